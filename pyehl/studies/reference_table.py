# SPDX-License-Identifier: BSD-3-Clause
"""Tables of reference values: CSV files with keys, values and tolerances.

The first line that is no comment (``#``) has the names of the columns. A name ``group.key`` is a
key of a case file: a row is compared with the results of cases that have these values. Any other
name is a result, as in ``summary.json``; ``NAME_rtol`` and ``NAME_atol`` beside it are its
tolerance, rtol times the value plus atol, and ``note`` is a remark. An empty cell is not
compared.
"""

import csv
import math
import os
from collections.abc import Sequence
from dataclasses import dataclass
from importlib import resources
from pathlib import Path

from pyehl.case import KEYS
from pyehl.errors import InputError, did_you_mean
from pyehl.given import text_file
from pyehl.studies.vary import LOGICAL

SHIPPED = ("smooth", "waviness")
"""Tables that come with the package."""
NOTE = "note"
TOLERANCES = ("_rtol", "_atol")

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


def read_reference(path: str | os.PathLike[str]) -> ReferenceTable:
    """Read a table of references, a file or one of `SHIPPED`.

    InputError with file, line, column and what was expected.
    """
    name = os.fspath(path)
    if name in SHIPPED and not Path(name).exists():
        file = resources.files("pyehl").joinpath("reproduce", "data", f"{name}.csv")
        name, text = f"{name}.csv", file.read_text(encoding="utf-8")
    else:
        text = text_file(path, f"a CSV file, or one of {', '.join(SHIPPED)}")
    lines = text.splitlines()
    numbers = [n for n, line in enumerate(lines, 1) if line.strip() and line[0] != "#"]
    if len(numbers) < 2:
        raise InputError(f"{name}: error: there are no rows\nexpected: a line of names, and rows")
    table = [[word.strip() for word in row] for row in csv.reader(lines[n - 1] for n in numbers)]
    head = table[0]
    keys, values = _columns(f"{name}:{numbers[0]}: error:", head)
    rows = []
    for number, row in zip(numbers[1:], table[1:], strict=True):
        where = f"{name}:{number}: error:"
        if len(row) != len(head):
            raise InputError(f"{where} {len(row)} cells\nexpected: {len(head)}, as the names")
        found = dict(zip(head, row, strict=True))
        given = {key: _key(where, key, found[key]) for key in keys}
        expected = {value: _expected(where, value, found) for value in values if found[value]}
        rows.append(ReferenceRow(number, given, expected))
    notes = tuple(line.lstrip("# ") for line in lines if line.startswith("#"))
    return ReferenceTable(name, notes, tuple(keys), tuple(values), tuple(rows))


def _columns(where: str, head: Sequence[str]) -> tuple[list[str], list[str]]:
    """Names of keys and of values."""
    for word in head:
        if not word or head.count(word) > 1:
            raise InputError(f"{where} the name '{word}' is {'there twice' if word else 'empty'}")
    known = KEYS
    keys = [word for word in head if "." in word]
    for word in keys:
        if word not in known:
            raise InputError(
                f"{where} '{word}' is no key of a case{did_you_mean(word, known)}\n"
                "expected: group.key for keys, names of summary.json for values"
            )
    rest = [word for word in head if word not in keys and word != NOTE]
    values = [word for word in rest if not word.endswith(TOLERANCES)]
    for word in rest:
        if word not in values and word[:-5] not in values:
            raise InputError(
                f"{where} '{word}' is the tolerance of no column{did_you_mean(word[:-5], values)}"
            )
    if not values:
        raise InputError(f"{where} no column of values\nexpected: names as in summary.json")
    return keys, values


def _key(where: str, key: str, cell: str) -> Key:
    if not cell:
        raise InputError(f"{where} {key} is empty\nexpected: a number or a word")
    if cell.lower() in LOGICAL:
        return LOGICAL[cell.lower()]
    try:
        return float(cell)
    except ValueError:
        return cell.strip("'\"")


def _expected(where: str, name: str, found: dict[str, str]) -> Expected:
    value = _number(where, name, found[name])
    given = [f"{name}{end}" for end in TOLERANCES if found.get(f"{name}{end}")]
    if not given:
        raise InputError(
            f"{where} {name} has no tolerance\nexpected: a column {name}_rtol or {name}_atol"
        )
    tolerance = 0.0
    for column in given:
        share = _number(where, column, found[column])
        if share < 0.0:
            raise InputError(f"{where} {column} = {found[column]}\nexpected: not negative")
        tolerance += share * abs(value) if column.endswith("_rtol") else share
    return Expected(value, tolerance)


def _number(where: str, name: str, cell: str) -> float:
    try:
        value = float(cell)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise InputError(f"{where} {name} = '{cell}'\nexpected: a number")
    return value
