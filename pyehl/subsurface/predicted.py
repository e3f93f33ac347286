# SPDX-License-Identifier: BSD-3-Clause
"""The loads of a predicted rough contact: smooth pressure, and what the roughness adds to it.

The pressure of the roughness is that of the prediction at the centre, where the tile passes; it
acts inside the dry contact.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.interpolate import RectBivariateSpline
from scipy.signal import resample

from pyehl.api import solve
from pyehl.case import Case
from pyehl.errors import InputError
from pyehl.results import settings_of
from pyehl.subsurface.loads import Load, Loads, loads_of
from pyehl.types import Array

if TYPE_CHECKING:
    import xarray as xr

# Positions of a tile over its length
POSITIONS = 16
# Margin around the dry contact [a], and nodes per semi-axis at the most
MARGIN, MOST_NODES = 0.25, 256


def predicted_loads(data: xr.Dataset, *, body: int | None, friction: str | float) -> Loads:
    """Give the loads of a prediction: the smooth contact is solved, a second or so.

    Of two rough surfaces the pressure of both, each at its own position.

    Raises
    ------
    InputError
        If nothing is predicted, or for a body or friction that cannot be.
    """
    if data.attrs.get("status") != "predicted":
        raise InputError(f"stress needs a prediction; the status is {data.attrs.get('status')!r}")
    solved = solve(Case.from_text(data.attrs["case"]).smooth())
    loads = loads_of(solved, body=body, friction=friction)
    tiles = [_Tile(data, side, loads) for side in ("", "second_") if f"{side}delta_p_Pa" in data]
    mesh = [min(tile.mesh[k] for tile in tiles) for k in (0, 1)]
    x, y = (_axis(half, step) for half, step in zip((1.0, loads.semi_axis_y), mesh, strict=True))
    pressure = _at(loads, loads.smooth.pressure, x, y)
    film = _at(loads, solved.H.values, x, y) * loads.operating.film_scale
    smooth = Load(loads.smooth.time, pressure, loads.traction(pressure, film, False))
    found = replace(loads, x=x, y=y, smooth=smooth)
    inside = found.contact()
    # a tile moves by its length in the time over all positions
    times = np.arange(POSITIONS, dtype=np.float64) * (
        tiles[0].length / tiles[0].velocity / POSITIONS
    )

    def pressures(k: int) -> Array:
        added = sum(tile.at(x, y, times[k]) for tile in tiles)
        # a lubricant bears no tension
        return np.maximum(pressure + np.where(inside, added, 0.0), 0.0)

    def films(k: int) -> Array:
        lost = sum(tile.at(x, y, times[k], film=True) for tile in tiles)
        return film - np.where(inside, lost, 0.0)

    return replace(found, times=times, pressures=pressures, films=films)


class _Tile:
    """What a rough surface adds to the pressure [p_h] and takes of the film [m]: periodic."""

    def __init__(self, data: xr.Dataset, side: str, loads: Loads) -> None:
        a, p_h = loads.operating.hertz_radius, loads.operating.hertz_pressure
        axes = [data[f"{side}{name}_m"].values / a for name in "xy"]
        self.length, self.width = (axis.size * float(axis[1] - axis[0]) for axis in axes)
        most = [
            int(MOST_NODES * length / half)
            for length, half in ((self.length, 1.0), (self.width, loads.semi_axis_y))
        ]
        self.pressure = _coarser(data[f"{side}delta_p_Pa"].values / p_h, most)
        self.deformed = _coarser(data[f"{side}deformed_m"].values, most)
        nx, ny = self.pressure.shape
        self.mesh = self.length / nx, self.width / ny
        slip = 0.5 * loads.operating.slide_to_roll
        settings = settings_of(data)
        body = int(settings["contact"]["rough_surface"])
        if side:
            body = 3 - body
        self.velocity = 1.0 + slip if body == 1 else 1.0 - slip

    def at(self, x: Array, y: Array, time: float, *, film: bool = False) -> Array:
        """Values at nodes (nx, ny), moved along x by the time, by the nearest pixel."""
        values = self.deformed if film else self.pressure
        i = np.rint((x - self.velocity * time) / self.mesh[0]).astype(int) % values.shape[0]
        j = np.rint(y / self.mesh[1]).astype(int) % values.shape[1]
        return np.asarray(values[np.ix_(i, j)])


def _coarser(values: Array, most: list[int]) -> Array:
    """Return a periodic map on so many pixels at the most, by its Fourier components."""
    for axis, pixels in enumerate(most):
        if values.shape[axis] > pixels:
            values = np.asarray(resample(values, pixels, axis=axis))
    return values


def _axis(half: float, mesh: float) -> Array:
    """Nodes over the contact and its margins, one of them at 0."""
    n = int(np.ceil((half + MARGIN) / mesh))
    return mesh * np.arange(-n, n + 1, dtype=np.float64)


def _at(loads: Loads, values: Array, x: Array, y: Array) -> Array:
    """Interpolate a field of the smooth contact to other nodes."""
    return np.asarray(RectBivariateSpline(loads.x, loads.y, values, kx=1, ky=1)(x, y))
