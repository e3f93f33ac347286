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
from pyehl.operating import OperatingPoint

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
        (nx, ny). History columns are named ``history_<column>``, one value per row.
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
    x, y = _array(folder / "X.npy"), _array(folder / "Y.npy")
    p, h = _array(folder / "P.npy"), _array(folder / "H.npy")
    plane = ("X", "Y")
    result.coords["X"] = Variable(("X",), x, "1", "X = x/a, in the direction of motion")
    result.coords["Y"] = Variable(("Y",), y, "1", "Y = y/a, across the motion")
    result.variables["P"] = Variable(plane, p, "1", "pressure p/p_h")
    result.variables["H"] = Variable(plane, h, "1", "film h R/a^2")
    if "load" not in case["contact"]:
        return
    point = OperatingPoint.from_settings(case)
    a, p_h = point.hertz_radius, point.hertz_pressure
    result.coords["x"] = Variable(("X",), x * a, "m", "in the direction of motion")
    result.coords["y"] = Variable(("Y",), y * a, "m", "across the motion")
    result.variables["p"] = Variable(plane, p * p_h, "Pa", "pressure")
    result.variables["h"] = Variable(plane, h * a**2 / point.radius, "m", "film thickness")


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
