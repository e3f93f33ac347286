# SPDX-License-Identifier: BSD-3-Clause
"""Viscosity and density of a lubricant under pressure."""

import math
from dataclasses import dataclass, field
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from pyehl.case import resolve
from pyehl.errors import InputError, check
from pyehl.extension import lubricants
from pyehl.given import positive
from pyehl.namelist import text_of, values
from pyehl.theory.shear import ShearLaw
from pyehl.types import Array, Settings

# Density under pressure p: (P + F p)/(P + p), P [Pa], F [-] (Dowson & Higginson 1966)
DENSITY_PRESSURE = 5.9e8
DENSITY_FACTOR = 1.34
# Laws of which all parameters are attributes; the others need `constants`
SIMPLE_VISCOSITY = ("roelands", "barus")
SIMPLE_DENSITY = ("dowson-higginson", "incompressible")
# 0 degC, and the temperature at which Roelands' viscosity is infinite [K]
ZERO_CELSIUS = 273.15
ROELANDS_TEMPERATURE = 138.0
# Temperature of `density_15` [degC]
DENSITY_TEMPERATURE = 15.0


def default_roelands_z(
    viscosity: float, pressure_viscosity: float, roelands_p0: float = 1.96e8
) -> float:
    """Roelands exponent z = alpha p0 / (ln eta0 + 9.67) [-].

    It makes d(ln eta)/dp at ambient pressure equal to alpha [1/Pa], for eta0 [Pa s] and p0 [Pa].
    InputError if the viscosity is not positive, or so low that ln eta0 + 9.67 <= 0, where the law
    has no meaning.
    """
    denominator = math.log(positive("viscosity", viscosity, "Pa s")) + 9.67
    if denominator <= 0.0:
        raise InputError(
            f"viscosity {viscosity!r} Pa s is below exp(-9.67) Pa s, the lowest of the Roelands "
            "law; is the unit Pa s?"
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
        alpha [1/Pa]; 0: the viscosity does not change with pressure.
    viscosity_law
        ``"roelands"`` or ``"barus"``; from a case also ``"dicke"``, ``"yasutomi"``,
        ``"doolittle"`` or ``"table"``.
    roelands_z
        Exponent [-]; 0 for the value of :func:`default_roelands_z`.
    roelands_p0
        [Pa].
    density_law
        ``"dowson-higginson"`` or ``"incompressible"``; from a case also ``"murnaghan"`` or
        ``"tait"``.
    shear
        Law of the shear stress in the contact, for friction.
    temperature
        Temperature of the inlet, for which `viscosity` holds [degC].
    temperature_viscosity
        beta = -(d eta/dT)/eta at ambient pressure and the temperature of the inlet [1/K].
    thermal_expansion
        -(d rho/dT) over the density rho at 15 degC [1/K]; ``"tait"`` has its own among the
        constants.
    range_temperature_min, range_temperature_max, range_pressure_max
        Range in which the constants of the law were measured [degC, Pa]; all 0: not known.
    constants
        The group ``lubricant`` of a resolved case as text, for laws with constants of an oil.

    Raises
    ------
    InputError
        For an unknown law, or a viscosity, alpha, p0 or z out of range.

    Examples
    --------
    >>> import pyehl
    >>> oil = pyehl.Lubricant(viscosity=0.04, pressure_viscosity=2.2e-8)
    >>> round(float(oil.log_viscosity_ratio(1e9)), 2), round(float(oil.density_ratio(1e9)), 3)
    (15.16, 1.214)
    >>> fva3 = pyehl.Lubricant.from_name("fva3", temperature=40.0)
    >>> round(fva3.viscosity, 4), round(float(fva3.log_viscosity_ratio(1e9)), 2)
    (0.0845, 16.34)
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
    range_temperature_min: float = 0.0
    range_temperature_max: float = 0.0
    range_pressure_max: float = 0.0
    constants: str = ""

    def __post_init__(self) -> None:
        """Check the words and the numbers."""
        positive("viscosity", self.viscosity, "Pa s")
        if self.pressure_viscosity != 0.0:
            positive("pressure_viscosity", self.pressure_viscosity, "1/Pa")
        positive("roelands_p0", self.roelands_p0, "Pa")
        if self.viscosity_law not in SIMPLE_VISCOSITY and not self.constants:
            raise InputError(
                f"viscosity_law {self.viscosity_law!r}: expected 'roelands' or 'barus', or "
                "Lubricant.from_settings and a case with the constants of another law"
            )
        if self.density_law not in SIMPLE_DENSITY and not self.constants:
            raise InputError(
                f"density_law {self.density_law!r}: expected 'dowson-higginson' or "
                "'incompressible', or Lubricant.from_settings and a case with the constants of "
                "another law"
            )
        if self.roelands_z == 0.0 and self.viscosity_law == "roelands":
            z = default_roelands_z(self.viscosity, self.pressure_viscosity, self.roelands_p0)
            object.__setattr__(self, "roelands_z", z)
        if self.viscosity_law == "roelands" and self.pressure_viscosity > 0.0:
            positive("roelands_z", self.roelands_z, "-")

    @classmethod
    def from_settings(cls, settings: Settings, viscosity_law: str = "") -> Self:
        """From the group ``lubricant`` of a resolved case; `viscosity_law` overrides the law."""
        group = settings["lubricant"]
        given = {name: group[name] for name in cls.__dataclass_fields__ if name in group}
        given["viscosity_law"] = viscosity_law or group["viscosity_law"]
        laws = given["viscosity_law"], given.get("density_law", "incompressible")
        if laws[0] not in SIMPLE_VISCOSITY or laws[1] not in SIMPLE_DENSITY:
            given["constants"] = text_of(
                {"lubricant": {**group, "viscosity_law": given["viscosity_law"]}}
            )
        return cls(shear=ShearLaw.from_settings(settings), **given)

    @classmethod
    def from_name(cls, name: str, temperature: float = 40.0) -> Self:
        """Return an oil of :func:`pyehl.lubricants` at a temperature of the inlet [degC].

        InputError for an unknown name, with the known ones, or a temperature out of range.
        """
        group = text_of({"lubricant": {"name": name, "temperature": float(temperature)}})
        return cls.from_settings(values(resolve(group, "the lubricant")))

    def log_viscosity_ratio(self, pressure: ArrayLike, rise: ArrayLike = 0.0) -> Array:
        """ln(eta/eta0) [-] at a pressure [Pa] and a temperature increase T' [K], any shapes.

        T' is relative to the temperature T0 of the inlet. NaN below -p0 (Roelands).

        Barus 1893: alpha p - beta T'; Roelands 1966: A ((1 + p/p0)^z (1 + T'/(T0 - 138 K))^-S0 - 1)
        with A = alpha p0/z, S0 = beta (T0 - 138 K)/A, or -beta T' if alpha is 0. The other laws are
        those of the solver.
        """
        p, warmer = np.asarray(pressure, dtype=float), np.asarray(rise, dtype=float)
        if self.viscosity_law not in SIMPLE_VISCOSITY:
            return self._compiled(p, warmer)[0]
        if self.viscosity_law == "barus" or self.pressure_viscosity == 0.0:
            return np.asarray(self.pressure_viscosity * p - self.temperature_viscosity * warmer)
        factor = self.pressure_viscosity * self.roelands_p0 / self.roelands_z
        above = self.temperature + ZERO_CELSIUS - ROELANDS_TEMPERATURE
        s0 = self.temperature_viscosity * above / factor
        with np.errstate(invalid="ignore", divide="ignore"):
            # in place: a prediction spends much of its time here
            power = np.asarray(p / self.roelands_p0)
            power += 1.0
            np.log(power, out=power)
            power *= self.roelands_z
            np.exp(power, out=power)
            if warmer.ndim > 0 or warmer.any():
                power = np.asarray(power * np.exp(-s0 * np.log(1.0 + warmer / above)))
        power -= 1.0
        power *= factor
        return power

    def viscosity_ratio(self, pressure: ArrayLike, rise: ArrayLike = 0.0) -> Array:
        """eta/eta0 [-] at a pressure [Pa] and a temperature increase [K], any shapes."""
        result = self.log_viscosity_ratio(pressure, rise)
        return np.exp(result, out=result)[()]

    def density_ratio(self, pressure: ArrayLike, rise: ArrayLike = 0.0) -> Array:
        """rho/rho0 [-] at a pressure [Pa] and a temperature increase [K], any shapes.

        Dowson & Higginson 1966 under pressure, or incompressible, and linear in temperature. The
        other laws are those of the solver.
        """
        p, warmer = np.asarray(pressure, dtype=float), np.asarray(rise, dtype=float)
        if self.density_law not in SIMPLE_DENSITY:
            return self._compiled(p, warmer)[1]
        expansion = self.thermal_expansion
        inlet = 1.0 - expansion * (self.temperature - DENSITY_TEMPERATURE)
        expanded = 1.0 - expansion / inlet * warmer
        if self.density_law == "incompressible":
            return np.ones_like(p) * expanded
        return np.asarray(
            (DENSITY_PRESSURE + DENSITY_FACTOR * p) / (DENSITY_PRESSURE + p) * expanded
        )

    def beyond(self, pressure: float) -> str:
        """Name conditions outside the range of the constants at a pressure [Pa]; '' if none is."""
        low, high = self.range_temperature_min, self.range_temperature_max
        words = ""
        if low < high and not low <= self.temperature <= high:
            words = f"; the lubricant was measured from {low:g} to {high:g} degC"
        maximum = self.range_pressure_max
        if 0.0 < maximum < pressure and self.constants:
            words += f"; the lubricant was measured up to {maximum:.3g} Pa"
        return words

    def _compiled(self, pressure: Array, rise: Array) -> tuple[Array, Array]:
        """ln(eta/eta0) and rho/rho0 by the laws of the solver."""
        p, warmer = (np.array(a) for a in np.broadcast_arrays(pressure, rise))
        log_viscosity, density = np.empty(p.size), np.empty(p.size)
        places = p.ravel(), warmer.ravel()
        check(*lubricants.properties(self.constants.encode(), *places, log_viscosity, density))
        return log_viscosity.reshape(p.shape), density.reshape(p.shape)
