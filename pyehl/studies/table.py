# SPDX-License-Identifier: BSD-3-Clause
"""The table of a study: CSV, and an xarray Dataset whose dimensions are what was varied."""

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

from pyehl import arrays
from pyehl.case import KEYS
from pyehl.given import bare
from pyehl.results import unit_of
from pyehl.studies.study import Point, Study
from pyehl.studies.tasks import LAST
from pyehl.types import Values

# Words that are always in the table; other words only where they are asked for
TEXTS = ("status", "message")
WORDS = ("flags", "outside_range", "assessment")


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


def results(study: Study, points: Iterable[Point], rows: Mapping[int, Values]) -> pd.DataFrame:
    """Give what was varied and the results of all finished cases."""
    names = columns(study, rows)
    found = (
        [*point.values.values(), *map(rows[point.number].get, names)]
        for point in points
        if point.number in rows
    )
    return pd.DataFrame(found, columns=[*study.keys, *names], dtype=object)


def write_csv(path: Path, table: pd.DataFrame) -> None:
    """Write a table, whole or not at all. FileError if it cannot be written."""
    arrays.write_csv(path, list(table.columns), table.itertuples(index=False, name=None))


def dataset(study: Study, points: Sequence[Point], rows: Mapping[int, Values]) -> xr.Dataset:
    """Give the results over what was varied."""
    table = results(study, points, {number: rows.get(number, {}) for number in range(study.size)})
    films = ("h_c_m_", "h_min_m_")
    units = {name: "m" if name.startswith(films) else unit_of(name) for name in table}
    attributes = {"title": "study of pyehl", "run": study.run}
    attributes |= {"set": "\n".join(map(bare, study.options))} if study.options else {}
    return over(study, table, units, attributes)


def over(
    study: Study,
    table: pd.DataFrame,
    units: Mapping[str, str],
    attributes: Mapping[str, str],
    kind: type | None = None,
) -> xr.Dataset:
    """Give a table of all cases as a Dataset over what was varied.

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
    for name in table.columns.drop(study.keys):
        if name in coords:
            # the value that was given, see `ECHOED`
            continue
        column = table[name]
        if name in TEXTS or column.map(type).eq(str).any():
            values, about = column.fillna("").astype(str).to_numpy(str), {}
        else:
            values, about = column.to_numpy(float), {"units": units[name]}
        variables[name] = xr.Variable(names, values.reshape(study.shape), about)
    return xr.Dataset(variables, coords, attributes)
