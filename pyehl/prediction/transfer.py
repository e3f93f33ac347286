# SPDX-License-Identifier: BSD-3-Clause
"""What the contact makes of every component of a tile: the response over its spectrum.

Units: lengths along the surface by a, heights by a^2/R, pressures by p_h.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

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
CENTRE = STATIONS[: MIDDLE + 1]
OFF_CENTRE = 0.5
"""The second distance from the centre line at which the free wave is made [a]."""

# Standard deviation of the friction over Y [a], and the phase that may be interpolated over it
FRICTION_LINES = 0.24
BENDING = 0.2

# Wavenumbers and directions of the table of responses: the interpolated T is right to 1e-3. Both
# are odd, so that every second one is a table, too
TABLE = (73, 25)
# Components that are interpolated at a time
BLOCK = 1 << 18
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


class _Table:
    """Wavenumbers and directions at which a response is taken, and the way from there to a tile.

    Attributes
    ----------
    kx, ky
        Wavenumbers of the table (m,) [1/a].
    """

    def __init__(self, spectrum: Spectrum) -> None:
        rows, ny = spectrum.qx.size, spectrum.qy.size
        # qy and -qy have the same response
        half = ny // 2 + 1
        qx, qy = spectrum.qx[:, np.newaxis], np.abs(spectrum.qy[np.newaxis, :half])
        q = np.hypot(qx, qy)
        low, high = np.log(q[q > 0.0].min()), np.log(q.max())
        wavenumber = np.exp(np.linspace(low, high, TABLE[0]))[:, np.newaxis]
        direction = np.linspace(0.0, 0.5 * np.pi, TABLE[1])
        kx, ky = wavenumber * np.cos(direction), wavenumber * np.sin(direction)
        kx[:, -1] = 0.0
        self.kx, self.ky = kx.ravel(), ky.ravel()
        with np.errstate(divide="ignore"):
            row = (np.log(q) - low) * ((TABLE[0] - 1) / max(high - low, 1e-12))
        row = np.maximum(row, 0.0).ravel()
        column = np.arctan2(qy, qx).ravel() * ((TABLE[1] - 1) / (0.5 * np.pi))
        self._nearest = np.rint(row).astype(int) * TABLE[1] + np.rint(column).astype(int)
        self._rows, self._columns = row, column
        self._shape = rows, half
        self._mirror = np.minimum(np.arange(ny), ny - np.arange(ny))

    def gathered(self, power: Array) -> Array:
        """Sum what the components of a tile have, at the places of the coarse table, (l,).

        Weighted as for a linear interpolation between them.
        """
        half = self._shape[1]
        folded = power[:, :half].copy()
        folded[:, 1 : power.shape[1] - half + 1] += power[:, half:][:, ::-1]
        sums = np.bincount(self._nearest, folded.ravel(), self.kx.size)
        found: Array = np.asarray(sums, dtype=np.float64).reshape(TABLE)
        for _ in TABLE:
            between = 0.5 * found[1::2]
            found = found[::2].copy()
            found[:-1] += between
            found[1:] += between
            found = found.T
        return found.ravel()

    def coarse(self) -> tuple[Array, Array]:
        """Every second wavenumber and direction of the table, (l,) each."""
        kx, ky = (values.reshape(TABLE)[::2, ::2].ravel() for values in (self.kx, self.ky))
        return kx, ky

    def spread(self, tables: Sequence[Complex]) -> list[Complex]:
        """Interpolate tables (m,) to all components, linear in log |q| and direction."""
        values = np.stack(tables, axis=-1).view(np.float64)
        found = [np.empty((self._shape[0], self._mirror.size), dtype=complex) for _ in tables]
        width = self._shape[1]
        step = max(1, BLOCK // width)
        for first in range(0, self._shape[0], step):
            part = slice(first * width, (first + step) * width)
            spread = (_weights(self._rows[part], self._columns[part]) @ values).view(np.complex128)
            for k, out in enumerate(found):
                out[first : first + step] = spread[:, k].reshape(-1, width)[:, self._mirror]
        for out in found:
            # a component that does not move has no phase but its own
            out[0] = out[0].real
        return found


def _weights(row: Array, column: Array) -> sparse.csr_array:
    """Matrix of the bilinear interpolation in a table, (n, m)."""
    i, j = (
        np.minimum(place.astype(np.int32), size - 2)
        for place, size in zip((row, column), TABLE, strict=True)
    )
    # what rounding puts beyond the last column is on it
    u, v = row - i, np.minimum(column - j, 1.0)
    at = i * np.int32(TABLE[1]) + j
    index = np.stack([at, at + 1, at + TABLE[1], at + TABLE[1] + 1], axis=-1)
    weight = np.stack([(1.0 - u) * (1.0 - v), (1.0 - u) * v, u * (1.0 - v), u * v], axis=-1)
    ends = np.arange(0, 4 * at.size + 1, 4, dtype=np.int32)
    return sparse.csr_array(
        (weight.ravel(), index.ravel(), ends), shape=(at.size, TABLE[0] * TABLE[1])
    )


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
        table = _Table(spectrum)
        kx, ky = table.kx, table.ky
        # the inlet of a strip off the centre line lies further along the motion
        slip = velocity_ratio - 1.0
        behind = 1.0 if bent else np.exp(1j * kx * slip * (np.sqrt(1.0 - OFF_CENTRE**2) - 1.0))
        lines = np.array([[0.0], [OFF_CENTRE]])
        inlet = inlet_transfer(kx, ky, *moes, velocity_ratio, lines)
        inlet[1] *= behind
        leaking = zone
        if thickening is not None:
            power, few = table.gathered(spectrum.power), table.coarse()
            carried = inlet_transfer(*few, *moes, velocity_ratio) * np.exp(1j * few[0] * slip)
            for _ in range(REPETITIONS):
                driven, free = transport(leaking, *few, velocity_ratio, CENTRE)[MIDDLE]
                pressure = stiffness(np.hypot(*few)) * np.abs(1.0 - driven - free * carried)
                leaking = _at_amplitude(zone, thickening, float(power @ np.square(pressure)))
        stations = transport(leaking, kx, ky, velocity_ratio, STATIONS)
        found = table.spread(
            [driven for driven, _ in stations]
            + [free * inlet[0] for _, free in stations]
            + [stations[MIDDLE][1] * (inlet[1] - inlet[0])]
        )
        count = STATIONS.size
        return cls(found[:count], found[count:-1], found[-1], bent)

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
