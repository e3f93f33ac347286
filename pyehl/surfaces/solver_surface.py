# SPDX-License-Identifier: BSD-3-Clause
"""The surface of a case for the solver: what it cannot make or read itself."""

import logging
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from pyehl.case.surface_group import Surface as Keys
from pyehl.errors import InputError
from pyehl.plan_text import making_text
from pyehl.surfaces.filters import shift_across
from pyehl.surfaces.from_case import GROUPS, moved, scan_of, whole
from pyehl.surfaces.in_memory import given, part_of
from pyehl.surfaces.map_steps import mirrored
from pyehl.surfaces.options import NEUTRAL, Options
from pyehl.surfaces.prepare import consume
from pyehl.surfaces.reading import plain_array
from pyehl.surfaces.tile import Topography
from pyehl.surfaces.working_map import Record
from pyehl.theory.line_contact import contact_of
from pyehl.types import Array, Settings

LOG = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class SolverSurface:
    """What the solver needs from Python for the surface of a case."""

    # (nx, ny) [m], Fortran order; None where the solver makes or reads the surface itself
    heights: Array | None = None
    # Texts ``group.key=value`` to set in its case: the size of a prepared tile, and whether it is
    # the heights with their mirror images
    options: tuple[str, ...] = ()
    # How a map became a tile, or that it was taken as it is; else None
    preparation: Record | None = None
    # Of a large map a part, see :func:`part_of`; its spectrum is not cut. Else None
    part: Topography | None = None


def gather(
    settings: Settings, heights: Mapping[str, Array], tiles: Mapping[str, Topography]
) -> dict[str, SolverSurface]:
    """Make what the solver needs from Python for both surfaces of a resolved case, by group.

    `heights` [m] by group stand in for the surfaces of the case; `tiles` are what they were made
    of. InputError if a surface that they stand in for is none of heights; else as `for_solver`.
    """
    both: dict[str, SolverSurface] = {}
    for group in GROUPS:
        if group not in heights:
            both[group] = for_solver(settings, group)
            continue
        if settings.get(group, {}).get("kind") not in ("map", "fractal"):
            raise InputError(
                "heights are given, and the surface of the case is none of heights\n"
                f"expected: {group}.kind = 'map' or 'fractal'"
            )
        made = tiles[group].preparation if group in tiles else None
        stand_in = given(np.asarray(heights[group], dtype=np.float64), settings[group])
        both[group] = SolverSurface(heights[group], (), made.record if made else None, stand_in)
    return both


def for_solver(settings: Settings, group: str = "surface") -> SolverSurface:
    """Make what the solver needs from Python for the surface of a group of a resolved case.

    The solver makes harmonic patterns and fractal surfaces, reads arrays that need no preparation,
    and cuts their spectra itself: so these give the same bits by the program `ehl`. Only what it
    cannot read or prepare comes from here, before its spectrum is cut. InputError if a map is not
    usable; OSError if it cannot be opened.
    """
    if group not in settings:
        return SolverSurface()
    surface, s = settings[group], Keys.of(settings[group])
    if s.kind == "fractal" and s.track:
        # the film is the scale of harmonic patterns alone
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
    # a large map is in memory once
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
