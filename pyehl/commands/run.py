# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl run``: solve a case and write a result folder."""

import argparse
import logging
import sys
import time
from collections.abc import Callable
from typing import Any

from pyehl.case import Case
from pyehl.commands.arguments import add_case_arguments, add_force
from pyehl.errors import EXIT_FAILED, EXIT_INTERRUPTED, EXIT_OK, InputError
from pyehl.progress import ProgressBar
from pyehl.run import Outcome, resume, run
from pyehl.solver import Solver
from pyehl.streams import mute

LOG = logging.getLogger(__name__)

# Seconds between progress lines where the output is not a terminal
PROGRESS_INTERVAL = 2.0


class _Printer:
    """Prints lines; if the output fails after the first one, a run continues without them.

    A closed pipe, and a failure at the first line, are raised.
    """

    def __init__(self) -> None:
        self.lines = 0
        self.failed = False

    def __call__(self, text: str) -> None:
        if self.failed:
            return
        try:
            print(text, flush=True)
        except BrokenPipeError:
            raise
        except OSError as error:
            if not self.lines:
                # nothing has been computed
                raise
            mute()
            self.failed = True
            LOG.warning("standard output: cannot be written: %s", error.strerror)
        self.lines += 1


def _display(say: Callable[[str], None]) -> Callable[[Solver], None]:
    """Make a function that shows the state: a bar on a terminal, else lines at intervals."""
    bar = ProgressBar() if sys.stderr.isatty() else None
    interval = PROGRESS_INTERVAL if bar is None else 0.1
    last = time.monotonic()

    def show(solver: Solver) -> None:
        nonlocal last
        if solver.done or time.monotonic() - last >= interval:
            last = time.monotonic()
            if bar is not None:
                bar.show(solver)
            if bar is None or solver.done:
                say(solver.progress)

    return show


def _status(outcome: Outcome, say: _Printer) -> int:
    if outcome.converged:
        return EXIT_FAILED if say.failed else EXIT_OK
    return EXIT_INTERRUPTED if outcome.interrupted else EXIT_FAILED


def add_arguments(parser: argparse.ArgumentParser) -> None:
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
    say = _Printer()
    options: dict[str, Any] = {} if args.quiet else {"say": say, "advanced": _display(say)}
    options["force"] = args.force
    if args.resume is not None:
        if args.resume == "":
            raise InputError("pyehl run: error: the folder after --resume has no name")
        case = None if args.case is None else Case(args.case, args.overrides)
        done = resume(
            args.resume,
            args.output,
            case,
            options=args.overrides,
            inputs=() if args.case is None else (args.case,),
            **options,
        )
        return _status(done, say)
    if args.case is None or args.output is None:
        missing = "case file" if args.case is None else "result folder: -o DIR is missing"
        raise InputError(
            f"pyehl run: error: no {missing}\n"
            "expected: pyehl run CASE.nml -o DIR, or pyehl run --resume DIR"
        )
    case = Case(args.case, args.overrides)
    return _status(run(case, args.output, inputs=(args.case,), **options), say)
