# SPDX-License-Identifier: BSD-3-Clause
"""Result folder of a measured response, with the response of the prediction for comparison."""

import os
import tempfile
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from pyehl import schema
from pyehl.case import Case, exchanged
from pyehl.case.duty import refuse_duty
from pyehl.case.inlet import refuse_inlet
from pyehl.contact.smooth import circle_of, solve_contact, zone_of
from pyehl.destination import Destination, new_file, write_json
from pyehl.given import Option, path_of
from pyehl.measured_response.measurement import TIERS, measure, with_tiers
from pyehl.netcdf import write_netcdf
from pyehl.prediction.model import ModelOptions, outside_range
from pyehl.prediction.response import STATIONS
from pyehl.results import scalars
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.response import inlet_transfer
from pyehl.theory.transport import Zone, stiffness, transport
from pyehl.types import Array, Complex

PICTURE = "response.png"
FILES = ("response.csv", "response.nc", "case.nml", PICTURE, "summary.json")
DIRECTIONS = (0.0, 45.0, 80.0)
"""Directions in which the shipped response is drawn [deg]; 0: crests across the motion."""
PLACES = ("upstream", "centre", "downstream")
"""Names of the STATIONS on Y = 0 in the columns of the table."""
# Variables over the waves, some of them also over X: meaning and unit
VARIABLES = {
    "kx": ("wavenumber along the motion", "1/a"),
    "ky": ("wavenumber across the motion", "1/a"),
    "wavelength": ("2 pi/|q|", "a"),
    "nabla_2": ("wavelength over a times sqrt(M/L) of the circle with the same inlet", "1"),
    "direction": ("angle of the crests to those across the motion", "degree"),
    "points": ("nodes per side of the grid", "1"),
    "fit_residual": ("rms residual of the fit in time over the amplitude, at X = 0", "1"),
    "amplitude": ("|T|, film wave over roughness", "1"),
    "lag": ("phase of T", "degree"),
    "pressure": ("|pressure wave| over roughness", "p_h R/a^2"),
    "pressure_ratio": ("pressure wave over that of the half-space, K (1 - T)", "1"),
    "shipped_amplitude": ("|T| of the response that the prediction uses", "1"),
    "shipped_lag": ("phase of T of the response that the prediction uses", "degree"),
    "shipped_difference": ("|T - T of the response that the prediction uses|", "1"),
}


def destination(
    folder: str | os.PathLike[str],
    *,
    inputs: Iterable[str | os.PathLike[str]] = (),
    force: bool = False,
) -> Destination:
    """Return the destination of a measured response."""
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
    """Measure the response of a contact to small waves of roughness; takes minutes.

    Parameters
    ----------
    case
        A case, or the path of a case file: its contact, lubricant and `surface.velocity_ratio`.
    *options
        Values that replace those of the case, as in `Case`.
    output
        Result folder, as ``pyehl response -o`` writes it; runs that it already holds are not
        repeated. None: nothing is kept on disk.
    force
        Other files may be in the folder; they stay.
    quick
        Waves down to a/16 only, with a sixth of the work: nodes times steps.
    second
        At the velocity of the second surface of the case, not of the first.
    progress
        Called with the name of a run, its steps done and its total of steps.

    Returns
    -------
    xarray.Dataset
        All waves, the longest first, each variable with its units; numbers of the summary as scalar
        variables, its texts and booleans as attributes.

    Raises
    ------
    InputError
        If the case is not valid, or the folder has other files.
    EhlError
        If a run fails; the folder keeps the finished ones.
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
    case = Case(case, *options)
    settings = case.resolve()
    refuse_duty(settings)
    refuse_inlet(settings, "waves are measured in a flooded contact", "a case without &inlet")
    # refuses lines and rollers
    OperatingPoint.from_settings(settings)
    if second:
        case = exchanged(case)
    tiers = TIERS[:-1] if quick else TIERS
    with tempfile.TemporaryDirectory(prefix="pyehl-") as nothing:
        folder = nothing if output is None else path_of(output, "output")
        place = destination(folder, inputs=inputs, force=force)
        more = {} if progress is None else {"progress": progress}
        return _write(case, measure(case, place, tiers=tiers, **more), place)


def _write(case: Case, result: Mapping[str, Mapping[str, Any]], place: Destination) -> xr.Dataset:
    """Write table, Dataset, picture, summary and case of a measured response, whole or not at all.

    `result` is what :func:`pyehl.measured_response.measurement.measure` returns.
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
    data = dataset(result, zone, operating, moes, ratio)
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
    summary = _summary(result, at_centre["shipped_difference"].values, data)
    summary["within_fitted_range"] = not outside_range(
        operating, ratio, ModelOptions(), smooth.thinning
    )
    with with_tiers(place).fresh() as folder:
        write_table(data, folder / "response.csv")
        write_netcdf(folder / "response.nc", data)
        save(response_figure(waves, lines, label), folder / PICTURE)
        (folder / "case.nml").write_text(case.text, encoding="utf-8")
        write_json(folder / "summary.json", summary)
    numbers = scalars(summary)
    rest = {name: value for name, value in summary.items() if name not in numbers}
    return data.assign(numbers).assign_attrs(rest)


def _summary(
    result: Mapping[str, Mapping[str, Any]], difference: Array, values: xr.Dataset
) -> dict[str, Any]:
    """Return the content of ``summary.json``; `values` has the conditions."""
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
        for name, tier in result.items()
    ]
    conditions = "moes_m", "moes_l", "ellipticity", "velocity_ratio"
    return {
        "kind": "response",
        "schema_version": schema.VERSION,
        "files": list(FILES),
        **{name: float(values[name]) for name in conditions},
        "waves": int(difference.size),
        "tiers": tiers,
        "shipped_difference_rms": float(np.sqrt(np.mean(difference**2))),
        "shipped_difference_max": float(difference.max()),
    }


def shipped_response(
    kx: Array, ky: Array, zone: Zone, moes: tuple[float, float], velocity_ratio: float
) -> Complex:
    """T at the STATIONS by :mod:`pyehl.theory.response`, (m, 3), for wavenumbers [1/a].

    `moes`: M and L of the circular contact with the same inlet.
    """
    inlet = inlet_transfer(zone, kx, ky, moes, velocity_ratio)
    slip = np.exp(1j * np.outer(kx * (velocity_ratio - 1.0), STATIONS + 1.0))
    parts = transport(zone, kx, ky, velocity_ratio, STATIONS)
    result = [driven + free * inlet * slip[:, i] for i, (driven, free) in enumerate(parts)]
    return np.stack(result, axis=-1)


def nabla_2(q: Array, moes: tuple[float, float]) -> Array:
    """Wavelength parameter of waves |q| [1/a], by M and L of the circle with the same inlet."""
    moes_m, moes_l = moes
    return np.asarray(2.0 * np.pi / q * np.sqrt(moes_m / moes_l))


def _tier(
    tier: Mapping[str, Any], zone: Zone, moes: tuple[float, float], velocity_ratio: float
) -> dict[str, Array]:
    k0 = 2.0 * np.pi / float(tier["tile"])
    kx, ky = k0 * tier["along"], k0 * tier["across"]
    q = np.hypot(kx, ky)
    place = [int(np.argmin(np.abs(tier["x"] - station))) for station in STATIONS]
    t, pressure = tier["response"][:, place], tier["stiffness"][:, place]
    half_space = zone.stiffness * stiffness(q)[:, np.newaxis]
    shipped = shipped_response(kx, ky, zone, moes, velocity_ratio)
    return {
        "kx": kx,
        "ky": ky,
        "wavelength": 2.0 * np.pi / q,
        "nabla_2": nabla_2(q, moes),
        "direction": np.degrees(np.arctan2(ky, kx)),
        "points": np.full(kx.shape, round(4.0 / float(tier["spacing"])) + 1.0),
        "fit_residual": tier["residual"][:, place[1]],
        "amplitude": np.abs(t),
        "lag": np.degrees(np.angle(t)),
        "pressure": np.abs(pressure),
        "pressure_ratio": np.abs(pressure / (half_space * (1.0 - t))),
        "shipped_amplitude": np.abs(shipped),
        "shipped_lag": np.degrees(np.angle(shipped)),
        "shipped_difference": np.abs(t - shipped),
    }


def dataset(
    tiers: Mapping[str, Mapping[str, Any]],
    zone: Zone,
    operating: OperatingPoint,
    moes: tuple[float, float],
    velocity_ratio: float,
) -> xr.Dataset:
    """Return all waves of a measurement, the longest first.

    `tiers` are as :func:`pyehl.measured_response.measurement.measure` returns them; `zone` is the
    smooth contact of the shipped response, `moes` M and L of the circular contact with the same
    inlet. Variables are over wave (m,), or over wave and X (m, 3) at the STATIONS, with units.
    """
    parts = [_tier(tier, zone, moes, velocity_ratio) for tier in tiers.values()]
    joined = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    order = np.argsort(-joined["wavelength"], kind="stable")
    names = np.repeat(list(tiers), [tier["along"].size for tier in tiers.values()])
    variables = {"tier": xr.Variable(("wave",), names[order], {"long_name": "run of the wave"})}
    for name, (text, unit) in VARIABLES.items():
        values = joined[name][order]
        dims = ("wave", "X")[: values.ndim]
        variables[name] = xr.Variable(dims, values, {"long_name": text, "units": unit})
    place = xr.Variable(("X",), STATIONS, {"long_name": "along the motion, x/a", "units": "1"})
    conditions = {
        "moes_m": operating.moes_m,
        "moes_l": operating.moes_l,
        "ellipticity": operating.ellipse.ellipticity,
        "velocity_ratio": velocity_ratio,
    }
    title = {"title": "response of a lubricated contact to waves of roughness"}
    return xr.Dataset(variables | scalars(conditions), {"X": place}, title)


def write_table(data: xr.Dataset, path: Path) -> None:
    """Write a Dataset of waves as CSV, one row per wave, a column for each X."""
    table = data[[name for name in data if data[name].dims == ("wave",)]].to_dataframe()
    for name in VARIABLES:
        if "X" in data[name].dims:
            table[[f"{name}_{place}" for place in PLACES]] = data[name].values
    with new_file(path) as fresh:
        table.to_csv(fresh, index=False, float_format="%.6g")
