# SPDX-License-Identifier: BSD-3-Clause
"""A lubricant fitted to a measured curve, and its result folder."""

import math
import os
from dataclasses import replace

from pyehl.arrays import write_csv
from pyehl.case import Case
from pyehl.destination import Destination, write_json
from pyehl.errors import InputError, did_you_mean
from pyehl.given import Option, check_kind, path_of
from pyehl.rigs.quantities import FILM, FRICTION, SLIP, SPEED
from pyehl.rigs.reading import is_rig, read_rig
from pyehl.studies.film_fit import fit_coefficient
from pyehl.studies.measured_friction import Measured, read_measured
from pyehl.studies.rig_comparison import measured_curve
from pyehl.studies.shear_fit import PARAMETERS, Fit, fit_law
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Settings

KEY = "contact.slide_to_roll"
OF_FILM = "pressure-viscosity"
FILES = ("fit.csv", "parameters.csv", "lubricant.nml", "fit.png", "summary.json")


def fit_lubricant(
    data: str | os.PathLike[str],
    case: Case | str | os.PathLike[str],
    *options: Option,
    law: str = "",
    between: tuple[float, float] | None = None,
    points: int = 129,
    output: str | os.PathLike[str] | None = None,
    force: bool = False,
) -> Fit:
    """Fit the shear law of a lubricant to a traction curve, or its coefficient to film thickness.

    Friction and central film are those of smooth contacts that are solved, at each slide-to-roll
    ratio or over the mean velocity; the parameters are those of least squares, with 95 % confidence
    intervals of the linearised model.

    Parameters
    ----------
    data
        CSV file with the columns ``contact.slide_to_roll``, ``mu`` and, if known, ``error``; or the
        file of a rig (`pyehl compare --measured`): its steps under the conditions of the case,
        repeats averaged, with their scatter as error.
    case
        A case, or the path of a case file: the contact in SI units and its lubricant. Roughness
        does not count.
    *options
        Values that replace those of the case, as of `Case`.
    law
        'eyring', 'limiting' (the limiting coefficient) or 'carreau'; '': that of the case, and
        'eyring' where the case has none. 'pressure-viscosity': the coefficient from films over
        speed of a rig, also where the file has films alone.
    between
        Least and largest slide-to-roll ratio [-] or mean velocity [m/s] of the points of a rig that
        are used; None: all.
    points
        Nodes along X of the contacts.
    output
        Result folder, as ``pyehl fit-lubricant -o`` writes it; None: nothing is kept on disk.
    force
        Other files may be in the folder; they stay.

    Returns
    -------
    Fit
        With ``parameters``, ``residual_rms`` and ``group``, the parameters as ``&lubricant`` to
        paste.

    Raises
    ------
    InputError
        If the data or the case is not acceptable, or the folder holds something else.
    EhlError
        If a contact has no solution, or no fit is found.
    FileError
        If the folder cannot be written.

    Examples
    --------
    >>> import pyehl
    >>> try:
    ...     pyehl.fit_lubricant("cases/films.csv", "cases/table1.nml")
    ... except pyehl.InputError as error:
    ...     print(str(error).partition(" error")[0])
    cases/films.csv:3:
    """
    path = path_of(data, "data")
    inputs = [path] if isinstance(case, Case) else [path, path_of(case, "case")]
    check_kind(points, int, "points", "a whole number")
    case = Case(case, *options)
    settings = case.resolve()
    given = str(settings["lubricant"]["shear_law"])
    if not law and is_rig(path) and not _has_friction(path):
        law = OF_FILM
    law = law or ("eyring" if given == "newtonian" else given)
    laws = (*PARAMETERS, OF_FILM)
    if law not in laws:
        raise InputError(f"law = {law}: expected one of {', '.join(laws)}{did_you_mean(law, laws)}")
    measured, left_out = _measured(path, settings, law, between)
    if not OperatingPoint.from_settings(settings).si:
        raise InputError(
            "a contact given by moes_m and moes_l has no sliding speed in m/s\nexpected: load, "
            "mean_velocity, radius and reduced_modulus"
        )
    place = None
    if output is not None:
        place = Destination(path_of(output, "output"), "fit", FILES, tuple(inputs), force=force)
        place.check()
    if law == OF_FILM:
        found = fit_coefficient(settings, measured, points)
    else:
        found = fit_law(settings, law, measured, points)
    found = replace(found, notes=(*found.notes, *(f"left out: {why}" for why in left_out)))
    if place is not None:
        _write(found, place)
    return found


def _measured(
    path: str, settings: Settings, law: str, between: tuple[float, float] | None
) -> tuple[Measured, list[str]]:
    """Read the curve that a law is fitted to, and what of the file is left out."""
    left_out: list[str] = []
    if law == OF_FILM or is_rig(path):
        quantity, over = (FILM, SPEED) if law == OF_FILM else (FRICTION, SLIP)
        ends = between or (-math.inf, math.inf)
        measured, left_out = measured_curve(path, settings, quantity, over, ends)
    elif between is not None:
        raise InputError(f"{path}: between is for the file of a rig")
    else:
        measured = read_measured(path, KEY)
    if law == OF_FILM:
        return measured, left_out
    if (measured.abscissa, measured.ordinate) != (KEY, "mu"):
        raise InputError(
            f"{path}:1: error: the columns are {measured.abscissa} and {measured.ordinate}\n"
            f"expected: {KEY} and mu, and error, which may be missing"
        )
    if measured.places.max() > 2.0:
        raise InputError(f"{path}: error: {KEY} = {measured.places.max():g}\nexpected: at most 2")
    if measured.friction.min() <= 0.0:
        raise InputError(f"{path}: error: mu = {measured.friction.min():g}\nexpected: above 0")
    return measured, left_out


def _has_friction(path: str) -> bool:
    return any(FRICTION.name in step.columns for step in read_rig(path).steps)


def _write(fit: Fit, place: Destination) -> None:
    """Write tables, group, picture and summary, whole or not at all."""
    # matplotlib takes long to import
    from pyehl.plots.lubricant import draw_film_fit, draw_fit  # noqa: PLC0415
    from pyehl.plots.style import save  # noqa: PLC0415

    with place.fresh() as folder:
        rows = zip(fit.places, fit.measured, fit.error, fit.fitted, strict=True)
        names = fit.over, fit.quantity, "error", f"{fit.quantity}_fitted"
        write_csv(folder / "fit.csv", names, rows)
        columns = ("key", "unit", "value", "low", "high")
        write_csv(
            folder / "parameters.csv",
            columns,
            [tuple(getattr(p, name) for name in columns) for p in fit.parameters],
        )
        (folder / "lubricant.nml").write_text(fit.group, encoding="utf-8")
        draw = draw_fit if fit.law else draw_film_fit
        words = f"{fit.law or fit.parameters[0].key.replace('_', '-')}, fitted"
        figure = draw(fit.places, fit.measured, fit.error, (fit.places, fit.fitted), words)
        save(figure, folder / "fit.png", command="fit-lubricant")
        write_json(folder / "summary.json", {**fit.summary, "files": sorted(FILES)})
