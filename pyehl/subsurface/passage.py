# SPDX-License-Identifier: BSD-3-Clause
"""Stress below the surface under a result, depth by depth, over all instants.

The depths follow from the Fourier spectrum of the pressure: near the surface the stress of short
waves of roughness dominates.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
import scipy.fft
from tqdm import tqdm

from pyehl.prediction.summary import INCREASE_ERROR
from pyehl.subsurface.cycle import Cycle, Fatigue, History, hydrostatic, incomplete, shear_and_mises
from pyehl.subsurface.half_space import HalfSpace, Layer
from pyehl.subsurface.loads import Load, Loads
from pyehl.subsurface.traction import steep_edge
from pyehl.types import Array

if TYPE_CHECKING:
    from collections.abc import Iterable


# Ratio of successive depths; maximum depth over the shorter semi-axis of the contact
RATIO, MAX_DEPTH = 1.3, 3.0
# Relative rms of the pressure in waves too short to be resolved
UNRESOLVED = 0.003
# First depth over 1/k of the shortest wave, where its shear is largest
FIRST = 0.4


def shortest_wavenumber_depth(pressure: Array, mesh: tuple[float, float]) -> float:
    """Return 1/k of the shortest wave that is resolved, in the unit of the mesh sizes.

    The shortest waves are omitted as long as their rms pressure stays below `UNRESOLVED`.
    """
    power = np.square(np.abs(scipy.fft.rfft2(pressure)))
    kx = 2.0 * np.pi * scipy.fft.fftfreq(pressure.shape[0], mesh[0])[:, None]
    ky = 2.0 * np.pi * scipy.fft.rfftfreq(pressure.shape[1], mesh[1])[None, :]
    k = np.hypot(kx, ky).ravel()
    order = np.argsort(k)[::-1]
    left_out = np.cumsum(power.ravel()[order])
    first = int(np.searchsorted(left_out, UNRESOLVED**2 * left_out[-1]))
    return 1.0 / max(float(k[order][first]), float(k[k > 0.0].min()))


def depths(pressure: Array, mesh: tuple[float, float], short_side: float) -> Array:
    """Depths (n,) from the surface down, the first one 0, in the unit of the mesh sizes.

    The shear of a wave k is largest at the depth 1/k. The depths begin above that of the shortest
    resolved wave of the pressure (nx, ny), and increase by `RATIO` up to `MAX_DEPTH` times the
    shorter semi-axis `short_side` of the contact.
    """
    first = FIRST * min(shortest_wavenumber_depth(pressure, mesh), 0.5 * short_side)
    last = MAX_DEPTH * short_side
    number = math.ceil(math.log(last / first) / math.log(RATIO)) + 1
    return np.concatenate([[0.0], np.geomspace(first, last, number)])


# Distance from the centre within which the largest shear is also reported [semi-axes]: further out
# it depends on the edge of the contact and the pressure spike, which the roughness displaces
INNER = 0.6


@dataclass(slots=True)
class Peak:
    """A maximum with its position x, y [a] and time [a/u]."""

    value: float = -math.inf
    x: float = math.nan
    y: float = math.nan
    time: float = math.nan

    def take(self, values: Array, loads: Loads, time: float) -> bool:
        """Update the maximum by values (nx, ny); return whether it increased."""
        i, j = np.unravel_index(int(values.argmax()), values.shape)
        if not values[i, j] > self.value:
            return False
        self.value, self.time = float(values[i, j]), time
        self.x, self.y = float(loads.x[i]), float(loads.y[j])
        return True


@dataclass(slots=True)
class Row:
    """Results at one depth; stresses in p_h."""

    depth: float  # [a]
    shear: Peak = field(default_factory=Peak)
    inner: Peak = field(default_factory=Peak)  # shear within `INNER`
    outer: Peak = field(default_factory=Peak)  # shear outside it
    mises: Peak = field(default_factory=Peak)
    tension: float = -math.inf  # largest hydrostatic stress
    above: float = 0.0  # fraction of the dry contact where the shear exceeds a value
    section: Array | None = None  # principal shear on y = 0 (nx,), largest over time
    cycle: Cycle | None = None  # stress cycles; None if the run covers no complete passage
    fatigue: float = math.nan  # largest equivalent stress of the criterion
    error: float = 0.0  # bound on the error by the periodic cell


def row_of(
    depth: float,
    layer: Layer,
    loads: Loads,
    instants: Iterable[Load],
    above: float | None,
    fatigue: Fatigue | None,
) -> Row:
    """Return the row of a depth over some instants; `above` in p_h."""
    row, middle = Row(depth), int(np.abs(loads.y).argmin())
    exceeded = np.zeros((loads.x.size, loads.y.size), dtype=bool)
    inside, inner = loads.contact(), loads.contact(INNER)
    history = None if incomplete(loads) else History(loads)
    for load in instants:
        stress = layer.under(load.pressure, load.traction)
        shear, mises = shear_and_mises(stress)
        row.mises.take(mises, loads, load.time)
        row.inner.take(np.where(inner, shear, -math.inf), loads, load.time)
        row.outer.take(np.where(inner, -math.inf, shear), loads, load.time)
        if row.shear.take(shear, loads, load.time):
            row.error = layer.error(load.pressure, load.traction)
        on_axis = shear[:, middle]
        row.section = on_axis if row.section is None else np.maximum(row.section, on_axis)
        row.tension = max(row.tension, float(hydrostatic(stress).max()))
        if above is not None:
            exceeded |= shear > above
        if history:
            history.add(stress)
    row.above = float(np.count_nonzero(exceeded & inside) / np.count_nonzero(inside))
    if history:
        points = history.of_points()
        row.cycle = Cycle.of(points)
        if fatigue:
            row.fatigue = fatigue.largest(Cycle.of(points, fatigue.weight))
    return row


@dataclass(frozen=True, slots=True)
class Profile:
    """Rows of the smooth contact, and of the rough one if there is one; stresses in p_h."""

    smooth: list[Row]
    rough: list[Row]
    components: Array  # (6, nx, nz) on y = 0 at the instant of the largest shear

    @property
    def rows(self) -> list[Row]:
        """Rows of the rough contact, or of the smooth one if there is no rough one."""
        return self.rough or self.smooth


def profile(
    loads: Loads,
    *,
    above: float | None,
    fatigue: Fatigue | None,
    at: Array | None = None,
    progress: bool = False,
) -> Profile:
    """Compute the stress at depths `at` [a], None: from the pressure; `above` in p_h.

    The depths of the largest shear are added; depth 0 is omitted if a traction ends in a step.
    """
    is_rough = loads.times.size > 0
    first = next(loads.rough(), loads.smooth)
    half_space = HalfSpace(
        (loads.x.size, loads.y.size), loads.mesh, poisson=loads.poisson, periodic=loads.periodic
    )
    smooth: list[Row] = []
    rough: list[Row] = []

    def add(depth: float) -> None:
        layer = half_space.layer(depth)
        if is_rough:
            rough.append(row_of(depth, layer, loads, loads.rough(), above, fatigue))
        only = dataclasses.replace(loads, times=np.zeros(0))
        smooth.append(
            row_of(depth, layer, only, [loads.smooth], above, None if is_rough else fatigue)
        )

    all_depths = depths(first.pressure, loads.mesh, loads.short_side) if at is None else at
    if all_depths[0] == 0.0 and any(steep_edge(load.traction) for load in (loads.smooth, first)):
        # the stress at the surface increases with the number of nodes
        all_depths = all_depths[1:]
    for depth in tqdm(all_depths, desc="stress", delay=2.0, leave=False, disable=not progress):
        add(float(depth))
    # the rows are far apart: add one at the vertex of each parabola
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
    """Return the largest value of a peak, its depth, and the peak of the nearest row.

    Below the surface it is the vertex of a parabola through three depths, over log depth.
    """
    peaks: list[Peak] = [getattr(row, name) for row in rows]
    k = int(np.argmax([peak.value for peak in peaks]))
    # depth 0 has no logarithm
    if k == 0 or not rows[k - 1].depth > 0.0 or k == len(rows) - 1:
        return peaks[k].value, rows[k].depth, peaks[k]
    z = np.log([row.depth for row in rows[k - 1 : k + 2]])
    curve = np.polyfit(z - z[1], [peak.value for peak in peaks[k - 1 : k + 2]], 2)
    top = -0.5 * curve[1] / curve[0]
    return float(np.polyval(curve, top)), float(np.exp(z[1] + top)), peaks[k]


def in_layer(rows: list[Row], name: str, depth: float) -> float:
    """Return the largest value of a peak down to a depth [a] within the range of the rows."""
    z = np.array([row.depth for row in rows])
    values = np.array([getattr(row, name).value for row in rows])
    return float(np.append(values[z < depth], np.interp(depth, z, values)).max())


def share_above(rows: list[Row], depth: float) -> float:
    """Fraction of the volume under the dry contact, to a depth [a], where `above` is exceeded."""
    z = np.array([row.depth for row in rows])
    fraction = np.array([row.above for row in rows])
    grid = np.union1d(z[z < depth], [depth])
    return float(np.trapezoid(np.interp(grid, z, fraction), grid) / depth)


# Depth of the near-surface layer over that of the largest smooth shear
NEAR = 0.25
CHANGE_INNER, CHANGE_OUTER = INCREASE_ERROR, 1.0
"""Relative error of the predicted change of the near-surface shear by the roughness: within `INNER`
that of the maximum pressure increase; outside 1, because the roughness displaces the edge of the
contact but the linear response does not (docs/evidence/subsurface)."""

Scalar = tuple[str, float, str, str]


def near_surface(
    result: Profile, depth: float | None, above: float | None, *, predicted: bool
) -> list[Scalar]:
    """Return the largest shear in the layer, and the fraction of its volume above a given shear.

    Parameters
    ----------
    result
        Stress over depth [p_h].
    depth
        Depth of the layer [a]; None: `NEAR` times the depth of the largest smooth shear.
    above
        Shear [Pa] to which `Row.above` refers; None: not given.
    predicted
        Whether the rough contact is predicted, so that errors are added.

    Returns
    -------
    list
        Name, value in Hertz units, unit in SI, meaning.
    """
    depth = depth or NEAR * largest(result.smooth)[1]
    scalars: list[Scalar] = [
        ("near_surface_depth", depth, "m", "depth of the near-surface layer"),
    ]
    pairs = [(result.rows, "", ""), (result.smooth, "_smooth", " of the smooth contact")]
    for rows, end, of in pairs if result.rough else pairs[:1]:
        inner, outer = (in_layer(rows, name, depth) for name in ("inner", "outer"))
        meaning = f"largest principal shear in the near-surface layer{of}"
        scalars += [
            (f"near_surface_shear{end}", max(inner, outer), "Pa", meaning),
            (
                f"near_surface_shear_inner{end}",
                inner,
                "Pa",
                f"{meaning}, within {INNER:g} semi-axes of the centre",
            ),
        ]
        if above is not None:
            meaning = f"fraction of the layer where the shear exceeds {above:g} Pa at some time{of}"
            share = share_above(rows, depth)
            scalars.append((f"near_surface_share{end}", share, "1", meaning))
    if result.rough and predicted:
        names = "near_surface_shear_error", "near_surface_shear_inner_error"
        for name, error in zip(names, _errors(result, depth), strict=True):
            scalars.append((name, error, "Pa", "estimate of its error"))
    return scalars


def _errors(result: Profile, depth: float) -> tuple[float, float]:
    """Errors of the largest predicted shear in the layer [p_h]: anywhere, and within `INNER`."""
    reached = {}
    for name, relative in (("inner", CHANGE_INNER), ("outer", CHANGE_OUTER)):
        pairs = zip(result.rough, result.smooth, strict=True)
        peaks = [(r.depth, getattr(r, name).value, getattr(s, name).value) for r, s in pairs]
        rows = [Row(z) for z, *_ in peaks]
        for row, (_, rough, smooth) in zip(rows, peaks, strict=True):
            row.shear.value = rough + relative * abs(rough - smooth)
        reached[name] = in_layer(rows, "shear", depth)
    inner, outer = (in_layer(result.rough, name, depth) for name in ("inner", "outer"))
    error = reached["inner"] - inner
    return max(max(reached.values()) - max(inner, outer), error), error
