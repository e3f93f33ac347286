# SPDX-License-Identifier: BSD-3-Clause
"""Film thickness formulas of point contacts, with their ranges and accuracies."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from pyehl.theory.lubricant import Lubricant
from pyehl.theory.moes_film import nijenbanning_venner_moes, regime
from pyehl.theory.operating import OperatingPoint

__all__ = [
    "FilmEstimate",
    "brewe",
    "central_film",
    "chittenden",
    "de_vicente",
    "estimates",
    "hamrock_dowson",
    "hamrock_dowson_soft",
    "nijenbanning_venner_moes",
    "outside",
]

# Conditions of the numerical cases of the Hamrock-Dowson formulas (J. Lubr. Technol. 99,
# 1977, 264): 34 cases, speed by a factor of 30, load by one of 10, bronze to silicon nitride.
HAMROCK_DOWSON_RANGE = {
    "U": (1.68e-12, 5.05e-11),
    "W": (1.10e-7, 1.11e-6),
    "G": (2.3e3, 6.8e3),
    "ellipticity": (1.0, 8.0),
}
# Conditions over which the other formulas were compared with converged solutions of the solver
BREWE_RANGE = {"M": (0.0, 2.0), "R_x/R_y": (0.03, 1.0)}
SOFT_RANGE = {"M": (8.0, 2000.0), "L": (0.0, 0.05)}
# U of de Vicente et al.; at fixed M their exponents leave a dependence U^-0.005
DE_VICENTE_RANGE = {"U": (1e-12, 1e-7), **SOFT_RANGE}
# its exponents do not give one curve over M, as they should: h_c and h_min differ by 6 and 2 % per
# decade of U; on longer ellipses h_min is 10 to 15 % low
HAMROCK_DOWSON_SOFT_RANGE = {"U": (1e-9, 1e-7), **SOFT_RANGE, "R_x/R_y": (0.8, 1.0)}
# Relative tolerance of the bounds, for rounding
ROUNDING = 1e-12
# Conditions over which the asymptotic formula was compared with converged solutions of the solver
NIJENBANNING_RANGE = {"M": (20.0, 2000.0), "L": (5.0, 15.0), "R_x/R_y": (0.0, 1.0)}


@dataclass(frozen=True, slots=True)
class FilmEstimate:
    """Films by one formula.

    Attributes
    ----------
    name, source
        The formula and its publication.
    regime
        Regime of the formula, as :func:`pyehl.theory.moes_film.regime` names it; '' for all.
    h_c, h_min
        Central and minimum film thickness [m]; NaN where the formula gives none.
    applies
        Whether the contact is in that regime, or between it and another.
    bounds
        Its range: minimum and maximum values of conditions.
    outside
        Conditions outside the range of the formula, in words; empty when inside.
    note
        Its accuracy, empty for an ellipse, for which it is hardly known; of a starved inlet, how
        the film follows from the flooded one.
    """

    name: str
    source: str
    regime: str
    h_c: float
    h_min: float
    applies: bool
    bounds: Mapping[str, tuple[float, float]]
    outside: tuple[str, ...]
    note: str


def hamrock_dowson(
    speed: float, material: float, load_number: float, ellipticity: float = 1.0
) -> tuple[float, float]:
    """h_c/R_x and h_min/R_x [-], from U, G, W2 as in `OperatingPoint`.

    Hamrock & Dowson 1977, J. Lubr. Technol. 99, 264-276; `ellipticity` is the semi-axis across the
    motion over that along it; they approximate it by 1.03 (R_y/R_x)^0.64.
    """
    side_c, side_min = math.exp(-0.73 * ellipticity), math.exp(-0.68 * ellipticity)
    h_c = 2.69 * speed**0.67 * material**0.53 * load_number**-0.067 * (1 - 0.61 * side_c)
    h_min = 3.63 * speed**0.68 * material**0.49 * load_number**-0.073 * (1 - side_min)
    return h_c, h_min


def chittenden(speed: float, material: float, load_number: float) -> tuple[float, float]:
    """h_c/R and h_min/R [-] of a circular contact, from U, G, W2 as in `OperatingPoint`.

    Chittenden, Dowson, Dunn & Taylor 1985, Proc. R. Soc. Lond. A 397, 245-269 and 271-294.
    """
    common = speed**0.68 * material**0.49 * load_number**-0.073
    return 4.31 * common * (1 - math.exp(-1.23)), 3.68 * common * (1 - math.exp(-0.67))


def brewe(speed: float, load_number: float, radius_ratio: float = 1.0) -> float:
    """h_c/R_x = h_min/R_x [-] of rigid bodies with constant viscosity, from U and W2.

    Brewe, Hamrock & Taylor 1979, J. Lubr. Technol. 101, 231-239; `radius_ratio` is R_x/R_y.
    """
    across = 1.0 / radius_ratio
    side_flow = 1.0 / (1.0 + 2.0 / (3.0 * across))
    shape = 0.131 * math.atan(across / 2.0) + 1.683
    return 128.0 * across * side_flow**2 * shape**2 * (speed / load_number) ** 2


def hamrock_dowson_soft(
    speed: float, load_number: float, ellipticity: float = 1.0
) -> tuple[float, float]:
    """h_c/R_x and h_min/R_x [-] of soft bodies with constant viscosity, from U and W2.

    Hamrock & Dowson 1978, J. Lubr. Technol. 100, 236-245. h_min agrees with the regime formula of
    textbooks, 8.70 g_E^0.67 (1 - 0.85 exp(-0.31 k)) (U/W)^2, within 1.2 % at U = 1e-8. The
    constants of h_c are quoted and were not checked against another source. `ellipticity` as in
    `hamrock_dowson`.
    """
    side_c, side_min = math.exp(-0.28 * ellipticity), math.exp(-0.31 * ellipticity)
    h_c = 7.32 * (1 - 0.72 * side_c) * speed**0.64 * load_number**-0.22
    h_min = 7.43 * (1 - 0.85 * side_min) * speed**0.65 * load_number**-0.21
    return h_c, h_min


def de_vicente(speed: float, load_number: float) -> float:
    """h_c/R [-] of a circular contact of soft bodies with constant viscosity, from U and W2.

    de Vicente, Stokes & Spikes 2005, Tribol. Lett. 20, 273-286: quoted, and checked only against
    converged solutions (docs/howto/soft.md).
    """
    return 3.3 * speed**0.6 * load_number**-0.14


def central_film(operating: OperatingPoint, lubricant: Lubricant) -> float:
    """Central film thickness h_c [m]: Nijenbanning-Venner-Moes divided by rho(p_h)/rho0.

    Within 0.8 % of converged solutions for 500 <= M <= 2000, 5 <= L <= 15; up to 4 % below those of
    flooded contacts for 20 <= M <= 200 (docs/evidence/validation).
    """
    h = nijenbanning_venner_moes(operating.moes_m, operating.moes_l, operating.ellipse)
    return h * operating.film_scale / float(lubricant.density_ratio(operating.density_pressure))


def outside(
    values: Mapping[str, float], bounds: Mapping[str, tuple[float, float]]
) -> tuple[str, ...]:
    """List the values outside their bounds, in words; empty when none is."""
    return tuple(
        f"{name} = {values[name]:.4g} outside {low:g} ... {high:g}"
        for name, (low, high) in bounds.items()
        if not low * (1.0 - ROUNDING) <= values[name] <= high * (1.0 + ROUNDING)
    )


def estimates(operating: OperatingPoint, lubricant: Lubricant) -> list[FilmEstimate]:
    """Return all formulas at an operating point, the best one of its regime first.

    A formula with alpha as a factor is omitted where alpha is 0; those of Chittenden et al. and of
    de Vicente et al. are for circles only.
    """
    u, g, w = operating.speed, operating.material, operating.load_number
    shape = operating.ellipse
    values = {"U": u, "G": g, "W": w, "M": operating.moes_m, "L": operating.moes_l}
    values |= {"ellipticity": shape.ellipticity, "R_x/R_y": shape.radius_ratio}
    here = regime(operating.moes_m, operating.moes_l, shape)
    circle = shape.radius_ratio == 1.0
    result: list[FilmEstimate] = []

    def in_metres(films: tuple[float, float]) -> tuple[float, float]:
        return films[0] * operating.radius, films[1] * operating.radius

    def add(
        name: str,
        source: str,
        of: str,
        films: tuple[float, float],
        bounds: Mapping[str, tuple[float, float]],
        note: str,
    ) -> None:
        h_c, h_min = films
        beyond = outside(values, bounds)
        result.append(
            FilmEstimate(
                name=name,
                source=source,
                regime=of,
                h_c=h_c,
                h_min=h_min,
                applies=_applies(of, here),
                bounds=bounds,
                outside=beyond,
                # the accuracies are known for circles
                note=note if circle else "",
            )
        )

    add(
        "Nijenbanning-Venner-Moes",
        "Wear 176 (1994) 217, divided by rho(p_h)/rho0",
        "",
        (central_film(operating, lubricant), math.nan),
        NIJENBANNING_RANGE,
        "within 0.8 % of converged solutions for M = 500-2000; down to M = 20 up to 4 % low; "
        "at L = 0 up to 10 % high, with rigid bodies 17 % and between the regimes 38 %",
    )
    if g > 0.0:
        add(
            "Hamrock-Dowson",
            "J. Lubr. Technol. 99 (1977) 264",
            "elastic-piezoviscous",
            in_metres(hamrock_dowson(u, g, w, shape.ellipticity)),
            HAMROCK_DOWSON_RANGE,
            "at M = 1000, L = 10: h_c 8 % too high, h_min 76 % too high",
        )
        if circle:
            add(
                "Chittenden et al.",
                "Proc. R. Soc. A 397 (1985) 245",
                "elastic-piezoviscous",
                in_metres(chittenden(u, g, w)),
                HAMROCK_DOWSON_RANGE,
                "range taken as that of Hamrock-Dowson; h_min as inaccurate",
            )
    add(
        "Brewe-Hamrock-Taylor",
        "J. Lubr. Technol. 101 (1979) 231",
        "rigid-isoviscous",
        in_metres((brewe(u, w, shape.radius_ratio),) * 2),
        BREWE_RANGE,
        "1 to 3 % below converged solutions at L = 0; at L = 10, 2 % for M = 1 and 8 % for M = 2",
    )
    if circle:
        add(
            "de Vicente et al.",
            "Tribol. Lett. 20 (2005) 273",
            "elastic-isoviscous",
            in_metres((de_vicente(u, w), math.nan)),
            DE_VICENTE_RANGE,
            "4 to 9 % above converged solutions at L = 0 and U = 8e-12, 1.2 % less per decade of U",
        )
    add(
        "Hamrock-Dowson soft",
        "J. Lubr. Technol. 100 (1978) 236",
        "elastic-isoviscous",
        in_metres(hamrock_dowson_soft(u, w, shape.ellipticity)),
        HAMROCK_DOWSON_SOFT_RANGE,
        "h_min within 4 % of converged solutions at L = 0 and M = 8-1000, 10 % high at M = 2000; "
        "h_c up to 23 % off",
    )
    # an isoviscous formula precedes the one for all regimes only within its range
    isoviscous = here.endswith("-isoviscous")
    return sorted(result, key=lambda f: (not f.applies, isoviscous and _rank(f)))


def _rank(formula: FilmEstimate) -> int:
    if not formula.regime:
        return 1
    return 2 if formula.outside else 0


def _applies(of: str, here: str) -> bool:
    """Whether a formula for the regime `of`, '' for all, covers a contact in the regime `here`."""
    if not of:
        return True
    softness, viscosity = of.split("-")
    return here.endswith(f"-{viscosity}") and softness in here
