# SPDX-License-Identifier: BSD-3-Clause
"""Readers of rig files: PCS Instruments EHD and MTM, and plain tables with units.

A reader takes the lines of a file and yields steps, each a table. To add a format, write a function
and add it to `READERS`. The PCS reader follows the public example files (EHD261, MTM311) of the
package `tribology` by M. Ploss.
"""

from __future__ import annotations

import csv
import os
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from pyehl.errors import InputError
from pyehl.rigs.quantities import MEASURED, QUANTITIES, in_si, label_of, quantity_of
from pyehl.types import Array

PCS = re.compile(r"(EHD|MTM|ETM)\d*\s+Test Data File")
SLIM = "SLIM Mapper"
MAX_BYTES = 64 * 1024 * 1024


@dataclass(frozen=True, slots=True)
class Step:
    """One table of a rig file."""

    title: str
    columns: dict[str, Array]  # by the names of `QUANTITIES`, (n,) in their units; NaN: no value
    left_out: tuple[str, ...]  # names of unknown columns


@dataclass(frozen=True, slots=True)
class RigFile:
    """Measurements of a rig: `format` names the reader of the file."""

    name: str
    format: str
    steps: tuple[Step, ...]


Lines = Sequence[str]


def read_rig(path: str | os.PathLike[str]) -> RigFile:
    """Read a file of a rig.

    Parameters
    ----------
    path
        A text file of PCS EHD or MTM, or a table with units in its header, columns separated by
        commas, semicolons or tabs.

    Returns
    -------
    RigFile
        Steps with measurements of film thickness or friction.

    Raises
    ------
    InputError
        If the file cannot be read, is none of these, or has no measurements; then with the names of
        its columns.
    """
    name = os.fspath(path)
    lines = _text(path).splitlines()
    if lines and lines[0].startswith(SLIM):
        raise InputError(
            f"{name}: error: an analysis of a SLIM picture is not read\nexpected: films over "
            "speed, or friction, as a table"
        )
    reader = next((reader for reader in READERS if reader[1](lines)), None)
    if reader is None:
        raise InputError(f"{name}: error: the file is empty")
    kind, _, read = reader
    steps = tuple(read(name, lines))
    measured = tuple(s for s in steps if any(q.name in s.columns for q in MEASURED))
    if not measured:
        result = [cell for step in steps for cell in (*step.columns, *step.left_out)]
        known = ", ".join(q.known_as[0] for q in QUANTITIES)
        raise InputError(
            f"{name}: error: no column of film thickness or friction; columns: "
            f"{', '.join(dict.fromkeys(result)) or 'none'}\nexpected: names such as {known}, with "
            "units in brackets"
        )
    return RigFile(name, kind, measured)


def is_rig(path: str | os.PathLike[str]) -> bool:
    """Whether a file comes from a rig, or is a table with units in its header."""
    lines = [line for line in _text(path).splitlines() if line.strip() and line[0] != "#"]
    if not lines:
        return False
    named = any(quantity_of(cell) and label_of(cell)[1] for cell in re.split("[;\t,]", lines[0]))
    return bool(named or PCS.match(lines[0]) or lines[0].startswith(SLIM))


def _text(path: str | os.PathLike[str]) -> str:
    """Text of a file; instruments write UTF-8, UTF-16 or Windows-1252."""
    name = os.fspath(path)
    try:
        if Path(path).stat().st_size > MAX_BYTES:
            raise InputError(f"{name}: error: larger than {MAX_BYTES >> 20} MiB: not a rig file")
        data = Path(path).read_bytes()
    except OSError as error:
        raise InputError(f"{name}: cannot read: {error.strerror or error}") from error
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return data.decode("utf-16", errors="replace")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("cp1252", errors="replace")


def _pcs(name: str, lines: Lines) -> Iterator[Step]:
    """Yield the steps of a PCS file: 'Step 2 ...', its description, column names, values."""
    title, number = "", 0
    while number < len(lines):
        line = lines[number]
        if re.match(r"Step \d+", line):
            title = line.partition(" started at")[0]
        cells = line.split("\t")
        # a line with two or more known column names begins a table
        if sum(quantity_of(cell) is not None for cell in cells) >= 2:
            last = number + 1
            while last < len(lines) and lines[last].strip() and _begins_with_number(lines[last]):
                last += 1
            rows = [line.split("\t") for line in lines[number + 1 : last]]
            yield _step(name, title, cells, rows, number + 1)
            number = last
        number += 1


def _begins_with_number(line: str) -> bool:
    try:
        float(line.partition("\t")[0])
    except ValueError:
        return False
    return True


def _table(name: str, lines: Lines) -> Iterator[Step]:
    """Yield one table: comments (#), a line of names, values."""
    numbers = [n for n, line in enumerate(lines) if line.strip() and not line.startswith("#")]
    if not numbers:
        return
    head = lines[numbers[0]]
    delimiter = max(";\t,", key=head.count)
    rows = list(csv.reader([lines[n] for n in numbers], delimiter=delimiter))
    if delimiter == ";" and any("," in cell for row in rows[1:] for cell in row):
        rows = [rows[0], *([cell.replace(",", ".") for cell in row] for row in rows[1:])]
    for n, row in zip(numbers[1:], rows[1:], strict=True):
        if len(row) != len(rows[0]):
            raise InputError(f"{name}:{n + 1}: error: {len(row)} values for {len(rows[0])} columns")
    yield _step(name, "", rows[0], rows[1:], numbers[0] + 1)


def _step(
    name: str, title: str, head: Sequence[str], rows: Sequence[Sequence[str]], line: int
) -> Step:
    """Return the known columns in their units; of two for one quantity that with more values."""
    columns: dict[str, Array] = {}
    left_out: list[str] = []
    for k, cell in enumerate(head):
        quantity = quantity_of(cell)
        if quantity is None:
            left_out += [cell.strip()] if cell.strip() else []
            continue
        values = np.array([_value(row[k]) if k < len(row) else np.nan for row in rows])
        if not np.isfinite(values).any():
            continue
        try:
            values = in_si(quantity, cell, values)
        except ValueError as error:
            raise InputError(f"{name}:{line}: error: column '{cell.strip()}'\n{error}") from None
        before = columns.get(quantity.name)
        if before is None or np.isfinite(before).sum() < np.isfinite(values).sum():
            columns[quantity.name] = values
    return Step(title, columns, tuple(dict.fromkeys(left_out)))


def _value(cell: str) -> float:
    try:
        return float(cell)
    except ValueError:
        return float("nan")


READERS: tuple[tuple[str, Callable[[Lines], bool], Callable[[str, Lines], Iterator[Step]]], ...] = (
    ("PCS", lambda lines: bool(lines and PCS.match(lines[0])), _pcs),
    ("table", lambda lines: any(line.strip() for line in lines), _table),
)
"""Name, test and reader of each format; the first whose test succeeds is used."""
