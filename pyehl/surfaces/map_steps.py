# SPDX-License-Identifier: BSD-3-Clause
"""Single steps of a preparation: crop, rotate, level, fill a map, join its edges, find spikes.

A tile is repeated periodically. Where opposite edges of a map do not match, the heights jump: a
step of infinite slope that the surface does not have, and at which the film breaks down.

Missing points are filled by a harmonic surface. Spikes stand out of their neighbourhood: at steep
slopes and dirt optical instruments produce single pixels or small groups that are micrometres off,
and one of them is enough for film breakdown.
"""

from __future__ import annotations

import math
import warnings

import numpy as np
import scipy

from pyehl.errors import InputError
from pyehl.types import Array, Mask

MIN_PIXELS = 4

LINES = 64
"""Number of lines of a map that are processed at a time."""

MARGIN = 12
"""Width of the padding of a map [pixels]; the effect of its end on the splines decays by a factor
of 3.7 per pixel."""


def cropped(
    heights: Array, pixel: tuple[float, float], bounds: tuple[float, float, float, float]
) -> Array:
    """Crop a map (nx, ny) with a pixel size along x and y [m].

    `bounds` are (x_min, x_max, y_min, y_max) [m], rounded to whole pixels; a maximum of 0 is the
    far edge. InputError if they are beyond the map, or fewer than 4 x 4 pixels remain.
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
        if last - first < MIN_PIXELS:
            raise InputError(
                f"surface.crop_{name}_min = {low:g} and crop_{name}_max = {high:g} m leave "
                f"{max(0, last - first)} pixels of {pixel[axis]:.3g} m; {MIN_PIXELS} are needed"
            )
        cuts.append(slice(first, last))
    return np.ascontiguousarray(heights[tuple(cuts)])


def rotated(
    heights: Array, pixel: tuple[float, float], angle: float
) -> tuple[Array, tuple[float, float]]:
    """Rotate a map (nx, ny), none missing, about its centre, counter-clockwise seen from above.

    The x direction of the map turns to `angle` [degrees]: a lay along x rotated by 90 degrees is
    across the motion. Quarter turns only permute pixels; any other angle interpolates (cubic
    splines) and keeps the largest upright rectangle inside the rotated map, so that no heights from
    outside the map are needed. Its pixels [m] are then square, with the smaller of the two sizes.
    InputError if fewer than 4 x 4 pixels remain.
    """
    quarters = round(angle / 90.0)
    if abs(angle - 90.0 * quarters) < 1e-9:
        turned = np.ascontiguousarray(np.rot90(heights, -quarters, axes=(1, 0)))
        return turned, pixel if quarters % 2 == 0 else (pixel[1], pixel[0])
    size_x, size_y = (n * p for n, p in zip(heights.shape, pixel, strict=True))
    width, height = _inside(size_x, size_y, math.radians(angle))
    step = min(pixel)
    nx, ny = int(width / step), int(height / step)
    if min(nx, ny) < MIN_PIXELS:
        raise InputError(f"surface.rotate = {angle:g}: no rectangle of 4 x 4 pixels is left inside")
    y = (np.arange(ny) - 0.5 * (ny - 1)) * step
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    # the effect of the end of the map on the splines decays within the margin
    splines = np.pad(heights, MARGIN, mode="edge")
    scipy.ndimage.spline_filter(splines, order=3, output=splines, mode="mirror")
    turned = np.empty((nx, ny))
    for first in range(0, nx, LINES):
        # a block of lines at a time: all coordinates would take twice the memory of the map
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
    """Sides of the largest upright rectangle inside a rotated rectangle."""
    s, c = abs(math.sin(angle)), abs(math.cos(angle))
    long, short = max(width, height), min(width, height)
    if short <= 2.0 * s * c * long or abs(s - c) < 1e-12:
        # two opposite corners touch the long sides
        half = 0.5 * short
        return (half / s, half / c) if width >= height else (half / c, half / s)
    determinant = c * c - s * s
    return (width * c - height * s) / determinant, (height * c - width * s) / determinant


DEGREES = {"centre": 0, "tilt": 1, "curvature": 2}
"""Total degree of the polynomial in x and y that each value of detrend removes."""


def _factors(heights: Array, degree: int, valid: Mask | None) -> tuple[Array, Array, Array]:
    """Fit a polynomial; returns its factors: powers of x, coefficients, powers of y."""
    nx, ny = heights.shape
    good = valid
    if valid is None and np.isfinite(heights.sum()):
        count = heights.size
    else:
        good = np.isfinite(heights) if valid is None else valid & np.isfinite(heights)
        count = int(np.count_nonzero(good))
    powers = [(a, b) for a in range(degree + 1) for b in range(degree + 1 - a)]
    # the basis is separable in x and y, so that sums over the map are matrix products
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
            f"surface.detrend: the positions of {count} heights do not determine a polynomial of "
            f"degree {degree}"
        )
    values = np.linalg.solve(matrix, [right[a, b] for a, b in powers])
    coefficient = np.zeros((degree + 1, degree + 1))
    for (a, b), value in zip(powers, values, strict=True):
        coefficient[a, b] = value
    return x[:, : degree + 1], coefficient, y[:, : degree + 1]


def align_lines(heights: Array, along: str) -> None:
    """Remove the height offsets of the scan lines along x or y, in place.

    The median height of each line above the plane of the map becomes 0; NaN stays NaN. This also
    removes what the surface itself contributes to the line medians: waves across the lines that are
    constant along them. InputError as :func:`level`.
    """
    axis = "xy".index(along)
    flat = heights.copy()
    level(flat, "tilt")
    with warnings.catch_warnings():
        # a line without valid points stays as it is
        warnings.simplefilter("ignore", RuntimeWarning)
        offsets = np.nan_to_num(np.nanmedian(flat, axis=axis))
    heights -= np.expand_dims(offsets, axis)


def level(heights: Array, what: str, valid: Mask | None = None) -> None:
    """Remove the mean (`centre`), plane (`tilt`) or `curvature` of a map in place.

    The polynomial is a least-squares fit to the `valid` points (default: all that are finite);
    missing points stay missing. InputError if there are too few points for the polynomial.
    """
    # the mean is removed first, so that the rounding error is that of the remainder
    for degree in sorted({0, DEGREES[what]}):
        x, coefficient, y = _factors(heights, degree, valid)
        lines = coefficient @ y.T
        for first in range(0, heights.shape[0], LINES):
            part = slice(first, first + LINES)
            for power, line in zip(x[part].T, lines, strict=True):
                heights[part] -= power[:, np.newaxis] * line


TAPER = 0.1
"""Fraction of the length at each edge over which 'window' tapers the heights."""


def mirrored(heights: Array) -> Array:
    """Return the tile (2 nx, 2 ny) of a map (nx, ny) and its mirror images.

    It is reflected about the midpoint between two pixels (the symmetry of a cosine transform), so
    that every height occurs four times: mean, rms and the whole height distribution are those of
    the map. Heights are continuous across every seam. The slope across a seam changes its sign but
    not its magnitude, with one step of zero between: a fold, not a jump. The spectrum of a fold
    decays as the fourth power of the wavenumber, at least as fast as that of a rough surface; that
    of a jump as the second.

    The middle of the map in y is at y = 0 of the tile, so that it passes the centre of the contact.
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
    """Return the pixel of a map (nx, ny) = `shape` for pixel (i, j) of its mirrored tile."""
    nx, ny = shape
    i, j = i % (2 * nx), (j + ny // 2) % (2 * ny)
    return (i if i < nx else 2 * nx - 1 - i), (j if j < ny else 2 * ny - 1 - j)


def windowed(heights: Array) -> Array:
    """Taper a map to its mean along its edges by a raised cosine over a tenth of each side.

    The inner part does not change; tapering reduces the rms height. The middle of the map in y is
    at y = 0 of the tile (nx, ny), as in `mirrored`.
    """
    half = heights.shape[1] // 2
    mean = float(heights.mean())
    tile = np.roll(heights, -half, axis=1)
    tile -= mean
    tile *= _taper(heights.shape[0])[:, np.newaxis]
    tile *= np.roll(_taper(heights.shape[1]), -half)
    tile += mean
    return tile


def tapered_points(shape: tuple[int, int]) -> int:
    """Count the points of a map (nx, ny) = `shape` that `windowed` tapers."""
    inside = [int(np.count_nonzero(_taper(n) == 1.0)) for n in shape]
    return shape[0] * shape[1] - inside[0] * inside[1]


def _taper(n: int) -> Array:
    """Tukey window of n points, zero half a pixel outside both ends."""
    distance = (np.minimum(np.arange(n), np.arange(n)[::-1]) + 0.5) / n
    return np.where(distance < TAPER, 0.5 - 0.5 * np.cos(np.pi * distance / TAPER), 1.0)


def jump(heights: Array) -> float:
    """Rms step across the seams of a tile over the rms step between neighbours inside.

    The larger of those along x and along y. About 1 for a periodic surface, far more for a map that
    is not periodic.
    """
    ratios = []
    for axis in (0, 1):
        z = np.moveaxis(heights, axis, 0)
        square = 0.0
        for first in range(0, heights.shape[0], LINES):
            # a block of lines at a time; along x with the line after it
            part = heights[first : first + LINES + (axis == 0)]
            steps = np.diff(part, axis=axis)
            square += float(np.einsum("ij,ij->", steps, steps))
        inside = float(np.sqrt(square / (heights.size - heights.size // z.shape[0])))
        seam = float(np.sqrt(np.mean((z[0] - z[-1]) ** 2)))
        ratios.append(seam / inside if inside > 0.0 else 0.0)
    return max(ratios)


MAX_MISSING = 0.1
"""Largest fraction of a map that may be filled: beyond it the interpolated heights determine the
friction."""

GOOD_BLOCKS, GOOD_PART, MIN_PART = 48, 0.02, 0.1
"""Blocks per side in the search for a good part of a map, the fraction that may be missing in it,
and its minimum fraction of the map."""
SHOWN_COLUMNS, SHOWN_ROWS = 48, 20
"""Maximum number of columns and lines of the sketch of missing points."""

DIRECT_POINTS, TOLERANCE = 50_000, 1e-10
"""Largest number of missing points that are solved for directly; relative tolerance of the
iteration for more."""
WINDOW = 5
"""Pixels per side of the median filter with which a point is compared."""
MAD_TO_SIGMA = 1.482602218505602
"""Standard deviation of a normal distribution over its median absolute deviation."""


def filled(
    heights: Array, pixel: tuple[float, float], corner: tuple[float, float] = (0.0, 0.0)
) -> Array:
    """Fill missing points by the solution of Laplace's equation, with z given around each hole.

    Five-point differences; at the edge of the map the normal slope is zero. A plane is harmonic, so
    a hole in a plane that does not touch the edge is filled exactly. Heights (nx, ny) [m], NaN
    where missing; pixel size along x and y, and position of its `corner` on the map as read [m].
    InputError if more than `MAX_MISSING` is missing; it shows where, and which part is good.
    """
    missing = ~np.isfinite(heights)
    count = int(np.count_nonzero(missing))
    if count == 0:
        return heights
    share = count / heights.size
    if share > MAX_MISSING:
        raise InputError(
            f"{count} of {heights.size} heights are missing ({100 * share:.1f} %), more than "
            f"{100 * MAX_MISSING:.0f} %: the friction would depend on the interpolated heights; "
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
    """Name a part of a map that is nearly complete, if any, and show where points are missing."""
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
        absent = 100 * count[i:j, m:n].sum() / area[i:j, m:n].sum()
        of_all = 100 * area[i:j, m:n].sum() / missing.size
        share = f"{of_all:.0f} % of the map, {absent:.1f} % missing"
        text = f"\nexpected: such as {', '.join(part)}: {share}"
    # x to the right, y upwards; a character is about twice as high as wide
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
    """Largest rectangle of blocks with few missing points: x_begin, x_end, y_begin, y_end.

    As indices of blocks, the ends exclusive; None if it is too small a part of the map.
    """
    sums, areas = (np.pad(values.cumsum(0).cumsum(1), ((1, 0), (1, 0))) for values in (count, area))
    best, result = 0.0, None
    for i in range(count.shape[0]):
        for j in range(i + 1, count.shape[0] + 1):
            absent, whole = sums[j] - sums[i], areas[j] - areas[i]
            size = whole[np.newaxis, :] - whole[:, np.newaxis]
            good = absent[np.newaxis, :] - absent[:, np.newaxis] <= GOOD_PART * size
            size = np.where(good, size, 0.0)
            place = int(size.argmax())
            if size.flat[place] > best:
                best, result = float(size.flat[place]), (i, j, *divmod(place, size.shape[1]))
    return result if best >= MIN_PART * area.sum() else None


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
    """Fill missing points with the height of the nearest valid point."""
    missing = ~np.isfinite(heights)
    if not missing.any():
        return heights
    at = scipy.ndimage.distance_transform_edt(missing, return_distances=False, return_indices=True)
    return np.asarray(heights[tuple(at)])


def levelled(heights: Array) -> Array:
    """Return a copy without tilt and curvature, its missing points filled by `nearest`."""
    z = heights.copy()
    level(z, "curvature")
    return nearest(z)


def prominence(heights: Array) -> Array:
    """Absolute distance (nx, ny) of each point from the median around it, over their spread.

    Tilt and curvature are removed, then the median of the surrounding 5 x 5 points is subtracted.
    The spread is the median absolute deviation times 1.4826: the standard deviation of a normal
    distribution, but insensitive to spikes. For normal noise 6e-7 of all points exceed 5, and 1e-15
    exceed 8. Heights (nx, ny) [m]; the result is 0 where they are NaN. InputError if more than half
    of the points equal their median: then the spread is zero.
    """
    missing = ~np.isfinite(heights)
    z = levelled(heights)
    largest = max(float(z.max()), -float(z.min()))
    deviation = np.empty(z.shape)
    for first in range(0, z.shape[0], LINES):
        # a block of lines at a time, with the neighbours that the medians need
        part = z[max(0, first - WINDOW) : first + LINES + WINDOW]
        inner = slice(first - max(0, first - WINDOW), None)
        median = scipy.ndimage.median_filter(part, WINDOW, mode="nearest")[inner][:LINES]
        np.abs(z[first : first + LINES] - median, out=deviation[first : first + LINES])
    del z
    spread = MAD_TO_SIGMA * float(np.median(deviation[~missing], overwrite_input=True))
    # for a plane only rounding errors remain
    if not spread > 1e-12 * largest:
        raise InputError(
            "surface.outliers: at least half of the map is flat to the last digit: there is no "
            "spread to compare spikes with; remove them in the program of the instrument"
        )
    deviation /= spread
    deviation[missing] = 0.0
    return deviation
