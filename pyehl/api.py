# SPDX-License-Identifier: BSD-3-Clause
"""The subcommands as functions, each in one call."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from pyehl.case import Case, files_of
from pyehl.contact.film_formulas import FilmThickness, sheet
from pyehl.errors import NotConverged, named
from pyehl.given import Option, check_kind, path_of
from pyehl.prediction import result
from pyehl.prediction.friction import TRACKS
from pyehl.prediction.predict import predict as predict_resolved
from pyehl.prediction.result import Prediction
from pyehl.progress import ProgressBar
from pyehl.run import run
from pyehl.solver import Solver
from pyehl.surfaces import Surface, Topography, with_surface

if TYPE_CHECKING:
    import xarray

Progress = bool | Callable[[Solver], object]


def solve(
    case: Case | str | os.PathLike[str],
    *options: Option,
    surface: Surface | None = None,
    second_surface: Surface | None = None,
    output: str | os.PathLike[str] | None = None,
    force: bool = False,
    check: bool = True,
    progress: Progress = False,
) -> xarray.Dataset:
    """Solve a case.

    Parameters
    ----------
    case
        A case, or the path of a case file.
    *options
        Values that replace those of the case, as for `Case`.
    surface, second_surface
        Rough surfaces in place of those of the case: a `Topography`, or an array of heights [m] of
        shape (nx, ny), peaks positive, with the size of the case. Keys that prepare a map do not
        apply to them. They are written beside the results.
    output
        Result folder, as ``pyehl run -o`` writes it, with checkpoints of a transient run beside
        it; None: no files are written.
    force
        Accept other files in the result folder; they stay.
    check
        Raise `NotConverged` if the status at the end is not 'converged'.
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
    FileError
        If a height map cannot be opened, or the folder cannot be written.
    NoMemoryError
        If the arrays do not fit into memory.
    NotConverged
        If the run did not converge; the results so far are its ``results``.
    KeyboardInterrupt
        If the run was interrupted; the folder `output` is written nevertheless.

    Examples
    --------
    >>> import pyehl
    >>> ds = pyehl.solve("cases/quick.nml", {"grid.points": 65})
    >>> ds.P.shape, ds.attrs["status"]
    ((65, 65), 'converged')
    >>> round(float(ds.H_c), 3), ds.hertz_pressure_Pa.attrs["units"]
    (0.072, 'Pa')
    """
    inputs, name = ((), "") if isinstance(case, Case) else ((case,), path_of(case, "case"))
    case = Case(case, *options)
    check_kind(check, bool, "check", "True or False")
    if not callable(progress):
        check_kind(progress, bool, "progress", "True, False or a function")
        progress = ProgressBar().show if progress else lambda solver: None
    if output is None:
        with named(name):
            opened = Solver(case, surface=surface, second_surface=second_surface)
        with opened as solver:
            while not solver.done:
                solver.advance()
                progress(solver)
            data = solver.dataset()
    else:
        output = path_of(output, "output")
        outcome = run(
            case,
            output,
            advanced=progress,
            force=force,
            inputs=inputs,
            surface=surface,
            second_surface=second_surface,
        )
        if outcome.interrupted:
            raise KeyboardInterrupt
        # importing xarray is slow, and most functions do not need it
        from pyehl.results import load  # noqa: PLC0415

        data = load(output)
    status = data.attrs["status"]
    if check and status != "converged":
        raise NotConverged(f"not converged: the run ended with the status '{status}'", data)
    return data


def predict(
    case: Case | str | os.PathLike[str],
    *options: Option,
    surface: Surface | None = None,
    second_surface: Surface | None = None,
    smooth: str | os.PathLike[str] | None = None,
    tracks: int = TRACKS,
    output: str | os.PathLike[str] | None = None,
    force: bool = False,
    plots: bool = True,
) -> Prediction:
    """Predict the relative friction of a rough contact from the spectrum of its surfaces.

    Parameters
    ----------
    case
        A case, or the path of a case file.
    *options
        Values that replace those of the case, as for `Case`.
    surface, second_surface
        As in `solve`.
    smooth
        Result folder of `solve` with the same smooth contact, alone or under roughness; without it
        the contact is solved first.
    tracks
        Tracks across the surface, for mean and spread of mu_r/mu_s.
    output
        Result folder, as ``pyehl predict -o`` writes it; None: no files are written.
    force
        Accept other files in the result folder; they stay.
    plots
        Whether the folder gets the pictures.

    Returns
    -------
    Prediction
        With ``mu_ratio`` (mu_r/mu_s [-]), ``summary``, ``data`` and ``plot()``.

    Raises
    ------
    InputError
        If the case is not acceptable, or has no rough surface, or `output` holds something else
        than a prediction.
    FileError
        If a height map cannot be opened, or the folder cannot be written.

    Examples
    --------
    >>> import pyehl
    >>> p = pyehl.predict("cases/table1.nml", {"surface.seed": 3})
    >>> p
    Prediction(mu_ratio=1..., 'predicted')
    """
    inputs, name = ([], "") if isinstance(case, Case) else ([case], path_of(case, "case"))
    case = Case(case, *options)
    tiles: dict[str, Topography | None] = {"surface": None, "second_surface": None}
    inputs += files_of(case.resolve())
    for group, given in (("surface", surface), ("second_surface", second_surface)):
        if given is not None:
            case, tiles[group] = with_surface(case, given, group)
    check_kind(tracks, int, "tracks", "a whole number")
    if smooth is not None:
        smooth = path_of(smooth, "smooth")
    place = None
    if output is not None:
        place = result.destination(path_of(output, "output"), inputs=inputs, force=force)
        place.check()
    settings = case.resolve()
    with named(name):
        results = predict_resolved(
            settings,
            case.text,
            tracks=tracks,
            smooth=smooth,
            surface=tiles["surface"],
            second_surface=tiles["second_surface"],
        )
    if place is not None:
        result.write(results, place)
        if plots:
            result.draw(results, place.folder)
    return results


def film(case: Case | str | os.PathLike[str], *options: Option) -> FilmThickness:
    """Compute the film thickness of a case by closed formulas.

    Parameters
    ----------
    case
        A case, or the path of a case file.
    *options
        Values that replace those of the case, as for `Case`.

    Returns
    -------
    FilmThickness
        With ``formulas``, a dict for each with h_c_m and h_min_m [m], and ``summary``, the output
        of ``pyehl film --json``; its repr is the output of ``pyehl film``.

    Raises
    ------
    InputError
        If the case or its surface is not acceptable.

    Examples
    --------
    >>> import pyehl
    >>> result = pyehl.film("cases/table1.nml", {"contact.mean_velocity": 0.5})
    >>> for formula in (f for f in result.formulas if f["applies"]):
    ...     print(f"{formula['name']}: {formula['h_c_m'] * 1e9:.0f} nm")
    Nijenbanning-Venner-Moes: 164 nm
    Hamrock-Dowson: 181 nm
    Chittenden et al.: 171 nm
    """
    name = "" if isinstance(case, Case) else path_of(case, "case")
    settings = Case(case, *options).resolve()
    with named(name):
        return FilmThickness(sheet(settings))


@dataclass(frozen=True, slots=True, repr=False)
class CheckedCase:
    """A valid case and the plan of its solution; its repr is the output of ``pyehl check``.

    Attributes
    ----------
    case
        The case, with every value.
    plan
        What will be solved and how, with memory, time and a table of the levels.
    """

    case: Case
    plan: str

    def __repr__(self) -> str:
        """Give the case and the plan as text."""
        return f"{self.case.text}\n{self.plan}"


def check(case: Case | str | os.PathLike[str], *options: Option) -> CheckedCase:
    """Complete a case and plan its solution, without solving it.

    Parameters
    ----------
    case
        A case, or the path of a case file.
    *options
        Values that replace those of the case, as for `Case`.

    Returns
    -------
    CheckedCase
        With ``case`` and ``plan``; its repr is the output of ``pyehl check``.

    Raises
    ------
    InputError
        If the case cannot be solved.

    Examples
    --------
    >>> import pyehl
    >>> checked = pyehl.check("cases/quick.nml", {"grid.points": 65})
    >>> checked.case["grid"]["points"], "level" in checked.plan
    (65, True)
    """
    name = "" if isinstance(case, Case) else path_of(case, "case")
    case = Case(case, *options)
    with named(name), Solver(case) as solver:
        return CheckedCase(case, solver.describe())
