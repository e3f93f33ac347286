# SPDX-License-Identifier: BSD-3-Clause
"""Read the records of docs/evidence, and format numbers for pages."""

from __future__ import annotations

import csv
import sys
from collections.abc import Iterable
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

ROOT = Path(__file__).resolve().parents[2]
Row = dict[str, str]
Values = dict[str, Any]
"""Values by the names that the markers of a page may use."""


def read(name: str) -> list[Row]:
    """Read the rows of a table of docs/evidence, as texts."""
    text = (ROOT / "docs" / "evidence" / name).read_text(encoding="utf-8")
    return list(csv.DictReader(x for x in text.splitlines() if not x.startswith("#")))


def of(rows: Iterable[Row], name: str) -> NDArray[np.float64]:
    """Give the numbers of a column; NaN for an empty cell."""
    return np.array([float(row[name] or "nan") for row in rows])


def percent(value: float, digits: int = 1) -> str:
    """Format a number in per cent, with the minus sign of the pages."""
    return f"{value:.{digits}f} %".replace("-", "−")


def largest(values: Iterable[float], digits: int) -> str:
    """Format the maximum magnitude."""
    return f"{np.nanmax(np.abs(np.array(list(values)))):.{digits}f}"


def span(values: Iterable[float], form: str) -> str:
    """Format the minimum and maximum."""
    result = np.array(list(values))
    return f"{np.nanmin(result):{form}} to {np.nanmax(result):{form}}"


def script(path: str) -> ModuleType:
    """Import a script of docs/evidence."""
    file = ROOT / "docs" / "evidence" / path
    spec = spec_from_file_location(path.replace("/", "_"), file)
    assert spec is not None
    assert spec.loader is not None
    module = module_from_spec(spec)
    # dataclasses look up their module
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module
