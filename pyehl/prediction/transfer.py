# SPDX-License-Identifier: BSD-3-Clause
"""What the contact makes of every component of a tile: the response over its spectrum.

Units: lengths along the surface by a, heights by a^2/R, pressures by p_h.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import map_coordinates

from pyehl.prediction.spectrum import Spectrum
from pyehl.theory.response import Zone, inlet_transfer, stiffness, transport

__all__ = ["MIDDLE", "OFF_CENTRE", "STATIONS", "Transfer"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Indices = NDArray[np.int_]

STATIONS = np.array([-0.5, 0.0, 0.5])
"""Where the waves are made, along the motion [a]; between them they are interpolated."""
MIDDLE = 1
"""The one of them at X = 0."""
OFF_CENTRE = 0.5
"""The second distance from the centre line at which the free wave is made [a]."""

# Standard deviation of the friction over Y [a], and the phase that may be interpolated over it
FRICTION_LINES = 0.24
BENDING = 0.2

# Wavenumbers and directions of the table of responses: the interpolated T is right to 1e-3
TABLE = (72, 25)
# Repetitions of pressure from leak and leak from pressure; each leaves a tenth of the change
REPETITIONS = 3


def _bends(spectrum: Spectrum, velocity_ratio: float) -> bool:
    """Whether slip bends the free waves of a tile so much that it must be followed line by line.

    The inlet is curved: off the centre line the free wave has slipped less. Where the phase of the
    shortest wave differs little over the lines that friction comes from, it is interpolated.
    """
    return abs(velocity_ratio - 1.0) * float(spectrum.qx[-1]) * 0.5 * FRICTION_LINES**2 > BENDING


def _at_amplitude(zone: Zone, thickening: Array, variance: float) -> Zone:
    """Return a contact that leaks as waves of finite pressure do, for their friction.

    The leak is div(rho H^3/(eta lambda) grad P): it is slow where the waves raise the pressure and
    the viscosity, and friction comes from there. For a Gaussian delta P the leak lowers the mean of
    exp(b delta P), b = d ln eta/dP, at the rate of small waves over that mean, exp(b^2 s^2/2).

    Parameters
    ----------
    zone, thickening
        The contact, and b on its places.
    variance
        s^2 of delta P [p_h^2].
    """
    with np.errstate(over="ignore"):
        gain = np.exp(0.5 * variance * np.square(thickening))
    return replace(zone, conductance=zone.conductance / gain)


@dataclass(frozen=True, slots=True)
class Transfer:
    """T of every component of a tile: driven and free part at the stations.

    Attributes
    ----------
    driven
        Per station, shape of the spectrum.
    free
        Empty without free waves; per station on the centre line, without the phase that slip adds
        on the way from X = -1.
    off_centre
        What the distance OFF_CENTRE from the centre line adds to the free part at X = 0.
    bent
        Whether the phase that slip loses by the curved inlet is left out of `off_centre`: the
        free waves are then to be read line by line.
    """

    driven: list[Complex]
    free: list[Complex]
    off_centre: Complex | None
    bent: bool

    @classmethod
    def of(
        cls,
        spectrum: Spectrum,
        zone: Zone,
        moes: tuple[float, float],
        velocity_ratio: float,
        thickening: Array | None = None,
    ) -> Transfer:
        """Of a tile in a contact, from a table over |q| and direction.

        Parameters
        ----------
        spectrum
            Of the tile.
        zone
            The smooth contact.
        moes
            M, L.
        velocity_ratio
            U.
        thickening
            d ln(shear stress)/dP on the places of the zone [-], for the leak at the amplitude of
            the tile (:func:`_at_amplitude`); None: of small waves.
        """
        bent = _bends(spectrum, velocity_ratio)
        q = spectrum.q
        present = q > 0.0
        low, high = np.log(q[present].min()), np.log(q.max())
        log_q = np.linspace(low, high, TABLE[0])
        direction = np.linspace(0.0, 0.5 * np.pi, TABLE[1])
        kx = (np.exp(log_q)[:, np.newaxis] * np.cos(direction)).ravel()
        ky = (np.exp(log_q)[:, np.newaxis] * np.sin(direction)).ravel()
        kx[TABLE[1] - 1 :: TABLE[1]] = 0.0
        # the inlet of a strip off the centre line lies further along the motion
        slip = velocity_ratio - 1.0
        behind = 1.0 if bent else np.exp(1j * kx * slip * (np.sqrt(1.0 - OFF_CENTRE**2) - 1.0))
        inlet = (
            inlet_transfer(kx, ky, *moes, velocity_ratio),
            inlet_transfer(kx, ky, *moes, velocity_ratio, OFF_CENTRE) * behind,
        )
        angle = np.arctan2(np.abs(spectrum.qy)[np.newaxis, :], spectrum.qx[:, np.newaxis])
        with np.errstate(divide="ignore"):
            row = (np.log(q) - low) * ((TABLE[0] - 1) / max(high - low, 1e-12))
        place = np.stack([np.maximum(row, 0.0), angle * ((TABLE[1] - 1) / (0.5 * np.pi))])

        def spread(table: Complex) -> Complex:
            part = table.reshape(TABLE)
            out = np.empty(q.shape, dtype=complex)
            out.real = map_coordinates(part.real, place, order=1, mode="nearest")
            out.imag = map_coordinates(part.imag, place, order=1, mode="nearest")
            # a component that does not move has no phase but its own
            out[0] = out[0].real
            return out

        stations = transport(zone, kx, ky, velocity_ratio, STATIONS)
        if thickening is not None:
            nearest = np.ravel_multi_index(tuple(np.rint(place).astype(int)), TABLE)
            power = np.bincount(nearest.ravel(), spectrum.power.ravel(), kx.size)
            carried = inlet[0] * np.exp(1j * kx * slip)
            for _ in range(REPETITIONS):
                driven, free = stations[MIDDLE]
                pressure = stiffness(np.hypot(kx, ky)) * np.abs(1.0 - driven - free * carried)
                leaking = _at_amplitude(zone, thickening, float(power @ np.square(pressure)))
                stations = transport(leaking, kx, ky, velocity_ratio, STATIONS)
        return cls(
            [spread(driven) for driven, _ in stations],
            [spread(free * inlet[0]) for _, free in stations],
            spread(stations[MIDDLE][1] * (inlet[1] - inlet[0])),
            bent,
        )

    @classmethod
    def carried(cls, ratio: Array) -> Transfer:
        """Return a real ratio that is the same everywhere and moves with the roughness."""
        return cls([ratio.astype(np.complex128)] * STATIONS.size, [], None, bent=False)

    def kept(self, index: tuple[Indices, Indices]) -> Transfer:
        """Return the part of the components at rows and columns of the spectrum."""
        cut = np.ix_(*index)
        off = None if self.off_centre is None else self.off_centre[cut]
        return Transfer([t[cut] for t in self.driven], [t[cut] for t in self.free], off, self.bent)

    def at_centre(self, spectrum: Spectrum, velocity_ratio: float) -> Complex:
        """T at X = Y = 0."""
        if not self.free:
            return self.driven[MIDDLE]
        slip = np.exp(1j * spectrum.qx * (velocity_ratio - 1.0))[:, np.newaxis]
        return np.asarray(self.driven[MIDDLE] + self.free[MIDDLE] * slip)
