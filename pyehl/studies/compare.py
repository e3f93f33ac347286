# SPDX-License-Identifier: BSD-3-Clause
"""Results against a table of reference values: deviations, pass or fail.

A table is a CSV file with keys, values and tolerances. The first line that is not a comment (``#``)
has the names of the columns. A name ``group.key`` is a key of a case file: a row is compared with
the results of cases that have these values. Any other name is a result, as in ``summary.json``;
``NAME_rtol`` and ``NAME_atol`` define its tolerance, rtol times the value plus atol, and ``note``
is a remark. An empty cell is not compared.
"""

import json
import math
import os
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from importlib import resources
from io import StringIO
from pathlib import Path
from typing import Any

import pandas as pd

from pyehl.case import KEYS, Case
from pyehl.errors import InputError, did_you_mean
from pyehl.given import option, text_file
from pyehl.studies.journal import read_header
from pyehl.studies.measured_friction import csv_rows, number_in
from pyehl.studies.study import LOGICAL
from pyehl.types import Values

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
    notes: tuple[str, ...]  # its comment lines, which name the sources of the values
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
        file = resources.files("pyehl").joinpath("studies", "references", f"{name}.csv")
        name, text = f"{name}.csv", file.read_text(encoding="utf-8")
    else:
        text = text_file(path, f"a CSV file, or one of {', '.join(SHIPPED)}")
    where, head, lines = csv_rows(name, text)
    if not lines:
        raise InputError(f"{name}: error: there are no rows\nexpected: a line of names, and rows")
    keys, values = _columns(where, head)
    rows = []
    for number, row in lines:
        where = f"{name}:{number}: error:"
        given = {key: _key(where, key, row[key]) for key in keys}
        expected = {value: _expected(where, value, row) for value in values if row[value]}
        rows.append(ReferenceRow(number, given, expected))
    notes = tuple(line.lstrip("# ") for line in text.splitlines() if line.startswith("#"))
    return ReferenceTable(name, notes, tuple(keys), tuple(values), tuple(rows))


def _columns(where: str, head: Sequence[str]) -> tuple[list[str], list[str]]:
    """Names of keys and of values."""
    for word in head:
        if not word or head.count(word) > 1:
            raise InputError(f"{where} the name '{word}' is {'repeated' if word else 'empty'}")
    known = KEYS
    keys = [word for word in head if "." in word]
    for word in keys:
        if word not in known:
            raise InputError(
                f"{where} '{word}' is not a key of a case{did_you_mean(word, known)}\n"
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


def _expected(where: str, name: str, row: dict[str, str]) -> Expected:
    value = _number(where, name, row[name])
    given = [f"{name}{end}" for end in TOLERANCES if row.get(f"{name}{end}")]
    if not given:
        raise InputError(
            f"{where} {name} has no tolerance\nexpected: a column {name}_rtol or {name}_atol"
        )
    tolerance = 0.0
    for column in given:
        number = _number(where, column, row[column])
        if number < 0.0:
            raise InputError(f"{where} {column} = {row[column]}\nexpected: not negative")
        tolerance += number * abs(value) if column.endswith("_rtol") else number
    return Expected(value, tolerance)


def _number(where: str, name: str, cell: str) -> float:
    value = number_in(cell)
    if math.isnan(value):
        raise InputError(f"{where} {name} = '{cell}'\nexpected: a number")
    return value


TABLES = ("results.csv", "stribeck.csv")
# Relative difference below which numbers of keys are equal
SAME = 1e-9


@dataclass(frozen=True, slots=True)
class Deviation:
    """A result beside a reference value."""

    line: int  # of the table of references
    case: str  # keys of the row, as text
    name: str  # of the result
    expected: Expected  # reference value and tolerance
    value: float | None  # the result, or None
    why: str = ""  # why there is no result

    @property
    def difference(self) -> float:
        """Result minus reference [unit of the result]; NaN without a result."""
        return math.nan if self.value is None else self.value - self.expected.value

    @property
    def passed(self) -> bool:
        """Whether it is within the tolerance."""
        return self.value is not None and abs(self.difference) <= self.expected.tolerance

    def __str__(self) -> str:
        """Give name, both values, deviation and verdict in one line."""
        value, tolerance = self.expected.value, self.expected.tolerance
        if self.value is None:
            return f"{self.name} no result ({self.why}), reference {value:.6g}: FAIL"
        relative = f" ({100.0 * self.difference / value:+.2g} %)" if value else ""
        verdict = "pass" if self.passed else "FAIL"
        return (
            f"{self.name} {self.value:.6g}, reference {value:.6g}: deviation "
            f"{self.difference:+.2g}{relative}, tolerance {tolerance:.2g}: {verdict}"
        )


@dataclass(frozen=True, slots=True)
class Comparison:
    """All deviations, and rows of the table that match no result."""

    deviations: tuple[Deviation, ...]
    missing: tuple[ReferenceRow, ...]

    @property
    def passed(self) -> bool:
        """Whether every value that was compared is within its tolerance."""
        return all(d.passed for d in self.deviations)


@dataclass(frozen=True, slots=True)
class Results:
    """Results to compare: one folder, or the rows of a table."""

    name: str  # folder or file
    rows: tuple[Values, ...]  # results by name; keys of the case that were varied are among them
    many: bool  # whether it is a table
    case: str  # text of the case of all rows; '' if it is not known
    # Options ``group.key=value`` of all rows, and keys that are varied
    options: tuple[str, ...] = ()
    vary: tuple[str, ...] = ()

    def key(self, row: Values, name: str) -> object:
        """Give the value of a key for a row; None if the case does not have it.

        InputError if there is neither such a column nor the case.
        """
        if name in row:
            return row[name]
        if not self.case:
            raise InputError(
                f"{self.name}: there is no column '{name}', and no journal beside it with the case"
            )
        varied = (option(key, row[key]) for key in self.vary)
        group, _, key = name.partition(".")
        return _settings(self.case, (*self.options, *varied)).get(group, {}).get(key)


@cache
def _settings(text: str, options: tuple[str, ...]) -> dict[str, dict[str, Any]]:
    return Case.from_text(text, options, origin="case of the results").resolve()


def read_results(path: str | os.PathLike[str]) -> Results:
    """Open results: a folder of one run, of a study (``pyehl sweep``, ``stribeck``), or a CSV file.

    InputError if it is none of these.
    """
    folder = Path(path)
    if folder.is_dir() and (folder / "summary.json").is_file():
        summary = json.loads(text_file(folder / "summary.json"))
        return Results(str(folder), (summary,), False, text_file(folder / "case.nml"))
    tables = [folder / name for name in TABLES] if folder.is_dir() else [folder]
    for table in tables:
        if table.is_file():
            study = read_header(table.parent) or {"case": "", "set": (), "vary": ()}
            known = (study["case"], tuple(study["set"]), tuple(study["vary"]))
            return Results(str(table), _rows(table), True, *known)
    raise InputError(
        f"{folder}: no results\nexpected: a result folder (summary.json), a folder of "
        f"pyehl sweep or stribeck ({', '.join(TABLES)}), or a CSV file"
    )


def _rows(path: Path) -> tuple[Values, ...]:
    lines = [line for line in text_file(path).splitlines() if line.strip() and line[0] != "#"]
    if len(lines) < 2:
        raise InputError(f"{path}: there are no rows")
    try:
        table = pd.read_csv(StringIO("\n".join(lines)))
    except pd.errors.ParserError as error:
        raise InputError(f"{path}: no table: {error}") from error
    return tuple(table.to_dict("records"))


def _same(wanted: Key, result: object) -> bool:
    if isinstance(wanted, bool) or isinstance(result, bool):
        return wanted is result
    if isinstance(wanted, float):
        return isinstance(result, int | float) and math.isclose(wanted, result, rel_tol=SAME)
    return isinstance(result, str) and result.strip("'\"").lower() == wanted.lower()


def compare(results: Results, table: ReferenceTable) -> Comparison:
    """Compare results with the rows of a table that have their keys.

    InputError if no row of the table matches a result, or no result has a column of the table.
    """
    for name in table.values:
        if not any(name in row for row in results.rows):
            raise InputError(
                f"{table.name}: no result has '{name}'{did_you_mean(name, results.rows[0])}\n"
                "expected: names of results, as in summary.json"
            )
    deviations, missing = [], []
    for reference in table.rows:
        matched = [
            row
            for row in results.rows
            if all(_same(value, results.key(row, key)) for key, value in reference.keys.items())
        ]
        deviations += [result for row in matched for result in _deviations(reference, row)]
        if not matched:
            missing.append(reference)
    if not deviations:
        raise InputError(
            f"{table.name}: none of its {len(table.rows)} rows matches a result of "
            f"{results.name}; its keys are {', '.join(table.keys) or 'none'}"
        )
    return Comparison(tuple(deviations), tuple(missing))


def _deviations(reference: ReferenceRow, row: Values) -> list[Deviation]:
    words = (
        f"{k}={v:g}" if isinstance(v, float) else f"{k}={v}" for k, v in reference.keys.items()
    )
    case, result = ", ".join(words), []
    for name, expected in reference.expected.items():
        value, why = row.get(name), ""
        if (
            isinstance(value, bool)
            or not isinstance(value, int | float)
            or not math.isfinite(value)
        ):
            value, why = None, f"status '{row.get('status', 'unknown')}'"
        result.append(Deviation(reference.line, case, name, expected, value, why))
    return result
