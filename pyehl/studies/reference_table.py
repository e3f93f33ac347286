# SPDX-License-Identifier: BSD-3-Clause
"""Tables of reference values: CSV files with keys, values and tolerances.

The first line that is no comment (``#``) has the names of the columns. A name ``group.key`` is a
key of a case file: a row is compared with the results of cases that have these values. Any other
name is a result, as in ``summary.json``; ``NAME_rtol`` and ``NAME_atol`` beside it are its
tolerance, rtol times the value plus atol, and ``note`` is for people. An empty cell is not
compared.
"""

from __future__ import annotations

import csv
import math
import os
from collections.abc import Iterable
from dataclasses import dataclass
from importlib import resources
from pathlib import Path

from pyehl import library
from pyehl.errors import InputError, did_you_mean
from pyehl.given import text_file
from pyehl.studies.vary import LOGICAL

__all__ = ["SHIPPED", "Expected", "ReferenceRow", "ReferenceTable", "read_reference"]

SHIPPED = ("smooth", "waviness")
"""Tables that come with the package."""
NOTE = "note"
RTOL, ATOL = "_rtol", "_atol"

Key = float | bool | str


@dataclass(frozen=True, slots=True)
class Expected:
    """A reference value and its tolerance, in the unit of the result."""

    value: float
    tolerance: float


@dataclass(frozen=True, slots=True)
class ReferenceRow:
    """One row: the line of the file, keys by name, expected values by name."""

    line: int
    keys: dict[str, Key]
    expected: dict[str, Expected]


@dataclass(frozen=True, slots=True)
class ReferenceTable:
    """A table of references."""

    name: str  # of the file
    notes: tuple[str, ...]  # its comment lines, which say where the values are from
    # Names of the columns
    keys: tuple[str, ...]
    values: tuple[str, ...]
    rows: tuple[ReferenceRow, ...]  # at least one


def read_reference(
    path: str | os.PathLike[str], *, keys: Iterable[str] = (), rtol: float | None = None
) -> ReferenceTable:
    """Read a table of references, a file or one of `SHIPPED`.

    `keys` are columns without a dot that are keys all the same; `rtol` is the relative tolerance
    of values that have none in the table, else they must have one. InputError with file, line,
    column and what was expected.
    """
    name, text = _text(path)
    lines = text.splitlines()
    table = [(n, line) for n, line in enumerate(lines, start=1) if _counts(line)]
    if len(table) < 2:
        raise InputError(f"{name}: error: there are no rows\nexpected: a line of names, and rows")
    cells = list(csv.reader(line for _, line in table))
    head = [word.strip() for word in cells[0]]
    key_columns, value_columns = _columns(name, table[0][0], head, keys)
    rows = []
    for (number, _), row in zip(table[1:], cells[1:], strict=True):
        if len(row) != len(head):
            raise InputError(
                f"{name}:{number}: error: {len(row)} cells\nexpected: {len(head)}, as the names"
            )
        found = dict(zip(head, (cell.strip() for cell in row), strict=True))
        given = {key: _key(f"{name}:{number}", key, found[key]) for key in key_columns}
        expected = {
            value: _expected(f"{name}:{number}", value, found, rtol)
            for value in value_columns
            if found[value]
        }
        rows.append(ReferenceRow(number, given, expected))
    notes = tuple(line.lstrip("# ") for line in lines if line.startswith("#"))
    return ReferenceTable(name, notes, tuple(key_columns), tuple(value_columns), tuple(rows))


def _text(path: str | os.PathLike[str]) -> tuple[str, str]:
    name = os.fspath(path)
    if name in SHIPPED and not Path(name).exists():
        file = resources.files("pyehl").joinpath("reproduce", "data", f"{name}.csv")
        return f"{name}.csv", file.read_text(encoding="utf-8")
    return name, text_file(path, f"a CSV file, or one of {', '.join(SHIPPED)}")


def _counts(line: str) -> bool:
    return bool(line.strip()) and not line.startswith("#")


def _columns(
    name: str, number: int, head: list[str], keys: Iterable[str]
) -> tuple[list[str], list[str]]:
    where = f"{name}:{number}: error:"
    for word in head:
        if not word or head.count(word) > 1:
            raise InputError(f"{where} the name '{word}' is {'there twice' if word else 'empty'}")
    chosen = set(keys)
    for word in chosen - set(head):
        raise InputError(
            f"{name}: error: there is no column '{word}' (--key){did_you_mean(word, head)}"
        )
    known = {key.name for key in library.keys()}
    key_columns = [word for word in head if "." in word or word in chosen]
    for word in key_columns:
        if "." in word and word not in known:
            raise InputError(
                f"{where} '{word}' is no key of a case{did_you_mean(word, known)}\n"
                "expected: group.key for keys, names of summary.json for values"
            )
    rest = [word for word in head if word not in key_columns and word != NOTE]
    values = [word for word in rest if not word.endswith((RTOL, ATOL))]
    for word in rest:
        if word not in values and word[: -len(RTOL)] not in values:
            raise InputError(
                f"{where} '{word}' is the tolerance of no column{did_you_mean(word[:-5], values)}"
            )
    if not values:
        raise InputError(f"{where} no column of values\nexpected: names as in summary.json")
    return key_columns, values


def _key(where: str, key: str, cell: str) -> Key:
    if not cell:
        raise InputError(f"{where}: error: {key} is empty\nexpected: a number or a word")
    if cell.lower() in LOGICAL:
        return LOGICAL[cell.lower()]
    try:
        return float(cell)
    except ValueError:
        return cell.strip("'\"")


def _expected(where: str, name: str, found: dict[str, str], rtol: float | None) -> Expected:
    value = _number(where, name, found[name])
    relative, absolute = (found.get(f"{name}{end}", "") for end in (RTOL, ATOL))
    if not relative and not absolute:
        if rtol is None:
            raise InputError(
                f"{where}: error: {name} has no tolerance\n"
                f"expected: a column {name}{RTOL} or {name}{ATOL}, or --rtol"
            )
        return Expected(value, rtol * abs(value))
    tolerance = 0.0
    for word, end, scale in ((relative, RTOL, abs(value)), (absolute, ATOL, 1.0)):
        if word:
            share = _number(where, f"{name}{end}", word)
            if share < 0.0:
                raise InputError(f"{where}: error: {name}{end} = {word}\nexpected: not negative")
            tolerance += share * scale
    return Expected(value, tolerance)


def _number(where: str, name: str, cell: str) -> float:
    try:
        value = float(cell)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise InputError(f"{where}: error: {name} = '{cell}'\nexpected: a number")
    return value
