# SPDX-License-Identifier: BSD-3-Clause
"""Lubricants fitted to measured curves: pressure-viscosity coefficient from film over speed.

The film is that of solved smooth contacts, extrapolated from two grids, on finer ones if needed. It
is tabulated over speed and coefficient: the logarithm of the film is nearly linear in those of
both. This module also writes the result folder of a shear law (:mod:`pyehl.studies.shear_fit`).
"""

from __future__ import annotations

import math
import os
from dataclasses import replace
from functools import lru_cache

import numpy as np
from numpy.polynomial import chebyshev

from pyehl import namelist
from pyehl.arrays import write_csv
from pyehl.case import KEYS, Case, resolve
from pyehl.contact.smooth import FINEST, film_of
from pyehl.destination import Destination, write_json
from pyehl.errors import EhlError, InputError, did_you_mean
from pyehl.given import Option, check_kind, path_of
from pyehl.handle import SolverHandle, results_of
from pyehl.rigs.quantities import FILM, FRICTION, SLIP, SPEED
from pyehl.rigs.reading import is_rig, read_rig
from pyehl.studies.measured_friction import Measured, read_measured
from pyehl.studies.rig_comparison import measured_curve
from pyehl.studies.shear_fit import (
    PARAMETERS,
    Fit,
    Parameter,
    fit_law,
    intervals,
    smooth_base,
    weights,
)
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Array, Settings

KEY = "pressure_viscosity"
# Keys, and prefixes of keys, that determine the coefficient; the inlet viscosity stays as resolved
DETERMINING = KEY, "roelands_z", "name", "kinematic_", "vogel_", "dicke_", "inlet_law"
LAWS = ("roelands", "barus")
# Numbers of speeds and coefficients of the table, and the maximum coefficient over the middle one
SPEEDS, COEFFICIENTS, SPAN = 5, 3, 1.5
# Exponent of the coefficient in the film, for the first guess (Hamrock & Dowson 1977)
POWER = 0.53
# Maximum number of tables until one contains the coefficient in its range
TABLES = 6


class FilmTable:
    """Central film over speeds [m/s] and pressure-viscosity coefficients [1/Pa].

    Chebyshev polynomials in the logarithms, which interpolate solved contacts at Chebyshev nodes.
    """

    def __init__(self, base: Settings, speeds: tuple[float, float], coefficient: float) -> None:
        self._speed = (
            0.5 * math.log(speeds[0] * speeds[1]),
            max(0.5 * math.log(speeds[1] / speeds[0]), 0.05),
        )
        self.middle, self._span = math.log(coefficient), math.log(SPAN)
        along, across = (chebyshev.chebpts1(n) for n in (SPEEDS, COEFFICIENTS))
        speed, values = (
            np.exp(m + h * z)
            for m, h, z in ((*self._speed, along), (self.middle, self._span, across))
        )
        films = np.log([[_film(base, float(u), float(a)) for a in values] for u in speed])
        matrix = chebyshev.chebvander(along, SPEEDS - 1)
        other = chebyshev.chebvander(across, COEFFICIENTS - 1)
        self._terms = np.linalg.solve(matrix, films) @ np.linalg.inv(other).T

    def films(self, speeds: Array, coefficient: float) -> Array:
        """Films [m] at speeds (n,)."""
        u, a = self._places(speeds, coefficient)
        return np.exp(chebyshev.chebval2d(u, a, self._terms))

    def exponents(self, speeds: Array, coefficient: float) -> tuple[float, float]:
        """Mean exponents of speed and of coefficient in the film."""
        u, a = self._places(speeds, coefficient)
        slopes = [chebyshev.chebval2d(u, a, chebyshev.chebder(self._terms, axis=k)) for k in (0, 1)]
        return float(slopes[0].mean() / self._speed[1]), float(slopes[1].mean() / self._span)

    def _places(self, speeds: Array, coefficient: float) -> tuple[Array, Array]:
        u = (np.log(speeds) - self._speed[0]) / self._speed[1]
        return u, np.full_like(u, (math.log(coefficient) - self.middle) / self._span)


def fit_coefficient(settings: Settings, measured: Measured, points: int) -> Fit:
    """Fit the pressure-viscosity coefficient to central films over the mean velocity.

    The deviations are relative, weighted by relative errors where they are known.

    Raises
    ------
    InputError
        If the viscosity law of the case has no such coefficient, or for one measured point.
    EhlError
        If a contact has no solution, or the coefficient leaves the range of its key.
    """
    # importing scipy is slow
    from scipy.optimize import least_squares  # noqa: PLC0415

    law = settings["lubricant"]["viscosity_law"]
    if law not in LAWS:
        raise InputError(
            f"viscosity_law = {law}: no pressure-viscosity coefficient to fit\nexpected: one of "
            f"{', '.join(LAWS)}"
        )
    order = np.argsort(measured.places)
    speeds, films, error = (v[order] for v in (measured.places, measured.friction, measured.error))
    if speeds.size < 2:
        raise InputError("1 measured point for 1 parameter\nexpected: more points than parameters")
    weight = weights(error / films)
    base = _base(settings, points)
    ends = float(speeds[0]), float(speeds[-1])
    low, high = KEYS[f"lubricant.{KEY}"].interval[:2]

    def residuals(x: Array) -> Array:
        return weight * (table.films(speeds, math.exp(x[0])) / films - 1.0)

    guess = float(settings["lubricant"][KEY])
    for _ in range(TABLES):
        table = FilmTable(base, ends, guess)
        result = least_squares(residuals, [table.middle], xtol=1e-12, ftol=1e-12)
        guess = math.exp(float(result.x[0]))
        if not low < guess < high:
            break
        if abs(result.x[0] - table.middle) <= math.log(SPAN):
            break
        # beyond the table: repeat it around the coefficient that the mean film suggests
        ratio = float(np.exp(np.mean(np.log(films / table.films(speeds, math.exp(table.middle))))))
        guess = math.exp(table.middle) * ratio ** (1.0 / POWER)
    else:
        raise EhlError(f"the fit of {KEY} did not converge; the last value is {guess:.3g} 1/Pa")
    if not low < guess < high:
        raise EhlError(
            f"the fit of {KEY} ends at {guess:.3g} 1/Pa, where the range of the key ends: the data "
            "do not determine it"
        )
    ((bottom, top),) = intervals((KEY,), result.jac, result.fun, result.x)
    of_speed, of_coefficient = table.exponents(speeds, guess)
    notes = (
        f"exponents of the film: speed {of_speed:.2f}, {KEY} {of_coefficient:.2f}; a viscosity 10 "
        f"% too high makes {KEY} {1.0 - 1.1 ** (-of_speed / of_coefficient):.0%} too low",
        f"relative residual {np.sqrt(np.mean((table.films(speeds, guess) / films - 1.0) ** 2)):.1%}"
        " (rms)",
    )
    unit = KEYS[f"lubricant.{KEY}"].unit
    parameter = Parameter(KEY, unit, guess, bottom, top)
    fitted = table.films(speeds, guess)
    return Fit(
        "", (parameter,), speeds, films, error, fitted, points, measured.abscissa, "h_c_m", notes
    )


def _base(settings: Settings, points: int) -> dict[str, dict[str, object]]:
    """Give the common keys of the contacts, without those that the coefficient replaces."""
    groups = smooth_base(settings, points)
    groups["lubricant"] = {
        key: value
        for key, value in groups["lubricant"].items()
        if not key.startswith(DETERMINING) and key != "temperature"
    }
    groups["contact"]["slide_to_roll"] = settings["contact"]["slide_to_roll"]
    return groups


def _film(base: Settings, speed: float, coefficient: float) -> float:
    """Central film of a solved smooth contact [m], extrapolated if possible."""
    groups = {name: dict(group) for name, group in base.items()}
    groups["contact"]["mean_velocity"] = speed
    groups["lubricant"][KEY] = coefficient
    # the inlet at a low speed needs a finer grid
    points = int(groups["grid"]["points"])
    while True:
        groups["grid"]["points"] = points
        film, extrapolated, status = _solved(namelist.text_of(groups))
        points = 2 * points - 1
        if points > FINEST or extrapolated:
            break
    if not math.isfinite(film):
        raise EhlError(
            f"the smooth contact at {speed:.3g} m/s with {KEY} = {coefficient:.3g} 1/Pa: {status}"
        )
    return film


@lru_cache(maxsize=64)
def _solved(case: str) -> tuple[float, bool, str]:
    """Central film of a case [m], NaN for none, whether it is extrapolated, and the status."""
    text = resolve(case, "the contact of the fit")
    with SolverHandle(text) as solver:
        solver.run()
        summary = results_of(solver).values
    if summary["status"] != "converged":
        return math.nan, False, str(summary["status"])
    scale = OperatingPoint.from_settings(namelist.values(text)).film_scale
    film, _ = film_of(summary, "H_c")
    return float(film) * scale, summary.get("H_c_extrapolated") is not None, "converged"


SLIDE = "contact.slide_to_roll"
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

    Smooth contacts are solved for the friction at each slide-to-roll ratio, or for the central film
    over the mean velocity; the parameters are a least-squares fit with 95 % confidence intervals of
    the linearised model.

    Parameters
    ----------
    data
        CSV file with the columns ``contact.slide_to_roll``, ``mu`` and, if known, ``error``; or the
        file of a rig (`pyehl compare --measured`), of which the steps under the conditions of the
        case are used; repeats are averaged, with their scatter as error.
    case
        A case, or the path of a case file: the contact in SI units and its lubricant. Roughness
        is ignored.
    *options
        Values that replace those of the case, as for `Case`.
    law
        'eyring', 'limiting' (the limiting coefficient) or 'carreau'; '': that of the case, or
        'eyring' for a Newtonian case. 'pressure-viscosity': the coefficient from films of a rig
        over speed; default for a file with films only.
    between
        Minimum and maximum slide-to-roll ratio [-] or mean velocity [m/s] of the points of a rig to
        use; None: all.
    points
        Nodes along X of the contacts.
    output
        Result folder, as ``pyehl fit-lubricant -o`` writes it; None: no files are written.
    force
        Accept other files in the folder; they stay.

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
        result = fit_coefficient(settings, measured, points)
    else:
        result = fit_law(settings, law, measured, points)
    result = replace(result, notes=(*result.notes, *(f"left out: {why}" for why in left_out)))
    if place is not None:
        _write(result, place)
    return result


def _measured(
    path: str, settings: Settings, law: str, between: tuple[float, float] | None
) -> tuple[Measured, list[str]]:
    """Read the measured curve, and list omitted parts of the file."""
    left_out: list[str] = []
    if law == OF_FILM or is_rig(path):
        quantity, over = (FILM, SPEED) if law == OF_FILM else (FRICTION, SLIP)
        ends = between or (-math.inf, math.inf)
        measured, left_out = measured_curve(path, settings, quantity, over, ends)
    elif between is not None:
        raise InputError(f"{path}: between is for the file of a rig")
    else:
        measured = read_measured(path, SLIDE)
    if law == OF_FILM:
        return measured, left_out
    if (measured.abscissa, measured.ordinate) != (SLIDE, "mu"):
        raise InputError(
            f"{path}:1: error: the columns are {measured.abscissa} and {measured.ordinate}\n"
            f"expected: {SLIDE} and mu, and error, which may be missing"
        )
    if measured.places.max() > 2.0:
        raise InputError(f"{path}: error: {SLIDE} = {measured.places.max():g}\nexpected: at most 2")
    if measured.friction.min() <= 0.0:
        raise InputError(f"{path}: error: mu = {measured.friction.min():g}\nexpected: above 0")
    return measured, left_out


def _has_friction(path: str) -> bool:
    return any(FRICTION.name in step.columns for step in read_rig(path).steps)


def _write(fit: Fit, place: Destination) -> None:
    """Write tables, group, picture and summary, whole or not at all."""
    # importing matplotlib is slow
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
