# SPDX-License-Identifier: BSD-3-Clause
"""The table of a study: CSV, and an xarray Dataset whose dimensions are what was varied."""

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from pyehl import arrays
from pyehl.case import KEYS
from pyehl.given import bare
from pyehl.results import unit_of
from pyehl.studies.outputs import LAST
from pyehl.studies.study import Point, Study
from pyehl.types import Values

# Words that are always in the table; other words only where they are asked for
WORDS = ("flags", "outside_range", "judgement")


def columns(study: Study, rows: Mapping[int, Values]) -> list[str]:
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


def write_csv(
    path: Path,
    study: Study,
    points: Iterable[Point],
    rows: Mapping[int, Values],
    names: Sequence[str] = (),
) -> None:
    """Write the table of all finished cases, whole or not at all; `names`: of these columns.

    FileError if it cannot be written.
    """
    names = names or columns(study, rows)
    arrays.write_csv(
        path,
        [*study.keys, *names],
        (
            [*point.values.values(), *(rows[point.number].get(name) for name in names)]
            for point in points
            if point.number in rows
        ),
    )


def dataset(study: Study, points: Sequence[Point], rows: Mapping[int, Values]) -> xr.Dataset:
    """Give the results over what was varied."""
    found = {
        name: [rows.get(point.number, {}).get(name) for point in points]
        for name in columns(study, rows)
    }
    films = ("h_c_m_", "h_min_m_")
    units = {name: "m" if name.startswith(films) else unit_of(name) for name in found}
    attributes = {"title": "study of pyehl", "run": study.run}
    attributes |= {"set": "\n".join(map(bare, study.options))} if study.options else {}
    return over(study, found, units, attributes)


def over(
    study: Study,
    found: Mapping[str, Sequence[Any]],
    units: Mapping[str, str],
    attributes: Mapping[str, str],
    kind: type | None = None,
) -> xr.Dataset:
    """Give columns in the order of the table as a Dataset over what was varied.

    Dimensions have the names of `Study.names`, and their keys as attributes; keys that move
    together are coordinates of the dimension of the first of them, of a `kind` if it is given.
    Where there is no number there is NaN, where there is no word ''.
    """
    called = study.names
    names = tuple(called[axes[0].key] for axes in study.dimensions)
    coords = {}
    for axes, name in zip(study.dimensions, names, strict=True):
        for a in axes:
            about = {"key": a.key, "units": "1"}
            if known := KEYS.get(a.key):
                about["long_name"] = known.meaning
                if known.unit not in ("", "-"):
                    about["units"] = known.unit
            coords[called[a.key]] = xr.Variable((name,), np.array(a.values, dtype=kind), about)
    variables = {}
    for name, column in found.items():
        if name in coords:
            # the value that was given, see `ECHOED`
            continue
        if any(isinstance(value, str) for value in column) or name in ("status", "message"):
            values = np.array(["" if v is None else str(v) for v in column])
            unit = {}
        else:
            values = np.array([np.nan if v is None else float(v) for v in column])
            unit = {"units": units[name]}
        variables[name] = xr.Variable(names, values.reshape(study.shape), unit)
    return xr.Dataset(variables, coords, attributes)
