# SPDX-License-Identifier: BSD-3-Clause
"""Run a solver to the end and write the result folder.

The calls and their order are those of the program ``ehl``, hence the same bits and files. A
transient run saves its state in ``DIR.checkpoint`` at intervals: `resume` continues from there.
"""

import logging
import os
import signal
import threading
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from types import FrameType

import numpy as np

from pyehl import library
from pyehl.arrays import read_array
from pyehl.case import Case, files_of
from pyehl.destination import Destination
from pyehl.errors import FileError, InputError, named
from pyehl.solver import Solver, solver_on_heights
from pyehl.surfaces import GROUPS, Surface, for_solver

AnyPath = str | os.PathLike[str]

LOG = logging.getLogger(__name__)

SIGNALS = (signal.SIGINT, signal.SIGTERM)


@contextmanager
def signals_to(take: Callable[[int, FrameType | None], None]) -> Iterator[None]:
    """Handle SIGINT and SIGTERM by a function, in the main thread only.

    Python delivers signals to the main thread: in another thread nothing changes.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = {number: signal.signal(number, take) for number in SIGNALS}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


class StopRequest:
    """Whether the user wants the run to stop; a second signal acts at once."""

    def __init__(self) -> None:
        self.wanted = False
        self._before = {number: signal.getsignal(number) for number in SIGNALS}

    def take(self, number: int, frame: FrameType | None) -> None:
        """Handle a signal."""
        self.wanted = True
        signal.signal(number, self._before[signal.Signals(number)])


def _silent(_: object) -> None:
    """Ignore the progress of a run."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """How a run ended: whether it converged, and whether it was interrupted."""

    converged: bool
    interrupted: bool


def resume(
    results: AnyPath,
    folder: AnyPath | None = None,
    case: Case | None = None,
    *,
    say: Callable[[str], object] = _silent,
    advanced: Callable[[Solver], object] = _silent,
    options: Iterable[str] = (),
    force: bool = False,
    inputs: Iterable[AnyPath] = (),
) -> Outcome:
    """Resume a transient run that was stopped; the results are those of an uninterrupted run.

    Parameters
    ----------
    results
        Result folder of the run, with its state beside it in ``RESULTS.checkpoint``.
    folder
        Where the results go; None: to `results`.
    case
        The case, which may change the threads, when to stop and what to write; None: the saved one.
    options
        Such changes of the saved case; not used with a `case`.
    say, advanced, force, inputs
        As in `run`.

    Returns
    -------
    Outcome
        How the run ended.

    Raises
    ------
    InputError
        If there is no checkpoint, every state is damaged, or it belongs to another case.
    EhlError
        As in `run`.
    """
    kept = library.checkpoint_case(results)
    if case is None:
        case = Case(kept, options)
    return run(
        case,
        results if folder is None else folder,
        resumed=results,
        say=say,
        advanced=advanced,
        force=force,
        inputs=inputs,
    )


def _open(case: Case, resumed: AnyPath, given: tuple[Surface | None, Surface | None]) -> Solver:
    """Open a solver on a case, with the surfaces in the checkpoint if the run is resumed."""
    place = library.checkpoint_case(resumed) if os.fspath(resumed) else None
    files = {g: place.with_name(f"{g}.npy") for g in GROUPS} if place else {}
    kept = {group: read_array(path) for group, path in files.items() if path.is_file()}
    if place is None or not kept:
        return Solver(case, surface=given[0], second_surface=given[1])
    sizes: list[str] = []
    for group in kept:
        old = Case(place)[group]
        sizes += [f"{group}.{key}={old[key]!r}" for key in ("tile_x", "tile_y") if old[key]]
        if old["tile_mirrored"]:
            sizes.append(f"{group}.tile_mirrored=.true.")
    changed = case.with_options(*sizes) if sizes else case
    made = {}
    for group, heights in kept.items():
        try:
            tile = for_solver(case.resolve(), group)
        except (InputError, FileError):
            # the map file may be gone: its heights are in the checkpoint
            continue
        if tile.heights is not None and np.array_equal(tile.heights, heights):
            made[group] = tile
    return solver_on_heights(changed, kept, made)


def _open_named(
    inputs: tuple[AnyPath, ...],
    case: Case,
    resumed: AnyPath,
    given: tuple[Surface | None, Surface | None],
) -> Solver:
    """Open a solver; an error of the case names its file."""
    with named(os.fspath(inputs[0]) if inputs else ""):
        return _open(case, resumed, given)


def _save_state(solver: Solver, *, at_once: bool) -> bool:
    """Save the state, at once or if it is due; a failure does not end the run."""
    try:
        return solver.save_state(at_once=at_once)
    except FileError as error:
        LOG.warning(str(error))
        return False


def run(
    case: Case,
    folder: AnyPath,
    *,
    resumed: AnyPath = "",
    say: Callable[[str], object] = _silent,
    advanced: Callable[[Solver], object] = _silent,
    force: bool = False,
    inputs: Iterable[AnyPath] = (),
    surface: Surface | None = None,
    second_surface: Surface | None = None,
) -> Outcome:
    """Solve a case and write the result folder, whether or not the run converges.

    Parameters
    ----------
    case
        The case.
    folder
        A new or empty folder, or one with results of an earlier run, which are replaced.
    resumed
        Result folder of a run from whose state this one continues; '': it starts anew.
    say
        Receives messages.
    advanced
        Receives the solver after each cycle or step.
    force
        Accept other files in the folder; they stay.
    inputs
        Files of the case, the case file first; a folder with one of them is not replaced.
    surface, second_surface
        Rough surfaces in place of those of the case, as in `pyehl.solve`.

    Returns
    -------
    Outcome
        How the run ended.

    Raises
    ------
    InputError
        If the case is not acceptable, or the folder holds something other than results, or cannot
        be written.
    EhlError
        If the solver failed: nothing is written then.
    """
    inputs = tuple(inputs)
    sources = (*inputs, *files_of(case.resolve()))
    Destination(folder, "solution", inputs=sources, force=force).check()
    request = StopRequest()
    given = surface, second_surface
    with signals_to(request.take), _open_named(inputs, case, resumed, given) as solver:
        say(solver.describe(predict=True))
        if os.fspath(resumed):
            begins = "there is no state yet: the run starts from the beginning"
            say(f"resume: {solver.resume(resumed) or begins}")
        note = solver.checkpoint(folder, resumed)
        if note:
            say(f"note: {note}")
        while not solver.done:
            if request.wanted:
                solver.interrupt()
            else:
                solver.advance()
                _save_state(solver, at_once=False)
            advanced(solver)
        say(solver.conclusion())
        has_state = not solver.converged and _save_state(solver, at_once=True)
        solver.write(folder, force=force, inputs=sources)
        name = os.fspath(folder)
        say(f"results: {name}")
        if solver.converged:
            solver.clear_checkpoint()
        elif has_state and (command := solver.resumption(name)):
            say(f"state: {name}.checkpoint\n{command}")
        return Outcome(solver.converged, request.wanted and not solver.converged)
