# SPDX-License-Identifier: BSD-3-Clause
"""A solver of the compiled library on one case.

Arrays are float64 of shape (nx, ny) in Fortran order, first index X. Pressures are scaled by the
Hertz pressure p_h, lengths by the Hertz radius a, films by a^2/R.
"""

from __future__ import annotations

import os
import tempfile
import time
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from numpy.typing import ArrayLike

from pyehl import display
from pyehl.assessment import assess
from pyehl.case import Case
from pyehl.conclusion import conclude, resumption
from pyehl.destination import Destination, write_json
from pyehl.given import Option, heights_of, path_of
from pyehl.handle import SolverHandle, Work, plan_of, results_of
from pyehl.library import version
from pyehl.plan_text import plan_text
from pyehl.reasons import summary_of
from pyehl.simulation.predictions import Predictions
from pyehl.surfaces import (
    GROUPS,
    Record,
    SolverSurface,
    Surface,
    Topography,
    gather,
    moved,
    with_surface,
    write_beside,
)
from pyehl.types import Array

if TYPE_CHECKING:
    import xarray


@dataclass(frozen=True, slots=True)
class Step:
    """State of a solver after a cycle (steady contact) or a time step (transient run).

    Attributes
    ----------
    number
        Calls of `Solver.advance` so far.
    text
        The state in one line; in a transient run with the time left.
    solver
        The solver itself, for its fields and its summary.
    """

    number: int
    text: str
    solver: Solver

    def __str__(self) -> str:
        """Give the state in one line."""
        return self.text

    @property
    def summary(self) -> dict[str, Any]:
        """The scalars so far, as `Solver.summary`."""
        return self.solver.summary

    @property
    def work(self) -> Work:
        """Completed and total work of a transient run, as `Solver.work`."""
        return self.solver.work


class Solver(SolverHandle):
    """A solver on one case, advanced cycle by cycle or step by step.

    A context manager, and an iterator over its cycles or steps. Any thread may call any method: one
    call at a time runs on a solver, so that a thread reads the state after a whole cycle or step.
    Several solvers may run in several threads.

    Parameters
    ----------
    case
        A case, or the path of a case file.
    *options
        Values that replace those of the case, as for `Case`.
    surface, second_surface
        Rough surfaces in place of those of the case: a `pyehl.Topography`, or an array of heights
        [m] with the size of the case. Keys that prepare a map do not apply to them.

    Raises
    ------
    InputError
        If the case cannot be solved.
    FileError
        If a height map cannot be opened.
    NoMemoryError
        If its arrays do not fit, or too many solvers are open.

    Examples
    --------
    >>> import pyehl
    >>> with pyehl.Solver("cases/quick.nml", "grid.points=65") as solver:
    ...     for step in solver:
    ...         if step.number == 20:
    ...             break
    ...     pressure = solver.field("P")
    >>> solver.converged, pressure.shape
    (True, (65, 65))
    """

    def __init__(
        self,
        case: Case | str | os.PathLike[str],
        *options: Option,
        surface: Surface | None = None,
        second_surface: Surface | None = None,
    ) -> None:
        case = Case(case, *options)
        tiles = {}
        for group, in_memory in zip(GROUPS, (surface, second_surface), strict=True):
            if in_memory is not None:
                case, tiles[group] = with_surface(case, in_memory, group)
        settings = case.resolve()
        heights = {group: moved(tile, settings[group]).heights for group, tile in tiles.items()}
        self._start(case, heights, tiles)

    def _start(
        self, case: Case, heights: Mapping[str, Array], tiles: Mapping[str, Topography]
    ) -> None:
        """Start on a case with heights by group, made from `tiles`, in place of its surfaces."""
        self._started = time.perf_counter()
        self._case, self._settings = case, case.resolve()
        # surfaces that were given as arrays
        self._tiles = tiles
        self._preparations: dict[str, Record] = {}
        own = gather(self._settings, heights, tiles)
        parts = self._take(own)
        self._predictions = Predictions(case, parts, whole=bool(heights) or not parts)
        options = [option for made in own.values() for option in made.options]
        text = case.with_options(*options).text if options else case.text
        super().__init__(text, *(made.heights for made in own.values()))

    def _take(self, made: Mapping[str, SolverSurface]) -> dict[str, Topography]:
        """Store how maps were prepared, by group; return the parts of large maps."""
        self._preparations |= {g: one.preparation for g, one in made.items() if one.preparation}
        return {group: one.part for group, one in made.items() if one.part is not None}

    def advance(self) -> bool:
        """Run one cycle (steady) or time step (transient); whether the run has ended."""
        if not self._calls:
            self._predictions.begin(self)
        if super().advance():
            self._predictions.transfer(self)
        return self.done

    def interrupt(self) -> None:
        """Stop here; the results so far stay readable, with the status 'interrupted'."""
        super().interrupt()
        self._predictions.transfer(self)

    def __repr__(self) -> str:
        """Give the case and the state in one line."""
        state = "closed" if self._handle == 0 else results_of(self).values["status"]
        return f"Solver({self._case!r}, {state!r}, {self._calls} advances)"

    def _repr_html_(self) -> str:
        """Draw the scalars so far, for notebooks."""
        values = {} if self._handle == 0 else self.summary
        return display.table(repr(self), {k: v for k, v in values.items() if v is not None})

    def __iter__(self) -> Iterator[Step]:
        """Advance to the end, or until the caller stops; yields the state after each advance."""
        while not self.done:
            self.advance()
            yield Step(self._calls, self.progress, self)

    def describe(self, *, predict: bool = False) -> str:
        """Describe the plan: what will be solved and how, with a table of the levels.

        Parameters
        ----------
        predict
            Also predict the part of the friction by waves that the grid does not resolve; this
            solves the smooth contact.
        """
        return "\n".join([self._plan_text(), *self._lines(predict=predict)])

    def _plan_text(self) -> str:
        return plan_text(plan_of(self), self._settings)

    def _lines(self, *, predict: bool = True) -> list[str]:
        """Describe how a map was prepared, and what the grid does not resolve."""
        lines = [line for made in self._preparations.values() for line in made.report()]
        return lines + (self._predictions.lines() if predict else [])

    @property
    def summary(self) -> dict[str, Any]:
        """The scalar results as in ``summary.json``; None for a number that does not exist."""
        why = self._predictions.why_none
        values = summary_of(results_of(self), self._settings, why) | self._prepared()
        return values | {"assessment": assess(values).text}

    def _prepared(self) -> dict[str, Any]:
        """Describe the preparation of measured maps, by the name in a summary."""
        return {f"{name}_preparation": made.summary for name, made in self._preparations.items()}

    def conclusion(self) -> str:
        """Describe the results of a run that has ended, with their errors, in a few lines."""
        self._predictions.transfer(self)
        return str(conclude(self.summary))

    def resumption(self, results: str | os.PathLike[str]) -> str:
        """Describe how to resume a run for a result folder; '' if that is impossible."""
        return resumption(self.summary["status"], os.fspath(results))

    def dataset(self) -> xarray.Dataset:
        """Give the results so far, the same as `pyehl.load` of the folder that `write` makes."""
        # importing xarray is slow, and most runs only write
        from pyehl.results import load  # noqa: PLC0415

        with tempfile.TemporaryDirectory(prefix="pyehl-") as folder:
            self._fill(Path(folder))
            return load(folder)

    def write(
        self,
        folder: str | os.PathLike[str],
        *,
        force: bool = False,
        inputs: Iterable[str | os.PathLike[str]] = (),
    ) -> None:
        """Write the result folder, whole or not at all.

        Parameters
        ----------
        folder
            A new or empty folder, or one with a result of an earlier run, which is replaced.
        force
            Accept other files in the folder; they stay.
        inputs
            Files that must not be replaced.

        Raises
        ------
        InputError
            If the folder holds something else.
        FileError
            If it cannot be written.
        """
        folder = path_of(folder, "the result folder")
        place = Destination(folder, "solution", inputs=tuple(inputs), force=force)
        with place.fresh() as fresh:
            self._fill(fresh)

    def _fill(self, folder: Path) -> None:
        """Write all files into an empty folder, with the entries that pyehl adds."""
        self._predictions.transfer(self)
        self._write(folder)
        lines = [self._plan_text(), *self._lines()]
        (folder / "plan.txt").write_text("\n".join([*lines, ""]), encoding="utf-8")
        for group, tile in self._tiles.items():
            write_beside(tile, folder / "case.nml", group)
        values = {
            **self.summary,
            "version": version(),
            "wall_seconds": time.perf_counter() - self._started,
            "files": sorted(["summary.json", *os.listdir(folder)]),
        }
        write_json(folder / "summary.json", values)


def solver_on_heights(
    case: Case,
    heights: Mapping[str, ArrayLike],
    made: Mapping[str, SolverSurface] | None = None,
) -> Solver:
    """Start a solver on a case with heights in place of its surfaces.

    Parameters
    ----------
    case
        The case.
    heights
        Surfaces by group [m], shape (nx, ny), peaks positive; for the kinds 'map' and 'fractal', in
        place of the file or the generator. The size is `tile_x` and `tile_y` of the group or, where
        these are 0, `length_x` and `length_y`.
    made
        Their preparation, for those from an earlier run.

    Raises
    ------
    InputError, FileError, NoMemoryError
        As `Solver`.
    """
    solver = Solver.__new__(Solver)
    solver._start(case, {group: heights_of(given) for group, given in heights.items()}, {})
    if made:
        parts = solver._take(made)
        solver._predictions = Predictions(case, parts, whole=not parts)
    return solver
