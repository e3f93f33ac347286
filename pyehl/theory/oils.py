# SPDX-License-Identifier: BSD-3-Clause
"""Oils by name; pressure-viscosity coefficients alpha* and alpha_film of any lubricant."""

import math
from dataclasses import dataclass, fields

import numpy as np

from pyehl.case.oils import OILS, Constant, OilConstants
from pyehl.errors import InputError, did_you_mean
from pyehl.theory.lubricant import Lubricant

__all__ = ["Constant", "Oil", "film_forming", "known_oils", "oil", "reciprocal_isoviscous"]

# Upper limit [Pa] and number of nodes of the integrals over pressure
HIGHEST_PRESSURE, NODES = 1e10, 20001


@dataclass(frozen=True, slots=True)
class Oil(OilConstants):
    """An oil whose constants are known: ``lubricant.name`` of a case."""

    def constant(self, key: str) -> float | None:
        """Return the value of a constant, None where the source has none."""
        return next((c.value for c in self.constants if c.key == key), None)

    @property
    def measured(self) -> tuple[float, float, float]:
        """Range of the measurements: temperatures [degC], maximum pressure [Pa]; inf: not known."""
        keys = ("range_temperature_min", "range_temperature_max", "range_pressure_max")
        result = [self.constant(key) for key in keys]
        ends = (-math.inf, math.inf, math.inf)
        low, high, pressure = (e if f is None else f for f, e in zip(result, ends, strict=True))
        return low, high, pressure

    def at(self, temperature: float) -> Lubricant:
        """Return the lubricant at a temperature of the inlet [degC]."""
        return Lubricant.from_name(self.name, temperature)


def known_oils() -> dict[str, Oil]:
    """Return all oils by name."""
    names = [field.name for field in fields(OilConstants)]
    return {oil.name: Oil(*(getattr(oil, name) for name in names)) for oil in OILS.values()}


def oil(name: str) -> Oil:
    """Return an oil by its name; InputError for an unknown name, with the nearest known one."""
    oils = known_oils()
    if name not in oils:
        raise InputError(
            f"lubricant '{name}' is not known{did_you_mean(name, oils)}\nexpected: one of "
            f"{', '.join(oils)}; any other oil by its constants, or by a table of measured values"
        )
    return oils[name]


def _integral(lubricant: Lubricant, end: float) -> float:
    """Integrate eta0/eta from ambient pressure to a higher one [Pa]."""
    # nodes are dense at low pressures, where the integrand is large
    p = end * np.linspace(0.0, 1.0, NODES) ** 3
    return float(np.trapezoid(np.exp(-lubricant.log_viscosity_ratio(p)), p))


def reciprocal_isoviscous(lubricant: Lubricant) -> float:
    """Reciprocal asymptotic isoviscous pressure alpha* [1/Pa].

    1/alpha* is the integral of eta0/eta over pressure (Blok 1963), here up to 10 GPa.
    """
    return 1.0 / _integral(lubricant, HIGHEST_PRESSURE)


def film_forming(lubricant: Lubricant) -> float:
    """Film-forming coefficient alpha_film [1/Pa] of Bair, Liu & Wang 2006 (J. Tribol. 128, 624).

    (1 - exp(-3)) over the integral of eta0/eta up to the pressure 3/alpha*.
    """
    return -math.expm1(-3.0) / _integral(lubricant, 3.0 / reciprocal_isoviscous(lubricant))
