# SPDX-License-Identifier: BSD-3-Clause
"""Film thickness formulas."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

from pyehl.theory.lubricant import Lubricant
from pyehl.theory.moes_film import inlet_viscosity_ratio, nijenbanning_venner_moes
from pyehl.theory.operating import OperatingPoint

__all__ = [
    "FilmEstimate",
    "central_film",
    "chittenden",
    "circle_with_same_inlet",
    "estimates",
    "hamrock_dowson",
    "nijenbanning_venner_moes",
    "outside",
]

# Conditions of the numerical cases behind the Hamrock-Dowson formulas (J. Lubr. Technol. 99,
# 1977, 264): 34 cases, speed over nearly two decades, load over one, bronze to silicon nitride.
HAMROCK_DOWSON_RANGE = {
    "U": (1.68e-12, 5.05e-11),
    "W": (1.10e-7, 1.11e-6),
    "G": (2.3e3, 6.8e3),
    "ellipticity": (1.0, 8.0),
}
# Conditions over which the asymptotic formula was compared with converged solutions here
NIJENBANNING_RANGE = {"M": (20.0, 2000.0), "L": (5.0, 15.0), "R_x/R_y": (0.0, 1.0)}


@dataclass(frozen=True, slots=True)
class FilmEstimate:
    """What one formula gives.

    Attributes
    ----------
    name, source
        The formula and where it is from.
    h_c, h_min
        Central and minimum film thickness [m]; NaN where the formula gives none.
    outside
        Conditions outside the range of the formula, in words; empty when inside.
    note
        What is known of its accuracy; empty for an ellipse, where little is.
    """

    name: str
    source: str
    h_c: float
    h_min: float
    outside: tuple[str, ...]
    note: str


def hamrock_dowson(
    speed: float, material: float, load_number: float, ellipticity: float = 1.0
) -> tuple[float, float]:
    """h_c/R_x and h_min/R_x [-], from U, G, W2 as `OperatingPoint` has them.

    Hamrock & Dowson 1977, J. Lubr. Technol. 99, 264-276; `ellipticity` is the semi-axis across the
    motion over that along it, for which they have 1.03 (R_y/R_x)^0.64.
    """
    side_c, side_min = math.exp(-0.73 * ellipticity), math.exp(-0.68 * ellipticity)
    h_c = 2.69 * speed**0.67 * material**0.53 * load_number**-0.067 * (1 - 0.61 * side_c)
    h_min = 3.63 * speed**0.68 * material**0.49 * load_number**-0.073 * (1 - side_min)
    return h_c, h_min


def chittenden(speed: float, material: float, load_number: float) -> tuple[float, float]:
    """h_c/R and h_min/R [-] of a circular contact, from U, G, W2 as `OperatingPoint` has them.

    Chittenden, Dowson, Dunn & Taylor 1985, Proc. R. Soc. Lond. A 397, 245-269 and 271-294.
    """
    common = speed**0.68 * material**0.49 * load_number**-0.073
    return 4.31 * common * (1 - math.exp(-1.23)), 3.68 * common * (1 - math.exp(-0.67))


def central_film(operating: OperatingPoint, lubricant: Lubricant) -> float:
    """Central film thickness h_c [m]: Nijenbanning-Venner-Moes over rho(p_h)/rho0.

    Within 0.8 % of converged solutions for 500 <= M <= 2000, 5 <= L <= 15; up to 4 % below those of
    flooded contacts for 20 <= M <= 200 (docs/evidence/validation).
    """
    h = nijenbanning_venner_moes(operating.moes_m, operating.moes_l, operating.ellipse)
    return h * operating.film_scale / float(lubricant.density_ratio(operating.hertz_pressure))


def circle_with_same_inlet(
    operating: OperatingPoint, lubricant: Lubricant, film: float
) -> tuple[float, float]:
    """M and L [-] of the circular contact whose inlet makes of waves what this one makes of them.

    Of equal alpha_bar and, with heights by which the stiffness of waves is the same, of equal
    central film H_c = `film` [a^2/R_x]: what flows off to the sides of an ellipse acts as a lower
    viscosity (docs/evidence/ellipse). Of a circle its own, whatever its film.
    """
    moes_m, moes_l = operating.equivalent_moes
    if operating.radius_ratio == 1.0:
        return moes_m, moes_l
    here = film / operating.ellipse.kernel_ratio
    density = float(lubricant.density_ratio(operating.hertz_pressure))
    share = here * density / nijenbanning_venner_moes(moes_m, moes_l)
    ratio = inlet_viscosity_ratio(moes_m, moes_l, share)
    return moes_m * ratio**-0.75, moes_l * ratio**0.25


def outside(
    values: Mapping[str, float], bounds: Mapping[str, tuple[float, float]]
) -> tuple[str, ...]:
    """Say which values lie outside of their bounds, in words; empty when none does."""
    return tuple(
        f"{name} = {values[name]:.4g} outside {low:g} ... {high:g}"
        for name, (low, high) in bounds.items()
        if not low <= values[name] <= high
    )


def estimates(operating: OperatingPoint, lubricant: Lubricant) -> list[FilmEstimate]:
    """All formulas at an operating point."""
    point = (operating.speed, operating.material, operating.load_number)
    ugw = dict(zip(("U", "G", "W"), point, strict=True))
    shape = operating.ellipse
    ml = {"M": operating.moes_m, "L": operating.moes_l, "R_x/R_y": shape.radius_ratio}
    radius = operating.radius
    hd_outside = outside(ugw | {"ellipticity": shape.ellipticity}, HAMROCK_DOWSON_RANGE)
    hd = hamrock_dowson(*point, shape.ellipticity)
    ch = chittenden(*point)
    formulas = [
        FilmEstimate(
            "Nijenbanning-Venner-Moes",
            "Wear 176 (1994) 217, divided by rho(p_h)/rho0",
            central_film(operating, lubricant),
            math.nan,
            outside(ml, NIJENBANNING_RANGE),
            "within 0.8 % of converged solutions for M = 500-2000; down to M = 20 up to 4 % low",
        ),
        FilmEstimate(
            "Hamrock-Dowson",
            "J. Lubr. Technol. 99 (1977) 264",
            hd[0] * radius,
            hd[1] * radius,
            hd_outside,
            "at M = 1000, L = 10: h_c 8 % too high, h_min 76 % too high",
        ),
        FilmEstimate(
            "Chittenden et al.",
            "Proc. R. Soc. A 397 (1985) 245",
            ch[0] * radius,
            ch[1] * radius,
            hd_outside,
            "range taken as that of Hamrock-Dowson; h_min as far off",
        ),
    ]
    # the last one, and how good they are, is known here for circles alone
    if shape.radius_ratio == 1.0:
        return formulas
    return [replace(formula, note="") for formula in formulas[:-1]]
