# SPDX-License-Identifier: BSD-3-Clause
"""Arrays and tables of a result folder."""

import csv
import math
import os
from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np

from pyehl import library
from pyehl.destination import new_file
from pyehl.errors import EhlError, FileError, NoMemoryError
from pyehl.types import Array


def read_array(path: Path) -> Array:
    """Read an array that pyehl has written.

    NoMemoryError, before reading, if it does not fit into memory; FileError if it cannot be read
    or is damaged.
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
        # with a damaged header numpy raises any error of the Python parser
        raise FileError(f"{path}: damaged: {error}") from error


def write_csv(
    path: str | os.PathLike[str], names: Sequence[str], rows: Iterable[Iterable[object]]
) -> None:
    """Write a table, whole or not at all: numbers with all digits, None and NaN as empty cells.

    FileError if it cannot be written.
    """
    with new_file(path) as fresh, fresh.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(names)
        writer.writerows([_cell(value) for value in row] for row in rows)


def _cell(value: object) -> str:
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return ""
    if isinstance(value, bool):
        return "true" if value else "false"
    return repr(float(value)) if isinstance(value, float) else " ".join(str(value).split())
