# SPDX-License-Identifier: BSD-3-Clause
"""Height maps as tables of numbers under header lines of words, as spreadsheets export them."""

import re
from itertools import islice, pairwise
from pathlib import Path

import numpy as np

from pyehl.errors import InputError
from pyehl.surfaces.instruments import Foreign, Sizes
from pyehl.surfaces.text_map import count_numbers, read_text

UNITS = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "nm": 1e-9}
"""Metres in the units of `surface.height_unit`."""

HEADER_LINES = 100
# A micro sign is two characters of Unicode, and in a file of another encoding it is none
UNIT = "(m|mm|[uµμ\ufffd]m|nm)"
SIZE = re.compile(
    rf"(?P<name>[a-z _-]+?)\s*(?:[(\[]{UNIT}[)\]])?\s*[:;=,\t]\s*(?P<value>[\d.,]+)\s*{UNIT}?",
    re.IGNORECASE,
)
OF_HEIGHTS = re.compile(
    rf"(?:(?:z|height|value)[ -])?units?\s*[:;=,\t]\s*[(\[]?{UNIT}[)\]]?", re.IGNORECASE
)
SIDES = (("width", "x size", "x length", "x range"), ("height", "y size", "y length", "y range"))


def read_headed(path: Path) -> Foreign:
    """Heights (nx, ny) of a table whose lines run along x, as those of images do.

    The same as :func:`pyehl.surfaces.instruments.read_instrument`: heights in m where a header line
    names their unit, and a note where none does; the size [m] where header lines give it with a
    unit. A list of the x, y and z of points is as it stands, (n, 3).

    InputError if there is no table.
    """
    with path.open(encoding="utf-8", errors="replace") as lines:
        first = [line.strip().rstrip(";,\t ") for line in islice(lines, HEADER_LINES)]
    counts = [count_numbers(line) for line in first]
    # two lines of as many numbers, three at the least: a header may have numbers, too
    both = enumerate(pairwise(counts))
    start = next((n for n, (one, other) in both if one == other > 2), None)
    if start is None:
        at = next(
            n
            for n, (line, count) in enumerate(zip(first, counts, strict=True))
            if line and not count
        )
        raise InputError(
            f"{path}:{at + 1}: {first[at][:40]!r} is not numbers, and no table of heights follows\n"
            "expected: numbers, with surface.height_unit, surface.length_x and surface.length_y"
        )
    rows, _, _ = read_text(path, start + 1)
    header = first[:start]
    units = {_unit(match[1]) for line in header if (match := OF_HEIGHTS.fullmatch(line))}
    note = "the file names no unit: its heights are taken in m"
    if len(units) == 1:
        rows *= UNITS[units.pop()]
        note = ""
    heights = rows if rows.shape[1] == 3 else np.ascontiguousarray(rows.T)
    return heights, _size(header), False, "", note


def _unit(text: str) -> str:
    return text.lower() if text.lower() in UNITS else "um"


def _size(header: list[str]) -> Sizes:
    """Size along and across the lines [m]; None where the header does not give it, or twice."""
    found: list[set[float]] = [set(), set()]
    for match in filter(None, map(SIZE.fullmatch, header)):
        units = {_unit(unit) for unit in (match[2], match[4]) if unit}
        value = match["value"].replace(",", ".")
        for side, names in zip(found, SIDES, strict=True):
            if match["name"].lower() in names and len(units) == 1 and value.count(".") < 2:
                side.add(float(value) * UNITS[units.pop()])
    # a height alone may be that of the surface
    if len(found[0]) != 1:
        return None, None
    return found[0].pop(), found[1].pop() if len(found[1]) == 1 else None
