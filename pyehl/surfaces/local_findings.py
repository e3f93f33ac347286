# SPDX-License-Identifier: BSD-3-Clause
"""What a finding about a map is; stitching steps across a map, and specks of dust on it."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy

from pyehl import lengths
from pyehl.surfaces.defects import MAD_TO_SIGMA
from pyehl.types import Array, Mask

SAMPLES = 512
"""Points of a line, at the most, that its offset is found by."""


@dataclass(frozen=True, slots=True)
class Finding:
    """One thing that is no roughness."""

    kind: str  # 'form', 'line offsets', 'stitching step', 'dust', 'spikes'
    text: str  # what it is, how large and where
    remedy: str  # option of a case that takes it off, 'surface.key=value'; '' if there is none
    # Where it is on the map (x_min, x_max, y_min, y_max) [m]; empty: everywhere
    places: tuple[tuple[float, float, float, float], ...] = ()

    def report(self) -> str:
        """Describe it in one line."""
        return f"{self.kind}: {self.text}" + (f"; {self.remedy}" if self.remedy else "")

    @property
    def summary(self) -> dict[str, object]:
        """Return what ``summary.json`` holds of it."""
        return {
            "kind": self.kind,
            "text": self.text,
            "remedy": self.remedy or None,
            "places_m": [list(place) for place in self.places],
        }


def line_steps(z: Array, axis: int, parts: int = 1) -> tuple[Array, float]:
    """Median steps (parts, n - 1) from a line to the next along an axis, and their scatter.

    The scatter of single steps about the median of their line, as a standard deviation.
    """
    lines = np.moveaxis(z, axis, 0)
    steps, deviations = [], []
    for k in range(parts):
        a, b = k * lines.shape[1] // parts, (k + 1) * lines.shape[1] // parts
        part = lines[:, a : b : max(1, (b - a) // SAMPLES)]
        difference = np.diff(part, axis=0)
        median = np.median(difference, axis=1)
        steps.append(median)
        deviations.append(np.median(np.abs(difference - median[:, np.newaxis])))
    return np.array(steps), MAD_TO_SIGMA * float(np.median(deviations))


STEP, BROAD, ABOVE, FEW = 12.0, 6.0, 3.0, 4
"""A stitching step is so many times as high as the median step between two lines, as their rms but
for the largest few, and as the rms step between two points."""
PARTS = 4
"""Parts of a line that may have a stitching step each: stitched fields meet in corners."""
DUST = 8.0
"""Dust stands out so many standard deviations, by the median."""
HIGH = 6.0
"""And its top so many above what is around it, by all that is no dust."""
SPIKE = 12.0
"""The same of spikes, which are few pixels and can be so by chance."""
REMEDY = {"dust": "surface.outliers=6", "spikes": "surface.outliers=8"}
"""Take off what of these stands out of its neighbourhood."""
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


def dust(z: Array, pixel: tuple[float, float], corner: tuple[float, float]) -> list[Finding]:
    """Specks of several pixels that stand out, and spikes of fewer."""
    specks, spread = _specks(z)
    large, small = ([speck for speck in specks if speck.is_dust == yes] for yes in (True, False))
    return [
        _named(kind, noun, some, spread, pixel, corner)
        for kind, noun, some in (("dust", "speck", large), ("spikes", "spike", small))
        if some
    ]


def dust_points(z: Array, limit: float) -> Mask:
    """Where on a levelled map specks of several pixels are, with a rim of one pixel.

    Those that stand out by more than `limit` standard deviations.
    """
    points = np.zeros(z.shape, dtype=bool)
    specks, spread = _specks(z)
    for speck in specks:
        if speck.is_dust and speck.height > limit * spread:
            points[speck.box] |= speck.points
    return np.asarray(scipy.ndimage.binary_dilation(points, structure=np.ones((3, 3))))


@dataclass(frozen=True, slots=True)
class _Speck:
    """Pixels that touch each other and stand out."""

    height: float  # above what is around it [m]
    box: tuple[slice, slice]
    points: Mask  # in the box

    @property
    def size(self) -> int:
        return int(np.count_nonzero(self.points))

    @property
    def is_dust(self) -> bool:
        return self.size >= LEAST_DUST


def _raised(z: Array) -> tuple[Mask, float]:
    """Pixels that stand out, and the spread of all others [m]; 0: there is none."""
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
        return raised, 0.0
    count, square = 0, 0.0
    for i, j, median in tops:
        block = slice(i, i + BLOCK), slice(j, j + BLOCK)
        raised[block] = z[block] - median > DUST * spread
        rest = z[block][~raised[block]] - median
        count, square = count + rest.size, square + float(np.dot(rest, rest))
    # plateaus with valleys are narrow in the median and broad otherwise
    return raised, max(spread, math.sqrt(square / max(1, count)))


def _specks(z: Array) -> tuple[list[_Speck], float]:
    """Group raised pixels that are high enough and not long, highest first; the spread [m]."""
    raised, spread = _raised(z)
    if not raised.any() or raised.mean() > MOST_DUST:
        return [], spread
    label, _ = scipy.ndimage.label(raised, structure=np.ones((3, 3)))
    specks = []
    for k, box in enumerate(scipy.ndimage.find_objects(label), 1):
        sides = [s.stop - s.start for s in box]
        around = z[tuple(slice(max(0, s.start - 3), s.stop + 3) for s in box)]
        speck = _Speck(float(z[box].max()) - float(np.median(around)), box, label[box] == k)
        limit = HIGH if speck.is_dust else SPIKE
        if max(sides) <= 5 * min(sides) and speck.height > limit * spread:
            specks.append(speck)
    return sorted(specks, key=lambda speck: -speck.height), spread


def _named(
    kind: str,
    noun: str,
    specks: Sequence[_Speck],
    spread: float,
    pixel: tuple[float, float],
    corner: tuple[float, float],
) -> Finding:
    """Describe of specks, the highest first."""
    first = specks[0]
    x, y = (
        c + 0.5 * (b.start + b.stop) * p for c, b, p in zip(corner, first.box, pixel, strict=True)
    )
    number = f"{len(specks)} {noun}{'' if len(specks) == 1 else 's'}"
    of = f"of {LEAST_DUST} pixels or more" if kind == "dust" else "of fewer pixels than dust has"
    text = (
        f"{number} {of}, the highest {lengths.length(first.height)} "
        f"({first.height / spread:.0f} standard deviations) on {first.size} "
        f"pixel{'' if first.size == 1 else 's'} at "
        f"x = {lengths.length(x, 4)}, y = {lengths.length(y, 4)}"
    )
    places = tuple(
        (
            *(corner[0] + end * pixel[0] for end in (bx.start, bx.stop)),
            *(corner[1] + end * pixel[1] for end in (by.start, by.stop)),
        )
        for bx, by in (speck.box for speck in specks)
    )
    return Finding(kind, text, REMEDY[kind], places)
