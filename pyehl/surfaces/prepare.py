# SPDX-License-Identifier: BSD-3-Clause
"""Prepare a measured map as a periodic tile, in recorded steps.

The order is fixed: crop, sign, outliers, align_lines, fill, detrend, rotate, edges. Spikes are
removed before the plane is fitted, because they would tilt it, and missing points are filled before
the map is rotated; the edges are joined last. The record includes artefacts of the levelled map,
see :mod:`pyehl.surfaces.findings`. :func:`pyehl.surfaces.working_map.defaults` resolves 'auto'.
"""

import logging
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import scipy

from pyehl import blas
from pyehl.destination import new_file
from pyehl.errors import InputError
from pyehl.surfaces import findings, map_steps
from pyehl.surfaces.arrays import check_pixels
from pyehl.surfaces.findings import dust_points
from pyehl.surfaces.reading import Scan
from pyehl.surfaces.tile import Topography
from pyehl.surfaces.working_map import NEUTRAL, Options, Record, Step, WorkingMap, defaults
from pyehl.types import Array, Mask

LOG = logging.getLogger(__name__)

SMALLER = "a part of the map: surface.crop_x_min, crop_x_max, crop_y_min, crop_y_max"
RMS_BAND = (1e-10, 1e-4)
"""Rms heights outside this range [m] indicate a wrong unit."""

LARGE = 2**22
"""Number of heights above which steps take seconds and are reported before they begin."""

MAX_JUMP = 3.0
"""Ratio of the steps across the seams to those inside above which the record has a note."""


@dataclass(frozen=True, slots=True)
class Preparation:
    """A prepared tile, with the scan, the options and the record of its preparation."""

    scan: Scan = field(repr=False)
    options: Options  # options used, every 'auto' resolved
    record: Record  # result of each step in numbers
    prepared: Array = field(repr=False)  # map (nx, ny) [m] before its edges were joined
    pixel: tuple[float, float]  # pixel size of map and tile [m]
    # The tile, mean zero: (nx, ny), or (2 nx, 2 ny) if mirrored [m]
    tile: Array = field(repr=False)

    @property
    def steps(self) -> tuple[Step, ...]:
        """The steps that changed the map, in order."""
        return self.record.steps

    @property
    def lengths(self) -> tuple[float, float]:
        """Size of the tile along x and y [m]."""
        return self.tile.shape[0] * self.pixel[0], self.tile.shape[1] * self.pixel[1]

    @property
    def measured_width(self) -> float:
        """Width of the map across the motion, without mirror images [m]."""
        return self.prepared.shape[1] * self.pixel[1]

    def place(self, i: int, j: int) -> tuple[float, float]:
        """Position x, y [m] of pixel (i, j) of the tile on the prepared map, from its corner."""
        nx, ny = self.prepared.shape
        if self.options.edges == "mirror":
            i, j = map_steps.unmirrored(i, j, (nx, ny))
        elif self.options.edges == "window":
            i, j = i % nx, (j + ny // 2) % ny
        return (i % nx) * self.pixel[0], (j % ny) * self.pixel[1]


@blas.one_thread()
def prepare(scan: Scan, options: Options = NEUTRAL) -> Preparation:
    """Prepare the tile of a map as read.

    InputError if a step fails, or the rms height is so large or small that the unit must be wrong;
    NoMemoryError if the map is larger than the memory.
    """
    work, options, why = _prepared(scan, options, keep=True)
    prepared = work.z
    _join(work, options, why)
    tile = map_steps.mirrored(work.z) if options.edges == "mirror" else work.z
    return Preparation(scan, options, work.record(options), prepared, work.pixel, tile)


def consume(scan: Scan, options: Options = NEUTRAL) -> tuple[Array, Record]:
    """Prepare a tile [m] in the memory of `scan`, whose heights are overwritten, with its record.

    A map that is to be mirrored is returned without its images, (nx, ny), because these take four
    times its memory. Exceptions as :func:`prepare`.
    """
    work, options, why = _prepared(scan, options, keep=False)
    _join(work, options, why)
    return work.z, work.record(options)


def _prepared(
    scan: Scan, options: Options, *, keep: bool
) -> tuple[WorkingMap, Options, dict[str, str]]:
    """Do all steps but the last, to a mean of zero; `keep` preserves the heights of `scan`."""
    options, why = defaults(options, scan)
    _report(scan, "numbers")
    work = WorkingMap(scan, keep=keep)
    check_pixels(scan.origin, work.z.shape)
    if any(options.crop):
        work.add_step("crop", ", ".join(f"{v:g}" for v in options.crop),
                map_steps.cropped(work.z, work.pixel, options.crop))  # fmt: skip
    tiles = 4 if keep and options.edges == "mirror" else 1
    check_pixels(scan.origin, work.z.shape, tiles, remedy=SMALLER)
    if options.sign < 0:
        work.add_step("sign", "-1", -work.z)
    complete = bool(np.isfinite(work.z).all())
    valid = None if complete else np.isfinite(work.z)
    if options.outliers > 0.0:
        _report(scan, "outliers")
        spiky = map_steps.prominence(work.z) > options.outliers
        # a median of 5 x 5 points misses specks that cover half of them or more
        spiky |= dust_points(map_steps.levelled(work.z), options.outliers)
        valid = ~spiky if valid is None else valid & ~spiky
        work.begin()
        work.writable()[spiky] = np.nan
        work.add_step("outliers", f"{options.outliers:g}", work.z, changed=int(spiky.sum()))
    if options.align_lines != "none":
        _report(scan, "align_lines")
        work.begin()
        map_steps.align_lines(work.writable(), options.align_lines)
        work.add_step("align_lines", options.align_lines, work.z)
    if valid is not None:
        _report(scan, "fill")
        _fill(work, options, valid)
    if options.detrend != "none":
        _report(scan, "detrend")
        work.begin()
        map_steps.level(work.writable(), options.detrend, valid)
        work.add_step("detrend", options.detrend, work.z, why["detrend"])
    _report(scan, "findings")
    periodic = options.edges == "periodic"
    corner = (options.crop[0], options.crop[2])
    work.findings = findings.find(
        work.z, work.pixel, options.detrend, periodic=periodic, corner=corner
    )
    if options.rotate % 360.0 != 0.0:
        _report(scan, "rotate")
        turned, pixel = map_steps.rotated(work.z, work.pixel, options.rotate)
        work.add_step("rotate", f"{options.rotate:g}", turned, pixel=pixel)
    z = work.writable()
    z -= z.mean()
    _check_rms(scan, float(np.sqrt(np.einsum("ij,ij->", z, z) / z.size)))
    return work, options, why


def _join(work: WorkingMap, options: Options, why: dict[str, str]) -> None:
    """Join the edges of the map to a tile of mean zero; mirror images are added later."""
    prepared = work.z
    if options.edges == "mirror":
        work.add_step("edges", "mirror", prepared, why["edges"])
    elif options.edges == "window":
        tile = map_steps.windowed(prepared)
        work.add_step(
            "edges", "window", tile, why["edges"], changed=map_steps.tapered_points(tile.shape)
        )
        tile -= tile.mean()
    elif (steep := map_steps.jump(prepared)) > MAX_JUMP:
        note = (
            f"the edges do not match: steps across them are {steep:.3g} times those inside; "
            "if the map is not periodic, surface.edges = 'mirror'"
        )
        work.add_step("edges", "periodic", prepared, why["edges"], note=note)


def _fill(work: WorkingMap, options: Options, valid: Mask) -> None:
    """Fill missing points and removed spikes; InputError where `fill` is 'none'."""
    missing = int(valid.size - np.count_nonzero(valid))
    if missing == 0:
        return
    if options.fill == "none":
        i, j = np.argwhere(~valid)[0]
        raise InputError(
            f"{work.origin}: {missing} of {valid.size} heights are missing, the first at row {i}, "
            f"column {j}, and surface.fill = 'none'; with 'harmonic' they are interpolated"
        )
    try:
        full = map_steps.filled(work.z, work.pixel, (options.crop[0], options.crop[2]))
    except ValueError as error:
        raise InputError(f"{work.origin}: {error}") from None
    why = "given" if options.outliers > 0.0 else "the points around them are known"
    work.add_step("fill", options.fill, full, why, changed=missing)


def _report(scan: Scan, step: str) -> None:
    """Log which step of a large map begins."""
    if scan.heights.size >= LARGE:
        nx, ny = scan.heights.shape
        LOG.info("%s: %d x %d heights: %s ...", scan.origin, nx, ny, step)


def _check_rms(scan: Scan, rms: float) -> None:
    """Refuse an rms height that indicates a wrong unit."""
    if not RMS_BAND[0] <= rms <= RMS_BAND[1]:
        raise InputError(
            f"{scan.origin}: rms height {rms:.3g} m is outside {RMS_BAND[0]:g} ... "
            f"{RMS_BAND[1]:g} m; are the heights in m?"
        )


SUFFIXES = (".npy", ".txt", ".nc")
"""Formats in which a tile can be written."""


def write_map(tile: Topography, path: str | Path) -> Path:
    """Write a tile, completely or not at all, in the format of the suffix of the path.

    ``.npy`` has only the heights, (nx, ny) in Fortran order. Text has one x per line and its size
    in the header, ``# length_x = ... m``. netCDF has ``heights(x, y)`` with the coordinates of the
    pixels and their attributes length, unit and periodic, as xarray and SurfaceTopography read
    them. Heights and lengths are in m. InputError for any other suffix; FileError if it cannot be
    written.
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
        # 17 digits, so that the same numbers are read back
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
