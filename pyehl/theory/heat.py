# SPDX-License-Identifier: BSD-3-Clause
"""Temperature: shear heating of the inlet, flash temperature.

The formulas are those of ``fortran/physics/heat.f90``, which the solver uses. Only the solver
computes the temperature of the film.
"""

import math
from dataclasses import dataclass

# Exponent of `potential` in `flash_temperature`, as in ``fortran/physics/heat.f90``
NARROW = 0.38


@dataclass(frozen=True, slots=True)
class Heat:
    """Effect of frictional heating on the friction of a contact."""

    ratio: float = 1.0  # friction with heating over isothermal friction [-]; NaN: not known
    # Maximum temperature increases [K]: mean across the film, surfaces of body 1 and of body 2
    rises: tuple[float, float, float] = (math.nan, math.nan, math.nan)
    note: str = "isothermal"  # how heating enters the coefficient of friction, in words
    rough: bool = False  # whether it is for the rough contact, not for the smooth one


def thermal_loading(
    coefficient: float, viscosity: float, velocity: float, conductivity: float
) -> float:
    """Thermal loading beta eta0 u^2/k [-].

    beta = -(d eta/dT)/eta [1/K], eta0 [Pa s], mean velocity u [m/s], thermal conductivity k of the
    oil [W/(m K)].
    """
    return coefficient * viscosity * velocity**2 / conductivity


def thermal_reduction(loading: float, pressure: float, slide_to_roll: float) -> float:
    """Film with shear heating of the inlet over the isothermal one [-].

    Gupta, Cheng, Zhu, Forster & Schrand 1992, Tribol. Trans. 35, 269, from the thermal loading, the
    Hertz pressure over E' and (u1 - u2)/u [-]. Not positive far outside its range.
    """
    sliding = 1.0 + 2.23 * abs(slide_to_roll) ** 0.83
    return (1.0 - 13.2 * pressure * loading**0.42) / (1.0 + 0.213 * sliding * loading**0.64)


def flash_temperature(
    flux: float,
    half: float,
    speeds: tuple[float, float],
    conductivity: tuple[float, float],
    diffusivity: tuple[float, float],
    potential: float = 1.0,
) -> float:
    """Maximum temperature increase [K] of two surfaces in a Hertz contact.

    Semi-elliptical heat flux: for one surface and a circle 2.32 q a/(k sqrt(pi (1.234 + Pe))),
    Pe = u a/(2 kappa) (Tian & Kennedy 1994, J. Tribol. 116, 167). For an ellipse 1.234 is divided
    by the square of `potential`, which is exact for a stationary surface; in a narrow one, where
    heat also flows across the motion, (1.234^m + Pe^m)^(1/m) with m = potential^0.38 replaces the
    sum. The heat is divided so that both surfaces become equally hot (Blok 1937). Mean heat flux q
    over the contact [W/m^2], half its length a along the motion [m], speeds of the surfaces through
    the contact [m/s], k [W/(m K)] and kappa [m^2/s] of the solids; `potential` as
    :attr:`pyehl.theory.ellipse.Ellipse.potential` [-].
    """
    stationary, power = 1.234 / potential**2, min(1.0, potential**NARROW)
    roots = 0.0
    for u, k, kappa in zip(speeds, conductivity, diffusivity, strict=True):
        peclet = abs(u) * half / (2.0 * kappa)
        roots += k * math.sqrt(math.pi * (stationary**power + peclet**power) ** (1.0 / power))
    return 2.32 * flux * half / roots
