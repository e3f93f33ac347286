# SPDX-License-Identifier: BSD-3-Clause
"""What a passage of a tile is in the end: mu_r/mu_s with all that was met."""

import math
from dataclasses import dataclass, replace

import numpy as np

from pyehl.prediction.contact import Response, ShearedContact
from pyehl.prediction.relative_positions import Passage
from pyehl.surfaces import interpolated
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Array

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
