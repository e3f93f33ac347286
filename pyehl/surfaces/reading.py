# SPDX-License-Identifier: BSD-3-Clause
"""Height maps from files, as they are: `.npy` and text by numpy, all else by SurfaceTopography.

Axes: the first index of a map runs along x, which is the direction of motion, the second along y.
An instrument file is taken as SurfaceTopography gives it: x along the lines of the image (its
width), y across them. A map whose lay or motion is another way is turned by `surface.rotate`.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pyehl.surfaces.instruments import read_instrument
from pyehl.surfaces.memory import check_pixels

__all__ = ["Scan", "is_array_file", "plain_array", "read_scan"]

Array = NDArray[np.float64]

PIXEL_BAND = (1e-10, 1e-3)
"""Pixels outside of it [m] are mistakes of units."""

TEXT_SUFFIXES = (".txt", ".csv", ".dat", ".asc", "")
# Headers of text exports that name sizes or units: Gwyddion, in each of its languages, SPIP and the
# like, and Wyko; for the program ehl fortran/case/map_needs.f90 tells the same
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
# What stands between separators
WORD = re.compile(r"[^\s,;]+")
OWN_SIZE = re.compile(r"^#\s*(length_[xy])\s*=\s*(\S+)\s*m\s*$")
OWN_PERIODIC = re.compile(r"^#\s*periodic\s*$")
HEADER_LINES = 100
LEAST_PIXELS = 4


@dataclass(frozen=True, slots=True)
class Scan:
    """A height map as a file has it.

    Attributes
    ----------
    heights
        (nx, ny) [m], peaks positive, NaN where the instrument saw nothing. Pixel [i, j] lies at
        x = i length_x/nx, y = j length_y/ny.
    length_x, length_y
        Size [m].
    origin
        Name of the file.
    is_array
        Whether it is an array (`.npy`, text), with no word about how it came about, or a file of
        an instrument.
    is_periodic
        Whether the file says that the map can be repeated without a seam.
    channel
        Name of the channel or data set; empty for arrays.
    size_from
        Where the size is from: 'the file' or 'surface.length_x, surface.length_y'.
    note
        What a person should know besides; mostly empty.
    """

    heights: Array
    length_x: float
    length_y: float
    origin: str
    is_array: bool = True
    is_periodic: bool = False
    channel: str = ""
    size_from: str = "surface.length_x, surface.length_y"
    note: str = ""


def is_array_file(path: str | Path) -> bool:
    """Whether a file is a `.npy` array or plain text, which need no other package.

    Text counts as an array unless it begins with words, or its header is that of an instrument's
    program and names a size or a unit; such exports have their lines along x, as images have.

    Raises
    ------
    OSError
        If the file cannot be opened.
    """
    path = Path(path)
    suffix = path.suffix.lower()
    if suffix == ".npy":
        return True
    if suffix not in TEXT_SUFFIXES:
        return False
    with path.open("rb") as stream:
        head = stream.read(4096)
    if b"\0" in head or any(byte < 9 for byte in head):
        return False
    with path.open(encoding="utf-8", errors="replace") as lines:
        first = [line for _, line in zip(range(HEADER_LINES), lines, strict=False)]
    data = next((text for line in first if (text := line.partition("#")[0].strip())), "")
    words = bool(data) and data[0] not in NUMBER_BEGINS
    return not words and not any(EXPORT.search(line) for line in first)


def read_scan(
    path: str | Path,
    length_x: float | None = None,
    length_y: float | None = None,
    channel: str = "",
) -> Scan:
    """Read a height map with its size.

    Parameters
    ----------
    path
        ``.npy`` (never pickled) or text (``.txt``, ``.csv``, ``.dat``, ``.asc``: one x per line, y
        along the line, separated by blanks, commas or semicolons), heights in m, NaN where they
        are missing; any other file must be one that SurfaceTopography reads. Where such a file
        names neither size nor unit (MATLAB, HDF5), its heights are taken in m, too.
    length_x, length_y
        Size [m]. Needed where the file has none; replaces that of the file.
    channel
        Name of a channel of an instrument file, or its number, counted from 1; empty: the one
        that the file calls its first height channel.

    Raises
    ------
    OSError
        If the file cannot be opened.
    ValueError
        If it is no matrix of numbers, has no size, has no such channel, is larger than the memory
        or its size cannot be meant.
    """
    path = Path(path)
    if not path.is_file():
        raise FileNotFoundError(f"{path}: no such height map")
    if path.stat().st_size == 0:
        raise ValueError(f"{path}: the file is empty")
    own: tuple[float | None, float | None] = (None, None)
    periodic, name, note = False, "", ""
    array = is_array_file(path)
    if array:
        if channel:
            raise ValueError(
                f"{path}: surface.channel = '{channel}', but .npy and text hold one map alone"
            )
        if path.suffix.lower() == ".npy":
            heights = _read_npy(path)
        else:
            heights, own, periodic = _read_text(path)
    else:
        heights, own, periodic, name, note = read_instrument(path, channel, (length_x, length_y))
    _check_shape(path, heights.shape)
    sizes = []
    for key, given, found in zip(("length_x", "length_y"), (length_x, length_y), own, strict=True):
        size = given or found
        if size is None:
            raise ValueError(
                f"{path}: the size of the map is not known: the file has none; "
                f"give surface.{key} [m]"
            )
        sizes.append(float(size))
    given_names = [f"surface.{k}" for k, v in (("length_x", length_x), ("length_y", length_y)) if v]
    size_from = ", ".join(given_names) or "the file"
    if len(given_names) == 1:
        size_from += " and the file"
    if given_names and own != (None, None):
        size_from += f" (in place of {own[0]:.6g} x {own[1]:.6g} m of the file)"
    scan = Scan(heights, sizes[0], sizes[1], str(path), array, periodic, name, size_from, note)
    _check_pixel(scan)
    return scan


def _check_shape(path: Path, shape: tuple[int, ...]) -> None:
    """Refuse what is no map."""
    if min(shape) < LEAST_PIXELS:
        lines = ("a profile along one line", "a profile of x and z", "a list of x, y and z")
        what = f"; is it {lines[shape[1] - 1]}?" if shape[1] <= len(lines) < shape[0] else ""
        raise ValueError(
            f"{path}: the map must have at least {LEAST_PIXELS} x {LEAST_PIXELS} pixels, "
            f"not {shape[0]} x {shape[1]}{what}"
        )


def _check_pixel(scan: Scan) -> None:
    """Refuse pixels that can only be a mistake of units."""
    sides = zip(("x", "y"), (scan.length_x, scan.length_y), scan.heights.shape, strict=True)
    for axis, length, pixels in sides:
        pixel = length / pixels
        if not PIXEL_BAND[0] <= pixel <= PIXEL_BAND[1]:
            raise ValueError(
                f"{scan.origin}: length_{axis} = {length:.4g} m gives a pixel of {pixel:.3g} m, "
                f"outside {PIXEL_BAND[0]:g} ... {PIXEL_BAND[1]:g} m; is the length in m?"
            )


def plain_array(path: str) -> bool:
    """Whether a file is one that the solver reads itself: text, or little-endian float64."""
    if not path.endswith(".npy"):
        return True
    return bool(np.load(path, mmap_mode="r", allow_pickle=False).dtype.str == "<f8")


def _read_npy(path: Path) -> Array:
    try:
        # mapped, so that the header is checked before the data are read
        raw = np.load(path, mmap_mode="r", allow_pickle=False)
    except (OSError, MemoryError):
        raise
    except Exception as error:
        # a damaged header makes numpy raise whatever the parser of Python does
        raise ValueError(f"{path}: not a readable .npy file of numbers: {error}") from None
    if raw.ndim != 2:
        raise ValueError(f"{path}: heights must be a matrix (nx, ny), not of shape {raw.shape}")
    if raw.dtype.kind not in "fiu":
        raise ValueError(f"{path}: heights must be real numbers, not {raw.dtype}")
    check_pixels(str(path), raw.shape)
    return np.array(raw, dtype=float, order="C")


def _read_text(path: Path) -> tuple[Array, tuple[float | None, float | None], bool]:
    """Heights, the size if the header has it, and whether it says 'periodic'."""
    size: dict[str, float | None] = {"length_x": None, "length_y": None}
    periodic = False
    rows: list[Array] = []
    with path.open(encoding="utf-8", errors="replace") as lines:
        for number, line in enumerate(lines, 1):
            if match := OWN_SIZE.match(line):
                size[match[1]] = float(match[2])
            periodic = periodic or bool(OWN_PERIODIC.match(line))
            row = _row(path, number, line)
            if row is None:
                continue
            if rows and row.size != rows[0].size:
                raise ValueError(
                    f"{path}:{number}:{_column(line, rows[0].size)}: {row.size} heights, but "
                    f"{rows[0].size} in the lines above"
                )
            rows.append(row)
            if len(rows) % 1024 == 0:
                check_pixels(str(path), (len(rows), row.size))
    if not rows:
        raise ValueError(f"{path}: no heights in the file")
    return np.array(rows), (size["length_x"], size["length_y"]), periodic


def _row(path: Path, number: int, line: str) -> Array | None:
    """Heights of one line; None for an empty one."""
    text = line.partition("#")[0].replace(";", " ")
    if "," in text:
        # "1,2 3,4" would otherwise be read as four heights
        commas = text.count(",")
        text = text.replace(",", " ")
        words = text.split()
        if commas not in (len(words) - 1, len(words)):
            raise ValueError(
                f"{path}:{number}:{line.index(',') + 1}: commas and blanks both separate the "
                "numbers; if the comma is a decimal comma, write a point"
            )
    else:
        words = text.split()
    if not words:
        return None
    try:
        return np.array(words, dtype=float)
    except ValueError:
        bad = next(n for n, word in enumerate(words) if not _is_number(word))
        raise ValueError(
            f"{path}:{number}:{_column(line, bad)}: {words[bad]!r} is no number; expected: heights "
            "in m"
        ) from None


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True


def _column(line: str, index: int) -> int:
    """Column of a word of a line, from 1; behind its last one where it has fewer."""
    words = list(WORD.finditer(line.partition("#")[0]))
    return words[index].start() + 1 if index < len(words) else words[-1].end() + 1
