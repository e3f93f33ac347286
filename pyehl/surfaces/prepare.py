# SPDX-License-Identifier: BSD-3-Clause
"""From a map as measured to a tile that can pass through a contact, one recorded step at a time.

The order is fixed: crop, sign, outliers, fill, detrend, rotate, edges. Spikes go before the plane
is fitted, which they would tilt, and holes before the map is turned; the edges are joined last.
What 'auto' means depends on what the file is, see :func:`defaults`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pyehl.surfaces import areal, cutting, holes, levelling, seams, spikes
from pyehl.surfaces.memory import check_pixels
from pyehl.surfaces.reading import Scan

__all__ = ["NEUTRAL", "Options", "Preparation", "Step", "defaults", "prepare"]

Array = NDArray[np.float64]

RMS_BAND = (1e-10, 1e-4)
"""Rms heights outside of it [m] are mistakes of units."""

JUMP = 3.0
"""A seam whose steps are more than this many times those inside is named in the record."""


@dataclass(frozen=True, slots=True)
class Options:
    """What to do with a map; each attribute is a key of ``&surface``.

    Attributes
    ----------
    detrend
        ``"none"``, ``"centre"``, ``"tilt"``, ``"curvature"`` or ``"auto"``.
    fill
        ``"harmonic"`` or ``"none"``, which refuses maps with missing points.
    outliers
        Threshold, see :func:`pyehl.surfaces.spikes.prominence`; 0: none are removed.
    edges
        ``"mirror"``, ``"window"``, ``"periodic"`` or ``"auto"``.
    crop
        (x_min, x_max, y_min, y_max) [m], a maximum of 0 being the far edge.
    rotate
        Counter-clockwise [degrees].
    sign
        1, or -1 for a map whose valleys are positive.
    """

    detrend: str = "auto"
    fill: str = "harmonic"
    outliers: float = 0.0
    edges: str = "auto"
    crop: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)
    rotate: float = 0.0
    sign: int = 1

    @classmethod
    def from_settings(cls, surface: Mapping[str, Any]) -> Options:
        """Options of the group ``surface`` of a resolved case; absent keys have their defaults."""
        bounds = ("crop_x_min", "crop_x_max", "crop_y_min", "crop_y_max")
        return cls(
            detrend=str(surface.get("detrend", "auto")),
            fill=str(surface.get("fill", "harmonic")),
            outliers=float(surface.get("outliers", 0.0)),
            edges=str(surface.get("edges", "auto")),
            crop=tuple(float(surface.get(key, 0.0)) for key in bounds),  # type: ignore[arg-type]
            rotate=float(surface.get("rotate", 0.0)),
            sign=int(surface.get("sign", 1)),
        )


NEUTRAL = Options()
"""With these an array passes through as it is, its mean removed."""


@dataclass(frozen=True, slots=True)
class Step:
    """One step of a preparation.

    Attributes
    ----------
    name, value
        Key of ``&surface`` and what it was.
    why
        Why it was so, in words: 'given', or the reason of the default.
    changed
        Points that were removed, filled or altered; 0 where all are, evenly.
    before, after
        How rough the map was and is.
    note
        What a person should know besides; mostly empty.
    """

    name: str
    value: str
    why: str
    changed: int
    before: areal.Extent
    after: areal.Extent
    note: str = ""

    def summary(self) -> dict[str, Any]:
        """Return what ``summary.json`` holds of it."""
        return {
            "key": f"surface.{self.name}",
            "value": self.value,
            "why": self.why,
            "points_changed": self.changed,
            "note": self.note or None,
        } | {
            f"{name}_{when}{unit}": getattr(extent, name)
            for when, extent in (("before", self.before), ("after", self.after))
            for name, unit in (("rms", "_m"), ("peak", "_m"), ("slope", ""))
        }


@dataclass(frozen=True, slots=True)
class Preparation:
    """How a tile came about.

    Attributes
    ----------
    scan
        The map as read.
    options
        What was done, every 'auto' resolved.
    steps
        The steps that did something, in order.
    prepared
        (nx, ny) [m] map before its edges were joined.
    pixel
        Of it and of the tile [m].
    tile
        The tile, mean zero: (nx, ny), or (2 nx, 2 ny) if mirrored [m].
    """

    scan: Scan = field(repr=False)
    options: Options
    steps: tuple[Step, ...]
    prepared: Array = field(repr=False)
    pixel: tuple[float, float]
    tile: Array = field(repr=False)

    @property
    def lengths(self) -> tuple[float, float]:
        """Size of the tile along x and y [m]."""
        return self.tile.shape[0] * self.pixel[0], self.tile.shape[1] * self.pixel[1]

    @property
    def measured_width(self) -> float:
        """Width of the map across the motion, without mirror images [m]."""
        return self.prepared.shape[1] * self.pixel[1]

    def place(self, i: int, j: int) -> tuple[float, float]:
        """Where on the prepared map pixel (i, j) of the tile is: x, y from its corner [m]."""
        nx, ny = self.prepared.shape
        if self.options.edges == "mirror":
            i, j = seams.unmirrored(i, j, (nx, ny))
        elif self.options.edges == "window":
            i, j = i % nx, (j + ny // 2) % ny
        return (i % nx) * self.pixel[0], (j % ny) * self.pixel[1]

    def summary(self) -> dict[str, Any]:
        """Return what ``summary.json`` holds of it: SI units."""
        scan = self.scan
        return {
            "file": scan.origin,
            "channel": scan.channel or None,
            "kind": "array" if scan.is_array else "instrument",
            "pixels": list(scan.heights.shape),
            "size_m": [scan.length_x, scan.length_y],
            "size_from": scan.size_from,
            "missing": int(np.count_nonzero(~np.isfinite(scan.heights))),
            "detrend": self.options.detrend,
            "edges": self.options.edges,
            "tile_pixels": list(self.tile.shape),
            "tile_size_m": list(self.lengths),
            "steps": [step.summary() for step in self.steps],
        }

    def report(self) -> list[str]:
        """Return the lines that the plan prints."""
        scan = self.scan
        name = f"{scan.origin}" + (f", channel '{scan.channel}'" if scan.channel else "")
        lines = [
            f"map        {name}",
            f"           {scan.heights.shape[0]} x {scan.heights.shape[1]} pixels, "
            f"{scan.length_x * 1e3:.5g} x {scan.length_y * 1e3:.5g} mm by {scan.size_from}",
        ]
        for step in self.steps:
            b, a = step.before, step.after
            changed = f", {step.changed} points" if step.changed else ""
            lines.append(
                f"  {step.name:8} {step.value} ({step.why}){changed}: "
                f"rms {b.rms * 1e9:.4g} -> {a.rms * 1e9:.4g} nm, "
                f"peak {b.peak * 1e9:.4g} -> {a.peak * 1e9:.4g} nm, "
                f"slope {b.slope:.3g} -> {a.slope:.3g}"
            )
            if step.note:
                lines.append(f"           {step.note}")
        return lines


def defaults(options: Options, scan: Scan) -> tuple[Options, dict[str, str]]:
    """Options without 'auto', and the reason for each word.

    A file of an instrument is a map of a part: it lies at an angle that is the stage's and not
    the surface's, and its edges do not meet. An array is taken at its word, as is a file that
    says that it is periodic: nothing is taken off, and it is repeated. A part of an array, or an
    array that was turned, is no longer periodic.
    """
    why = {"detrend": "given", "edges": "given"}
    tile = scan.is_array or scan.is_periodic
    what = "an array is taken at its word" if scan.is_array else "the file says it is periodic"
    if options.detrend == "auto":
        options = replace(options, detrend="none" if tile else "tilt")
        why["detrend"] = what if tile else "the tilt of a scan is that of the stage"
    if options.edges == "auto":
        quarter = abs(options.rotate / 90.0 - round(options.rotate / 90.0)) < 1e-9
        whole = not any(options.crop) and quarter
        options = replace(options, edges="periodic" if tile and whole else "mirror")
        why["edges"] = what if tile and whole else "opposite edges of a scan do not meet"
        if tile and not whole:
            why["edges"] = "a part of a tile is not periodic"
    return options, why


def prepare(scan: Scan, options: Options = NEUTRAL) -> Preparation:
    """Make a tile of a map.

    Parameters
    ----------
    scan
        The map as read.
    options
        What to do.

    Raises
    ------
    ValueError
        If a step cannot be done, the map is larger than the memory, or the rms height is so
        large or small that the unit must be wrong.
    """
    options, why = defaults(options, scan)
    work = _Work(scan)
    check_pixels(scan.origin, work.z.shape)
    if any(options.crop):
        work.do("crop", ", ".join(f"{v:g}" for v in options.crop),
                cutting.cropped(work.z, work.pixel, options.crop))  # fmt: skip
    check_pixels(scan.origin, work.z.shape, 4 if options.edges == "mirror" else 1)
    if options.sign < 0:
        work.do("sign", "-1", -work.z)
    valid = np.isfinite(work.z)
    if options.outliers > 0.0:
        spiky = spikes.prominence(work.z) > options.outliers
        valid &= ~spiky
        work.do("outliers", f"{options.outliers:g}", np.where(spiky, np.nan, work.z),
                changed=int(spiky.sum()))  # fmt: skip
    _fill(work, options, valid)
    if options.detrend != "none":
        level = levelling.levelled(work.z, options.detrend, valid)
        work.do("detrend", options.detrend, level, why["detrend"])
    if options.rotate % 360.0 != 0.0:
        turned, pixel = cutting.rotated(work.z, work.pixel, options.rotate)
        work.do("rotate", f"{options.rotate:g}", turned, pixel=pixel)
    prepared = work.z - work.z.mean()
    _check_rms(scan, float(np.std(prepared)))
    tile = prepared
    if options.edges == "mirror":
        tile = seams.mirrored(prepared)
        work.do("edges", "mirror", tile, why["edges"])
    elif options.edges == "window":
        tile = seams.windowed(prepared)
        rim = int(np.count_nonzero(np.roll(tile, tile.shape[1] // 2, axis=1) != prepared))
        work.do("edges", "window", tile, why["edges"], changed=rim)
    elif (steep := seams.jump(prepared)) > JUMP:
        note = (
            f"the edges do not meet: steps across them are {steep:.3g} times those inside; "
            "if the map is not periodic, surface.edges = 'mirror'"
        )
        work.do("edges", "periodic", tile, why["edges"], note=note)
    tile = np.ascontiguousarray(tile - tile.mean())
    return Preparation(scan, options, tuple(work.steps), prepared, work.pixel, tile)


def _fill(work: _Work, options: Options, valid: NDArray[np.bool_]) -> None:
    """Fill what is missing, spikes included, or refuse to."""
    missing = int(valid.size - np.count_nonzero(valid))
    if missing == 0:
        return
    if options.fill == "none":
        i, j = np.argwhere(~valid)[0]
        raise ValueError(
            f"{work.origin}: {missing} of {valid.size} heights are missing, the first at row {i}, "
            f"column {j}, and surface.fill = 'none'; with 'harmonic' they are interpolated"
        )
    try:
        full = holes.filled(work.z, work.pixel)
    except ValueError as error:
        raise ValueError(f"{work.origin}: {error}") from None
    why = "given" if options.outliers > 0.0 else "nothing is known but the rims of the holes"
    work.do("fill", options.fill, full, why, changed=missing)


LARGEST = 1e6
"""Largest height [m] that is not taken for damage."""


class _Work:
    """A map on its way, with the record of the steps so far."""

    def __init__(self, scan: Scan) -> None:
        # an infinite height is none
        self.z = np.where(np.isinf(scan.heights), np.nan, scan.heights)
        self.origin = scan.origin
        largest = np.nanmax(np.abs(self.z), initial=0.0)
        if largest > LARGEST:
            raise ValueError(
                f"{scan.origin}: a height of {largest:.3g} m: expected heights in metres"
            )
        nx, ny = scan.heights.shape
        self.pixel = (scan.length_x / nx, scan.length_y / ny)
        self.steps: list[Step] = []
        self._last: areal.Extent | None = None

    def do(
        self,
        name: str,
        value: str,
        heights: Array,
        why: str = "given",
        *,
        changed: int = 0,
        pixel: tuple[float, float] | None = None,
        note: str = "",
    ) -> None:
        """Record a step; its result is what the next one works on."""
        before = self._last or areal.extent(self.z, self.pixel)
        self.z = heights
        self.pixel = pixel or self.pixel
        self._last = areal.extent(self.z, self.pixel)
        self.steps.append(Step(name, value, why, changed, before, self._last, note))


def _check_rms(scan: Scan, rms: float) -> None:
    """Refuse what can only be a mistake of units."""
    if not RMS_BAND[0] <= rms <= RMS_BAND[1]:
        raise ValueError(
            f"{scan.origin}: rms height {rms:.3g} m is outside {RMS_BAND[0]:g} ... "
            f"{RMS_BAND[1]:g} m; are the heights in m?"
        )
