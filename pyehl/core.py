# SPDX-License-Identifier: BSD-3-Clause
"""The only importer of the compiled extension: solvers, and functions of the library.

Arrays are float64 of shape (nx, ny) in Fortran order, first index X. Pressures are scaled by the
Hertz pressure p_h, lengths by the Hertz radius a, films and deflections by a^2/R.
"""

from __future__ import annotations

import json
import os
import threading
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pyehl.errors import InputError, check

try:
    from pyehl._core import ehl_f2py_functions as _functions
    from pyehl._core import ehl_f2py_solver as _ehl
except ImportError as error:  # pragma: no cover
    raise ImportError(
        "the compiled part of pyehl is not here. Install the package (pip install .) and run "
        "outside of the source folder, or use 'python -P'."
    ) from error

if TYPE_CHECKING:
    from pyehl.case import Case

__all__ = [
    "Deflection",
    "Key",
    "Solver",
    "build",
    "check_output",
    "checkpoint_case",
    "deflection",
    "density",
    "keys",
    "log_viscosity",
    "resolve",
    "version",
]

Array = NDArray[np.float64]


def _text(value: bytes) -> str:
    return value.decode(errors="replace").rstrip()


def join_options(options: Iterable[str]) -> str:
    """Options group.key=value as the library takes them, one a line.

    Raises
    ------
    InputError
        If an option has more than one line.
    """
    options = list(options)
    for option in options:
        if "\n" in option:
            raise InputError("--set: more than one line\nexpected: group.key=value")
    return "".join(f"{option}\n" for option in options)


def resolve(text: str, origin: str, options: Iterable[str] = (), *, from_file: bool = False) -> str:
    """Resolve a case: check it, and spell out every value of it as namelist text.

    Parameters
    ----------
    text
        Namelist text; not used with `from_file`.
    origin
        Name of the file, for messages and for names of maps.
    options
        Texts ``group.key=value`` that replace values.
    from_file
        Read the file `origin`.

    Raises
    ------
    InputError
        With file, line and column, what was expected, and the nearest name.
    """
    resolved, status, message = _functions.resolve(
        text.encode(), os.fsencode(origin), join_options(options).encode(), int(from_file)
    )
    check(status, message)
    return _text(resolved) + "\n"


def check_output(folder: str | os.PathLike[str]) -> None:
    """Refuse a folder that results could not be written into.

    Raises
    ------
    InputError
        If it holds something else than results, or cannot be made.
    """
    check(*_functions.check_output(os.fsencode(folder)))


def checkpoint_case(results: str | os.PathLike[str]) -> Path:
    """Case file of the march that was to write into a folder, to go on with it.

    Beside it lies ``surface.npy`` when the surface of the march came from Python.

    Raises
    ------
    InputError
        If nothing was kept to go on with.
    """
    path, status, message = _functions.checkpoint_case(os.fsencode(results))
    check(status, message)
    return Path(os.fsdecode(path.rstrip()))


@dataclass(frozen=True, slots=True)
class Key:
    """One key of a case file: ``group.name``, unit, default, allowed values, meaning."""

    name: str
    unit: str
    default: str
    allowed: str
    meaning: str


def keys() -> list[Key]:
    """All keys of a case file, in order."""
    return [Key(*line.split("\t")) for line in _text(_functions.keys()).splitlines()]


def version() -> str:
    """Version of the compiled library."""
    return _text(_functions.about()[0])


def build() -> str:
    """Compiler and options of the compiled library."""
    return _text(_functions.about()[1])


class Solver:
    """A solver on one case, advanced cycle by cycle or step by step.

    A context manager: ``with Solver.open(case) as solver``. One thread at a time works on a
    solver; several solvers may run in several threads.
    """

    def __init__(self, handle: int) -> None:
        self._handle = handle
        self._lock = threading.Lock()
        self.done = False
        self.converged = False

    @classmethod
    def open(cls, case: Case, heights: ArrayLike | None = None) -> Self:
        """Start a solver on a case.

        Parameters
        ----------
        case
            What to solve.
        heights
            Surface [m], shape (nx, ny), peaks positive; for the kinds 'map' (in place of the file)
            and 'fractal', where `pyehl.topography` makes it.

        Raises
        ------
        InputError
            If the case cannot be solved.
        NoMemoryError
            If its arrays do not fit, or too many solvers are open.
        """
        given = np.zeros((1, 1)) if heights is None else heights
        handle, status, message = _ehl.open_case(
            case.text.encode(),
            b"resolved case",
            int(heights is not None),
            np.asfortranarray(given, dtype=np.float64),
        )
        check(status, message)
        return cls(handle)

    def close(self) -> None:
        """Free the memory; the solver cannot be used afterwards."""
        with self._lock:
            _ehl.close_case(self._handle)
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
        # __init__ may not have run, and at exit the extension may be gone
        if getattr(self, "_handle", 0) and _ehl is not None:
            _ehl.close_case(self._handle)

    def advance(self) -> bool:
        """One cycle (steady) or step (moving surface); whether nothing is left to do."""
        with self._lock:
            done, converged, status, message = _ehl.advance(self._handle)
        check(status, message)
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
            check(*_ehl.interrupt(self._handle))
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
            note, status, message = _ehl.resume(self._handle, os.fsencode(results))
        check(status, message)
        return _text(note)

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
            note, status, message = _ehl.keep(
                self._handle, os.fsencode(results), os.fsencode(resumed)
            )
        check(status, message)
        return _text(note)

    def save_state(self, *, at_once: bool = False) -> bool:
        """Save the state if its time has come, or at once; whether there is one then.

        Raises
        ------
        FileError
            If it cannot be written.
        """
        with self._lock:
            has_state, status, message = _ehl.save_state(self._handle, int(at_once))
        check(status, message)
        return bool(has_state)

    def end_keeping(self) -> None:
        """Remove the states: there is nothing left to go on with."""
        with self._lock:
            check(*_ehl.end_keeping(self._handle))

    def describe(self) -> str:
        """Tell the plan: what will be solved and how, with a table of the levels."""
        text, status, message = _ehl.describe(self._handle)
        check(status, message)
        return _text(text)

    def progress(self) -> str:
        """Tell the state in one line."""
        text, status, message = _ehl.progress(self._handle)
        check(status, message)
        return _text(text)

    def skipped(self) -> str:
        """Tell what a march that has ended did not have to do; '' for every other run."""
        text, status, message = _ehl.skipped(self._handle)
        check(status, message)
        return _text(text)

    def summary(self) -> dict[str, Any]:
        """Give the scalar results as in ``summary.json``; None for a number that does not exist."""
        text, status, message = _ehl.summary(self._handle)
        check(status, message)
        values: dict[str, Any] = json.loads(_text(text))
        return values

    @property
    def shape(self) -> tuple[int, int]:
        """Nodes of the finest grid in X and Y."""
        nx, ny, status, message = _ehl.grid_shape(self._handle)
        check(status, message)
        return nx, ny

    def axes(self) -> tuple[Array, Array]:
        """Coordinates X (nx,) and Y (ny,) of the nodes in Hertz radii a."""
        nx, ny = self.shape
        x, y = np.empty(nx), np.empty(ny)
        check(*_ehl.axes(self._handle, x, y))
        return x, y

    def field(self, name: str) -> Array:
        """Pressure 'P' or film 'H', shape (nx, ny), Fortran order.

        Raises
        ------
        InputError
            If there is no such field.
        """
        values = np.empty(self.shape, order="F")
        check(*_ehl.field(self._handle, name.encode(), values))
        return values

    def write(self, folder: str | os.PathLike[str]) -> str:
        """Write the result folder, whole or not at all; returns a note, mostly empty.

        Raises
        ------
        FileError
            If it cannot be written.
        """
        with self._lock:
            note, status, message = _ehl.write_output(self._handle, os.fsencode(folder))
        check(status, message)
        return _text(note)


@dataclass(frozen=True, slots=True)
class Deflection:
    """A deflection: values (nx, ny), mean seconds of an application, bytes of the engine."""

    values: Array
    seconds: float
    bytes: float


def deflection(
    pressure: ArrayLike,
    hx: float,
    hy: float,
    engine: str = "mlmi",
    *,
    mirror: bool = False,
    accuracy: float = 1e-4,
    threads: int = 1,
    repeats: int = 1,
) -> Deflection:
    """Elastic deflection W = (2/pi^2) iint P dX' dY'/r, P constant over cells.

    The integral of Zhang et al. 2019, eq. 2, in Hertz units: P by p_h, lengths by a, W by a^2/R.

    Parameters
    ----------
    pressure
        P, shape (nx, ny).
    hx, hy
        Mesh sizes [a].
    engine
        'mlmi', 'fft' or 'direct'.
    mirror
        The rows are those with Y >= 0 of a pressure that is symmetric in Y.
    accuracy
        Largest error of 'mlmi' relative to the largest deflection.
    threads
        OpenMP threads.
    repeats
        Applications, for timing.

    Raises
    ------
    InputError
        If the engine does not exist or cannot serve the grid.
    """
    p = np.asfortranarray(pressure, dtype=np.float64)
    w = np.empty(p.shape, order="F")
    seconds, size, status, message = _functions.deflection(
        engine.encode(), p, w, hx, hy, int(mirror), accuracy, threads, repeats
    )
    check(status, message)
    return Deflection(w, seconds, size)


def log_viscosity(
    pressure: ArrayLike,
    law: str,
    *,
    alpha_bar: float,
    hertz_pressure: float,
    roelands_z: float,
    roelands_p0: float,
) -> tuple[Array, Array]:
    """ln(eta/eta0) of the solver and its slope in P at P = p/p_h, both shape (n,).

    Parameters
    ----------
    pressure
        P, shape (n,).
    law
        'roelands' or 'barus'.
    alpha_bar
        alpha p_h [-].
    hertz_pressure, roelands_p0
        p_h and p_0 [Pa].
    roelands_z
        Exponent z [-].

    Raises
    ------
    InputError
        If the law does not exist.
    """
    p = np.ascontiguousarray(pressure, dtype=np.float64)
    values, slopes = np.empty(p.shape), np.empty(p.shape)
    check(
        *_functions.viscosity(
            law.encode(), p, values, slopes, alpha_bar, hertz_pressure, roelands_z, roelands_p0
        )
    )
    return values, slopes


def density(pressure: ArrayLike, hertz_pressure: float) -> tuple[Array, Array]:
    """Dowson-Higginson rho/rho0 and its slope d(rho/rho0)/dP [-], both shape (n,).

    Parameters
    ----------
    pressure
        P = p/p_h, shape (n,).
    hertz_pressure
        p_h [Pa].
    """
    p = np.ascontiguousarray(pressure, dtype=np.float64)
    values, slopes = np.empty(p.shape), np.empty(p.shape)
    _functions.density(p, values, slopes, hertz_pressure)
    return values, slopes
