# SPDX-License-Identifier: BSD-3-Clause
"""Binary files that are right, and not as SurfaceTopography 1.27 expects them.

The module needs NumPy alone, so that it could be part of readers of SurfaceTopography as it is.
"""

import struct
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

TMD_MAGIC = b"Binary TrueMap Data File v2.0"
TMD_BEGIN = 32
"""Bytes of the first line of a TMD file."""
TMD_COMMENT = b"Created by TrueMap v6\r\n\0"
"""Comment of TrueMap, which is the only one that SurfaceTopography reads."""
NMS_POINTS, NMS_DATA = 1368, 3468
"""Where a NMS file has its numbers of points, and its heights."""
NMS_MISSING = 2**16 - 1


def plain_tmd(data: bytes) -> bytes | None:
    """Give a TMD file with the comment of TrueMap in place of its own, which may be empty.

    The comment ends with the first zero byte, as GelSight's own reader has it; None for files that
    are plain already, or none of the format.
    """
    if not data.startswith(TMD_MAGIC):
        return None
    end = data.find(b"\0", TMD_BEGIN)
    # the comment as text, its zero byte behind it; none at all; padded to 24 bytes
    for begin in (end + 1, TMD_BEGIN, TMD_BEGIN + len(TMD_COMMENT)):
        if begin < TMD_BEGIN or begin + 24 > len(data):
            continue
        nx, ny = struct.unpack_from("<II", data, begin)
        if nx and ny and begin + 24 + 4 * nx * ny == len(data):
            if begin == TMD_BEGIN + len(TMD_COMMENT):
                return None
            return data[:TMD_BEGIN] + TMD_COMMENT + data[begin:]
    return None


def nms_missing(path: Path) -> NDArray[np.bool_] | None:
    """Where (nx, ny) a NMS file has no heights: the largest whole number of two bytes.

    The scale of its heights ends at the number below. None if the file is shorter than it says.
    """
    with path.open("rb") as stream:
        stream.seek(NMS_POINTS)
        nx, ny = struct.unpack("<II", stream.read(8))
        stream.seek(NMS_DATA)
        data = np.frombuffer(stream.read(2 * nx * ny), "<u2")
    if data.size != nx * ny:
        return None
    return (data == NMS_MISSING).reshape(ny, nx).T
