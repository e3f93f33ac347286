# SPDX-License-Identifier: BSD-3-Clause
"""Shear stress of the lubricant in the contact, for friction, and shear-thinning flow.

The laws are those of ``fortran/physics/shear.f90``, for the prediction. In a shear-thinning
lubricant a pressure gradient drives phi_x times the Newtonian flow along X, the direction of
sliding, and phi_y times along Y. ``fortran/physics/flow_factors.f90`` integrates these flow factors
across the film.
"""

import math
from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from pyehl import extension
from pyehl.errors import EhlError, InputError
from pyehl.types import Array, Settings

CODES = {"eyring": 1, "carreau": 2}
"""Laws of a shear-thinning flow, by their numbers in the library."""
LAWS = ("newtonian", "eyring", "limiting", "carreau")


@dataclass(frozen=True, slots=True)
class FlowFactors:
    """Flow factors of films and derivatives of phi_x, all of one shape [-]."""

    along: Array  # phi_x
    across: Array  # phi_y
    by_sliding: Array  # d ln(phi_x)/d ln(B)
    by_gradient: Array  # d ln(phi_x)/d ln(S)
    tangent: Array  # d(phi_x S_x)/dS_x


def flow_factors(
    law: str, exponent: float, sliding: ArrayLike, gradient: tuple[ArrayLike, ArrayLike]
) -> FlowFactors:
    """Return the flow factors of films for B and S = (S_x, S_y).

    Parameters
    ----------
    law, exponent
        One of `CODES`, and the exponent n of Carreau.
    sliding
        B = eta |u1 - u2|/h over the stress of the law, any shape [-].
    gradient
        S = h grad p over the stress of the law, along X and Y; broadcast to that shape [-].

    Raises
    ------
    EhlError
        If the iteration for the stress across a film fails.
    """
    b = np.asarray(sliding, dtype=float)
    s = np.empty((2, b.size), order="F")
    for i, part in enumerate(gradient):
        s[i] = np.broadcast_to(part, b.shape).ravel()
    result = np.empty((5, b.size), order="F")
    extension.lubricants.flow_factors(CODES[law], exponent, b.ravel().copy(), s, result)
    if not np.all(np.isfinite(result)):
        raise EhlError(f"no flow factors: the iteration for the stress by the law {law!r} failed")
    return FlowFactors(*(row.reshape(b.shape) for row in result))


def sliding_stress(law: str, exponent: float, sliding: ArrayLike) -> Array:
    """Stress over that of the law in films without a pressure gradient, for B of any shape [-].

    `law` and `exponent` as in `flow_factors`. NaN where the iteration fails.
    """
    b = np.asarray(sliding, dtype=float)
    stress = np.empty(b.size)
    extension.lubricants.sliding_stresses(CODES[law], exponent, b.ravel().copy(), stress)
    return stress.reshape(b.shape)


@dataclass(frozen=True, slots=True)
class ShearLaw:
    """A shear law with its parameters; those of other laws are not used.

    InputError for an unknown law or a number out of range.
    """

    law: str = "newtonian"  # one of :data:`LAWS`
    eyring_stress: float = 5e6  # tau_0 [Pa]
    limiting_stress: float = 0.0  # tau_L [Pa]; 0: `limiting_coefficient` times pressure
    limiting_coefficient: float = 0.06  # tau_L/p [-]
    # Carreau: stress G at which thinning begins [Pa], power-law exponent n [-]; no defaults
    carreau_stress: float = 0.0
    carreau_exponent: float = 0.0
    # Whether the flow also obeys the law: then Carreau's law has its stress form
    in_flow: bool = False

    def __post_init__(self) -> None:
        """Check the word and the numbers."""
        if self.law not in LAWS:
            raise InputError(f"shear_law {self.law!r}: expected one of {LAWS}")
        used = {
            "eyring": ("eyring_stress",),
            "limiting": ("limiting_coefficient",),
            "carreau": ("carreau_stress", "carreau_exponent"),
        }.get(self.law, ())
        if self.limiting_stress > 0.0:
            used = tuple(name for name in used if name != "limiting_coefficient")
        for name in used:
            number = getattr(self, name)
            if not (math.isfinite(number) and number > 0.0):
                raise InputError(f"{name} must be positive, not {number!r}")
        if not (math.isfinite(self.limiting_stress) and self.limiting_stress >= 0.0):
            raise InputError(f"limiting_stress must not be negative, not {self.limiting_stress!r}")
        if self.law == "carreau" and not 0.05 <= self.carreau_exponent <= 1.0:
            raise InputError(
                f"carreau_exponent must be in [0.05, 1], not {self.carreau_exponent!r}"
            )

    @classmethod
    def from_settings(cls, settings: Settings) -> Self:
        """From the group ``lubricant`` of a resolved case."""
        group = settings["lubricant"]
        names = cls.__dataclass_fields__.keys() - {"law", "in_flow"}
        given = {name: float(group[name]) for name in names if name in group}
        law = str(group["shear_law"])
        return cls(law, in_flow=law in CODES and group.get("flow") == "consistent", **given)

    @property
    def friction_matches_flow(self) -> bool:
        """Whether friction and flow obey the same law."""
        return self.law == "newtonian" or self.in_flow

    @property
    def scale(self) -> float:
        """Stress at which shear thinning of the flow begins [Pa]."""
        return self.eyring_stress if self.law == "eyring" else self.carreau_stress


def shear_stress(newtonian: ArrayLike, pressure: ArrayLike, law: ShearLaw) -> Array:
    """Shear stress tau [Pa] of the lubricant.

    Eyring: tau_0 asinh(tau_N/tau_0) (Johnson & Tevaarwerk 1977, Proc. R. Soc. A 356, 215).
    Limiting: tau_L (1 - exp(-tau_N/tau_L)) (Bair & Winer 1979, J. Lubr. Technol. 101, 258).
    Carreau: tau_N (1 + (tau_N/G)^2)^((n - 1)/2), single Newtonian plateau (Bair 2007,
    *High-Pressure Rheology for Quantitative Elastohydrodynamics*); where the flow obeys it,
    tau (1 + (tau/G)^2)^((1 - n)/2n) = tau_N.

    tau_N = eta |u1 - u2|/h [Pa], eta the viscosity at that pressure, of any shape; p [Pa],
    on which only the limiting law depends, broadcasts with it.
    """
    tau = np.asarray(newtonian, dtype=float)
    if law.law == "eyring":
        return np.asarray(law.eyring_stress * np.arcsinh(tau / law.eyring_stress))
    if law.law == "carreau" and law.in_flow:
        stress = law.carreau_stress
        return stress * sliding_stress(law.law, law.carreau_exponent, tau / stress)
    if law.law == "carreau":
        thinning = 1.0 + (tau / law.carreau_stress) ** 2
        return np.asarray(tau * thinning ** (0.5 * (law.carreau_exponent - 1.0)))
    if law.law == "limiting":
        if law.limiting_stress > 0.0:
            return np.asarray(-law.limiting_stress * np.expm1(-tau / law.limiting_stress))
        limit = law.limiting_coefficient * np.asarray(pressure, dtype=float)
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(limit > 0.0, -limit * np.expm1(-tau / limit), 0.0)
    return tau
