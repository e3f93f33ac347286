# SPDX-License-Identifier: BSD-3-Clause
"""Height maps from files, as they are: `.npy` and text by numpy, all else by SurfaceTopography.

Axes: the first index of a map runs along x, which is the direction of motion, the second along y.
An instrument file has the axes of SurfaceTopography: x along the lines of the image (its width), y
across them. `surface.rotate` rotates a map with another direction of lay or motion.

Texts of known programs are read by their own rules. Implausible heights
(:mod:`pyehl.surfaces.plausibility`) are reported, a map of implausible slope is refused.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import islice
from pathlib import Path

import numpy as np

from pyehl.errors import EhlError, FileError, InputError
from pyehl.library import check_memory
from pyehl.surfaces.arrays import UNITS, Found, Sizes, encoding_of, lines_of, read_npy
from pyehl.surfaces.instruments import UnknownFormatError, read_instrument
from pyehl.surfaces.plausibility import STEEP, doubts, slopes, unmarked
from pyehl.surfaces.text_map import MIN_PIXELS, matrix_map, read_text_map
from pyehl.surfaces.text_table import HEADER_LINES, tables_of
from pyehl.surfaces.variants import ZYGO_MAGIC, read_zygo
from pyehl.types import Array

# Headers of Wyko, SPIP, Attocube and Nova, which SurfaceTopography knows; the heights need factors
# of the header
FLAVOUR = re.compile(
    r"^Wyko ASCII|^#\s*File Format\s*=\s*ASCII|^\s*(?:Unit|Scale) (?:X|Data)\s*="
    r"|height\s+conversion\s+factor",
    re.IGNORECASE,
)
# Header of a Mahr stylus instrument
PROFILE = re.compile(r"\bPRF\s*$")
# Magic numbers of formats that have a reader
MARKED = ("aISO-1.0", "aBCR-1", "fileformat = bcr")


def read_known_text(path: Path, encoding: str, channel: str) -> Found | None:
    """Read a text of a known program; None if the program is unknown.

    InputError if it is a profile along a line, or cannot be read.
    """
    first = [line for _, line in islice(lines_of(path, encoding), HEADER_LINES)]
    if not first:
        return None
    if first[0].startswith(ZYGO_MAGIC):
        return _zygo(path, encoding, channel)
    if first[0].startswith(MARKED):
        return read_instrument(path, channel)
    if first[0].startswith("X;Y;valid") or (len(first) > 1 and PROFILE.search(first[1])):
        raise InputError(
            f"{path}: it is a profile along a line; a contact needs the map of an area"
        )
    if any(FLAVOUR.search(line) for line in first):
        return _flavoured(path, encoding, channel)
    return None


def _zygo(path: Path, encoding: str, channel: str) -> Found:
    """Read a text of Zygo."""
    if channel:
        raise InputError(f"{path}: surface.channel = '{channel}', but the file holds one map alone")
    try:
        read = read_zygo(line for _, line in lines_of(path, encoding))
    except (ValueError, IndexError) as error:
        raise InputError(f"{path}: cannot be read as a Zygo text file: {error}") from None
    result = Found(read.heights, height_unit=1.0)
    if read.pixel > 0.0:
        nx, ny = read.heights.shape
        result.size = nx * read.pixel, ny * read.pixel
    else:
        result.no_size = "line 8 of the file gives no size of a pixel"
    return result


def _flavoured(path: Path, encoding: str, channel: str) -> Found:
    """Read a text whose header SurfaceTopography knows, after reading and counting all lines."""
    tables = tables_of(path, encoding)

    def lines() -> Iterator[str]:
        for table in tables:
            yield from table.header
            yield from ("\t".join(map(repr, row.tolist())) for row in table.rows)

    result = read_instrument(path, channel, "\n".join(lines()).encode())
    sizes = {table.rows.size for table in tables}
    if result.heights.size not in sizes:
        raise InputError(
            f"{path}: the file has {' or '.join(map(str, sorted(sizes)))} heights, and "
            f"{result.heights.size} were read"
        )
    return result


PIXEL_BAND = (1e-10, 1e-3)
"""Pixel sizes outside this range [m] indicate a wrong unit."""
CLEAR_BAND = (2e-8, 1e-4)
"""Pixel sizes outside this range [m] need an explicit unit. Its default is that of the heights, but
heights in m with positions in mm would make a map as large as a table."""
SAME = "same"
"""The unit of the positions is that of the heights."""

TEXT_SUFFIXES = (".txt", ".csv", ".dat", ".asc", ".xyz", ".tsv", ".tab", ".prn", "")


@dataclass(frozen=True, slots=True)
class Scan:
    """A height map as read from a file."""

    # (nx, ny) [m], peaks positive, NaN where not measured. Pixel [i, j] lies at x = i length_x/nx,
    # y = j length_y/ny
    heights: Array
    # Size [m]
    length_x: float
    length_y: float
    origin: str  # name of the file
    # Whether it is an array (`.npy`, text) without information on its origin, or a file of an
    # instrument
    is_array: bool = True
    is_periodic: bool = False  # whether the file states that the map is periodic
    channel: str = ""  # name of the channel or data set; empty for arrays
    # Source of the size in words, as 'the file' or 'surface.length_x, surface.length_y'
    size_from: str = "surface.length_x, surface.length_y"
    note: str = ""  # remark for the user; usually empty


def read_scan(
    path: str | Path,
    length_x: float | None = None,
    length_y: float | None = None,
    channel: str = "",
    height_unit: str = "m",
    lateral_unit: str = SAME,
) -> Scan:
    """Read a height map; a given size [m] replaces that of the file, which may have none.

    ``.npy`` (never pickled) or text, whatever its suffix (one x per line, y along the line,
    separated by blanks, commas, semicolons or tabs; a table under a header, or with axes; or a list
    of the x, y and z of all points of a grid, see :mod:`pyehl.surfaces.text_map`), NaN where
    heights are missing; any other file must be one that SurfaceTopography reads. Heights are in
    `height_unit` ('m', 'mm', 'um' or 'nm') if the file does not name their unit, positions of a
    list or of axes in `lateral_unit` (or 'same': that of the heights). `channel` is the name of a
    channel of an instrument file or of a table of a text, or its number, counted from 1; empty: the
    first height channel according to the file.

    FileError if the file cannot be opened; NoMemoryError if it is larger than the memory;
    InputError if it is no matrix of numbers, has no size or no such channel, names a unit that is
    given, too, or its size or its slopes are implausible.
    """
    path = Path(path)
    if not path.is_file():
        raise FileError(f"{path}: no such height map")
    try:
        return _read(path, (length_x, length_y), channel, height_unit, lateral_unit)
    except EhlError:
        raise
    except OSError as error:
        raise FileError(f"{path}: cannot read: {error.strerror or error}") from error


def _read(path: Path, given: Sizes, channel: str, height_unit: str, lateral_unit: str) -> Scan:
    length = path.stat().st_size
    if length == 0:
        raise InputError(f"{path}: the file is empty")
    if path.suffix.lower() != ".npy":
        # a line of text may be as long as the file; the header of an array states its size
        check_memory(f"{path}: a file of this length", length)
    result = _found(path, channel)
    notes = [*result.notes, *_measured(path, result, height_unit)]
    _check_shape(path, result.heights.shape)
    own, why = _own_size(path, result, lateral_unit, height_unit)
    x, y = given[0] or own[0], given[1] or own[1]
    if x is None or y is None:
        missing = (f"surface.length_{k}" for k, size in (("x", x), ("y", y)) if size is None)
        unit = "" if not result.no_size or result.size_in_metres else ", or surface.lateral_unit"
        raise InputError(
            f"{path}: the size of the map is not known: {result.no_size or 'the file has none'}; "
            f"give {' and '.join(missing)} [m]{unit}"
        )
    given_names = [
        f"surface.{k}" for k, v in zip(("length_x", "length_y"), given, strict=True) if v
    ]
    size_from = ", ".join(given_names) or "the file"
    if len(given_names) == 1:
        size_from += " and the file"
    if given_names and own != (None, None):
        of_file = " x ".join("?" if size is None else f"{size:.6g}" for size in own)
        size_from += f" (in place of {of_file} m of the file)"
    if not all(given):
        notes += why
    scan = Scan(
        result.heights,
        float(x),
        float(y),
        str(path),
        result.is_array,
        result.is_periodic,
        result.channel,
        size_from,
        "; ".join(notes),
    )
    _check_pixel(scan)
    return _sensible(scan)


def _found(path: Path, channel: str) -> Found:
    """Read a file by the reader for its format."""
    if path.suffix.lower() == ".npy":
        if channel:
            raise InputError(
                f"{path}: surface.channel = '{channel}', but .npy and text hold one map alone"
            )
        return matrix_map(path, read_npy(path))
    encoding = encoding_of(path)
    if encoding is None:
        return read_instrument(path, channel)
    known = read_known_text(path, encoding, channel)
    if known is not None:
        return known
    if path.suffix.lower() in TEXT_SUFFIXES:
        return read_text_map(path, encoding, channel)
    try:
        return read_instrument(path, channel)
    except UnknownFormatError:
        return read_text_map(path, encoding, channel)


def _measured(path: Path, result: Found, height_unit: str) -> list[str]:
    """Convert heights to metres, without marks of missing points; returns notes on both."""
    if result.height_unit is not None and height_unit != "m":
        raise InputError(
            f"{path}: surface.height_unit = '{height_unit}', but the file names its unit itself"
        )
    notes = unmarked(result.heights, result.height_unit) + doubts(result.heights)
    if result.height_unit is None:
        result.heights *= UNITS[height_unit]
        if height_unit != "m":
            notes.append(f"heights in {height_unit} by surface.height_unit")
        elif not result.is_array:
            notes.append("the file names no unit: its heights are taken in m")
    elif result.height_unit != 1.0:
        result.heights *= result.height_unit
    return notes


def _own_size(
    path: Path, result: Found, lateral_unit: str, height_unit: str
) -> tuple[Sizes, list[str]]:
    """Return the size stated in the file [m], and notes on its unit."""
    x, y = result.size
    for name, size in (("length_x", x), ("length_y", y)):
        if size is not None and not size > 0.0:
            raise InputError(f"{path}: its header gives {name} = {size:g}: it is damaged")
    if result.size_in_metres or (x is None and y is None):
        if lateral_unit != SAME:
            raise InputError(
                f"{path}: surface.lateral_unit = '{lateral_unit}', but the file "
                f"{'has no size' if x is None else 'names its unit itself'}"
            )
        return (x, y), []
    if lateral_unit == SAME and result.ask_lateral_unit:
        return (None, None), []
    named = height_unit if lateral_unit == SAME else lateral_unit
    own = x and x * UNITS[named], y and y * UNITS[named]
    pixel = min(s / n for s, n in zip(own, result.heights.shape, strict=True) if s)
    clear = result.height_unit is None and CLEAR_BAND[0] <= pixel <= CLEAR_BAND[1]
    if lateral_unit == SAME and not clear:
        result.no_size = (
            f"it has steps of {pixel / UNITS[named]:.6g}, and the file does not name their unit"
        )
        return (None, None), []
    key = "height_unit" if lateral_unit == SAME else "lateral_unit"
    return own, [f"x and y in {named} by surface.{key}: steps of {pixel:.6g} m"]


def _sensible(scan: Scan) -> Scan:
    """Refuse heights that are steeper than any surface, and note steep steps."""
    nx, ny = scan.heights.shape
    usual, share = slopes(scan.heights, (scan.length_x / nx, scan.length_y / ny))
    if usual > STEEP:
        raise InputError(
            f"{scan.origin}: the heights have a slope of {usual:.3g} nearly everywhere: a unit is "
            "wrong, of the heights (surface.height_unit; are they in m?), of x and y "
            f"(surface.lateral_unit) or of the size, {scan.length_x:.4g} x {scan.length_y:.4g} m"
            + (f"\nknown: {scan.note}" if scan.note else "")
        )
    if share > 0.0:
        steep = (
            f"{100.0 * share:.2g} % of the steps from point to point are steeper than 45 degrees: "
            "spikes, or marks of missing points"
        )
        scan = replace(scan, note="; ".join(filter(None, (scan.note, steep))))
    return scan


def _check_shape(path: Path, shape: tuple[int, ...]) -> None:
    """Refuse a map with too few pixels."""
    if min(shape) < MIN_PIXELS:
        lines = ("a profile along one line", "a profile of x and z")
        what = f"; is it {lines[shape[1] - 1]}?" if shape[1] <= len(lines) < shape[0] else ""
        raise InputError(
            f"{path}: the map must have at least {MIN_PIXELS} x {MIN_PIXELS} pixels, "
            f"not {shape[0]} x {shape[1]}{what}"
        )


def _check_pixel(scan: Scan) -> None:
    """Refuse pixel sizes that indicate a wrong unit."""
    sides = zip(("x", "y"), (scan.length_x, scan.length_y), scan.heights.shape, strict=True)
    for axis, length, pixels in sides:
        pixel = length / pixels
        if not PIXEL_BAND[0] <= pixel <= PIXEL_BAND[1]:
            raise InputError(
                f"{scan.origin}: length_{axis} = {length:.4g} m gives a pixel of {pixel:.3g} m, "
                f"outside {PIXEL_BAND[0]:g} ... {PIXEL_BAND[1]:g} m; is the length in m? "
                "surface.height_unit is the unit of heights, surface.lateral_unit that of a list "
                "of x, y and z"
            )


def plain_array(path: str, shape: tuple[int, ...]) -> bool:
    """Whether the solver reads a file itself: ``.npy`` of little-endian floats without axes."""
    if not path.endswith(".npy"):
        return False
    array = np.load(path, mmap_mode="r", allow_pickle=False)
    return array.dtype.str in {"<f8", "<f4"} and array.shape == shape
