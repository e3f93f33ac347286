# SPDX-License-Identifier: BSD-3-Clause
"""What the contact makes of every component of a tile: the response over its spectrum.

Units: lengths along the surface by a, heights by a^2/R, pressures by p_h.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from pyehl.prediction.second_order import SecondOrder
from pyehl.prediction.spectrum import Spectrum, WaveTable, coarsened
from pyehl.theory.response import edge_gain, inlet_transfer
from pyehl.theory.transport import LINES, Zone, free_stiffness, pressed, transport, wave_pressure
from pyehl.types import Array, Complex, Indices

STATIONS = np.array([-0.5, 0.0, 0.5])
"""Where the waves are made, along the motion [a]; between them they are interpolated. Two more, at
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


def _bends(spectrum: Spectrum, velocity_ratio: float) -> bool:
    """Whether slip bends the free waves of a tile so much that it must be followed line by line.

    The inlet is curved: off the centre line the free wave has slipped less. Where the phase of the
    shortest wave differs little over the lines that friction comes from, it is interpolated.
    """
    return abs(velocity_ratio - 1.0) * float(spectrum.qx[-1]) * 0.5 * FRICTION_LINES**2 > BENDING


def _bend(kx: Array, slip: float) -> Complex:
    """Phase that slip loses by the curved inlet on LINES: (lines, ...)."""
    behind = np.sqrt(1.0 - np.square(LINES)) - 1.0
    return np.asarray(np.exp(1j * slip * np.multiply.outer(behind, kx)))


def _at_amplitude(zone: Zone, variance: float) -> Zone:
    """Return a contact that leaks as waves of finite pressure do, for their friction.

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
    """The waves of a tile as the inlet makes them, on the table of the tile."""

    def __init__(
        self, spectrum: Spectrum, velocity_ratio: float, zone: Zone, moes: tuple[float, float]
    ) -> None:
        self.bent = _bends(spectrum, velocity_ratio)
        self.table, self.ratio = WaveTable(spectrum), velocity_ratio
        self._power, self._negative = spectrum.power, spectrum.qy < 0.0
        kx, ky = self.table.kx, self.table.ky
        # the inlet of a strip off the centre line lies further along the motion
        self._slip = velocity_ratio - 1.0
        self._inlet = inlet_transfer(zone, kx, ky, moes, velocity_ratio, LINES)
        if not self.bent:
            self._inlet *= _bend(kx, self._slip)

    def variance(self, zone: Zone, mesh: float) -> float:
        """Mean square of their pressure at X = 0 where they leak as in a zone [p_h^2]."""
        few = self.table.coarse()
        carried = coarsened(self._inlet[AXIS], 1) * np.exp(1j * few[0] * self._slip)
        driven, free = transport(zone, *few, self.ratio, CENTRE, mesh)[MIDDLE]
        pressure = zone.stiffness * wave_pressure(*few, self.ratio, driven, free * carried)
        return float(self.table.gathered(self._power) @ np.square(np.abs(pressure)))

    def at_stations(self, zone: Zone, mesh: float) -> _AtStations:
        """Give what becomes of them where they leak as in a zone."""
        kx, ky, inlet = self.table.kx, self.table.ky, self._inlet[AXIS]
        stations = transport(zone, kx, ky, self.ratio, STATIONS, mesh)
        turned = [np.exp(1j * kx * self._slip * (x + 1.0)) for x in STATIONS]
        parts = [(d, f * inlet * t) for (d, f), t in zip(stations, turned, strict=True)]
        k = zone.stiffness
        pressures = [k * wave_pressure(kx, ky, self.ratio, d, f) for d, f in parts]
        carried = [
            k * t * wave_pressure(kx, ky, self.ratio, np.zeros_like(d), f * inlet)
            for (d, f), t in zip(stations, turned, strict=True)
        ]
        beside = stations[MIDDLE][1] * (self._inlet - inlet)
        pressed_by: Sequence[Complex] = ()
        if zone.ellipticity != 1.0:
            bend = _bend(kx, self._slip) if self.bent else 1.0
            pressed_by = list(pressed(beside * bend, kx, ky, self.ratio, zone.ellipticity) / bend)
        found = self.table.spread(
            driven=[driven for driven, _ in stations],
            free=[free * inlet for _, free in stations],
            off_centre=list(np.delete(beside, AXIS, 0)),
            pressed=pressed_by,
        )
        # the table has k_Y > 0; a wave with -k_Y is on a line what one with k_Y is on its mirror
        # image
        for name in ("off_centre", "pressed"):
            lines = found[name]
            found[name] = [
                np.where(self._negative, other, one)
                for one, other in zip(lines, lines[::-1], strict=True)
            ]
        ratios = np.array([d + f for d, f in parts])
        return _AtStations(found, ratios, np.array(pressures), np.array(carried))


class _AtStations(NamedTuple):
    """The waves of a tile at the stations."""

    # Of the components of the tile, by the names that :class:`Transfer` gives them
    parts: dict[str, list[Complex]]
    # Of the table (n, m): T, pressure, and pressure without the slip since the inlet
    ratios: Complex
    pressures: Complex
    carried: Complex


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
    # Of an ellipse, what gives way where `off_centre` is [p_h R/a^2], of a half-space under a
    # circle: on each of LINES (:func:`pyehl.theory.transport.pressed`)
    pressed: Sequence[Complex] = ()
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
        (:func:`_at_amplitude`), not as small ones. `mesh` [a]: they leak as on a grid. The pressure
        of second order is one.
        """
        entering = [_Entering(*tile, zone, moes) for tile in tiles]
        leaking = zone
        if at_amplitude:
            for _ in range(REPETITIONS):
                variance = sum(waves.variance(leaking, mesh) for waves in entering)
                leaking = _at_amplitude(zone, variance)
        loaded = [waves.at_stations(leaking, mesh) for waves in entering]
        tables = [waves.table for waves in entering]
        of_tables = zip(*(found[1:] for found in loaded), strict=True)
        second = SecondOrder(zone, STATIONS, tables, *of_tables)
        return [
            cls(
                driven=found.parts["driven"],
                free=found.parts["free"],
                off_centre=found.parts["off_centre"],
                pressed=found.parts["pressed"],
                bent=waves.bent,
                second=second,
                stiffening=zone.stiffness,
                ellipticity=zone.ellipticity,
            )
            for waves, found in zip(entering, loaded, strict=True)
        ]

    @classmethod
    def carried(cls, ratio: Array, stiffening: float = 1.0) -> Transfer:
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
            pressed=cut(self.pressed),
        )

    def gain(self, qx: Array, qy: Array, central_film: float) -> Array:
        """Stiffness of waves [1/a] over that of the half-space under a circle, at H_c [a^2/R].

        The factor that was measured on circles is for what is calculated on ellipses.
        """
        if self.pressed:
            return np.full(np.broadcast_shapes(qx.shape, qy.shape), self.stiffening)
        return self.stiffening * edge_gain(qx, qy, self.stiffening * central_film)

    def free_pressures(
        self, qx: Array, qy: Array, velocity_ratio: float
    ) -> tuple[list[Complex], ...]:
        """Pressures by which free waves give way on an ellipse, of a half-space under a circle.

        At the stations, and what is added on each of LINES but the centre line.
        """
        k_free, axis = free_stiffness(qx, qy, velocity_ratio), self.pressed[AXIS]
        lines = [p - axis for i, p in enumerate(self.pressed) if i != AXIS]
        return [k_free * t + axis for t in self.free], lines

    def beside(self, qx: Array, velocity_ratio: float) -> Complex | None:
        """Change of T at X = 0 on LINES (lines, ...) of an ellipse; None of a circle."""
        if not self.pressed:
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
        found = wave_pressure(qx, qy, velocity_ratio, self.driven[MIDDLE], free)
        return self.stiffening * found

    def _free_at_centre(self, spectrum: Spectrum, velocity_ratio: float) -> Complex:
        if not self.free:
            return np.zeros_like(self.driven[MIDDLE])
        slip = np.exp(1j * spectrum.qx * (velocity_ratio - 1.0))[:, np.newaxis]
        return np.asarray(self.free[MIDDLE] * slip)
