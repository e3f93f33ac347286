# SPDX-License-Identifier: BSD-3-Clause
"""The deformed surface of a prediction in numbers, each with an estimate of its error."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from pyehl.prediction.friction import RoughFriction

__all__ = ["deformed_surface", "film_levels"]

# Errors against the full simulation, measured in docs/evidence/thinning: relative, and of a film
# beside that of the smooth contact by the rms height of the deformed roughness
RMS_DEFORMED, RMS_PRESSURE, RISE = 0.07, 0.07, 0.12
FILM = 0.3


def film_levels(limit: float, rms_deformed: float) -> tuple[float, ...]:
    """Film limit less its error, itself, and with its error; () without a limit."""
    margin = FILM * rms_deformed
    return (limit - margin, limit, limit + margin) if limit > 0.0 else ()


def deformed_surface(
    friction: RoughFriction, film_minimum: float, film_limit: float, *, known: bool
) -> dict[str, Any]:
    """Give what a summary says of the deformed surface.

    Minimum film of the smooth contact and film limit in m; `known`: whether the errors are, because
    the model is one that they were measured of and the case in its range. NaN for what is not.
    """
    deformed = float(np.std(friction.response.deformed))
    pressure = float(np.std(friction.response.pressure))
    ratio = film_minimum / deformed if deformed > 0.0 else math.nan
    rise, share, share_error = friction.rise_max, friction.below_limit, friction.below_limit_error
    if friction.status != "predicted":
        rise = share = share_error = math.nan
    values = {
        "h_min_rough_m": (friction.film_min, FILM * deformed),
        "rms_deformed_m": (deformed, RMS_DEFORMED * deformed),
        "lambda_ratio_deformed": (ratio, RMS_DEFORMED * ratio),
        "rms_pressure_Pa": (pressure, RMS_PRESSURE * pressure),
        "p_rise_max_Pa": (rise, RISE * rise),
        "film_below_limit_share": (share, share_error),
    }
    found: dict[str, Any] = {"film_limit_m": film_limit or None}
    for name, (value, error) in values.items():
        found |= {name: value, _error(name): error if known else math.nan}
    return found


def _error(name: str) -> str:
    """Give the name of an error: before the unit."""
    for unit in ("_m", "_Pa", "_share"):
        if name.endswith(unit):
            return f"{name.removesuffix(unit)}_error{unit.replace('_share', '')}"
    return f"{name}_error"
