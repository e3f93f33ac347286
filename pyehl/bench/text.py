# SPDX-License-Identifier: BSD-3-Clause
"""Rows of numbers as text, for a terminal and for documents."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

__all__ = ["Columns", "table"]

Columns = Sequence[tuple[str, str]]


def _cell(value: object, form: str) -> str:
    return "-" if value is None else format(value, form)


def table(rows: Sequence[Mapping[str, Any]], columns: Columns) -> str:
    """Give rows as text; columns are (name, format)."""
    lines = [[name.replace("_", " ") for name, _ in columns]]
    lines += [[_cell(row[name], form) for name, form in columns] for row in rows]
    widths = [max(len(line[k]) for line in lines) for k in range(len(columns))]
    return "\n".join(
        "  ".join(text.rjust(width) for text, width in zip(line, widths, strict=True))
        for line in lines
    )
