# SPDX-License-Identifier: BSD-3-Clause
"""Height maps from files, as tiles."""

from __future__ import annotations

from pathlib import Path

from pyehl.surfaces.options import NEUTRAL, Options
from pyehl.surfaces.prepare import prepare
from pyehl.surfaces.reading import Scan, read_scan
from pyehl.surfaces.tile import Topography

__all__ = ["read_map", "tile_of"]


def tile_of(scan: Scan, options: Options = NEUTRAL) -> Topography:
    """Prepare a map, see :func:`pyehl.surfaces.prepare.prepare`; the tile carries the record."""
    made = prepare(scan, options)
    return Topography(made.tile, made.lengths, scan.origin, None, made)


def read_map(
    path: str | Path,
    length_x: float | None = None,
    length_y: float | None = None,
    channel: str = "",
    options: Options = NEUTRAL,
) -> Topography:
    """Read a height map and make a tile of it.

    Parameters
    ----------
    path, length_x, length_y, channel
        As in :func:`pyehl.surfaces.reading.read_scan`.
    options
        How it is prepared. By default an array keeps its heights but for their mean, and a file of
        an instrument is levelled and mirrored.

    Raises
    ------
    OSError
        If the file cannot be opened.
    InputError
        If it cannot be read or prepared.
    """
    return tile_of(read_scan(path, length_x, length_y, channel), options)
