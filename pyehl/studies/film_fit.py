# SPDX-License-Identifier: BSD-3-Clause
"""Pressure-viscosity coefficient from measured film thickness over speed.

The film is that of solved smooth contacts, extrapolated from two grids, finer ones where need be.
It is tabulated over speed and coefficient; logarithms of films are nearly linear in both.
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from numpy.polynomial import chebyshev

from pyehl import namelist
from pyehl.case import KEYS, resolve
from pyehl.errors import EhlError, InputError
from pyehl.handle import SolverHandle, results_of
from pyehl.prediction.smooth import FINEST, film_of
from pyehl.studies.measured_friction import Measured
from pyehl.studies.shear_fit import Fit, Parameter, intervals, smooth_base, weights
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Array, Settings

KEY = "pressure_viscosity"
# Keys, and how keys begin, that determine the coefficient; the viscosity of the inlet is resolved
DETERMINING = KEY, "roelands_z", "name", "kinematic_", "vogel_", "dicke_", "inlet_law"
LAWS = ("roelands", "barus")
# Speeds and coefficients of the table, and the largest coefficient over the middle one
SPEEDS, COEFFICIENTS, SPAN = 5, 3, 1.5
# Power of the coefficient in the film, for the first guess (Hamrock & Dowson 1977)
POWER = 0.53
# Tables until one holds the coefficient in its range
TABLES = 6


class FilmTable:
    """Central film over speeds [m/s] and pressure-viscosity coefficients [1/Pa].

    Polynomials of Chebyshev in the logarithms through solved contacts at the zeros of the next one.
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

    def powers(self, speeds: Array, coefficient: float) -> tuple[float, float]:
        """Mean powers of speed and of coefficient in the film."""
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
    # it takes long to import
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

    def off(x: Array) -> Array:
        return weight * (table.films(speeds, math.exp(x[0])) / films - 1.0)

    guess = float(settings["lubricant"][KEY])
    for _ in range(TABLES):
        table = FilmTable(base, ends, guess)
        found = least_squares(off, [table.middle], xtol=1e-12, ftol=1e-12)
        guess = math.exp(float(found.x[0]))
        if not low < guess < high:
            break
        if abs(found.x[0] - table.middle) <= math.log(SPAN):
            break
        # the table does not reach there: once more, from where the film alone leads
        share = float(np.exp(np.mean(np.log(films / table.films(speeds, math.exp(table.middle))))))
        guess = math.exp(table.middle) * share ** (1.0 / POWER)
    else:
        raise EhlError(f"the fit of {KEY} did not settle; the last value is {guess:.3g} 1/Pa")
    if not low < guess < high:
        raise EhlError(
            f"the fit of {KEY} ends at {guess:.3g} 1/Pa, where the range of the key ends: the data "
            "do not determine it"
        )
    ((bottom, top),) = intervals((KEY,), found.jac, found.fun, found.x)
    of_speed, of_coefficient = table.powers(speeds, guess)
    notes = (
        f"film by powers: speed {of_speed:.2f}, {KEY} {of_coefficient:.2f}; a viscosity 10 % "
        f"too high makes {KEY} {1.0 - 1.1 ** (-of_speed / of_coefficient):.0%} too low",
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
    """Give what the contacts share; what a case gave in place of the coefficient is left out."""
    groups = smooth_base(settings, points)
    groups["lubricant"] = {
        key: value
        for key, value in groups["lubricant"].items()
        if not key.startswith(DETERMINING) and key != "temperature"
    }
    groups["contact"]["slide_to_roll"] = settings["contact"]["slide_to_roll"]
    return groups


def _film(base: Settings, speed: float, coefficient: float) -> float:
    """Central film of a solved smooth contact [m], extrapolated where that is possible."""
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
