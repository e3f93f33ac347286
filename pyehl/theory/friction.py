# SPDX-License-Identifier: BSD-3-Clause
"""Coefficient of friction from the friction ratio, where it is known, and temperature increases."""

import math
from typing import Any

from pyehl.reasons import NO_SIZE, OF_ROUGH, VANISHING, above_limit
from pyehl.theory.heat import Heat, flash_temperature
from pyehl.theory.line_contact import AnyContact
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.shear import shear_stress


def absolute_friction(
    operating: AnyContact,
    lubricant: Lubricant,
    film: float,
    mu_smooth: float,
    mu_ratio: float,
    heat: Heat | None = None,
) -> dict[str, Any]:
    """Coefficients of friction and the related entries of ``summary.json``.

    `film` is the central film h_c [m], used for the whole contact; `mu_smooth` the coefficient of
    the smooth contact at the slide-to-roll ratio and `mu_ratio` the friction over it [-], both
    isothermal; `heat` the effect of frictional heating on the smooth contact, used for the rough
    one, too, or on the rough contact: then ``mu_smooth`` is not known. Returns ``mu`` and
    ``mu_smooth``, both also isothermal, temperature increases, ``shear_rate_mean_per_s``,
    ``shear_stress_max_Pa`` (of the smooth contact) and ``flash_temperature_K``, each NaN where it
    is not known, and ``mu_note``: the reason or the caveat. A Newtonian coefficient is given where
    the stress does not exceed the Eyring stress.
    """
    heat = heat or Heat()
    speed, law = operating.sliding_speed, lubricant.shear
    nothing = math.nan
    rate = stress = rise = nothing
    smooth = nothing
    if not operating.si:
        note = NO_SIZE
    elif speed == 0.0:
        note = f"{VANISHING}; 'pyehl run' has the rolling moment"
    else:
        rate = speed / film
        p = operating.hertz_pressure
        newtonian = lubricant.viscosity * float(lubricant.viscosity_ratio(p)) * rate
        stress = float(shear_stress(newtonian, p, law))
        if law.law != "newtonian" or stress <= law.eyring_stress:
            smooth, note = mu_smooth, heat.note
        elif math.isnan(stress):
            note = "the film of the smooth contact is not known"
        else:
            note = above_limit(stress, law.eyring_stress)
    mu = mu_ratio * smooth * heat.ratio
    if heat.rough and math.isfinite(smooth):
        note = f"{note}; {OF_ROUGH}"
    rises = heat.rises if math.isfinite(mu) else Heat().rises
    if math.isfinite(mu):
        u, srr, a = operating.mean_velocity, operating.slide_to_roll, operating.hertz_radius
        rise = flash_temperature(
            mu * operating.load * speed / operating.dry_area,
            a,
            (u * (1.0 + 0.5 * srr), u * (1.0 - 0.5 * srr)),
            operating.thermal_conductivities,
            operating.thermal_diffusivities,
            operating.ellipse.potential,
        )
    return {
        "mu": mu,
        "mu_smooth": nothing if heat.rough else smooth * heat.ratio,
        "mu_isothermal": mu_ratio * smooth,
        "mu_smooth_isothermal": smooth,
        "temperature_rise_max_K": rises[0],
        "temperature_rise_wall_1_max_K": rises[1],
        "temperature_rise_wall_2_max_K": rises[2],
        "shear_rate_mean_per_s": rate,
        "shear_stress_max_Pa": stress,
        "flash_temperature_K": rise,
        "mu_note": note,
    }
