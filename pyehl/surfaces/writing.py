# SPDX-License-Identifier: BSD-3-Clause
"""Tiles as files: `.npy`, text and netCDF, with their size."""

from pathlib import Path

import numpy as np
import scipy

from pyehl.destination import new_file
from pyehl.errors import InputError
from pyehl.surfaces.tile import Topography

SUFFIXES = (".npy", ".txt", ".nc")
"""What a tile can be written as."""


def write_map(tile: Topography, path: str | Path) -> Path:
    """Write a tile, whole or not at all; the suffix of the path says as what.

    ``.npy`` holds the heights alone, (nx, ny) in Fortran order. Text has one x per line and its
    size in the header, ``# length_x = ... m``. netCDF holds ``heights(x, y)`` with the coordinates
    of the pixels, their length, unit and that they are periodic, as xarray and SurfaceTopography
    read it. Heights and lengths are in m. InputError for any other suffix; FileError if it cannot
    be written.
    """
    path = Path(path)
    writers = {".npy": _write_npy, ".txt": _write_text, ".nc": _write_netcdf}
    if path.suffix not in writers:
        raise InputError(f"{path}: a map is written as one of {', '.join(SUFFIXES)}")
    with new_file(path) as partial:
        writers[path.suffix](tile, partial)
    return path


def _write_npy(tile: Topography, path: Path) -> None:
    with path.open("wb") as stream:
        np.save(stream, np.asfortranarray(tile.heights))


def _write_text(tile: Topography, path: Path) -> None:
    header = (
        "heights [m] of a tile, one x per line, y along the line\n"
        f"length_x = {tile.length_x!r} m\nlength_y = {tile.length_y!r} m\nperiodic"
    )
    with path.open("wb") as stream:
        # 17 digits: the same numbers when it is read
        np.savetxt(stream, tile.heights, fmt="%.17g", header=header)


def _write_netcdf(tile: Topography, path: Path) -> None:
    with scipy.io.netcdf_file(path, "w", version=2) as file:
        file.Conventions = "CF-1.8"
        file.title = tile.origin or "tile of heights"
        lengths = (tile.length_x, tile.length_y)
        for name, n, length in zip("xy", tile.shape, lengths, strict=True):
            file.createDimension(name, n)
            axis = file.createVariable(name, "f8", (name,))
            axis[:] = np.arange(n) * (length / n)
            axis.length = np.float64(length)
            axis.periodic = np.int32(1)
            axis.unit = axis.units = "m"
        heights = file.createVariable("heights", "f8", ("x", "y"))
        heights[:] = tile.heights
        heights.unit = heights.units = "m"
        heights.long_name = "height, peaks positive"
