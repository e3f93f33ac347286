# SPDX-License-Identifier: BSD-3-Clause
"""Stress below the surface under a result: one depth after the other, over all instants."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from tqdm import tqdm

from pyehl.subsurface.depths import depths
from pyehl.subsurface.fatigue import Fatigue
from pyehl.subsurface.half_space import HalfSpace, Layer
from pyehl.subsurface.loads import Load, Loads
from pyehl.subsurface.measures import hydrostatic, shear_and_mises
from pyehl.types import Array

if TYPE_CHECKING:
    from collections.abc import Iterable

# Lines across the motion whose material points have a history under a passage
LINES = 33


@dataclass(slots=True)
class Peak:
    """A largest value with its place: x, y [a] and time [a/u]."""

    value: float = -math.inf
    x: float = math.nan
    y: float = math.nan
    time: float = math.nan

    def take(self, values: Array, loads: Loads, time: float) -> bool:
        """Take over the largest of values (nx, ny); tell whether it is larger."""
        i, j = np.unravel_index(int(values.argmax()), values.shape)
        if not values[i, j] > self.value:
            return False
        self.value, self.time = float(values[i, j]), time
        self.x, self.y = float(loads.x[i]), float(loads.y[j])
        return True


@dataclass(slots=True)
class Row:
    """What is found at one depth; stresses in p_h."""

    depth: float  # [a]
    shear: Peak = field(default_factory=Peak)
    mises: Peak = field(default_factory=Peak)
    tension: float = -math.inf  # largest hydrostatic stress
    above: float = 0.0  # share of the dry contact where the shear exceeds a value
    section: Array | None = None  # principal shear on y = 0 (nx,), largest over time
    fatigue: float = math.nan  # largest equivalent stress of the criterion
    error: float = 0.0  # of what the periodic cell changes, bound


def row_of(
    depth: float,
    layer: Layer,
    loads: Loads,
    instants: Iterable[Load],
    above: float | None,
    fatigue: Fatigue | None,
) -> Row:
    """Give the row of a depth over some instants; `above` in p_h."""
    row, middle = Row(depth), int(np.abs(loads.y).argmin())
    exceeded = np.zeros((loads.x.size, loads.y.size), dtype=bool)
    history = History(loads) if fatigue else None
    for load in instants:
        stress = layer.under(load.pressure, load.traction)
        shear, mises = shear_and_mises(stress)
        row.mises.take(mises, loads, load.time)
        if row.shear.take(shear, loads, load.time):
            row.error = layer.error(load.pressure, load.traction)
        on_axis = shear[:, middle]
        row.section = on_axis if row.section is None else np.maximum(row.section, on_axis)
        row.tension = max(row.tension, float(hydrostatic(stress).max()))
        if above is not None:
            exceeded |= shear > above
        if history:
            history.add(stress, load.time)
    inside = loads.contact()
    row.above = float(np.count_nonzero(exceeded & inside) / np.count_nonzero(inside))
    if fatigue and history:
        row.fatigue = fatigue.largest(history.of_points())
    return row


class History:
    """Stress of material points over time; they move with the surface of the body.

    Under a smooth contact all points of a line along the motion have one history. Under a passage
    a point at x at the end of the run was at x - U t before; between nodes it is interpolated.
    Points are those of `LINES` lines in the dry contact.
    """

    def __init__(self, loads: Loads) -> None:
        inside = np.flatnonzero(np.abs(loads.y) <= loads.semi_axis_y)
        step = max(1, inside.size // LINES)
        self.lines = inside[::step]
        self.x, self.velocity = loads.x, loads.velocity
        self.end = float(loads.times[-1]) if loads.times.size else math.nan
        self.parts: list[Array] = []

    def add(self, stress: Array, time: float) -> None:
        """Add an instant, stress (6, nx, ny)."""
        lines = stress[:, :, self.lines]
        if math.isnan(time):
            # the path along x is the history
            self.parts = list(np.moveaxis(lines, 1, 0))
            return
        mesh = self.x[1] - self.x[0]
        # a point outside of the domain has the stress at its border
        place = np.arange(self.x.size) - self.velocity * (self.end - time) / mesh
        left = np.clip(np.floor(place), 0, self.x.size - 2).astype(int)
        share = np.clip(place - left, 0.0, 1.0)[np.newaxis, :, np.newaxis]
        moved = lines[:, left] * (1.0 - share) + lines[:, left + 1] * share
        self.parts.append(moved.reshape(6, -1).astype(np.float32))

    def of_points(self) -> Array:
        """Give the history (6, times, points)."""
        return np.stack(self.parts, axis=1).astype(np.float64)


@dataclass(frozen=True, slots=True)
class Profile:
    """Rows of the smooth contact, and of the rough one where there is one; stresses in p_h."""

    smooth: list[Row]
    rough: list[Row]
    components: Array  # (6, nx, nz) on y = 0 at the instant of the largest shear

    @property
    def rows(self) -> list[Row]:
        """Those of the contact that was asked for."""
        return self.rough or self.smooth


def profile(
    loads: Loads, *, above: float | None, fatigue: Fatigue | None, progress: bool = False
) -> Profile:
    """Compute the stress at all depths; `above` [p_h]."""
    is_rough = loads.times.size > 0
    first = next(loads.rough(), loads.smooth)
    half_space = HalfSpace((loads.x.size, loads.y.size), loads.mesh, poisson=loads.poisson)
    smooth: list[Row] = []
    rough: list[Row] = []

    def add(depth: float) -> None:
        layer = half_space.layer(depth)
        of_smooth = None if is_rough else fatigue
        smooth.append(row_of(depth, layer, loads, [loads.smooth], above, of_smooth))
        if is_rough:
            rough.append(row_of(depth, layer, loads, loads.rough(), above, fatigue))

    all_depths = depths(first.pressure, loads.mesh, loads.short_side)
    for depth in tqdm(all_depths, desc="stress", delay=2.0, leave=False, disable=not progress):
        add(float(depth))
    # the rows are far apart: one more where the parabolas have their tops
    known = {row.depth for row in smooth}
    for depth in sorted({largest(rows)[1] for rows in (smooth, rough) if rows} - known):
        add(depth)
    for rows in (smooth, rough):
        rows.sort(key=lambda row: row.depth)
    time = largest(rough or smooth)[2].time
    load = next((load for load in loads.rough() if load.time == time), first)
    middle = int(np.abs(loads.y).argmin())
    planes = [
        half_space.layer(row.depth).under(load.pressure, load.traction)[:, :, middle]
        for row in smooth
    ]
    return Profile(smooth, rough, np.stack(planes, axis=-1))


def largest(rows: list[Row], name: str = "shear") -> tuple[float, float, Peak]:
    """Give the largest value of a peak, its depth, and the peak of the row nearest to it.

    Below the surface by the parabola through three depths, in the logarithm of the depth.
    """
    peaks: list[Peak] = [getattr(row, name) for row in rows]
    k = int(np.argmax([peak.value for peak in peaks]))
    # the surface has no logarithm
    if k < 2 or k == len(rows) - 1:
        return peaks[k].value, rows[k].depth, peaks[k]
    z = np.log([row.depth for row in rows[k - 1 : k + 2]])
    curve = np.polyfit(z - z[1], [peak.value for peak in peaks[k - 1 : k + 2]], 2)
    top = -0.5 * curve[1] / curve[0]
    return float(np.polyval(curve, top)), float(np.exp(z[1] + top)), peaks[k]


def share_above(rows: list[Row], depth: float) -> float:
    """Share of the volume under the dry contact, down to a depth [a], above the value asked for."""
    z = np.array([row.depth for row in rows])
    share = np.array([row.above for row in rows])
    grid = np.union1d(z[z < depth], [depth])
    return float(np.trapezoid(np.interp(grid, z, share), grid) / depth)
