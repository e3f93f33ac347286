# SPDX-License-Identifier: BSD-3-Clause
"""A measured response as an xarray Dataset and as a table, beside the shipped response."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from pyehl.destination import new_file
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.response import inlet_transfer
from pyehl.theory.transport import Zone, stiffness, transport
from pyehl.types import Array, Complex

STATIONS = np.array([-0.5, 0.0, 0.5])
"""Where the response is tabulated, on Y = 0 [a]."""
PLACES = ("upstream", "centre", "downstream")
"""How the columns of the table call them."""
# Variables over the waves, the second part also over X: meaning and unit
VARIABLES = {
    "kx": ("wavenumber along the motion", "1/a"),
    "ky": ("wavenumber across the motion", "1/a"),
    "wavelength": ("2 pi/|q|", "a"),
    "nabla_2": ("wavelength over a times sqrt(M/L) of the circle with the same inlet", "1"),
    "direction": ("angle of the crests to those across the motion", "degree"),
    "points": ("nodes per side of the grid", "1"),
    "fit_residual": ("rms left by the fit in time over the amplitude, at X = 0", "1"),
    "amplitude": ("|T|, film wave over roughness", "1"),
    "lag": ("phase of T", "degree"),
    "pressure": ("|pressure wave| over roughness", "p_h R/a^2"),
    "pressure_ratio": ("pressure wave over that of the half-space, K (1 - T)", "1"),
    "shipped_amplitude": ("|T| of the response that the prediction uses", "1"),
    "shipped_lag": ("phase of T of the response that the prediction uses", "degree"),
    "shipped_difference": ("|T - T of the response that the prediction uses|", "1"),
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
    found = [driven + free * inlet * slip[:, i] for i, (driven, free) in enumerate(parts)]
    return np.stack(found, axis=-1)


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
    """Give all waves of a measurement, the longest first.

    `tiers` are as :func:`pyehl.measured_response.measurement.measure` returns them; `zone` is the
    smooth contact that the shipped response goes through, `moes` M and L of the circular contact
    with the same inlet. Over wave (m,), and over wave and X
    (m, 3) at the STATIONS; each variable has units.
    """
    parts = [_tier(tier, zone, moes, velocity_ratio) for tier in tiers.values()]
    joined = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    order = np.argsort(-joined["wavelength"], kind="stable")
    names = np.repeat(list(tiers), [tier["along"].size for tier in tiers.values()])
    variables = {"tier": xr.Variable(("wave",), names[order], {"long_name": "run it is from"})}
    for name, (text, unit) in VARIABLES.items():
        values = joined[name][order]
        dims = ("wave", "X")[: values.ndim]
        variables[name] = xr.Variable(dims, values, {"long_name": text, "units": unit})
    place = xr.Variable(("X",), STATIONS, {"long_name": "along the motion, x/a", "units": "1"})
    scalars = {
        "title": "response of a lubricated contact to waves of roughness",
        "moes_m": operating.moes_m,
        "moes_l": operating.moes_l,
        "ellipticity": operating.ellipse.ellipticity,
        "velocity_ratio": velocity_ratio,
    }
    return xr.Dataset(variables, {"X": place}, scalars)


def write_table(data: xr.Dataset, path: Path) -> None:
    """Write a Dataset of waves as CSV, one line a wave, a column for each X."""
    table = data.drop_dims("X").to_dataframe()
    for name in VARIABLES:
        if "X" in data[name].dims:
            table[[f"{name}_{place}" for place in PLACES]] = data[name].values
    with new_file(path) as fresh:
        table.to_csv(fresh, index=False, float_format="%.6g")
