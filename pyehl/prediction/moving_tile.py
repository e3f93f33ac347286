# SPDX-License-Identifier: BSD-3-Clause
"""Film and pressure waves of a moving rough tile on the points of a contact, by linear response.

The tile is decomposed into plane waves. Each causes a driven wave, which moves with the roughness,
and a free wave, which arises in the inlet and is convected at the mean velocity
(:mod:`pyehl.theory.response`). Both change slowly along the motion, so that they are computed at a
few stations and interpolated; the free wave also on a few lines off the centre line. Waves longer
than half the contact radius depend on the edge of the contact (:mod:`pyehl.theory.disc`), and they
displace it: the contact is wider where their pressure is positive and narrower where it is
negative. Lengths along the surface are scaled by a, films by a^2/R, pressures by p_h.
"""

from __future__ import annotations

import copy
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from pyehl import extension
from pyehl.prediction.response import AXIS, LINES, STATIONS, Transfer
from pyehl.prediction.spectrum import Spectrum
from pyehl.theory.disc import (
    EDGE_ANGLES,
    MAX_WAVENUMBER,
    RADIUS,
    disc_correction,
    edge_of_disc,
    monomials,
)
from pyehl.theory.ellipse import Ellipse
from pyehl.theory.ellipse_edge import ellipse_edge
from pyehl.theory.line_contact import AnyContact
from pyehl.theory.strip_edge import StripEdge
from pyehl.theory.transport import free_stiffness, harmonics, stiffness
from pyehl.types import Array, Complex, Indices, Single

if TYPE_CHECKING:
    from pyehl.prediction.rough_contact import RoughContact


# The polynomials of the edge of a circle are held constant beyond this radius; 0.8 and 0.9 change
# mu_r/mu_s of Table 1 by 1e-6
EDGE_RADIUS = 0.85


def long_waves(spectrum: Spectrum, largest: float) -> tuple[Indices, Indices]:
    """Rows and columns of the nonzero components with |q| below a largest one [1/a]."""
    strong = np.abs(spectrum.values) > 1e-9 * np.abs(spectrum.values).max()
    i, j = np.nonzero((spectrum.q > 0.0) & (spectrum.q < largest) & strong)
    return i, j


def _largest(shape: Ellipse | StripEdge) -> float:
    """Largest wavenumber on which the edge has an effect [1/a]."""
    if isinstance(shape, StripEdge):
        return shape.largest
    return MAX_WAVENUMBER if shape.radius_ratio == 1.0 else ellipse_edge(shape).largest


def _effect(shape: Ellipse | StripEdge, qx: Array, qy: Array) -> tuple[Complex, Complex]:
    """Coefficients and displacement of an :class:`Edge` for waves of unit amplitude."""
    if isinstance(shape, StripEdge):
        return shape.correction(qx, qy), shape.displacement(qx, qy)
    if shape.radius_ratio == 1.0:
        return disc_correction(qx, qy), edge_of_disc(qx, qy)
    return ellipse_edge(shape).both(qx, qy)


class Edge:
    """Effect of the edge of the contact on the pressure of the long waves of a tile.

    `coefficients` (n, m) of the polynomials [p_h] for the waves of the tile with wavenumbers
    qx >= 0, qy (m,) [1/a]: of :func:`pyehl.theory.disc.monomials` (n = 28) in a circle, of
    :mod:`pyehl.theory.ellipse_edge` in an ellipse, of :mod:`pyehl.theory.strip_edge` in a line
    contact. `displacement` (k, m): that of the edge, outwards [semi-axes], at EDGE_ANGLES, for a
    line at the places of :meth:`pyehl.theory.strip_edge.StripEdge.displacement`.
    """

    def __init__(
        self,
        qx: Array,
        qy: Array,
        coefficients: Complex,
        displacement: Complex,
        shape: Ellipse | StripEdge,
    ) -> None:
        self.qx, self.qy, self.coefficients, self.displacement = qx, qy, coefficients, displacement
        self.shape = shape

    @classmethod
    def of_all(
        cls, waves: Sequence[tuple[Spectrum, Transfer, float]], shape: Ellipse | StripEdge
    ) -> list[Edge]:
        """Compute the effect for moving tiles, from their deformed components.

        `waves`: of each tile its spectrum, transfer and velocity ratio.
        """
        largest = _largest(shape)
        tiles = [(*one, *long_waves(one[0], largest)) for one in waves]
        groups: dict[tuple[bytes, bytes], list[int]] = {}
        for number, (spectrum, _, _, i, j) in enumerate(tiles):
            alike = spectrum.qx[i].tobytes(), spectrum.qy[j].tobytes()
            groups.setdefault(alike, []).append(number)
        result = {
            number: edge
            for group in groups.values()
            for number, edge in zip(
                group, cls._alike([tiles[number] for number in group], shape), strict=True
            )
        }
        return [result[number] for number in range(len(tiles))]

    @classmethod
    def _alike(
        cls,
        tiles: Sequence[tuple[Spectrum, Transfer, float, Indices, Indices]],
        shape: Ellipse | StripEdge,
    ) -> list[Edge]:
        """Give the edges of tiles whose long waves have the same wavenumbers.

        `tiles`: as `waves` of `of_all`, with the rows and columns of the long waves.
        """
        spectrum, _, _, i, j = tiles[0]
        qx, qy = spectrum.qx[i], spectrum.qy[j]
        if not (i.size or isinstance(shape, StripEdge)):
            nothing = np.zeros((0, 0), complex), np.zeros((EDGE_ANGLES.size, 0), complex)
            return [cls(qx, qy, *nothing, shape) for _ in tiles]
        result, parts = [], []
        correction, displacement = _effect(shape, qx, qy)
        for spectrum, transfer, velocity_ratio, i, j in tiles:
            flattened = 1.0 - transfer.at_centre(spectrum, velocity_ratio)
            amplitude = spectrum.amplitudes(i, j, flattened[i, j])
            effect = correction * amplitude, displacement * amplitude
            result.append(cls(qx, qy, *effect, shape))
            # change on the lines off the centre line of an ellipse (lines, ...)
            beside = transfer.beside(spectrum.qx, velocity_ratio)
            if beside is not None:
                parts.append(-spectrum.amplitudes(i, j) * beside[:, i, j])
        if parts and isinstance(shape, Ellipse):
            # a wave whose amplitude changes across the motion is a sum of waves
            wavenumbers = harmonics(parts[0])[0]
            for k, *of_each in zip(wavenumbers, *(harmonics(one)[1] for one in parts), strict=True):
                there = qy + k / shape.ellipticity
                q = np.hypot(qx, there)
                affected = (q > 1e-9) & (q < _largest(shape))
                if affected.any():
                    correction, displacement = _effect(shape, qx[affected], there[affected])
                    for edge, part in zip(result, of_each, strict=True):
                        edge.coefficients[:, affected] += correction * part[affected]
                        edge.displacement[:, affected] += displacement * part[affected]
        return result

    def below(self, limit: float) -> Edge:
        """Return the part of the waves with |q| below a limit [1/a]."""
        keep = np.hypot(self.qx, self.qy) < limit
        parts = self.coefficients[:, keep], self.displacement[:, keep]
        return Edge(self.qx[keep], self.qy[keep], *parts, self.shape)

    def at(self, shift: float, track: float) -> tuple[Array, Array]:
        """Coefficients (n,) and outward displacement of the edge (k,), as in the attributes.

        For a tile moved along and across the motion [a].
        """
        phase = np.exp(-1j * (self.qx * shift + self.qy * track))
        return (self.coefficients @ phase).real, (self.displacement @ phase).real

    def polynomials(self, x: Array, y: Array) -> Array:
        """Polynomials (n, ...) at x/a and y/b, held constant near the edge."""
        assert not isinstance(self.shape, StripEdge)
        ellipse = None if self.shape.radius_ratio == 1.0 else ellipse_edge(self.shape)
        held = np.minimum(
            1.0, (RADIUS if ellipse else EDGE_RADIUS) / np.maximum(np.hypot(x, y), 1e-12)
        )
        if not self.coefficients.size:
            return np.zeros((self.coefficients.shape[0], *held.shape))
        if ellipse:
            return ellipse.functions(held * x, held * y)
        return monomials(held * x, held * y, axis=0)


Narrow = NDArray[np.complexfloating[Any, Any]]

REFINEMENT = 4
"""Points per pixel along the motion at which the free wave is tabulated."""


@dataclass(frozen=True, slots=True)
class WaveFactors:
    """Loss of film and pressure increase over the roughness, for every component of a tile."""

    driven: list[tuple[Narrow, Narrow]]  # per station
    free: list[tuple[Narrow, Narrow]]  # the same, [] without free waves
    # Difference of the free waves on each line from those on the centre line; [] without free waves
    off_centre: list[tuple[Narrow, Narrow]]

    @classmethod
    def of(
        cls,
        spectrum: Spectrum,
        transfer: Transfer,
        central_film: float,
        velocity_ratio: float,
        *,
        on_lines: bool = False,
    ) -> WaveFactors:
        """Compute the factors in a contact with a film H_c [a^2/R].

        `on_lines`: for tiles on given lines.
        """
        qx, qy = spectrum.qx[:, np.newaxis], spectrum.qy[np.newaxis, :]
        gain = transfer.gain(qx, qy, central_film)
        k = (stiffness(spectrum.q) * gain).astype(np.float32)
        k_free = (free_stiffness(qx, qy, velocity_ratio) * gain).astype(np.float32)
        # correction of the mean loss of amplitude by linear interpolation between the points
        step = spectrum.qx * (np.pi / REFINEMENT / spectrum.qx[-1])
        bright = (1.0 / (1.0 - np.square(step) / 12.0)).astype(np.float32)[:, np.newaxis]

        def lit(waves: list[Complex]) -> list[Narrow]:
            return [t.astype(np.complex64) * bright for t in waves]

        def free(waves: list[Complex], pressures: list[Complex]) -> list[tuple[Narrow, Narrow]]:
            if not pressures:
                return [(t, -k_free * t) for t in lit(waves)]
            given = [-one for one in lit([gain * p for p in pressures])]
            return list(zip(lit(waves), given, strict=True))

        on_stations: list[Complex] = []
        beside: list[Complex] = []
        if transfer.line_pressure:
            on_stations, beside = transfer.free_pressures(qx, qy, velocity_ratio)
        driven = [(t, k * (1 - t)) for t in (t.astype(np.complex64) for t in transfer.driven)]
        if on_lines:
            driven = [(t * bright, pressure * bright) for t, pressure in driven]
        return cls(driven, free(transfer.free, on_stations), free(transfer.off_centre, beside))


@dataclass(frozen=True, slots=True)
class WaveTiles:
    """Loss of film and pressure increase by driven and free waves as tiles, single precision.

    With given lines in place of the columns of the tile, the driven waves are refined as the free
    ones.
    """

    driven: Single  # over station (n, nx, ny/stride, 2): film, pressure
    free: Single | None  # the same (n, REFINEMENT nx, ny/stride, 2); None without free waves
    # Difference of the free waves on each line from those on the centre line, as waves along the
    # motion (n, 2, ny/stride, nx//2 + 1); None without free waves
    off_centre: Narrow | None
    stride: int  # of the columns of the tile

    @classmethod
    def of(
        cls,
        spectrum: Spectrum,
        factors: WaveFactors,
        stride: int = 1,
        lines: Array | None = None,
    ) -> WaveTiles:
        """Make the tiles of all waves, on the columns of the tile or on lines Y (n,) [a]."""
        narrow = spectrum.single()
        across = None if lines is None else narrow.on_lines(lines)

        def tiles(waves: list[tuple[Narrow, Narrow]], refinement: int) -> Single:
            columns = spectrum.shape[1] // stride if lines is None else lines.size
            rows = spectrum.shape[0] * refinement
            result = np.empty((len(waves), rows, columns, 2), dtype=np.float32)
            both = np.empty((columns, 2, rows), dtype=np.float32)
            for tile, pair in zip(result, waves, strict=True):
                for i, factor in enumerate(pair):
                    along = narrow.along(factor, refinement, stride, across)
                    np.fft.irfft(along, n=rows, out=both[:, i])  # type: ignore[arg-type]
                extension.surface_functions.wave_tile(both.T, tile.T)
            return result

        def off_centre() -> Narrow:
            return np.array(
                [
                    [narrow.along(factor, REFINEMENT, stride, across) for factor in pair]
                    for pair in factors.off_centre
                ]
            )

        return cls(
            tiles(factors.driven, 1 if lines is None else REFINEMENT),
            tiles(factors.free, REFINEMENT) if factors.free else None,
            off_centre() if factors.off_centre else None,
            stride,
        )

    def beside(
        self, columns: NDArray[np.int32], line: NDArray[np.int32], part: Single
    ) -> Single | None:
        """Additional free waves on columns off the centre line (REFINEMENT nx, n, 2).

        `part` (2, n) are the weights of the lines `line` and of the next ones. None without free
        waves.
        """
        if self.free is None:
            return None
        if self.off_centre is None:
            return np.zeros((self.free.shape[1], columns.size, 2), dtype=np.float32)
        weights = part[..., np.newaxis, np.newaxis]
        waves = weights[0] * self.off_centre[line, :, columns]
        waves += weights[1] * self.off_centre[line + 1, :, columns]
        rows = np.asarray(np.fft.irfft(waves, n=self.free.shape[1]), dtype=np.float32)
        result = np.empty((rows.shape[2], columns.size, 2), dtype=np.float32)
        extension.surface_functions.wave_tile(rows.T, result.T)
        return result


Position = tuple[float, float]
"""For one tile: its displacements along and across the motion [pixels]; for two: the displacements
of both along the motion [a]."""

REACH = 1.0
"""Friction is integrated within this distance from the centre [semi-axes]: in the dry contact,
outside of which the viscosity hardly increases. 0.95 and 1.05 change mu_r/mu_s of Table 1 by 0.02
%."""


@dataclass(frozen=True)
class Component:
    """The waves of one surface: its spectrum, and the response of the contact to it."""

    spectrum: Spectrum
    transfer: Transfer
    edge: Edge
    velocity_ratio: float  # of the surface [-]
    factors: WaveFactors | None = None  # if they are known already

    def wave_factors(self, central_film: float, *, on_lines: bool = False) -> WaveFactors:
        """Give the factors of its tiles in a contact with a film H_c [a^2/R]."""
        given = self.spectrum, self.transfer, central_film, self.velocity_ratio
        return self.factors or WaveFactors.of(*given, on_lines=on_lines)

    def at_centre(self) -> Complex:
        """T at X = Y = 0."""
        return self.transfer.at_centre(self.spectrum, self.velocity_ratio)

    def pressure_at_centre(self) -> Complex:
        """Pressure over roughness at X = Y = 0 [p_h R/a^2]."""
        return self.transfer.pressure_at_centre(self.spectrum, self.velocity_ratio)


def station_weights(x: Array) -> Array:
    """Weights (..., n) of the stations in the waves at X [a]."""
    return np.stack([np.interp(x, STATIONS, unit) for unit in np.eye(STATIONS.size)], axis=-1)


def line_weights(y: Array) -> Array:
    """Weights (n, lines) of LINES without the centre line in the free wave at Y [semi-axis]."""
    lines = np.delete(np.eye(LINES.size), AXIS, 0)
    return np.stack([np.interp(y, LINES, unit) for unit in lines], axis=-1)


def two_lines(y: Array) -> tuple[NDArray[np.int32], Single]:
    """`line_weights` at Y (n,) as the first of two successive lines and two weights (2, n)."""
    weights = line_weights(y)
    first = np.minimum(np.argmax(weights > 0.0, axis=1), weights.shape[1] - 2)
    both = np.stack([np.take_along_axis(weights, (first + k)[:, np.newaxis], 1) for k in (0, 1)])
    return first.astype(np.int32), both[..., 0].astype(np.float32)


def slipped(x: Array, y: Array, velocity_ratio: float, *, bent: bool) -> Array:
    """Displacement of the roughness past the free wave since the inlet [a].

    At places X [a] and Y [semi-axis].
    """
    inlet = np.sqrt(np.maximum(0.0, 1.0 - y * y)) if bent else np.ones_like(y)
    return (velocity_ratio - 1.0) * (x + inlet)


def _steps(reach: float, pixel: float, pixels: int, stride: int) -> NDArray[np.int32]:
    """Every `stride`-th pixel within a reach [a]; if it is infinite, of the whole tile."""
    if math.isinf(reach):
        return np.arange(0, pixels, stride, dtype=np.int32)
    n = int(reach / (stride * pixel))
    return np.arange(-n, n + 1, dtype=np.int32) * np.int32(stride)


class PixelTile:
    """A tile whose pixels, every `stride`-th, are the points of the contact."""

    def __init__(
        self, wave: Component, central_film: float, stride: int, operating: AnyContact
    ) -> None:
        self.wave, self.stride, self.pixel = wave, stride, wave.spectrum.pixel
        ratio, transfer = wave.velocity_ratio, wave.transfer
        self.waves = WaveTiles.of(wave.spectrum, wave.wave_factors(central_film), stride)
        self.rows, self.columns = (
            _steps(reach, pixel, n, stride)
            for reach, pixel, n in zip(
                (REACH, REACH * operating.ellipse.ellipticity),
                self.pixel,
                wave.spectrum.shape,
                strict=True,
            )
        )
        self.x, self.y = (
            np.asarray(index * p, dtype=float)
            for index, p in zip((self.rows, self.columns), self.pixel, strict=True)
        )
        self.across = self.y / operating.ellipse.ellipticity
        # the free wave follows from the roughness that was in the inlet when it arose; without a
        # bend the slip since then is the same on all lines
        lines = self.across if transfer.bent else np.zeros(1)
        way = slipped(self.x[:, np.newaxis], lines, ratio, bent=transfer.bent)
        place = (self.x[:, np.newaxis] + way) / self.pixel[0] * REFINEMENT
        self.free_rows = np.floor(place).astype(np.int32)
        self.between = (place - self.free_rows).astype(np.float32)
        # additional free waves off the centre line, for the last track
        self.beside: dict[int, Single | None] = {}

    def with_wave(self, wave: Component, central_film: float) -> PixelTile:
        """Return a tile of other waves on the same pixels."""
        other = copy.copy(self)
        other.wave, other.beside = wave, {}
        other.waves = WaveTiles.of(wave.spectrum, wave.wave_factors(central_film), self.stride)
        return other

    def add(
        self, contact: RoughContact, position: Position, spans: NDArray[np.int32], total: Single
    ) -> None:
        """Add loss of film and pressure increase (m, n, 2); track: a multiple of the stride.

        `spans` (m, 2): first and last column of each row, from 1.
        """
        shift, track = (int(pixels) for pixels in position)
        waves = self.waves
        columns = (self.columns - track) // self.stride % waves.driven.shape[2]
        columns = columns.astype(np.int32)
        if track not in self.beside:
            self.beside = {track: waves.beside(columns, *two_lines(self.across))}
        extension.surface_functions.driven_waves(
            waves.driven.T, self.rows, columns, spans.T, contact.weights.T, shift, total.T
        )
        places = self.free_rows, self.between
        beside = self.beside[track]
        contact.add_free(waves, beside, places, columns, spans, shift * REFINEMENT, total)

    def at_edge(self, position: Position) -> tuple[Array, Array]:
        """Effect of the edge in a position, see :meth:`Edge.at`."""
        return self.wave.edge.at(position[0] * self.pixel[0], position[1] * self.pixel[1])


class LineTile:
    """One of two tiles, with its `number`, on lines of the contact and its own track [a]."""

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
        factors = wave.wave_factors(central_film, on_lines=True)
        self.waves = WaveTiles.of(wave.spectrum, factors, lines=y - track)
        self.columns = np.arange(y.size, dtype=np.int32)
        self.beside = self.waves.beside(self.columns, *two_lines(across))
        self.scale = REFINEMENT / wave.spectrum.pixel[0]
        self.places = x[:, np.newaxis]
        lines = across if bent else np.zeros(1)
        self.free_places = self.places + slipped(self.places, lines, ratio, bent=bent)

    def _rows(self, places: Array) -> tuple[NDArray[np.int32], Single]:
        """Row of the waves before positions [a], and the weight of the next row."""
        at = places * self.scale
        low = np.floor(at)
        return low.astype(np.int32), (at - low).astype(np.float32)

    def add(
        self, contact: RoughContact, position: Position, spans: NDArray[np.int32], total: Single
    ) -> None:
        """Add loss of film and pressure increase."""
        shift = position[self.number]
        (rows, between), free = (self._rows(p - shift) for p in (self.places, self.free_places))
        extension.surface_functions.waves_between(
            self.waves.driven.T,
            rows[:, 0],
            self.columns,
            spans.T,
            between[:, 0],
            contact.weights.T,
            total.T,
        )
        contact.add_free(self.waves, self.beside, free, self.columns, spans, 0, total)

    def at_edge(self, position: Position) -> tuple[Array, Array]:
        """Effect of the edge in a position, see :meth:`Edge.at`."""
        return self.edge.at(position[self.number], self.track)
