# SPDX-License-Identifier: BSD-3-Clause
"""Result folders as xarray Datasets: fields with coordinates and units, tables, scalars.

Capital letters (X, Y, T, P, H, RR, A_d) are in Hertz units: a, a/u, p_h, a^2/R. Names that end in
a unit (``_m``, ``_Pa``, ``_s``) are in that unit; they exist if the case was given in SI units. No
two names differ only in case, for readers of exported files that ignore case.
"""

import csv
import json
import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from pyehl import namelist
from pyehl.arrays import read_array
from pyehl.destination import file_errors
from pyehl.errors import FileError, InputError
from pyehl.given import path_of
from pyehl.schema import QUANTITIES, VERSION
from pyehl.theory.line_contact import LineContact, scaling_contact
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Array


@dataclass(frozen=True, slots=True)
class Field:
    """One file of a solution: its name without .npy, names of variables, dimensions, meaning."""

    file: str
    name: str
    si_name: str
    si_unit: str
    dims: tuple[str, ...]
    meaning: str
    scaled: str

    def scale(self, point: OperatingPoint | LineContact) -> float:
        """Hertz unit of the values in SI units."""
        if self.si_unit == "Pa":
            return point.hertz_pressure
        if self.si_unit == "s":
            return point.time_scale
        return point.hertz_radius if self.dims == (self.name,) else point.film_scale


PLANE, FRAMES = ("X", "Y"), ("X", "Y", "T")
SOLUTION = (
    Field("X", "X", "x_m", "m", ("X",), "in the direction of motion", "X = x/a"),
    Field("Y", "Y", "y_m", "m", ("Y",), "across the motion", "Y = y/a"),
    Field("frame_T", "T", "t_s", "s", ("T",), "time", "T = t u/a"),
    Field("P", "P", "p_Pa", "Pa", PLANE, "pressure", "p/p_h"),
    Field("H", "H", "h_m", "m", PLANE, "film thickness", "h R/a^2"),
    Field("P_smooth", "P_smooth", "p_smooth_Pa", "Pa", PLANE, "pressure, smooth contact", "p/p_h"),
    Field("H_smooth", "H_smooth", "h_smooth_m", "m", PLANE, "film, smooth contact", "h R/a^2"),
    Field("RR", "RR", "rr_m", "m", PLANE, "roughness, peaks positive", "r R/a^2"),
    Field("A_d", "A_d", "a_d_m", "m", PLANE, "deformed roughness: smooth film minus film", "R/a^2"),
    *(
        Field(name := f"temperature_rise{part}_K", name, name, "K", PLANE, f"rise of {of}", "")
        for part, of in (
            ("", "temperature, mean across the film"),
            ("_wall_1", "the temperature of the surface of body 1"),
            ("_wall_2", "the temperature of the surface of body 2"),
        )
    ),
    Field("frame_P", "frame_P", "frame_p_Pa", "Pa", FRAMES, "pressure in time", "p/p_h"),
    Field("frame_H", "frame_H", "frame_h_m", "m", FRAMES, "film thickness in time", "h R/a^2"),
)
# Arrays of a prediction: name in the Dataset, unit, meaning; coordinates first
PREDICTION = {
    "x": ("x_m", "m", "along the motion"),
    "y": ("y_m", "m", "across the motion"),
    "surface": ("surface_m", "m", "undeformed roughness, peaks positive"),
    "deformed": ("deformed_m", "m", "roughness deformed in the contact"),
    "delta_p": ("delta_p_Pa", "Pa", "pressure change by the roughness"),
}
PREDICTION |= {
    f"second_{file}": (f"second_{name}", unit, f"{meaning}, second surface")
    for file, (name, unit, meaning) in PREDICTION.items()
}
# Tables are CSV files with a line of names
SOLUTION_TABLES = ("history",)
PREDICTION_TABLES = ("passage", "spectrum", "bands")
# Unit by the suffix of a name, the longest first
SUFFIXES = {
    "_rad_per_m": "rad/m",
    "_per_s": "1/s",
    "_N_per_m": "N/m",
    "_Pa_s": "Pa s",
    "_K": "K",
    "_m4": "m4",
    "_Pa": "Pa",
    "_m": "m",
    "_s": "s",
    "_deg": "deg",
    "seconds": "s",
}

# Numbers have a unit in the schema; T, the time at the end, has the name of a coordinate
SCALARS = {q.name: q for q in QUANTITIES if q.unit and q.name not in {f.name for f in SOLUTION}}
SI = {
    *("s", "m", "Pa", "N", "N/m", "N m", "W", "K", "Pa s", "1/s", "1/Pa", "m/s"),
    *("deg", "byte"),
}
"""Units that are written as such; numbers in Hertz units have the unit '1'."""


def settings_of(data: xr.Dataset) -> dict[str, dict[str, Any]]:
    """Give the groups and values of the resolved case of a Dataset."""
    return namelist.values(data.attrs["case"])


def unit_of(name: str) -> str:
    """Give the unit of a quantity, or that of the suffix of its name; '1' if there is none."""
    if name in SCALARS:
        return SCALARS[name].unit if SCALARS[name].unit in SI else "1"
    return next((unit for end, unit in SUFFIXES.items() if name.endswith(end)), "1")


def _variable(dims: tuple[str, ...], values: Array, unit: str, meaning: str) -> xr.Variable:
    return xr.Variable(dims, values, {"units": unit, "long_name": meaning})


def scalars(summary: Mapping[str, Any]) -> dict[str, xr.Variable]:
    """Numbers of a summary as variables without a dimension; NaN for one that does not exist."""
    result = {}
    for name, value in summary.items():
        if name in SCALARS and (value is None or isinstance(value, int | float)):
            number = np.array(np.nan if value is None else value, dtype=np.float64)
            unit = SCALARS[name].unit
            scaled = "" if unit == "-" or unit in SI else f", in {unit}"
            meaning = f"{SCALARS[name].meaning}{scaled}"
            result[name] = _variable((), number, unit_of(name), meaning)
    return result


def attributes(summary: Mapping[str, Any]) -> dict[str, Any]:
    """Give the entries of a summary that are not variables: words, truth values and T."""
    result = {k: v for k, v in summary.items() if isinstance(v, str | int | float)}
    return {k: v for k, v in result.items() if k not in SCALARS}


def _tables(tables: Mapping[str, Mapping[str, Array]]) -> dict[str, xr.Variable]:
    return {
        f"{table}_{name}": _variable((table,), values, unit_of(name), f"{name} of the {table}")
        for table, columns in tables.items()
        for name, values in columns.items()
    }


def _solution_dataset(
    summary: Mapping[str, Any],
    case: str,
    arrays: Mapping[str, Array],
    tables: Mapping[str, Mapping[str, Array]],
) -> xr.Dataset:
    """Make the Dataset of a solution; `arrays` by the names of their files."""
    settings = namelist.values(case)
    point = scaling_contact(settings) if "mean_velocity" in settings["contact"] else None
    result: dict[str, xr.Variable] = {}
    for field in SOLUTION:
        if field.file not in arrays:
            continue
        values = arrays[field.file]
        if field.si_unit == "K":
            result[field.name] = _variable(field.dims, values, "K", field.meaning)
            continue
        result[field.name] = _variable(field.dims, values, "1", f"{field.meaning}, {field.scaled}")
        if point is not None:
            scaled = values * field.scale(point)
            result[field.si_name] = _variable(field.dims, scaled, field.si_unit, field.meaning)
    return _dataset(summary, case, result, tables)


def prediction_dataset(
    summary: Mapping[str, Any],
    case: str,
    arrays: Mapping[str, Array],
    tables: Mapping[str, Mapping[str, Array]],
) -> xr.Dataset:
    """Make the Dataset of a prediction.

    From the scalars in `pyehl.schema`, the resolved namelist text, the arrays x (nx,), y (ny,) [m]
    and, of shape (nx, ny), surface, deformed [m], delta_p [Pa], those of a second surface with the
    prefix second_, and the columns by name of the tables ``passage``, ``spectrum`` and ``bands``.
    """
    result = {
        name: _variable(_dims(name), arrays[file], unit, meaning)
        for file, (name, unit, meaning) in PREDICTION.items()
        if file in arrays
    }
    return _dataset(summary, case, result, tables)


def _dims(name: str) -> tuple[str, ...]:
    """Dimensions of an array of a prediction, by its name in the Dataset."""
    start = "second_" if name.startswith("second_") else ""
    axes = f"{start}x_m", f"{start}y_m"
    return (name,) if name in axes else axes


def _dataset(
    summary: Mapping[str, Any],
    case: str,
    result: Mapping[str, xr.Variable],
    tables: Mapping[str, Mapping[str, Array]],
) -> xr.Dataset:
    """Make a Dataset of arrays, tables and numbers; arrays of one dimension are coordinates."""
    coords = {name: values for name, values in result.items() if values.ndim == 1}
    rest = {name: values for name, values in result.items() if values.ndim > 1}
    variables = rest | _tables(tables) | scalars(summary)
    return xr.Dataset(variables, coords, attributes(summary) | {"case": case})


def _table(path: Path) -> dict[str, Array]:
    """Read a table by its columns (rows,); FileError if it cannot be read or is damaged."""
    try:
        with file_errors(path, "cannot read"), path.open(newline="", encoding="utf-8") as stream:
            rows = list(csv.reader(stream))
        values = [[float(cell or "nan") for cell in row] for row in rows[1:]]
        table = np.array(values, dtype=np.float64).reshape(len(values), len(rows[0]))
    except (csv.Error, IndexError, ValueError) as error:
        raise FileError(f"{path}: damaged: {error}") from error
    return {name: table[:, k].copy() for k, name in enumerate(rows[0])}


def load(folder: str | os.PathLike[str]) -> xr.Dataset:
    """Open a result folder.

    Parameters
    ----------
    folder
        What ``-o`` named: a folder of ``ehl``, ``pyehl run`` or ``pyehl predict``.

    Returns
    -------
    xarray.Dataset
        Each variable has ``units`` and ``long_name``. The numbers of the summary (see
        `pyehl.schema`) are variables without a dimension, NaN where they do not exist:
        ``float(ds.H_c)``. Words and truth values that exist are attributes, with the resolved case
        as ``case``; so is the time at the end, ``T``, whose name is that of a coordinate.

        Of a solution: X, Y, P, H [Hertz units], P and H of shape (nx, ny), and x_m, y_m, p_Pa,
        h_m when the case was given in SI units. A rough contact also has P_smooth, H_smooth (the
        smooth contact), RR (the roughness, peaks positive) and A_d = H_smooth - H (the roughness
        deformed in the contact); one with frictional heating temperature_rise_K (mean across the
        film), temperature_rise_wall_1_K and temperature_rise_wall_2_K; a transient run the frames
        frame_P and frame_H of shape (nx, ny, frames) at the times T, if the case asks for them.
        Columns of the history are ``history_<column>``.

        Of a prediction: surface_m, deformed_m and delta_p_Pa of shape (nx, ny) over x_m, y_m, and
        the columns ``passage_...``, ``spectrum_...`` and ``bands_...``. Of two rough surfaces also
        second_surface_m, second_deformed_m and second_delta_p_Pa over second_x_m, second_y_m.

    Raises
    ------
    InputError
        If it is not a result folder.
    FileError
        If a file of it cannot be read, or is damaged.
    NoMemoryError
        If it does not fit into memory.

    Examples
    --------
    >>> import pyehl
    >>> solved = pyehl.solve("cases/quick.nml", "grid.points=65", output="out/example")
    >>> data = pyehl.load("out/example")
    >>> data.P.shape, data.attrs["status"], round(float(data.H_c), 3)
    ((65, 65), 'converged', 0.072)
    """
    folder = Path(path_of(folder, "folder"))
    for name in ("summary.json", "case.nml"):
        if not (folder / name).is_file():
            study = (folder / "journal.sqlite").is_file()
            raise InputError(_no_case(folder, "of a study" if study else f"no {name}"))
    try:
        summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        case = (folder / "case.nml").read_text(encoding="utf-8")
    except OSError as error:
        raise FileError(f"{folder}: cannot read: {error.filename}: {error.strerror}") from error
    except ValueError as error:
        raise FileError(f"{folder}: summary.json or case.nml is damaged: {error}") from error
    if not isinstance(summary, dict):
        raise FileError(f"{folder}: summary.json is damaged: it is no object")
    if summary.get("kind", "solution") not in ("solution", "prediction"):
        raise InputError(_no_case(folder, f"of '{summary['kind']}'"))
    if summary.get("schema_version", VERSION) > VERSION:
        raise InputError(
            f"{folder}: results of schema {summary['schema_version']}; this version of pyehl reads "
            f"schema {VERSION}\nexpected: a newer version of pyehl"
        )
    prediction = summary.get("kind") == "prediction"
    files = list(PREDICTION) if prediction else [field.file for field in SOLUTION]
    names = PREDICTION_TABLES if prediction else SOLUTION_TABLES
    arrays = {n: read_array(p) for n in files if (p := folder / f"{n}.npy").is_file()}
    tables = {n: _table(p) for n in names if (p := folder / f"{n}.csv").is_file()}
    make = prediction_dataset if prediction else _solution_dataset
    return make(summary, case, arrays, tables)


def _no_case(folder: Path, why: str) -> str:
    return (
        f"{folder}: not a result folder of one case ({why}); tables and pictures of other results "
        "are in their folders\nexpected: what -o of run or predict named"
    )
