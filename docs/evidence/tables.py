# SPDX-License-Identifier: BSD-3-Clause
"""Tables of evidence: numbers of a CSV file, and how many stated errors hold."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

Row = dict[str, Any]


def numbers_of(path: Path) -> list[Row]:
    """Read a table; None where there is no number."""

    def value(text: str) -> float | str | None:
        try:
            return float(text)
        except ValueError:
            return text or None

    with path.open(encoding="utf-8", newline="") as stream:
        return [{k: value(v) for k, v in row.items()} for row in csv.DictReader(stream)]


def shares(rows: list[Row], name: str, true: str, stated: str, factor: float) -> tuple[int, int]:
    """Count the rows whose true error is at most `factor` times the stated one, and all of them."""
    known = [row for row in rows if None not in (row[name], row[true], row[stated])]
    good = sum(abs(row[name] - row[true]) <= factor * row[stated] for row in known)
    return good, len(known)
