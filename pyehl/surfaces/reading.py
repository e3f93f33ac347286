# SPDX-License-Identifier: BSD-3-Clause
"""Height maps from files, as they are: `.npy` and text by numpy, all else by SurfaceTopography.

Axes: the first index of a map runs along x, which is the direction of motion, the second along y.
An instrument file is taken as SurfaceTopography gives it: x along the lines of the image (its
width), y across them. A map whose lay or motion is another way is turned by `surface.rotate`.
"""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from pyehl.errors import EhlError, FileError, InputError
from pyehl.library import check_memory
from pyehl.surfaces import sense
from pyehl.surfaces.arrays import read_npy
from pyehl.surfaces.found import UNITS, Found, Sizes
from pyehl.surfaces.instruments import UnknownFormatError, read_instrument
from pyehl.surfaces.text_file import encoding_of
from pyehl.surfaces.text_map import LEAST_PIXELS, matrix_map, read_text_map
from pyehl.surfaces.texts import read_known_text
from pyehl.types import Array

PIXEL_BAND = (1e-10, 1e-3)
"""Pixels outside of it [m] are mistakes of units."""
CLEAR_BAND = (2e-8, 1e-4)
"""Pixels outside of it [m] are asked for, where x and y are in the unit of the heights by default:
heights in m beside places in mm would be a map of the size of a table."""
SAME = "same"
"""The unit of places is that of the heights."""

TEXT_SUFFIXES = (".txt", ".csv", ".dat", ".asc", ".xyz", ".tsv", ".tab", ".prn", "")


@dataclass(frozen=True, slots=True)
class Scan:
    """A height map as a file has it."""

    # (nx, ny) [m], peaks positive, NaN where the instrument saw nothing. Pixel [i, j] lies at x = i
    # length_x/nx, y = j length_y/ny
    heights: Array
    # Size [m]
    length_x: float
    length_y: float
    origin: str  # name of the file
    # Whether it is an array (`.npy`, text), with no word about how it came about, or a file of an
    # instrument
    is_array: bool = True
    is_periodic: bool = False  # whether the file says that the map can be repeated without a seam
    channel: str = ""  # name of the channel or data set; empty for arrays
    # Where the size is from: 'the file' or 'surface.length_x, surface.length_y'
    size_from: str = "surface.length_x, surface.length_y"
    note: str = ""  # what a person should know besides; mostly empty


def read_scan(
    path: str | Path,
    length_x: float | None = None,
    length_y: float | None = None,
    channel: str = "",
    height_unit: str = "m",
    lateral_unit: str = SAME,
) -> Scan:
    """Read a height map with its size [m]: needed where the file has none, else in place of it.

    ``.npy`` (never pickled) or text (``.txt``, ``.csv``, ``.dat``, ``.asc``: one x per line, y
    along the line, separated by blanks, commas, semicolons or tabs; a table under lines of words,
    or with axes; or a list of the x, y and z of all points of a grid, see
    :mod:`pyehl.surfaces.text_map`), NaN where heights are missing; any other file must be one that
    SurfaceTopography reads. Heights are in `height_unit` ('m', 'mm', 'um' or 'nm') where the file
    names no unit of theirs, the places of a list or of axes in `lateral_unit` (or 'same': that of
    the heights).
    `channel` is the name of a channel of an instrument file, or its number, counted from 1; empty:
    the one that the file calls its first height channel.

    FileError if the file cannot be opened; NoMemoryError if it is larger than the memory;
    InputError if it is no matrix of numbers, has no size, has no such channel or its size cannot
    be meant.
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
        # a line of text may be as long as the file; the header of an array tells more
        check_memory(f"{path}: a file of this length", length)
    found = _found(path, channel)
    notes = [*found.notes, *_measured(path, found, height_unit)]
    _check_shape(path, found.heights.shape)
    own, why = _own_size(path, found, lateral_unit, height_unit)
    x, y = given[0] or own[0], given[1] or own[1]
    if x is None or y is None:
        missing = (f"surface.length_{k}" for k, size in (("x", x), ("y", y)) if size is None)
        unit = "" if not found.no_size or found.size_in_metres else ", or surface.lateral_unit"
        raise InputError(
            f"{path}: the size of the map is not known: {found.no_size or 'the file has none'}; "
            f"give {' and '.join(missing)} [m]{unit}"
        )
    given_names = [
        f"surface.{k}" for k, v in zip(("length_x", "length_y"), given, strict=True) if v
    ]
    size_from = ", ".join(given_names) or "the file"
    if len(given_names) == 1:
        size_from += " and the file"
    if given_names and own != (None, None):
        said = " x ".join("?" if size is None else f"{size:.6g}" for size in own)
        size_from += f" (in place of {said} m of the file)"
    if not all(given):
        notes += why
    scan = Scan(
        found.heights,
        float(x),
        float(y),
        str(path),
        found.is_array,
        found.is_periodic,
        found.channel,
        size_from,
        "; ".join(notes),
    )
    _check_pixel(scan)
    return _sensible(scan)


def _found(path: Path, channel: str) -> Found:
    """Read a file by the reader that knows it."""
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


def _measured(path: Path, found: Found, height_unit: str) -> list[str]:
    """Heights in metres, without marks of missing points; notes on both."""
    if found.height_unit is not None and height_unit != "m":
        raise InputError(
            f"{path}: surface.height_unit = '{height_unit}', but the file names its unit itself"
        )
    notes = sense.unmarked(found.heights, found.height_unit) + sense.doubts(found.heights)
    if found.height_unit is None:
        found.heights *= UNITS[height_unit]
        if height_unit != "m":
            notes.append(f"heights in {height_unit} by surface.height_unit")
        elif not found.is_array:
            notes.append("the file names no unit: its heights are taken in m")
    elif found.height_unit != 1.0:
        found.heights *= found.height_unit
    return notes


def _own_size(
    path: Path, found: Found, lateral_unit: str, height_unit: str
) -> tuple[Sizes, list[str]]:
    """Size that the file has [m], and notes on its unit."""
    x, y = found.size
    for name, size in (("length_x", x), ("length_y", y)):
        if size is not None and not size > 0.0:
            raise InputError(f"{path}: its header gives {name} = {size:g}: it is damaged")
    if found.size_in_metres or (x is None and y is None):
        if lateral_unit != SAME:
            raise InputError(
                f"{path}: surface.lateral_unit = '{lateral_unit}', but the file "
                f"{'has no size' if x is None else 'names its unit itself'}"
            )
        return (x, y), []
    if lateral_unit == SAME and found.ask_lateral_unit:
        return (None, None), []
    named = height_unit if lateral_unit == SAME else lateral_unit
    own = x and x * UNITS[named], y and y * UNITS[named]
    pixel = min(s / n for s, n in zip(own, found.heights.shape, strict=True) if s)
    clear = found.height_unit is None and CLEAR_BAND[0] <= pixel <= CLEAR_BAND[1]
    if lateral_unit == SAME and not clear:
        found.no_size = (
            f"it has steps of {pixel / UNITS[named]:.6g}, and the file does not name their unit"
        )
        return (None, None), []
    key = "height_unit" if lateral_unit == SAME else "lateral_unit"
    return own, [f"x and y in {named} by surface.{key}: steps of {pixel:.6g} m"]


def _sensible(scan: Scan) -> Scan:
    """Refuse heights that are steeper than any surface, and note where some are."""
    nx, ny = scan.heights.shape
    usual, share = sense.slopes(scan.heights, (scan.length_x / nx, scan.length_y / ny))
    if usual > sense.STEEP:
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
    """Refuse what is no map."""
    if min(shape) < LEAST_PIXELS:
        lines = ("a profile along one line", "a profile of x and z")
        what = f"; is it {lines[shape[1] - 1]}?" if shape[1] <= len(lines) < shape[0] else ""
        raise InputError(
            f"{path}: the map must have at least {LEAST_PIXELS} x {LEAST_PIXELS} pixels, "
            f"not {shape[0]} x {shape[1]}{what}"
        )


def _check_pixel(scan: Scan) -> None:
    """Refuse pixels that can only be a mistake of units."""
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
    """Whether a file is one that the solver reads itself: ``.npy`` of little-endian floats.

    All of it are heights, without axes.
    """
    if not path.endswith(".npy"):
        return False
    array = np.load(path, mmap_mode="r", allow_pickle=False)
    return array.dtype.str in {"<f8", "<f4"} and array.shape == shape
