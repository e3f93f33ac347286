# SPDX-License-Identifier: BSD-3-Clause
"""Parameters of a shear law from a measured traction curve.

Smooth contacts with the law are solved at each slide-to-roll ratio. The search starts from the best
fit of the law over film and pressure of the smooth contact of the case.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pyehl import namelist, schema
from pyehl.case import KEYS, resolve
from pyehl.case.duty import refuse_duty
from pyehl.contact.smooth import SmoothContact, solve_contact, without_surface
from pyehl.destination import check_files, check_name
from pyehl.errors import EhlError, InputError
from pyehl.given import path_of
from pyehl.handle import SolverHandle, results_of
from pyehl.studies.measured_friction import Measured
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.oils import Oil, known_oils, oil
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.shear import ShearLaw, shear_stress
from pyehl.types import Array, Settings

if TYPE_CHECKING:
    from scipy.optimize import OptimizeResult


def lubricants(
    *names: str, temperature: float = 40.0, output: str | os.PathLike[str] | None = None
) -> dict[str, Oil]:
    """Give the oils of `lubricant.name`, and draw them if a folder is given.

    Parameters
    ----------
    *names
        Names of oils; none: all.
    temperature
        Temperature of the pictures, with two more above it [degC].
    output
        Folder for the pictures, made if it is missing; None: nothing is drawn.

    Returns
    -------
    dict
        Oils by name: ``title``, ``source``, ``range`` of the measurements, ``constants`` with their
        places in the source, and ``at(temperature)``, a :class:`pyehl.Lubricant`.

    Raises
    ------
    InputError
        For an unknown name, with the nearest one; a temperature out of range; another file with the
        name of a picture.
    FileError
        If a picture cannot be written.

    Examples
    --------
    >>> import pyehl
    >>> sorted(pyehl.lubricants())
    ['fva3', 'n100', 'pao100']
    >>> oil = pyehl.lubricants("fva3")["fva3"]
    >>> oil.title, f"{oil.at(40.0).pressure_viscosity:.3g}"
    ('FVA reference oil 3, mineral, ISO VG 100', '2.24e-08')
    """
    chosen = {name: oil(name) for name in names or known_oils()}
    at = {name: oil.at(temperature) for name, oil in chosen.items()}
    if output is None:
        return chosen
    folder = Path(path_of(output, "output"))
    check_name(folder)
    if folder.exists() and not folder.is_dir():
        raise InputError(f"{folder}: error: this is not a folder\nexpected: a folder for pictures")
    # importing matplotlib is slow
    from pyehl.plots.folder import made  # noqa: PLC0415
    from pyehl.plots.lubricant import draw_oil  # noqa: PLC0415
    from pyehl.plots.style import save  # noqa: PLC0415

    place = made(folder)
    paths = {name: place / f"{name}.png" for name in chosen}
    check_files(paths.values(), "lubricants")
    for name, those in chosen.items():
        limit = those.constant("limiting_coefficient")
        figure = draw_oil(f"{name}: {those.title}", at[name], those.measured, limit)
        save(figure, paths[name], command="lubricants")
    return chosen


# Parameters of each law that is fitted, keys of &lubricant
PARAMETERS = {
    "eyring": ("eyring_stress",),
    "limiting": ("limiting_coefficient",),
    "carreau": ("carreau_stress", "carreau_exponent"),
}
# Start of the search
START = {
    "eyring_stress": 5e6,
    "limiting_coefficient": 0.06,
    "carreau_stress": 5e6,
    "carreau_exponent": 0.5,
}
# Step of parameters (of the exponent, of logarithms of the others) for the derivatives, whose
# effect is far above the algebraic error of the contacts; change at which the search ends
STEP, TOLERANCE = 0.03, 1e-4
CONFIDENCE = 0.95


@dataclass(frozen=True, slots=True)
class Parameter:
    """A fitted parameter: key, unit, value, and the ends of its confidence interval."""

    key: str
    unit: str
    value: float
    low: float
    high: float


@dataclass(frozen=True, slots=True)
class Fit:
    """Parameters of a lubricant and the measured curve of the fit."""

    law: str  # the shear law, or '' for the pressure-viscosity coefficient
    parameters: tuple[Parameter, ...]
    places: Array  # values of the key `over`, ascending (n,)
    measured: Array  # measured values of `quantity` (n,)
    error: Array  # their errors, zeros if none are given (n,)
    fitted: Array  # fitted values of `quantity` (n,)
    points: int  # nodes along X of the contacts
    over: str = "contact.slide_to_roll"  # key that was varied
    quantity: str = "mu"  # result that was measured
    notes: tuple[str, ...] = ()  # remarks on the fit

    @property
    def residual_rms(self) -> float:
        """Root mean square of fitted minus measured values [their unit]."""
        return float(np.sqrt(np.mean((self.fitted - self.measured) ** 2)))

    @property
    def summary(self) -> dict[str, Any]:
        """Content of ``summary.json``."""
        return {
            "kind": "fit",
            "schema_version": schema.VERSION,
            **({"shear_law": self.law} if self.law else {"fitted": self.parameters[0].key}),
            "residual_rms": self.residual_rms,
            "points": self.points,
        }

    @property
    def group(self) -> str:
        """The parameters as ``&lubricant`` to paste into a case."""
        values: dict[str, Any] = {"shear_law": self.law} if self.law else {}
        values |= {p.key: float(f"{p.value:.6g}") for p in self.parameters}
        return namelist.text_of({"lubricant": values})


def fit_law(settings: Settings, law: str, measured: Measured, points: int) -> Fit:
    """Fit a law, one of :data:`PARAMETERS`, to measured friction over the slide-to-roll ratio.

    InputError for too few points; EhlError if a contact has no solution, or no fit is found.
    """
    # importing scipy is slow
    from scipy.optimize import least_squares  # noqa: PLC0415

    keys = PARAMETERS[law]
    order = np.argsort(measured.places)
    srr, mu, error = (v[order] for v in (measured.places, measured.friction, measured.error))
    if srr.size <= len(keys):
        raise InputError(
            f"{srr.size} measured points for {len(keys)} parameters of '{law}'\nexpected: more "
            "points than parameters"
        )
    weight = weights(error)
    base = smooth_base(settings, points)
    model = _Model(settings, law)
    limits = np.array([_limits(key) for key in keys])
    lower, upper = _to_search(keys, limits[:, 0]), _to_search(keys, limits[:, 1])
    first = _to_search(keys, np.array([START[key] for key in keys]))

    def search(friction: Callable[[Array], Array], start: Array) -> OptimizeResult:
        return least_squares(
            lambda x: weight * (friction(_to_values(keys, x)) - mu),
            start,
            bounds=(lower, upper),
            x_scale="jac",
            diff_step=STEP / np.maximum(np.abs(start), STEP),
            xtol=TOLERANCE,
            ftol=TOLERANCE,
            gtol=None,
        )

    def solved(values: Array) -> Array:
        return np.array([_friction(base, law, keys, values, float(s)) for s in srr])

    begin = search(lambda values: model.friction(values, srr), first)
    settled = search(solved, begin.x)
    if not settled.success:
        raise EhlError(f"the fit of '{law}' did not settle: {settled.message}")
    values = _to_values(keys, settled.x)
    if settled.active_mask.any():
        listed = ", ".join(f"{k} = {v:.4g}" for k, v in zip(keys, values, strict=True))
        raise EhlError(
            f"the fit of '{law}' ends at {listed}, where the range of the key ends: the data do "
            "not determine it"
        )
    ends = intervals(keys, settled.jac, settled.fun, settled.x)
    units = {key.name.partition(".")[2]: key.unit for key in KEYS.values()}
    parameters = tuple(
        Parameter(key, units[key], float(value), *end)
        for key, value, end in zip(keys, values, ends, strict=True)
    )
    return Fit(law, parameters, srr, mu, error, settled.fun / weight + mu, points)


def weights(error: Array) -> Array:
    """Weights of measured points by their errors (n,); InputError if only some errors are 0.

    If all are 0, the errors are not known.
    """
    if not error.any():
        return np.ones_like(error)
    if not (error > 0.0).all():
        raise InputError(
            f"an error of {error.min():g} of measured friction\nexpected: errors above 0, or 0 for "
            "all where none is known"
        )
    return np.asarray(1.0 / error)


def _limits(key: str) -> tuple[float, float]:
    """Give the ends of the interval that a key allows besides 0."""
    return KEYS[f"lubricant.{key}"].interval[:2]


def _to_search(keys: tuple[str, ...], values: Array) -> Array:
    """Transform parameters for the search: logarithms of all but the exponent."""
    linear = np.array(keys) == "carreau_exponent"
    return np.where(linear, values, np.log(values))


def _to_values(keys: tuple[str, ...], transformed: Array) -> Array:
    """Undo `_to_search`."""
    linear = np.array(keys) == "carreau_exponent"
    return np.where(linear, transformed, np.exp(np.where(linear, 0.0, transformed)))


def intervals(
    keys: tuple[str, ...], jacobian: Array, residuals: Array, transformed: Array
) -> list[tuple[float, float]]:
    """Compute the ends of the confidence intervals; infinite if the data determine nothing.

    Parameters, Jacobian and residuals of the search, see `_to_search`.
    """
    from scipy.stats import t  # noqa: PLC0415

    free = residuals.size - transformed.size
    values, vectors = np.linalg.eigh(jacobian.T @ jacobian)
    if values[0] <= 1e-12 * max(values[-1], 1e-300):
        return [(-np.inf, np.inf)] * transformed.size
    covariance = (vectors / values) @ vectors.T * float(residuals @ residuals) / free
    width = t.ppf(0.5 + 0.5 * CONFIDENCE, free) * np.sqrt(np.diag(covariance))
    low, high = (_to_values(keys, transformed + sign * width) for sign in (-1.0, 1.0))
    return [(float(a), float(b)) for a, b in zip(low, high, strict=True)]


class _Model:
    """Friction by a law over film and pressure of the smooth contact of the case."""

    def __init__(self, settings: Settings, law: str) -> None:
        self.law = law
        operating = OperatingPoint.from_settings(settings)
        contact: SmoothContact = solve_contact(settings)
        oil = Lubricant.from_settings(settings)
        self.pressure = operating.hertz_pressure * contact.pressure
        film = operating.film_scale * contact.film
        self.rate = oil.viscosity * oil.viscosity_ratio(self.pressure) / film
        cell = (contact.x[1] - contact.x[0]) * (contact.y[1] - contact.y[0])
        self.area = float(cell) * operating.hertz_radius**2 / operating.load
        self.velocity = operating.mean_velocity

    def friction(self, values: Array, slide_to_roll: Array) -> Array:
        """Coefficients of friction (n,) at slide-to-roll ratios."""
        law = ShearLaw(self.law, **dict(zip(PARAMETERS[self.law], values, strict=True)))
        return np.array(
            [
                self.area * shear_stress(s * self.velocity * self.rate, self.pressure, law).sum()
                for s in slide_to_roll
            ]
        )


def smooth_base(settings: Settings, points: int) -> dict[str, dict[str, Any]]:
    """Give the common keys of the contacts: groups of a case without sliding and shear law."""
    refuse_duty(settings)
    groups = without_surface(settings)
    for key in ("slide_to_roll", "rough_surface"):
        groups["contact"].pop(key, None)
    for key in ("limiting_stress", "limiting_coefficient"):
        groups["lubricant"].pop(key, None)
    groups["grid"]["points"] = points
    return groups


def _friction(
    base: Settings, law: str, keys: tuple[str, ...], values: Array, slide_to_roll: float
) -> float:
    """Coefficient of friction of a solved smooth contact."""
    groups = {name: dict(group) for name, group in base.items()}
    groups["contact"]["slide_to_roll"] = slide_to_roll
    groups["lubricant"] |= {"shear_law": law} | dict(zip(keys, map(float, values), strict=True))
    text = resolve(namelist.text_of(groups), "the contact of the fit")
    with SolverHandle(text) as solver:
        solver.run()
        summary = results_of(solver).values
    if summary["status"] != "converged" or summary["mu"] is None:
        listed = ", ".join(f"{k} = {v:.4g}" for k, v in zip(keys, values, strict=True))
        raise EhlError(
            f"the smooth contact at a slide-to-roll ratio of {slide_to_roll:g} with {listed}: "
            f"{summary['status']}"
        )
    return float(summary["mu"])
