# SPDX-License-Identifier: BSD-3-Clause
"""The response of the contact to every component of a tile.

Units: lengths along the surface by a, heights by a^2/R, pressures by p_h.

Pressure of second order in the roughness
-----------------------------------------
A column of lubricant keeps its mass rho(P) (H - t) during its passage. For a pressure P1 and a loss
of film t1 of first order, with c = d ln rho/dP, r = (d^2 rho/dP^2)/rho and C = K H c, the pressure
of second order that conserves the mass is

    P2 = K/(1 + C) (c P1 t1 - r/2 H P1^2),

with K/(1 + C) applied wave by wave: the products have the sums and differences of the wavenumbers.
No constant is fitted. For the friction the convolution is replaced by P2 = gamma (P1^2 - s^2) at
each point; s^2 is the variance of P1 and

    gamma s^4 = sum over all pairs of waves of K/(1 + C) at q + q' and q - q', times
                (c <P1 t1>' - r/2 H <P1^2>') <P1^2> of the two.

For Gaussian P1 the mean of P2 exp(b P1), and with it the friction, is then that of the convolution
for every b.

The second-order contribution of the inlet is not derived but measured in the fields of simulations
(docs/evidence/fields). It is convected at the mean velocity like the free wave: a pressure
INLET_PRESSURE P0^2, where P0 is the first-order pressure that the waves would have at their
position without slip since the inlet. With slip P0 is less correlated with P1: only its part along
P1^2, (<P0 P1>/s^2)^2 INLET_PRESSURE, is added to gamma. The loss of film t1 is smaller by
INLET_FILM t1^2/H. So the film is nearly H exp(-t1/H), also where most of the film is lost
(docs/evidence/thin_film): :func:`film_left`.

For two rough surfaces P1 contains the waves of both, and the sum also the pairs of one wave of
each; all relative positions occur, so that no such product has a mean.
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
"""Second-order pressure from the inlet, over the square of the first-order one [1/p_h]."""
INLET_FILM = 0.4
"""Second-order film from the inlet, over the square of the first-order loss of film, both over
the smooth film [-]."""

FILM_ENDS = 1.6
"""First-order loss of film over the smooth film above which no full film is predicted [-]: in
simulations the film is full at 1.2 and 1.35, and on fine grids not at 1.8
(docs/evidence/thin_film)."""

# Loss of film over the film up to which the second-order film is used; beyond it the film
# continues as an exponential
QUADRATIC = 0.6
_LEFT = 1.0 - QUADRATIC + INLET_FILM * QUADRATIC**2
_RATE = (1.0 - 2.0 * INLET_FILM * QUADRATIC) / _LEFT

# Number of coarsenings of the table of the response for the pairs of its waves: 1 in place of 2
# changes mu_r/mu_s of Table 1 by 0.01 % and takes 16 times as long
COARSER = 2


def film_left(loss: Array) -> Array:
    """Film over the smooth film, from the first-order loss of film over it [-]."""
    near = np.minimum(loss, QUADRATIC)
    left = np.asarray(1.0 - near + INLET_FILM * np.square(near))
    # only few points
    beyond = loss > QUADRATIC
    left[beyond] = film_beyond(loss[beyond])
    return left


def film_beyond(loss: Array) -> Array:
    """Give `film_left` for losses above QUADRATIC."""
    return np.asarray(_LEFT * np.exp(-_RATE * (loss - QUADRATIC)))


def loss_at(film: Array) -> Array:
    """First-order loss of film for a film, both over the smooth film: inverse of `film_left`.

    It is infinite for a film that is not positive.
    """
    with np.errstate(divide="ignore"):
        beyond = -np.log(np.clip(film, 0.0, _LEFT) / _LEFT) / _RATE
    root = np.sqrt(np.maximum(0.0, 1.0 - 4.0 * INLET_FILM * (1.0 - np.maximum(film, _LEFT))))
    return np.asarray((1.0 - root) / (2.0 * INLET_FILM) + beyond)


class SecondOrder:
    """gamma and s^2 of surfaces on given tiles, from the response of the contact to their waves.

    At ascending stations X (n,) [a] of the smooth contact `zone`, for each tile: T of the waves of
    its table (n, m), their pressure over roughness (n, m) [p_h R/a^2], and that pressure without
    slip since the inlet.
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
        # a wave represents both signs of k_Y
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
        # without waves there is no second order
        return sums / np.where(variance > 0.0, variance, 1.0) ** 2, variance


def _lines(zone: Zone) -> Array:
    """Lines on which the free wave is computed; one in a line contact, where all are equal."""
    return LINES if np.isfinite(zone.ellipticity) else LINES[AXIS : AXIS + 1]


STATIONS = np.array([-0.5, 0.0, 0.5])
"""Stations along the motion at which waves are computed [a], interpolated in between. Two more, at
-0.25 and 0.25, change mu_r/mu_s of Table 1 by 0.06 % and, at a velocity ratio of 1.2, by 0.2 %."""
MIDDLE = 1
"""Index of the station at X = 0."""
CENTRE = STATIONS[: MIDDLE + 1]
AXIS = LINES.size // 2
"""Index of the centre line in LINES."""

# Standard deviation of the friction over Y [semi-axis], and the largest phase that is interpolated.
# The former is that of Newtonian contacts: 0.23 at M = 1000 and L = 10, 0.26 at M = 200. Half the
# phase changes mu_r/mu_s of Table 1 by 0.2 %, twice the phase not at all; twice the deviation
# changes it by 0.2 %, half of it by at most 1.8 % (velocity ratios of 1.01 to 1.25)
FRICTION_LINES = 0.24
BENDING = 0.2

# Iterations of the leakage, which depends on the pressure; each reduces the change to a tenth: two
# and five give mu_r/mu_s within 1e-5 of that of three
REPETITIONS = 3


def _is_bent(spectrum: Spectrum, velocity_ratio: float) -> bool:
    """Whether slip bends the crests of free waves so much that every line is computed.

    The inlet is curved: off the centre line the roughness has slipped less relative to the free
    wave. If the phase of the shortest wave differs little over the width where friction arises, it
    is interpolated.
    """
    return abs(velocity_ratio - 1.0) * float(spectrum.qx[-1]) * 0.5 * FRICTION_LINES**2 > BENDING


def _bend(kx: Array, slip: float) -> Complex:
    """Phase of the free waves due to slip since the curved inlet, on LINES: (lines, ...)."""
    behind = np.sqrt(1.0 - np.square(LINES)) - 1.0
    return np.asarray(np.exp(1j * slip * np.multiply.outer(behind, kx)))


def leaking_at_amplitude(zone: Zone, variance: float) -> Zone:
    """Return the contact with the leakage of waves of finite pressure.

    The leakage is div(rho H^3/(eta lambda) grad P): it is slow where the waves raise the pressure
    and the viscosity, and most of the friction arises there. For a Gaussian delta P of `variance`
    s^2 [p_h^2] the leakage reduces the mean of exp(b delta P), b = d ln eta/dP, at the rate of
    small waves divided by that mean, exp(b^2 s^2/2). If the flow is shear-thinning, b is that of
    eta/phi_x, the reduced viscosity, which governs both leakage and shear.
    """
    b = zone.thickening
    if zone.factors:
        b = b * (1.0 - zone.factors.by_sliding)
    with np.errstate(over="ignore"):
        gain = np.exp(0.5 * variance * np.square(b))
    return replace(zone, conductance=zone.conductance / gain)


class _Entering:
    """The waves of a tile at the inlet, for the wavenumbers of its table."""

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
        """Mean square of their pressure at X = 0 with the leakage of a zone [p_h^2]."""
        few = self.table.coarse()
        convected = coarsened(self._inlet[self._axis], 1) * np.exp(1j * few[0] * self._slip)
        driven, free = transport(zone, *few, self.ratio, CENTRE, mesh)[MIDDLE]
        pressure = zone.stiffness * wave_pressure(*few, self.ratio, driven, free * convected)
        return float(self.table.gathered(self._power) @ np.square(np.abs(pressure)))

    def at_stations(self, zone: Zone, mesh: float) -> _AtStations:
        """Transport them to the stations of a zone."""
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
        # the table has k_Y >= 0; a wave with -k_Y on a line equals one with k_Y on the mirror image
        # of the line
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

    # For the components of the tile, by the names of the attributes of :class:`Transfer`
    parts: dict[str, list[Complex]]
    # For the table (n, m): T, pressure, and pressure without the slip since the inlet
    ratios: Complex
    pressures: Complex
    convected: Complex


@dataclass(frozen=True, slots=True)
class Transfer:
    """T of every component of a tile: driven and free part at the stations."""

    driven: list[Complex]  # per station, shape of the spectrum
    # Empty without free waves; per station on the centre line, without the phase due to slip since
    # X = -1
    free: list[Complex]
    # Difference from the free part at X = 0, on each of LINES except the centre line
    off_centre: list[Complex]
    # Whether `off_centre` excludes the phase due to slip since the curved inlet: the free waves
    # then have a different displacement on each line
    bent: bool
    # The second-order pressure; None for `uniform`
    second: SecondOrder | None = None
    # For an ellipse, pressure of `off_centre` on each of LINES, in the units of a circle [p_h
    # R/a^2] (:func:`pyehl.theory.transport.line_pressure`)
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
        """Compute the transfers of the tiles in a contact, each with its velocity ratio.

        They are interpolated from tables over |q| and direction; `moes` are M and L of the circular
        contact with the same inlet. `at_amplitude`: the leakage is that at the total amplitude of
        all tiles (:func:`leaking_at_amplitude`), not that of small waves. `mesh` [a]: the leakage
        is that on a grid; 0: of the continuous equations. All tiles share the second-order
        pressure.
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

        The measured factor of circles represents an effect that is computed for ellipses; a line
        has no sides.
        """
        if self.line_pressure or np.isinf(self.ellipticity):
            return np.full(np.broadcast_shapes(qx.shape, qy.shape), self.stiffening)
        return self.stiffening * edge_gain(qx, qy, self.stiffening * central_film)

    def free_pressures(
        self, qx: Array, qy: Array, velocity_ratio: float
    ) -> tuple[list[Complex], ...]:
        """Pressures released by free waves on an ellipse, in the units of a circle.

        At the stations, and the differences on each of LINES except the centre line.
        """
        k_free, axis = free_stiffness(qx, qy, velocity_ratio), self.line_pressure[AXIS]
        lines = [p - axis for i, p in enumerate(self.line_pressure) if i != AXIS]
        return [k_free * t + axis for t in self.free], lines

    def beside(self, qx: Array, velocity_ratio: float) -> Complex | None:
        """Change of T at X = 0 on LINES (lines, ...) of an ellipse; None for a circle or a line."""
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
    """Response of a loaded contact to a rough tile, everywhere as at its centre."""

    pressure: Array  # delta p (nx, ny) [Pa], mean zero
    deformed: Array  # deformed roughness rr_d (nx, ny) [m], mean zero, peaks positive
