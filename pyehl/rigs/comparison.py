# SPDX-License-Identifier: BSD-3-Clause
"""Comparison of computed curves with measurements on a rig."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from pyehl.errors import InputError
from pyehl.rigs.repeats import Curve
from pyehl.types import Array


@dataclass(frozen=True, slots=True)
class Deviation:
    """Computed over measured values minus 1, over one range of the condition."""

    low: float
    high: float
    count: int
    mean: float
    rms: float
    largest: float  # largest by magnitude, with its sign
    at: float  # condition at which it occurs

    def __str__(self) -> str:
        """Return one line: range, number of points, mean, rms, largest and its condition."""
        return (
            f"{self.low:.4g} to {self.high:.4g}: {self.count} points, mean {self.mean:+.1%}, rms "
            f"{self.rms:.1%}, largest {self.largest:+.1%} at {self.at:.4g}"
        )


def deviations(curve: Curve, places: Array, values: Array) -> list[Deviation]:
    """Compare per decade of the condition, then over the whole range.

    Only the whole range if it is less than a decade, or a place or a computed value is not
    positive.

    Parameters
    ----------
    curve
        The measurements.
    places, values
        The computed curve (n,), in the units of the measured one; interpolated in logarithms if it
        and the measured places are all positive, else linearly.

    Returns
    -------
    list of Deviation
        Ranges with measured points that the computed curve reaches.

    Raises
    ------
    InputError
        If the computed curve has fewer than two values, or reaches none of the measured points.
    """
    known = np.isfinite(places) & np.isfinite(values)
    order = np.argsort(places[known])
    x, y = places[known][order], values[known][order]
    if x.size < 2:
        raise InputError(f"the results have {x.size} values of {curve.quantity}: two are needed")
    logs = bool(x[0] > 0.0 and (y > 0.0).all() and (curve.places > 0.0).all())
    along = np.log if logs else np.asarray
    computed = np.interp(along(curve.places), along(x), along(y), left=np.nan, right=np.nan)
    if logs:
        computed = np.exp(computed)
    off = computed / curve.values - 1.0
    reached = np.isfinite(off)
    if not reached.any():
        raise InputError(
            f"the results go from {x[0]:.4g} to {x[-1]:.4g} of {curve.over}, the measured points "
            f"from {curve.places[0]:.4g} to {curve.places[-1]:.4g}: none is reached"
        )
    at, off = curve.places[reached], off[reached]
    parts = [np.arange(at.size)]
    if logs and at[-1] > 10.0 * at[0]:
        decades = np.floor(np.log10(at))
        parts = [np.flatnonzero(decades == d) for d in np.unique(decades)] + parts
    return [_deviation(at[part], off[part]) for part in parts]


def _deviation(at: Array, off: Array) -> Deviation:
    k = int(np.abs(off).argmax())
    return Deviation(
        low=float(at[0]),
        high=float(at[-1]),
        count=at.size,
        mean=float(off.mean()),
        rms=float(np.sqrt(np.mean(off**2))),
        largest=float(off[k]),
        at=float(at[k]),
    )
