# SPDX-License-Identifier: BSD-3-Clause
"""Height maps as `.npy` arrays: what counts as heights, and what is refused."""

from pathlib import Path

import numpy as np

from pyehl.errors import InputError
from pyehl.given import real_numbers
from pyehl.surfaces.memory import check_pixels
from pyehl.types import Array


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
