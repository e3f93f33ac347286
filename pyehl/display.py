# SPDX-License-Identifier: BSD-3-Clause
"""Tables for notebooks and terminals."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from html import escape
from typing import Any

__all__ = ["Columns", "table", "text_table"]

Columns = Sequence[tuple[str, str]]
"""Names and formats."""


def table(title: str, rows: Mapping[str, object]) -> str:
    """HTML of a table with two columns, the text of all cells escaped."""
    lines = [
        f"<tr><th style='text-align:left'>{escape(name)}</th>"
        f"<td style='text-align:left'>{escape(_text(value))}</td></tr>"
        for name, value in rows.items()
    ]
    return f"<table><caption><b>{escape(title)}</b></caption>{''.join(lines)}</table>"


def _text(value: object) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def text_table(rows: Sequence[Mapping[str, Any]], columns: Columns) -> str:
    """Give rows as text; '-' for a value that does not exist."""
    lines = [[name.replace("_", " ") for name, _ in columns]]
    lines += [
        ["-" if row[name] is None else format(row[name], form) for name, form in columns]
        for row in rows
    ]
    widths = [max(len(line[k]) for line in lines) for k in range(len(columns))]
    return "\n".join(
        "  ".join(text.rjust(width) for text, width in zip(line, widths, strict=True))
        for line in lines
    )
