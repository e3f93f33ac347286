# SPDX-License-Identifier: BSD-3-Clause
"""Records of docs/evidence, and how pages write their numbers."""

from __future__ import annotations

import csv
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Row = dict[str, str]
Read = Callable[[str], list[Row]]
Said = Callable[[Read], Iterator[str]]


def of(rows: Iterable[Row], name: str) -> NDArray[np.float64]:
    """Numbers of a column; NaN where it is empty."""
    return np.array([float(row[name] or "nan") for row in rows])


def percent(value: float, digits: int = 1) -> str:
    """A share in per cent, with the sign of the pages."""
    return f"{value:.{digits}f} %".replace("-", "−")


def largest(values: Iterable[float], digits: int) -> str:
    """The largest magnitude, rounded."""
    return f"{np.nanmax(np.abs(np.array(list(values)))):.{digits}f}"


def span(values: Iterable[float], form: str) -> str:
    """The least and the largest value."""
    found = np.array(list(values))
    return f"{np.nanmin(found):{form}} to {np.nanmax(found):{form}}"


def missing(root: Path, page: str, said: Said) -> list[str]:
    """What a record says and the page does not; a row of the record is a row of texts."""

    def read(name: str) -> list[Row]:
        lines = (root / "docs" / "evidence" / name).read_text(encoding="utf-8").splitlines()
        return list(csv.DictReader(line for line in lines if not line.startswith("#")))

    text = (root / page).read_text(encoding="utf-8")
    return [words for words in said(read) if words not in text]
