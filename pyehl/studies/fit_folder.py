# SPDX-License-Identifier: BSD-3-Clause
"""A shear law fitted to a measured traction curve, and its result folder."""

import os

from pyehl.arrays import write_csv
from pyehl.case import Case
from pyehl.destination import Destination, write_json
from pyehl.errors import InputError, did_you_mean
from pyehl.given import Option, check_kind, path_of
from pyehl.studies.measured_friction import read_measured
from pyehl.studies.shear_fit import PARAMETERS, Fit, fit_law
from pyehl.theory.operating import OperatingPoint

KEY = "contact.slide_to_roll"
FILES = ("fit.csv", "parameters.csv", "lubricant.nml", "fit.png", "summary.json")


def fit_lubricant(
    data: str | os.PathLike[str],
    case: Case | str | os.PathLike[str],
    *options: Option,
    law: str = "",
    points: int = 129,
    output: str | os.PathLike[str] | None = None,
    force: bool = False,
) -> Fit:
    """Fit the shear law of a lubricant to a measured traction curve.

    The friction is that of smooth contacts, solved with the law at each slide-to-roll ratio; the
    parameters are those of least squares, with 95 % confidence intervals of the linearised model.

    Parameters
    ----------
    data
        CSV file with the columns ``contact.slide_to_roll``, ``mu`` and, if known, ``error``.
    case
        A case, or the path of a case file: the contact in SI units and its lubricant. Roughness
        does not count.
    *options
        Values that replace those of the case, as of `Case`.
    law
        'eyring', 'limiting' (the limiting coefficient) or 'carreau'; '': that of the case, and
        'eyring' where the case has none.
    points
        Nodes along X of the contacts.
    output
        Result folder, as ``pyehl fit-lubricant -o`` writes it; None: nothing is kept on disk.
    force
        Other files may be in the folder; they stay.

    Returns
    -------
    Fit
        With ``parameters``, ``residual_rms`` and ``group``, the law as ``&lubricant`` to paste.

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
    law = law or ("eyring" if given == "newtonian" else given)
    if law not in PARAMETERS:
        raise InputError(
            f"law = {law}: expected one of {', '.join(PARAMETERS)}{did_you_mean(law, PARAMETERS)}"
        )
    measured = read_measured(path, KEY)
    if (measured.abscissa, measured.ordinate) != (KEY, "mu"):
        raise InputError(
            f"{path}:1: error: the columns are {measured.abscissa} and {measured.ordinate}\n"
            f"expected: {KEY} and mu, and error, which may be missing"
        )
    if measured.places.max() > 2.0:
        raise InputError(f"{path}: error: {KEY} = {measured.places.max():g}\nexpected: at most 2")
    if measured.friction.min() <= 0.0:
        raise InputError(f"{path}: error: mu = {measured.friction.min():g}\nexpected: above 0")
    if not OperatingPoint.from_settings(settings).si:
        raise InputError(
            "a contact given by moes_m and moes_l has no sliding speed in m/s\nexpected: load, "
            "mean_velocity, radius and reduced_modulus"
        )
    place = None
    if output is not None:
        place = Destination(path_of(output, "output"), "fit", FILES, tuple(inputs), force=force)
        place.check()
    found = fit_law(settings, law, measured, points)
    if place is not None:
        _write(found, place)
    return found


def _write(fit: Fit, place: Destination) -> None:
    """Write tables, group, picture and summary, whole or not at all."""
    # matplotlib takes long to import
    from pyehl.plots.lubricant import draw_fit  # noqa: PLC0415
    from pyehl.plots.style import save  # noqa: PLC0415

    with place.fresh() as folder:
        rows = zip(fit.slide_to_roll, fit.measured, fit.error, fit.fitted, strict=True)
        write_csv(folder / "fit.csv", (KEY, "mu", "error", "mu_fitted"), rows)
        columns = ("key", "unit", "value", "low", "high")
        write_csv(
            folder / "parameters.csv",
            columns,
            [tuple(getattr(p, name) for name in columns) for p in fit.parameters],
        )
        (folder / "lubricant.nml").write_text(fit.group, encoding="utf-8")
        curve = fit.slide_to_roll, fit.fitted
        words = f"{fit.law}, fitted"
        figure = draw_fit(fit.slide_to_roll, fit.measured, fit.error, curve, words)
        save(figure, folder / "fit.png", command="fit-lubricant")
        write_json(folder / "summary.json", {**fit.summary, "files": sorted(FILES)})
