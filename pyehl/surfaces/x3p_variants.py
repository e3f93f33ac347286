# SPDX-License-Identifier: BSD-3-Clause
"""X3P files (ISO 25178-72) that are right, and not as SurfaceTopography 1.27 expects them.

x3ptools (R) writes the revision with an en dash and folds all into a folder; the standard allows
heights in the XML itself. The module needs NumPy alone, so that it could be part of a reader of
SurfaceTopography as it is.
"""

import io
import re
import zipfile
from xml.etree import ElementTree

import numpy as np

REVISION = "ISO5436 - 2000"
_DASHES = re.compile(r"[\s‐-―−_-]+")
BINARY = "bindata/data.bin"
MAX_XML = 2**28
"""Bytes of the largest XML that is looked at."""


def plain_x3p(data: bytes) -> bytes | None:
    """Give the same surface in the plain form; None if it is that already, or no X3P.

    ValueError says what is wrong with heights in the XML.
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
    """Element by its path, whatever the namespace."""
    return root.find("/".join(f"{{*}}{name}" for name in path.split("/")))


def _revised(root: ElementTree.Element) -> bool:
    """Spell the revision as the standard does; whether that changed it."""
    revision = _find(root, "Record1/Revision")
    if revision is None or revision.text in (None, REVISION):
        return False
    if _DASHES.sub("", revision.text or "") != _DASHES.sub("", REVISION):
        return False
    revision.text = REVISION
    return True


def _linked(root: ElementTree.Element, names: set[str], folder: str) -> bool:
    """Write the places of binary data as they are in the archive; whether that changed one."""
    changed = False
    for link in ("PointDataLink", "ValidPointsLink"):
        element = _find(root, f"Record3/DataLink/{link}")
        if element is None or not element.text:
            continue
        place = re.sub(r"[\\/]+", "/", element.text.strip()).removeprefix("./").lstrip("/")
        place = place.removeprefix(folder)
        if folder + place not in names:
            # written in other capitals
            same = (n for n in names if n.lower() == (folder + place).lower())
            place = next(same, folder + place).removeprefix(folder)
        changed |= place != element.text
        element.text = place
    return changed


def _listed(root: ElementTree.Element) -> bytes | None:
    """Heights of the XML as the binary data that the XML then links to; None if it has none."""
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
        # x;y;z, or z alone where x and y have equal steps; nothing where the point is missing
        last = (datum.text or "").strip().rpartition(";")[2].strip()
        try:
            values.append(float(last) if last else np.nan)
        except ValueError:
            raise ValueError(f"a height in the XML is {last[:40]!r}, no number") from None
    if len(values) != expected:
        raise ValueError(f"{len(values)} heights in the XML, but its matrix has {expected} points")
    kind = next((e for e in axis if e.tag.rpartition("}")[2] == "DataType"), None)
    if kind is not None:
        # a missing point is NaN, which whole numbers have not
        kind.text = "D"
    record.remove(listed)
    link = ElementTree.SubElement(record, _like(listed, "DataLink"))
    ElementTree.SubElement(link, _like(listed, "PointDataLink")).text = BINARY
    ElementTree.SubElement(link, _like(listed, "MD5ChecksumPointData")).text = ""
    return np.array(values, dtype="<f8").tobytes()


def _like(element: ElementTree.Element, name: str) -> str:
    """Name in the namespace of an element."""
    space, brace, _ = element.tag.rpartition("}")
    return f"{space}{brace}{name}"
