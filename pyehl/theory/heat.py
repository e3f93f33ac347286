# SPDX-License-Identifier: BSD-3-Clause
"""Temperature: shear heating of the inlet, flash temperature.

The same formulas as in ``fortran/physics/heat.f90``, which the solver uses.
"""

from __future__ import annotations

import math

__all__ = ["flash_temperature", "thermal_loading", "thermal_reduction"]


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

    Gupta, Cheng, Zhu, Forster & Schrand 1992, Tribol. Trans. 35, 269, for a thermal loading, the
    Hertz pressure over E' and (u1 - u2)/u [-]. Not positive far outside its range.
    """
    sliding = 1.0 + 2.23 * abs(slide_to_roll) ** 0.83
    return (1.0 - 13.2 * pressure * loading**0.42) / (1.0 + 0.213 * sliding * loading**0.64)


def flash_temperature(
    flux: float,
    radius: float,
    speeds: tuple[float, float],
    conductivity: float,
    diffusivity: float,
) -> float:
    """Greatest temperature rise [K] of two surfaces of one material in a Hertz contact.

    Heat in a semi-ellipse over the circle: Tian & Kennedy 1994, J. Tribol. 116, 167, for one
    surface, 2.32 q a/(k sqrt(pi (1.234 + Pe))), Pe = u a/(2 kappa). The heat is shared so that
    both become as hot (Blok 1937). Mean heat flux q over the circle [W/m^2], Hertz radius a [m],
    speeds of the surfaces through the contact [m/s], k [W/(m K)] and kappa [m^2/s] of the solids.
    """
    roots = sum(
        math.sqrt(math.pi * (1.234 + abs(u) * radius / (2.0 * diffusivity))) for u in speeds
    )
    return 2.32 * flux * radius / (conductivity * roots)
