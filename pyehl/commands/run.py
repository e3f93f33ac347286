# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl run``: solve a case and write a result folder."""

from __future__ import annotations

import argparse
import sys
import time

from pyehl.case import Case
from pyehl.commands.arguments import add_case_arguments, add_force
from pyehl.errors import EXIT_FAILED, EXIT_INTERRUPTED, EXIT_OK, InputError
from pyehl.progress import ProgressBar
from pyehl.run import Observer, Outcome, resume, run
from pyehl.solver import Solver

__all__ = ["add_arguments", "execute"]

# Seconds between progress lines where the output is not a terminal
PROGRESS_INTERVAL = 2.0


class Terminal(Observer):
    """Prints; one line about the state in place on a terminal, now and then elsewhere."""

    def __init__(self) -> None:
        self._bar = ProgressBar(disable=not sys.stderr.isatty())
        self._last = time.monotonic()

    def say(self, text: str) -> None:
        """Print a message."""
        print(text, flush=True)

    def advanced(self, solver: Solver) -> None:
        """Show the state if it is time to, and at the end."""
        if solver.done:
            self._bar.close()
            self.say(solver.progress())
            return
        now = time.monotonic()
        if now - self._last < (PROGRESS_INTERVAL if self._bar.disabled else 0.1):
            return
        self._last = now
        if self._bar.disabled:
            self.say(solver.progress())
        else:
            self._bar.show(solver)


def _status(outcome: Outcome) -> int:
    if outcome.converged:
        return EXIT_OK
    return EXIT_INTERRUPTED if outcome.interrupted else EXIT_FAILED


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of ``pyehl run``."""
    add_case_arguments(parser, optional=True)
    parser.add_argument("-o", "--output", metavar="DIR", help="result folder")
    parser.add_argument(
        "--resume",
        metavar="DIR",
        help="resume the interrupted run in DIR; results are bitwise identical. CASE.nml and -o "
        "may be left out",
    )
    add_force(parser)
    parser.add_argument("-q", "--quiet", action="store_true", help="print nothing but errors")


def execute(args: argparse.Namespace) -> int:
    """Run ``pyehl run``."""
    observer = Observer() if args.quiet else Terminal()
    if args.resume is not None:
        if args.resume == "":
            raise InputError("pyehl run: error: the folder behind --resume has no name")
        case = None if args.case is None else Case.read(args.case, args.overrides)
        done = resume(
            args.resume,
            args.output,
            case,
            observer,
            options=args.overrides,
            force=args.force,
            inputs=() if args.case is None else (args.case,),
        )
        return _status(done)
    if args.case is None or args.output is None:
        missing = "case file" if args.case is None else "result folder: -o DIR is missing"
        raise InputError(
            f"pyehl run: error: no {missing}\n"
            "expected: pyehl run CASE.nml -o DIR, or pyehl run --resume DIR"
        )
    case = Case.read(args.case, args.overrides)
    return _status(run(case, args.output, observer, force=args.force, inputs=(args.case,)))
