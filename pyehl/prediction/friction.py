# SPDX-License-Identifier: BSD-3-Clause
"""Results of a passage: mu_r/mu_s, pressure, film and deformed surface, with their errors."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from statistics import fmean
from typing import TYPE_CHECKING, Any

import numpy as np

from pyehl.prediction.contact import Response, ShearedContact
from pyehl.prediction.relative_positions import Passage
from pyehl.surfaces import interpolated
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Array

if TYPE_CHECKING:
    from pyehl.prediction.second_surface import Together

BEYOND = "beyond linear response"
"""Status where the ratio is larger than the model can tell."""
STATUSES = ("predicted", "film breakdown", BEYOND, "load lost", "overflow")
"""All statuses of a prediction; every one but the first is one without a ratio."""
TRACKS = 8
"""Tracks over which mean and spread are taken unless asked for otherwise."""

LARGEST_RATIO = 10.0
"""Largest mu_r/mu_s that is reported."""

NEWTONIAN_NOTE = (
    "Newtonian: a ratio at this slip, no absolute coefficient; shear thinning brings it close to "
    "1, see lubricant.shear_law"
)
NEWTONIAN_FLOW_NOTE = (
    "; film and waves are those of a Newtonian flow: where the oil thins in it, too, the ratio is "
    "nearer to 1, see lubricant.flow"
)
STRESS_NOTE = "ratio of friction coefficients at the given slide-to-roll ratio"


@dataclass(frozen=True, slots=True)
class RoughFriction:
    """Friction over one passage of the rough surfaces."""

    # ``"predicted"``, ``"film breakdown"``, ``"beyond linear response"``, ``"overflow"`` or ``"load
    # lost"``. Unless ``"predicted"`` the ratios are NaN
    status: str
    message: str  # the status in a sentence
    # mean, least and greatest mu_r/mu_s over the passage [-]; the extremes of the trigonometric
    # interpolant through the positions
    mu_ratio: float
    mu_ratio_min: float
    mu_ratio_max: float
    # What half as many positions would miss at the others, relative to the mean: an upper estimate
    # of what the positions leave undecided. NaN for an odd number of them
    position_error: float
    # (n,) how far each tile has moved [m], equally spaced over its length. Of two rough surfaces
    # over their common period; in the order of a lattice where there is none
    shifts: tuple[Array, ...]
    passage: Array  # (n,) mu_r/mu_s there [-]
    # Friction coefficient of the smooth contact at the slide-to-roll ratio [-]; without meaning for
    # a Newtonian lubricant
    mu_smooth: float
    film_min: float  # minimum film over the passage [m]; NaN where it ends
    # Rise of the pressure over the passage, its rms within :data:`~pyehl.prediction.contact.NEAR`
    # and the greatest within :data:`~pyehl.prediction.contact.INNER` [Pa]
    rise_rms: float
    rise_max: float
    pressure_max: float  # maximum pressure over the passage within INNER [Pa]
    # Mean share of the contact with less film than psd.film_limit [-], and what the error of the
    # film makes of it; NaN without a limit
    below_limit: float
    below_limit_error: float
    cavitated_share: float  # mean share of the contact where p_s + delta p <= 0 [-]
    cavitated_friction: float  # bound of the share of the friction that comes from there [-]
    # Greatest |integral of delta p|/w over the passage [-], before any load balance
    load_error: float
    # Mean share of the contact where the film has ended, in the positions [-]
    ended: float
    # delta p and deformed roughness of each surface on the grid of its tile
    responses: tuple[Response, ...]

    @property
    def response(self) -> Response:
        """Response of the (first) surface."""
        return self.responses[0]

    @property
    def shift(self) -> Array:
        """How far the tile of the (first) surface has moved (n,) [m]."""
        return self.shifts[0]


def thins(lubricant: Lubricant, operating: OperatingPoint) -> bool:
    """Whether the shear stress is another than the Newtonian one."""
    return lubricant.shear.law != "newtonian" and operating.sliding_speed > 0.0


def meaning(lubricant: Lubricant, operating: OperatingPoint) -> str:
    """Say what mu_r/mu_s is."""
    stress = STRESS_NOTE + ("" if lubricant.shear.in_flow else NEWTONIAN_FLOW_NOTE)
    note = stress if thins(lubricant, operating) else NEWTONIAN_NOTE
    return note + lubricant.beyond(operating.hertz_pressure)


def outcome(
    contact: ShearedContact, ratios: Array, *, load_balance: bool = False
) -> tuple[str, str]:
    """Give status and message of a passage by mu_r/mu_s at its positions (n,).

    `load_balance`: what the roughness carries is taken off the smooth contact.
    """
    if contact.thinnest <= 0.0:
        return "film breakdown", too_high(-contact.thinnest * contact.operating.film_scale)
    if contact.lost or (load_balance and contact.imbalance >= 1.0):
        return "load lost", "the roughness pressure exceeds the load"
    if not np.all(np.isfinite(ratios)):
        return "overflow", "the viscosity at p_s + delta p is not a number"
    mean = float(ratios.mean())
    if mean > LARGEST_RATIO:
        message = f"pressures that raise mu_r/mu_s to {mean:.3g} are beyond a linear response"
        return BEYOND, message
    return "predicted", "full film throughout the passage"


def passed(
    contact: ShearedContact,
    outcome: tuple[str, str],
    passage: Passage,
    *,
    film_unit: float,
    shifts: tuple[Array, ...],
    responses: tuple[Response, ...],
) -> RoughFriction:
    """Put together what a contact has met in a passage, with its status and message.

    `film_unit` [m]; `shifts` and `responses` of the surfaces by number.
    """
    ratios, visited = passage.ratios, max(1, contact.count * contact.points)
    low, share, high = contact.shares() if contact.levels else (math.nan,) * 3
    status, message = outcome
    mean = least = greatest = math.nan
    least_film = math.nan if status == "film breakdown" else contact.least_film()
    if status == "predicted":
        fine = interpolated(ratios, 8) if passage.periodic else ratios
        mean, least, greatest = (float(v) for v in (ratios.mean(), fine.min(), fine.max()))
    return RoughFriction(
        status=status,
        message=message,
        mu_ratio=mean,
        mu_ratio_min=least,
        mu_ratio_max=greatest,
        position_error=passage.undecided,
        shifts=shifts,
        passage=ratios,
        mu_smooth=contact.mu_smooth(),
        film_min=least_film * film_unit,
        rise_rms=contact.rise_rms() * contact.operating.hertz_pressure,
        rise_max=contact.greatest_rise * contact.operating.hertz_pressure,
        pressure_max=contact.greatest_pressure * contact.operating.hertz_pressure,
        below_limit=float(share),
        below_limit_error=0.5 * float(high - low),
        cavitated_share=contact.cavitated / visited,
        cavitated_friction=contact.cavitated_bound(least) if status == "predicted" else math.nan,
        load_error=contact.imbalance,
        ended=contact.ended / visited,
        responses=responses,
    )


def too_high(height: float) -> str:
    """Say that the deformed roughness is higher than the film sustains, by a height [m]."""
    much = f"{height * 1e9:.3g} nm"
    return f"the deformed roughness is {much} higher than the film sustains: no full film"


def broken(friction: RoughFriction, sustained: float) -> RoughFriction:
    """Return a prediction whose film ends between its positions: no film, no ratio.

    `sustained`: least of what the film sustains less the deformed roughness [m].
    """
    return replace(
        friction,
        status="film breakdown",
        message=too_high(-sustained),
        mu_ratio=math.nan,
        mu_ratio_min=math.nan,
        mu_ratio_max=math.nan,
        position_error=math.nan,
        film_min=math.nan,
        cavitated_friction=math.nan,
    )


# Errors against the full simulation, measured in docs/evidence/thinning: relative, and of a film
# beside that of the smooth contact by the rms height of the deformed roughness
RMS_DEFORMED, RISE_RMS, RISE = 0.13, 0.05, 0.15
ROUGH_FILM_ERROR = 0.35
# Slip from which on that of the film is twice as large
MUCH_SLIP = 0.2


def film_share(*velocity_ratios: float) -> float:
    """Error of a film over the rms height of the deformed roughness, at velocity ratios [-]."""
    slips = [abs(ratio - 1.0) for ratio in velocity_ratios]
    return ROUGH_FILM_ERROR * (2.0 if max(slips) > MUCH_SLIP else 1.0)


def film_levels(
    limit: float, waves: Sequence[tuple[Array, Array]], velocity_ratios: Sequence[float]
) -> tuple[float, ...]:
    """Film limit less its error, itself, and with its error; () without a limit.

    Of each surface `waves` has the mean square of the components of the roughness, in the square of
    the unit of the limit, and how much of each the contact leaves.
    """
    left = sum(float((power * np.square(ratio)).sum()) for power, ratio in waves)
    margin = film_share(*velocity_ratios) * math.sqrt(left)
    return (limit - margin, limit, limit + margin) if limit > 0.0 else ()


def deformed_surface(
    friction: RoughFriction,
    film_minimum: float,
    film_limit: float,
    velocity_ratios: Sequence[float],
    *,
    known: bool,
    together: Together | None = None,
) -> dict[str, Any]:
    """Give what a summary says of the deformed surface.

    Minimum film of the smooth contact and film limit in m; `known`: whether the errors are, because
    the model is one that they were measured of and the case in its range; `together`: the sum of
    two surfaces that move so. NaN for what is not known.
    """
    of_each = [float(np.std(response.deformed)) for response in friction.responses]
    deformed = of_each[0]
    of_all = math.hypot(*of_each) if together is None else together.deformed_rms
    ratio = film_minimum / of_all if of_all > 0.0 else math.nan
    rms, rise = friction.rise_rms, friction.rise_max
    share, share_error = friction.below_limit, friction.below_limit_error
    if friction.status != "predicted":
        rms = rise = share = share_error = math.nan
    values = {
        "h_min_rough_m": (friction.film_min, film_share(*velocity_ratios) * of_all),
        "rms_deformed_m": (deformed, RMS_DEFORMED * deformed),
        "lambda_ratio_deformed": (ratio, RMS_DEFORMED * ratio),
        "p_rise_rms_Pa": (rms, RISE_RMS * rms),
        "p_rise_max_Pa": (rise, RISE * rise),
        "film_below_limit_share": (share, share_error),
    }
    found: dict[str, Any] = {"film_limit_m": film_limit or None}
    for name, (value, error) in values.items():
        reported = known and math.isfinite(value)
        found |= {name: value, error_name(name): error if reported else math.nan}
    return found


def error_name(name: str) -> str:
    """Give the name of the error of a quantity: before the unit."""
    for unit in ("_m", "_Pa", "_share"):
        if name.endswith(unit):
            return f"{name.removesuffix(unit)}_error{unit.replace('_share', '')}"
    return f"{name}_error"


def deformed_surfaces(rows: Sequence[Mapping[str, Any]]) -> dict[str, float | None]:
    """Give the same over the summaries of several surfaces.

    Means, the maximum pressure increase, the minimum film; the largest of each error. None
    where one of the surfaces has none.
    """
    names = (
        "lambda_ratio_deformed",
        "rms_deformed_m",
        "p_rise_rms_Pa",
        "p_rise_max_Pa",
        "h_min_rough_m",
        "film_below_limit_share",
    )
    over = {"p_rise_max_Pa": max, "h_min_rough_m": min}
    found: dict[str, float | None] = {}
    for name in names:
        for key, of_all in ((name, over.get(name, fmean)), (error_name(name), max)):
            numbers = [row.get(key) for row in rows]
            found[key] = None if None in numbers else of_all(float(str(v)) for v in numbers)
    return found
