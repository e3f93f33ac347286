# SPDX-License-Identifier: BSD-3-Clause
"""The result folder of a measured response, and the shipped response beside it."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from pyehl.case import Case
from pyehl.destination import Destination
from pyehl.netcdf import write_netcdf
from pyehl.prediction.smooth import solve_contact, zone_of
from pyehl.studies.response import with_tiers
from pyehl.studies.response_table import dataset, shipped_response, write_table
from pyehl.studies.tiers import TIERS
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.response import fitted_range
from pyehl.theory.transport import Zone

__all__ = ["beside_shipped", "destination", "write"]

Settings = Mapping[str, Mapping[str, Any]]
Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

PICTURE = "response.png"
FILES = ("response.csv", "response.nc", "case.nml", PICTURE, "summary.json")
DIRECTIONS = (0.0, 45.0, 80.0, 90.0)
"""Of the lines of the shipped response: crests to those across the motion [deg]."""


def _zone(settings: Settings, operating: OperatingPoint) -> Zone:
    """Give the smooth contact that the shipped response goes through."""
    return zone_of(solve_contact(settings), operating, Lubricant.from_settings(settings))


def destination(
    folder: str | Path, *, inputs: Iterable[str | Path] = (), force: bool = False
) -> Destination:
    """Give the place of a measured response."""
    names = (*FILES, *(f"tier_{tier.name}.npz" for tier in TIERS))
    return Destination(folder, "response", names, tuple(inputs), force=force)


def write(
    case: Case,
    found: Mapping[str, Mapping[str, Any]],
    place: Destination,
    draw: Callable[[xr.Dataset, Path], object],
) -> dict[str, Any]:
    """Write table, Dataset, picture, summary and case of a measured response, whole or not at all.

    Parameters
    ----------
    case
        What was measured.
    found
        As :func:`pyehl.studies.response.measure` returns it.
    place
        Where to, with the tiers in it.
    draw
        Draws the waves, as :func:`pyehl.studies.response_table.dataset` gives them, into a file.

    Returns
    -------
    dict
        The summary.

    Raises
    ------
    InputError, FileError
        If the folder holds something else, or cannot be written.
    """
    settings = case.resolve()
    ratio = float(settings["surface"]["velocity_ratio"])
    operating = OperatingPoint.from_settings(settings)
    data = dataset(found, _zone(settings, operating), operating, ratio)
    values = {"moes_m": operating.moes_m, "moes_l": operating.moes_l, "velocity_ratio": ratio}
    difference = data["shipped_difference"].values[:, 1]
    summary = {
        "kind": "response",
        "files": list(FILES),
        **values,
        "waves": int(data.sizes["wave"]),
        "tiers": [_tier_summary(name, tier) for name, tier in found.items()],
        "shipped_difference_rms": float(np.sqrt(np.mean(difference**2))),
        "shipped_difference_max": float(difference.max()),
        "within_fitted_range": all(
            low <= values[name] <= high for name, (low, high) in fitted_range().items()
        ),
    }
    with with_tiers(place).fresh() as folder:
        write_table(data, folder / "response.csv")
        write_netcdf(folder / "response.nc", data)
        draw(data, folder / PICTURE)
        (folder / "case.nml").write_text(case.text, encoding="utf-8")
        text = json.dumps(summary, indent=2, allow_nan=False) + "\n"
        (folder / "summary.json").write_text(text, encoding="utf-8")
    return summary


def beside_shipped(
    settings: Settings, data: xr.Dataset
) -> tuple[dict[str, Array], dict[float, tuple[Array, Complex]], str]:
    """Give the measured waves at X = 0 and the shipped response, to draw.

    Returns
    -------
    tuple
        The arguments of :func:`pyehl.plots.response.response_figure`.
    """
    operating = OperatingPoint.from_settings(settings)
    zone, ratio = _zone(settings, operating), float(data.attrs["velocity_ratio"])
    nabla = np.geomspace(float(data["nabla_2"].min()), float(data["nabla_2"].max()), 400)
    q = 2.0 * np.pi / nabla * np.sqrt(operating.moes_m / operating.moes_l)
    lines = {}
    for direction in DIRECTIONS:
        kx, ky = q * np.cos(np.radians(direction)), q * np.sin(np.radians(direction))
        lines[direction] = (nabla, shipped_response(kx, ky, zone, operating, ratio)[:, 1])
    waves = {
        "nabla_2": data["nabla_2"].values,
        "direction": data["direction"].values,
        "amplitude": data["amplitude"].values[:, 1],
        "lag": data["lag"].values[:, 1],
    }
    label = f"M = {operating.moes_m:.4g}, L = {operating.moes_l:.4g}, velocity ratio {ratio:g}"
    return waves, lines, label


def _tier_summary(name: str, tier: Mapping[str, Any]) -> dict[str, Any]:
    middle = int(np.argmin(np.abs(tier["x"])))
    return {
        "name": name,
        "points": round(4.0 / float(tier["spacing"])) + 1,
        "tile": float(tier["tile"]),
        "waves": int(tier["along"].size),
        "H_c": float(tier["central_film"]),
        "fit_residual": float(tier["residual"][:, middle].max()),
        "seconds": float(tier["seconds"]),
    }
