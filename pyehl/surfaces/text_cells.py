# SPDX-License-Identifier: BSD-3-Clause
"""Cells of a table in a text: numbers, missing points, and what is neither."""

import csv
import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from pyehl.types import Array

BLANKS = " "
"""Stands for any number of blanks as the separator."""
SEPARATORS = (";", "\t", ",", BLANKS)

_WORDS = """
    nan inf infinity infinite nil bad void null none missing invalid masked undefined undef empty
    na n/a n.a. nd n.d. nv n.v. nodata no_data no-data novalue unmeasured outlier over under ovr
    overflow underflow off ungültig ungueltig fehlt leer ohne nichtgemessen invalide absent vide
    manquant mancante vuoto vacío vacio perdido 無効 欠測 なし 无效 缺失
"""
WORDS = frozenset(_WORDS.split())
"""Words in place of a missing point, in lower case."""
# Marks without a letter or digit: ***, ---, ?, ..., and the like; and errors of spreadsheets
_MARKS = re.compile(
    r"[-+*_?.~#!–—−×|<>]+|#?(?:n/a|nv|num!|value!|wert!|ref!|div/0!)|[-+]?1\.#\w+|<\w+>|x{2,}",
    re.IGNORECASE,
)
# Two words for one point, where blanks separate the cells
_PHRASES = re.compile(
    r"\b(?:no|not|out|kein|keine|nicht|pas|sin)[ _-]+"
    r"(?:data|value|measured|valid|available|of[ _-]range|daten|wert|gemessen|de[ _-]données|datos)"
    r"\b",
    re.IGNORECASE,
)
# A comment begins a line, or follows a blank; #N/A is none
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
    """How the cells of a table are separated, and what stood in place of missing points."""

    separator: str
    # Whether each line ends with a separator, behind which there is no cell; begins with one
    closed: bool = False
    opened: bool = False
    words: Counter[str] = field(default_factory=Counter)

    def split(self, line: str) -> list[str]:
        """Cells of a line, without a comment; none for an empty line."""
        text = uncommented(line)
        if not text.strip():
            # separators alone are a line of missing points
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
        """Give the same separation, with nothing counted."""
        return Cells(self.separator, self.closed, self.opened)

    def numbers(self, line: str) -> Array | None:
        """Numbers of a line, NaN where a point is missing; None for an empty line.

        BadCellError names the first cell that is neither.
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
        """Column of a cell of a line, from 1; behind the last one where there are fewer."""
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
    """Text of a line before its comment."""
    found = _COMMENT.search(line) if "#" in line else None
    return line[: found.start()] if found else line


def is_missing(word: str) -> bool:
    """Whether a word, or nothing, stands in place of a missing point."""
    return (
        not word
        or word.lower() in WORDS
        or bool(_MARKS.fullmatch(word))
        or bool(_PHRASES.fullmatch(word))
    )


def cells_of(lines: Sequence[str]) -> Cells:
    """How the lines of a table are separated: so that most of them have equally many numbers."""
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
    """Count the cells of a line of heights; 0 for a line of anything else, or of no number."""
    try:
        row = cells.numbers(line)
    except (BadCellError, csv.Error):
        return 0
    return row.size if row is not None and np.isfinite(row).any() else 0
