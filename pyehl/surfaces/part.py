# SPDX-License-Identifier: BSD-3-Clause
"""Part of a large surface, for what needs its statistics alone."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pyehl.surfaces.seams import mirrored
from pyehl.surfaces.tile import Topography

__all__ = ["LARGE_PIXELS", "PART_PIXELS", "given", "part_of"]

LARGE_PIXELS, PART_PIXELS = 2**20, 2**18
"""Pixels of the largest tile that is looked at as a whole, and of a part of a larger one."""


def part_of(
    heights: NDArray[np.float64], pixel: tuple[float, float], origin: str, *, images: bool = False
) -> Topography | None:
    """Middle of a large surface, with its mirror images; None for one that is not large.

    Heights (nx, ny) [m], pixel size along x and y [m]. `images`: the tile of the surface is it
    with its mirror images, four times as many pixels. The part has at most `PART_PIXELS` pixels,
    square where the surface is wide enough.
    """
    if heights.size * (4 if images else 1) <= LARGE_PIXELS:
        return None
    most = PART_PIXELS // 4
    side = int(most**0.5)
    nx = min(heights.shape[0], max(side, most // heights.shape[1]))
    ny = min(heights.shape[1], most // nx)
    i, j = (heights.shape[0] - nx) // 2, (heights.shape[1] - ny) // 2
    tile = mirrored(heights[i : i + nx, j : j + ny])
    tile -= tile.mean()
    name = f"{origin}, {nx} x {ny} pixels in its middle"
    return Topography(tile, (2 * nx * pixel[0], 2 * ny * pixel[1]), name)


def given(heights: NDArray[np.float64], surface: Mapping[str, Any]) -> Topography:
    """Tile of heights [m] that stand in for the surface of a case; of a large one a part.

    Its size is that of the tile in the group ``surface``, or that of the map.
    """
    x, y = (float(surface[f"tile_{k}"] or surface[f"length_{k}"]) for k in "xy")
    images = bool(surface["tile_mirrored"])
    pixel = (x / heights.shape[0], y / heights.shape[1])
    if images:
        pixel = (0.5 * pixel[0], 0.5 * pixel[1])
    part = part_of(heights, pixel, "the heights", images=images)
    return part or Topography(mirrored(heights) if images else heights, (x, y))
