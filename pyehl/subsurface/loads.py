# SPDX-License-Identifier: BSD-3-Clause
"""Pressure and shear traction on a body from a result: one instant, or all instants of a run.

Lengths are scaled by the semi-axis a along the motion, stresses by p_h, times by a/u.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from pyehl.contact.smooth import solve_contact
from pyehl.errors import InputError
from pyehl.prediction.model import Model, ModelOptions, RoughSurface
from pyehl.prediction.moving_tile import Component
from pyehl.prediction.response import film_left
from pyehl.prediction.rough_contact import RoughContact
from pyehl.results import settings_of
from pyehl.subsurface.traction import Traction, friction_of, value_of
from pyehl.surfaces import Topography
from pyehl.theory.line_contact import AnyContact, contact_of
from pyehl.theory.lubricant import Lubricant
from pyehl.types import Array, Mask, Settings

if TYPE_CHECKING:
    import xarray as xr


# Poisson ratio of steel, for cases without the group bodies
DEFAULT_POISSON = 0.3


@dataclass(frozen=True, slots=True)
class Load:
    """Load on the surface of the body at an instant."""

    time: float  # [a/u]; NaN for a smooth contact
    pressure: Array  # (nx, ny) [p_h]
    traction: Array | None  # along x (nx, ny) [p_h]; None without friction


@dataclass(frozen=True, slots=True)
class Loads:
    """The loads of a result, and the body on which they act."""

    x: Array  # (nx,) [a]
    y: Array  # (ny,) [a]
    smooth: Load
    times: Array  # instants (n,) of the rough contact [a/u]; empty for a smooth one
    # (nx, ny) of the rough contact by the number of an instant: pressure [p_h] and film [m]
    pressures: Callable[[int], Array]
    films: Callable[[int], Array]
    traction: Traction
    body: int  # 1 or 2
    velocity: float  # velocity of its surface over the mean velocity
    poisson: float  # its Poisson ratio [-]
    semi_axis_y: float  # [a]; infinite for a line
    operating: AnyContact
    friction_note: str
    pressure_error: float  # relative error of the maximum pressure; NaN where it is not known
    period: float  # period of the rough contact [a/u]; 0 if it is not periodic

    @property
    def mesh(self) -> tuple[float, float]:
        """Mesh sizes [a]."""
        return _steps(self.x, self.y)

    @property
    def periodic(self) -> tuple[bool, bool]:
        """Whether the loads are periodic along x and along y: a line contact is along y."""
        return False, math.isinf(self.semi_axis_y)

    @property
    def short_side(self) -> float:
        """Shorter semi-axis of the dry contact [a]."""
        return min(1.0, self.semi_axis_y)

    def rough(self) -> Iterator[Load]:
        """Yield the loads of the rough contact, one after the other."""
        for k, time in enumerate(self.times):
            pressure = self.pressures(k)
            film = self.films(k) if self.traction.by_film else None
            yield Load(float(time), pressure, self.traction(pressure, film, True))

    def contact(self, fraction: float = 1.0) -> Mask:
        """Nodes (nx, ny) within the dry contact, or within a fraction of its semi-axes."""
        across = self.y / self.semi_axis_y
        return np.hypot(self.x[:, np.newaxis], across[np.newaxis, :]) <= fraction


def _steps(x: Array, y: Array) -> tuple[float, float]:
    """Mesh sizes [a] of axes (nx,), (ny,); a single row has square cells."""
    step = float(x[1] - x[0])
    return step, float(y[1] - y[0]) if y.size > 1 else step


def body_of(settings: Settings, body: int | None) -> tuple[int, float, float]:
    """Return the number of a body, the velocity ratio of its surface, and its Poisson ratio.

    `body` None: the body with the surface of the case. InputError for another number than 1 or 2.
    """
    contact = settings["contact"]
    number = int(contact["rough_surface"]) if body is None else body
    if number not in (1, 2) or isinstance(body, bool):
        raise InputError(f"body = {body!r}: expected 1 or 2")
    slip = 0.5 * float(contact["slide_to_roll"])
    velocity = 1.0 + slip if number == 1 else 1.0 - slip
    group = settings.get("bodies")
    poisson = DEFAULT_POISSON if group is None else float(group[f"poisson_{number}"])
    return number, velocity, poisson


def loads_of(data: xr.Dataset, *, body: int | None, friction: str | float) -> Loads:
    """Return the loads of a solution.

    For a rough contact those of its frames, or, without frames, those at the end of the run.

    Raises
    ------
    InputError
        If the result is not converged or has no fields, or for an invalid body or friction.
    """
    if data.attrs.get("status") != "converged":
        raise InputError(f"stress needs a solution; the status is {data.attrs.get('status')!r}")
    if "P" not in data:
        raise InputError(
            "stress needs the fields of pressure and film: the case has output.fields = .false."
        )
    rough, frames = "P_smooth" in data, "frame_P" in data
    scale = contact_of(settings_of(data)).film_scale
    times = np.zeros(0)
    if rough:
        times = data.T.values if frames else np.array([float(data.attrs.get("T", math.nan))])
    return _assembled(
        data,
        (data.X.values, data.Y.values),
        (
            np.asarray(data["P_smooth" if rough else "P"].values),
            np.asarray(data["H_smooth" if rough else "H"].values) * scale,
        ),
        times,
        lambda k: data.frame_P.values[..., k] if frames else data.P.values,
        lambda k: (data.frame_H.values[..., k] if frames else data.H.values) * scale,
        body=body,
        friction=friction,
    )


def _assembled(
    data: xr.Dataset,
    axes: tuple[Array, Array],
    smooth: tuple[Array, Array],
    times: Array,
    pressures: Callable[[int], Array],
    films: Callable[[int], Array],
    *,
    body: int | None,
    friction: str | float,
    period: float = 0.0,
) -> Loads:
    """Assemble the loads of a result.

    Axes (nx,), (ny,) [a]; pressure [p_h] and film [m] of the smooth contact (nx, ny), and those of
    the rough one at the times [a/u]; `period` is not 0 if it is periodic in time.
    """
    settings = settings_of(data)
    operating = contact_of(settings)
    number, velocity, poisson = body_of(settings, body)
    lubricant = Lubricant.from_settings(settings) if operating.si else None
    result = friction_of(data, operating, lubricant, friction)
    x, y = axes
    area, width = math.prod(_steps(x, y)), _steps(x, y)[1] * y.size
    traction = Traction(smooth, area, width, operating, lubricant, result, number, friction)
    return Loads(
        x=x,
        y=y,
        smooth=Load(math.nan, smooth[0], traction(*smooth, False)),
        times=times,
        pressures=pressures,
        films=films,
        traction=traction,
        body=number,
        velocity=velocity,
        poisson=poisson,
        semi_axis_y=operating.ellipse.ellipticity,
        operating=operating,
        friction_note=result[2],
        pressure_error=value_of(data, "P_max_error") / value_of(data, "P_max"),
        period=period,
    )


# Number of positions along a tile
POSITIONS = 16
# Margin around the dry contact [semi-axes]; points per semi-axis for two surfaces
MARGIN, GRID_POINTS = 0.3, 128.0


def predicted_loads(data: xr.Dataset, *, body: int | None, friction: str | float) -> Loads:
    """Return the loads of a prediction; solves its smooth contact again, in about a second.

    `psd.smooth`, `psd.film_thickness` and the folder of a smooth contact are ignored.

    Raises
    ------
    InputError
        If the status is not 'predicted', for another `psd.reduction` than 'response', for a surface
        at rest, or for an invalid body or friction.
    """
    if data.attrs.get("status") != "predicted":
        raise InputError(f"stress needs a prediction; the status is {data.attrs.get('status')!r}")
    settings = settings_of(data)
    if settings["psd"]["reduction"] != "response":
        raise InputError(
            "stress needs psd.reduction = 'response': the model of the paper has no distribution "
            "of pressure"
        )
    operating = contact_of(settings)
    surfaces = tuple(
        RoughSurface(
            _tile(data, prefix),
            float(settings[f"{prefix}surface"]["velocity_ratio"]),
            float(settings[f"{prefix}surface"]["x_start"]),
        )
        for prefix in ("", "second_")
        if f"{prefix}surface_m" in data
    )
    smooth, oil = solve_contact(settings), Lubricant.from_settings(settings)
    model = Model(surfaces, smooth, operating, oil, ModelOptions())
    # two surfaces of the same velocity act as one
    model = model.merged or model
    waves = model.components()
    contact = _contact(model, waves)
    # a line contact is periodic along y
    x = _with_margin(contact.x)
    y = contact.y if operating.ellipse.is_line else _with_margin(contact.y)
    pressure, film = smooth.at(x, y)
    inner = np.ix_(np.isin(x, contact.x), np.isin(y, contact.y))
    length = max(one.topography.length_x for one in model.surfaces) / operating.hertz_radius
    slowest = min(one.velocity_ratio for one in model.surfaces)
    if not slowest > 0.0:
        raise InputError("stress of a prediction needs surfaces that move")
    period = length / slowest
    step = period / POSITIONS
    if len(model.surfaces) > 1:
        # two surfaces may have no common period: a point is followed through the contact
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
        result = pressure.copy()
        total = contact.pressure + np.where(contact.inside, change(k)[..., 1], 0.0)
        # the film cavitates where it would be in tension: `cavitated_share` of the contact
        result[inner] = np.maximum(total, 0.0)
        return result

    def films(k: int) -> Array:
        result = film.copy()
        smooth_film = contact.smooth_film()
        loss = np.where(contact.inside, change(k)[..., 0], 0.0)
        result[inner] = smooth_film * film_left(loss / smooth_film)
        return result * operating.film_scale

    return _assembled(
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


def _tile(data: xr.Dataset, prefix: str) -> Topography:
    """Return the tile of a surface from the Dataset of a prediction."""
    axes = (data[f"{prefix}{name}_m"].values for name in "xy")
    length, width = (axis.size * float(axis[1] - axis[0]) for axis in axes)
    return Topography(data[f"{prefix}surface_m"].values, size=(length, width))


def _contact(model: Model, waves: list[Component]) -> RoughContact:
    """Return the rough contact at all pixels of a tile, or for two surfaces on a grid."""
    of = model.contact, model.operating, model.lubricant
    if len(waves) > 1:
        return RoughContact.on_grid(*of, waves, GRID_POINTS)
    return RoughContact.on_pixels(*of, model.pixel_tile(waves[0], np.inf))


def _position(model: Model, waves: list[Component], time: float) -> tuple[float, float]:
    """Return the position of the surfaces at a time [a/u]: of two [a], of one in whole pixels."""
    ways = [one.velocity_ratio * time for one in model.in_order]
    if len(waves) > 1:
        return ways[0], ways[1]
    return float(round(ways[0] / waves[0].spectrum.pixel[0])), 0.0


def _with_margin(axis: Array) -> Array:
    """Extend an axis on both sides by `MARGIN`, with the same spacing."""
    step = float(axis[1] - axis[0])
    more = int(np.ceil(MARGIN * float(axis[-1]) / step))
    before = axis[0] - step * np.arange(more, 0, -1)
    after = axis[-1] + step * np.arange(1, more + 1)
    return np.concatenate([before, axis, after])
