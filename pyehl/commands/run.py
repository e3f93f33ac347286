# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl run``: solve a case and write a result folder."""

from __future__ import annotations

import argparse

from pyehl.case import Case
from pyehl.commands.arguments import add_case_arguments
from pyehl.errors import InputError
from pyehl.run import resume, run

__all__ = ["add_arguments", "execute"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of ``pyehl run``."""
    add_case_arguments(parser, optional=True)
    parser.add_argument("-o", "--output", metavar="DIR", help="result folder")
    parser.add_argument(
        "--resume",
        metavar="DIR",
        help="go on with the march that was to write into DIR, to the same numbers; CASE.nml and "
        "-o may be left out",
    )
    parser.add_argument("-q", "--quiet", action="store_true", help="print nothing but errors")


def execute(args: argparse.Namespace) -> int:
    """Run ``pyehl run``."""
    if args.resume is not None:
        if args.resume == "":
            raise InputError("pyehl run: error: the folder behind --resume has no name")
        case = None if args.case is None else Case.read(args.case, args.overrides)
        return resume(args.resume, args.output, case, options=args.overrides, quiet=args.quiet)
    if args.case is None or args.output is None:
        missing = "case file" if args.case is None else "result folder: -o DIR is missing"
        raise InputError(
            f"pyehl run: error: no {missing}\n"
            "expected: pyehl run CASE.nml -o DIR, or pyehl run --resume DIR"
        )
    return run(Case.read(args.case, args.overrides), args.output, quiet=args.quiet)
