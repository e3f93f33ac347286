# SPDX-License-Identifier: BSD-3-Clause
"""What would carry where a film ends: a cut-off or a threshold of spikes, found by bisection."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from pyehl.surfaces.tile import Topography

__all__ = ["Carries", "carrying_outliers", "carrying_wavelength", "confirmed"]

Array = NDArray[np.float64]

Carries = Callable[[Topography], bool]
"""Whether a tile is good enough: its film is full."""

FEW = 0.01
"""Largest share of a map that counts as a few spikes."""

LEAST_THRESHOLD = 5.0
"""Below it, points of a normal distribution would be taken for spikes."""


def carrying_wavelength(
    tile: Topography,
    without_shorter: Callable[[Topography, float], Topography],
    carries: Carries,
    *,
    tolerance: float = 0.05,
) -> float | None:
    """Find the cut-off [m] at which the film of a tile is full: shorter waves are taken off.

    Bisection in the logarithm of the wavelength to a relative `tolerance`, between two pixels and
    the length of the tile; the film need not be full for every longer cut-off, but it is for the
    one returned. `without_shorter` takes a tile and a wavelength [m]. None if even the longest
    waves break the film.
    """
    low = math.log(2.0 * min(tile.pixel))
    high = math.log(max(tile.length_x, tile.length_y))
    if not carries(without_shorter(tile, math.exp(high))):
        return None
    while high - low > tolerance:
        middle = 0.5 * (low + high)
        if carries(without_shorter(tile, math.exp(middle))):
            high = middle
        else:
            low = middle
    rounded = _two_digits(math.exp(high))
    return rounded if carries(without_shorter(tile, rounded)) else math.exp(high)


def carrying_outliers(
    prominence: Array,
    without_spikes: Callable[[float], Topography],
    carries: Carries,
    *,
    few: float = FEW,
    tolerance: float = 0.1,
) -> tuple[float, int] | None:
    """Find the threshold of spikes at which the film is full, if a few points are what breaks it.

    `prominence` is (nx, ny), see :func:`pyehl.surfaces.spikes.prominence`; `without_spikes` takes
    a threshold, `few` is the largest share of the points that may be removed, `tolerance` that of
    the threshold, relative. Threshold and number of points beyond it; None if more than a few have
    to go.
    """
    allowed = float(np.quantile(prominence, 1.0 - few))
    low = max(LEAST_THRESHOLD, allowed)
    high = float(prominence.max())
    if low >= high or not carries(without_spikes(low)):
        return None
    least, most = math.log(low), math.log(high)
    while most - least > tolerance:
        middle = 0.5 * (least + most)
        if carries(without_spikes(math.exp(middle))):
            least = middle
        else:
            most = middle
    # a threshold that a person would write, on the safe side
    rounded = float(f"{math.exp(least):.2g}")
    if rounded > math.exp(least) or rounded < low or not carries(without_spikes(rounded)):
        rounded = math.exp(least)
    return rounded, int(np.count_nonzero(prominence > rounded))


def confirmed(start: float, longest: float, good: Callable[[float], bool]) -> float | None:
    """First wavelength of two digits, from `start` [m] on in steps of a tenth, that is good.

    None if there is none up to `longest` [m].
    """
    value = start
    while value <= longest:
        rounded = _two_digits(value)
        if good(rounded):
            return rounded
        value = 1.1 * rounded
    return None


def _two_digits(value: float) -> float:
    """Two digits of a wavelength, rounded up."""
    scale = 10.0 ** (math.floor(math.log10(value)) - 1)
    return float(f"{math.ceil(value / scale - 1e-9) * scale:.2g}")
