# SPDX-License-Identifier: BSD-3-Clause
"""The film and pressure waves that a rough tile makes in a contact, by its linear response.

The tile is taken apart into plane waves; each becomes a driven wave, which moves with the
roughness, and a free wave, made in the inlet and carried at the mean velocity
(:mod:`pyehl.theory.response`). Both change slowly on their way, so that they are made at a few
stations along the motion and interpolated; the free wave also at two distances from the centre
line. Units: lengths along the surface by a, heights by a^2/R, pressures by p_h.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, cast

import numpy as np
import scipy.fft
from numpy.typing import NDArray
from scipy.ndimage import map_coordinates

from pyehl.theory.response import Zone, edge_gain, inlet_transfer, stiffness, transport

__all__ = ["MIDDLE", "OFF_CENTRE", "REFINEMENT", "STATIONS", "Spectrum", "Transfer", "Waves"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Indices = NDArray[np.int_]

STATIONS = np.array([-0.5, 0.0, 0.5])
"""Where the waves are made, along the motion [a]; between them they are interpolated."""
MIDDLE = 1
"""The one of them at X = 0."""
OFF_CENTRE = 0.5
"""The second distance from the centre line at which the free wave is made [a]."""
REFINEMENT = 4
"""Points per pixel along the motion at which the free wave is tabulated."""

# Standard deviation of the friction over Y [a], and the phase that may be interpolated over it
FRICTION_LINES = 0.24
BENDING = 0.2

# Wavenumbers and directions of the table of responses: the interpolated T is right to 1e-3
TABLE = (72, 25)


@dataclass(frozen=True, slots=True)
class Spectrum:
    """The Fourier components of a tile with qx >= 0.

    Attributes
    ----------
    values
        (nx//2 + 1, ny) [a^2/R], of the transform without factors, the mean left out.
    qx, qy
        (nx//2 + 1,) and (ny,) [1/a].
    shape
        (nx, ny).
    """

    values: Complex
    qx: Array
    qy: Array
    shape: tuple[int, int]

    @classmethod
    def of(cls, heights: Array, length_x: float, length_y: float) -> Spectrum:
        """Of heights (nx, ny) [a^2/R] on a tile of a size [a]."""
        nx, ny = heights.shape
        values = scipy.fft.fft(scipy.fft.rfft(heights, axis=0), axis=1)
        values[0, 0] = 0.0
        qx = 2.0 * np.pi * scipy.fft.rfftfreq(nx, length_x / nx)
        qy = 2.0 * np.pi * scipy.fft.fftfreq(ny, length_y / ny)
        return cls(values, qx, qy, (nx, ny))

    @property
    def q(self) -> Array:
        """|q| (nx//2 + 1, ny) [1/a]."""
        return cast(Array, np.hypot(self.qx[:, np.newaxis], self.qy[np.newaxis, :]))

    @property
    def pixel(self) -> tuple[float, float]:
        """Size of a pixel along x and y [a]."""
        nx, ny = self.shape
        return 2.0 * np.pi / (self.qx[1] * nx), 2.0 * np.pi / (self.qy[1] * ny)

    def kept(self, index: tuple[Indices, Indices], shape: tuple[int, int]) -> Spectrum:
        """Return the components at rows and columns of `values` as a tile of fewer pixels."""
        values = self.values[np.ix_(*index)] * (shape[0] * shape[1] / np.prod(self.shape))
        return Spectrum(values, self.qx[index[0]], self.qy[index[1]], shape)

    def tile(
        self,
        factor: Complex | Array,
        refinement: int = 1,
        stride: int = 1,
        precision: type[np.complexfloating[Any, Any]] = np.complex128,
    ) -> Array:
        """Heights (refinement nx, ny/stride) of the tile with its components times a factor."""
        nx, _ = self.shape
        part = self.values * factor
        if nx % 2 == 0:
            # the shortest wave of an even number of pixels has no phase of its own
            part[-1] = self.values[-1] * np.real(factor[-1])
            part[-1] *= 0.5 if refinement > 1 else 1.0
        lines = scipy.fft.ifft(part.astype(precision), axis=1)[:, ::stride]
        return np.asarray(scipy.fft.irfft(lines, n=nx * refinement, axis=0) * refinement)


def _bends(spectrum: Spectrum, velocity_ratio: float) -> bool:
    """Whether slip bends the free waves of a tile so much that it must be followed line by line.

    The inlet is curved: off the centre line the free wave has slipped less. Where the phase of the
    shortest wave differs little over the lines that friction comes from, it is interpolated.
    """
    return abs(velocity_ratio - 1.0) * float(spectrum.qx[-1]) * 0.5 * FRICTION_LINES**2 > BENDING


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
    ) -> Transfer:
        """Of a tile in a contact with M, L, from a table over |q| and direction."""
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
        slip = 0.0 if bent else velocity_ratio - 1.0
        behind = np.exp(1j * kx * slip * (np.sqrt(1.0 - OFF_CENTRE**2) - 1.0))
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


@dataclass(frozen=True, slots=True)
class Waves:
    """Film (less by) and pressure (more by) of driven and free waves as tiles.

    Attributes
    ----------
    driven
        Per station (nx, ny/stride, 2): film, pressure.
    free
        Per station (REFINEMENT nx, ny/stride, 2).
    off_centre
        What OFF_CENTRE adds to the free waves (REFINEMENT nx, ny/stride, 2).
    stride
        Every so many-th column of the tile is there. Single precision is enough for waves.
    bent
        As in :class:`Transfer`.
    """

    driven: list[Array]
    free: list[Array]
    off_centre: Array | None
    stride: int
    bent: bool

    @classmethod
    def of(
        cls,
        spectrum: Spectrum,
        transfer: Transfer,
        central_film: float,
        stride: int = 1,
    ) -> Waves:
        """Make the tiles of all waves in a contact with a film H_c [a^2/R]."""
        k = stiffness(spectrum.q) * edge_gain(
            spectrum.qx[:, np.newaxis], spectrum.qy[np.newaxis, :], central_film
        )
        # a linear interpolation between the points dims a wave by this on average
        step = spectrum.qx * (np.pi / REFINEMENT / spectrum.qx[-1])
        bright = (1.0 / (1.0 - np.square(step) / 12.0))[:, np.newaxis]

        def tiles(t: Complex, pressure: Complex, refinement: int) -> Array:
            kept = (
                spectrum.tile(factor, refinement, stride, np.complex64) for factor in (t, pressure)
            )
            return np.stack(list(kept), axis=-1)

        def free(t: Complex) -> Array:
            return tiles(t * bright, -k * (t * bright), REFINEMENT)

        return cls(
            [tiles(t, k * (1.0 - t), 1) for t in transfer.driven],
            [free(t) for t in transfer.free],
            None if transfer.off_centre is None else free(transfer.off_centre),
            stride,
            transfer.bent,
        )
