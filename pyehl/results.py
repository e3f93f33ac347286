# SPDX-License-Identifier: BSD-3-Clause
"""Result folders in Python: fields with coordinates and units, history, scalars."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from pyehl import namelist
from pyehl.theory.operating import OperatingPoint

if TYPE_CHECKING:
    import xarray

__all__ = ["Result", "Variable", "load", "read"]

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Variable:
    """Values on named dimensions, with a unit ('1' for none) and a meaning."""

    dims: tuple[str, ...]
    values: Array
    units: str
    long_name: str


@dataclass(frozen=True, slots=True)
class Result:
    """A result folder.

    Attributes
    ----------
    summary
        The scalars of ``summary.json``; None where a number does not exist.
    case
        Groups and values of the resolved case.
    coords, variables
        Coordinates and fields by name. X, Y, P, H are in Hertz units (a, p_h, a^2/R); x, y [m],
        p [Pa] and h [m] are there too when the case was given in SI units. Fields have the shape
        (nx, ny). A march also has P_smooth and H_smooth (the smooth contact), RR (the
        roughness, peaks positive) and A_d = H_smooth - H (the roughness deformed in the contact),
        in metres and pascals p_smooth, h_smooth, rr and a_d; its frames are frame_P and frame_H
        of shape (nx, ny, frames) at the times T [a/u], frame_p and frame_h at t [s]. History
        columns are named ``history_<column>``, one value per row.
    """

    summary: dict[str, Any]
    case: dict[str, dict[str, Any]]
    coords: dict[str, Variable] = field(default_factory=dict)
    variables: dict[str, Variable] = field(default_factory=dict)

    def __getitem__(self, name: str) -> Array:
        """Values of a field or coordinate."""
        return (self.variables | self.coords)[name].values

    @property
    def converged(self) -> bool:
        """Whether the numbers are a solution; otherwise they are what there was at the end."""
        return self.summary.get("status") == "converged"


# Coordinates of `ehl` and `pyehl run`: name, file, scaling, unit in SI, meaning
COORDINATES = (
    ("X", "X", "x/a", "m", "in the direction of motion"),
    ("Y", "Y", "y/a", "m", "across the motion"),
    ("T", "frame_T", "t u/a", "s", "time"),
)
# Fields of both: name, name and unit in SI, meaning, scaling, dimensions
PLANE, FRAMES = ("X", "Y"), ("X", "Y", "T")
FIELDS = (
    ("P", "p", "Pa", "pressure", "p/p_h", PLANE),
    ("H", "h", "m", "film thickness", "h R/a^2", PLANE),
    ("P_smooth", "p_smooth", "Pa", "pressure of the smooth contact", "p/p_h", PLANE),
    ("H_smooth", "h_smooth", "m", "film thickness of the smooth contact", "h R/a^2", PLANE),
    ("RR", "rr", "m", "roughness, peaks positive", "r R/a^2", PLANE),
    ("A_d", "a_d", "m", "deformed roughness: smooth film less film", "R/a^2", PLANE),
    ("frame_P", "frame_p", "Pa", "pressure in time", "p/p_h", FRAMES),
    ("frame_H", "frame_h", "m", "film thickness in time", "h R/a^2", FRAMES),
)

# File, dimensions, unit and meaning of what a folder of `pyehl predict` holds
PREDICTION = {
    "surface": ("m", "undeformed roughness, peaks positive"),
    "deformed": ("m", "roughness deformed in the contact"),
    "delta_p": ("Pa", "pressure change by the roughness"),
}


def _array(path: Path) -> Array:
    values: Array = np.load(path, allow_pickle=False)
    return values


def _history(path: Path) -> dict[str, Variable]:
    if not path.is_file():
        return {}
    with path.open(encoding="utf-8") as stream:
        names = stream.readline().strip().split(",")
        rows = [[float(cell or "nan") for cell in line.strip().split(",")] for line in stream]
    table = np.array(rows, dtype=np.float64).reshape(len(rows), len(names))
    return {
        f"history_{name}": Variable(("row",), table[:, k], "1", f"{name} of the history")
        for k, name in enumerate(names)
    }


def _solution(folder: Path, case: dict[str, dict[str, Any]], result: Result) -> None:
    """Coordinates and fields of `ehl` and `pyehl run`."""
    if not (folder / "P.npy").is_file():
        return
    point = OperatingPoint.from_settings(case) if "load" in case["contact"] else None

    for name, file, scaled, unit, meaning in COORDINATES:
        if not (folder / f"{file}.npy").is_file():
            continue
        values = _array(folder / f"{file}.npy")
        result.coords[name] = Variable((name,), values, "1", f"{name} = {scaled}, {meaning}")
        if point is not None:
            scale = point.hertz_radius if unit == "m" else point.time_scale
            result.coords[name.lower()] = Variable((name,), values * scale, unit, meaning)
    for name, si, unit, meaning, scaled, dims in FIELDS:
        if not (folder / f"{name}.npy").is_file():
            continue
        values = _array(folder / f"{name}.npy")
        result.variables[name] = Variable(dims, values, "1", f"{meaning}, {scaled}")
        if point is not None:
            scale = point.hertz_pressure if unit == "Pa" else point.film_scale
            result.variables[si] = Variable(dims, values * scale, unit, meaning)


def _prediction(folder: Path, result: Result) -> None:
    """Coordinates and fields of `pyehl predict`."""
    for name in ("x", "y"):
        result.coords[name] = Variable((name,), _array(folder / f"{name}.npy"), "m", name)
    for name, (units, meaning) in PREDICTION.items():
        values = _array(folder / f"{name}.npy")
        result.variables[name] = Variable(("x", "y"), values, units, meaning)


def read(folder: str | os.PathLike[str]) -> Result:
    """Read a result folder that either driver wrote.

    Raises
    ------
    FileNotFoundError
        If it is not a result folder.
    """
    folder = Path(folder)
    if not (folder / "summary.json").is_file():
        raise FileNotFoundError(f"{folder}: not a result folder (there is no summary.json)")
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    case = namelist.values((folder / "case.nml").read_text(encoding="utf-8"))
    result = Result(summary, case)
    if summary.get("kind") == "prediction":
        _prediction(folder, result)
    else:
        _solution(folder, case, result)
    result.variables.update(_history(folder / "history.csv"))
    return result


def load(folder: str | os.PathLike[str]) -> xarray.Dataset | Result:
    """Open a result folder as an xarray Dataset, or as a `Result` where xarray is missing.

    Parameters
    ----------
    folder
        What ``-o`` named: a folder of ``ehl``, ``pyehl run`` or ``pyehl predict``.

    Returns
    -------
    xarray.Dataset or Result
        Fields and coordinates as described at `Result`, each with ``units`` and ``long_name``;
        scalars of the summary as attributes (those that do not exist are left out).

    Raises
    ------
    FileNotFoundError
        If it is not a result folder.
    """
    result = read(folder)
    try:
        import xarray as xr  # noqa: PLC0415 (optional)
    except ImportError:
        return result

    def entry(variable: Variable) -> tuple[tuple[str, ...], Array, dict[str, str]]:
        attributes = {"units": variable.units, "long_name": variable.long_name}
        return variable.dims, variable.values, attributes

    return xr.Dataset(
        {name: entry(variable) for name, variable in result.variables.items()},
        {name: entry(variable) for name, variable in result.coords.items()},
        {k: v for k, v in result.summary.items() if isinstance(v, str | int | float)},
    )
