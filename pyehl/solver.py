# SPDX-License-Identifier: BSD-3-Clause
"""A solver of the compiled library on one case.

Arrays are float64 of shape (nx, ny) in Fortran order, first index X. Pressures are scaled by the
Hertz pressure p_h, lengths by the Hertz radius a, films by a^2/R.
"""

from __future__ import annotations

import json
import os
import tempfile
import threading
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pyehl import display
from pyehl.case import Case, Option
from pyehl.errors import FileError, InputError, check
from pyehl.library import ehl, text_of
from pyehl.surfaces import Preparation, for_solver

if TYPE_CHECKING:
    import xarray

__all__ = ["Solver", "Step"]

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Step:
    """Where a solver is after a cycle (steady contact) or a time step (transient run).

    Attributes
    ----------
    number
        Calls of `Solver.advance` so far.
    text
        The state in one line.
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


class Solver:
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
    def open(cls, case: Case, heights: ArrayLike | None = None) -> Self:
        """Start a solver on a case with a surface that is given.

        Parameters
        ----------
        case
            What to solve.
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
        solver._start(case, heights)
        return solver

    def _start(self, case: Case, heights: ArrayLike | None) -> None:
        self._handle = 0
        self._lock = threading.Lock()
        self._case = case
        self._calls = 0
        self.done = False
        self.converged = False
        self.preparation: Preparation | None = None
        options: tuple[str, ...] = ()
        if heights is None:
            try:
                made = for_solver(case.resolve())
            except (ValueError, OSError) as error:
                raise InputError(str(error)) from error
            heights, options, self.preparation = made.heights, made.options, made.preparation
        text = case.with_options(*options).text if options else case.text
        given = np.zeros((1, 1)) if heights is None else heights
        handle, status, message = ehl.open_case(
            text.encode(),
            b"resolved case",
            int(heights is not None),
            np.asfortranarray(given, dtype=np.float64),
        )
        check(status, message)
        self._handle = handle

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

    def close(self) -> None:
        """Free the memory; the solver cannot be used afterwards."""
        with self._lock:
            ehl.close_case(self._handle)
            self._handle = 0

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def __del__(self) -> None:
        # The constructor may have failed, and at exit the extension may be gone
        if getattr(self, "_handle", 0) and ehl is not None:
            ehl.close_case(self._handle)

    def advance(self) -> bool:
        """One cycle (steady) or step (moving surface); whether nothing is left to do."""
        with self._lock:
            done, converged, status, message = ehl.advance(self._handle)
        check(status, message)
        self._calls += 1
        self.done, self.converged = bool(done), bool(converged)
        return self.done

    def run(self) -> bool:
        """Advance to the end; whether the solution converged."""
        while not self.advance():
            pass
        return self.converged

    def interrupt(self) -> None:
        """Stop here; the results so far stay readable, with the status 'interrupted'."""
        with self._lock:
            check(*ehl.interrupt(self._handle))
        self.done = True

    def resume(self, results: str | os.PathLike[str]) -> str:
        """Go on with the march that was to write into a folder; before the first `advance`.

        Returns what a person should know; '' when there is no state yet, so that the march
        begins at its beginning.

        Raises
        ------
        InputError
            If the state is damaged, or belongs to another case.
        """
        with self._lock:
            note, status, message = ehl.resume(self._handle, os.fsencode(results))
        check(status, message)
        return text_of(note)

    def keep(self, results: str | os.PathLike[str], resumed: str | os.PathLike[str] = "") -> str:
        """Keep states of a march in ``RESULTS.checkpoint``, every ``output.checkpoint_interval``.

        Parameters
        ----------
        results
            The folder that the results are for.
        resumed
            The folder of the run that `resume` goes on with.

        Returns
        -------
        str
            Where the states of an earlier run are now; mostly ''.

        Raises
        ------
        FileError
            If the folder cannot be made.
        """
        with self._lock:
            note, status, message = ehl.keep(
                self._handle, os.fsencode(results), os.fsencode(resumed)
            )
        check(status, message)
        return text_of(note)

    def save_state(self, *, at_once: bool = False) -> bool:
        """Save the state if its time has come, or at once; whether there is one then.

        Raises
        ------
        FileError
            If it cannot be written.
        """
        with self._lock:
            has_state, status, message = ehl.save_state(self._handle, int(at_once))
        check(status, message)
        return bool(has_state)

    def end_keeping(self) -> None:
        """Remove the states: there is nothing left to go on with."""
        with self._lock:
            check(*ehl.end_keeping(self._handle))

    def describe(self) -> str:
        """Tell the plan: what will be solved and how, with a table of the levels."""
        text, status, message = ehl.describe(self._handle)
        check(status, message)
        return "\n".join([text_of(text), *self._map_lines()])

    def _map_lines(self) -> list[str]:
        """Tell how a map was prepared."""
        return self.preparation.report() if self.preparation else []

    def progress(self) -> str:
        """Tell the state in one line."""
        text, status, message = ehl.progress(self._handle)
        check(status, message)
        return text_of(text)

    def skipped(self) -> str:
        """Tell what a march that has ended did not have to do; '' for every other run."""
        text, status, message = ehl.skipped(self._handle)
        check(status, message)
        return text_of(text)

    def summary(self) -> dict[str, Any]:
        """Give the scalar results as in ``summary.json``; None for a number that does not exist."""
        text, status, message = ehl.summary(self._handle)
        check(status, message)
        values: dict[str, Any] = json.loads(text_of(text))
        if self.preparation:
            values["surface_preparation"] = self.preparation.summary()
        return values

    @property
    def shape(self) -> tuple[int, int]:
        """Nodes of the finest grid in X and Y."""
        nx, ny, status, message = ehl.grid_shape(self._handle)
        check(status, message)
        return nx, ny

    def axes(self) -> tuple[Array, Array]:
        """Coordinates X (nx,) and Y (ny,) of the nodes in Hertz radii a."""
        nx, ny = self.shape
        x, y = np.empty(nx), np.empty(ny)
        check(*ehl.axes(self._handle, x, y))
        return x, y

    def field(self, name: str) -> Array:
        """Pressure 'P' or film 'H', shape (nx, ny), Fortran order.

        Raises
        ------
        InputError
            If there is no such field.
        """
        values = np.empty(self.shape, order="F")
        check(*ehl.field(self._handle, name.encode(), values))
        return values

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
        with self._lock:
            note, status, message = ehl.write_output(self._handle, os.fsencode(folder))
        check(status, message)
        if self.preparation:
            self._add_preparation(Path(folder))
        return text_of(note)

    def _add_preparation(self, folder: Path) -> None:
        """Add to plan and summary how a map was prepared; the library does not know."""
        try:
            for name in ("summary.json", "plan.txt"):
                text = (folder / name).read_text(encoding="utf-8")
                if name == "plan.txt":
                    text = "\n".join([text.rstrip("\n"), *self._map_lines(), ""])
                else:
                    values = json.loads(text)
                    assert self.preparation is not None
                    values["surface_preparation"] = self.preparation.summary()
                    text = json.dumps(values, indent=2, allow_nan=False) + "\n"
                fresh = folder / f"{name}.new"
                fresh.write_text(text, encoding="utf-8")
                fresh.replace(folder / name)
        except OSError as error:
            raise FileError(f"{folder}: cannot write: {error.strerror or error}") from error
