# SPDX-License-Identifier: BSD-3-Clause
"""Two rough surfaces: their sum if they have the same velocity, and their correlation."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np

from pyehl.surfaces.tile import MAX_PIXELS, Topography, resampled, shifted

SAME = 1e-9
"""Relative difference below which two lengths or times count as equal."""
MAX_TILES = 12
"""Maximum number of tiles of a surface along an axis in a tile of the sum, that of the passages in
a common period (:data:`pyehl.prediction.relative_positions.MAX_PASSAGES`)."""


def composite_rms(tiles: Sequence[Topography], together: Topography | None = None) -> float:
    """Composite rms height [m] of one or two surfaces; `together` is their sum, if it is known.

    Else they count as uncorrelated, as in the mean over all relative positions.
    """
    if together is None and len(tiles) == 1:
        return tiles[0].rms_height
    return together.rms_height if together else math.hypot(*(tile.rms_height for tile in tiles))


def correlation(first: Topography, second: Topography, together: Topography | None) -> float:
    """Correlation of the heights of two surfaces with the sum `together`; NaN without a sum."""
    product = first.rms_height * second.rms_height
    if together is None or product == 0.0:
        return math.nan
    squares = first.rms_height**2 + second.rms_height**2
    return (together.rms_height**2 - squares) / (2.0 * product)


def sum_of(
    groups: Sequence[Mapping[str, Any]], tiles: Sequence[Topography], hertz_radius: float
) -> Topography | None:
    """Return the sum of the tiles of two groups of a case.

    None if their velocities differ, or as :func:`merged`.
    """
    one, two = groups
    if float(one["velocity_ratio"]) != float(two["velocity_ratio"]):
        return None
    ahead = float(two["x_start"]) - float(one["x_start"])
    return merged(tiles[0], tiles[1], ahead * hertz_radius)


def merged(first: Topography, second: Topography, ahead: float) -> Topography | None:
    """Return a tile with the sum of two, the second one `ahead` [m] along the motion.

    It holds whole tiles of both; None if it needs more than `MAX_TILES` of one, or too many pixels.
    """
    if ahead != 0.0:
        second = shifted(second, ahead)
    counts = [Fraction(b / a) for a, b in zip(first.size, second.size, strict=True)]
    counts = [ratio.limit_denominator(MAX_TILES) for ratio in counts]
    for ratio, a, b in zip(counts, first.size, second.size, strict=True):
        if ratio.numerator > MAX_TILES or not math.isclose(ratio * a, b, rel_tol=SAME):
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
