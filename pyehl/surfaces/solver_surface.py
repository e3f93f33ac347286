# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces of a case for the solver, in memory, and for ``ehl``, as files beside the case."""

import logging
import os
import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from pyehl.case import Case, files_of
from pyehl.case.surface_group import Surface as Keys
from pyehl.case.surfaces import without_fractal
from pyehl.destination import check_files, made_by, mark, new_file
from pyehl.errors import InputError
from pyehl.given import heights_of, real_numbers
from pyehl.plan_text import making_text
from pyehl.surfaces.from_case import GROUPS, moved, scan_of, whole
from pyehl.surfaces.map_steps import filled, mirrored
from pyehl.surfaces.prepare import consume
from pyehl.surfaces.reading import plain_array
from pyehl.surfaces.tile import Topography, shift_across
from pyehl.surfaces.working_map import NEUTRAL, Options, Record
from pyehl.theory.line_contact import contact_of
from pyehl.types import Array, Settings

LOG = logging.getLogger(__name__)

Surface = Topography | ArrayLike
"""A tile, or heights [m] of shape (nx, ny) whose size the case states."""

IN_MEMORY = {
    "surface": "heights in memory",
    "second_surface": "heights of the second surface in memory",
}
"""Name of a surface in memory in place of a file, by the group of the case."""
READY: Mapping[str, Any] = {
    "surface.kind": "map",
    "surface.channel": "",
    "surface.detrend": "none",
    "surface.edges": "periodic",
    "surface.outliers": 0.0,
    "surface.align_lines": "none",
    "surface.profile": "none",
    "surface.rotate": 0.0,
    "surface.sign": 1,
    "surface.height_unit": "m",
    "surface.lateral_unit": "same",
    "surface.crop_x_min": 0.0,
    "surface.crop_x_max": 0.0,
    "surface.crop_y_min": 0.0,
    "surface.crop_y_max": 0.0,
    "surface.tile_x": 0.0,
    "surface.tile_y": 0.0,
    "surface.tile_mirrored": False,
}
"""Options of a tile that needs no further preparation."""
LARGE_PIXELS, PART_PIXELS = 2**20, 2**18
"""Pixels of the largest tile that is analysed completely, and of the part of a larger one."""


def in_memory(surface: Surface, group: Mapping[str, Any], name: str = "surface") -> Topography:
    """Return a surface with mean zero; an array has the size stated in the group `name`.

    Missing points of an array, nan or masked, are interpolated like those of a file. InputError if
    it is no surface of heights, or the case does not state its size.
    """
    if not isinstance(surface, Topography):
        numbers = real_numbers(surface, name)
        s = Keys.of(group)
        size = s.tile_x or s.length_x, s.tile_y or s.length_y
        if s.kind == "smooth" or s.fill == "none":
            heights_of(numbers)
        if s.kind not in ("map", "fractal") or not all(size):
            raise InputError(
                "heights are given, and the case does not state their size\n"
                f"expected: {name}.kind = 'map' or 'fractal' with {name}.length_x and length_y, "
                "or pyehl.Topography(heights, size)"
            )
        surface = _whole(numbers, size, group, name)
    heights = surface.heights - surface.heights.mean()
    return replace(surface, heights=heights, origin=surface.origin or IN_MEMORY[name])


def _whole(
    heights: Array, size: tuple[float, float], group: Mapping[str, Any], name: str
) -> Topography:
    """Return the tile of an array, with missing points interpolated."""
    missing = int(np.isnan(heights).sum()) if heights.ndim == 2 else 0
    if not missing or Keys.of(group).fill == "none":
        return Topography(heights_of(heights), size)
    pixel = (size[0] / heights.shape[0], size[1] / heights.shape[1])
    try:
        full = filled(np.asarray(heights, dtype=np.float64), pixel)
    except ValueError as error:
        raise InputError(f"{IN_MEMORY[name]}: {error}") from None
    LOG.info("%s: %d missing points were interpolated", IN_MEMORY[name], missing)
    return Topography(full, size, f"{IN_MEMORY[name]}, {missing} missing points interpolated")


def as_map(tile: Topography, group: str = "surface") -> dict[str, Any]:
    """Options of a case for a tile in memory; its track and filter do not change."""
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


def write_beside(tile: Topography, case: Path, group: str = "surface") -> str:
    """Write a tile beside a resolved case and its name into the case; returns that name."""
    name = f"{group}.npy"
    np.save(case.with_name(name), tile.heights)
    text = case.read_text(encoding="utf-8")
    called = IN_MEMORY[group]
    changed = re.sub(rf"^(\s*file = )'[^']*/{called}'", rf"\1'{name}'", text, flags=re.MULTILINE)
    case.write_text(changed, encoding="utf-8")
    return name


def part_of(
    heights: Array, pixel: tuple[float, float], origin: str, *, images: bool = False
) -> Topography | None:
    """Return the middle of a large surface with its mirror images; None if it is not large.

    Heights (nx, ny) [m], pixel size along x and y [m]. `images`: the tile of the surface includes
    its mirror images, four times as many pixels. The part has at most `PART_PIXELS` pixels, square
    if the surface is wide enough.
    """
    if heights.size * (4 if images else 1) <= LARGE_PIXELS:
        return None
    pixels = PART_PIXELS // 4
    side = int(pixels**0.5)
    nx = min(heights.shape[0], max(side, pixels // heights.shape[1]))
    ny = min(heights.shape[1], pixels // nx)
    i, j = (heights.shape[0] - nx) // 2, (heights.shape[1] - ny) // 2
    tile = mirrored(heights[i : i + nx, j : j + ny])
    tile -= tile.mean()
    name = f"{origin}, {nx} x {ny} pixels in its middle"
    return Topography(tile, (2 * nx * pixel[0], 2 * ny * pixel[1]), name)


def given(heights: Array, surface: Mapping[str, Any]) -> Topography:
    """Return a tile of heights [m] that replace the surface of a case; a part of a large one.

    Its size is that of the tile in the group ``surface``, or that of the map.
    """
    s = Keys.of(surface)
    x, y, images = s.tile_x or s.length_x, s.tile_y or s.length_y, s.tile_mirrored
    pixel = (x / heights.shape[0], y / heights.shape[1])
    if images:
        pixel = (0.5 * pixel[0], 0.5 * pixel[1])
    part = part_of(heights, pixel, "the heights", images=images)
    return part or Topography(mirrored(heights) if images else heights, (x, y))


def with_surface(case: Case, surface: Surface, group: str = "surface") -> tuple[Case, Topography]:
    """Replace the surface of a group by one in memory; returns the case and the tile.

    InputError if it is no surface of heights, or the case does not state its size.
    """
    values = case.resolve().get(group, {})
    tile = in_memory(surface, values, group)
    return case.with_options(as_map(tile, group), without_fractal(group, values)), tile


@dataclass(frozen=True, slots=True)
class SolverSurface:
    """Data of a surface of a case that the solver takes from Python."""

    # (nx, ny) [m], Fortran order; None if the solver makes or reads the surface itself
    heights: Array | None = None
    # Options ``group.key=value`` for its case: the size of a prepared tile, and whether mirror
    # images are to be added to the heights
    options: tuple[str, ...] = ()
    # Record of the preparation of a map; else None
    preparation: Record | None = None
    # Part of a large map, not filtered, see :func:`part_of`; else None
    part: Topography | None = None


def gather(
    settings: Settings, heights: Mapping[str, Array], tiles: Mapping[str, Topography]
) -> dict[str, SolverSurface]:
    """Prepare both surfaces of a resolved case for the solver, by group.

    `heights` [m] by group replace the surfaces of the case; `tiles` are the tiles from which they
    were made. InputError if a surface that they replace is neither a map nor a fractal tile; else
    as `for_solver`.
    """
    both: dict[str, SolverSurface] = {}
    for group in GROUPS:
        if group not in heights:
            both[group] = for_solver(settings, group)
            continue
        if settings.get(group, {}).get("kind") not in ("map", "fractal"):
            raise InputError(
                "heights are given, and the surface of the case is not a height map\n"
                f"expected: {group}.kind = 'map' or 'fractal'"
            )
        made = tiles[group].preparation if group in tiles else None
        stand_in = given(np.asarray(heights[group], dtype=np.float64), settings[group])
        both[group] = SolverSurface(heights[group], (), made.record if made else None, stand_in)
    return both


def for_solver(settings: Settings, group: str = "surface") -> SolverSurface:
    """Prepare the surface of a group of a resolved case for the solver.

    The solver makes harmonic patterns and fractal surfaces, reads arrays that need no preparation,
    and filters them itself, so that the program `ehl` gives the same bits. Python prepares only
    what the solver cannot read or prepare, and does not filter it. InputError if a map is not
    usable; OSError if it cannot be opened.
    """
    if group not in settings:
        return SolverSurface()
    surface, s = settings[group], Keys.of(settings[group])
    if s.kind == "fractal" and s.track:
        # only harmonic patterns depend on the film
        made = whole({**settings, "surface": surface}, contact_of(settings), film=0.0)
        return SolverSurface(np.asfortranarray(moved(made, surface).heights))
    if s.kind == "fractal":
        if need := making_text(s.pixels):
            LOG.info(need)
    if s.kind != "map":
        return SolverSurface()
    scan, options = scan_of(surface), Options.from_settings(surface)
    changed = s.track or not scan.is_array or not (s.length_x and s.length_y)
    changed = changed or s.height_unit != "m" or s.profile != "none"
    changed = changed or not plain_array(s.file, scan.heights.shape)
    # a large map must be in memory only once
    heights, record = consume(scan, options)
    del scan
    x, y = record.tile_size
    images = record.edges == "mirror"
    pixel = (x / record.tile_pixels[0], y / record.tile_pixels[1])
    part = part_of(heights, pixel, record.file, images=images)
    if not changed and options == NEUTRAL and not record.missing:
        return SolverSurface(preparation=record, part=part)
    sizes = [f"{group}.tile_x={x!r}", f"{group}.tile_y={y!r}"]
    if s.track:
        heights = mirrored(heights) if images else heights
        shift_across(heights, y, -s.track)
    elif images:
        sizes.append(f"{group}.tile_mirrored=.true.")
    return SolverSurface(np.asfortranarray(heights), tuple(sizes), record, part)


def write_resolved(
    case: Case, path: str | os.PathLike[str], inputs: tuple[str | os.PathLike[str], ...] = ()
) -> list[Path]:
    """Write a resolved case, and prepared surfaces as .npy beside it; returns all files.

    InputError if a file exists that this command did not write, or is one of `inputs`; else as
    `for_solver`.
    """
    path = Path(path)
    tiles = {group: path.with_name(f"{path.stem}_{group}.npy") for group in GROUPS}
    inputs = (*inputs, *files_of(case.resolve()))
    check_files([path], "check", inputs)
    check_files(
        tiles.values(),
        "check",
        inputs,
        known=lambda tile: path.is_file() and made_by(path, f"'{tile.absolute()}'"),
    )
    written = [path]
    for group, tile in tiles.items():
        made = for_solver(case.resolve(), group)
        if made.heights is None:
            continue
        with new_file(tile) as fresh:
            np.save(fresh, made.heights)
        written.append(tile)
        if made.options:
            case = case.with_options(*made.options)
        surface = case[group]
        x, y = (float(surface[f"tile_{axis}"] or surface[f"length_{axis}"]) for axis in "xy")
        ready = as_map(Topography(made.heights, (x, y)), group)
        ready[f"{group}.file"] = str(tile.absolute())
        ready |= without_fractal(group, surface)
        # already applied to the heights
        ready |= {f"{group}.track": 0.0} if surface["track"] else {}
        ready[f"{group}.tile_mirrored"] = surface["tile_mirrored"]
        case = case.with_options(ready)
    with new_file(path) as fresh:
        fresh.write_text(f"! {mark('check')}\n{case.text}", encoding="utf-8")
    return written
