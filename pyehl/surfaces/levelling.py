# SPDX-License-Identifier: BSD-3-Clause
"""Form taken off a map: its mean, its plane, its curvature, by least squares."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["DEGREES", "fit", "levelled"]

Array = NDArray[np.float64]

DEGREES = {"centre": 0, "tilt": 1, "curvature": 2}
"""Total degree of the polynomial in x and y that each word takes off."""


def fit(heights: Array, degree: int, valid: NDArray[np.bool_] | None = None) -> Array:
    """Polynomial of a total degree in x and y nearest to a map.

    Parameters
    ----------
    heights
        (nx, ny) [m].
    degree
        0: mean; 1: plane; 2: with x^2, x y and y^2.
    valid
        (nx, ny) points that count; default: those that are numbers.

    Returns
    -------
    Array
        The polynomial at all points, (nx, ny) [m].

    Raises
    ------
    ValueError
        If too few points are left to tell the polynomial.
    """
    nx, ny = heights.shape
    good = np.isfinite(heights) if valid is None else valid & np.isfinite(heights)
    powers = [(a, b) for a in range(degree + 1) for b in range(degree + 1 - a)]
    # Sums over the map are products of matrices: the basis is a product of one in x and one in y
    x = np.vander(np.linspace(-1.0, 1.0, nx), 2 * degree + 1, increasing=True)
    y = np.vander(np.linspace(-1.0, 1.0, ny), 2 * degree + 1, increasing=True)
    moments = x.T @ good.astype(float) @ y
    right = x.T @ np.where(good, heights, 0.0) @ y
    matrix = np.array([[moments[a + c, b + d] for c, d in powers] for a, b in powers])
    if np.count_nonzero(good) < len(powers) or np.linalg.cond(matrix) > 1e12:
        raise ValueError(
            f"surface.detrend: {np.count_nonzero(good)} heights lie so that a polynomial of degree "
            f"{degree} cannot be told from them"
        )
    values = np.linalg.solve(matrix, [right[a, b] for a, b in powers])
    coefficient = np.zeros((degree + 1, degree + 1))
    for (a, b), value in zip(powers, values, strict=True):
        coefficient[a, b] = value
    return np.asarray(x[:, : degree + 1] @ coefficient @ y[:, : degree + 1].T)


def levelled(heights: Array, what: str, valid: NDArray[np.bool_] | None = None) -> Array:
    """Map without its mean ('centre'), plane ('tilt') or curvature; 'none': as it is.

    The least-squares polynomial of :func:`fit` is subtracted; missing points stay missing.
    """
    if what == "none":
        return heights
    # the large parts go first, so that rounding is that of what remains
    centred = heights - fit(heights, 0, valid)
    return centred if what == "centre" else centred - fit(centred, DEGREES[what], valid)
