# SPDX-License-Identifier: BSD-3-Clause
"""Read the tables of numbers in a text, each with the lines above it; no line is ignored."""

import csv
import re
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path

import numpy as np

from pyehl.errors import InputError
from pyehl.surfaces.arrays import check_pixels, lines_of
from pyehl.surfaces.text_header import header_of
from pyehl.types import Array

BLANKS = " "
"""Separator of any number of blanks."""
SEPARATORS = (";", "\t", ",", BLANKS)

_WORDS = """
    nan inf infinity infinite nil bad void null none missing invalid masked undefined undef empty
    na n/a n.a. nd n.d. nv n.v. nodata no_data no-data novalue unmeasured outlier over under ovr
    overflow underflow off ungültig ungueltig fehlt leer ohne nichtgemessen invalide absent vide
    manquant mancante vuoto vacío vacio perdido 無効 欠測 なし 无效 缺失
"""
WORDS = frozenset(_WORDS.split())
"""Words for a missing point, in lower case."""
# Marks without letters or digits (***, ---, ?, ...), and errors of spreadsheets
_MARKS = re.compile(
    r"[-+*_?.~#!–—−×|<>]+|#?(?:n/a|nv|num!|value!|wert!|ref!|div/0!)|[-+]?1\.#\w+|<\w+>|x{2,}",
    re.IGNORECASE,
)
# Phrases of several words for one missing point, where blanks separate the cells
_PHRASES = re.compile(
    r"\b(?:no|not|out|kein|keine|nicht|pas|sin)[ _-]+"
    r"(?:data|value|measured|valid|available|of[ _-]range|daten|wert|gemessen|de[ _-]données|datos)"
    r"\b",
    re.IGNORECASE,
)
# A comment begins a line, or follows a blank; #N/A is not a comment
_COMMENT = re.compile(r"(?:^|(?<=\s))#(?!\s*(?:N/A|NV|NUM!|VALUE!|WERT!|REF!|DIV/0!|#+|$))", re.I)
_WORD = re.compile(r"\S+")
_FORTRAN = re.compile(r"^([-+.\d]+)[dD]([-+]?\d+)$")


class BadCellError(ValueError):
    """A cell that is neither a number nor a word for a missing point."""

    def __init__(self, index: int, cell: str) -> None:
        super().__init__(index, cell)
        self.index, self.cell = index, cell


@dataclass(slots=True)
class Cells:
    """Separator of the cells of a table, and counts of the words for missing points."""

    separator: str
    # Whether each line ends, or begins, with a separator that delimits no cell
    closed: bool = False
    opened: bool = False
    words: Counter[str] = field(default_factory=Counter)

    def split(self, line: str) -> list[str]:
        """Return the cells of a line without its comment; an empty list for an empty line."""
        text = uncommented(line)
        if not text.strip():
            # a line of only separators is one of missing points
            if self.separator == BLANKS or self.separator not in text:
                return []
        if self.separator == BLANKS:
            return text.replace('"', "").split()
        if '"' in text:
            cells = next(csv.reader([text], delimiter=self.separator, skipinitialspace=True))
        else:
            cells = text.split(self.separator)
        if self.closed and len(cells) > 1 and not cells[-1].strip():
            cells.pop()
        return cells[1:] if self.opened and not cells[0].strip() else cells

    def fresh(self) -> "Cells":
        """Return the same separation with empty counts."""
        return Cells(self.separator, self.closed, self.opened)

    def numbers(self, line: str) -> Array | None:
        """Return the numbers of a line, NaN where a point is missing; None for an empty line.

        BadCellError names the first cell that is neither a number nor a missing point.
        """
        cells = self.split(line)
        if not cells:
            return None
        if self.separator == BLANKS and any("," in cell for cell in cells):
            raise BadCellError(-1, ",")
        try:
            values = np.array([cell.replace(",", ".") for cell in cells], dtype=float)
        except ValueError:
            if self.separator == BLANKS:
                cells = _PHRASES.sub("nan", uncommented(line)).replace('"', "").split()
            values = np.array([self._value(n, cell) for n, cell in enumerate(cells)])
        values[np.isinf(values)] = np.nan
        return values

    def _value(self, index: int, cell: str) -> float:
        word = cell.strip().strip('"').strip()
        try:
            # Fortran writes 1.0D-07
            return float(_FORTRAN.sub(r"\1e\2", word.replace(",", ".")))
        except ValueError:
            if not is_missing(word):
                raise BadCellError(index, word) from None
        self.words[word] += 1
        return np.nan

    def column(self, line: str, index: int) -> int:
        """Text column of a cell of a line, from 1; after the last cell if there are fewer."""
        if index < 0:
            return line.index(",") + 1
        if self.separator == BLANKS:
            words = list(_WORD.finditer(uncommented(line)))
            return words[index].start() + 1 if index < len(words) else words[-1].end() + 1
        cells = uncommented(line).split(self.separator)
        if index >= len(cells):
            return len(uncommented(line).rstrip()) + 1
        index += self.opened and not cells[0].strip()
        before = sum(len(cell) + 1 for cell in cells[:index])
        return before + len(cells[index]) - len(cells[index].lstrip()) + 1


def uncommented(line: str) -> str:
    """Return the text of a line before its comment."""
    match = _COMMENT.search(line) if "#" in line else None
    return line[: match.start()] if match else line


def is_missing(word: str) -> bool:
    """Whether a cell, which may be empty, denotes a missing point."""
    return (
        not word
        or word.lower() in WORDS
        or bool(_MARKS.fullmatch(word))
        or bool(_PHRASES.fullmatch(word))
    )


def cells_of(lines: Sequence[str]) -> Cells:
    """Find the separator with which most lines of a table have equally many numbers."""
    best, score = None, (0, 0)
    for separator in SEPARATORS:
        cells = Cells(separator, *_edges(lines, separator))
        counts = Counter(count for line in lines if (count := count_numbers(cells, line)))
        if counts:
            count, times = max(counts.items(), key=lambda item: (item[1] * item[0], item[0]))
            if (times * count, count) > score:
                best, score = cells, (times * count, count)
    if best is None:
        text = "\n".join(lines)
        best = Cells(next((s for s in SEPARATORS if s in text), BLANKS))
    return best.fresh()


def _edges(lines: Sequence[str], separator: str) -> tuple[bool, bool]:
    """Whether all lines of numbers end with the separator, and begin with it."""
    if separator == BLANKS:
        return False, False
    cells = Cells(separator)
    with_it = [line for line in lines if separator in line and count_numbers(cells, line)]
    closed = bool(with_it) and all(line.rstrip(" ").endswith(separator) for line in with_it)
    return closed, bool(with_it) and all(line.startswith(separator) for line in with_it)


def count_numbers(cells: Cells, line: str) -> int:
    """Count the cells of a line of heights; 0 for any other line, or one without a number."""
    try:
        row = cells.numbers(line)
    except (BadCellError, csv.Error):
        return 0
    return row.size if row is not None and np.isfinite(row).any() else 0


HEADER_LINES = 200
"""Number of lines within which a table must begin."""
SAMPLE_LINES = 20
# First characters of numbers, nan and inf, of quotes and of empty cells
NUMBER_BEGINS = '0123456789+-.nNiI,;"\t'


@dataclass(slots=True)
class Table:
    """One table, with the lines above and below it."""

    header: list[str]
    # Numbers in the order of the file, NaN where a point is missing
    rows: Array
    # Line of the file at which the numbers begin, from 1
    line: int
    cells: Cells
    # Lines of text after it
    footer: list[str] = field(default_factory=list)


def begins_with_numbers(first: list[str]) -> bool:
    """Whether the first line that is not a comment begins with a number or an empty cell."""
    data = next((text for line in first if (text := uncommented(line)).strip()), "")
    word = data.lstrip(" ")
    if not word or word[0] not in NUMBER_BEGINS:
        return False
    return word[0].isdigit() or count_numbers(cells_of([data]), data) > 0


def tables_of(path: Path, encoding: str) -> list[Table]:
    """Read all tables of a text.

    InputError names line and column of a cell that is neither a number nor a word for a missing
    point, of a line with more or fewer cells than the others, or the first line of a text without a
    table.
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
            # numbers after words are a new table if the words are a header
            if header_of(footer).is_informative:
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
    """Index of the line at which the first table begins, and the separation of its cells."""
    begins = next((n for n, line in enumerate(first) if uncommented(line).strip()), 0)
    cells = cells_of(first[begins : begins + SAMPLE_LINES])
    if begins_with_numbers(first) and count_numbers(cells, first[begins]):
        counts = [count_numbers(cells, line) for line in first[begins : begins + 3]]
        # the first line may have the positions x, with an empty corner above the column y,
        corner = counts[0] + 1
        # or only the numbers of points
        if len(counts) == 3 and counts[1] == counts[2] and (corner == counts[1] or corner == 3):
            begins += counts[0] != counts[1]
        return begins, cells.fresh()
    best: tuple[int, int, Cells] | None = None
    # the header may have another separator than the table: try that of the last lines first
    cells = cells_of([line for line in first[-SAMPLE_LINES:] if line.strip()])
    for candidate in (cells, cells_of(first)):
        counts = [count_numbers(candidate, line) for line in first]
        # two successive lines of equally many numbers, at least three: a header may have numbers
        both = enumerate(pairwise(counts))
        result = next((n for n, (one, other) in both if one == other > 2), None)
        if result is not None and (best is None or counts[result] > best[1]):
            best = result, counts[result], candidate
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
    # words for missing points are counted from here on
    cells = separated.fresh()
    # lines of missing points above the first number belong to the table
    while start > 0 and _is_row_of_none(cells, first[start - 1], size):
        start -= 1
    return start, cells


def _is_row_of_none(cells: Cells, line: str, size: int) -> bool:
    """Whether a line has only missing points."""
    try:
        row = cells.numbers(line)
    except BadCellError:
        return False
    return row is not None and row.size == size and not np.isfinite(row).any()


def _goes_on(cells: Cells, line: str, size: int) -> bool:
    """Whether a line that cannot be read belongs to the table and is no heading or footer."""
    parts = cells.split(line)
    numbers = sum(count_numbers(cells, part) > 0 for part in parts)
    return len(parts) == size or 2 * numbers >= max(len(parts), 1)


def _bad(path: Path, number: int, line: str, cells: Cells, error: BadCellError) -> InputError:
    """Return the error of a cell that is no number, with its position."""
    place = f"{path}:{number}:{cells.column(line, error.index)}"
    if error.index < 0 or (cells.separator == "," and len(error.cell.split()) > 1):
        return InputError(
            f"{place}: commas and blanks both separate the numbers; if the comma is a decimal "
            "comma, write a point, or a semicolon between the numbers"
        )
    return InputError(
        f"{place}: {error.cell!r} is no number; expected: heights, and nan where a point is missing"
    )
