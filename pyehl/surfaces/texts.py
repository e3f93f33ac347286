# SPDX-License-Identifier: BSD-3-Clause
"""Texts of known programs, which are read by their own rules."""

import re
from collections.abc import Iterator
from itertools import islice
from pathlib import Path

from pyehl.errors import InputError
from pyehl.surfaces.found import Found
from pyehl.surfaces.instruments import read_instrument
from pyehl.surfaces.text_file import lines_of
from pyehl.surfaces.text_table import HEADER_LINES, tables_of
from pyehl.surfaces.zygo_text import MAGIC, read_zygo

# Headers of Wyko, SPIP, Attocube and Nova, which SurfaceTopography knows: their numbers need
# factors that the header has
FLAVOUR = re.compile(
    r"^Wyko ASCII|^#\s*File Format\s*=\s*ASCII|^\s*(?:Unit|Scale) (?:X|Data)\s*="
    r"|height\s+conversion\s+factor",
    re.IGNORECASE,
)
# A stylus instrument's, of Mahr
PROFILE = re.compile(r"\bPRF\s*$")
# Files that begin with the mark of a format that has a reader
MARKED = ("aISO-1.0", "aBCR-1", "fileformat = bcr")


def read_known_text(path: Path, encoding: str, channel: str) -> Found | None:
    """Read a text of a known program; None if it is of none."""
    first = [line for _, line in islice(lines_of(path, encoding), HEADER_LINES)]
    if not first:
        return None
    if first[0].startswith(MAGIC):
        return _zygo(path, encoding, channel)
    if first[0].startswith(MARKED):
        return read_instrument(path, channel)
    if first[0].startswith("X;Y;valid") or (len(first) > 1 and PROFILE.search(first[1])):
        raise InputError(
            f"{path}: it is a profile along a line; a contact needs the map of an area"
        )
    if any(FLAVOUR.search(line) for line in first):
        return _flavoured(path, encoding, channel)
    return None


def _zygo(path: Path, encoding: str, channel: str) -> Found:
    """Heights of a text of Zygo."""
    if channel:
        raise InputError(f"{path}: surface.channel = '{channel}', but the file holds one map alone")
    try:
        read = read_zygo(line for _, line in lines_of(path, encoding))
    except (ValueError, IndexError) as error:
        raise InputError(f"{path}: cannot be read as a Zygo text file: {error}") from None
    found = Found(read.heights, height_unit=1.0)
    if read.pixel > 0.0:
        nx, ny = read.heights.shape
        found.size = nx * read.pixel, ny * read.pixel
    else:
        found.no_size = "line 8 of the file gives no size of a pixel"
    return found


def _flavoured(path: Path, encoding: str, channel: str) -> Found:
    """Heights of a text whose header SurfaceTopography knows, every line read and counted here."""
    tables = tables_of(path, encoding)

    def lines() -> Iterator[str]:
        for table in tables:
            yield from table.header
            yield from ("\t".join(map(repr, row.tolist())) for row in table.rows)

    found = read_instrument(path, channel, "\n".join(lines()).encode())
    sizes = {table.rows.size for table in tables}
    if found.heights.size not in sizes:
        raise InputError(
            f"{path}: the file has {' or '.join(map(str, sorted(sizes)))} heights, and "
            f"{found.heights.size} were read"
        )
    return found
