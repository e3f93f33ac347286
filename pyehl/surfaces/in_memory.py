# SPDX-License-Identifier: BSD-3-Clause
"""A surface that a caller has in memory, in place of that of a case."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from pyehl.errors import InputError
from pyehl.given import heights_of
from pyehl.surfaces.tile import Topography

__all__ = ["READY", "Surface", "as_map", "in_memory", "keep_beside"]

Surface = Topography | ArrayLike
"""A tile, or heights [m] of shape (nx, ny) that have the size that the case says."""

IN_MEMORY = {
    "surface": "heights in memory",
    "second_surface": "heights of the second surface in memory",
}
"""What a surface in memory is called in place of a file, by the group of the case."""
READY: Mapping[str, Any] = {
    "surface.kind": "map",
    "surface.channel": "''",
    "surface.detrend": "none",
    "surface.edges": "periodic",
    "surface.outliers": 0.0,
    "surface.rotate": 0.0,
    "surface.sign": 1,
    "surface.crop_x_min": 0.0,
    "surface.crop_x_max": 0.0,
    "surface.crop_y_min": 0.0,
    "surface.crop_y_max": 0.0,
    "surface.tile_x": 0.0,
    "surface.tile_y": 0.0,
    "surface.tile_mirrored": False,
}
"""Options of a tile that is ready: nothing is left to prepare."""


def in_memory(surface: Surface, group: Mapping[str, Any], name: str = "surface") -> Topography:
    """Give a surface about its mean, of an array with the size in the group of that name.

    InputError if it is none of heights, or the case does not say its size.
    """
    if not isinstance(surface, Topography):
        heights = heights_of(surface)
        size = tuple(float(group.get(f"tile_{k}") or group.get(f"length_{k}") or 0.0) for k in "xy")
        if group.get("kind") not in ("map", "fractal") or not all(size):
            raise InputError(
                "heights are given, and the case does not say their size\n"
                f"expected: {name}.kind = 'map' or 'fractal' with {name}.length_x and length_y, "
                "or pyehl.Topography(heights, size)"
            )
        surface = Topography(heights, (size[0], size[1]))
    heights = surface.heights - surface.heights.mean()
    return replace(surface, heights=heights, origin=surface.origin or IN_MEMORY[name])


def as_map(tile: Topography, group: str = "surface") -> dict[str, Any]:
    """Options of a case with a tile in memory; they leave its track and the cut of its spectrum."""
    length_x, length_y = tile.size
    options = {
        **READY,
        "surface.file": IN_MEMORY[group],
        "surface.tile_x": length_x,
        "surface.tile_y": length_y,
        "surface.length_x": length_x,
        "surface.length_y": length_y,
    }
    return {key.replace("surface", group, 1): value for key, value in options.items()}


def keep_beside(tile: Topography, case: Path, group: str = "surface") -> str:
    """Write a tile beside a resolved case, which then names it; returns the name of the file."""
    name = f"{group}.npy"
    np.save(case.with_name(name), tile.heights)
    text = case.read_text(encoding="utf-8")
    called = IN_MEMORY[group]
    changed = re.sub(rf"^(\s*file = )'[^']*/{called}'", rf"\1'{name}'", text, flags=re.MULTILINE)
    case.write_text(changed, encoding="utf-8")
    return name
