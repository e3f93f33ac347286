# SPDX-License-Identifier: BSD-3-Clause
"""Objects in notebooks: a small table."""

from __future__ import annotations

from collections.abc import Mapping
from html import escape

__all__ = ["table"]


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
