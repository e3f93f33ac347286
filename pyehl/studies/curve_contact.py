# SPDX-License-Identifier: BSD-3-Clause
"""Contact at a boundary film along a Stribeck curve, and the speed at which it ends."""

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from statistics import fmean

import numpy as np

from pyehl.types import Array, Values

LIFT_OFF = 0.01
"""Share of the load at the boundary film to which it falls at the transition speed."""
SPEED = "contact.mean_velocity"
CONTACT = {
    "contact_load_share": "1",
    "contact_load_share_error": "1",
    "contact_area_share": "1",
    "contact_area_share_error": "1",
    "contact_load_share_ehl": "1",
    "contact_load_share_ehl_error": "1",
    "contact_area_share_ehl": "1",
    "h_min_rough_ehl_m": "m",
}
"""Columns of a curve of a case with a boundary film, and their units."""


def touches(found: Sequence[Values]) -> bool:
    """Whether bodies touch, by the summaries of the predictions of a point."""
    return any((row.get("contact_load_share") or 0.0) > 0.0 for row in found)


def contact_columns(found: Sequence[Values], full: Values) -> dict[str, float | None]:
    """Give means and largest errors over surfaces, and what the full simulation has."""
    values: dict[str, float | None] = dict.fromkeys(CONTACT)
    for name, of_all in (
        ("contact_load_share", fmean),
        ("contact_load_share_error", max),
        ("contact_area_share", fmean),
        ("contact_area_share_error", max),
    ):
        numbers = [row[name] for row in found if row.get(name) is not None]
        if numbers and len(numbers) == len(found):
            values[name] = of_all(numbers)
    if full.get("status") == "converged":
        for name in (
            *("contact_load_share", "contact_load_share_error"),
            *("contact_area_share", "h_min_rough_m"),
        ):
            values[re.sub("share|rough", r"\g<0>_ehl", name)] = full.get(name)
    return values


@dataclass(frozen=True, slots=True)
class LiftOff:
    """Where contact ends along a curve over the speed; NaN for what is not known.

    Without an error there is no speed.
    """

    speed: float  # transition speed [m/s]
    error: float  # by the error of the load share [m/s]
    lambda_ratio: float  # [-]
    theta_2: float  # [-]

    @property
    def words(self) -> str:
        """The transition speed in a line."""
        if not math.isfinite(self.speed):
            return (
                f"lift-off   not known: {LIFT_OFF:.0%} of the load lies within the error of the "
                "load share where the curve ends, or where a point has none"
            )
        beside = [
            f"{name} = {value:.3g}"
            for name, value in (("Lambda", self.lambda_ratio), ("theta_2", self.theta_2))
            if math.isfinite(value)
        ]
        return (
            f"lift-off   {LIFT_OFF:.0%} of the load at the boundary film at "
            f"{self.speed:.3g} +- {self.error:.2g} m/s{', ' if beside else ''}"
            f"{', '.join(beside)}"
        )


def lift_off(key: str, places: Array, rows: Sequence[Values]) -> LiftOff | None:
    """Find the transition speed of a curve over `key`; None where it is not on the curve."""
    if key != SPEED or "contact_load_share" not in rows[0]:
        return None
    order = np.argsort(places)

    def column(name: str) -> Array:
        values = (rows[k][name] for k in order)
        return np.array([math.nan if v is None else v for v in values], dtype=float)

    speeds, share = places[order], column("contact_load_share")
    found = _crossing(speeds, share)
    if found is None:
        return None
    error = column("contact_load_share_error")
    ends = [_crossing(speeds, share + sign * error) for sign in (1.0, -1.0)]
    between = [math.inf if end is None else abs(end - found) for end in ends]
    worst = max(between)
    if not math.isfinite(worst):
        return LiftOff(math.nan, math.nan, math.nan, math.nan)
    numbers = [
        float(np.interp(found, speeds, column(name))) for name in ("lambda_ratio", "theta_2")
    ]
    return LiftOff(found, worst, numbers[0], numbers[1])


def _crossing(speeds: Array, share: Array) -> float | None:
    """Highest speed at which a load share falls to `LIFT_OFF`, by the logarithm of the speed."""
    for k in range(speeds.size - 2, -1, -1):
        low, high = share[k], share[k + 1]
        if low > LIFT_OFF >= high:
            part = (low - LIFT_OFF) / (low - high)
            return float(speeds[k] * (speeds[k + 1] / speeds[k]) ** part)
    return None
