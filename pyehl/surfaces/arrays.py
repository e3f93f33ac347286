# SPDX-License-Identifier: BSD-3-Clause
"""Result of a reader of heights; units, `.npy` arrays, text encodings and the memory check."""

import codecs
import logging
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from pyehl import library
from pyehl.errors import InputError, NoMemoryError
from pyehl.given import real_numbers
from pyehl.types import Array

Sizes = tuple[float | None, float | None]

UNITS = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "nm": 1e-9}
"""Units of `surface.height_unit` and `surface.lateral_unit` in metres."""

# Units in metres as headers spell them. Unicode has two micro signs; in a file of another encoding
# the sign may be unreadable
_SPELT = {
    r"nm|nanomet(?:er|re)s?|ナノメートル": 1e-9,
    r"[uµμ\ufffd]m|microns?|micromet(?:er|re)s?|mikrometer|マイクロメートル": 1e-6,
    r"mm|millimet(?:er|re)s?": 1e-3,
    r"cm|centimet(?:er|re)s?": 1e-2,
    r"pm|picomet(?:er|re)s?": 1e-12,
    r"å|angstr[oö]ms?": 1e-10,
    r"m|met(?:er|re)s?": 1.0,
}
UNIT = f"(?:{'|'.join(_SPELT)})"
"""Regular expression of a unit of length, to be matched without regard to case."""
_WHOLE = {re.compile(spelt, re.IGNORECASE): metres for spelt, metres in _SPELT.items()}


def unit_of(text: str) -> float | None:
    """Return a unit of length, as headers spell it, in metres; None for another word."""
    word = text.strip().strip("()[]")
    # Mm and MM in a header mean millimetres
    result = (metres for spelt, metres in _WHOLE.items() if spelt.fullmatch(word))
    return next(result, None)


@dataclass(slots=True)
class Found:
    """A height map as stored in its file, with the units and the size that the file states."""

    # (nx, ny) in the unit of the file, NaN where missing
    heights: Array
    # That unit [m]; None if the file names none
    height_unit: float | None = None
    # Size along x and y, in m or in the unit of the file; None if the file has no size
    size: Sizes = (None, None)
    size_in_metres: bool = True
    # Whether the user must give the unit of the size; else it is by default that of the heights
    ask_lateral_unit: bool = False
    # Whether it is an array, without information on its origin
    is_array: bool = False
    is_periodic: bool = False
    channel: str = ""
    notes: list[str] = field(default_factory=list)
    # Reason for a missing size, unless the file simply has none
    no_size: str = ""


SAMPLE = 2**16
"""Number of bytes that are examined to find the encoding of a file."""
_MARKS = {
    codecs.BOM_UTF8: "utf-8-sig",
    codecs.BOM_UTF32_LE: "utf-32",
    codecs.BOM_UTF16_LE: "utf-16",
    codecs.BOM_UTF16_BE: "utf-16",
}
# Control characters of text: tab, ends of lines and pages, and the end of a DOS file
_CONTROL = set(b"\t\n\v\f\r\x1a")


def encoding_of(path: Path) -> str | None:
    """Find the encoding of a text file from its first bytes; None if it is not text."""
    with path.open("rb") as stream:
        first = stream.read(SAMPLE)
    for mark, name in _MARKS.items():
        if first.startswith(mark):
            return name
    half = len(first) // 2
    for zeros, others, name in ((1, 0, "utf-16-le"), (0, 1, "utf-16-be")):
        # in UTF-16, ASCII text has a zero in every pair of bytes
        if first[zeros::2].count(0) > 0.8 * half > 0 and not first[others::2].count(0):
            return name
    if any(byte < 32 and byte not in _CONTROL for byte in first):
        return None
    try:
        codecs.getincrementaldecoder("utf-8")().decode(first)
    except UnicodeDecodeError:
        return "latin-1"
    return "utf-8"


def lines_of(path: Path, encoding: str) -> Iterator[tuple[int, str]]:
    """Yield the lines of a text file without line ends, numbered from 1."""
    with path.open(encoding=encoding, errors="replace") as lines:
        for number, line in enumerate(lines, 1):
            # concatenated files have byte order marks inside
            yield number, line.rstrip("\r\n\x1a\ufeff").lstrip("\ufeff")


WORKING_COPIES, PREDICTION_COPIES = 12, 28
"""Peak number of arrays of the size of the map in its preparation, and of the size of a generated
tile in a prediction, spectra included."""
LARGE = 1e9
"""Memory above which the need is reported [bytes]."""

_LOG = logging.getLogger(__name__)


def check_pixels(
    origin: str,
    pixels: tuple[int, int],
    tiles: int = 1,
    *,
    copies: int = WORKING_COPIES,
    remedy: str = "a part of the map, in a separate file",
) -> None:
    """Refuse a surface whose processing needs more than the free memory.

    The surface `origin` has `pixels` (nx, ny); its tile has `tiles` times as many (4: mirrored), of
    which `copies` arrays are held at once; `remedy` names what needs less. NoMemoryError with the
    bytes needed and free.
    """
    need = 8.0 * pixels[0] * pixels[1] * tiles * copies
    images = " with their mirror images" if tiles > 1 else ""
    what = f"{origin}: work on {pixels[0]} x {pixels[1]} heights{images}"
    try:
        library.check_memory(what, need)
    except NoMemoryError as error:
        raise NoMemoryError(f"{error}\nexpected: {remedy}") from None
    if need > LARGE:
        _LOG.info("%s takes up to %.1f GB of memory", what, need / 1e9)


def read_npy(path: Path) -> Array:
    """Read the heights (nx, ny) of a `.npy` file, as they are stored.

    InputError if it is no matrix of real numbers, or its header is invalid; NoMemoryError as
    `check_pixels`.
    """
    raw = mapped(path)
    if raw.ndim != 2 or raw.size == 0:
        raise InputError(f"{path}: heights must be a matrix (nx, ny), not of shape {raw.shape}")
    check_pixels(str(path), raw.shape)
    return np.array(raw, dtype=float, order="C")


def mapped(path: Path) -> Array:
    """Memory-map the real numbers of a `.npy` file, of any shape; InputError for other data."""
    with path.open("rb") as stream:
        first = stream.read(4)
    if first == b"PK\x03\x04":
        raise InputError(
            f"{path}: it is a .npz archive of arrays, named .npy\n"
            "expected: one array, saved by numpy.save; or the archive named .npz, its array by "
            "surface.channel"
        )
    try:
        # memory-mapped, so that the header is checked before the data are read
        raw = np.load(path, mmap_mode="r", allow_pickle=False)
    except (OSError, MemoryError):
        raise
    except Exception as error:
        # for a damaged header numpy raises any error of the Python parser
        raise InputError(f"{path}: not a readable .npy file of numbers: {error}") from None
    real_numbers(raw, str(path))
    return raw
