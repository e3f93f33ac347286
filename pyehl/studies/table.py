# SPDX-License-Identifier: BSD-3-Clause
"""The table of a study: CSV, and an xarray Dataset whose dimensions are what was varied."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from pyehl import library
from pyehl.destination import new_file
from pyehl.results import unit_of
from pyehl.studies.outputs import LAST
from pyehl.studies.study import Point, Study

__all__ = ["cell", "columns", "dataset", "write_csv"]

Row = Mapping[str, Any]

# Words that are always in the table; other words only where they are asked for
WORDS = ("flags", "outside_range")


def columns(study: Study, rows: Mapping[int, Row]) -> list[str]:
    """Names of the results in the table, behind what was varied."""
    if study.outputs:
        found: Iterable[str] = study.outputs
    else:
        names: dict[str, bool] = {}
        for number in sorted(rows):
            for name, value in rows[number].items():
                text = isinstance(value, str) and name not in WORDS
                names[name] = names.get(name, False) or text
        found = [name for name, text in names.items() if not text]
    skipped = {*LAST, *study.keys}
    return [*(name for name in found if name not in skipped), *LAST]


def write_csv(path: Path, study: Study, points: Sequence[Point], rows: Mapping[int, Row]) -> None:
    """Write the table of all finished cases, whole or not at all.

    Raises
    ------
    FileError
        If it cannot be written.
    """
    names = columns(study, rows)
    text = io.StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([*study.keys, *names])
    for point in points:
        row = rows.get(point.number)
        if row is not None:
            cells = [*point.values.values(), *(row.get(name) for name in names)]
            writer.writerow([cell(value) for value in cells])
    with new_file(path) as partial:
        partial.write_text(text.getvalue(), encoding="utf-8", newline="")


def cell(value: object) -> str:
    """Give the text of a value in a table; empty for one that does not exist."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return "true" if value else "false"
    return repr(value) if isinstance(value, float) else " ".join(str(value).split())


def dataset(study: Study, points: Sequence[Point], rows: Mapping[int, Row]) -> xr.Dataset:
    """Give the results over what was varied.

    A dimension is called by its key; keys that move together are coordinates of the dimension of
    the first of them. Where there is no number there is NaN, where there is no word ''.
    """
    names = tuple(axes[0].key for axes in study.dimensions)
    units = {key.name: key.unit for key in library.keys()}
    coords = {
        a.key: xr.Variable((axes[0].key,), np.array(a.values), {"units": units.get(a.key) or "1"})
        for axes in study.dimensions
        for a in axes
    }
    variables = {}
    for name in columns(study, rows):
        found = [rows.get(point.number, {}).get(name) for point in points]
        if any(isinstance(value, str) for value in found) or name in ("status", "message"):
            values = np.array(["" if v is None else str(v) for v in found])
            attributes = {}
        else:
            values = np.array([np.nan if v is None else float(v) for v in found])
            film = name.startswith(("h_c_m_", "h_min_m_"))
            attributes = {"units": "m" if film else unit_of(name)}
        variables[name] = xr.Variable(names, values.reshape(study.shape), attributes)
    attributes = {"title": "study of pyehl", "run": study.run}
    attributes |= {"set": "\n".join(study.options)} if study.options else {}
    return xr.Dataset(variables, coords, attributes)
