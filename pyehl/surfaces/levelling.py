# SPDX-License-Identifier: BSD-3-Clause
"""Form taken off a map: its mean, its plane, its curvature, by least squares."""

import warnings

import numpy as np

from pyehl.errors import InputError
from pyehl.types import Array, Mask

DEGREES = {"centre": 0, "tilt": 1, "curvature": 2}
"""Total degree of the polynomial in x and y that each word takes off."""

LINES = 64
"""Lines of a map that are levelled together."""


def _factors(heights: Array, degree: int, valid: Mask | None) -> tuple[Array, Array, Array]:
    """Give the polynomial nearest to a map as a product: powers of x, coefficients, powers of y."""
    nx, ny = heights.shape
    good = valid
    if valid is None and np.isfinite(heights.sum()):
        count = heights.size
    else:
        good = np.isfinite(heights) if valid is None else valid & np.isfinite(heights)
        count = int(np.count_nonzero(good))
    powers = [(a, b) for a in range(degree + 1) for b in range(degree + 1 - a)]
    # Sums over the map are products of matrices: the basis is a product of one in x and one in y
    x = np.vander(np.linspace(-1.0, 1.0, nx), 2 * degree + 1, increasing=True)
    y = np.vander(np.linspace(-1.0, 1.0, ny), 2 * degree + 1, increasing=True)
    if good is None:
        moments = np.outer(x.sum(axis=0), y.sum(axis=0))
        right = x.T @ heights @ y
    else:
        moments = x.T @ good.astype(float) @ y
        right = x.T @ np.where(good, heights, 0.0) @ y
    matrix = np.array([[moments[a + c, b + d] for c, d in powers] for a, b in powers])
    if count < len(powers) or np.linalg.cond(matrix) > 1e12:
        raise InputError(
            f"surface.detrend: {count} heights lie so that a polynomial of degree "
            f"{degree} cannot be determined from them"
        )
    values = np.linalg.solve(matrix, [right[a, b] for a, b in powers])
    coefficient = np.zeros((degree + 1, degree + 1))
    for (a, b), value in zip(powers, values, strict=True):
        coefficient[a, b] = value
    return x[:, : degree + 1], coefficient, y[:, : degree + 1]


def align_lines(heights: Array, along: str) -> None:
    """Put the lines of a scan along x or y level with each other, in place.

    The median of what each line is above the plane of the map becomes 0. Points that are NaN stay
    so. What the surface itself has in its line medians goes with the offsets: waves across the
    lines that are as long as a line.
    """
    axis = "xy".index(along)
    flat = heights.copy()
    level(flat, "tilt")
    with warnings.catch_warnings():
        # a line without a point stays as it is
        warnings.simplefilter("ignore", RuntimeWarning)
        offsets = np.nan_to_num(np.nanmedian(flat, axis=axis))
    heights -= np.expand_dims(offsets, axis)


def level(heights: Array, what: str, valid: Mask | None = None) -> None:
    """Take the mean (`centre`), plane (`tilt`) or `curvature` off a map in place.

    A least-squares polynomial over the points that count (`valid`; default: all that are numbers);
    missing points stay missing. InputError if too few points are left to tell the polynomial.
    """
    # the large parts go first, so that rounding is that of what remains
    for degree in sorted({0, DEGREES[what]}):
        x, coefficient, y = _factors(heights, degree, valid)
        lines = coefficient @ y.T
        for first in range(0, heights.shape[0], LINES):
            part = slice(first, first + LINES)
            for power, line in zip(x[part].T, lines, strict=True):
                heights[part] -= power[:, np.newaxis] * line
