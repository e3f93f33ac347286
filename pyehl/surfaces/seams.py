# SPDX-License-Identifier: BSD-3-Clause
"""Tiles of maps: what happens at the edges of a map that is not periodic.

A tile is repeated over and over. Where opposite edges do not match, the heights jump, a step of
infinite slope that the surface does not have, and that holds the film up or breaks it.
"""

import numpy as np

from pyehl.types import Array

LINES = 64
"""Lines of a map that are looked at together."""

RIM = 0.1
"""Share of each side over which 'window' brings the heights down."""


def mirrored(heights: Array) -> Array:
    """Tile (2 nx, 2 ny) of twice the size on each side: the map (nx, ny) and its mirror images.

    Reflected about the middle between two pixels (the symmetry of a cosine transform), so that
    every height occurs four times: mean, rms and every other number of the height distribution are
    those of the map. Heights are continuous across every seam. The slope across a seam keeps its
    magnitude and changes its sign, with one step of zero between: a fold, no jump. Its spectrum
    falls with the fourth power of the wavenumber, no slower than that of a rough surface, that of
    a jump with the second.

    The middle of the map lies on the tile's row 0, so that it passes the centre of the contact.
    """
    nx, ny = heights.shape
    half = ny // 2
    tile = np.empty((2 * nx, 2 * ny))
    tile[:nx, : ny - half] = heights[:, half:]
    tile[:nx, ny - half : 2 * ny - half] = heights[:, ::-1]
    tile[:nx, 2 * ny - half :] = heights[:, :half]
    tile[nx:] = tile[nx - 1 :: -1]
    return tile


def unmirrored(i: int, j: int, shape: tuple[int, int]) -> tuple[int, int]:
    """Pixel of the map (nx, ny) = `shape` that pixel (i, j) of its mirrored tile shows."""
    nx, ny = shape
    i, j = i % (2 * nx), (j + ny // 2) % (2 * ny)
    return (i if i < nx else 2 * nx - 1 - i), (j if j < ny else 2 * ny - 1 - j)


def windowed(heights: Array) -> Array:
    """Map brought down to its mean along its rim by a raised cosine over a tenth of each side.

    Inside nothing changes; the rim loses roughness, so that the rms falls.
    """
    half = heights.shape[1] // 2
    mean = float(heights.mean())
    tile = np.roll(heights, -half, axis=1)
    tile -= mean
    tile *= _taper(heights.shape[0])[:, np.newaxis]
    tile *= np.roll(_taper(heights.shape[1]), -half)
    tile += mean
    return tile


def rim(shape: tuple[int, int]) -> int:
    """Points (nx, ny) of a map that `windowed` brings down."""
    inside = [int(np.count_nonzero(_taper(n) == 1.0)) for n in shape]
    return shape[0] * shape[1] - inside[0] * inside[1]


def _taper(n: int) -> Array:
    """Tukey window of n points, zero half a pixel outside of both ends."""
    distance = (np.minimum(np.arange(n), np.arange(n)[::-1]) + 0.5) / n
    return np.where(distance < RIM, 0.5 - 0.5 * np.cos(np.pi * distance / RIM), 1.0)


def jump(heights: Array) -> float:
    """Rms step across the seams of a tile over the rms step between neighbours inside.

    About 1 for a periodic surface, many for a map that is none.
    """
    ratios = []
    for axis in (0, 1):
        z = np.moveaxis(heights, axis, 0)
        square = 0.0
        for first in range(0, heights.shape[0], LINES):
            # a few lines at a time; along x with the next one
            part = heights[first : first + LINES + (axis == 0)]
            steps = np.diff(part, axis=axis)
            square += float(np.einsum("ij,ij->", steps, steps))
        inside = float(np.sqrt(square / (heights.size - heights.size // z.shape[0])))
        seam = float(np.sqrt(np.mean((z[0] - z[-1]) ** 2)))
        ratios.append(seam / inside if inside > 0.0 else 0.0)
    return max(ratios)
