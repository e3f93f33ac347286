# SPDX-License-Identifier: BSD-3-Clause
"""Read and write the tables of this folder."""

from __future__ import annotations

import csv
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
WORDS = frozenset(
    {
        *("kind", "law", "border", "processor", "build", "message"),
        *("status", "fine_status", "long_status"),
    }
)

Row = dict[str, Any]


def write(name: str, columns: tuple[str, ...], rows: Iterable[Row]) -> None:
    """Write a table."""
    with (HERE / name).open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, columns, extrasaction="ignore", lineterminator="\n")
        writer.writeheader()
        for row in rows:
            writer.writerow({name: _rounded(row.get(name)) for name in columns})


def _rounded(value: object) -> object:
    return f"{value:.6g}" if isinstance(value, float) else value


def read(name: str = "contacts.csv") -> list[Row]:
    """Read a table; None for an empty cell."""
    with (HERE / name).open(encoding="utf-8", newline="") as stream:
        return [{k: _value(k, v) for k, v in row.items()} for row in csv.DictReader(stream)]


def _value(name: str, text: str) -> float | int | str | None:
    if name in WORDS or not text:
        return text or None
    number = float(text)
    return int(number) if number.is_integer() and "." not in text else number


def run(
    command: str,
    measure: Mapping[str, Callable[[], None]],
    tables: Iterable[Callable[[], list[str]]],
) -> None:
    """Make a table with the command of its name, or print the tables of the documents."""
    if command in measure:
        measure[command]()
    else:
        print("\n\n".join("\n".join(lines()) for lines in tables))
