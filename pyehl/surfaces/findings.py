# SPDX-License-Identifier: BSD-3-Clause
"""What a prepared scan has that is no roughness: form, offset lines, stitching steps, dust.

Nothing is taken off here. A finding names what it is, how large, where, and the key of a case that
takes it off, where there is one. Every limit lies far beyond what self-affine surfaces with or
without a lay show.
"""

import math

import numpy as np

from pyehl import lengths
from pyehl.errors import InputError
from pyehl.surfaces.defects import MAD_TO_SIGMA
from pyehl.surfaces.local_findings import SAMPLES, Finding, dust, line_steps, stitching
from pyehl.surfaces.map_steps import DEGREES, level
from pyehl.types import Array

MOST_FORM = 0.5
"""Share of the variance in a polynomial of degree 2 from which on it is named."""
FOLD = 0.5
"""Change of the slope from edge to edge, as a share of that of the form: less is a wave."""
ALIKE = 2.0
"""Most by which the form of half a map differs from that of all of it."""
LINE_OFFSETS = 0.5
"""Median step to the next line over the scatter of the steps along the lines, from which on lines
are offset. Of isotropic surfaces of 128 points it is 0.1 to 0.2."""
INDEPENDENT = -0.25
"""Correlation of a step with the next one below which lines are offset each by itself: -0.5 for
independent offsets, 0.5 for the lay of a ground surface (Hurst exponent 0.8), -0.24 for 0.3."""


def find(
    heights: Array,
    pixel: tuple[float, float],
    taken: str,
    *,
    periodic: bool,
    corner: tuple[float, float] = (0.0, 0.0),
) -> tuple[Finding, ...]:
    """Find what a map (nx, ny) [m], none missing, has besides roughness.

    Pixel size along x and y [m]; `taken`: the form that was taken off; `periodic`: the map counts
    as a tile that can be repeated; `corner`: where it lies on the map as read [m].
    """
    found = [
        _form(heights, pixel, taken, periodic=periodic),
        *(_lines(heights, axis) for axis in (0, 1)),
    ]
    # a form, or offsets of all lines, would hide what is small
    rest = heights
    if found[0] is not None:
        rest = heights.copy()
        level(rest, "curvature")
    if found[1] is None and found[2] is None:
        found += [stitching(rest, pixel, axis, corner) for axis in (0, 1)]
    found += dust(rest, pixel, corner)
    return tuple(finding for finding in found if finding is not None)


def _form(z: Array, pixel: tuple[float, float], taken: str, *, periodic: bool) -> Finding | None:
    """Tilt or curvature that hold most of the variance."""
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
        if share < MOST_FORM or not _even(coarse, form, what):
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
    """Means over blocks of a large map."""
    a, b = (max(1, n // SAMPLES) for n in z.shape)
    z = z[: z.shape[0] // a * a, : z.shape[1] // b * b]
    return np.asarray(z.reshape(z.shape[0] // a, a, z.shape[1] // b, b).mean(axis=(1, 3)))


def _even(z: Array, form: Array, what: str) -> bool:
    """Whether both halves of a map have the form of the whole, as a long wave has not."""
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
    """Whether a map that is repeated has an edge where its form ends, as a wave has not."""
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
        if abs(bend) > 1e-4:  # a radius of 10 km is none
            words.append(f"{_radius(-1.0 / bend)} along {name}")
    return f": radius {', '.join(words)}" if words else ""


def _radius(value: float) -> str:
    return f"{value * 1e3:.3g} mm" if abs(value) < 1.0 else f"{value:.3g} m"


def _percent(share: float) -> str:
    return f"{100.0 * share:.1f} %" if share < 0.9995 else "nearly all"


def _lines(z: Array, axis: int) -> Finding | None:
    """Lines that lie at heights of their own: of a scan along the other axis."""
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
    words = f"lines along {along} lie {lengths.length(size / math.sqrt(2.0))} rms above or below "
    words += "each other"
    if scatter > 0.0:
        words += f", {size / scatter:.1f} times what the surface changes from one to the next"
    return Finding("line offsets", words, f"surface.align_lines={along}")
