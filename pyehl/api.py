# SPDX-License-Identifier: BSD-3-Clause
"""What people type: solve and predict in one call."""

from __future__ import annotations

import os
from collections.abc import Callable

import xarray as xr

from pyehl.case import Case
from pyehl.errors import NotConverged
from pyehl.given import Option, check_kind, path_of
from pyehl.prediction import of_case
from pyehl.prediction.result import Prediction
from pyehl.progress import ProgressBar
from pyehl.results import load
from pyehl.run import Observer, run
from pyehl.solver import Solver

__all__ = ["predict", "solve"]

Progress = bool | Callable[[Solver], object]


class _Listener(Observer):
    """Hands the state of a run on: to a function, or to a line on stderr."""

    def __init__(self, progress: Progress) -> None:
        self._call = progress if callable(progress) else None
        self._bar = ProgressBar(disable=progress is not True)

    def advanced(self, solver: Solver) -> None:
        """Take the state after a cycle or a step."""
        if self._call is not None:
            self._call(solver)
        self._bar.show(solver)
        if solver.done:
            self._bar.close()


def solve(
    case: Case | str | os.PathLike[str],
    *options: Option,
    output: str | os.PathLike[str] | None = None,
    force: bool = False,
    check: bool = True,
    progress: Progress = False,
) -> xr.Dataset:
    """Solve a case.

    Parameters
    ----------
    case
        A case, or the path of a case file.
    *options
        Texts ``group.key=value`` that replace values.
    output
        Result folder, as ``pyehl run -o`` writes it, with checkpoints of a transient run beside
        it; None: nothing is kept on disk.
    force
        Other files may be in the result folder; they stay.
    check
        Raise `NotConverged` if there is no solution.
    progress
        True: a line about the state on stderr, in a transient run with the time left; a function:
        called with the solver after each cycle or step.

    Returns
    -------
    xarray.Dataset
        The same as `load` of the result folder.

    Raises
    ------
    InputError
        If the case is not acceptable, or `output` holds something else than results of `solve`.
    NotConverged
        If the run ended without a solution; the results so far are its ``results``.
    KeyboardInterrupt
        If the run was interrupted; the folder `output` is written nevertheless.

    Examples
    --------
    >>> import pyehl
    >>> ds = pyehl.solve("cases/quick.nml", "grid.points=65")
    >>> ds.P.shape, ds.attrs["status"]
    ((65, 65), 'converged')
    >>> round(ds.attrs["H_c"], 3)
    0.059
    """
    inputs = () if isinstance(case, Case) else (case,)
    case = Case.of(case, *options)
    check_kind(check, bool, "check", "True or False")
    if not callable(progress):
        check_kind(progress, bool, "progress", "True, False or a function")
    listener = _Listener(progress)
    if output is None:
        with Solver(case) as solver:
            while not solver.done:
                solver.advance()
                listener.advanced(solver)
            data = solver.dataset()
    else:
        output = path_of(output, "output")
        outcome = run(case, output, listener, force=force, inputs=inputs)
        if outcome.interrupted:
            raise KeyboardInterrupt
        data = load(output)
    status = data.attrs["status"]
    if check and status != "converged":
        raise NotConverged(f"no solution: the run ended with the status '{status}'", data)
    return data


def predict(
    case: Case | str | os.PathLike[str],
    *options: Option,
    smooth: str | os.PathLike[str] | None = None,
) -> Prediction:
    """Predict the relative friction of a rough contact from the spectrum of its surface.

    Parameters
    ----------
    case
        A case, or the path of a case file.
    *options
        Texts ``group.key=value`` that replace values.
    smooth
        Result folder with the smooth contact (of `solve`, or under a transient run); without it the
        contact is solved on the spot.

    Returns
    -------
    Prediction
        With ``mu_ratio`` (mu_r/mu_s [-]), ``summary``, ``data`` and ``plot()``.

    Raises
    ------
    InputError
        If the case is not acceptable, or has no rough surface.
    FileError
        If a height map cannot be read.

    Examples
    --------
    >>> import pyehl
    >>> p = pyehl.predict("cases/table1.nml", "surface.seed=3")
    >>> p
    Prediction(mu_ratio=1..., 'predicted')
    """
    case = Case.of(case, *options)
    if smooth is not None:
        smooth = path_of(smooth, "smooth")
    return of_case.predict(case.resolve(), case.text, smooth=smooth)
