# SPDX-License-Identifier: BSD-3-Clause
"""Height maps from files, as they are: `.npy` and text by numpy, all else by SurfaceTopography.

Axes: the first index of a map runs along x, which is the direction of motion, the second along y.
An instrument file is taken as SurfaceTopography gives it: x along the lines of the image (its
width), y across them. A map whose lay or motion is another way is turned by `surface.rotate`.
"""

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from pyehl.errors import EhlError, FileError, InputError
from pyehl.library import check_memory
from pyehl.surfaces.instruments import Foreign, UnknownFormatError, read_instrument
from pyehl.surfaces.memory import check_pixels
from pyehl.surfaces.text_map import UNITS, grid_of, is_list, read_headed, read_text
from pyehl.types import Array

PIXEL_BAND = (1e-10, 1e-3)
"""Pixels outside of it [m] are mistakes of units."""

TEXT_SUFFIXES = (".txt", ".csv", ".dat", ".asc", "")
# Headers of text exports that name sizes or units: Gwyddion, in each of its languages, SPIP and the
# like, and Wyko
EXPORT = re.compile(
    r"(width|šířka|breite|anchura|largeur|larghezza|幅|폭|largura|ширина|"
    r"value units|jednotky hodnot|einheiten|unités|unità valore|値の単位|값 단위|"
    r"unidades de valor|единицы измерения|"
    r"lateral units|[xyz]-unit|x-length|x-pixels|pixel size|file format|unit x|scale x)\s*[:：=]"
    r"|^Wyko ASCII",
    re.IGNORECASE,
)
# First characters of numbers, nan and inf among them
NUMBER_BEGINS = "0123456789+-.nNiI,;"
HEADER_LINES = 100
LEAST_PIXELS = 4


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


def is_array_file(path: str | Path) -> bool:
    """Whether a file is a `.npy` array or plain text, which need no other package.

    Text counts as an array unless it begins with words, or its header is that of an instrument's
    program and names a size or a unit; such exports have their lines along x, as images have.
    OSError if the file cannot be opened.
    """
    path = Path(path)
    if path.suffix.lower() == ".npy":
        return True
    if not _is_text(path):
        return False
    with path.open(encoding="utf-8", errors="replace") as lines:
        first = [line for _, line in zip(range(HEADER_LINES), lines, strict=False)]
    data = next((text for line in first if (text := line.partition("#")[0].strip())), "")
    words = bool(data) and data[0] not in NUMBER_BEGINS
    return not words and not any(EXPORT.search(line) for line in first)


def _is_text(path: Path) -> bool:
    """Whether a file has the name of a text and no byte that a text has not."""
    if path.suffix.lower() not in TEXT_SUFFIXES:
        return False
    with path.open("rb") as stream:
        return all(byte >= 9 for byte in stream.read(4096))


def read_scan(
    path: str | Path,
    length_x: float | None = None,
    length_y: float | None = None,
    channel: str = "",
    height_unit: str = "m",
) -> Scan:
    """Read a height map with its size [m]: needed where the file has none, else in place of it.

    ``.npy`` (never pickled) or text (``.txt``, ``.csv``, ``.dat``, ``.asc``: one x per line, y
    along the line, separated by blanks, commas or semicolons; or a list of the x, y and z of all
    points of a grid), heights in `height_unit` ('m', 'mm', 'um' or 'nm'), as are the places of a
    list, NaN where they are missing; any other file must be one that SurfaceTopography reads, or a
    text with its table under lines of words (:mod:`pyehl.surfaces.text_map`). Where such a file
    names neither size nor unit (MATLAB, HDF5), its heights are in that unit, too.
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
        return _read(path, length_x, length_y, channel, height_unit)
    except EhlError:
        raise
    except OSError as error:
        raise FileError(f"{path}: cannot read: {error.strerror or error}") from error


def _read(
    path: Path, length_x: float | None, length_y: float | None, channel: str, height_unit: str
) -> Scan:
    length = path.stat().st_size
    if length == 0:
        raise InputError(f"{path}: the file is empty")
    if path.suffix.lower() != ".npy":
        # a line of text may be as long as the file; the header of an array tells more
        check_memory(f"{path}: a file of this length", length)
    name, note = "", ""
    array = is_array_file(path)
    if array:
        heights, own, periodic = _read_array(path, channel)
    else:
        heights, own, periodic, name, note = _read_foreign(path, channel)
    if height_unit != "m":
        if not array and not note:
            raise InputError(
                f"{path}: surface.height_unit = '{height_unit}', but the file names its unit itself"
            )
        heights *= UNITS[height_unit]
        note = f"heights in {height_unit} by surface.height_unit"
    if is_list(heights):
        heights, own = grid_of(path, heights)
    _check_shape(path, heights.shape)
    x, y = length_x or own[0], length_y or own[1]
    if x is None or y is None:
        missing = (f"surface.length_{k}" for k, size in (("x", x), ("y", y)) if size is None)
        raise InputError(
            f"{path}: the size of the map is not known: the file has none; "
            f"give {' and '.join(missing)} [m]"
        )
    given_names = [f"surface.{k}" for k, v in (("length_x", length_x), ("length_y", length_y)) if v]
    size_from = ", ".join(given_names) or "the file"
    if len(given_names) == 1:
        size_from += " and the file"
    if given_names and own != (None, None):
        size_from += f" (in place of {own[0]:.6g} x {own[1]:.6g} m of the file)"
    scan = Scan(heights, float(x), float(y), str(path), array, periodic, name, size_from, note)
    _check_pixel(scan)
    return scan


def _read_foreign(path: Path, channel: str) -> Foreign:
    """Read a file of an instrument, or a table under lines of words."""
    found = None
    may_be_table = not channel and _is_text(path)
    try:
        found = read_instrument(path, channel)
    except UnknownFormatError:
        if not may_be_table:
            raise
    # a text whose unit SurfaceTopography does not see may name it in words
    if found is not None and not (found[-1] and may_be_table):
        return found
    try:
        return read_headed(path)
    except InputError:
        if found is None:
            raise
        return found


def _read_array(path: Path, channel: str) -> tuple[Array, tuple[float | None, float | None], bool]:
    """Heights, the size if the file has it, and whether it says 'periodic'."""
    if channel:
        raise InputError(
            f"{path}: surface.channel = '{channel}', but .npy and text hold one map alone"
        )
    if path.suffix.lower() == ".npy":
        return _read_npy(path), (None, None), False
    return read_text(path)


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
                "surface.height_unit is the unit of heights, and of a list of x, y and z"
            )


def plain_array(path: str) -> bool:
    """Whether a file is one that the solver reads itself: ``.npy`` of little-endian floats."""
    if not path.endswith(".npy"):
        return False
    return bool(np.load(path, mmap_mode="r", allow_pickle=False).dtype.str in {"<f8", "<f4"})


def _read_npy(path: Path) -> Array:
    try:
        # mapped, so that the header is checked before the data are read
        raw = np.load(path, mmap_mode="r", allow_pickle=False)
    except (OSError, MemoryError):
        raise
    except Exception as error:
        # a damaged header makes numpy raise whatever the parser of Python does
        raise InputError(f"{path}: not a readable .npy file of numbers: {error}") from None
    if raw.ndim != 2:
        raise InputError(f"{path}: heights must be a matrix (nx, ny), not of shape {raw.shape}")
    if raw.dtype.kind not in "fiu":
        raise InputError(f"{path}: heights must be real numbers, not {raw.dtype}")
    check_pixels(str(path), raw.shape)
    return np.array(raw, dtype=float, order="C")
