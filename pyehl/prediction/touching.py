# SPDX-License-Identifier: BSD-3-Clause
"""What a prediction says of contact at a boundary film."""

import math
from dataclasses import replace
from typing import Any

from pyehl.prediction.friction import RoughFriction, broken
from pyehl.prediction.partial import Partial, without
from pyehl.surfaces import interpolated

NO_FRICTION = (
    "the bodies touch, and the friction there is not known: lubricant.boundary_friction and "
    "sliding are needed"
)

BETWEEN = "the film ends between the positions at which contact is looked for"


def touching(
    friction: RoughFriction, partial: Partial, tracks: tuple[float, float]
) -> tuple[RoughFriction, tuple[float, float]]:
    """Friction and that over the tracks where bodies touch, by those of a full film.

    A prediction without contact, or whose contact is not known, stays as it is.
    """
    if partial.lost:
        return _lost(friction, partial), (math.nan, math.nan)
    if not partial.touches:
        return friction, tracks
    fine = interpolated(partial.passage, 8)
    known = math.isfinite(partial.friction)
    if friction.status != "predicted":
        # a full film that breaks down has no pressures
        friction = replace(friction, rise_rms=math.nan, rise_max=math.nan, pressure_max=math.nan)
        friction = replace(friction, below_limit=math.nan, below_limit_error=math.nan)
    return replace(
        friction,
        status="predicted",
        message="partial film: the bodies touch at the boundary film",
        mu_ratio=partial.friction,
        mu_ratio_min=float(fine.min()) if known else math.nan,
        mu_ratio_max=float(fine.max()) if known else math.nan,
        position_error=math.nan,
        shift=partial.shift,
        passage=partial.passage,
        mu_smooth=partial.mu_smooth,
        film_min=partial.film_min,
        cavitated_friction=math.nan,
    ), (math.nan, math.nan)


def lost_with_the_film(friction: RoughFriction, partial: Partial) -> Partial:
    """Give a contact that is not known where the film ends, and none was found there."""
    if friction.status != "film breakdown" or partial.touches:
        return partial
    found = partial if partial.note else without(BETWEEN)
    return replace(found, mu_smooth=partial.mu_smooth, lost=True)


def _lost(friction: RoughFriction, partial: Partial) -> RoughFriction:
    """No friction of a full film where bodies touch, and how much is not known."""
    message = f"the bodies touch at the boundary film, and nothing of that is known: {partial.note}"
    if friction.status != "predicted":
        message = f"{friction.message}; {message}"
    status = "film breakdown" if friction.status == "predicted" else friction.status
    smooth = partial.mu_smooth if math.isfinite(partial.mu_smooth) else friction.mu_smooth
    none = broken(friction, math.nan)
    return replace(none, status=status, message=message, mu_smooth=smooth)


def contact_numbers(partial: Partial | None, layer: float, *, known: bool) -> dict[str, Any]:
    """Give what a summary says of contact with a layer [a^2/R]; nothing without one.

    `known`: whether the case lies in the range that the response was measured in.
    """
    if partial is None:
        return {}
    film = {"h_min_rough_error_m": partial.film_min_error if known else math.nan}
    return {
        **(film if partial.touches else {}),
        "boundary_film": layer,
        "contact_load_share": partial.load_share,
        "contact_load_share_error": partial.load_share_error,
        "contact_load_share_error_note": partial.note,
        "contact_area_share": partial.area_share,
        "contact_area_share_error": partial.area_share_error,
    }
