# SPDX-License-Identifier: BSD-3-Clause
"""The Fourier components of a rough tile.

Units: lengths along the surface by a, heights by a^2/R.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from pyehl.errors import InputError
from pyehl.prediction.options import FIRST_POSITIONS
from pyehl.surfaces import MAX_PIXELS, Topography, resampled
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Array, Complex, Indices

WORKING_PIXELS = 48
"""Pixels per semi-axis below which a coarse map is interpolated."""


@dataclass(frozen=True, slots=True)
class Spectrum:
    """The Fourier components of a tile with qx >= 0."""

    values: Complex  # (nx//2 + 1, ny) [a^2/R], of the transform without factors, the mean left out
    # (nx//2 + 1,) and (ny,) [1/a]
    qx: Array
    qy: Array
    shape: tuple[int, int]  # (nx, ny)
    q: Array = field(init=False, repr=False)  # |q| (nx//2 + 1, ny) [1/a]

    @classmethod
    def of(cls, heights: Array, length_x: float, length_y: float) -> Spectrum:
        """Of heights (nx, ny) [a^2/R] on a tile of a size [a]."""
        nx, ny = heights.shape
        values = np.fft.fft(np.fft.rfft(heights, axis=0), axis=1)
        values[0, 0] = 0.0
        qx = 2.0 * np.pi * np.fft.rfftfreq(nx, length_x / nx)
        qy = 2.0 * np.pi * np.fft.fftfreq(ny, length_y / ny)
        return cls(values, qx, qy, (nx, ny))

    def __post_init__(self) -> None:
        """Keep |q|, which all that follows asks for."""
        q = np.hypot(self.qx[:, np.newaxis], self.qy[np.newaxis, :])
        object.__setattr__(self, "q", q)

    def single(self) -> Spectrum:
        """Return the same in single precision."""
        return replace(self, values=self.values.astype(np.complex64))

    @property
    def pixel(self) -> tuple[float, float]:
        """Size of a pixel along x and y [a]."""
        nx, ny = self.shape
        return 2.0 * np.pi / (self.qx[1] * nx), 2.0 * np.pi / (self.qy[1] * ny)

    def longest(self, nx: int, ny: int) -> tuple[Indices, Indices]:
        """Rows and columns of `values` that a tile of nx x ny pixels, no more than here, has."""
        columns = np.rint(np.fft.fftfreq(ny, 1.0 / ny)).astype(np.int_) % self.shape[1]
        return np.arange(nx // 2 + 1), columns

    def kept(self, index: tuple[Indices, Indices], shape: tuple[int, int]) -> Spectrum:
        """Return the components at rows and columns of `values` as a tile of fewer pixels."""
        values = self.values[np.ix_(*index)] * (shape[0] * shape[1] / np.prod(self.shape))
        return Spectrum(values, self.qx[index[0]], self.qy[index[1]], shape)

    def tile(
        self,
        factor: NDArray[np.complexfloating[Any, Any]] | Array,
        refinement: int = 1,
        stride: int = 1,
        lines: NDArray[np.complexfloating[Any, Any]] | None = None,
    ) -> Array:
        """Heights (refinement nx, ny/stride) of the tile with its components times a factor.

        In the precision of both. With `lines`, (ny, n), what :meth:`on_lines` gives, on
        these, (refinement nx, n).
        """
        found = self.along(factor, refinement, stride, lines)
        return np.asarray(np.fft.irfft(found, n=self.shape[0] * refinement).T)

    def along(
        self,
        factor: NDArray[np.complexfloating[Any, Any]] | Array,
        refinement: int = 1,
        stride: int = 1,
        lines: NDArray[np.complexfloating[Any, Any]] | None = None,
    ) -> NDArray[np.complexfloating[Any, Any]]:
        """Waves along the motion (n, nx//2 + 1) on each column or line of :meth:`tile`.

        In order, as for a transform of refinement nx heights.
        """
        nx, ny = self.shape
        part = self.values * factor
        if nx % 2 == 0:
            # the shortest wave of an even number of pixels has no phase of its own
            part[-1] = self.values[-1] * np.real(factor[-1])
            part[-1] *= 0.5 if refinement > 1 else 1.0
        if lines is not None:
            return np.asarray((lines.T @ part.T) * (refinement / ny))
        if stride > 1:
            # on every so many-th column waves that differ by its wavenumber are one
            part = part.reshape(part.shape[0], stride, -1).sum(axis=1)
        across = np.ascontiguousarray(np.fft.ifft(part, axis=1).T)
        across *= refinement / stride
        return across

    def on_lines(self, y: Array) -> NDArray[np.complexfloating[Any, Any]]:
        """Waves across the motion (ny, n) at places Y (n,) [a], in the precision of the values."""
        return np.exp(1j * np.outer(self.qy, y)).astype(self.values.dtype)

    def share_below(self, length: float) -> float:
        """Share of the variance in waves shorter than a length [a], 0 where it is rounding."""
        power = self.power
        # a flat surface has none
        share = float(power[self.q > 2.0 * np.pi / length].sum() / (power.sum() or 1.0))
        return share if share > 1e-24 else 0.0

    @property
    def power(self) -> Array:
        """Mean square of each component and its conjugate (nx//2 + 1, ny) [a^4/R^2]."""
        power = np.square(np.abs(self.values)) / np.prod(self.shape, dtype=float) ** 2
        # components with 0 < qx < Nyquist stand for two
        power[1 : (self.shape[0] + 1) // 2] *= 2.0
        return cast(Array, power)


def _fewer_pixels(pixels: int, length: float, limit: float, semi_axis: float) -> int:
    """Pixels for waves below a limit [1/a] in a contact, as a mean over a few positions takes them.

    Of a tile of a length [a] that has so many, along a semi-axis of the contact [a].
    """
    if math.isinf(limit):
        return pixels
    highest = int(limit * length / (2.0 * math.pi))
    few = max(2 * highest + 2, math.ceil(WORKING_PIXELS * length / semi_axis))
    few = FIRST_POSITIONS * math.ceil(few / FIRST_POSITIONS)
    return few if few < pixels else pixels


def longer_waves(
    spectrum: Spectrum, limit: float, ellipticity: float
) -> tuple[Spectrum, tuple[Indices, Indices]]:
    """Waves of a tile with |q| below a limit [1/a] on as few pixels as they need.

    And the rows and columns that are left of the spectrum.
    """
    axes = 1.0, ellipticity
    nx, ny = (
        _fewer_pixels(n, pixel * n, limit, axis)
        for n, pixel, axis in zip(spectrum.shape, spectrum.pixel, axes, strict=True)
    )
    index = spectrum.longest(nx, ny)
    part = spectrum.kept(index, (nx, ny))
    part.values[part.q >= limit] = 0.0
    return part, index


def working_grid(topography: Topography, operating: OperatingPoint, positions: int) -> Topography:
    """Return the tile on a grid that resolves the contact and has room for the positions.

    InputError if that takes too many pixels.
    """
    nx, ny = topography.shape
    finest = operating.hertz_radius / WORKING_PIXELS, operating.semi_axis_y / WORKING_PIXELS
    want_x = max(nx, math.ceil(topography.length_x / finest[0]))
    want_y = max(ny, math.ceil(topography.length_y / finest[1]))
    multiple = positions or FIRST_POSITIONS * 4
    want_x = multiple * math.ceil(want_x / multiple)
    if want_x * want_y > MAX_PIXELS:
        raise InputError(
            f"{topography.origin}: a tile of {topography.length_x:.3g} x "
            f"{topography.length_y:.3g} m would need {want_x} x {want_y} pixels to resolve a "
            f"contact of radius {operating.hertz_radius:.3g} m; cut a part out of it"
        )
    return resampled(topography, (want_x, want_y))
