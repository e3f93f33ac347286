# SPDX-License-Identifier: BSD-3-Clause
"""The loads of a predicted rough contact: pressure and film of its model at some positions."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from pyehl.errors import InputError
from pyehl.prediction.model import Model, ModelOptions, RoughSurface
from pyehl.prediction.moving_tile import Component
from pyehl.prediction.response import film_left
from pyehl.prediction.rough_contact import RoughContact
from pyehl.prediction.smooth import solve_contact
from pyehl.results import settings_of
from pyehl.subsurface.loads import Loads, made_of
from pyehl.surfaces import Topography
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Array

if TYPE_CHECKING:
    import xarray as xr

# Positions over the length of a tile
POSITIONS = 16
# Margin around the dry contact [semi-axes]; points per semi-axis under two surfaces
MARGIN, GRID_POINTS = 0.3, 128.0


def predicted_loads(data: xr.Dataset, *, body: int | None, friction: str | float) -> Loads:
    """Give the loads of a prediction: its smooth contact is solved again, a second or so.

    Raises
    ------
    InputError
        If nothing is predicted, by the model of the paper, or for a body or friction that cannot
        be.
    """
    if data.attrs.get("status") != "predicted":
        raise InputError(f"stress needs a prediction; the status is {data.attrs.get('status')!r}")
    settings = settings_of(data)
    if settings["psd"]["reduction"] != "response":
        raise InputError(
            "stress needs psd.reduction = 'response': the model of the paper has no pressure at "
            "places of the contact"
        )
    operating = OperatingPoint.from_settings(settings)
    surfaces = tuple(
        RoughSurface(
            _tile(data, side),
            float(settings[f"{side}surface"]["velocity_ratio"]),
            float(settings[f"{side}surface"]["x_start"]),
        )
        for side in ("", "second_")
        if f"{side}surface_m" in data
    )
    smooth, oil = solve_contact(settings), Lubricant.from_settings(settings)
    model = Model(surfaces, smooth, operating, oil, ModelOptions())
    # two surfaces that move together are one
    model = model.merged or model
    waves = model.components()
    contact = _contact(model, waves)
    x, y = _with_margin(contact.x), _with_margin(contact.y)
    pressure, film = smooth.at(x, y)
    inner = np.ix_(np.isin(x, contact.x), np.isin(y, contact.y))
    length = max(one.topography.length_x for one in model.surfaces) / operating.hertz_radius
    slowest = min(one.velocity_ratio for one in model.surfaces)
    if not slowest > 0.0:
        raise InputError("stress of a prediction needs surfaces that move")
    period = length / slowest
    step = period / POSITIONS
    if len(model.surfaces) > 1:
        # two surfaces do not repeat themselves: a point is followed through the contact
        period = 0.0
        times = np.arange(0.0, (x[-1] - x[0]) / slowest, step)
    else:
        times = np.arange(POSITIONS) * step
    changes: dict[int, Array] = {}

    def change(k: int) -> Array:
        if k not in changes:
            changes.clear()
            changes[k] = np.asarray(contact.change(_position(model, waves, float(times[k]))))
        return changes[k]

    def pressures(k: int) -> Array:
        found = pressure.copy()
        gained = contact.pressure + np.where(contact.inside, change(k)[..., 1], 0.0)
        # cavitation: `cavitated_share` of the prediction says on how much of the contact
        found[inner] = np.maximum(gained, 0.0)
        return found

    def films(k: int) -> Array:
        found = film.copy()
        smooth_film = contact.smooth_film()
        loss = np.where(contact.inside, change(k)[..., 0], 0.0)
        found[inner] = smooth_film * film_left(loss / smooth_film)
        return found * operating.film_scale

    return made_of(
        data,
        (x, y),
        (pressure, film * operating.film_scale),
        times,
        pressures,
        films,
        body=body,
        friction=friction,
        period=period,
    )


def _tile(data: xr.Dataset, side: str) -> Topography:
    """Give the tile of a surface that a prediction holds."""
    axes = (data[f"{side}{name}_m"].values for name in "xy")
    length, width = (axis.size * float(axis[1] - axis[0]) for axis in axes)
    return Topography(data[f"{side}surface_m"].values, size=(length, width))


def _contact(model: Model, waves: list[Component]) -> RoughContact:
    """Give the contact with as many points as resolve the waves: all pixels of a tile."""
    of = model.contact, model.operating, model.lubricant
    if len(waves) > 1:
        return RoughContact.on_grid(*of, waves, GRID_POINTS)
    return RoughContact.on_pixels(*of, model.pixel_tile(waves[0], np.inf))


def _position(model: Model, waves: list[Component], time: float) -> tuple[float, float]:
    """Give the position of the surfaces at a time [a/u]."""
    ways = [one.velocity_ratio * time for one in model.in_order]
    if len(waves) > 1:
        return ways[0], ways[1]
    return float(round(ways[0] / waves[0].spectrum.pixel[0])), 0.0


def _with_margin(axis: Array) -> Array:
    """Give the points with others around them, at the same distance."""
    step = float(axis[1] - axis[0])
    more = int(np.ceil(MARGIN * float(axis[-1]) / step))
    before = axis[0] - step * np.arange(more, 0, -1)
    behind = axis[-1] + step * np.arange(1, more + 1)
    return np.concatenate([before, axis, behind])
