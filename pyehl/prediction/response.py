# SPDX-License-Identifier: BSD-3-Clause
"""The response of the contact to every component of a tile.

Units: lengths along the surface by a, heights by a^2/R, pressures by p_h.

Pressure of second order in the roughness
-----------------------------------------
A column of lubricant keeps its mass rho(P) (H - t) during its passage. For a pressure
P1 and a loss of film t1 of first order, with c = d ln rho/dP, r = (d^2 rho/dP^2)/rho and C = K H c,
the pressure of second order that keeps it is

    P2 = K/(1 + C) (c P1 t1 - r/2 H P1^2),

K/(1 + C) taken wave by wave: the products hold sums and differences of the wavenumbers. No constant
in it is fitted. In place of the convolution the friction takes P2 = gamma (P1^2 - s^2) point by
point; s^2 is the variance of P1 and

    gamma s^4 = sum over all pairs of waves of K/(1 + C) at q + q' and q - q', times
                (c <P1 t1>' - r/2 H <P1^2>') <P1^2> of the two.

For Gaussian P1 the mean of P2 exp(b P1), and with it the friction, is then that of the convolution
for every b.

The second-order contribution of the inlet was not derived but measured, in the fields of
simulations (docs/evidence/fields). It is convected at the mean velocity, as the free wave is: a
pressure INLET_PRESSURE P0^2, P0 the pressure of first order that the waves would have where they
are if they had not slipped since the inlet. With slip P0 is less and less like P1: only its part
along P1^2, (<P0 P1>/s^2)^2 INLET_PRESSURE, is added to gamma. And the film regains INLET_FILM
t1^2/H of its loss t1. So it is nearly H exp(-t1/H), which it follows where the loss is most of the
film, too (docs/evidence/thin_film): :func:`film_left`.

Of two rough surfaces P1 holds the waves of both, and the sum the pairs of one wave of
each, too: they meet in all positions, so that no product of two has a mean.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from pyehl.prediction.spectrum import Spectrum, WaveTable, coarsened
from pyehl.theory.response import edge_gain, inlet_transfer
from pyehl.theory.transport import (
    LINES,
    Zone,
    free_stiffness,
    line_pressure,
    stiffness,
    transport,
    wave_pressure,
)
from pyehl.types import Array, Complex, Indices

INLET_PRESSURE = 0.5
"""Pressure of second order by the inlet, over the square of that of first order [1/p_h]."""
INLET_FILM = 0.4
"""Film of second order by the inlet, over the square of the loss of first order, both over the
smooth film [-]."""

FILM_ENDS = 1.6
"""Loss of first order over the smooth film at which no full film is predicted [-]: films hold at
1.2 and 1.35, and fine grids have none at 1.8 (docs/evidence/thin_film)."""

# Loss over the film up to which the film of second order is taken; beyond it falls as an
# exponential that continues from there
QUADRATIC = 0.6
_LEFT = 1.0 - QUADRATIC + INLET_FILM * QUADRATIC**2
_RATE = (1.0 - 2.0 * INLET_FILM * QUADRATIC) / _LEFT

# How often the table of the response is coarsened for the pairs of its waves: once, in place of
# twice, changes mu_r/mu_s of Table 1 by 0.01 % and takes 16 times as long
COARSER = 2


def film_left(loss: Array) -> Array:
    """Film over the smooth one after a loss of first order, over the smooth film [-]."""
    near = np.minimum(loss, QUADRATIC)
    left = np.asarray(1.0 - near + INLET_FILM * np.square(near))
    # few points lose so much
    beyond = loss > QUADRATIC
    left[beyond] *= np.exp(-_RATE * (loss[beyond] - QUADRATIC))
    return left


def loss_at(film: Array) -> Array:
    """Loss of first order that leaves a film, both over the smooth film: `film_left` inverted.

    A film that is not positive needs an infinite one.
    """
    with np.errstate(divide="ignore"):
        beyond = -np.log(np.clip(film, 0.0, _LEFT) / _LEFT) / _RATE
    root = np.sqrt(np.maximum(0.0, 1.0 - 4.0 * INLET_FILM * (1.0 - np.maximum(film, _LEFT))))
    return np.asarray((1.0 - root) / (2.0 * INLET_FILM) + beyond)


class SecondOrder:
    """gamma and s^2 of any surfaces on some tiles, from the response of the contact to their waves.

    At ascending stations X (n,) [a] of the smooth contact `zone`, for each tile: T of the waves of
    its table (n, m), their pressure over roughness (n, m) [p_h R/a^2], and that which they would
    have if they had not slipped since the inlet.
    """

    def __init__(
        self,
        zone: Zone,
        stations: Array,
        tables: Sequence[WaveTable],
        ratios: Sequence[Complex],
        pressures: Sequence[Complex],
        convected: Sequence[Complex],
    ) -> None:
        self._tables = tables
        kx, ky = np.concatenate([table.coarse(COARSER) for table in tables], axis=1)
        # a wave stands for +-k_Y, too
        pairs = [
            zone.stiffness
            * stiffness(np.hypot(kx[:, np.newaxis] + i * kx, ky[:, np.newaxis] + j * ky))
            for i in (1, -1)
            for j in (1, -1)
        ]
        film, c, r = (
            np.interp(stations, zone.x, values)
            for values in (zone.film, zone.compressibility, zone.curvature)
        )
        t, pressure, earlier = (
            np.concatenate([coarsened(part, COARSER) for part in parts], axis=1)
            for parts in (ratios, pressures, convected)
        )
        self._squared = np.abs(pressure) ** 2
        mixed = (pressure * np.conj(t)).real
        self._alike = (pressure * np.conj(earlier)).real
        self._source = c[:, np.newaxis] * mixed - (0.5 * r * film)[:, np.newaxis] * self._squared
        self._yielding = [
            sum(one / (1.0 + one * held) for one in pairs) / len(pairs) for held in film * c
        ]

    def of(self, *powers: Array) -> tuple[Array, Array]:
        """Give gamma [1/p_h] and s^2 [p_h^2] at the stations, (n,) each.

        `powers` are, for each tile, the mean square of each component of the surface, shape of the
        spectrum [a^4/R^2].
        """
        parts = zip(self._tables, powers, strict=True)
        few = np.concatenate([table.gathered(power, COARSER) for table, power in parts])
        squared, source = few * self._squared, few * self._source
        variance = squared.sum(axis=1)
        pairs = zip(squared, self._yielding, source, strict=True)
        sums = np.array([a @ y @ b for a, y, b in pairs])
        sums += INLET_PRESSURE * np.square((few * self._alike).sum(axis=1))
        # nothing in it, nothing of second order
        return sums / np.where(variance > 0.0, variance, 1.0) ** 2, variance


def _lines(zone: Zone) -> Array:
    """Lines on which the free wave is made: of a line contact one, which is like all others."""
    return LINES if np.isfinite(zone.ellipticity) else LINES[AXIS : AXIS + 1]


STATIONS = np.array([-0.5, 0.0, 0.5])
"""Stations along the motion at which waves are computed [a], interpolated in between. Two more, at
-0.25 and 0.25, change mu_r/mu_s of Table 1 by 0.06 % and, at a velocity ratio of 1.2, by 0.2 %."""
MIDDLE = 1
"""The one of them at X = 0."""
CENTRE = STATIONS[: MIDDLE + 1]
AXIS = LINES.size // 2
"""The one of them on the centre line."""

# Standard deviation of the friction over Y [semi-axis], and the phase that may be interpolated.
# The former is that of Newtonian contacts: 0.23 at M = 1000 and L = 10, 0.26 at M = 200. Half the
# phase changes mu_r/mu_s of Table 1 by 0.2 %, twice the phase by nothing; twice the deviation by
# 0.2 %, half of it by 1.8 % at most (velocity ratios of 1.01 to 1.25)
FRICTION_LINES = 0.24
BENDING = 0.2

# Repetitions of pressure from leak and leak from pressure; each leaves a tenth of the change: two
# and five give mu_r/mu_s within 1e-5 of that of three
REPETITIONS = 3


def _is_bent(spectrum: Spectrum, velocity_ratio: float) -> bool:
    """Whether slip bends the free waves of a tile so much that every line is computed.

    The inlet is curved: off the centre line the free wave has slipped less. Where the phase of the
    shortest wave differs little over the lines that friction comes from, it is interpolated.
    """
    return abs(velocity_ratio - 1.0) * float(spectrum.qx[-1]) * 0.5 * FRICTION_LINES**2 > BENDING


def _bend(kx: Array, slip: float) -> Complex:
    """Phase of the free waves by slip after the curved inlet on LINES: (lines, ...)."""
    behind = np.sqrt(1.0 - np.square(LINES)) - 1.0
    return np.asarray(np.exp(1j * slip * np.multiply.outer(behind, kx)))


def leaking_at_amplitude(zone: Zone, variance: float) -> Zone:
    """Return a contact in which waves of finite pressure leak, for their friction.

    The leak is div(rho H^3/(eta lambda) grad P): it is slow where the waves raise the pressure and
    the viscosity, and most of the friction arises there. For a Gaussian delta P of `variance` s^2
    [p_h^2] the leak lowers the mean of exp(b delta P), b = d ln eta/dP the thickening, at the rate
    of small waves over that mean, exp(b^2 s^2/2). Where the lubricant thins in the flow, b is that
    of eta/phi_x: it leaks and shears by what is left of the viscosity.
    """
    b = zone.thickening
    if zone.factors:
        b = b * (1.0 - zone.factors.by_sliding)
    with np.errstate(over="ignore"):
        gain = np.exp(0.5 * variance * np.square(b))
    return replace(zone, conductance=zone.conductance / gain)


class _Entering:
    """The waves of a tile at the inlet, on the table of the tile."""

    def __init__(
        self, spectrum: Spectrum, velocity_ratio: float, zone: Zone, moes: tuple[float, float]
    ) -> None:
        lines = _lines(zone)
        self.bent, self._axis = (
            lines.size > 1 and _is_bent(spectrum, velocity_ratio),
            lines.size // 2,
        )
        self.table, self.ratio = WaveTable(spectrum), velocity_ratio
        self._power, self._negative = spectrum.power, spectrum.qy < 0.0
        kx, ky = self.table.kx, self.table.ky
        # the inlet of a strip off the centre line lies further along the motion
        self._slip = velocity_ratio - 1.0
        self._inlet = inlet_transfer(zone, kx, ky, moes, velocity_ratio, lines)
        if not self.bent and lines.size > 1:
            self._inlet *= _bend(kx, self._slip)

    def variance(self, zone: Zone, mesh: float) -> float:
        """Mean square of their pressure at X = 0 where they leak as in a zone [p_h^2]."""
        few = self.table.coarse()
        convected = coarsened(self._inlet[self._axis], 1) * np.exp(1j * few[0] * self._slip)
        driven, free = transport(zone, *few, self.ratio, CENTRE, mesh)[MIDDLE]
        pressure = zone.stiffness * wave_pressure(*few, self.ratio, driven, free * convected)
        return float(self.table.gathered(self._power) @ np.square(np.abs(pressure)))

    def at_stations(self, zone: Zone, mesh: float) -> _AtStations:
        """Transport them to the stations of a zone in which they leak."""
        kx, ky, inlet = self.table.kx, self.table.ky, self._inlet[self._axis]
        stations = transport(zone, kx, ky, self.ratio, STATIONS, mesh)
        turned = [np.exp(1j * kx * self._slip * (x + 1.0)) for x in STATIONS]
        parts = [(d, f * inlet * t) for (d, f), t in zip(stations, turned, strict=True)]
        k = zone.stiffness
        pressures = [k * wave_pressure(kx, ky, self.ratio, d, f) for d, f in parts]
        convected = [
            k * t * wave_pressure(kx, ky, self.ratio, np.zeros_like(d), f * inlet)
            for (d, f), t in zip(stations, turned, strict=True)
        ]
        beside = stations[MIDDLE][1] * (self._inlet - inlet)
        pressure_parts: Sequence[Complex] = ()
        if zone.ellipticity != 1.0 and np.isfinite(zone.ellipticity):
            bend = _bend(kx, self._slip) if self.bent else 1.0
            pressure_parts = list(
                line_pressure(beside * bend, kx, ky, self.ratio, zone.ellipticity) / bend
            )
        result = self.table.spread(
            driven=[driven for driven, _ in stations],
            free=[free * inlet for _, free in stations],
            off_centre=list(np.delete(beside, self._axis, 0)),
            line_pressure=pressure_parts,
        )
        # the table has k_Y > 0; a wave with -k_Y is on a line what one with k_Y is on its mirror
        # image
        for name in ("off_centre", "line_pressure"):
            lines = result[name]
            result[name] = [
                np.where(self._negative, other, one)
                for one, other in zip(lines, lines[::-1], strict=True)
            ]
        ratios = np.array([d + f for d, f in parts])
        return _AtStations(result, ratios, np.array(pressures), np.array(convected))


class _AtStations(NamedTuple):
    """The waves of a tile at the stations."""

    # Of the components of the tile, by the names that :class:`Transfer` gives them
    parts: dict[str, list[Complex]]
    # Of the table (n, m): T, pressure, and pressure without the slip since the inlet
    ratios: Complex
    pressures: Complex
    convected: Complex


@dataclass(frozen=True, slots=True)
class Transfer:
    """T of every component of a tile: driven and free part at the stations."""

    driven: list[Complex]  # per station, shape of the spectrum
    # Empty without free waves; per station on the centre line, without the phase that slip adds on
    # the way from X = -1
    free: list[Complex]
    # What is added to the free part at X = 0 on each of LINES but the centre line
    off_centre: list[Complex]
    # Whether the phase that slip loses by the curved inlet is left out of `off_centre`: the free
    # waves are then to be read line by line
    bent: bool
    # The pressure of second order; None where the waves move with the roughness as they are
    second: SecondOrder | None = None
    # Of an ellipse, the pressure that is released where `off_centre` is [p_h R/a^2], of a
    # half-space under a circle: on each of LINES (:func:`pyehl.theory.transport.line_pressure`)
    line_pressure: Sequence[Complex] = ()
    stiffening: float = 1.0  # stiffness over that of the half-space under a circle
    ellipticity: float = 1.0  # of the contact

    @classmethod
    def of_all(
        cls,
        tiles: Sequence[tuple[Spectrum, float]],
        zone: Zone,
        moes: tuple[float, float],
        *,
        at_amplitude: bool = False,
        mesh: float = 0.0,
    ) -> list[Transfer]:
        """Of the tiles that are in a contact at a time, each with its velocity ratio.

        From tables over |q| and direction; `moes` are M, L of the circular contact with the same
        inlet. `at_amplitude`: the waves leak as those of the amplitude of all tiles
        (:func:`leaking_at_amplitude`), not as small ones. `mesh` [a]: they leak as on a grid. The
        pressure of second order is one.
        """
        entering = [_Entering(*tile, zone, moes) for tile in tiles]
        leaking = zone
        if at_amplitude:
            for _ in range(REPETITIONS):
                variance = sum(waves.variance(leaking, mesh) for waves in entering)
                leaking = leaking_at_amplitude(zone, variance)
        loaded = [waves.at_stations(leaking, mesh) for waves in entering]
        tables = [waves.table for waves in entering]
        of_tables = zip(*(result[1:] for result in loaded), strict=True)
        second = SecondOrder(zone, STATIONS, tables, *of_tables)
        return [
            cls(
                driven=result.parts["driven"],
                free=result.parts["free"],
                off_centre=result.parts["off_centre"],
                line_pressure=result.parts["line_pressure"],
                bent=waves.bent,
                second=second,
                stiffening=zone.stiffness,
                ellipticity=zone.ellipticity,
            )
            for waves, result in zip(entering, loaded, strict=True)
        ]

    @classmethod
    def uniform(cls, ratio: Array, stiffening: float = 1.0) -> Transfer:
        """Return a real ratio that is the same everywhere and moves with the roughness."""
        driven = [ratio.astype(np.complex128)] * STATIONS.size
        return cls(driven, [], [], bent=False, stiffening=stiffening)

    def kept(self, index: tuple[Indices, Indices]) -> Transfer:
        """Return the part of the components at rows and columns of the spectrum."""
        rows_columns = np.ix_(*index)

        def cut(part: Sequence[Complex]) -> list[Complex]:
            return [t[rows_columns] for t in part]

        return replace(
            self,
            driven=cut(self.driven),
            free=cut(self.free),
            off_centre=cut(self.off_centre),
            line_pressure=cut(self.line_pressure),
        )

    def gain(self, qx: Array, qy: Array, central_film: float) -> Array:
        """Stiffness of waves [1/a] over that of the half-space under a circle, at H_c [a^2/R].

        The factor that was measured on circles is for what is calculated on ellipses; a line has no
        sides.
        """
        if self.line_pressure or np.isinf(self.ellipticity):
            return np.full(np.broadcast_shapes(qx.shape, qy.shape), self.stiffening)
        return self.stiffening * edge_gain(qx, qy, self.stiffening * central_film)

    def free_pressures(
        self, qx: Array, qy: Array, velocity_ratio: float
    ) -> tuple[list[Complex], ...]:
        """Pressures that free waves release on an ellipse, of a half-space under a circle.

        At the stations, and what is added on each of LINES but the centre line.
        """
        k_free, axis = free_stiffness(qx, qy, velocity_ratio), self.line_pressure[AXIS]
        lines = [p - axis for i, p in enumerate(self.line_pressure) if i != AXIS]
        return [k_free * t + axis for t in self.free], lines

    def beside(self, qx: Array, velocity_ratio: float) -> Complex | None:
        """Change of T at X = 0 on LINES (lines, ...) of an ellipse; None of a circle."""
        if not self.line_pressure:
            return None
        slip = velocity_ratio - 1.0
        kx = np.broadcast_to(qx[:, np.newaxis], self.off_centre[0].shape)
        bend = _bend(kx, slip) if self.bent else 1.0
        lines = np.insert(np.array(self.off_centre), AXIS, 0.0, axis=0)
        return np.asarray(lines * np.exp(1j * kx * slip) * bend)

    def at_centre(self, spectrum: Spectrum, velocity_ratio: float) -> Complex:
        """T at X = Y = 0."""
        return np.asarray(self.driven[MIDDLE] + self._free_at_centre(spectrum, velocity_ratio))

    def pressure_at_centre(self, spectrum: Spectrum, velocity_ratio: float) -> Complex:
        """Pressure over roughness at X = Y = 0 [p_h R/a^2]."""
        free = self._free_at_centre(spectrum, velocity_ratio)
        qx, qy = spectrum.qx[:, np.newaxis], spectrum.qy[np.newaxis, :]
        result = wave_pressure(qx, qy, velocity_ratio, self.driven[MIDDLE], free)
        return self.stiffening * result

    def _free_at_centre(self, spectrum: Spectrum, velocity_ratio: float) -> Complex:
        if not self.free:
            return np.zeros_like(self.driven[MIDDLE])
        slip = np.exp(1j * spectrum.qx * (velocity_ratio - 1.0))[:, np.newaxis]
        return np.asarray(self.free[MIDDLE] * slip)


@dataclass(frozen=True, slots=True)
class Response:
    """Response of a loaded contact to a rough tile, with the properties of its centre."""

    pressure: Array  # delta p (nx, ny) [Pa], mean zero
    deformed: Array  # deformed roughness rr_d (nx, ny) [m], mean zero, peaks thin the film
