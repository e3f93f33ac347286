# SPDX-License-Identifier: BSD-3-Clause
"""A solver of the compiled library by its handle: the calls, their lock and their errors.

One call at a time runs on a solver; calls of other threads wait.
"""

import math
import os
import threading
from collections.abc import Callable
from typing import Any, NamedTuple, NoReturn, Self

import numpy as np
from numpy.typing import ArrayLike

from pyehl.errors import check
from pyehl.extension import predicted
from pyehl.extension import solvers as ehl
from pyehl.given import path_of, text_of
from pyehl.library import returned
from pyehl.reasons import Results
from pyehl.types import Array

# Initial sizes of the buffers: bytes of names, number of values
MIN_BYTES, MIN_VALUES = 16384, 400
NO_HEIGHTS = np.zeros((1, 1), order="F")


class Work(NamedTuple):
    """How much of a transient run is done, in time steps of the finest grid.

    Steps on the next coarser grid, for the grid error, count by their cost. `earliest` and
    `latest` are 0 before the first time step, and for a steady contact, whose number of cycles is
    not known in advance. Of a duty both are an estimate of all steps, in proportion to time.

    Attributes
    ----------
    done
        Steps done.
    earliest
        Steps after which the run can end: its mean can then be compared with earlier ones.
    latest
        Steps after which it ends even if its mean has not settled.
    """

    done: float
    earliest: float
    latest: float


def _in_order(heights: ArrayLike | None) -> Array | None:
    return None if heights is None else np.asfortranarray(heights, dtype=np.float64)


def _arguments(given: tuple[Array | None, Array | None]) -> tuple[int, Array, int, Array]:
    """Give the arguments for the library: whether each surface is given, and its heights."""
    first, second = given
    return (
        int(first is not None),
        NO_HEIGHTS if first is None else first,
        int(second is not None),
        NO_HEIGHTS if second is None else second,
    )


class SolverHandle:
    """A solver on the text of a resolved case, with heights in place of files.

    A ``with`` block closes it at the end.

    Parameters
    ----------
    text
        Resolved namelist text.
    heights, second_heights
        Heights of &surface and &second_surface [m], (nx, ny), peaks positive; None: as in the case.

    Attributes
    ----------
    done
        Whether the run has ended.
    converged
        Whether the solution converged.
    """

    _handle = 0
    _calls = 0
    # surfaces in place of files, until they are in a checkpoint
    _given: tuple[Array | None, Array | None] = (None, None)
    done = False
    converged = False

    def __init__(
        self, text: str, heights: ArrayLike | None = None, second_heights: ArrayLike | None = None
    ) -> None:
        # reentrant: a method may make several calls
        self._lock = threading.RLock()
        self._given = (_in_order(heights), _in_order(second_heights))
        handle, status, message = ehl.open_case(
            text.encode(), b"resolved case", *_arguments(self._given)
        )
        check(status, message)
        self._handle = handle

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def _call(
        self, function: Callable[..., tuple[Any, ...]], *arguments: object
    ) -> tuple[Any, ...]:
        """Call a library function on this solver; returns its results without the status."""
        with self._lock:
            *result, status, message = function(self._handle, *arguments)
        check(status, message)
        return tuple(result)

    def close(self) -> None:
        """Free the memory; the solver cannot be used afterwards."""
        with self._lock:
            self._call(ehl.close_case)
            self._handle = 0
            self._given = (None, None)

    def __reduce_ex__(self, protocol: object) -> NoReturn:
        """Refuse to copy or pickle: the arrays are in the library."""
        raise TypeError(
            f"a {type(self).__name__} cannot be copied or pickled: make another of the same case, "
            "or pass on its dataset()"
        )

    def __del__(self) -> None:
        # The constructor may have failed, and at exit the extension may be gone
        if getattr(self, "_handle", 0) and ehl is not None:
            ehl.close_case(self._handle)

    def advance(self) -> bool:
        """Run one cycle (steady) or time step (transient); whether the run has ended."""
        with self._lock:
            done, converged = self._call(ehl.advance)
            self._calls += 1
            self.done, self.converged = bool(done), bool(converged)
            return self.done

    def run(self) -> bool:
        """Run to the end; whether the solution converged."""
        while not self.advance():
            pass
        return self.converged

    def interrupt(self) -> None:
        """Stop here; the results so far stay readable, with the status 'interrupted'."""
        with self._lock:
            self._call(ehl.interrupt)
            self.done = True

    def resume(self, results: str | os.PathLike[str]) -> str:
        """Resume the transient run of a result folder; call it before the first `advance`.

        Returns a note for the user; '' if there is no state yet and the run starts anew.

        Raises
        ------
        InputError
            If every state is damaged, or the state belongs to another case or version.
        """
        folder = os.fsencode(path_of(results, "the result folder"))
        return returned(*self._call(ehl.resume, folder))

    def checkpoint(
        self, results: str | os.PathLike[str], resumed: str | os.PathLike[str] = ""
    ) -> str:
        """Prepare ``RESULTS.checkpoint`` for the states of a transient run, see `save_state`.

        The folder of the results is locked until the solver is closed. There are no states without
        time steps, or with output.checkpoint_interval = 0.

        Parameters
        ----------
        results
            Result folder of the run.
        resumed
            Result folder of the run that `resume` resumes; '': none.

        Returns
        -------
        str
            Where the states of an earlier run are now; usually ''.

        Raises
        ------
        InputError
            If the folder holds other files, or another run writes these results.
        FileError
            If the folder cannot be made.
        """
        with self._lock:
            note = self._call(
                ehl.keep_states,
                os.fsencode(path_of(results, "the result folder")),
                os.fsencode(path_of(resumed, "the folder to resume")),
                *_arguments(self._given),
            )
            self._given = (None, None)
        return returned(*note)

    def save_state(self, *, at_once: bool = False) -> bool:
        """Save the state if the interval of the case has passed, or at once.

        Returns
        -------
        bool
            If at once, whether a saved state exists; otherwise False.

        Raises
        ------
        FileError
            If it cannot be written.
        """
        return bool(*self._call(ehl.save_state, int(at_once)))

    def clear_checkpoint(self) -> None:
        """Remove the states: the run has ended."""
        self._call(ehl.clear_states)

    @property
    def progress(self) -> str:
        """The state in one line."""
        return returned(*self._call(ehl.progress))

    @property
    def work(self) -> Work:
        """Completed and total work of a transient run."""
        return Work(*self._call(ehl.work))

    @property
    def shape(self) -> tuple[int, int]:
        """Nodes of the finest grid in X and Y."""
        nx, ny = self._call(ehl.grid_shape)
        return nx, ny

    def axes(self) -> tuple[Array, Array]:
        """Coordinates X (nx,) and Y (ny,) of the nodes in Hertz radii a."""
        nx, ny = self.shape
        x, y = np.empty(nx), np.empty(ny)
        self._call(ehl.axes, x, y)
        return x, y

    def field(self, name: str) -> Array:
        """Give a field on the finest grid, shape (nx, ny), Fortran order.

        Parameters
        ----------
        name
            'P' or 'H'; of a rough contact, after the smooth one, also 'P_smooth', 'H_smooth', 'RR'
            or 'A_d' (see `pyehl.load`); with frictional heating 'temperature_rise_K',
            'temperature_rise_wall_1_K' or 'temperature_rise_wall_2_K'. Lengths and pressures are in
            Hertz units, temperatures in K.

        Raises
        ------
        InputError
            If there is no such field.
        """
        values = np.empty(self.shape, order="F")
        self._call(ehl.field, text_of(name, "field"), values)
        return values

    def _write(self, folder: str | os.PathLike[str]) -> None:
        self._call(ehl.write_files, os.fsencode(folder))


def results_of(solver: SolverHandle) -> Results:
    """Give the scalar results of a solver, with codes of reasons in place of their texts."""
    return _listed(solver, of_plan=False)


def plan_of(solver: SolverHandle) -> Results:
    """Give the numbers of the plan of a solver."""
    return _listed(solver, of_plan=True)


def _listed(solver: SolverHandle, *, of_plan: bool) -> Results:
    n_bytes, n_values = MIN_BYTES, MIN_VALUES
    while True:
        names, kinds = np.empty(n_bytes, np.int32), np.empty(n_values, np.int32)
        values = np.empty(n_values)
        length, count = solver._call(ehl.results, int(of_plan), names, kinds, values)
        if length <= n_bytes and count <= n_values:
            text = names[:length].astype(np.uint8).tobytes().decode(errors="replace")
            return _sorted(text.splitlines(), kinds[:count].tolist(), values[:count].tolist())
        n_bytes, n_values = length, count


def _sorted(lines: list[str], kinds: list[int], values: list[float]) -> Results:
    """Sort results by kind; a line is a name, and after a tab a text."""
    result = Results({}, {}, {})
    for line, kind, value in zip(lines, kinds, values, strict=True):
        name, _, text = line.partition("\t")
        match kind:
            case 1:
                result.values[name] = value if math.isfinite(value) else None
            case 2:
                result.values[name] = int(value)
            case 3:
                result.values[name] = bool(value)
            case 4:
                result.codes[name] = int(value)
            case 5:
                result.details[name] = value
            case 6:
                result.values[name] = text
            case _:
                result.details[name] = text
    return result


def take_prediction(solver: SolverHandle, left_out: float, unresolved: float) -> None:
    """Pass a solver the prediction for the waves that the grid omits, for the error of mu_ratio.

    Parameters
    ----------
    solver
        The solver that receives it.
    left_out, unresolved
        Parts of mu_ratio in waves that the grid omits, and in those that it does not resolve [-];
        NaN if there is no prediction.
    """
    solver._call(predicted.take_prediction, left_out, unresolved)


def start_fronts(solver: SolverHandle) -> Array:
    """Positions of the fronts [a] at which `take_start` must give a pressure.

    Shape (4, surfaces); most runs need none, (4, 0).
    """
    fronts, n = solver._call(predicted.start_fronts)
    return np.asarray(fronts[:, :n])


def take_start(solver: SolverHandle, pressure: Array | None, why: str = "") -> None:
    """Pass a solver the pressure of roughness that fills the contact, as the initial condition.

    Parameters
    ----------
    solver
        The solver that receives it.
    pressure
        At the positions of `start_fronts`, shape (nx, ny, 4) [p_h]; None if there is none.
    why
        Why there is none.
    """
    given = np.zeros((1, 1, 4), order="F") if pressure is None else pressure
    solver._call(predicted.take_start, why.encode(), given)
