# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of a result, as figures and as files."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from matplotlib.figure import Figure

from pyehl.destination import check_files, file_errors
from pyehl.errors import InputError
from pyehl.given import check_kind, path_of
from pyehl.plots import machine
from pyehl.plots.figures import prediction_figures, solution_figures
from pyehl.plots.style import DPI, page_width, save
from pyehl.schema import summary_of
from pyehl.types import Array

if TYPE_CHECKING:
    import xarray as xr

EXPECTED = (
    "expected a result of solve, predict or load, or a result folder of one case; the pictures of "
    "stribeck and response are in the folders that they write"
)
FORMATS = ("png", "pdf", "svg")
MIN_WIDTH, MAX_WIDTH = 0.04, 0.4
"""Widths of figures [m]."""
UNITS = ("auto", "si", "hertz")
# Kinds of a summary of a machine element
MACHINES = ("bearing", "gear")
# Arrays of a prediction that are drawn, with their units
PREDICTED = {"surface": "m", "deformed": "m", "delta_p": "Pa"}


class Predicted(Protocol):
    """A result of `pyehl.predict`."""

    @property
    def data(self) -> xr.Dataset:
        """Fields, tables and scalars."""
        ...


def save_all(
    figures: Mapping[str, Figure], target: Path, suffix: str = "png", dpi: int = DPI
) -> list[Path]:
    """Write figures into a folder under their names; returns their paths.

    InputError if another file has one of the names; nothing is written then.
    """
    paths = {name: target / f"{name}.{suffix}" for name in figures}
    check_files(paths.values(), "plot")
    return [save(figure, paths[name], dpi) for name, figure in figures.items()]


def made(folder: str | os.PathLike[str]) -> Path:
    """Give a folder for pictures, made if it is missing; InputError if it cannot be made."""
    target = Path(folder)
    try:
        target.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(
            f"{target}: error: this folder cannot be made\nexpected: another folder"
        ) from error
    return target


def plot(
    results: xr.Dataset | Predicted | str | os.PathLike[str],
    output: str | os.PathLike[str] | None = None,
    *,
    units: str = "auto",
    format: str = "png",
    dpi: int = DPI,
    width: float = 0.0,
) -> dict[str, Figure]:
    """Draw the pictures of a result, and write them if a folder is given.

    Parameters
    ----------
    results
        What `pyehl.solve`, `pyehl.predict` and `pyehl.load` give, or a result folder.
    output
        Folder for the pictures; None: no files are written.
    units
        Units of a solution: 'si', 'hertz', or 'auto' for SI if the case was given in SI.
    format
        One of :data:`FORMATS`.
    dpi
        Dots per inch.
    width
        Width of the figures [m], such as 0.084 for a column of a journal, with letters of 8 points;
        0: a column of 85 mm or a page of 175 mm, by their panels.

    Returns
    -------
    dict
        Figures of matplotlib by the names of their files.

    Raises
    ------
    InputError
        If it is not a result, or has nothing to draw, an argument is not allowed, or another file
        has the name of a picture.
    FileError
        If a picture cannot be written.

    Examples
    --------
    >>> import pyehl
    >>> ds = pyehl.solve("cases/quick.nml", {"grid.points": 65})
    >>> sorted(pyehl.plot(ds))
    ['centre_lines', 'film']
    """
    for name, value, known in (("units", units, UNITS), ("format", format, FORMATS)):
        if value not in known:
            raise InputError(f"{name} = {value!r}: expected one of {', '.join(known)}")
    check_kind(dpi, int, "dpi", "a whole number")
    if not 10 <= dpi <= 2400:
        raise InputError(f"dpi = {dpi}: 10 ... 2400 dots per inch were expected")
    check_kind(width, (int, float), "width", "a number [m]")
    if width and not MIN_WIDTH <= width <= MAX_WIDTH:
        raise InputError(
            f"width = {width * 1e3:g} mm: {MIN_WIDTH * 1e3:g} ... {MAX_WIDTH * 1e3:g} mm were "
            "expected"
        )
    # a prediction is drawn without these slow imports
    import xarray as xr  # noqa: PLC0415

    from pyehl.results import load  # noqa: PLC0415

    kinds = xr.Dataset, str, bytes, os.PathLike
    result = results if isinstance(results, kinds) else getattr(results, "data", None)
    if not isinstance(result, kinds):
        raise InputError(f"results of type {type(results).__name__}: {EXPECTED}")
    folder = "the Dataset" if isinstance(result, xr.Dataset) else path_of(result, "results")
    with page_width(width):
        figures = {} if isinstance(result, xr.Dataset) else _of_machine(Path(folder))
        if not figures:
            data = result if isinstance(result, xr.Dataset) else load(folder)
            if "case" not in data.attrs:
                raise InputError(f"{folder}: {EXPECTED}")
            if data.attrs.get("kind") == "prediction":
                figures = _of_prediction(data)
            else:
                figures = solution_figures(data, units)
    if not figures:
        raise InputError(
            f"{folder}: there are no fields to draw: the case has output.fields = .false.\n"
            "expected: a result folder with P.npy and H.npy"
        )
    if output is not None:
        save_all(figures, made(path_of(output, "output")), format, dpi)
    return figures


def _of_machine(folder: Path) -> dict[str, Figure]:
    """Draw the result of a bearing or a gear pair; empty for other folders."""
    try:
        summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    if not isinstance(summary, dict) or summary.get("kind") not in MACHINES:
        return {}
    import pandas as pd  # noqa: PLC0415 (heavy)

    with file_errors(folder / "contacts.csv", "cannot be read"):
        table = pd.read_csv(folder / "contacts.csv")
    return {"contacts": machine.figure(str(summary["kind"]), table, summary)}


def _of_prediction(data: xr.Dataset) -> dict[str, Figure]:
    arrays = {
        f"{side}{name}": data[f"{side}{name}_{unit}"].values
        for side in ("", "second_")
        for name, unit in PREDICTED.items()
        if f"{side}{name}_{unit}" in data
    }
    tables: dict[str, dict[str, Array]] = {"passage": {}, "bands": {}}
    for name, values in data.variables.items():
        table, _, column = str(name).partition("_")
        if table in tables:
            tables[table][column] = values.values
    return prediction_figures(summary_of(data), arrays, tables)
