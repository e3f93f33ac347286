# SPDX-License-Identifier: BSD-3-Clause
"""The verb ``pyehl run``: drive a solver to the end and write the result folder.

The same calls in the same order as the program ``ehl``, hence the same bits and the same files.
"""

from __future__ import annotations

import argparse
import os
import signal
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

from tqdm import tqdm

from pyehl import core, surface
from pyehl.case import Case, add_case_arguments

__all__ = ["StopRequest", "add_arguments", "execute", "run"]

EXIT_OK, EXIT_FAILED, EXIT_INTERRUPTED = 0, 1, 130
# Seconds between progress lines where the output is not a terminal
PROGRESS_INTERVAL = 2.0


class StopRequest:
    """Whether somebody wants the run to stop."""

    def __init__(self) -> None:
        self.wanted = False


@contextmanager
def stop_on_signals() -> Iterator[StopRequest]:
    """SIGINT and SIGTERM ask for a stop after the cycle at hand; a second one acts at once."""
    request = StopRequest()
    previous: dict[int, signal._HANDLER] = {}
    numbers: tuple[int, ...] = (signal.SIGINT, signal.SIGTERM)

    def note(number: int, frame: FrameType | None) -> None:
        request.wanted = True
        signal.signal(number, previous[number])

    for number in numbers:
        previous[number] = signal.signal(number, note)
    try:
        yield request
    finally:
        for number, handler in previous.items():
            signal.signal(number, handler)


class Progress:
    """One line about the state: in place on a terminal, now and then elsewhere."""

    def __init__(self, solver: core.Solver, *, quiet: bool) -> None:
        self._solver = solver
        self._quiet = quiet
        self._bar = tqdm(bar_format="{desc} [{elapsed}]", disable=quiet or not sys.stderr.isatty())
        self._last = time.monotonic()

    def update(self) -> None:
        """Show the state if it is time to."""
        now = time.monotonic()
        if self._quiet or now - self._last < (PROGRESS_INTERVAL if self._bar.disable else 0.1):
            return
        self._last = now
        if self._bar.disable:
            print(self._solver.progress(), flush=True)
        else:
            self._bar.set_description_str(self._solver.progress())

    def close(self) -> None:
        """Show the last state."""
        self._bar.close()
        if not self._quiet:
            print(self._solver.progress(), flush=True)


def run(case: Case, folder: str | os.PathLike[str], *, quiet: bool = False) -> int:
    """Solve a case and write the result folder.

    Parameters
    ----------
    case
        What to solve.
    folder
        A new or empty folder, or one with results of an earlier run, which are replaced.
    quiet
        Print nothing.

    Returns
    -------
    int
        0 converged, 1 ended without convergence, 130 interrupted by a signal; the folder is
        written in all three.

    Raises
    ------
    InputError
        If the folder holds something else than results.
    EhlError
        If the solver failed; nothing is written then.
    """
    core.check_output(folder)
    heights = surface.made_heights(case)
    with stop_on_signals() as request, core.Solver.open(case, heights) as solver:
        if not quiet:
            print(solver.describe(), flush=True)
        progress = Progress(solver, quiet=quiet)
        while not solver.done:
            if request.wanted:
                solver.interrupt()
            else:
                solver.advance()
            progress.update()
        progress.close()
        note = solver.write(folder)
        if not quiet:
            print(f"note: {note}\n" if note else "", f"results: {os.fspath(folder)}", sep="")
        if solver.converged:
            return EXIT_OK
        return EXIT_INTERRUPTED if request.wanted else EXIT_FAILED


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of ``pyehl run``."""
    add_case_arguments(parser)
    parser.add_argument("-o", "--output", required=True, metavar="DIR", help="result folder")
    parser.add_argument("-q", "--quiet", action="store_true", help="print nothing but errors")


def execute(args: argparse.Namespace) -> int:
    """Run ``pyehl run``."""
    return run(Case.read(args.case, args.overrides), args.output, quiet=args.quiet)
