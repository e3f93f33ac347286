# SPDX-License-Identifier: BSD-3-Clause
"""The pressure that a rough surface adds where it fills the contact: a start for time steps.

The waves of :mod:`pyehl.prediction.transfer`, those that the grid of the run carries, on its nodes.
Units: lengths by a, heights by a^2/R, pressures by p_h.
"""

from __future__ import annotations

import logging
import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import scipy
from numpy.typing import NDArray

from pyehl import surfaces
from pyehl.errors import EhlError, InputError
from pyehl.handle import SolverHandle
from pyehl.prediction.by_response import Parts, RoughPassage
from pyehl.prediction.errors import model_error, outside_range
from pyehl.prediction.options import Options
from pyehl.prediction.rough_contact import (
    REACH,
    line_weights,
    slipped,
    station_weights,
)
from pyehl.prediction.smooth import SmoothContact, solve_contact
from pyehl.prediction.spectrum import Spectrum
from pyehl.prediction.transfer import Transfer
from pyehl.surfaces import Topography
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.response import edge_gain
from pyehl.theory.transport import free_stiffness, stiffness

__all__ = ["hand_over", "starting_pressure"]

LOG = logging.getLogger(__name__)

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

# Points per half of the shortest wave along the motion, between which a cubic spline is used
REFINEMENT = 2
# A grid carries waves of more than two nodes: so that rounding does not decide
BELOW = 1.0 - 1e-9
# The pressure of the waves fades over this width at the edge of the contact [a]
EDGE_WIDTH = 0.1


def starting_pressure(
    settings: Mapping[str, Mapping[str, Any]],
    tile: Topography | None,
    x: Array,
    y: Array,
    fronts: Sequence[float],
) -> Array:
    """Pressure (nx, ny, n) [p_h] that the roughness of a resolved case adds, Fortran order.

    Parameters
    ----------
    settings
        The resolved case.
    tile
        Its surface on its track, where it is not made as the case says.
    x, y
        Nodes of the grid of the run (nx,), (ny,) [a].
    fronts
        Positions along the motion at which the tile begins (n,) [a].

    Raises
    ------
    InputError
        If the surface is not usable, or the conditions are outside the range of the prediction.
    EhlError
        If the smooth contact has no solution.
    """
    passage = replace(_passage(settings, tile), mesh=float(x[1] - x[0]))
    beyond = outside_range(
        passage.operating, passage.velocity_ratio, passage.options, passage.contact.thinning
    )
    if beyond:
        raise InputError(f"{', '.join(beyond)} outside the range of the prediction")
    parts = passage.parts()
    # takes the waves that the grid does not carry off the spectrum
    waves = _Waves(passage, parts, x, y)
    if not math.isfinite(model_error(passage.mean(parts))):
        raise InputError("the pressures are beyond a linear response")
    pressure = np.zeros((x.size, y.size, len(fronts)), order="F")
    for k, front in enumerate(fronts):
        pressure[(*waves.place, k)] = waves.pressure(front)
    return pressure


def hand_over(
    solver: SolverHandle,
    settings: Mapping[str, Mapping[str, Any]],
    tile: Topography | None,
    *,
    whole: bool,
) -> None:
    """Give a solver the pressure that it asks for, or say why there is none.

    The solver then lets the roughness in behind a front. `whole`: `tile` is the surface, not a part
    of it.
    """
    try:
        if not whole:
            raise InputError("the map is too large to be predicted as a whole")
        x, y = solver.axes()
        found = starting_pressure(settings, tile, x, y, solver.start_fronts())
    except (EhlError, ValueError, ArithmeticError, OSError, MemoryError) as error:
        why = (str(error) or type(error).__name__).replace("\n", " ")
        LOG.warning("time.start = 'prediction': the roughness enters behind a front: %s", why)
        solver.take_start(None, why)
    else:
        solver.take_start(found)


def _passage(settings: Mapping[str, Mapping[str, Any]], tile: Topography | None) -> RoughPassage:
    operating = OperatingPoint.from_settings(settings)
    if operating.radius_ratio != 1.0:
        raise InputError("the start from the prediction is for circular contacts")
    lubricant = Lubricant.from_settings(settings)
    contact = solve_contact(settings)
    if tile is None:
        film = contact.central_film * operating.film_scale
        tile = surfaces.from_settings(settings, operating, film)
    else:
        tile = surfaces.finished(tile, {**settings["surface"], "track": 0.0})
    ratio = float(settings["surface"]["velocity_ratio"])
    return RoughPassage(tile, contact, operating, lubricant, Options(), ratio)


class _Waves:
    """The waves of a tile on the nodes of a grid that lie in the contact."""

    def __init__(self, passage: RoughPassage, parts: Parts, x: Array, y: Array) -> None:
        rows, columns = (np.flatnonzero(np.abs(v) < REACH) for v in (x, y))
        # the nodes are the product of these rows and columns of the grid
        self.place = slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)
        self.x, self.y = x[rows, np.newaxis], y[np.newaxis, columns]
        ratio = passage.velocity_ratio
        _, spectrum, transfer, edge = parts
        mesh = (x[1] - x[0]) * max(1.0, ratio), y[1] - y[0]
        limits = math.pi / mesh[0] * BELOW, math.pi / mesh[1] * BELOW
        spectrum.values[spectrum.qx >= limits[0]] = 0.0
        spectrum.values[:, np.abs(spectrum.qy) >= limits[1]] = 0.0
        second = transfer.second.of(spectrum.power) if transfer.second else None
        self.edge = edge.below(min(limits))
        spectrum, transfer = _on_fewer_pixels(spectrum, transfer, limits)
        self.pixel = spectrum.pixel
        self.slipped = self.x + slipped(self.x, self.y, ratio, bent=transfer.bent)
        self.weights = station_weights(self.x)
        self.off = np.moveaxis(line_weights(self.y), -1, 0)
        self.second = second and [self.weights @ v for v in second]
        self._make_tiles(spectrum, transfer, passage.contact, ratio)
        radius = np.hypot(self.x, self.y)
        self.polynomials = self.edge.polynomials(*np.broadcast_arrays(self.x, self.y))
        self.fade = np.clip((REACH - radius) / EDGE_WIDTH, 0.0, 1.0)

    def _make_tiles(
        self, spectrum: Spectrum, transfer: Transfer, contact: SmoothContact, ratio: float
    ) -> None:
        """Splines through the pressure of driven and free waves, by station."""
        qx, qy = spectrum.qx[:, np.newaxis], spectrum.qy[np.newaxis, :]
        gain = edge_gain(qx, qy, contact.central_film)
        k, k_free = gain * stiffness(spectrum.q), gain * free_stiffness(qx, qy, ratio)

        def spline(factor: Complex) -> Array:
            tile = spectrum.tile(factor, REFINEMENT)
            return np.asarray(scipy.ndimage.spline_filter(tile, order=3, mode="grid-wrap"))

        self.driven = [spline(k * (1.0 - t)) for t in transfer.driven]
        self.free = [spline(-k_free * t) for t in transfer.free]
        self.free_off = [spline(-k_free * t) for t in transfer.off_centre]

    def _at(self, spline: Array, x: Array) -> Array:
        """Values of a tile at places X on it and at the Y of the nodes."""
        places = np.broadcast_arrays(x * (REFINEMENT / self.pixel[0]), self.y / self.pixel[1])
        found = scipy.ndimage.map_coordinates(
            spline, places, order=3, mode="grid-wrap", prefilter=False
        )
        return np.asarray(found)

    def pressure(self, front: float) -> Array:
        """Pressure that is added at `place` where the tile begins at X = front."""
        added = np.zeros((self.x.size, self.y.size))
        for i, tile in enumerate(self.driven):
            added += self.weights[..., i] * self._at(tile, self.x - front)
        for i, tile in enumerate(self.free):
            added += self.weights[..., i] * self._at(tile, self.slipped - front)
        for weight, tile in zip(self.off, self.free_off, strict=False):
            added += weight * self._at(tile, self.slipped - front)
        added += np.tensordot(self.edge.at(front, 0.0)[0], self.polynomials, 1)
        if self.second:
            gain, variance = self.second
            added += gain * (np.square(added) - variance)
        return np.asarray(self.fade * added)


def _on_fewer_pixels(
    spectrum: Spectrum, transfer: Transfer, limits: tuple[float, float]
) -> tuple[Spectrum, Transfer]:
    """Return a tile without waves of limits [1/a] and more on the pixels that a spline asks for."""
    # two pixels for each that the waves need
    nx, ny = (
        min(n, 4 * (int(limit * pixel * n / (2.0 * math.pi)) + 1))
        for n, pixel, limit in zip(spectrum.shape, spectrum.pixel, limits, strict=True)
    )
    index = spectrum.longest(nx, ny)
    return spectrum.kept(index, (nx, ny)), transfer.kept(index)
