# SPDX-License-Identifier: BSD-3-Clause
"""Points of a map that are no heights of the surface: missing ones, and spikes.

Missing ones are filled by the smoothest surface that meets their rims. Spikes stand out of their
neighbourhood: optical instruments give single pixels or small groups of them that lie micrometres
off, at steep slopes and specks of dirt, and one of them ends a film.
"""

from __future__ import annotations

import math

import numpy as np
import scipy

from pyehl.errors import InputError
from pyehl.surfaces.map_steps import level
from pyehl.types import Array, Mask

MAX_MISSING = 0.1
"""Largest share of a map that may be filled: beyond it the friction is that of the filling."""

GOOD_BLOCKS, GOOD_PART, LEAST_PART = 48, 0.02, 0.1
"""Blocks per side by which a good part of a map is looked for, the share that may be missing in it,
and the least share of the map that it is worth."""
SHOWN_COLUMNS, SHOWN_ROWS = 48, 20
"""Letters that show where points are missing."""

DIRECT_POINTS = 50_000
TOLERANCE = 1e-10
WINDOW = 5
"""Pixels per side of the median that a point is compared with."""
LINES = 64
"""Lines of a map that are looked at together."""
MAD_TO_SIGMA = 1.482602218505602
"""Standard deviation of a normal distribution over its median absolute deviation."""


def filled(
    heights: Array, pixel: tuple[float, float], corner: tuple[float, float] = (0.0, 0.0)
) -> Array:
    """Map whose missing points are harmonic: Laplace z = 0, z given on the rim of each hole.

    Five-point differences; at the edge of the map the slope across it is zero. A plane is
    harmonic, so a hole in a plane is filled exactly (where it does not touch the edge). Heights
    (nx, ny) [m], NaN where missing; pixel size along x and y, and `corner` of it on the map as read
    [m]. InputError if more than a share of `MAX_MISSING` is missing: where, and which part is good.
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
            f"{_where(missing, pixel, corner)}"
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


def _where(missing: Mask, pixel: tuple[float, float], corner: tuple[float, float]) -> str:
    """Say which part of a map is nearly complete, if one is, and show where points are missing."""
    blocks = [np.linspace(0, n, min(n, GOOD_BLOCKS) + 1).astype(int) for n in missing.shape]
    count = np.add.reduceat(missing.astype(int), blocks[0][:-1], axis=0)
    count = np.add.reduceat(count, blocks[1][:-1], axis=1)
    area = np.outer(*(np.diff(b) for b in blocks))
    good = _largest_part(count, area)
    text = ""
    if good is not None:
        part = [
            f"surface.crop_{name}_{end}={corner[k] + blocks[k][at] * pixel[k]:.6g}"
            for k, name in enumerate("xy")
            for end, at in (("min", good[2 * k]), ("max", good[2 * k + 1]))
        ]
        i, j, m, n = good
        lost = 100 * count[i:j, m:n].sum() / area[i:j, m:n].sum()
        of_all = 100 * area[i:j, m:n].sum() / missing.size
        share = f"{of_all:.0f} % of the map, {lost:.1f} % missing"
        text = f"\nexpected: such as {', '.join(part)}: {share}"
    # X to the right, Y upwards; a letter is about twice as high as wide
    rows = np.array_split(missing, min(missing.shape[1], SHOWN_ROWS), axis=1)
    lines = [
        "".join(
            " .:#"[min(3, math.ceil(3 * cell.mean()))]
            for cell in np.array_split(row, min(missing.shape[0], SHOWN_COLUMNS), axis=0)
        )
        for row in rows[::-1]
    ]
    return text + "\n" + "\n".join(f"  |{line}|" for line in lines) + "\n  '#': missing"


def _largest_part(count: Array, area: Array) -> tuple[int, int, int, int] | None:
    """Largest part of blocks with few missing points: first and last block along x and y."""
    sums, areas = (np.pad(values.cumsum(0).cumsum(1), ((1, 0), (1, 0))) for values in (count, area))
    best, found = 0.0, None
    for i in range(count.shape[0]):
        for j in range(i + 1, count.shape[0] + 1):
            lost, whole = sums[j] - sums[i], areas[j] - areas[i]
            size = whole[np.newaxis, :] - whole[:, np.newaxis]
            few = lost[np.newaxis, :] - lost[:, np.newaxis] <= GOOD_PART * size
            size = np.where(few, size, 0.0)
            place = int(size.argmax())
            if size.flat[place] > best:
                best, found = float(size.flat[place]), (i, j, *divmod(place, size.shape[1]))
    return found if best >= LEAST_PART * area.sum() else None


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


def levelled(heights: Array) -> Array:
    """Copy of a map without tilt and curvature, whose missing points have the nearest height."""
    z = heights.copy()
    level(z, "curvature")
    return nearest(z)


def prominence(heights: Array) -> Array:
    """Distance (nx, ny) of each point from the median around it, over the spread of these.

    Not negative.

    The high-passed map is z minus the median of the 5 x 5 points around, after tilt and curvature
    are taken off (on a plane each point is the median of those around); its spread is its median
    absolute deviation times 1.4826, the standard deviation if it were normal, which spikes do not
    change. Of normal noise 6e-7 of all points lie beyond 5, 1e-15 beyond 8. Heights (nx, ny) [m],
    NaN where missing: 0 there. InputError if more than half of the map equals its median: then
    there is no spread to compare with.
    """
    missing = ~np.isfinite(heights)
    z = levelled(heights)
    largest = max(float(z.max()), -float(z.min()))
    above = np.empty(z.shape)
    for first in range(0, z.shape[0], LINES):
        # a few lines at a time, with those around that their medians need
        part = z[max(0, first - WINDOW) : first + LINES + WINDOW]
        inner = slice(first - max(0, first - WINDOW), None)
        median = scipy.ndimage.median_filter(part, WINDOW, mode="nearest")[inner][:LINES]
        np.abs(z[first : first + LINES] - median, out=above[first : first + LINES])
    del z
    spread = MAD_TO_SIGMA * float(np.median(above[~missing], overwrite_input=True))
    # what is left of a plane is rounding
    if not spread > 1e-12 * largest:
        raise InputError(
            "surface.outliers: half of the map or more is flat to the last digit, so that there "
            "is no spread to tell spikes by; remove them in the program of the instrument"
        )
    above /= spread
    above[missing] = 0.0
    return above
