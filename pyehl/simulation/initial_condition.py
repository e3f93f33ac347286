# SPDX-License-Identifier: BSD-3-Clause
"""The initial pressure of a run whose contact is covered by rough surfaces from the start.

It is the pressure of :mod:`pyehl.prediction.response`, of the waves that the grid of the run
resolves, at the nodes of the grid. Units: lengths by a, heights by a^2/R, pressures by p_h.
"""

from __future__ import annotations

import logging
import math
from collections.abc import Mapping, Sequence

import numpy as np
import scipy

from pyehl import surfaces
from pyehl.contact.smooth import SmoothContact, solve_contact
from pyehl.errors import EhlError, InputError, InternalError
from pyehl.handle import SolverHandle, start_fronts, take_start
from pyehl.prediction.friction import mean
from pyehl.prediction.model import Model, ModelOptions, RoughSurface, model_error
from pyehl.prediction.moving_tile import REACH, Component, line_weights, slipped, station_weights
from pyehl.prediction.predict import oblique
from pyehl.prediction.response import Transfer
from pyehl.prediction.spectrum import Spectrum
from pyehl.surfaces import Topography
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.transport import free_stiffness, stiffness
from pyehl.types import Array, Complex, Settings

LOG = logging.getLogger(__name__)

# Points per half of the shortest wave along the motion, between which a cubic spline is used
REFINEMENT = 2
# A grid resolves waves of more than two nodes: margin for rounding errors
BELOW = 1.0 - 1e-9
# The pressure of the waves fades over this width at the edge of the contact [a]. Half this
# width and twice this width change mu_r/mu_s of a wave of 0.5 a in the contact of Table 1 by at
# most 0.06 and 0.24 %, about the error of its final value, and the cycles per step by 3 %
# (129 x 129 nodes)
EDGE_WIDTH = 0.1


def starting_pressure(
    settings: Settings, tiles: Mapping[str, Topography], x: Array, y: Array, fronts: Array
) -> Array:
    """Pressure (nx, ny, n) [p_h] that the roughness of a resolved case adds, Fortran order.

    Parameters
    ----------
    settings
        The resolved case.
    tiles
        Surfaces by group, on their tracks, that replace those of the case.
    x, y
        Nodes of the grid of the run (nx,), (ny,) [a].
    fronts
        Positions along the motion at which the tiles begin (n, surfaces) [a].

    Raises
    ------
    InputError
        If a surface is not usable, or the conditions are outside the range of the prediction.
    EhlError
        If the smooth contact has no solution.
    """
    model = _model(settings, tiles, float(x[1] - x[0]), fronts[0])
    if beyond := model.outside_range():
        raise InputError(f"{', '.join(beyond)} outside the range of the prediction")
    fronts = fronts[:, list(model.order)]
    if model.merged is not None:
        # the tile of their sum is at the position of the first one
        model, fronts = model.merged, fronts[:, :1]
    waves = model.components()
    # this also removes the waves that the grid does not resolve from the spectra
    on_grid = [_GridWaves(wave, model, x, y) for wave in waves]
    if not math.isfinite(model_error(mean(model, waves))):
        raise InputError("the pressures are beyond a linear response")
    return _pressure(on_grid, x, y, fronts)


def _pressure(waves: Sequence[_GridWaves], x: Array, y: Array, fronts: Array) -> Array:
    first = waves[0]
    second = first.second and [
        first.weights @ v for v in first.second.of(*(one.power for one in waves))
    ]
    pressure = np.zeros((x.size, y.size, len(fronts)), order="F")
    for k, places in enumerate(fronts):
        added = np.zeros((first.x.size, first.y.size))
        for one, front in zip(waves, places, strict=True):
            one.add(added, float(front))
        if second:
            gain, variance = second
            added += gain * (np.square(added) - variance)
        pressure[(*first.place, k)] = first.fade * added
    return pressure


def transfer(
    solver: SolverHandle, settings: Settings, tiles: Mapping[str, Topography], *, whole: bool
) -> None:
    """Pass the initial pressure to a solver, or report why there is none.

    Without it the roughness enters the contact behind a front. `whole`: no tile of `tiles`, by
    group, is only a part of its surface.
    """
    try:
        if not whole:
            raise InputError("the map is too large to be predicted as a whole")
        x, y = solver.axes()
        result = starting_pressure(settings, tiles, x, y, start_fronts(solver))
    except InternalError:
        raise
    except (EhlError, OSError, MemoryError) as error:
        why = (str(error) or type(error).__name__).replace("\n", " ")
        LOG.warning("time.start = 'prediction': the roughness enters behind a front: %s", why)
        take_start(solver, None, why)
    else:
        take_start(solver, result)


def _model(
    settings: Settings, tiles: Mapping[str, Topography], mesh: float, fronts: Array
) -> Model:
    """Model of a resolved case with the leakage of a grid, and with tiles at fronts [a]."""
    if oblique(settings):
        raise InputError(oblique(settings))
    if settings["contact"].get("shape") == "line":
        raise InputError("contact.shape = 'line': no pressure is predicted to begin with")
    operating = OperatingPoint.from_settings(settings)
    contact = solve_contact(settings)
    film = contact.central_film * operating.film_scale
    result = []
    for group, front in zip(surfaces.rough_groups(settings), fronts, strict=True):
        keys = settings[group]
        if group in tiles:
            tile = surfaces.finished(tiles[group], {**keys, "track": 0.0})
        else:
            tile = surfaces.from_settings({**settings, "surface": keys}, operating, film)
        result.append(
            RoughSurface(tile, float(keys["velocity_ratio"]), float(front), groups=(group,))
        )
    lubricant = Lubricant.from_settings(settings)
    return Model(tuple(result), contact, operating, lubricant, ModelOptions(), mesh)


class _GridWaves:
    """The waves of a tile on the nodes of a grid that lie in the contact."""

    def __init__(
        self,
        wave: Component,
        model: Model,
        x: Array,
        y: Array,
    ) -> None:
        ratio, across = wave.velocity_ratio, y / model.operating.ellipse.ellipticity
        rows, columns = (np.flatnonzero(np.abs(v) < REACH) for v in (x, across))
        # the nodes are the product of these rows and columns of the grid
        self.place = slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)
        self.x, self.y = x[rows, np.newaxis], y[np.newaxis, columns]
        across = across[np.newaxis, columns]
        spectrum, transfer, edge = wave.spectrum, wave.transfer, wave.edge
        mesh = (x[1] - x[0]) * max(1.0, ratio), y[1] - y[0]
        limits = math.pi / mesh[0] * BELOW, math.pi / mesh[1] * BELOW
        spectrum.values[spectrum.qx >= limits[0]] = 0.0
        spectrum.values[:, np.abs(spectrum.qy) >= limits[1]] = 0.0
        self.power, self.second = spectrum.power, transfer.second
        self.edge = edge.below(min(limits))
        spectrum, transfer = _on_fewer_pixels(spectrum, transfer, limits)
        self.pixel = spectrum.pixel
        self.slipped = self.x + slipped(self.x, across, ratio, bent=transfer.bent)
        self.weights = station_weights(self.x)
        self.off = np.moveaxis(line_weights(across), -1, 0)
        self._make_tiles(spectrum, transfer, model.contact, ratio)
        radius = np.hypot(self.x, across)
        self.polynomials = self.edge.polynomials(*np.broadcast_arrays(self.x, across))
        self.fade = np.clip((REACH - radius) / EDGE_WIDTH, 0.0, 1.0)

    def _make_tiles(
        self, spectrum: Spectrum, transfer: Transfer, contact: SmoothContact, ratio: float
    ) -> None:
        """Splines through the pressure of driven and free waves, by station."""
        qx, qy = spectrum.qx[:, np.newaxis], spectrum.qy[np.newaxis, :]
        gain = transfer.gain(qx, qy, contact.central_film)
        k, k_free = gain * stiffness(spectrum.q), gain * free_stiffness(qx, qy, ratio)

        def spline(factor: Complex) -> Array:
            tile = spectrum.tile(factor, REFINEMENT)
            return np.asarray(scipy.ndimage.spline_filter(tile, order=3, mode="grid-wrap"))

        driven = [k * (1.0 - t) for t in transfer.driven]
        free, off = ([-k_free * t for t in part] for part in (transfer.free, transfer.off_centre))
        if transfer.line_pressure:
            pressures = transfer.free_pressures(qx, qy, ratio)
            free, off = ([-gain * p for p in part] for part in pressures)
        self.driven, self.free, self.free_off = (
            [spline(one) for one in part] for part in (driven, free, off)
        )

    def _at(self, spline: Array, x: Array) -> Array:
        """Values of a tile at positions x on it and at the y of the nodes."""
        places = np.broadcast_arrays(x * (REFINEMENT / self.pixel[0]), self.y / self.pixel[1])
        result = scipy.ndimage.map_coordinates(
            spline, places, order=3, mode="grid-wrap", prefilter=False
        )
        return np.asarray(result)

    def add(self, added: Array, front: float) -> None:
        """Add the pressure of first order at `place` where the tile begins at X = front."""
        for i, tile in enumerate(self.driven):
            added += self.weights[..., i] * self._at(tile, self.x - front)
        for i, tile in enumerate(self.free):
            added += self.weights[..., i] * self._at(tile, self.slipped - front)
        for weight, tile in zip(self.off, self.free_off, strict=False):
            added += weight * self._at(tile, self.slipped - front)
        added += np.tensordot(self.edge.at(front, 0.0)[0], self.polynomials, 1)


def _on_fewer_pixels(
    spectrum: Spectrum, transfer: Transfer, limits: tuple[float, float]
) -> tuple[Spectrum, Transfer]:
    """Return a tile of waves below limits [1/a], with no more pixels than a spline needs."""
    # twice as many pixels as the waves need
    nx, ny = (
        min(n, 4 * (int(limit * pixel * n / (2.0 * math.pi)) + 1))
        for n, pixel, limit in zip(spectrum.shape, spectrum.pixel, limits, strict=True)
    )
    index = spectrum.longest(nx, ny)
    return spectrum.kept(index, (nx, ny)), transfer.kept(index)
