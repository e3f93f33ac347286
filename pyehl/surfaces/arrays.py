# SPDX-License-Identifier: BSD-3-Clause
"""Height maps as arrays: what counts as heights, and what is refused."""

from pathlib import Path
from typing import Any

import numpy as np

from pyehl.errors import InputError
from pyehl.surfaces.memory import check_pixels
from pyehl.types import Array

# Kinds of numbers that can be heights: floats, and whole numbers with and without a sign
REAL = "fiu"
_NAMES = {
    "c": "complex numbers",
    "b": "truth values",
    "M": "dates",
    "m": "spans of time",
    "U": "text",
    "S": "text",
    "V": "records",
}


def real(values: Any, what: str) -> Any:  # noqa: ANN401
    """Give an array of real numbers as it is, a mask as NaN (then in double precision).

    `what` begins the message. InputError for complex numbers, truth values, dates and text, which
    NumPy would turn into numbers or lose a part of.
    """
    try:
        array = values if isinstance(values, np.ndarray) else np.asanyarray(values)
        if array.dtype.kind == "O":
            # whatever its members are, they have to be real numbers, one by one
            members = {type(item) for item in array.flat}
            if any(issubclass(kind, bool | complex | str | bytes) for kind in members):
                raise TypeError(f"not {', '.join(sorted(kind.__name__ for kind in members))}")
            array = np.ma.asarray(array, dtype=float) if np.ma.isMA(array) else array.astype(float)
    except (TypeError, ValueError) as error:
        raise InputError(f"{what}: heights: expected a matrix of numbers [m]: {error}") from None
    if array.dtype.kind not in REAL:
        found = _NAMES.get(array.dtype.kind, str(array.dtype))
        raise InputError(
            f"{what}: heights must be real numbers, not {found} ({array.dtype})\n"
            "expected: a matrix of numbers [m]: expected floats, missing points as nan or masked"
        )
    if np.ma.isMA(array):
        return np.ma.filled(array.astype(float), np.nan)
    return array


def read_npy(path: Path) -> Array:
    """Heights (nx, ny) of a `.npy` file, in the numbers of the file.

    InputError if it is no matrix of real numbers, or its header lies.
    """
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
    if raw.ndim != 2:
        raise InputError(f"{path}: heights must be a matrix (nx, ny), not of shape {raw.shape}")
    if raw.dtype.kind not in REAL:
        real(np.empty(0, raw.dtype), str(path))
    check_pixels(str(path), raw.shape)
    return np.array(raw, dtype=float, order="C")
