# SPDX-License-Identifier: BSD-3-Clause
"""Central film of a point contact in Moes numbers, and the inlet viscosity for a given film."""

import math
from typing import NamedTuple

from pyehl.errors import InputError
from pyehl.theory.ellipse import Ellipse, ellipse

CIRCLE = ellipse(1.0)
# Two asymptotes within this ratio count as a transition between regimes
ALIKE = 1.25


class _Asymptotes(NamedTuple):
    """Moes film numbers h/R (2U)^(-1/2) of the asymptotes [-]."""

    rigid_iso: float
    elastic_iso: float
    rigid_piezo: float
    elastic_piezo: float


def _asymptotes(moes_m: float, moes_l: float, shape: Ellipse) -> _Asymptotes:
    if not (moes_m > 0.0 and moes_l >= 0.0):
        raise InputError(f"need M > 0 and L >= 0, not M = {moes_m:g}, L = {moes_l:g}")
    d = shape.radius_ratio
    elastic = 1.0 + 0.006 * math.log(d) + 0.63 * d ** (4 / 7)
    return _Asymptotes(
        145.0 * (1.0 + 0.796 * d ** (14 / 15)) ** (-15 / 7) / d * moes_m**-2,
        3.18 * elastic ** (-14 / 25) * d ** (-1 / 15) * moes_m ** (-2 / 15),
        1.29 * (1.691 + 0.691 * (d - 1.0)) ** (-2 / 3) * moes_l ** (2 / 3),
        1.48 * elastic ** (-7 / 20) * d ** (-1 / 24) * moes_m ** (-1 / 12) * moes_l**0.75,
    )


def regime(moes_m: float, moes_l: float, shape: Ellipse = CIRCLE) -> str:
    """Name the nearest asymptote of the formula, as 'elastic-piezoviscous'.

    'rigid to elastic-...' where the two differ by a factor below `ALIKE`. M, L and `shape` as in
    `nijenbanning_venner_moes`. InputError if M is not positive or L is negative.
    """
    a = _asymptotes(moes_m, moes_l, shape)
    isoviscous = max(a.rigid_iso, min(a.elastic_iso, 1.8 / shape.radius_ratio))
    if min(a.rigid_piezo, a.elastic_piezo) > isoviscous:
        # the thinner film of the two governs here, the thicker one in the other branch
        softness, viscosity = a.rigid_piezo / a.elastic_piezo, "piezoviscous"
    else:
        softness, viscosity = a.elastic_iso / a.rigid_iso, "isoviscous"
    if 1.0 / ALIKE < softness < ALIKE:
        return f"rigid to elastic-{viscosity}"
    return f"{'elastic' if softness > 1.0 else 'rigid'}-{viscosity}"


def nijenbanning_venner_moes(moes_m: float, moes_l: float, shape: Ellipse = CIRCLE) -> float:
    """H_c = h_c R_x/a^2 [-] of a contact with an incompressible lubricant, M and L with R_x.

    Nijenbanning, Venner & Moes 1994, Wear 176, 217-229: joins the rigid-isoviscous, elastic-
    isoviscous, rigid-piezoviscous and elastic-piezoviscous asymptotes; validated for R_x <= R_y.
    `shape`: the dry contact. Divide by the density ratio at p_h for a compressible lubricant.
    InputError if M is not positive or L is negative.
    """
    rigid_iso, elastic_iso, rigid_piezo, elastic_piezo = _asymptotes(moes_m, moes_l, shape)
    flat = 1.8 / shape.radius_ratio
    s = 1.5 * (1.0 + math.exp(-1.2 * elastic_iso / rigid_iso))
    isoviscous = rigid_iso**1.5 + (elastic_iso**-4 + flat**-4) ** (-3 / 8)
    piezoviscous = 0.0
    if moes_l > 0.0:
        piezoviscous = (rigid_piezo**-8 + elastic_piezo**-8) ** (-s / 8)
    h_m = (isoviscous ** (2 * s / 3) + piezoviscous) ** (1 / s)
    # from the Moes film number h/R (2U)^(-1/2) to h R/a^2
    return float(h_m * (1.5 * moes_m / shape.load_factor) ** (-2 / 3))


def inlet_viscosity_ratio(
    moes_m: float, moes_l: float, film_ratio: float, shape: Ellipse = CIRCLE
) -> float:
    """Viscosity over that of (M, L) [-] at which the formula gives `film_ratio` times the film.

    Shear heating of the inlet enters in this form: the film is that of the warmer oil. M and L are
    those of the isothermal contact, `shape` its dry contact; film_ratio > 0.
    """
    if film_ratio == 1.0:
        return 1.0
    wanted = film_ratio * nijenbanning_venner_moes(moes_m, moes_l, shape)
    # the film increases at least as viscosity^0.4, which bounds the logarithm of the ratio
    low, high = sorted((2.5 * math.log(film_ratio), 0.0))
    for _ in range(60):
        middle = 0.5 * (low + high)
        ratio = math.exp(middle)
        film = nijenbanning_venner_moes(moes_m * ratio**-0.75, moes_l * ratio**0.25, shape)
        low, high = (middle, high) if film < wanted else (low, middle)
    return math.exp(0.5 * (low + high))
