# SPDX-License-Identifier: BSD-3-Clause
"""Files of instruments that SurfaceTopography 1.27 does not read, or reads wrongly.

Zygo MetroPro and Mx: XYZ Data File Format 1, ASCII Data File Formats 1 and 2 (MetroPro Reference
Guide OMP-0347, appendix on data formats).

TMD, NMS, X3P (ISO 25178-72: x3ptools of R writes the revision with an en dash and puts all files
into a folder; the standard allows heights in the XML itself), and Gwyddion files without units.
The module needs only NumPy, so that it could become part of SurfaceTopography.
"""

import io
import re
import struct
import zipfile
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

ZYGO_MAGIC = ("Zygo XYZ Data File", "Zygo ASCII Data File")
INVALID = 2147483640
"""Integers from this one up mark points without a phase."""
RESOLUTION = {0: 4096, 1: 32768, 2: 131072}
"""Phase counts per wavelength, by PhaseRes."""
HEADER_LINES = 13


@dataclass(frozen=True)
class ZygoMap:
    """Heights of a Zygo text file."""

    # (nx, ny) [m], NaN where there are no data; x along the lines of the camera
    heights: NDArray[np.float64]
    # Pixel size [m]; 0: not calibrated
    pixel: float


def read_zygo(lines: Iterable[str]) -> ZygoMap:
    """Read a Zygo text file; ValueError states which line is wrong."""
    rest = iter(lines)
    header = [line.strip() for line in islice(rest, HEADER_LINES)]
    if len(header) < HEADER_LINES or not header[0].startswith(ZYGO_MAGIC):
        raise ValueError(f"the header of a Zygo text file has {HEADER_LINES} lines at least")
    is_list = header[0].startswith(ZYGO_MAGIC[0])
    left, top, width, height = (int(v) for v in _numbers(header, 4, 4))
    # heights are phase counts times scale factor, wavelength and obliquity factor
    _, scale, wavelength, _, obliquity, _, pixel = _numbers(header, 8, 7)
    if min(width, height) < 1:
        raise ValueError(f"line 4: a phase map of {width} x {height} points")
    if is_list:
        heights = _listed_heights(rest, (left, top), (width, height))
    else:
        resolution = int(_numbers(header, 11, 1)[0])
        if resolution not in RESOLUTION:
            raise ValueError(f"line 11: PhaseRes is {resolution}, not 0, 1 or 2")
        intensities = int(np.prod(_numbers(header, 3, 5)[2:5]))
        counts = _phases(rest, intensities, width * height)
        counts[counts >= INVALID] = np.nan
        factor = scale * wavelength * obliquity / RESOLUTION[resolution]
        heights = factor * counts.reshape(height, width).T
    return ZygoMap(np.ascontiguousarray(heights), pixel)


def _numbers(header: list[str], line: int, count: int) -> list[float]:
    """Return the first `count` numbers of a line of the header; lines count from 1."""
    words = header[line - 1].split()[:count]
    try:
        values = [float(word) for word in words]
    except ValueError:
        values = []
    if len(values) < count:
        raise ValueError(f"line {line}: {count} numbers were expected, not {header[line - 1]!r}")
    return values


def _listed_heights(
    rest: Iterable[str], corner: tuple[int, int], shape: tuple[int, int]
) -> NDArray[np.float64]:
    """Read heights [m] from lines of column, row and micrometres between two '#'."""
    heights = np.full(shape, np.nan)
    seen = 0
    begun = False
    for line in rest:
        words = line.split()
        if words == ["#"]:
            if begun:
                break
            begun = True
            continue
        if not words or not begun:
            continue
        try:
            i, j = int(words[0]) - corner[0], int(words[1]) - corner[1]
            value = np.nan if words[2].lower() == "no" else 1e-6 * float(words[2])
        except (ValueError, IndexError):
            raise ValueError(f"a point is {line.strip()[:40]!r}, not column, row, height") from None
        if not (0 <= i < shape[0] and 0 <= j < shape[1]):
            raise ValueError(
                f"the point {words[0]} {words[1]} is outside of the {shape[0]} x {shape[1]} points "
                "of line 4"
            )
        heights[i, j] = value
        seen += 1
    if seen != heights.size:
        raise ValueError(f"{seen} points, but line 4 states {shape[0]} x {shape[1]}")
    return heights


def _phases(rest: Iterable[str], intensities: int, phases: int) -> NDArray[np.float64]:
    """Read phase counts: the block after the intensities, each block between two '#'."""
    blocks: list[list[str]] = []
    for line in rest:
        words = line.split()
        if words and words[0] == "#":
            blocks.append([])
        elif blocks:
            blocks[-1] += words
    # an empty block may follow the last '#'
    filled = [block for block in blocks if block]
    expected = [count for count in (intensities, phases) if count]
    lengths = [len(block) for block in filled]
    if lengths != expected:
        raise ValueError(f"blocks of {lengths} numbers, but lines 3 and 4 say {expected}")
    try:
        return np.array(filled[-1], dtype=float)
    except ValueError as error:
        raise ValueError(f"a phase is no number: {error}") from None


TMD_MAGIC = b"Binary TrueMap Data File v2.0"
TMD_BEGIN = 32
"""Bytes of the first line of a TMD file."""
TMD_COMMENT = b"Created by TrueMap v6\r\n\0"
"""Comment of TrueMap, which is the only one that SurfaceTopography reads."""
NMS_POINTS, NMS_DATA = 1368, 3468
"""Offsets of the numbers of points and of the heights in a NMS file [bytes]."""
NMS_MISSING = 2**16 - 1


def plain_tmd(data: bytes) -> bytes | None:
    """Replace the comment of a TMD file, which may be empty, by that of TrueMap.

    The comment ends at the first zero byte, as in the reader of GelSight. None for files that have
    that comment already, or another format.
    """
    if not data.startswith(TMD_MAGIC):
        return None
    end = data.find(b"\0", TMD_BEGIN)
    # the data begin after the zero byte of the comment, at once without a comment, or after a
    # comment padded to 24 bytes
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
    """Mark points (nx, ny) of a NMS file without height: those with the largest 16-bit integer.

    The scale of the heights ends at the integer below. None if the file is shorter than it states.
    """
    with path.open("rb") as stream:
        stream.seek(NMS_POINTS)
        nx, ny = struct.unpack("<II", stream.read(8))
        stream.seek(NMS_DATA)
        data = np.frombuffer(stream.read(2 * nx * ny), "<u2")
    if data.size != nx * ny:
        return None
    return (data == NMS_MISSING).reshape(ny, nx).T


REVISION = "ISO5436 - 2000"
_DASHES = re.compile(r"[\s‐-―−_-]+")
BINARY = "bindata/data.bin"
MAX_XML = 2**28
"""Size of the largest XML that is read [bytes]."""


def plain_x3p(data: bytes) -> bytes | None:
    """Convert an X3P file to the plain form; None if it is plain already, or no X3P.

    ValueError states what is wrong with heights in the XML.
    """
    try:
        archive = zipfile.ZipFile(io.BytesIO(data))
    except zipfile.BadZipFile:
        return None
    with archive:
        names = {name.replace("\\", "/"): name for name in archive.namelist()}
        main = next((n for n in names if n.lower().rpartition("/")[2] == "main.xml"), None)
        if main is None or archive.getinfo(names[main]).file_size > MAX_XML:
            return None
        folder = main[: -len("main.xml")]
        try:
            root = ElementTree.fromstring(archive.read(names[main]))
        except ElementTree.ParseError:
            return None
        changed = bool(folder) or main != "main.xml" or any(a != b for a, b in names.items())
        changed |= _revised(root)
        changed |= _linked(root, set(names), folder)
        heights = _listed(root)
        if not changed and heights is None:
            return None
        plain = io.BytesIO()
        with zipfile.ZipFile(plain, "w") as copy:
            copy.writestr("main.xml", ElementTree.tostring(root))
            for name, stored in names.items():
                if name != main and not name.endswith("/"):
                    copy.writestr(name.removeprefix(folder), archive.read(stored))
            if heights is not None:
                copy.writestr(BINARY, heights)
    return plain.getvalue()


def _find(root: ElementTree.Element, path: str) -> ElementTree.Element | None:
    """Find an element by its path, in any namespace."""
    return root.find("/".join(f"{{*}}{name}" for name in path.split("/")))


def _revised(root: ElementTree.Element) -> bool:
    """Spell the revision as the standard does; returns whether that changed it."""
    revision = _find(root, "Record1/Revision")
    if revision is None or revision.text in (None, REVISION):
        return False
    if _DASHES.sub("", revision.text or "") != _DASHES.sub("", REVISION):
        return False
    revision.text = REVISION
    return True


def _linked(root: ElementTree.Element, names: set[str], folder: str) -> bool:
    """Correct the paths of binary data to those in the archive; returns whether one changed."""
    changed = False
    for link in ("PointDataLink", "ValidPointsLink"):
        element = _find(root, f"Record3/DataLink/{link}")
        if element is None or not element.text:
            continue
        place = re.sub(r"[\\/]+", "/", element.text.strip()).removeprefix("./").lstrip("/")
        place = place.removeprefix(folder)
        if folder + place not in names:
            # the case of letters differs
            same = (n for n in names if n.lower() == (folder + place).lower())
            place = next(same, folder + place).removeprefix(folder)
        changed |= place != element.text
        element.text = place
    return changed


def _listed(root: ElementTree.Element) -> bytes | None:
    """Replace heights in the XML by a link to binary data; returns these, None without heights."""
    record = _find(root, "Record3")
    listed = _find(root, "Record3/DataList")
    axis = _find(root, "Record1/Axes/CZ")
    if record is None or listed is None or axis is None:
        return None
    sizes = [_find(root, f"Record3/MatrixDimension/Size{k}") for k in "XYZ"]
    if any(size is None for size in sizes):
        raise ValueError("heights in the XML without the dimensions of their matrix")
    expected = int(np.prod([int(size.text or 0) for size in sizes if size is not None]))
    values = []
    for datum in listed:
        # x;y;z, or only z for evenly spaced points; empty for a missing point
        last = (datum.text or "").strip().rpartition(";")[2].strip()
        try:
            values.append(float(last) if last else np.nan)
        except ValueError:
            raise ValueError(f"a height in the XML is {last[:40]!r}, no number") from None
    if len(values) != expected:
        raise ValueError(f"{len(values)} heights in the XML, but its matrix has {expected} points")
    kind = next((e for e in axis if e.tag.rpartition("}")[2] == "DataType"), None)
    if kind is not None:
        # integers have no NaN for a missing point
        kind.text = "D"
    record.remove(listed)
    link = ElementTree.SubElement(record, _like(listed, "DataLink"))
    ElementTree.SubElement(link, _like(listed, "PointDataLink")).text = BINARY
    ElementTree.SubElement(link, _like(listed, "MD5ChecksumPointData")).text = ""
    return np.array(values, dtype="<f8").tobytes()


def _like(element: ElementTree.Element, name: str) -> str:
    """Return a name in the namespace of an element."""
    space, brace, _ = element.tag.rpartition("}")
    return f"{space}{brace}{name}"


GWY_MAGIC = b"GWYP"
_ATOMS = {"b": "<b", "c": "<c", "i": "<i", "q": "<q", "d": "<d"}
_ARRAYS = {"C": "S1", "I": "<i4", "Q": "<i8", "D": "<f8"}


def data_fields(data: bytes) -> dict[str, dict[str, Any]]:
    """Return the data fields of the channels of a Gwyddion file, by their title or number.

    Each has ``xres``, ``yres``, ``xreal``, ``yreal``, ``data`` and, if the file names them,
    ``si_unit_xy`` and ``si_unit_z``. ValueError if it is no Gwyddion file, or ends too early.
    """
    if not data.startswith(GWY_MAGIC):
        raise ValueError("it does not begin as a Gwyddion file")
    try:
        (_, container), _ = _object(data, len(GWY_MAGIC))
    except (struct.error, IndexError, ValueError) as error:
        raise ValueError(f"it ends within an item: {error}") from None
    fields = {}
    for key, value in container.items():
        if (match := re.fullmatch(r"/(\d+)/data", key)) and value[0] == "GwyDataField":
            title = container.get(f"/{match[1]}/data/title")
            fields[str(title or match[1])] = value[1]
    return fields


def _text(data: bytes, at: int) -> tuple[str, int]:
    end = data.index(b"\0", at)
    return data[at:end].decode("utf-8", "replace"), end + 1


def _object(data: bytes, at: int) -> tuple[tuple[str, dict[str, Any]], int]:
    """Read an object; returns its name, its items and the offset of its end."""
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
    """Read a value of a kind; returns it and the offset of its end."""
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
