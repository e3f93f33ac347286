# SPDX-License-Identifier: BSD-3-Clause
"""Tables of numbers in a text, with the lines above each: every line is accounted for."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path

import numpy as np

from pyehl.errors import InputError
from pyehl.surfaces.arrays import check_pixels
from pyehl.surfaces.text_cells import BadCellError, Cells, cells_of, count_numbers, uncommented
from pyehl.surfaces.text_file import lines_of
from pyehl.surfaces.text_header import header_of
from pyehl.types import Array

HEADER_LINES = 200
"""Lines among which a table must begin."""
SAMPLE_LINES = 20
# First characters of numbers, nan and inf among them, and of quotes and empty cells
NUMBER_BEGINS = '0123456789+-.nNiI,;"\t'


@dataclass(slots=True)
class Table:
    """One table, and what stands above it."""

    header: list[str]
    # Each line as it stands, NaN where a point is missing
    rows: Array
    # Line of the file at which the numbers begin, from 1
    line: int
    cells: Cells
    # Lines behind it that are no numbers
    footer: list[str] = field(default_factory=list)


def begins_with_numbers(first: list[str]) -> bool:
    """Whether the first line that is no comment begins with a number, or an empty cell."""
    data = next((text for line in first if (text := uncommented(line)).strip()), "")
    word = data.lstrip(" ")
    if not word or word[0] not in NUMBER_BEGINS:
        return False
    return word[0].isdigit() or count_numbers(cells_of([data]), data) > 0


def tables_of(path: Path, encoding: str) -> list[Table]:
    """All tables of a text.

    InputError names line and column of what is neither a number nor a word for a missing point, of
    a line that is longer or shorter than the others, and the first line of a text without a table.
    """
    lines = lines_of(path, encoding)
    first = [line for _, line in zip(range(HEADER_LINES), lines, strict=False)]
    texts = [text for _, text in first]
    start, cells = _start(path, texts)
    tables: list[Table] = []
    table = Table(texts[:start], np.empty((0, 0)), start + 1, cells)
    rows: list[Array] = []
    footer: list[str] = []
    bad: InputError | None = None
    for number, line in _chained(first[start:], lines):
        row = None
        try:
            row = cells.numbers(line)
        except BadCellError as error:
            if not rows or error.index < 0 or _goes_on(cells, line, rows[0].size):
                raise _bad(path, number, line, cells, error) from None
            footer.append(line)
            bad = bad or _bad(path, number, line, cells, error)
            continue
        if row is None:
            if line.strip().startswith("#"):
                footer.append(line)
            continue
        if footer and rows:
            # numbers behind words are the next table where the words are its header
            if header_of(footer).says:
                table.rows = np.array(rows)
                tables.append(table)
                table = Table(footer, np.empty((0, 0)), number, cells)
                rows = []
            elif bad is not None:
                raise bad
            footer, bad = [], None
        rows.append(row)
        if row.size != rows[0].size:
            raise InputError(
                f"{path}:{number}:{cells.column(line, rows[0].size)}: {row.size} heights, but "
                f"{rows[0].size} in the lines above"
            )
        if len(rows) % 1024 == 0:
            check_pixels(str(path), (len(rows), row.size))
    if not rows:
        raise InputError(f"{path}: no heights in the file")
    table.rows = np.array(rows)
    table.footer = [text for text in footer if not text.strip().startswith("#")]
    return [*tables, table]


def _chained(
    first: list[tuple[int, str]], rest: Iterator[tuple[int, str]]
) -> Iterator[tuple[int, str]]:
    yield from first
    yield from rest


def _start(path: Path, first: list[str]) -> tuple[int, Cells]:
    """Index of the line at which the first table begins, and how its cells are separated."""
    begins = next((n for n, line in enumerate(first) if uncommented(line).strip()), 0)
    cells = cells_of(first[begins : begins + SAMPLE_LINES])
    if begins_with_numbers(first) and count_numbers(cells, first[begins]):
        counts = [count_numbers(cells, line) for line in first[begins : begins + 3]]
        # a line of x without a corner above a column of y
        corner = counts[0] + 1
        # or the numbers of points alone
        if len(counts) == 3 and counts[1] == counts[2] and (corner == counts[1] or corner == 3):
            begins += counts[0] != counts[1]
        return begins, cells.fresh()
    best: tuple[int, int, Cells] | None = None
    # the header may have other separators than the table: that of the last lines counts
    cells = cells_of([line for line in first[-SAMPLE_LINES:] if line.strip()])
    for candidate in (cells, cells_of(first)):
        counts = [count_numbers(candidate, line) for line in first]
        # two lines of as many numbers, three at the least: a header may have numbers, too
        both = enumerate(pairwise(counts))
        found = next((n for n, (one, other) in both if one == other > 2), None)
        if found is not None and (best is None or counts[found] > best[1]):
            best = found, counts[found], candidate
    if best is None and begins_with_numbers(first):
        return begins, cells_of(first[begins : begins + SAMPLE_LINES])
    if best is None and not any(uncommented(line).strip() for line in first):
        raise InputError(f"{path}: no heights in the file")
    if best is None:
        counts = [count_numbers(cells, line) for line in first]
        if any(one == other > 0 for one, other in pairwise(counts)):
            raise InputError(
                f"{path}: it is a profile along a line, of {max(counts)} numbers a line; a contact "
                "needs the map of an area"
            )
        at = next((n for n, line in enumerate(first) if line.strip()), 0)
        raise InputError(
            f"{path}:{at + 1}: {first[at].strip()[:40]!r} is not numbers, and no table of heights "
            "follows\n"
            "expected: numbers, with surface.height_unit, surface.length_x and surface.length_y"
        )
    start, size, separated = best
    # what stood in place of missing points is counted from here
    cells = separated.fresh()
    # lines of missing points above the first number belong to the table
    while start > 0 and _is_row_of_none(cells, first[start - 1], size):
        start -= 1
    return start, cells


def _is_row_of_none(cells: Cells, line: str, size: int) -> bool:
    """Whether a line is one of missing points alone."""
    try:
        row = cells.numbers(line)
    except BadCellError:
        return False
    return row is not None and row.size == size and not np.isfinite(row).any()


def _goes_on(cells: Cells, line: str, size: int) -> bool:
    """Whether a line that cannot be read is one of the table, and no heading or footer."""
    parts = cells.split(line)
    numbers = sum(count_numbers(cells, part) > 0 for part in parts)
    return len(parts) == size or 2 * numbers >= max(len(parts), 1)


def _bad(path: Path, number: int, line: str, cells: Cells, error: BadCellError) -> InputError:
    """Say where a cell is no number."""
    place = f"{path}:{number}:{cells.column(line, error.index)}"
    if error.index < 0 or (cells.separator == "," and len(error.cell.split()) > 1):
        return InputError(
            f"{place}: commas and blanks both separate the numbers; if the comma is a decimal "
            "comma, write a point, or a semicolon between the numbers"
        )
    return InputError(
        f"{place}: {error.cell!r} is no number; expected: heights, and nan where a point is missing"
    )
