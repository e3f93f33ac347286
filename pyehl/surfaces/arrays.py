# SPDX-License-Identifier: BSD-3-Clause
"""Height maps as `.npy` arrays, and whether a surface fits into the memory before it is read."""

import logging
from pathlib import Path

import numpy as np

from pyehl import library
from pyehl.errors import InputError, NoMemoryError
from pyehl.given import real_numbers
from pyehl.types import Array

WORKING_COPIES, PREDICTION_COPIES = 12, 28
"""Arrays of the size of the map that its preparation holds at once, and of the size of a made tile
that a prediction does, spectra included."""
LARGE = 1e9
"""Bytes from which on the need is reported."""

_LOG = logging.getLogger(__name__)


def check_pixels(
    origin: str,
    pixels: tuple[int, int],
    tiles: int = 1,
    *,
    copies: int = WORKING_COPIES,
    way: str = "a part of the map, in a file of its own",
) -> None:
    """Refuse a surface that the memory that is free cannot hold while it is worked on.

    A map (nx, ny), called `origin`, of which a tile has `tiles` times as many pixels (4:
    mirrored), and so many copies are held at once; `way` says what would do. NoMemoryError with
    the bytes needed and free.
    """
    need = 8.0 * pixels[0] * pixels[1] * tiles * copies
    images = " with their mirror images" if tiles > 1 else ""
    what = f"{origin}: work on {pixels[0]} x {pixels[1]} heights{images}"
    try:
        library.check_memory(what, need)
    except NoMemoryError as error:
        raise NoMemoryError(f"{error}\nexpected: {way}") from None
    if need > LARGE:
        _LOG.info("%s takes up to %.1f GB of memory", what, need / 1e9)


def read_npy(path: Path) -> Array:
    """Heights (nx, ny) of a `.npy` file, in the numbers of the file.

    InputError if it is no matrix of real numbers, or its header lies.
    """
    raw = mapped(path)
    if raw.ndim != 2 or raw.size == 0:
        raise InputError(f"{path}: heights must be a matrix (nx, ny), not of shape {raw.shape}")
    check_pixels(str(path), raw.shape)
    return np.array(raw, dtype=float, order="C")


def mapped(path: Path) -> Array:
    """Real numbers of a `.npy` file, of any shape and mapped from it; InputError for others."""
    with path.open("rb") as stream:
        first = stream.read(4)
    if first == b"PK\x03\x04":
        raise InputError(
            f"{path}: it is a .npz archive of arrays, named .npy\n"
            "expected: one array, saved by numpy.save; or the archive named .npz, its array by "
            "surface.channel"
        )
    try:
        # mapped, so that the header is checked before the data are read
        raw = np.load(path, mmap_mode="r", allow_pickle=False)
    except (OSError, MemoryError):
        raise
    except Exception as error:
        # a damaged header makes numpy raise whatever the parser of Python does
        raise InputError(f"{path}: not a readable .npy file of numbers: {error}") from None
    real_numbers(raw, str(path))
    return raw
