# SPDX-License-Identifier: BSD-3-Clause
"""Gwyddion files whose data have no units: Gwyddion writes none where they are not known.

SurfaceTopography 1.27 takes such data for no heights. The module needs NumPy alone, so that it
could be part of its reader as it is.
"""

import re
import struct
from typing import Any

import numpy as np

MAGIC = b"GWYP"
_ATOMS = {"b": "<b", "c": "<c", "i": "<i", "q": "<q", "d": "<d"}
_ARRAYS = {"C": "S1", "I": "<i4", "Q": "<i8", "D": "<f8"}


def data_fields(data: bytes) -> dict[str, dict[str, Any]]:
    """Give the data fields of the channels of a Gwyddion file, by their title or number.

    Each has ``xres``, ``yres``, ``xreal``, ``yreal``, ``data`` and, where the file names them,
    ``si_unit_xy`` and ``si_unit_z``. ValueError if the file is none, or ends too early.
    """
    if not data.startswith(MAGIC):
        raise ValueError("it does not begin as a Gwyddion file")
    try:
        (_, container), _ = _object(data, len(MAGIC))
    except (struct.error, IndexError, ValueError) as error:
        raise ValueError(f"it ends within an item: {error}") from None
    fields = {}
    for key, value in container.items():
        if (found := re.fullmatch(r"/(\d+)/data", key)) and value[0] == "GwyDataField":
            title = container.get(f"/{found[1]}/data/title")
            fields[str(title or found[1])] = value[1]
    return fields


def _text(data: bytes, at: int) -> tuple[str, int]:
    end = data.index(b"\0", at)
    return data[at:end].decode("utf-8", "replace"), end + 1


def _object(data: bytes, at: int) -> tuple[tuple[str, dict[str, Any]], int]:
    """Name and items of an object, and where it ends."""
    name, at = _text(data, at)
    (size,) = struct.unpack_from("<I", data, at)
    at += 4
    end = at + size
    if end > len(data):
        raise ValueError(f"{name} has {size} bytes")
    items: dict[str, Any] = {}
    while at < end:
        key, at = _text(data, at)
        kind, at = chr(data[at]), at + 1
        items[key], at = _value(data, kind, at)
    return (name, items), at


def _value(data: bytes, kind: str, at: int) -> tuple[Any, int]:
    """Value of a kind, and where it ends."""
    if kind in _ATOMS:
        return struct.unpack_from(_ATOMS[kind], data, at)[0], at + struct.calcsize(_ATOMS[kind])
    if kind == "s":
        return _text(data, at)
    if kind == "o":
        return _object(data, at)
    (count,) = struct.unpack_from("<I", data, at)
    at += 4
    if kind in _ARRAYS:
        dtype = np.dtype(_ARRAYS[kind])
        return np.frombuffer(data, dtype, count, at), at + count * dtype.itemsize
    items = []
    for _ in range(count):
        item, at = _text(data, at) if kind == "S" else _object(data, at)
        items.append(item)
    return items, at
