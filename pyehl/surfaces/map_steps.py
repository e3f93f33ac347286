# SPDX-License-Identifier: BSD-3-Clause
"""Steps of a preparation that need nothing but the map: cut, turn, level, fill, join its edges.

A tile is repeated over and over. Where opposite edges of a map do not match, the heights jump, a
step of infinite slope that the surface does not have, and at which the film breaks down.

Missing points are filled by the smoothest surface that meets their edges. Spikes stand out of their
neighbourhood: optical instruments give single pixels or small groups of them that lie micrometres
off, at steep slopes and specks of dirt, and one of them is enough for film breakdown.
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
"""Lines of a map that are processed at a time."""

MARGIN = 12
"""Pixels around a map that repeat its edge, whose effect on splines falls by a factor of 3.7 a
pixel."""


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
    """Map (nx, ny), none missing, turned about its middle, counter-clockwise seen from above.

    What pointed along x points in the direction `angle` [degrees] afterwards: a lay along x turned
    by 90 degrees lies across the motion. Quarter turns move pixels and change nothing else; any
    other angle interpolates (cubic splines) and keeps the largest upright rectangle inside the
    turned map, so that no heights from outside the map are needed. Its pixels [m] are then square,
    the smaller of the two sizes.
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


DEGREES = {"centre": 0, "tilt": 1, "curvature": 2}
"""Total degree of the polynomial in x and y that each value of detrend removes."""


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

    The median height of each line above the plane of the map becomes 0. Points that are NaN stay
    so. The part of the surface itself in its line medians is removed with the offsets: waves across
    the lines that are as long as a line.
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
    """Remove the mean (`centre`), plane (`tilt`) or `curvature` of a map in place.

    A least-squares polynomial over the points that count (`valid`; default: all that are numbers);
    missing points stay missing. InputError if too few points are left to determine the polynomial.
    """
    # the large parts are removed first, so that the rounding error is that of the remainder
    for degree in sorted({0, DEGREES[what]}):
        x, coefficient, y = _factors(heights, degree, valid)
        lines = coefficient @ y.T
        for first in range(0, heights.shape[0], LINES):
            part = slice(first, first + LINES)
            for power, line in zip(x[part].T, lines, strict=True):
                heights[part] -= power[:, np.newaxis] * line


RIM = 0.1
"""Share of each side over which 'window' tapers the heights."""


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
    """Map tapered to its mean along its margin by a raised cosine over a tenth of each side.

    The inner part does not change; the margin loses roughness, so that the rms falls.
    """
    half = heights.shape[1] // 2
    mean = float(heights.mean())
    tile = np.roll(heights, -half, axis=1)
    tile -= mean
    tile *= _taper(heights.shape[0])[:, np.newaxis]
    tile *= np.roll(_taper(heights.shape[1]), -half)
    tile += mean
    return tile


def margin(shape: tuple[int, int]) -> int:
    """Points (nx, ny) of a map that `windowed` tapers."""
    inside = [int(np.count_nonzero(_taper(n) == 1.0)) for n in shape]
    return shape[0] * shape[1] - inside[0] * inside[1]


def _taper(n: int) -> Array:
    """Tukey window of n points, zero half a pixel outside of both ends."""
    distance = (np.minimum(np.arange(n), np.arange(n)[::-1]) + 0.5) / n
    return np.where(distance < RIM, 0.5 - 0.5 * np.cos(np.pi * distance / RIM), 1.0)


def jump(heights: Array) -> float:
    """Rms step across the seams of a tile over the rms step between neighbours inside.

    About 1 for a periodic surface, far more for a map that is not periodic.
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


MAX_MISSING = 0.1
"""Largest share of a map that may be filled: beyond it the interpolated heights determine the
friction."""

GOOD_BLOCKS, GOOD_PART, MIN_PART = 48, 0.02, 0.1
"""Blocks per side in the search for a good part of a map, the share that may be missing in it, and
its least share of the map."""
SHOWN_COLUMNS, SHOWN_ROWS = 48, 20
"""Most columns and lines of the sketch of missing points."""

DIRECT_POINTS = 50_000
TOLERANCE = 1e-10
WINDOW = 5
"""Pixels per side of the median that a point is compared with."""
MAD_TO_SIGMA = 1.482602218505602
"""Standard deviation of a normal distribution over its median absolute deviation."""


def filled(
    heights: Array, pixel: tuple[float, float], corner: tuple[float, float] = (0.0, 0.0)
) -> Array:
    """Map whose missing points are harmonic: Laplace z = 0, z given on the edge of each hole.

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
    best, result = 0.0, None
    for i in range(count.shape[0]):
        for j in range(i + 1, count.shape[0] + 1):
            lost, whole = sums[j] - sums[i], areas[j] - areas[i]
            size = whole[np.newaxis, :] - whole[:, np.newaxis]
            few = lost[np.newaxis, :] - lost[:, np.newaxis] <= GOOD_PART * size
            size = np.where(few, size, 0.0)
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
    # the remainder of a plane is rounding error
    if not spread > 1e-12 * largest:
        raise InputError(
            "surface.outliers: half of the map or more is flat to the last digit, so that there "
            "is no spread to find spikes by; remove them in the program of the instrument"
        )
    above /= spread
    above[missing] = 0.0
    return above
