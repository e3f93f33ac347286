# SPDX-License-Identifier: BSD-3-Clause
"""Two rough tiles that move together as one."""

import math
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

import numpy as np

from pyehl.prediction.meeting import SAME
from pyehl.surfaces import MAX_PIXELS, Topography, resampled, shifted

MOST = 12
"""Tiles beside each other, along one way, that are added to those of the other surface."""


def as_one(first: Topography, second: Topography, ahead: float) -> Topography | None:
    """Return a tile with the heights of two, the second one ahead by a way [m] along the motion.

    It holds whole tiles of both. None: not so few of both are as long, or they have too many
    pixels.
    """
    if ahead != 0.0:
        second = shifted(second, ahead)
    counts = [Fraction(b / a) for a, b in zip(first.size, second.size, strict=True)]
    counts = [ratio.limit_denominator(MOST) for ratio in counts]
    for ratio, a, b in zip(counts, first.size, second.size, strict=True):
        if ratio.numerator > MOST or not math.isclose(ratio * a, b, rel_tol=SAME):
            return None
    nx, ny = (
        max(ratio.numerator * m, ratio.denominator * n)
        for ratio, m, n in zip(counts, first.shape, second.shape, strict=True)
    )
    if nx * ny > MAX_PIXELS:
        return None
    first = _repeated(first, [ratio.numerator for ratio in counts])
    second = _repeated(second, [ratio.denominator for ratio in counts])
    heights = resampled(first, (nx, ny)).heights + resampled(second, (nx, ny)).heights
    return Topography(heights, first.size, f"{first.origin} and {second.origin}")


def _repeated(tile: Topography, times: Sequence[int]) -> Topography:
    """Return so many of a tile beside each other along x and y."""
    size = tile.length_x * times[0], tile.length_y * times[1]
    return replace(tile, heights=np.tile(tile.heights, times), size=size)
