# SPDX-License-Identifier: BSD-3-Clause
"""Find artefacts in a prepared scan that are not roughness: form, line offsets, stitching, dust.

Nothing is removed here. A finding states kind, size and position, and the key of a case that
removes it, if there is one. All limits are far beyond the values of self-affine surfaces with or
without a lay.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy

from pyehl import lengths
from pyehl.errors import InputError
from pyehl.surfaces.map_steps import DEGREES, MAD_TO_SIGMA, level
from pyehl.types import Array, Mask

SAMPLES = 512
"""Maximum number of points of a line from which its offset is estimated."""


@dataclass(frozen=True, slots=True)
class Finding:
    """A feature of a map that is not roughness."""

    kind: str  # 'form', 'line offsets', 'stitching step', 'dust', 'spikes'
    text: str  # its description, with size and position
    remedy: str  # option of a case that removes it, 'surface.key=value'; '' if there is none
    # Its areas on the map (x_min, x_max, y_min, y_max) [m]; empty: everywhere
    places: tuple[tuple[float, float, float, float], ...] = ()

    def report(self) -> str:
        """Describe it in one line."""
        return f"{self.kind}: {self.text}" + (f"; {self.remedy}" if self.remedy else "")

    @property
    def summary(self) -> dict[str, object]:
        """Return its entry in ``summary.json``."""
        return {
            "kind": self.kind,
            "text": self.text,
            "remedy": self.remedy or None,
            "places_m": [list(place) for place in self.places],
        }


def line_steps(z: Array, axis: int, parts: int = 1) -> tuple[Array, float]:
    """Median steps (parts, n - 1) from each line to the next along an axis, and the scatter.

    The scatter is that of single steps about the median of their line, as a standard deviation.
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
"""Minimum height of a stitching step over the standard deviation of the steps between lines (from
their median deviation), over the rms of these steps without the `FEW` largest, and over the rms
step between two points."""
PARTS = 4
"""Parts of a line that may each have a stitching step: stitched fields meet in corners."""
DUST = 8.0
"""Minimum height of dust above the median [standard deviations]."""
HIGH = 6.0
"""Minimum height of its top above its surroundings [standard deviations of the rest]."""
SPIKE = 12.0
"""The same for spikes, whose few pixels may reach `HIGH` by chance."""
REMEDY = {"dust": "surface.outliers=6", "spikes": "surface.outliers=8"}
"""Options that remove those that stand out of their neighbourhood."""
MIN_DUST, MAX_DUST = 5, 0.02
"""Minimum number of pixels of a speck of dust (fewer: a spike), largest fraction of the map."""
BLOCK = 32
"""Pixels per side of the blocks; dust is compared with the median of its block."""
MAX_LISTED = 3
"""Number of stitching steps that are reported one by one."""


def stitching(
    z: Array, pixel: tuple[float, float], axis: int, corner: tuple[float, float]
) -> Finding | None:
    """Find steps along a straight line across the map, or a quarter of it.

    Map z (nx, ny), pixel size, and position of its `corner` on the map as read [m]; steps between
    the lines that follow one another along `axis`. None if there are none.
    """
    n = z.shape[1 - axis]
    parts = PARTS if n >= 16 * PARTS else 1
    steps, _ = line_steps(z, axis, parts)
    centred = steps - np.median(steps, axis=1, keepdims=True)
    usual = MAD_TO_SIGMA * float(np.median(np.abs(centred)))
    # plateaus give a narrow distribution of line steps with a broad tail: exclude the largest few
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
    more = f" and {lines.size - MAX_LISTED} more" if lines.size > MAX_LISTED else ""
    text = f"{', '.join(words[:MAX_LISTED])}{more}"
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
    """99th percentile of the modulus, which dust and steps in a part do not affect."""
    return float(np.quantile(np.abs(values), 0.99))


def _one_side(ends: Sequence[float], name: str) -> str:
    """Return the option that crops a map to its longest part between edges and steps."""
    first = max(range(len(ends) - 1), key=lambda k: ends[k + 1] - ends[k])
    low, high = ends[first], ends[first + 1]
    options = [f"surface.crop_{name}_min={low:.6g}"] if low > ends[0] else []
    options += [f"surface.crop_{name}_max={high:.6g}"] if high < ends[-1] else []
    return ", ".join(options)


def dust(z: Array, pixel: tuple[float, float], corner: tuple[float, float]) -> list[Finding]:
    """Find specks of several pixels that stand out, and spikes of fewer pixels.

    Map z (nx, ny), pixel size, and position of its `corner` on the map as read [m].
    """
    specks, spread = _specks(z)
    large, small = ([speck for speck in specks if speck.is_dust == yes] for yes in (True, False))
    return [
        _named(kind, noun, some, spread, pixel, corner)
        for kind, noun, some in (("dust", "speck", large), ("spikes", "spike", small))
        if some
    ]


def dust_points(z: Array, limit: float) -> Mask:
    """Mark dust on a levelled map, with a margin of one pixel.

    Dust are specks of several pixels that stand out by more than `limit` standard deviations.
    """
    points = np.zeros(z.shape, dtype=bool)
    specks, spread = _specks(z)
    for speck in specks:
        if speck.is_dust and speck.height > limit * spread:
            points[speck.box] |= speck.points
    return np.asarray(scipy.ndimage.binary_dilation(points, structure=np.ones((3, 3))))


@dataclass(frozen=True, slots=True)
class _Speck:
    """A group of adjacent raised pixels."""

    height: float  # above its surroundings [m]
    box: tuple[slice, slice]
    points: Mask  # in the box

    @property
    def size(self) -> int:
        return int(np.count_nonzero(self.points))

    @property
    def is_dust(self) -> bool:
        return self.size >= MIN_DUST


def _raised(z: Array) -> tuple[Mask, float]:
    """Pixels that stand out, and the spread of all others [m]; 0: a flat map."""
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
    # for plateaus with valleys the median deviation is much smaller than the rms
    return raised, max(spread, math.sqrt(square / max(1, count)))


def _specks(z: Array) -> tuple[list[_Speck], float]:
    """Group raised pixels into specks that are high and compact, highest first; the spread [m]."""
    raised, spread = _raised(z)
    if not raised.any() or raised.mean() > MAX_DUST:
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
    """Return the finding of the specks of a kind, which are sorted by height."""
    first = specks[0]
    x, y = (
        c + 0.5 * (b.start + b.stop) * p for c, b, p in zip(corner, first.box, pixel, strict=True)
    )
    number = f"{len(specks)} {noun}{'' if len(specks) == 1 else 's'}"
    of = f"of {MIN_DUST} pixels or more" if kind == "dust" else f"of fewer than {MIN_DUST} pixels"
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


MIN_FORM = 0.5
"""Fraction of the variance in a tilt or curvature above which it is reported."""
FOLD = 0.5
"""Change of the slope from edge to edge over that of the form, below which the map is a wave."""
ALIKE = 2.0
"""Largest ratio of the form of half a map to that of the whole map."""
LINE_OFFSETS = 0.5
"""Median step to the next line over the scatter of the steps along the lines, above which lines
are offset. For isotropic surfaces of 128 points it is 0.1 to 0.2."""
INDEPENDENT = -0.25
"""Correlation of successive steps below which lines are offset independently: -0.5 for independent
offsets, 0.5 for the lay of a ground surface with a Hurst exponent of 0.8, -0.24 with 0.3."""


def find(
    heights: Array,
    pixel: tuple[float, float],
    taken: str,
    *,
    periodic: bool,
    corner: tuple[float, float] = (0.0, 0.0),
) -> tuple[Finding, ...]:
    """Find what a map (nx, ny) [m], none missing, has besides roughness.

    Pixel size along x and y [m]; `taken`: the form that was removed; `periodic`: the map is
    repeated as a tile; `corner`: its position on the map as read [m].
    """
    result = [
        _form(heights, pixel, taken, periodic=periodic),
        *(_lines(heights, axis) for axis in (0, 1)),
    ]
    # a form, or offsets of all lines, would hide small artefacts
    rest = heights
    if result[0] is not None:
        rest = heights.copy()
        level(rest, "curvature")
    if result[1] is None and result[2] is None:
        result += [stitching(rest, pixel, axis, corner) for axis in (0, 1)]
    result += dust(rest, pixel, corner)
    return tuple(finding for finding in result if finding is not None)


def _form(z: Array, pixel: tuple[float, float], taken: str, *, periodic: bool) -> Finding | None:
    """Find a tilt or curvature that holds most of the variance."""
    if taken == "curvature":
        return None
    nx, ny = z.shape
    coarse = _coarse(z)
    variance = float(coarse.var())
    if not variance > 0.0:
        return None
    for what in ("tilt", "curvature"):
        if what == taken:
            continue
        rest = coarse.copy()
        try:
            level(rest, what)
        except InputError:
            return None
        form = coarse - rest
        share = float(form.var()) / variance
        if share < MIN_FORM or not _even(coarse, form, what):
            continue
        if periodic and not _folds(coarse, form):
            continue
        rms = float(np.sqrt(form.var()))
        words = f"{what} of {lengths.length(rms)} rms holds {_percent(share)} of the variance"
        if what == "curvature":
            words += _radii(form, (nx * pixel[0], ny * pixel[1]))
        return Finding("form", words, f"surface.detrend={what}")
    return None


def _coarse(z: Array) -> Array:
    """Return the means over blocks of a large map."""
    a, b = (max(1, n // SAMPLES) for n in z.shape)
    z = z[: z.shape[0] // a * a, : z.shape[1] // b * b]
    return np.asarray(z.reshape(z.shape[0] // a, a, z.shape[1] // b, b).mean(axis=(1, 3)))


def _even(z: Array, form: Array, what: str) -> bool:
    """Whether both halves of a map have the form of the whole map, unlike those of a wave."""
    degree = DEGREES[what]
    for axis in (0, 1):
        across, bare = z.mean(axis=1 - axis), form.mean(axis=1 - axis)
        n = across.size
        if n < 4 * degree + 4 or float(np.ptp(bare)) < 0.25 * float(np.ptp(form)):
            continue
        x = np.linspace(-1.0, 1.0, n)
        whole = float(np.polyfit(x, bare, degree)[0])
        halves = [np.polyfit(x[k], across[k], degree)[0] for k in (slice(n // 2), slice(n // 2, n))]
        if not all(1.0 / ALIKE < float(half) / whole < ALIKE for half in halves):
            return False
    return True


def _folds(z: Array, form: Array) -> bool:
    """Whether a repeated map has a fold or step at its edges, unlike a wave."""
    for axis in (0, 1):
        across, bare = z.mean(axis=1 - axis), form.mean(axis=1 - axis)
        n = across.size
        part = max(2, n // 8)
        x = np.arange(part)
        ends = [
            (np.polyfit(x, line[:part], 1), np.polyfit(x + n - part, line[-part:], 1))
            for line in (across, bare)
        ]
        slopes = [first[0] - last[0] for first, last in ends]
        steps = [last[1] + last[0] * n - first[1] for first, last in ends]
        size = float(np.ptp(bare))
        if size > 0.0 and (
            (abs(slopes[1]) * n > size and slopes[0] / slopes[1] > FOLD)
            or (abs(steps[1]) > FOLD * size and steps[0] / steps[1] > FOLD)
        ):
            return True
    return False


def _radii(form: Array, size: tuple[float, float]) -> str:
    """Radii of curvature of a form along x and y."""
    words = []
    for axis, name in ((0, "x"), (1, "y")):
        line = form.mean(axis=1 - axis)
        mid = line.size // 2
        step = size[axis] / line.size
        bend = float(line[mid + 1] - 2.0 * line[mid] + line[mid - 1]) / step**2
        if abs(bend) > 1e-4:  # a radius above 10 km is no curvature
            words.append(f"{_radius(-1.0 / bend)} along {name}")
    return f": radius {', '.join(words)}" if words else ""


def _radius(value: float) -> str:
    return f"{value * 1e3:.3g} mm" if abs(value) < 1.0 else f"{value:.3g} m"


def _percent(share: float) -> str:
    return f"{100.0 * share:.1f} %" if share < 0.9995 else "nearly all"


def _lines(z: Array, axis: int) -> Finding | None:
    """Find height offsets between scan lines, which run along the other axis."""
    (steps,), scatter = line_steps(z, axis)
    size = float(np.sqrt(np.mean(np.square(steps))))
    if steps.size < 8 or not size > LINE_OFFSETS * scatter or not size > 0.0:
        return None
    # a few large steps are stitching
    usual = MAD_TO_SIGMA * float(np.median(np.abs(steps)))
    if not usual > LINE_OFFSETS * scatter:
        return None
    about = steps - steps.mean()
    square = float(np.dot(about, about))
    if not square > 0.0 or float(np.dot(about[:-1], about[1:])) / square > INDEPENDENT:
        return None
    along = "yx"[axis]
    words = f"lines along {along} are offset by {lengths.length(size / math.sqrt(2.0))} rms"
    if scatter > 0.0:
        words += f"; steps between lines are {size / scatter:.1f} times those of the surface"
    return Finding("line offsets", words, f"surface.align_lines={along}")
