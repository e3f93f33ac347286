# SPDX-License-Identifier: BSD-3-Clause
"""The result folder of a measured response, and the shipped response beside it."""

import os
import tempfile
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np
import xarray as xr

from pyehl.case import Case, exchanged
from pyehl.destination import Destination, write_json
from pyehl.given import Option, path_of
from pyehl.measured_response.measurement import measure, with_tiers
from pyehl.measured_response.table import dataset, nabla_2, shipped_response, write_table
from pyehl.measured_response.tiers import TIERS
from pyehl.netcdf import write_netcdf
from pyehl.prediction.errors import outside_range
from pyehl.prediction.options import Options
from pyehl.prediction.smooth import circle_of, solve_contact, zone_of
from pyehl.results import scalars
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Array

PICTURE = "response.png"
FILES = ("response.csv", "response.nc", "case.nml", PICTURE, "summary.json")
DIRECTIONS = (0.0, 45.0, 80.0)
"""Of the lines of the shipped response: crests to those across the motion [deg]."""


def destination(
    folder: str | os.PathLike[str],
    *,
    inputs: Iterable[str | os.PathLike[str]] = (),
    force: bool = False,
) -> Destination:
    """Give the place of a measured response."""
    names = (*FILES, *(f"tier_{tier.name}.npz" for tier in TIERS))
    return Destination(folder, "response", names, tuple(inputs), force=force)


def response(
    case: Case | str | os.PathLike[str],
    *options: Option,
    output: str | os.PathLike[str] | None = None,
    force: bool = False,
    quick: bool = False,
    second: bool = False,
    progress: Callable[[str, int, int], object] | None = None,
) -> xr.Dataset:
    """Measure what the contact of a case makes of small waves of roughness; takes minutes.

    Parameters
    ----------
    case
        A case, or the path of a case file: its contact, lubricant and `surface.velocity_ratio`.
    *options
        Values that replace those of the case: dicts, or texts ``group.key=value``.
    output
        Result folder, as ``pyehl response -o`` writes it; runs that are there already are not made
        again. None: nothing is kept on disk.
    force
        Other files may be in the folder; they stay.
    quick
        Waves down to a/16 only, in a third of the time.
    second
        At the velocity of the second surface of the case, not of the first.
    progress
        Called with the name of a run, its steps done and its steps in all.

    Returns
    -------
    xarray.Dataset
        All waves, the longest first, each variable with its units; the numbers of the summary as
        variables without a dimension, the whole summary as attributes.

    Raises
    ------
    InputError
        If the case is not acceptable, or the folder holds something else.
    FileError
        If the folder cannot be written.

    Examples
    --------
    >>> import pyehl
    >>> try:
    ...     pyehl.response("cases/table1.nml", {"surface.velocity_ratio": 0.0})
    ... except pyehl.InputError as error:
    ...     print(str(error).partition(";")[0])
    surface.velocity_ratio = 0: a surface at rest makes no waves in time
    """
    inputs = () if isinstance(case, Case) else (case,)
    case = Case.of(case, *options)
    if second:
        case = exchanged(case)
    tiers = TIERS[:-1] if quick else TIERS
    with tempfile.TemporaryDirectory(prefix="pyehl-") as nothing:
        folder = nothing if output is None else path_of(output, "output")
        place = destination(folder, inputs=inputs, force=force)
        told = {} if progress is None else {"progress": progress}
        return _write(case, measure(case, place, tiers=tiers, **told), place)


def _write(case: Case, found: Mapping[str, Mapping[str, Any]], place: Destination) -> xr.Dataset:
    """Write table, Dataset, picture, summary and case of a measured response, whole or not at all.

    `found` is what :func:`pyehl.measured_response.measurement.measure` returns.
    """
    # matplotlib takes long to import
    from pyehl.plots.response import response_figure  # noqa: PLC0415
    from pyehl.plots.style import save  # noqa: PLC0415

    settings = case.resolve()
    ratio = float(settings["surface"]["velocity_ratio"])
    operating = OperatingPoint.from_settings(settings)
    smooth, lubricant = solve_contact(settings), Lubricant.from_settings(settings)
    zone = zone_of(smooth, operating, lubricant)
    moes = circle_of(smooth, operating, lubricant)
    data = dataset(found, zone, operating, moes, ratio)
    at_centre = data.sel(X=0.0)
    longest, shortest = (float(data["wavelength"][i]) for i in (0, -1))
    q = np.geomspace(2.0 * np.pi / shortest, 2.0 * np.pi / longest, 400)
    nabla = nabla_2(q, moes)
    lines = {}
    for direction in DIRECTIONS:
        kx, ky = q * np.cos(np.radians(direction)), q * np.sin(np.radians(direction))
        lines[direction] = (nabla, shipped_response(kx, ky, zone, moes, ratio)[:, 1])
    waves = {name: at_centre[name].values for name in ("nabla_2", "direction", "amplitude", "lag")}
    label = f"M = {operating.moes_m:.4g}, L = {operating.moes_l:.4g}, velocity ratio {ratio:g}"
    summary = _summary(found, at_centre["shipped_difference"].values, data.attrs)
    summary["within_fitted_range"] = not outside_range(operating, ratio, Options(), smooth.thinning)
    with with_tiers(place).fresh() as folder:
        write_table(data, folder / "response.csv")
        write_netcdf(folder / "response.nc", data)
        save(response_figure(waves, lines, label), folder / PICTURE)
        (folder / "case.nml").write_text(case.text, encoding="utf-8")
        write_json(folder / "summary.json", summary)
    return data.assign(scalars(summary)).assign_attrs(summary)


def _summary(
    found: Mapping[str, Mapping[str, Any]], difference: Array, values: Mapping[str, Any]
) -> dict[str, Any]:
    """Give what ``summary.json`` holds; `values` has the conditions."""
    tiers = [
        {
            "name": name,
            "points": round(4.0 / float(tier["spacing"])) + 1,
            "tile": float(tier["tile"]),
            "waves": int(tier["along"].size),
            "H_c": float(tier["central_film"]),
            "fit_residual": float(tier["residual"][:, int(np.argmin(np.abs(tier["x"])))].max()),
            "seconds": float(tier["seconds"]),
        }
        for name, tier in found.items()
    ]
    return {
        "kind": "response",
        "files": list(FILES),
        **{name: values[name] for name in ("moes_m", "moes_l", "ellipticity", "velocity_ratio")},
        "waves": int(difference.size),
        "tiers": tiers,
        "shipped_difference_rms": float(np.sqrt(np.mean(difference**2))),
        "shipped_difference_max": float(difference.max()),
    }
