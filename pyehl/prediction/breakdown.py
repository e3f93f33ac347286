# SPDX-License-Identifier: BSD-3-Clause
"""Where the film of rough surfaces ends.

With a measured surface some pixel nearly always touches. This is reported with its place, its
height and its share of the contact, and the film is never clipped.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from pyehl.prediction.model import Model
from pyehl.prediction.relative_positions import RelativePositions
from pyehl.prediction.response import FILM_ENDS
from pyehl.surfaces.tile import Topography
from pyehl.types import Array, Indices

Sustained = Callable[[Array, Array], Array]
"""Deformed roughness that the smooth film sustains [m] at x (m,) and y (n,) [m] from the centre of
the contact, (m, n): where it is higher the film ends."""

PLACES = 64
"""Places along a row at which the smooth film is taken: 1/32 a apart, where its slope makes a
difference far below the error of the film."""


def sustained_by(model: Model) -> Sustained:
    """Deformed roughness at which the film of a model ends."""
    ends = FILM_ENDS if model.options.reduction == "response" else 1.0
    a, film_unit = model.operating.hertz_radius, model.operating.film_scale

    def sustained(x: Array, y: Array) -> Array:
        return model.contact.at(x / a, y / a)[1] * film_unit * ends

    return sustained


@dataclass(frozen=True, slots=True)
class BelowZero:
    """Where the film of one or two tiles ends."""

    # Mean share of the Hertz area where it has ended, over a whole passage [-]
    share: float
    # Least of what the film sustains less the deformed roughness [m], not positive where it ends
    deepest: float
    pixels: tuple[tuple[int, int], ...]  # (i, j) of each tile where it is
    # Pixels of one tile that pass through the contact and end the film; of two: not counted
    count: int | None = None


def below_zero(
    tiles: Sequence[Topography],
    deformed: Sequence[Array],
    semi_axes: tuple[float, float],
    sustained: Sustained,
) -> BelowZero:
    """Find the minimum film over tiles, in the strip that passes through the contact.

    Every pixel of a tile within b of the track passes through the contact at some time, along its
    row, and meets the minimum smooth film of that row, and the highest point of the other tile on
    it. The deformed roughness (nx, ny) [m], row 0 through the centre, is taken to be that at the
    centre on the whole way. Semi-axes a and b of the contact in m, b infinite of a line. The share
    is that of one tile, NaN of two: it needs the positions of a prediction.
    """
    a, b = semi_axes
    smooth, columns = _strip(tiles, a, b, sustained)
    tops = [values.max(axis=0)[column] for values, column in zip(deformed, columns, strict=True)]
    minimum = smooth.min(axis=0)
    for top in tops:
        minimum = minimum - top
    worst = int(np.argmin(minimum))
    pixels = tuple(
        (int(np.argmax(values[:, column[worst]])), int(column[worst]))
        for values, column in zip(deformed, columns, strict=True)
    )
    result = BelowZero(math.nan, float(minimum[worst]), pixels)
    if len(tiles) > 1:
        return result
    share, count = _beyond(deformed[0], columns[0], smooth, minimum < 0.0)
    return replace(result, share=share, count=count)


def _strip(
    tiles: Sequence[Topography], a: float, b: float, sustained: Sustained
) -> tuple[Array, list[Indices]]:
    """Give what the smooth film sustains on the rows of the contact (n, m) [m], inf outside of it.

    And the column of each tile (m,) on the rows, which are as far apart as the finest pixels.
    """
    pixel = min(tile.pixel[1] for tile in tiles)
    if math.isinf(b):
        rows = np.arange(round(max(tile.length_y for tile in tiles) / pixel))
    else:
        rows = np.arange(-int(b / pixel), int(b / pixel) + 1)
    y = np.asarray(rows * pixel, dtype=float)
    x: Array = a * ((2.0 * np.arange(PLACES) + 1.0) / PLACES - 1.0)
    inside = np.hypot(x[:, np.newaxis], y[np.newaxis, :] * (a / b)) < a
    columns = [np.rint(y / tile.pixel[1]).astype(int) % tile.shape[1] for tile in tiles]
    return np.where(inside, sustained(x, y), np.inf), columns


def _beyond(deformed: Array, column: Indices, smooth: Array, ended: Array) -> tuple[float, int]:
    """Mean share of the contact in which one tile ends the film, and the pixels that do so."""
    inside, below = np.isfinite(smooth), 0
    # a pixel may pass through the contact on several rows of a small tile
    limit = np.full(deformed.shape[1], np.inf)
    np.minimum.at(limit, column, smooth.min(axis=0))
    for k in np.nonzero(ended)[0]:
        heights = np.sort(deformed[:, column[k]])
        at = np.searchsorted(heights, smooth[inside[:, k], k], side="right")
        below += int((heights.size - at).sum())
    share = below / (deformed.shape[0] * int(inside.sum()))
    return share, int(np.count_nonzero(deformed > limit[np.newaxis, :]))


def of_model(model: Model, deformed: Sequence[Array], sustained: Sustained) -> BelowZero:
    """Find where the film of a model ends; of two surfaces over all their relative positions."""
    tiles, semi_axes = [one.topography for one in model.surfaces], model.operating.semi_axes
    result = below_zero(tiles, deformed, semi_axes, sustained)
    if len(tiles) == 1 or result.deepest > 0.0:
        return result
    positions = model.relative_positions
    if positions.passages is None:
        return result
    return _in_common_period(model, positions, deformed, sustained)


def _in_common_period(
    model: Model, positions: RelativePositions, deformed: Sequence[Array], sustained: Sustained
) -> BelowZero:
    """Find the minimum film of two surfaces over a common period, by steps of a pixel."""
    tiles, (a, b) = [one.topography for one in model.surfaces], model.operating.semi_axes
    smooth, columns = _strip(tiles, a, b, sustained)
    x = (2.0 * np.arange(PLACES) + 1.0) / PLACES - 1.0
    heights = [values[:, column] for values, column in zip(deformed, columns, strict=True)]
    pixels = [tile.pixel[0] / a for tile in tiles]
    period = max(
        passages * length / u
        for passages, length, u in zip(
            positions.passages or (), positions.lengths, positions.velocity_ratios, strict=True
        )
        if u > 0.0
    )
    steps = math.ceil(period * max(positions.velocity_ratios) / min(pixels))
    result = BelowZero(math.nan, math.inf, ((0, 0), (0, 0)))
    for k in range(steps):
        shifts = positions.shifts(k, steps)
        rows = [
            np.rint((x - shifts[model.order.index(i)]) / pixels[i]).astype(int)
            % heights[i].shape[0]
            for i in (0, 1)
        ]
        film = smooth - heights[0][rows[0]] - heights[1][rows[1]]
        place = int(film.argmin())
        if film.flat[place] < result.deepest:
            i, j = divmod(place, film.shape[1])
            at = tuple(
                (int(row[i]), int(column[j])) for row, column in zip(rows, columns, strict=True)
            )
            result = BelowZero(math.nan, float(film[i, j]), at)
    return result
