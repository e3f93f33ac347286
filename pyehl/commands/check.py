# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl check``: the resolved case and the plan of its solution."""

import argparse

from pyehl.api import check
from pyehl.commands.arguments import add_case_arguments
from pyehl.surfaces.solver_surface import write_resolved


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.description = "Check a case; print the resolved case and the plan, without solving it."
    add_case_arguments(parser)
    parser.add_argument(
        "--resolved",
        metavar="FILE.nml",
        help="write the case that ehl reads instead, with every value, and surfaces that "
        "have to be prepared as .npy beside it; print the files",
    )


def execute(args: argparse.Namespace) -> int:
    checked = check(args.case, args.overrides)
    if args.resolved is None:
        print(checked)
        return 0
    for path in write_resolved(checked.case, args.resolved, (args.case,)):
        print(path)
    return 0
