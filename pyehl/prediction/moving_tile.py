# SPDX-License-Identifier: BSD-3-Clause
"""The waves of a moving tile on the points of a contact.

Lengths along the surface are scaled by a, films by a^2/R, pressures by p_h.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import NDArray

from pyehl import extension
from pyehl.prediction.edge import Edge
from pyehl.prediction.response import AXIS, LINES, STATIONS, Transfer
from pyehl.prediction.spectrum import Spectrum
from pyehl.prediction.waves import REFINEMENT, WaveTiles
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Array, Complex, Single

if TYPE_CHECKING:
    from pyehl.prediction.rough_contact import RoughContact

Position = tuple[float, float]
"""Of one tile: the pixels by which it has moved along and across the motion; of two: the ways by
which both have moved along it [a]."""

REACH = 1.0
"""Friction is taken within this distance from the centre [semi-axes]: in the dry contact, outside
of which the viscosity is hardly raised. 0.95 and 1.05 change mu_r/mu_s of Table 1 by 0.02 %."""


@dataclass(frozen=True)
class Component:
    """The waves of one surface: its spectrum, and what the contact makes of it."""

    spectrum: Spectrum
    transfer: Transfer
    edge: Edge
    velocity_ratio: float  # of the surface [-]

    def at_centre(self) -> Complex:
        """T at X = Y = 0."""
        return self.transfer.at_centre(self.spectrum, self.velocity_ratio)

    def pressure_at_centre(self) -> Complex:
        """Pressure over roughness at X = Y = 0 [p_h R/a^2]."""
        return self.transfer.pressure_at_centre(self.spectrum, self.velocity_ratio)


def station_weights(x: Array) -> Array:
    """Weights (..., n) of the stations in the waves at places X [a]."""
    return np.stack([np.interp(x, STATIONS, unit) for unit in np.eye(STATIONS.size)], axis=-1)


def line_weights(y: Array) -> Array:
    """Weights (n, lines) of LINES but the centre line in the free wave at places Y [semi-axis]."""
    lines = np.delete(np.eye(LINES.size), AXIS, 0)
    return np.stack([np.interp(y, LINES, unit) for unit in lines], axis=-1)


def two_lines(y: Array) -> tuple[NDArray[np.int32], Single]:
    """`line_weights` at places Y (n,): the first of two lines after each other, weights (2, n)."""
    weights = line_weights(y)
    first = np.minimum(np.argmax(weights > 0.0, axis=1), weights.shape[1] - 2)
    both = np.stack([np.take_along_axis(weights, (first + k)[:, np.newaxis], 1) for k in (0, 1)])
    return first.astype(np.int32), both[..., 0].astype(np.float32)


def slipped(x: Array, y: Array, velocity_ratio: float, *, bent: bool) -> Array:
    """Way of the roughness past the free wave since the inlet made that [a].

    At places X [a] and Y [semi-axis].
    """
    inlet = np.sqrt(np.maximum(0.0, 1.0 - y * y)) if bent else np.ones_like(y)
    return (velocity_ratio - 1.0) * (x + inlet)


class Tile(Protocol):
    """A moving tile on the points of a contact."""

    def add(self, contact: RoughContact, position: Position, total: Single) -> None:
        """Add loss of film and gain of pressure (m, n, 2) in a position."""
        ...

    def at_edge(self, position: Position) -> tuple[Array, Array]:
        """Give what the edge does in a position, see :meth:`Edge.at`."""
        ...


class PixelTile:
    """A tile whose pixels, every `stride`-th, are the points of the contact."""

    def __init__(
        self, wave: Component, central_film: float, stride: int, operating: OperatingPoint
    ) -> None:
        self.wave, self.stride, self.pixel = wave, stride, wave.spectrum.pixel
        ratio, transfer = wave.velocity_ratio, wave.transfer
        self.waves = WaveTiles.of(wave.spectrum, transfer, central_film, ratio, stride)
        reach = REACH, REACH * operating.ellipse.ellipticity
        half = [int(r / (stride * p)) for r, p in zip(reach, self.pixel, strict=True)]
        self.rows, self.columns = (np.arange(-n, n + 1, dtype=np.int32) * stride for n in half)
        self.x, self.y = (
            np.asarray(index * p, dtype=float)
            for index, p in zip((self.rows, self.columns), self.pixel, strict=True)
        )
        self.across = self.y / operating.ellipse.ellipticity
        # the free wave is that of the roughness where it was when the inlet made it; without a bend
        # it is so on all lines
        lines = self.across if transfer.bent else np.zeros(1)
        way = slipped(self.x[:, np.newaxis], lines, ratio, bent=transfer.bent)
        place = (self.x[:, np.newaxis] + way) / self.pixel[0] * REFINEMENT
        self.free_rows = np.floor(place).astype(np.int32)
        self.between = (place - self.free_rows).astype(np.float32)
        # free waves beside the centre line on the track that was met last
        self.beside: dict[int, Single | None] = {}

    def add(self, contact: RoughContact, position: Position, total: Single) -> None:
        """Add loss of film and gain of pressure; the track is a multiple of the stride."""
        shift, track = (int(pixels) for pixels in position)
        waves = self.waves
        columns = (self.columns - track) // self.stride % waves.driven.shape[2]
        columns = columns.astype(np.int32)
        if track not in self.beside:
            self.beside = {track: waves.beside(columns, *two_lines(self.across))}
        extension.surface_functions.driven_waves(
            waves.driven.T, self.rows, columns, contact.weights.T, shift, total.T
        )
        places = self.free_rows, self.between
        contact.add_free(waves, self.beside[track], places, columns, shift * REFINEMENT, total)

    def at_edge(self, position: Position) -> tuple[Array, Array]:
        """Give what the edge does in a position."""
        return self.wave.edge.at(position[0] * self.pixel[0], position[1] * self.pixel[1])


class LineTile:
    """A tile on lines of the contact: the one of two with a `number`, on its own track [a]."""

    def __init__(
        self,
        wave: Component,
        central_film: float,
        points: tuple[Array, Array, Array],
        track: float,
        number: int,
    ) -> None:
        x, y, across = points
        self.edge, self.track, self.number = wave.edge, track, number
        ratio, bent = wave.velocity_ratio, wave.transfer.bent
        self.waves = WaveTiles.of(
            wave.spectrum, wave.transfer, central_film, ratio, lines=y - track
        )
        self.columns = np.arange(y.size, dtype=np.int32)
        self.beside = self.waves.beside(self.columns, *two_lines(across))
        self.scale = REFINEMENT / wave.spectrum.pixel[0]
        self.places = x[:, np.newaxis]
        lines = across if bent else np.zeros(1)
        self.free_places = self.places + slipped(self.places, lines, ratio, bent=bent)

    def _rows(self, places: Array) -> tuple[NDArray[np.int32], Single]:
        """Row of the waves before places [a], and the share of the next one."""
        at = places * self.scale
        low = np.floor(at)
        return low.astype(np.int32), (at - low).astype(np.float32)

    def add(self, contact: RoughContact, position: Position, total: Single) -> None:
        """Add loss of film and gain of pressure."""
        shift = position[self.number]
        (rows, between), free = (self._rows(p - shift) for p in (self.places, self.free_places))
        extension.surface_functions.waves_between(
            self.waves.driven.T, rows[:, 0], self.columns, between[:, 0], contact.weights.T, total.T
        )
        contact.add_free(self.waves, self.beside, free, self.columns, 0, total)

    def at_edge(self, position: Position) -> tuple[Array, Array]:
        """Give what the edge does in a position."""
        return self.edge.at(position[self.number], self.track)
