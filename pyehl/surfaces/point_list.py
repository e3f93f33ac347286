# SPDX-License-Identifier: BSD-3-Clause
"""Lists of the x, y and z of points that lie on a grid."""

from pathlib import Path

import numpy as np

from pyehl.errors import InputError
from pyehl.surfaces.memory import check_pixels
from pyehl.types import Array

# Of a mesh size: how far points may be from the grid
OFF = 0.02
MOST_COLUMNS = 8
"""Of a list of points."""


def is_list(rows: Array) -> bool:
    """Whether rows of three numbers (n, 3) are points and no map: n is then far larger."""
    return rows.ndim == 2 and rows.shape[1] == 3 and rows.shape[0] > 3


def is_longer_list(path: Path, rows: Array) -> bool:
    """Whether rows of few numbers are the x, y and z of points, and what else is known of them."""
    lines, columns = rows.shape
    if not (3 < columns <= MOST_COLUMNS and lines >= 4 * columns):
        return False
    try:
        heights, _ = grid_of(path, rows[:, :3])
    except InputError:
        return False
    return min(heights.shape) > 1 and heights.size <= 2 * lines


def are_pixel_numbers(points: Array) -> bool:
    """Whether x and y count pixels: whole numbers from 0 or 1 in steps of one."""
    for axis in (0, 1):
        places = np.unique(points[:, axis])
        if places[0] not in (0.0, 1.0) or not (np.diff(places) == 1.0).all():
            return False
    return True


def grid_of(path: Path, points: Array) -> tuple[Array, tuple[float, float]]:
    """Heights (nx, ny) on the grid of points x, y, z (n, 3) in any order, and its steps.

    Lengths are in the unit of the points. A point that is not there is NaN. InputError if the
    places are no grid of equal steps, or a place is there twice.
    """
    indices, shape, steps = [], [], []
    for axis, name in enumerate("xy"):
        places = points[:, axis]
        if not np.isfinite(places).all():
            row = int(np.argmin(np.isfinite(places)))
            raise InputError(f"{path}: point {row + 1} of the list has no {name}")
        gaps = np.diff(np.unique(places))
        # places of one line differ by rounding
        gaps = gaps[gaps > OFF * gaps.max(initial=0.0)]
        if not gaps.size:
            raise InputError(f"{path}: all points of the list of x, y and z have the same {name}")
        # the span knows it better than the places, which are rounded
        span = float(np.ptp(places))
        step = span / round(span / float(np.median(gaps)))
        at = (places - places.min()) / step
        index = np.rint(at).astype(np.int64)
        worst = int(np.argmax(np.abs(at - index)))
        if abs(at[worst] - index[worst]) > OFF:
            raise InputError(
                f"{path}: point {worst + 1} of the list of x, y and z, {name} = {places[worst]:.6g}"
                f", is off the grid of steps of {step:.6g}; a map needs equal steps"
            )
        indices.append(index)
        shape.append(int(index.max()) + 1)
        steps.append(step)
    check_pixels(str(path), (shape[0], shape[1]))
    heights = np.full(shape, np.nan)
    flat = np.ravel_multi_index(indices, shape)
    first, count = np.unique(flat, return_counts=True)
    if first.size < flat.size:
        i, j = np.unravel_index(first[np.argmax(count)], shape)
        raise InputError(
            f"{path}: the place number {i + 1} along x, {j + 1} along y is in the list of x, y and "
            f"z {count.max()} times"
        )
    heights.ravel()[flat] = points[:, 2]
    return heights, (steps[0], steps[1])
