# SPDX-License-Identifier: BSD-3-Clause
"""Two rough surfaces: their sum where they move together, and their correlation."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np

from pyehl.surfaces.tile import MAX_PIXELS, Topography, resampled, shifted

SAME = 1e-9
"""Relative difference below which two lengths or times count as equal."""
MOST_TILES = 12
"""Most tiles of a surface along an axis in a tile of the sum, as many as passages of a common
period (:data:`pyehl.prediction.relative_positions.MOST_PASSAGES`)."""


def composite_rms(tiles: Sequence[Topography], together: Topography | None = None) -> float:
    """Rms height [m] of one or two surfaces: of their sum where they move `together`.

    Else that of uncorrelated surfaces, as in the mean over all positions.
    """
    if together is None and len(tiles) == 1:
        return tiles[0].rms_height
    return together.rms_height if together else math.hypot(*(tile.rms_height for tile in tiles))


def correlation(first: Topography, second: Topography, together: Topography | None) -> float:
    """Correlation of the heights of two surfaces that move `together`; NaN where they do not."""
    product = first.rms_height * second.rms_height
    if together is None or product == 0.0:
        return math.nan
    squares = first.rms_height**2 + second.rms_height**2
    return (together.rms_height**2 - squares) / (2.0 * product)


def sum_of(
    groups: Sequence[Mapping[str, Any]], tiles: Sequence[Topography], hertz_radius: float
) -> Topography | None:
    """Return the sum of the tiles of two groups of a case; None where they do not move together."""
    one, two = groups
    if float(one["velocity_ratio"]) != float(two["velocity_ratio"]):
        return None
    way = float(two["x_start"]) - float(one["x_start"])
    return merged(tiles[0], tiles[1], way * hertz_radius)


def merged(first: Topography, second: Topography, ahead: float) -> Topography | None:
    """Return a tile with the heights of two, the second one `ahead` [m] along the motion.

    It holds whole tiles of both. None if more than `MOST_TILES` of one are needed, or it has too
    many pixels.
    """
    if ahead != 0.0:
        second = shifted(second, ahead)
    counts = [Fraction(b / a) for a, b in zip(first.size, second.size, strict=True)]
    counts = [ratio.limit_denominator(MOST_TILES) for ratio in counts]
    for ratio, a, b in zip(counts, first.size, second.size, strict=True):
        if ratio.numerator > MOST_TILES or not math.isclose(ratio * a, b, rel_tol=SAME):
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
    """Repeat a tile along x and y."""
    size = tile.length_x * times[0], tile.length_y * times[1]
    return replace(tile, heights=np.tile(tile.heights, times), size=size)
