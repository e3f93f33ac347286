# SPDX-License-Identifier: BSD-3-Clause
"""What was done to a map, in numbers: for the plan and for ``summary.json``."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from pyehl.surfaces.areal import Extent

__all__ = ["Record", "Step"]


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
        How rough the map was and is, without mirror images: each of its heights and each step
        between two of them occurs four times in the tile.
    note
        What a person should know besides; mostly empty.
    """

    name: str
    value: str
    why: str
    changed: int
    before: Extent
    after: Extent
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
class Record:
    """What a map was and what became of it, without its heights."""

    # Where it came from
    file: str
    channel: str
    is_array: bool  # whether it is an array, and no file of an instrument
    # Of the map as read, along x and y, [m], and where the size is from
    pixels: tuple[int, int]
    size: tuple[float, float]
    size_from: str
    missing: int  # points without a height
    note: str  # what a person should know of the file besides; mostly empty
    # What these keys were, 'auto' resolved
    detrend: str
    edges: str
    # Of the tile, along x and y, [m]
    tile_pixels: tuple[int, int]
    tile_size: tuple[float, float]
    steps: tuple[Step, ...]  # the steps that did something, in order

    def summary(self) -> dict[str, Any]:
        """Return what ``summary.json`` holds of it: SI units."""
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
            "steps": [step.summary() for step in self.steps],
        }

    def report(self) -> list[str]:
        """Return the lines that the plan prints."""
        name = self.file + (f", channel '{self.channel}'" if self.channel else "")
        lines = [
            f"map        {name}",
            f"           {self.pixels[0]} x {self.pixels[1]} pixels, "
            f"{self.size[0] * 1e3:.5g} x {self.size[1] * 1e3:.5g} mm by {self.size_from}",
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
        return lines
