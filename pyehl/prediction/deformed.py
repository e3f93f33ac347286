# SPDX-License-Identifier: BSD-3-Clause
"""The deformed surface of a prediction in numbers, each with an estimate of its error."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from statistics import fmean
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from pyehl.prediction.friction import RoughFriction
    from pyehl.prediction.second_surface import Together

Array = NDArray[np.float64]

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
