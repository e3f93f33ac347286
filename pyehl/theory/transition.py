# SPDX-License-Identifier: BSD-3-Clause
"""End of full film along a Stribeck curve, and the speed at which solid contact ends."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from pyehl.types import Array

STATUSES = ("full film", "mixed film", "film breakdown", "outside the range", "not solved")
"""Status of a point of a curve."""
FULL_FILM, MIXED, BREAKDOWN, OUTSIDE, UNSOLVED = STATUSES
LIFT_OFF = 0.01
"""Load share of the boundary film at the transition speed, where solid contact counts as ended."""
SPEED = "contact.mean_velocity"


@dataclass(frozen=True, slots=True)
class Curve:
    """One curve of a table."""

    label: str  # its name in a legend; '' for the only one
    key: str  # the varied key
    table: pd.DataFrame  # its rows
    absolute: bool = False  # whether friction is drawn as a coefficient, else as a ratio

    @property
    def places(self) -> Array:
        """Values of the key (n,)."""
        return self.column(self.key)

    def column(self, name: str) -> Array:
        """Return a column (n,); a missing number is NaN."""
        return self.table[name].to_numpy(float)

    def friction(self, name: str = "mu_ratio") -> Array:
        """Return a column of friction ratios (n,), as coefficients where these are drawn."""
        if not self.absolute:
            return self.column(name)
        # with solid contact and frictional heating there is no mu_smooth
        smooth, own = self.column("mu_smooth"), self.column("mu") / self.column("mu_ratio")
        return self.column(name) * np.where(np.isfinite(smooth), smooth, own)

    @property
    def broken(self) -> tuple[int, ...]:
        """Indices of the rows with a mixed film or film breakdown."""
        return tuple(np.flatnonzero(self.table["status"].isin((BREAKDOWN, MIXED))).tolist())

    @property
    def ends(self) -> str:
        """Where full film ends, in words."""
        return full_film_ends(self.key, self.places, self.table["status"].tolist())

    @property
    def lift_off(self) -> "LiftOff | None":
        """Where solid contact ends; None where that is not on the curve."""
        known = self.key == SPEED and "contact_load_share" in self.table
        return lift_off(self.places, self.table) if known else None


def full_film_ends(key: str, places: Sequence[float] | Array, statuses: Sequence[str]) -> str:
    """Report where full film ends along a curve over `key`.

    `places` are its values, ascending or descending, `statuses` the status of the curve at each.
    """
    broken = [k for k, status in enumerate(statuses) if status in (BREAKDOWN, MIXED)]
    known = [k for k, status in enumerate(statuses) if status in (FULL_FILM, OUTSIDE)]
    missing = len(statuses) - len(known) - len(broken)
    rest = f" with a result; {missing} have none" if missing else ""
    far = statuses.count(OUTSIDE)
    beyond = f"; {far} of them outside the range of the prediction" if far else ""
    if not known and not broken:
        return "no point has a result"
    if not broken:
        return f"full film at all points{beyond}{rest}"
    if not known:
        return f"no full film at any point{rest}"
    k, j = min(((k, j) for k in broken for j in known), key=lambda pair: abs(pair[0] - pair[1]))
    low, high = sorted((places[k], places[j]))
    return f"full film ends between {key} = {low:.4g} and {high:.4g}"


@dataclass(frozen=True, slots=True)
class LiftOff:
    """Where solid contact ends along a curve over the speed; NaN for what is not known.

    A speed is given only with its error.
    """

    speed: float = math.nan  # transition speed [m/s]
    error: float = math.nan  # from the error of the load share [m/s]
    lambda_ratio: float = math.nan  # [-]
    theta_2: float = math.nan  # [-]

    @property
    def words(self) -> str:
        """The transition speed in a line."""
        if not math.isfinite(self.speed):
            return (
                f"lift-off   not known: the curve ends within the error of a load share of "
                f"{LIFT_OFF:.0%}, or a point has no error"
            )
        beside = [
            f", {name} = {value:.3g}"
            for name, value in (("Lambda", self.lambda_ratio), ("theta_2", self.theta_2))
            if math.isfinite(value)
        ]
        return (
            f"lift-off   {LIFT_OFF:.0%} of the load at the boundary film at "
            f"{self.speed:.3g} +- {self.error:.2g} m/s{''.join(beside)}"
        )


def lift_off(speeds: Array, table: pd.DataFrame) -> LiftOff | None:
    """Find the transition speed of a curve over speeds [m/s]; None where it is not on the curve.

    `table` has a row for each speed, with load share, its error, Lambda and theta_2.
    """
    order = np.argsort(speeds)
    speeds = speeds[order]

    def column(name: str) -> Array:
        return table[name].to_numpy(float)[order]

    share, error = column("contact_load_share"), column("contact_load_share_error")
    result = _crossing(speeds, share)
    if result is None:
        return None
    ends = [_crossing(speeds, share + sign * error) for sign in (1.0, -1.0)]
    if None in ends:
        return LiftOff()
    beside = [float(np.interp(result, speeds, column(n))) for n in ("lambda_ratio", "theta_2")]
    return LiftOff(result, max(abs(end - result) for end in ends if end is not None), *beside)


def _crossing(speeds: Array, share: Array) -> float | None:
    """Highest speed at which a load share falls to `LIFT_OFF`; None if it does not.

    Speeds, ascending, and load shares (n,); the share is linear in the logarithm of the speed.
    """
    falls = np.flatnonzero((share[:-1] > LIFT_OFF) & (share[1:] <= LIFT_OFF))
    if not falls.size:
        return None
    k = int(falls[-1])
    part = (share[k] - LIFT_OFF) / (share[k] - share[k + 1])
    return float(speeds[k] * (speeds[k + 1] / speeds[k]) ** part)
