# SPDX-License-Identifier: BSD-3-Clause
"""Operating conditions of a point contact, in SI units and in Moes and Hertz numbers.

The reduced modulus E' follows 2/E' = sum over the bodies of (1 - nu^2)/E, as everywhere in this
package. Codes that use 1/E* = sum of (1 - nu^2)/E have E* = E'/2: a factor of two.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["Lubricant", "OperatingPoint", "default_roelands_z"]

Array = NDArray[np.float64]

# Contact body of the reference conditions (Zhang et al. 2019, table 1). A case given by M and L
# alone has no length; these two fix one when a quantity in SI units is asked for.
REFERENCE_RADIUS = 0.018
REFERENCE_MODULUS = 2.26e11

# Dowson & Higginson 1966, density under pressure
DENSITY_PRESSURE = 5.9e8
DENSITY_FACTOR = 1.34


def _positive(name: str, value: float, unit: str) -> float:
    value = float(value)
    if not (math.isfinite(value) and value > 0.0):
        raise ValueError(f"{name} must be a positive number [{unit}], not {value!r}")
    return value


def default_roelands_z(
    viscosity: float, pressure_viscosity: float, roelands_p0: float = 1.96e8
) -> float:
    """Roelands exponent z = alpha p0 / (ln eta0 + 9.67) [-].

    It makes d(ln eta)/dp at ambient pressure equal to alpha.

    Parameters
    ----------
    viscosity
        Viscosity at ambient pressure eta0 [Pa s].
    pressure_viscosity
        Pressure-viscosity coefficient alpha [1/Pa].
    roelands_p0
        Roelands pressure p0 [Pa].

    Raises
    ------
    ValueError
        If the viscosity is so low that ln eta0 + 9.67 <= 0, where the law has no meaning.
    """
    denominator = math.log(_positive("viscosity", viscosity, "Pa s")) + 9.67
    if denominator <= 0.0:
        raise ValueError(
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

    Raises
    ------
    ValueError
        For an unknown law or a number out of range.
    """

    viscosity: float = 0.04
    pressure_viscosity: float = 2.2e-8
    viscosity_law: str = "roelands"
    roelands_z: float = 0.0
    roelands_p0: float = 1.96e8
    density_law: str = "dowson-higginson"

    def __post_init__(self) -> None:
        """Check the words and the numbers."""
        _positive("viscosity", self.viscosity, "Pa s")
        _positive("pressure_viscosity", self.pressure_viscosity, "1/Pa")
        _positive("roelands_p0", self.roelands_p0, "Pa")
        if self.viscosity_law not in ("roelands", "barus"):
            raise ValueError(
                f"viscosity_law {self.viscosity_law!r}: expected 'roelands' or 'barus'"
            )
        if self.density_law not in ("dowson-higginson", "incompressible"):
            raise ValueError(
                f"density_law {self.density_law!r}: expected 'dowson-higginson' or 'incompressible'"
            )
        if self.roelands_z == 0.0 and self.viscosity_law == "roelands":
            z = default_roelands_z(self.viscosity, self.pressure_viscosity, self.roelands_p0)
            object.__setattr__(self, "roelands_z", z)
        if self.viscosity_law == "roelands":
            _positive("roelands_z", self.roelands_z, "-")

    @classmethod
    def from_settings(
        cls, settings: Mapping[str, Mapping[str, Any]], viscosity_law: str = ""
    ) -> Lubricant:
        """From the group ``lubricant`` of a resolved case; `viscosity_law` overrides the law."""
        group = settings["lubricant"]
        return cls(
            viscosity=float(group["viscosity"]),
            pressure_viscosity=float(group["pressure_viscosity"]),
            viscosity_law=viscosity_law or str(group["viscosity_law"]),
            roelands_z=float(group.get("roelands_z", 0.0)),
            roelands_p0=float(group["roelands_p0"]),
            density_law=str(group["density_law"]),
        )

    def log_viscosity_ratio(self, pressure: ArrayLike) -> Array:
        """ln(eta/eta0) [-] at a pressure [Pa], any shape; NaN below -p0 (Roelands).

        Roelands 1966: (alpha p0/z) ((1 + p/p0)^z - 1); Barus 1893: alpha p.
        """
        p = np.asarray(pressure, dtype=float)
        if self.viscosity_law == "barus":
            return np.asarray(self.pressure_viscosity * p)
        factor = self.pressure_viscosity * self.roelands_p0 / self.roelands_z
        with np.errstate(invalid="ignore", divide="ignore"):
            power = np.exp(self.roelands_z * np.log(1.0 + p / self.roelands_p0))
        return np.asarray(factor * (power - 1.0))

    def viscosity_ratio(self, pressure: ArrayLike) -> Array:
        """eta/eta0 [-] at a pressure [Pa], any shape."""
        return np.exp(self.log_viscosity_ratio(pressure))

    def density_ratio(self, pressure: ArrayLike) -> Array:
        """rho/rho0 [-] at a pressure [Pa], any shape (Dowson & Higginson 1966)."""
        p = np.asarray(pressure, dtype=float)
        if self.density_law == "incompressible":
            return np.ones_like(p)
        return np.asarray((DENSITY_PRESSURE + DENSITY_FACTOR * p) / (DENSITY_PRESSURE + p))


@dataclass(frozen=True, slots=True)
class OperatingPoint:
    """A circular contact under load, with what follows from it.

    Attributes
    ----------
    load
        w [N].
    mean_velocity
        (u1 + u2)/2 [m/s].
    radius
        Reduced radius R [m].
    reduced_modulus
        E' [Pa], 2/E' = sum of (1 - nu^2)/E.
    viscosity
        eta0 [Pa s].
    pressure_viscosity
        alpha [1/Pa]; 0 for the isoviscous limit L = 0.
    si
        Whether the SI values were given; False when they were made from (M, L) with the radius
        and modulus of the reference conditions.

    Raises
    ------
    ValueError
        For a number that is not positive or not finite.
    """

    load: float = 600.0
    mean_velocity: float = 0.84
    radius: float = REFERENCE_RADIUS
    reduced_modulus: float = REFERENCE_MODULUS
    viscosity: float = 0.04
    pressure_viscosity: float = 2.2e-8
    si: bool = True

    def __post_init__(self) -> None:
        """Check the numbers."""
        _positive("load", self.load, "N")
        _positive("mean_velocity", self.mean_velocity, "m/s")
        _positive("radius", self.radius, "m")
        _positive("reduced_modulus", self.reduced_modulus, "Pa")
        _positive("viscosity", self.viscosity, "Pa s")
        if not (math.isfinite(self.pressure_viscosity) and self.pressure_viscosity >= 0.0):
            raise ValueError(
                f"pressure_viscosity must not be negative [1/Pa], not {self.pressure_viscosity!r}"
            )

    @classmethod
    def from_moes(
        cls,
        moes_m: float,
        moes_l: float,
        *,
        viscosity: float = 0.04,
        pressure_viscosity: float = 2.2e-8,
        radius: float = REFERENCE_RADIUS,
    ) -> OperatingPoint:
        """Return the contact that has the given M and L, for a lubricant and a radius [m].

        Two numbers leave two lengths and a stress free: the radius, eta0 and alpha are given, E'
        is the reference modulus. The Hertz pressure p_h = alpha_bar/alpha follows from M, L and
        alpha alone.

        Raises
        ------
        ValueError
            For M or L that is not positive (L = 0 fixes no speed in SI units).
        """
        m = _positive("moes_m", moes_m, "-")
        ell = _positive("moes_l", moes_l, "-")
        modulus = REFERENCE_MODULUS
        two_u = (ell / (pressure_viscosity * modulus)) ** 4
        return cls(
            load=m * two_u**0.75 * modulus * radius**2,
            mean_velocity=0.5 * two_u * modulus * radius / viscosity,
            radius=radius,
            reduced_modulus=modulus,
            viscosity=viscosity,
            pressure_viscosity=pressure_viscosity,
            si=False,
        )

    @classmethod
    def from_settings(cls, settings: Mapping[str, Mapping[str, Any]]) -> OperatingPoint:
        """From the groups ``contact`` and ``lubricant`` of a resolved case (either kind)."""
        contact, lubricant = settings["contact"], settings["lubricant"]
        viscosity = float(lubricant["viscosity"])
        alpha = float(lubricant["pressure_viscosity"])
        if contact.get("moes_m") is not None and contact.get("load") is None:
            return cls.from_moes(
                float(contact["moes_m"]),
                float(contact["moes_l"]),
                viscosity=viscosity,
                pressure_viscosity=alpha,
            )
        return cls(
            load=float(contact["load"]),
            mean_velocity=float(contact["mean_velocity"]),
            radius=float(contact["radius"]),
            reduced_modulus=float(contact["reduced_modulus"]),
            viscosity=viscosity,
            pressure_viscosity=alpha,
        )

    @property
    def hertz_radius(self) -> float:
        """Radius a of the dry contact [m], a^3 = 3 w R/(2 E')."""
        return float((1.5 * self.load * self.radius / self.reduced_modulus) ** (1.0 / 3.0))

    @property
    def hertz_pressure(self) -> float:
        """Maximum pressure p_h of the dry contact [Pa], 3 w/(2 pi a^2)."""
        return 1.5 * self.load / (math.pi * self.hertz_radius**2)

    @property
    def speed(self) -> float:
        """U = eta0 u/(E' R) [-]."""
        return self.viscosity * self.mean_velocity / (self.reduced_modulus * self.radius)

    @property
    def load_number(self) -> float:
        """W2 = w/(E' R^2) [-]."""
        return self.load / (self.reduced_modulus * self.radius**2)

    @property
    def material(self) -> float:
        """G = alpha E' [-]."""
        return self.pressure_viscosity * self.reduced_modulus

    @property
    def moes_m(self) -> float:
        """Moes load M = W2 (2U)^(-3/4) [-] of a point contact (a line has W (2U)^(-1/2))."""
        return float(self.load_number * (2.0 * self.speed) ** -0.75)

    @property
    def moes_l(self) -> float:
        """Moes material number L = G (2U)^(1/4) [-]."""
        return float(self.material * (2.0 * self.speed) ** 0.25)

    @property
    def alpha_bar(self) -> float:
        """Pressure-viscosity number alpha p_h = (L/pi)(3M/2)^(1/3) [-]."""
        return self.pressure_viscosity * self.hertz_pressure

    @property
    def speed_parameter(self) -> float:
        """lambda_bar = 12 eta0 u R^2/(a^3 p_h) = (128 pi^3/(3 M^4))^(1/3) [-]."""
        return (
            12.0
            * self.viscosity
            * self.mean_velocity
            * self.radius**2
            / (self.hertz_radius**3 * self.hertz_pressure)
        )

    @property
    def film_scale(self) -> float:
        """The film thickness that is one in Hertz units, a^2/R [m]; H = h R/a^2."""
        return self.hertz_radius**2 / self.radius

    @property
    def time_scale(self) -> float:
        """The time that is one in Hertz units, a/u [s]; T = t u/a."""
        return self.hertz_radius / self.mean_velocity
