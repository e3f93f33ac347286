# SPDX-License-Identifier: BSD-3-Clause
"""The surface of a case for the solver: what it cannot make or read itself."""

from __future__ import annotations

import logging
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pyehl import library
from pyehl.surfaces.in_memory import part_of
from pyehl.surfaces.interpolation import shift_across
from pyehl.surfaces.of_case import moved, scan_of, whole
from pyehl.surfaces.options import NEUTRAL, Options
from pyehl.surfaces.prepare import consume
from pyehl.surfaces.reading import plain_array
from pyehl.surfaces.seams import mirrored
from pyehl.surfaces.tile import Topography
from pyehl.surfaces.working_map import Record
from pyehl.theory.operating import OperatingPoint

__all__ = ["SolverSurface", "for_solver"]

LOG = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class SolverSurface:
    """What the solver needs from Python for the surface of a case."""

    # (nx, ny) [m], Fortran order; None where the solver makes or reads the surface itself
    heights: NDArray[np.float64] | None = None
    # Texts ``group.key=value`` to set in its case: the size of a prepared tile, and whether it is
    # the heights with their mirror images
    options: tuple[str, ...] = ()
    # How a map became a tile, or that it was taken as it is; else None
    preparation: Record | None = None
    # Of a large map a part, see :func:`part_of`; its spectrum is not cut. Else None
    part: Topography | None = None


def for_solver(settings: Mapping[str, Mapping[str, Any]]) -> SolverSurface:
    """Make what the solver needs from Python for a resolved case.

    The solver makes harmonic patterns and fractal surfaces, reads arrays that need no preparation,
    and cuts their spectra itself: so these give the same bits by the program `ehl`. Only what it
    cannot read or prepare comes from here, before its spectrum is cut. InputError if a map is not
    usable; OSError if it cannot be opened.
    """
    surface = settings["surface"]
    if surface["kind"] == "fractal" and surface.get("track"):
        # the film is the scale of harmonic patterns alone
        made = whole(settings, OperatingPoint.from_settings(settings), film=0.0)
        return SolverSurface(np.asfortranarray(moved(made, surface).heights))
    if surface["kind"] == "fractal":
        need = library.returned(library.surface_functions.making(int(surface["pixels"])))
        if need:
            LOG.info(need)
    if surface["kind"] != "map":
        return SolverSurface()
    scan, options = scan_of(surface), Options.from_settings(surface)
    given = surface.get("length_x") and surface.get("length_y")
    changed = surface.get("track") or not scan.is_array or not given
    changed = changed or not plain_array(str(surface["file"]))
    # a large map is in memory once
    heights, record = consume(scan, options)
    del scan
    x, y = record.tile_size
    images = record.edges == "mirror"
    pixel = (x / record.tile_pixels[0], y / record.tile_pixels[1])
    part = part_of(heights, pixel, record.file, images=images)
    if not changed and options == NEUTRAL and not record.missing:
        return SolverSurface(preparation=record, part=part)
    sizes = [f"surface.tile_x={x!r}", f"surface.tile_y={y!r}"]
    if surface.get("track"):
        heights = mirrored(heights) if images else heights
        shift_across(heights, y, -float(surface["track"]))
    elif images:
        sizes.append("surface.tile_mirrored=.true.")
    return SolverSurface(np.asfortranarray(heights), tuple(sizes), record, part)
