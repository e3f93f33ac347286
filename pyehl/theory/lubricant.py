# SPDX-License-Identifier: BSD-3-Clause
"""Viscosity and density of a lubricant under pressure."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pyehl.errors import InputError
from pyehl.given import positive
from pyehl.theory.shear import ShearLaw

__all__ = ["Lubricant", "default_roelands_z"]

Array = NDArray[np.float64]

# Dowson & Higginson 1966, density under pressure
DENSITY_PRESSURE = 5.9e8
DENSITY_FACTOR = 1.34
# 0 degC, and the temperature at which Roelands' viscosity is infinite [K]
FREEZING = 273.15
ROELANDS_TEMPERATURE = 138.0


def default_roelands_z(
    viscosity: float, pressure_viscosity: float, roelands_p0: float = 1.96e8
) -> float:
    """Roelands exponent z = alpha p0 / (ln eta0 + 9.67) [-].

    It makes d(ln eta)/dp at ambient pressure equal to alpha [1/Pa], for eta0 [Pa s] and p0 [Pa].
    InputError if the viscosity is so low that ln eta0 + 9.67 <= 0, where the law has no meaning.
    """
    denominator = math.log(positive("viscosity", viscosity, "Pa s")) + 9.67
    if denominator <= 0.0:
        raise InputError(
            f"viscosity {viscosity!r} Pa s is below exp(-9.67) Pa s, the lowest the Roelands law "
            "knows; is the unit Pa s?"
        )
    return pressure_viscosity * roelands_p0 / denominator


@dataclass(frozen=True, slots=True)
class Lubricant:
    """Viscosity and density of a lubricant under pressure.

    Attributes
    ----------
    viscosity
        At ambient pressure, eta0 [Pa s].
    pressure_viscosity
        alpha [1/Pa].
    viscosity_law
        ``"roelands"`` or ``"barus"``.
    roelands_z
        Exponent [-]; 0 for the value of :func:`default_roelands_z`.
    roelands_p0
        [Pa].
    density_law
        ``"dowson-higginson"`` or ``"incompressible"``.
    shear
        Shear stress in the contact, for friction.
    temperature
        Of the inlet, to which `viscosity` belongs [degC].
    temperature_viscosity
        beta = -(d eta/dT)/eta at ambient pressure and the temperature of the inlet [1/K].
    thermal_expansion
        Relative fall of the density with temperature [1/K].

    Raises
    ------
    InputError
        For an unknown law or a number out of range.

    Examples
    --------
    >>> import pyehl
    >>> oil = pyehl.Lubricant(viscosity=0.04, pressure_viscosity=2.2e-8)
    >>> round(float(oil.log_viscosity_ratio(1e9)), 2), round(float(oil.density_ratio(1e9)), 3)
    (15.16, 1.214)
    """

    viscosity: float = 0.04
    pressure_viscosity: float = 2.2e-8
    viscosity_law: str = "roelands"
    roelands_z: float = 0.0
    roelands_p0: float = 1.96e8
    density_law: str = "dowson-higginson"
    shear: ShearLaw = field(default_factory=ShearLaw)
    temperature: float = 40.0
    temperature_viscosity: float = 0.0
    thermal_expansion: float = 6.5e-4

    def __post_init__(self) -> None:
        """Check the words and the numbers."""
        positive("viscosity", self.viscosity, "Pa s")
        positive("pressure_viscosity", self.pressure_viscosity, "1/Pa")
        positive("roelands_p0", self.roelands_p0, "Pa")
        if self.viscosity_law not in ("roelands", "barus"):
            raise InputError(
                f"viscosity_law {self.viscosity_law!r}: expected 'roelands' or 'barus'"
            )
        if self.density_law not in ("dowson-higginson", "incompressible"):
            raise InputError(
                f"density_law {self.density_law!r}: expected 'dowson-higginson' or 'incompressible'"
            )
        if self.roelands_z == 0.0 and self.viscosity_law == "roelands":
            z = default_roelands_z(self.viscosity, self.pressure_viscosity, self.roelands_p0)
            object.__setattr__(self, "roelands_z", z)
        if self.viscosity_law == "roelands":
            positive("roelands_z", self.roelands_z, "-")

    @classmethod
    def from_settings(
        cls, settings: Mapping[str, Mapping[str, Any]], viscosity_law: str = ""
    ) -> Lubricant:
        """From the group ``lubricant`` of a resolved case; `viscosity_law` overrides the law."""
        group = settings["lubricant"]
        given = {name: group[name] for name in cls.__dataclass_fields__ if name in group}
        given["viscosity_law"] = viscosity_law or group["viscosity_law"]
        return cls(shear=ShearLaw.from_settings(settings), **given)

    def log_viscosity_ratio(self, pressure: ArrayLike, rise: ArrayLike = 0.0) -> Array:
        """ln(eta/eta0) [-] at a pressure [Pa] and a rise of temperature [K], any shapes.

        The rise is that over the temperature of the inlet. NaN below -p0 (Roelands).

        Barus 1893: alpha p - beta T'; Roelands 1966: A ((1 + p/p0)^z (1 + T'/(T0 - 138 K))^-S0 - 1)
        with A = alpha p0/z, S0 = beta (T0 - 138 K)/A and the rise T'.
        """
        p, warmer = np.asarray(pressure, dtype=float), np.asarray(rise, dtype=float)
        if self.viscosity_law == "barus":
            return np.asarray(self.pressure_viscosity * p - self.temperature_viscosity * warmer)
        factor = self.pressure_viscosity * self.roelands_p0 / self.roelands_z
        above = self.temperature + FREEZING - ROELANDS_TEMPERATURE
        s0 = self.temperature_viscosity * above / factor
        with np.errstate(invalid="ignore", divide="ignore"):
            power = np.exp(self.roelands_z * np.log(1.0 + p / self.roelands_p0))
            power = power * np.exp(-s0 * np.log(1.0 + warmer / above))
        return np.asarray(factor * (power - 1.0))

    def viscosity_ratio(self, pressure: ArrayLike, rise: ArrayLike = 0.0) -> Array:
        """eta/eta0 [-] at a pressure [Pa] and a rise of temperature [K], any shapes."""
        return np.exp(self.log_viscosity_ratio(pressure, rise))

    def density_ratio(self, pressure: ArrayLike, rise: ArrayLike = 0.0) -> Array:
        """rho/rho0 [-] at a pressure [Pa] and a rise of temperature [K], any shapes.

        Dowson & Higginson 1966 under pressure, linear with temperature.
        """
        p, warmer = np.asarray(pressure, dtype=float), np.asarray(rise, dtype=float)
        thinner = 1.0 - self.thermal_expansion * warmer
        if self.density_law == "incompressible":
            return np.ones_like(p) * thinner
        return np.asarray(
            (DENSITY_PRESSURE + DENSITY_FACTOR * p) / (DENSITY_PRESSURE + p) * thinner
        )
