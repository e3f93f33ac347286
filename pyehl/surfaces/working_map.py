# SPDX-License-Identifier: BSD-3-Clause
"""A map during its preparation: heights, options with their defaults, record of each step."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np

from pyehl import lengths
from pyehl.case.surface_group import Surface as Keys
from pyehl.errors import InputError
from pyehl.surfaces import areal
from pyehl.surfaces.findings import Finding
from pyehl.surfaces.reading import Scan
from pyehl.types import Array


@dataclass(frozen=True, slots=True)
class Options:
    """Options of the preparation of a map; each attribute is a key of ``&surface``."""

    detrend: str = "auto"  # ``"none"``, ``"centre"``, ``"tilt"``, ``"curvature"`` or ``"auto"``
    fill: str = "harmonic"  # ``"harmonic"`` or ``"none"``, which refuses maps with missing points
    # Threshold, see :func:`pyehl.surfaces.map_steps.prominence`; 0: no point is removed
    outliers: float = 0.0
    # Direction of the lines whose offsets are removed, ``"x"`` or ``"y"``; or ``"none"``
    align_lines: str = "none"
    edges: str = "auto"  # ``"mirror"``, ``"window"``, ``"periodic"`` or ``"auto"``
    # (x_min, x_max, y_min, y_max) [m], a maximum of 0 being the far edge
    crop: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)
    rotate: float = 0.0  # counter-clockwise [degrees]
    sign: int = 1  # 1, or -1 for a map whose valleys are positive

    @classmethod
    def from_settings(cls, surface: Mapping[str, Any]) -> Self:
        """Options of the group ``surface`` of a resolved case, with defaults for missing keys."""
        s = Keys.of(surface)
        crop = s.crop_x_min, s.crop_x_max, s.crop_y_min, s.crop_y_max
        return cls(s.detrend, s.fill, s.outliers, s.align_lines, s.edges, crop, s.rotate, s.sign)


NEUTRAL = Options()
"""With these options the mean of an array is removed and its missing points are filled, no more."""


def defaults(options: Options, scan: Scan) -> tuple[Options, dict[str, str]]:
    """Resolve 'auto'; returns the options, and the reason for each value.

    A file of an instrument is a map of a part of the surface: its tilt is that of the stage, and
    its edges do not match. An array, and a file that states that it is periodic, is used as it is:
    nothing is removed, and it is repeated. If it is cropped, or rotated by another angle than a
    multiple of 90 degrees, it is no longer periodic.
    """
    why = {"detrend": "given", "edges": "given"}
    tile = scan.is_array or scan.is_periodic
    what = "an array is taken as it is" if scan.is_array else "the file states it is periodic"
    if options.detrend == "auto":
        options = replace(options, detrend="none" if tile else "tilt")
        why["detrend"] = what if tile else "the tilt of a scan is that of the stage"
    if options.edges == "auto":
        quarter = abs(options.rotate / 90.0 - round(options.rotate / 90.0)) < 1e-9
        whole = not any(options.crop) and quarter
        options = replace(options, edges="periodic" if tile and whole else "mirror")
        why["edges"] = what if tile and whole else "opposite edges of a scan do not match"
        if tile and not whole:
            why["edges"] = "a part of a tile is not periodic"
    return options, why


MAX_HEIGHT = 1e6
"""Largest plausible height [m]; larger ones indicate a damaged file."""


@dataclass(frozen=True, slots=True)
class Step:
    """One step of a preparation.

    Attributes
    ----------
    name, value
        Key of ``&surface`` and its value.
    why
        Reason for the value: 'given', or the reason of the default.
    changed
        Number of points that were removed, filled or altered; 0 for a step that treats all points
        alike.
    before, after
        Roughness of the map before and after, without mirror images, which repeat its heights and
        the steps between them.
    note
        Remark; usually empty.
    """

    name: str
    value: str
    why: str
    changed: int
    before: areal.Extent
    after: areal.Extent
    note: str = ""

    @property
    def summary(self) -> dict[str, Any]:
        """Return its entry in ``summary.json``."""
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
class Record:
    """Record of the preparation of a map, without its heights."""

    # Origin of the map
    file: str
    channel: str
    is_array: bool  # whether it is an array, not a file of an instrument
    # Pixels and size [m] of the map as read, along x and y, and the source of the size
    pixels: tuple[int, int]
    size: tuple[float, float]
    size_from: str
    missing: int  # points without a height
    note: str  # remark on the file; usually empty
    # Values of these keys, 'auto' resolved
    detrend: str
    edges: str
    # Pixels and size [m] of the tile along x and y
    tile_pixels: tuple[int, int]
    tile_size: tuple[float, float]
    steps: tuple[Step, ...]  # the steps that changed the map, in order
    findings: tuple[Finding, ...] = ()  # artefacts of the levelled map

    @property
    def summary(self) -> dict[str, Any]:
        """Return its entry in ``summary.json``, in SI units."""
        return {
            "file": self.file,
            "channel": self.channel or None,
            "kind": "array" if self.is_array else "instrument",
            "pixels": list(self.pixels),
            "size_m": list(self.size),
            "size_from": self.size_from,
            "missing": self.missing,
            "note": self.note or None,
            "detrend": self.detrend,
            "edges": self.edges,
            "tile_pixels": list(self.tile_pixels),
            "tile_size_m": list(self.tile_size),
            "steps": [step.summary for step in self.steps],
            "findings": [finding.summary for finding in self.findings],
        }

    def report(self) -> list[str]:
        """Return the lines that the plan prints."""
        name = self.file + (f", channel '{self.channel}'" if self.channel else "")
        lines = [
            f"map        {name}",
            f"           {self.pixels[0]} x {self.pixels[1]} pixels, "
            f"{lengths.size(*self.size)} by {self.size_from}",
        ]
        if self.note:
            lines.append(f"           {self.note}")
        if not self.steps:
            lines.append("           taken as it is, and repeated")
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
        return lines + [f"  found    {finding.report()}" for finding in self.findings]


def _largest(z: Array) -> float:
    """Largest absolute height, ignoring missing points; makes no copies."""
    maximum = float(np.fmax.reduce(z, axis=None, initial=0.0))
    return max(maximum, -float(np.fmin.reduce(z, axis=None, initial=0.0)))


class WorkingMap:
    """A map that is being prepared, with the record of the steps so far.

    Heights `z` (nx, ny) [m], NaN where missing; `pixel` size along x and y [m]; `missing` heights
    in the map as read. `keep`: the heights of `scan` must not change. InputError if a height is
    implausible in metres.
    """

    def __init__(self, scan: Scan, *, keep: bool) -> None:
        self.z = scan.heights
        self.scan = scan
        self.origin = scan.origin
        if math.isinf(_largest(self.z)):
            # infinite heights count as missing
            self.z = np.where(np.isinf(self.z), np.nan, self.z)
        largest = _largest(self.z)
        if largest > MAX_HEIGHT:
            raise InputError(
                f"{scan.origin}: a height of {largest:.3g} m: expected heights in metres"
            )
        self.missing = self.z.size - int(np.count_nonzero(np.isfinite(self.z)))
        nx, ny = scan.heights.shape
        self.pixel = (scan.length_x / nx, scan.length_y / ny)
        self.steps: list[Step] = []
        self.findings: tuple[Finding, ...] = ()
        self._last: areal.Extent | None = None
        self._kept = scan.heights if keep else None

    def writable(self) -> Array:
        """Return the heights for changes in place, as a copy if they are shared."""
        shared = self._kept is not None and np.may_share_memory(self.z, self._kept)
        if shared or not self.z.flags.writeable:
            self.z = self.z.copy()
        return self.z

    def begin(self) -> None:
        """Store the roughness of the map before a step that works in place."""
        self._last = self._last or areal.extent(self.z, self.pixel)

    def add_step(
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
        """Record a step and its result `heights`, on which the next step works.

        `pixel` is its pixel size [m], None: as before; the other arguments as in :class:`Step`.
        """
        before = self._last or areal.extent(self.z, self.pixel)
        # a step 'edges' that only notes the edges or will add images does not change the heights
        same = heights is self.z and name == "edges"
        self.z = heights
        self.pixel = pixel or self.pixel
        self._last = before if same else areal.extent(self.z, self.pixel)
        self.steps.append(Step(name, value, why, changed, before, self._last, note))

    def record(self, options: Options) -> Record:
        """Return the record of all steps."""
        scan, images = self.scan, 2 if options.edges == "mirror" else 1
        nx, ny = (images * n for n in self.z.shape)
        return Record(
            file=scan.origin,
            channel=scan.channel,
            is_array=scan.is_array,
            pixels=(scan.heights.shape[0], scan.heights.shape[1]),
            size=(scan.length_x, scan.length_y),
            size_from=scan.size_from,
            missing=self.missing,
            note=scan.note,
            detrend=options.detrend,
            edges=options.edges,
            tile_pixels=(nx, ny),
            tile_size=(nx * self.pixel[0], ny * self.pixel[1]),
            steps=tuple(self.steps),
            findings=self.findings,
        )
