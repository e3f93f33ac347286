# SPDX-License-Identifier: BSD-3-Clause
"""Profiles in text: columns of numbers under lines of words that may name units and spacing."""

import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from pyehl.errors import InputError
from pyehl.types import Array

METRES = {
    "m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "μm": 1e-6, "micron": 1e-6,
    "microns": 1e-6, "nm": 1e-9, "å": 1e-10, "ang": 1e-10, "angstrom": 1e-10, "angstroms": 1e-10,
    "kå": 1e-7, "in": 0.0254, "inch": 0.0254, "uin": 2.54e-8, "µin": 2.54e-8,
}  # fmt: skip
UNIT = re.compile(
    r"(?<![A-Za-z])("
    + "|".join(sorted(map(re.escape, METRES), key=len, reverse=True))
    + r")(?![a-z])",
    re.IGNORECASE,
)
SPACING = re.compile(
    r"(pitch|spacing|increment|interval|step|sampling|auflösung|abstand|pas\b|dx\b|delta ?x)"
    r"\D*?(\d+(?:[.,]\d+)?(?:[eE][-+]?\d+)?)\s*[,;\t ]?\s*\(?\[?([A-Za-zµμÅå]*)",
    re.IGNORECASE,
)
LEAST_POINTS = 32
MOST_COLUMNS = 3
"""An index, a place and a height."""

Read = tuple[Array, Array | float | None, tuple[float | None, float | None]]
"""Heights, their places or their spacing, and the units of places and of heights [m]."""


def read_columns(path: Path, lines: Sequence[str]) -> Read:
    """Columns of numbers under lines of words."""
    comma = _decimal_comma(lines)
    rows = [row_of(line, comma=comma) for line in lines]
    sizes = [len(row) if row else 0 for row in rows]
    # the longest run of lines with as many numbers
    best, start = (0, 0), 0
    for k in range(1, len(rows) + 1):
        if k == len(rows) or sizes[k] != sizes[start]:
            if sizes[start] and k - start > best[1] - best[0]:
                best = start, k
            start = k
    first, last = best
    if last - first < LEAST_POINTS:
        raise InputError(f"{path}: no profile: no column of {LEAST_POINTS} heights or more")
    left = [k for k in range(last, len(lines)) if lines[k].strip()]
    if any(sizes[k] for k in left):
        raise InputError(
            f"{path}: line {left[0] + 1} has {sizes[left[0]]} numbers, those above have "
            f"{sizes[first]}: a profile has as many on each line, and a height on each"
        )
    if sizes[first] > MOST_COLUMNS:
        raise InputError(f"{path}: no profile: {sizes[first]} columns of numbers")
    table = np.array(rows[first:last], dtype=float)
    if sizes[first] == MOST_COLUMNS and not np.all(np.diff(table[:, 0]) > 0.0):
        raise InputError(f"{path}: no profile: of three columns the first does not ascend")
    head = [line for line in lines[:first] if line.strip()]
    return _places(table, head, comma=comma)


def _decimal_comma(lines: Sequence[str]) -> bool:
    """Whether commas are decimal points: numbers with a comma, and another sign between them."""
    number = re.compile(r"[-+]?\d+,\d+(?:[eE][-+]?\d+)?")
    with_comma = [line for line in lines if number.search(line)]
    others = sum(
        1 for line in with_comma if re.search(r"[;\t ]", line.strip()) or line.count(",") == 1
    )
    points = sum(1 for line in lines if re.search(r"\d\.\d", line))
    return len(with_comma) > points and others == len(with_comma)


def row_of(line: str, *, comma: bool) -> list[float] | None:
    """Numbers of a line; None if it has words."""
    parts = re.split(r"[;\t ]+" if comma else r"[;,\t ]+", line.strip().strip(";,").strip())
    try:
        return [float((p.replace(",", ".") if comma else p).strip('"')) for p in parts]
    except ValueError:
        return None


def _places(table: Array, head: Sequence[str], *, comma: bool) -> Read:
    """Distinguish places from heights, with the units that the head names."""
    columns, units = table.shape[1], _units(head, table.shape[1])
    if columns == 1:
        spacing, unit = _spacing(head, comma=comma)
        z_unit = next((u for u in reversed(units) if u), None)
        return (
            table[:, 0],
            None if spacing is None or unit is None else spacing * unit,
            (1.0, z_unit),
        )
    even = [_is_even(table[:, k]) for k in range(columns - 1)]
    # an index may stand before the places
    at = 1 if columns > 2 and even[0] and even[1] else 0
    if not even[at] and not np.all(np.diff(table[:, at]) > 0.0):
        at = -1
    z = table[:, at + 1]
    if at < 0:
        return z, None, (None, units[0])
    return z, table[:, at], (units[at], units[at + 1])


def _is_even(x: Array) -> bool:
    steps = np.diff(x)
    mean = float(steps.mean())
    return mean > 0.0 and bool(np.all(steps > 0.0)) and float(np.ptp(steps)) < 0.5 * mean


def _units(head: Sequence[str], columns: int) -> list[float | None]:
    """Give the unit of each column by the lines above them, the nearest line first."""
    for line in reversed(head):
        for between in (r"[;\t]|,(?!\d)|\s{2,}", r"\s+"):
            parts = [p for p in re.split(between, line.strip()) if p.strip()]
            found = [_unit(part) for part in parts]
            if len(parts) == columns and any(found):
                last = next(u for u in reversed(found) if u)
                return [u or last for u in found]
        words = [u for u in (_unit(word) for word in line.split()) if u]
        if len(words) == columns:
            return list(words)
        if len(words) == 1 and not SPACING.search(line):
            return [words[0]] * columns
    return [None] * columns


def _unit(text: str) -> float | None:
    """Find the unit in a text, in brackets rather than not."""
    inside = re.search(r"[\[(]\s*([^\])]+?)\s*[\])]", text)
    match = (inside and UNIT.fullmatch(inside[1])) or UNIT.search(text)
    return METRES[match[1].lower()] if match else None


def _spacing(head: Sequence[str], *, comma: bool) -> tuple[float | None, float | None]:
    """Spacing of the points by the head, and its unit [m]."""
    for line in head:
        if match := SPACING.search(line):
            number = match[2].replace(",", ".") if comma or "." not in match[2] else match[2]
            return float(number), METRES.get(match[3].lower()) or _unit(line)
    return None, None
