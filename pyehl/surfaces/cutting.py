# SPDX-License-Identifier: BSD-3-Clause
"""Parts of maps, and maps turned: the lay against the motion."""

import math

import numpy as np
import scipy

from pyehl.errors import InputError
from pyehl.types import Array

LEAST_PIXELS = 4

LINES = 64
"""Lines of a map that are turned together."""

MARGIN = 12
"""Pixels around a map that repeat its edge: splines forget by a factor of 3.7 a pixel."""


def cropped(
    heights: Array, pixel: tuple[float, float], bounds: tuple[float, float, float, float]
) -> Array:
    """Part of a map (nx, ny) with a pixel size along x and y [m].

    `bounds` are (x_min, x_max, y_min, y_max) [m], rounded to whole pixels; a maximum of 0 is the
    far edge. InputError if the part reaches beyond the map, or less than 4 x 4 pixels are left.
    """
    cuts = []
    for axis, name in enumerate("xy"):
        n, size = heights.shape[axis], heights.shape[axis] * pixel[axis]
        low, high = bounds[2 * axis], bounds[2 * axis + 1] or size
        if high > size * (1.0 + 1e-9):
            raise InputError(
                f"surface.crop_{name}_max = {high:g} m reaches beyond the map, which is "
                f"{size:g} m long in {name}"
            )
        first, last = round(low / pixel[axis]), min(n, round(high / pixel[axis]))
        if last - first < LEAST_PIXELS:
            raise InputError(
                f"surface.crop_{name}_min = {low:g} and crop_{name}_max = {high:g} m leave "
                f"{max(0, last - first)} pixels of {pixel[axis]:.3g} m; {LEAST_PIXELS} are needed"
            )
        cuts.append(slice(first, last))
    return np.ascontiguousarray(heights[tuple(cuts)])


def rotated(
    heights: Array, pixel: tuple[float, float], angle: float
) -> tuple[Array, tuple[float, float]]:
    """Map (nx, ny), none missing, turned about its middle, counter-clockwise seen from above.

    What pointed along x points in the direction `angle` [degrees] afterwards: a lay along x turned
    by 90 degrees lies across the motion. Quarter turns move pixels and change nothing else; any
    other angle interpolates (cubic splines) and keeps the largest upright rectangle inside the
    turned map, so that nothing is made up at its corners. Its pixels [m] are then square, the
    smaller of the two sizes.
    """
    quarters = round(angle / 90.0)
    if abs(angle - 90.0 * quarters) < 1e-9:
        turned = np.ascontiguousarray(np.rot90(heights, -quarters, axes=(1, 0)))
        return turned, pixel if quarters % 2 == 0 else (pixel[1], pixel[0])
    size_x, size_y = (n * p for n, p in zip(heights.shape, pixel, strict=True))
    width, height = _inside(size_x, size_y, math.radians(angle))
    step = min(pixel)
    nx, ny = int(width / step), int(height / step)
    if min(nx, ny) < LEAST_PIXELS:
        raise InputError(f"surface.rotate = {angle:g}: no rectangle of 4 x 4 pixels is left inside")
    y = (np.arange(ny) - 0.5 * (ny - 1)) * step
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    # the margin takes what the splines feel of the end of the map
    splines = np.pad(heights, MARGIN, mode="edge")
    scipy.ndimage.spline_filter(splines, order=3, output=splines, mode="mirror")
    turned = np.empty((nx, ny))
    for first in range(0, nx, LINES):
        # a few lines at a time: the places alone would take twice the memory of the map
        x = (np.arange(first, min(nx, first + LINES)) - 0.5 * (nx - 1))[:, None] * step
        at = [
            (c * x + s * y) / pixel[0] + 0.5 * (splines.shape[0] - 1),
            (c * y - s * x) / pixel[1] + 0.5 * (splines.shape[1] - 1),
        ]
        scipy.ndimage.map_coordinates(
            splines, at, turned[first : first + LINES], order=3, mode="mirror", prefilter=False
        )
    return turned, (step, step)


def _inside(width: float, height: float, angle: float) -> tuple[float, float]:
    """Sides of the largest upright rectangle inside a rectangle that is turned."""
    s, c = abs(math.sin(angle)), abs(math.cos(angle))
    long, short = max(width, height), min(width, height)
    if short <= 2.0 * s * c * long or abs(s - c) < 1e-12:
        # two opposite corners touch the long sides
        half = 0.5 * short
        return (half / s, half / c) if width >= height else (half / c, half / s)
    determinant = c * c - s * s
    return (width * c - height * s) / determinant, (height * c - width * s) / determinant
