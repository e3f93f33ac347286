# SPDX-License-Identifier: BSD-3-Clause
"""Height maps as text: one x per line, lists of points, tables under lines of words."""

import re
from itertools import islice, pairwise
from pathlib import Path

import numpy as np

from pyehl.errors import InputError
from pyehl.surfaces.instruments import Foreign, Sizes
from pyehl.surfaces.memory import check_pixels
from pyehl.types import Array

# What stands between separators
WORD = re.compile(r"[^\s,;]+")
DECIMAL = re.compile(r"[^\s;]+")
OWN_SIZE = re.compile(r"^#\s*(length_[xy])\s*=\s*(\S+)\s*m\s*$")
OWN_PERIODIC = re.compile(r"^#\s*periodic\s*$")
# Of a mesh size: how far points may be from the grid
OFF = 0.02
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


def read_text(path: Path, first: int = 1) -> tuple[Array, tuple[float | None, float | None], bool]:
    """Heights from a line on, the size if the header has it, and whether it says 'periodic'."""
    size: dict[str, float | None] = {"length_x": None, "length_y": None}
    periodic = False
    rows: list[Array] = []
    with path.open(encoding="utf-8", errors="replace") as lines:
        for number, line in enumerate(lines, 1):
            if match := OWN_SIZE.match(line):
                size[match[1]] = float(match[2])
            periodic = periodic or bool(OWN_PERIODIC.match(line))
            row = _row(path, number, line) if number >= first else None
            if row is None:
                continue
            if rows and row.size != rows[0].size:
                raise InputError(
                    f"{path}:{number}:{_column(line, rows[0].size)}: {row.size} heights, but "
                    f"{rows[0].size} in the lines above"
                )
            rows.append(row)
            if len(rows) % 1024 == 0:
                check_pixels(str(path), (len(rows), row.size))
    if not rows:
        raise InputError(f"{path}: no heights in the file")
    return np.array(rows), (size["length_x"], size["length_y"]), periodic


def _row(path: Path, number: int, line: str) -> Array | None:
    """Heights of one line; None for an empty one."""
    text = line.partition("#")[0].rstrip()
    # where something else separates the numbers a comma is a decimal comma
    if ";" in text or "\t" in text.strip():
        text = text.replace(",", ".").replace(";", " ")
    if "," in text:
        # "1,2 3,4" would otherwise be read as four heights
        commas = text.count(",")
        text = text.replace(",", " ")
        words = text.split()
        if commas not in (len(words) - 1, len(words)):
            raise InputError(
                f"{path}:{number}:{line.index(',') + 1}: commas and blanks both separate the "
                "numbers; if the comma is a decimal comma, write a point, or a semicolon between "
                "the numbers"
            )
    else:
        words = text.split()
    if not words:
        return None
    try:
        return np.array(words, dtype=float)
    except ValueError:
        bad = next(n for n, word in enumerate(words) if not _is_number(word))
        raise InputError(
            f"{path}:{number}:{_column(line, bad)}: {words[bad]!r} is no number; expected: heights"
        ) from None


def count_numbers(line: str) -> int:
    """Count the numbers of a line of heights; 0 for a line of anything else."""
    try:
        row = _row(Path(), 0, line)
    except InputError:
        return 0
    return 0 if row is None else row.size


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True


def _column(line: str, index: int) -> int:
    """Column of a word of a line, from 1; behind its last one where it has fewer."""
    text = line.partition("#")[0]
    words = list((DECIMAL if ";" in text or "\t" in text.strip() else WORD).finditer(text))
    return words[index].start() + 1 if index < len(words) else words[-1].end() + 1


def is_list(rows: Array) -> bool:
    """Whether rows of three numbers (n, 3) are points and no map: n is then far larger."""
    return rows.ndim == 2 and rows.shape[1] == 3 and rows.shape[0] > 3


def grid_of(path: Path, points: Array) -> tuple[Array, tuple[float, float]]:
    """Heights (nx, ny) on the grid of points x, y, z (n, 3) in any order, and its size.

    Lengths are in the unit of the points. A point that is not there is NaN. InputError if the
    places are no grid of equal steps, or a place is there twice.
    """
    indices, shape, steps = [], [], []
    for axis, name in enumerate("xy"):
        places = points[:, axis]
        if not np.isfinite(places).all():
            row = int(np.argmin(np.isfinite(places)))
            raise InputError(f"{path}: point {row + 1} of the list has no {name}")
        gaps = np.diff(np.unique(places))
        # places of one line differ by rounding
        gaps = gaps[gaps > OFF * gaps.max(initial=0.0)]
        if not gaps.size:
            raise InputError(f"{path}: all points of the list of x, y and z have the same {name}")
        # the span knows it better than the places, which are rounded
        span = float(np.ptp(places))
        step = span / round(span / float(np.median(gaps)))
        at = (places - places.min()) / step
        index = np.rint(at).astype(np.int64)
        worst = int(np.argmax(np.abs(at - index)))
        if abs(at[worst] - index[worst]) > OFF:
            raise InputError(
                f"{path}: point {worst + 1} of the list of x, y and z, {name} = {places[worst]:.6g}"
                f", is off the grid of steps of {step:.6g}; a map needs equal steps"
            )
        indices.append(index)
        shape.append(int(index.max()) + 1)
        steps.append(step)
    check_pixels(str(path), (shape[0], shape[1]))
    heights = np.full(shape, np.nan)
    flat = np.ravel_multi_index(indices, shape)
    first, count = np.unique(flat, return_counts=True)
    if first.size < flat.size:
        i, j = np.unravel_index(first[np.argmax(count)], shape)
        raise InputError(
            f"{path}: the place number {i + 1} along x, {j + 1} along y is in the list of x, y and "
            f"z {count.max()} times"
        )
    heights.ravel()[flat] = points[:, 2]
    return heights, (shape[0] * steps[0], shape[1] * steps[1])


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
