# SPDX-License-Identifier: BSD-3-Clause
"""Missing points of a map, filled by the smoothest surface that meets their rims."""

from __future__ import annotations

import numpy as np
import scipy

from pyehl.errors import InputError
from pyehl.types import Array

MAX_MISSING = 0.1
"""Largest share of a map that may be filled: beyond it the friction is that of the filling."""

DIRECT_POINTS = 50_000
TOLERANCE = 1e-10


def filled(heights: Array, pixel: tuple[float, float]) -> Array:
    """Map whose missing points are harmonic: Laplace z = 0, z given on the rim of each hole.

    Five-point differences; at the edge of the map the slope across it is zero. A plane is
    harmonic, so a hole in a plane is filled exactly (where it does not touch the edge). Heights
    (nx, ny) [m], NaN where missing; pixel size along x and y [m]. InputError if more than a share
    of `MAX_MISSING` is missing.
    """
    missing = ~np.isfinite(heights)
    count = int(np.count_nonzero(missing))
    if count == 0:
        return heights
    share = count / heights.size
    if share > MAX_MISSING:
        raise InputError(
            f"{count} of {heights.size} heights are missing ({100 * share:.1f} %), more than "
            f"{100 * MAX_MISSING:.0f} %: what the friction would be is what the filling is; "
            "measure again, or take a part of the map by surface.crop_x_min and so on"
        )
    i, j = np.nonzero(missing)
    places = np.ravel_multi_index((i, j), heights.shape)
    diagonal, right = np.zeros(count), np.zeros(count)
    rows, columns, values = [], [], []
    for di, dj in ((1, 0), (-1, 0), (0, 1), (0, -1)):
        weight = (min(pixel) / pixel[0 if di else 1]) ** 2
        p, q = i + di, j + dj
        inside = (p >= 0) & (p < heights.shape[0]) & (q >= 0) & (q < heights.shape[1])
        at = np.nonzero(inside)[0]
        p, q = p[at], q[at]
        diagonal[at] += weight
        unknown = missing[p, q]
        rows.append(at[unknown])
        neighbours = np.ravel_multi_index((p[unknown], q[unknown]), heights.shape)
        columns.append(np.searchsorted(places, neighbours))
        values.append(np.full(int(unknown.sum()), -weight))
        right[at[~unknown]] += weight * heights[p[~unknown], q[~unknown]]
    matrix = scipy.sparse.coo_matrix(
        (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), (count, count)
    ) + scipy.sparse.diags(diagonal)
    result = heights.copy()
    if count <= DIRECT_POINTS:
        result[missing] = scipy.sparse.linalg.spsolve(matrix.tocsc(), right)
    else:
        result[missing] = _solve(matrix.tocsr(), right, nearest(heights)[missing])
    return result


def _solve(matrix: scipy.sparse.csr_matrix, right: Array, guess: Array) -> Array:
    """Solve for many missing points by conjugate gradients."""
    offset = float(guess.mean())
    balance = right - offset * (matrix @ np.ones(right.size))
    inverse = scipy.sparse.diags(1.0 / matrix.diagonal())
    solution, failed = scipy.sparse.linalg.cg(
        matrix, balance, x0=guess - offset, rtol=TOLERANCE, maxiter=20_000, M=inverse
    )
    if failed:
        raise InputError(f"{right.size} missing heights: their interpolation does not converge")
    return np.asarray(solution + offset)


def nearest(heights: Array) -> Array:
    """Map whose missing points have the height of the nearest one that is not."""
    missing = ~np.isfinite(heights)
    if not missing.any():
        return heights
    at = scipy.ndimage.distance_transform_edt(missing, return_distances=False, return_indices=True)
    return np.asarray(heights[tuple(at)])
