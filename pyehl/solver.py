# SPDX-License-Identifier: BSD-3-Clause
"""A solver of the compiled library on one case.

Arrays are float64 of shape (nx, ny) in Fortran order, first index X. Pressures are scaled by the
Hertz pressure p_h, lengths by the Hertz radius a, films by a^2/R.
"""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, Self

from numpy.typing import ArrayLike

from pyehl import display
from pyehl.case import Case
from pyehl.errors import FileError, InputError
from pyehl.given import Option, heights_of, path_of
from pyehl.handle import SolverHandle, Work
from pyehl.surfaces import Record, Topography, for_solver

if TYPE_CHECKING:
    import xarray

__all__ = ["Addition", "Solver", "Step"]


@dataclass(frozen=True, slots=True)
class Step:
    """Where a solver is after a cycle (steady contact) or a time step (transient run).

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
        return self.solver.summary()

    @property
    def work(self) -> Work:
        """How much of a transient run is done, as `Solver.work`."""
        return self.solver.work()


class Addition(Protocol):
    """What is known of a run beside what the library tells."""

    def report(self) -> list[str]:
        """Lines of the plan."""
        ...

    def amend(self, values: dict[str, Any]) -> None:
        """Add to the scalars of a summary."""
        ...


class Solver(SolverHandle):
    """A solver on one case, advanced cycle by cycle or step by step.

    A context manager, and an iterator over what is left to do. One thread at a time works on a
    solver; several solvers may run in several threads.

    Parameters
    ----------
    case
        A case, or the path of a case file.
    *options
        Texts ``group.key=value`` that replace values.

    Raises
    ------
    InputError
        If the case cannot be solved.
    NoMemoryError
        If its arrays do not fit, or too many solvers are open.

    Examples
    --------
    >>> import pyehl
    >>> with pyehl.Solver("cases/quick.nml", "grid.points=33") as solver:
    ...     for step in solver:
    ...         if step.number == 20:
    ...             break
    ...     pressure = solver.field("P")
    >>> solver.converged, pressure.shape
    (True, (33, 33))
    """

    def __init__(self, case: Case | str | os.PathLike[str], *options: Option) -> None:
        self._start(Case.of(case, *options), None)

    @classmethod
    def open(cls, case: Case | str | os.PathLike[str], heights: ArrayLike | None = None) -> Self:
        """Start a solver on a case with a surface that is given.

        Parameters
        ----------
        case
            A case, or the path of a case file.
        heights
            Surface [m], shape (nx, ny), peaks positive; for the kinds 'map' and 'fractal', in
            place of the file or the generator. None: that of the case. Its size is `surface.tile_x`
            and `tile_y` or, where these are 0, `surface.length_x` and `length_y`.

        Raises
        ------
        InputError, NoMemoryError
            As the constructor.
        """
        solver = cls.__new__(cls)
        solver._start(Case.of(case), None if heights is None else heights_of(heights))
        return solver

    def _start(self, case: Case, heights: ArrayLike | None) -> None:
        self._case = case
        self.preparation: Record | None = None
        self.part: Topography | None = None
        self.resolution: Addition | None = None
        options: tuple[str, ...] = ()
        if heights is None:
            made = for_solver(case.resolve())
            heights, options, self.preparation = made.heights, made.options, made.preparation
            self.part = made.part
        elif case.resolve()["surface"]["kind"] not in ("map", "fractal"):
            raise InputError(
                "heights are given, and the surface of the case is none of heights\n"
                "expected: surface.kind = 'map' or 'fractal'"
            )
        text = case.with_options(*options).text if options else case.text
        self._open(text, heights)

    def __repr__(self) -> str:
        """Give the case and the state in one line."""
        state = "closed" if self._handle == 0 else self.summary()["status"]
        return f"Solver({self._case!r}, {state!r}, {self._calls} advances)"

    def _repr_html_(self) -> str:
        """Draw the scalars so far, for notebooks."""
        values = {} if self._handle == 0 else self.summary()
        return display.table(repr(self), {k: v for k, v in values.items() if v is not None})

    def __iter__(self) -> Iterator[Step]:
        """Advance to the end, or until the caller stops; yields the state after each advance."""
        while not self.done:
            self.advance()
            yield Step(self._calls, self.progress(), self)

    def describe(self) -> str:
        """Tell the plan: what will be solved and how, with a table of the levels."""
        return "\n".join([self._describe(), *self._lines()])

    def _lines(self) -> list[str]:
        """Tell how a map was prepared, and what the grid does not resolve."""
        lines = self.preparation.report() if self.preparation else []
        return lines + (self.resolution.report() if self.resolution else [])

    def _amended(self, values: dict[str, Any]) -> dict[str, Any]:
        """Add to the scalars what the library does not know."""
        if self.preparation:
            values["surface_preparation"] = self.preparation.summary()
        if self.resolution:
            self.resolution.amend(values)
        return values

    def summary(self) -> dict[str, Any]:
        """Give the scalar results as in ``summary.json``; None for a number that does not exist."""
        return self._amended(json.loads(self._summary()))

    def dataset(self) -> xarray.Dataset:
        """Give the results so far, the same as `pyehl.load` of the folder that `write` makes."""
        # xarray takes long to import, and most runs only write
        from pyehl.results import load  # noqa: PLC0415

        with tempfile.TemporaryDirectory(prefix="pyehl-") as folder:
            self.write(folder)
            return load(folder)

    def write(self, folder: str | os.PathLike[str]) -> str:
        """Write the result folder, whole or not at all; returns a note, mostly empty.

        Raises
        ------
        FileError
            If it cannot be written.
        """
        folder = path_of(folder, "folder")
        note = self._write(folder)
        if self.preparation or self.resolution:
            self._amend(Path(folder))
        return note

    def _amend(self, folder: Path) -> None:
        """Add to plan and summary what the library does not know."""
        try:
            for name in ("summary.json", "plan.txt"):
                text = (folder / name).read_text(encoding="utf-8")
                if name == "plan.txt":
                    text = "\n".join([text.rstrip("\n"), *self._lines(), ""])
                else:
                    values = self._amended(json.loads(text))
                    text = json.dumps(values, indent=2, allow_nan=False) + "\n"
                fresh = folder / f"{name}.new"
                fresh.write_text(text, encoding="utf-8")
                fresh.replace(folder / name)
        except OSError as error:
            raise FileError(f"{folder}: cannot write: {error.strerror or error}") from error
