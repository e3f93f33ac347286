# SPDX-License-Identifier: BSD-3-Clause
"""Drive a solver to the end and write the result folder.

The same calls in the same order as the program ``ehl``, hence the same bits and the same files.
A march keeps its state in ``DIR.checkpoint`` as it goes: `resume` goes on with it.
"""

from __future__ import annotations

import os
import signal
import sys
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from types import FrameType

import numpy as np
from numpy.typing import NDArray
from tqdm import tqdm

from pyehl import library
from pyehl.case import Case
from pyehl.errors import FileError
from pyehl.solver import Solver
from pyehl.surfaces import made_heights

__all__ = ["StopRequest", "resume", "run"]

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


def _keep_state(solver: Solver, *, at_once: bool) -> bool:
    """Save the state, now or if its time has come. A run does not end because that fails."""
    try:
        return solver.save_state(at_once=at_once)
    except FileError as error:
        print(error, file=sys.stderr)
        return False


class Progress:
    """One line about the state: in place on a terminal, now and then elsewhere."""

    def __init__(self, solver: Solver, *, quiet: bool) -> None:
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
    return _march(case, folder, "", quiet=quiet)


def resume(
    results: str | os.PathLike[str],
    folder: str | os.PathLike[str] | None = None,
    case: Case | None = None,
    *,
    options: Iterable[str] = (),
    quiet: bool = False,
) -> int:
    """Go on with a march that was stopped, to the same numbers as one that was not.

    Parameters
    ----------
    results
        The folder that the march was to write into; its state is beside it, in
        ``RESULTS.checkpoint``.
    folder
        Where the results go now; default `results`.
    case
        The case; default: as it was. It may differ in threads, in when to stop and in what
        to write.
    options
        Texts ``group.key=value`` that replace values of the case as it was.
    quiet
        Print nothing.

    Returns
    -------
    int
        As `run`.

    Raises
    ------
    InputError
        If nothing was kept, if all of it is damaged, or if it belongs to another case.
    EhlError
        As `run`.
    """
    kept = library.checkpoint_case(results)
    if case is None:
        case = Case.read(kept, options)
    return _march(case, results if folder is None else folder, results, quiet=quiet)


def _heights(case: Case, resumed: str | os.PathLike[str]) -> NDArray[np.float64] | None:
    """Surface that Python makes [m], or that was kept; None for the solver's own."""
    if os.fspath(resumed):
        kept = library.checkpoint_case(resumed).with_name("surface.npy")
        if kept.is_file():
            heights: NDArray[np.float64] = np.load(kept, allow_pickle=False)
            return heights
    return made_heights(case.resolve())


def _march(
    case: Case,
    folder: str | os.PathLike[str],
    resumed: str | os.PathLike[str],
    *,
    quiet: bool,
) -> int:
    """Solve a case, from its beginning or from the state of a run with the results `resumed`."""

    def say(text: str) -> None:
        if not quiet:
            print(text, flush=True)

    library.check_output(folder)
    heights = _heights(case, resumed)
    with stop_on_signals() as request, Solver.open(case, heights) as solver:
        say(solver.describe())
        if os.fspath(resumed):
            begins = "there is no state yet: the run begins at its beginning"
            say(f"resume: {solver.resume(resumed) or begins}")
        note = solver.keep(folder, resumed)
        if note:
            say(f"note: {note}")
        progress = Progress(solver, quiet=quiet)
        while not solver.done:
            if request.wanted:
                solver.interrupt()
            else:
                solver.advance()
                _keep_state(solver, at_once=False)
            progress.update()
        progress.close()
        if solver.skipped():
            say(solver.skipped())
        has_state = not solver.converged and _keep_state(solver, at_once=True)
        note = solver.write(folder)
        if note:
            say(f"note: {note}")
        name = os.fspath(folder)
        say(f"results: {name}")
        if solver.converged:
            solver.end_keeping()
            return EXIT_OK
        if has_state:
            say(f"state: {name}.checkpoint\nto go on: pyehl run --resume {name}")
        return EXIT_INTERRUPTED if request.wanted else EXIT_FAILED
