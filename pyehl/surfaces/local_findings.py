# SPDX-License-Identifier: BSD-3-Clause
"""Stitching steps across a map, and specks of dust on it."""

import math
from collections.abc import Sequence

import numpy as np
import scipy

from pyehl import lengths
from pyehl.surfaces.finding import SAMPLES, Finding, line_steps
from pyehl.surfaces.holes import MAD_TO_SIGMA
from pyehl.types import Array, Mask

STEP, BROAD, ABOVE, FEW = 12.0, 6.0, 3.0, 4
"""A stitching step is so many times as high as the median step between two lines, as their rms but
for the largest few, and as the rms step between two points."""
PARTS = 4
"""Parts of a line that may have a stitching step each: stitched fields meet in corners."""
DUST = 8.0
"""Dust stands out so many standard deviations, by the median."""
HIGH = 6.0
"""And its top so many above what is around it, by all that is no dust."""
LEAST_DUST, MOST_DUST = 5, 0.02
"""Pixels of a speck of dust at the least; fewer are spikes. Share of the map at the most."""
BLOCK = 32
"""Pixels per side of the squares whose median dust is compared with."""
MOST_NAMED = 3
"""Steps and specks that are named one by one."""


def stitching(
    z: Array, pixel: tuple[float, float], axis: int, corner: tuple[float, float]
) -> Finding | None:
    """Find steps along a straight line across the map, or a quarter of it."""
    n = z.shape[1 - axis]
    parts = PARTS if n >= 16 * PARTS else 1
    steps, _ = line_steps(z, axis, parts)
    centred = steps - np.median(steps, axis=1, keepdims=True)
    usual = MAD_TO_SIGMA * float(np.median(np.abs(centred)))
    # surfaces with plateaus have few large steps between lines, which are broad otherwise
    few = np.sort(np.abs(centred), axis=1)[:, : -min(FEW, steps.shape[1] // 4) or None]
    limit = max(STEP * usual, BROAD * float(np.sqrt(np.mean(few**2))), ABOVE * _rms_step(z, axis))
    high = np.abs(centred) > limit
    lines = np.nonzero(high.any(axis=0))[0]
    if not limit > 0.0 or not lines.size or lines.size > max(4, steps.shape[1] // 32):
        return None
    name, size, width = "xy"[axis], pixel[axis], z.shape[1 - axis] * pixel[1 - axis] / parts
    lines = np.array(sorted(lines, key=lambda j: -np.abs(centred[:, j]).max()))
    words, places = [], []
    for j in lines:
        k = int(np.argmax(np.abs(centred[:, j])))
        at = corner[axis] + (j + 1) * size
        words.append(f"{lengths.length(abs(float(centred[k, j])))} at {name} = "
                     f"{lengths.length(at, 4)}")  # fmt: skip
        for part in np.nonzero(high[:, j])[0]:
            ends = [corner[1 - axis] + (part + side) * width for side in (0, 1)]
            places.append((at, at, *ends) if axis == 0 else (*ends, at, at))
    more = f" and {lines.size - MOST_NAMED} more" if lines.size > MOST_NAMED else ""
    text = f"{', '.join(words[:MOST_NAMED])}{more}"
    cuts = sorted(corner[axis] + (int(j) + 1) * size for j in lines)
    crop = _one_side((corner[axis], *cuts, corner[axis] + z.shape[axis] * size), name)
    return Finding("stitching step", text, crop, tuple(places))


def _rms_step(z: Array, axis: int) -> float:
    """Rms step between points on neighbouring lines about the median of these steps."""
    lines = np.moveaxis(z, axis, 0)
    difference = np.diff(lines[:, :: max(1, lines.shape[1] // SAMPLES)], axis=0)
    difference -= np.median(difference, axis=1)[:, np.newaxis]
    return float(np.sqrt(np.mean(np.minimum(np.abs(difference), _top(difference)) ** 2)))


def _top(values: Array) -> float:
    """Value that one of a hundred exceeds by its modulus: dust and steps of a part do not count."""
    return float(np.quantile(np.abs(values), 0.99))


def _one_side(ends: Sequence[float], name: str) -> str:
    """Option that leaves the longest part between the ends of a map and steps."""
    first = max(range(len(ends) - 1), key=lambda k: ends[k + 1] - ends[k])
    low, high = ends[first], ends[first + 1]
    options = [f"surface.crop_{name}_min={low:.6g}"] if low > ends[0] else []
    options += [f"surface.crop_{name}_max={high:.6g}"] if high < ends[-1] else []
    return ", ".join(options)


def dust(z: Array, pixel: tuple[float, float], corner: tuple[float, float]) -> Finding | None:
    """Specks of several pixels that stand out."""
    nx, ny = z.shape
    raised = np.zeros(z.shape, dtype=bool)
    spreads, tops = [], []
    for i in range(0, nx, BLOCK):
        for j in range(0, ny, BLOCK):
            part = z[i : i + BLOCK, j : j + BLOCK]
            median = float(np.median(part))
            spreads.append(float(np.median(np.abs(part - median))))
            tops.append((i, j, median))
    spread = MAD_TO_SIGMA * float(np.median(spreads))
    if not spread > 0.0:
        return None
    count, square = 0, 0.0
    for i, j, median in tops:
        block = slice(i, i + BLOCK), slice(j, j + BLOCK)
        raised[block] = z[block] - median > DUST * spread
        rest = z[block][~raised[block]] - median
        count, square = count + rest.size, square + float(np.dot(rest, rest))
    # plateaus with valleys are narrow in the median and broad otherwise
    return _specks(z, raised, max(spread, math.sqrt(square / max(1, count))), pixel, corner)


def _specks(
    z: Array,
    raised: Mask,
    spread: float,
    pixel: tuple[float, float],
    corner: tuple[float, float],
) -> Finding | None:
    """Name the groups of raised pixels that are large enough and not long."""
    if not raised.any() or raised.mean() > MOST_DUST:
        return None
    label, count = scipy.ndimage.label(raised, structure=np.ones((3, 3)))
    sizes = np.bincount(label.ravel(), minlength=count + 1)
    specks = []
    for k, box in enumerate(scipy.ndimage.find_objects(label), 1):
        sides = [s.stop - s.start for s in box]
        if sizes[k] >= LEAST_DUST and max(sides) <= 5 * min(sides):
            around = z[tuple(slice(max(0, s.start - 3), s.stop + 3) for s in box)]
            height = float(z[box].max()) - float(np.median(around))
            if height > HIGH * spread:
                specks.append((height, int(sizes[k]), box))
    if not specks:
        return None
    specks.sort(key=lambda speck: -speck[0])
    height, size, (bx, by) = specks[0]
    x, y = (
        c + 0.5 * (b.start + b.stop) * p for c, b, p in zip(corner, (bx, by), pixel, strict=True)
    )
    number = "1 speck" if len(specks) == 1 else f"{len(specks)} specks"
    text = (
        f"{number} of {LEAST_DUST} pixels or more, the highest {lengths.length(height)} "
        f"({height / spread:.0f} standard deviations) on {size} pixels at "
        f"x = {lengths.length(x, 4)}, y = {lengths.length(y, 4)}"
    )
    places = tuple(
        (
            *(corner[0] + end * pixel[0] for end in (bx.start, bx.stop)),
            *(corner[1] + end * pixel[1] for end in (by.start, by.stop)),
        )
        for _, _, (bx, by) in specks
    )
    return Finding("dust", text, "", places)
