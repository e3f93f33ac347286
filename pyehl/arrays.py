# SPDX-License-Identifier: BSD-3-Clause
"""Arrays of a result folder."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pyehl import library
from pyehl.errors import EhlError, FileError, NoMemoryError

__all__ = ["read_array"]


def read_array(path: Path) -> NDArray[np.float64]:
    """Read an array that pyehl has written, if it fits into the memory.

    Raises
    ------
    NoMemoryError
        If it does not fit; nothing is read then.
    FileError
        If it cannot be read, or is damaged.
    """
    try:
        library.check_memory(f"{path}: an array of this length", path.stat().st_size)
        return np.asarray(np.load(path, allow_pickle=False))
    except EhlError:
        raise
    except MemoryError as error:
        raise NoMemoryError(f"{path}: {error}") from error
    except OSError as error:
        raise FileError(f"{path}: cannot read: {error.strerror or error}") from error
    except Exception as error:
        # a damaged header makes numpy raise whatever the parser of Python does
        raise FileError(f"{path}: damaged: {error}") from error
