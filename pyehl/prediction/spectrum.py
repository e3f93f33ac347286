# SPDX-License-Identifier: BSD-3-Clause
"""The Fourier components of rough tiles, a table over wavenumber and direction, and bands.

Units: lengths along the surface by a, heights by a^2/R.
"""

from __future__ import annotations

import copy
import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from pyehl.errors import InputError
from pyehl.surfaces import MAX_PIXELS, Topography, resampled
from pyehl.theory.line_contact import AnyContact
from pyehl.types import Array, Complex, Indices, Mask

FIRST_POSITIONS = 8
"""Minimum number of positions of a tile in a passage, also for a mean over a few positions."""
MAX_POSITIONS = 4096
"""Maximum number of positions in a passage, as in the range of psd.positions."""
WORKING_PIXELS = 48
"""Pixels per semi-axis below which a coarse map is interpolated."""


@dataclass(frozen=True, slots=True)
class Spectrum:
    """The Fourier components of a tile with qx >= 0."""

    values: Complex  # (nx//2 + 1, ny) [a^2/R], transform without factors, zero mean
    # (nx//2 + 1,) and (ny,) [1/a]
    qx: Array
    qy: Array
    shape: tuple[int, int]  # (nx, ny)
    q: Array = field(init=False, repr=False)  # |q| (nx//2 + 1, ny) [1/a]
    filled: int = field(init=False)  # number of rows of `values` before those that are zero

    @classmethod
    def of(cls, heights: Array, length_x: float, length_y: float) -> Spectrum:
        """Transform heights (nx, ny) [a^2/R] on a tile of a size [a]."""
        nx, ny = heights.shape
        values = np.fft.fft(np.fft.rfft(heights, axis=0), axis=1)
        values[0, 0] = 0.0
        qx = 2.0 * np.pi * np.fft.rfftfreq(nx, length_x / nx)
        qy = 2.0 * np.pi * np.fft.fftfreq(ny, length_y / ny)
        return cls(values, qx, qy, (nx, ny))

    def __post_init__(self) -> None:
        """Compute |q| once."""
        q = np.hypot(self.qx[:, np.newaxis], self.qy[np.newaxis, :])
        object.__setattr__(self, "q", q)
        object.__setattr__(self, "filled", self.qx.size)

    def single(self) -> Spectrum:
        """Return the same in single precision."""
        result = copy.copy(self)
        object.__setattr__(result, "values", self.values.astype(np.complex64))
        return result

    def below(self, limit: float) -> Spectrum:
        """Return the components with |q| below a limit [1/a]; the others are zero."""
        result = copy.copy(self)
        object.__setattr__(result, "values", np.where(self.q < limit, self.values, 0.0))
        object.__setattr__(result, "filled", int(np.count_nonzero(self.qx < limit)))
        return result

    @property
    def pixel(self) -> tuple[float, float]:
        """Size of a pixel along x and y [a]."""
        nx, ny = self.shape
        return 2.0 * np.pi / (self.qx[1] * nx), 2.0 * np.pi / (self.qy[1] * ny)

    def longest(self, nx: int, ny: int) -> tuple[Indices, Indices]:
        """Rows and columns of `values` that a tile of nx x ny pixels contains."""
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

        `factor` (nx//2 + 1, ny); the heights are in the precision of it and of the components.
        With a `stride`, every stride-th column. With `lines` (ny, n), the result of
        :meth:`on_lines`, on these lines: (refinement nx, n).
        """
        result = self.along(factor, refinement, stride, lines)
        return np.asarray(np.fft.irfft(result, n=self.shape[0] * refinement).T)

    def along(
        self,
        factor: NDArray[np.complexfloating[Any, Any]] | Array,
        refinement: int = 1,
        stride: int = 1,
        lines: NDArray[np.complexfloating[Any, Any]] | None = None,
    ) -> NDArray[np.complexfloating[Any, Any]]:
        """Waves along the motion (n, nx//2 + 1) on each column or line of :meth:`tile`.

        Scaled for an inverse transform to refinement nx heights. On columns without those of
        rows that are zero, which the transform adds.
        """
        nx, ny = self.shape
        rows = self.filled if lines is None else self.qx.size
        part = self.values[:rows] * factor[:rows]
        if nx % 2 == 0 and rows == self.qx.size:
            # the shortest wave of an even number of pixels has no phase
            part[-1] = self.values[-1] * np.real(factor[-1])
            part[-1] *= 0.5 if refinement > 1 else 1.0
        if lines is not None:
            return np.asarray((lines.T @ part.T) * (refinement / ny))
        if stride > 1:
            # aliasing: waves that differ by the wavenumber of the stride are equal on its columns
            part = part.reshape(part.shape[0], stride, -1).sum(axis=1)
        across = np.ascontiguousarray(np.fft.ifft(part, axis=1).T)
        across *= refinement / stride
        return across

    def on_lines(self, y: Array) -> NDArray[np.complexfloating[Any, Any]]:
        """Waves across the motion (ny, n) at places Y (n,) [a], in the precision of the values."""
        return np.exp(1j * np.outer(self.qy, y)).astype(self.values.dtype)

    def share_below(self, length: float) -> float:
        """Share of the variance in waves shorter than a length [a]; rounding errors count as 0."""
        power = self.power
        # a flat surface has none
        share = float(power[self.q > 2.0 * np.pi / length].sum() / (power.sum() or 1.0))
        return share if share > 1e-24 else 0.0

    def amplitudes(self, i: Indices, j: Indices, factor: Complex | float = 1.0) -> Complex:
        """Amplitudes (m,) [a^2/R] of the waves at rows and columns of `values`, times a factor."""
        nx, ny = self.shape
        # a component includes its conjugate at -q, unless the half spectrum contains both
        twice = np.where((i == 0) | ((nx % 2 == 0) & (i == nx // 2)), 1.0, 2.0)
        return np.asarray(twice * self.values[i, j] * factor / (nx * ny))

    @property
    def power(self) -> Array:
        """Mean square of each component and its conjugate (nx//2 + 1, ny) [a^4/R^2]."""
        power = np.square(np.abs(self.values)) / np.prod(self.shape, dtype=float) ** 2
        # components with 0 < qx < Nyquist include their conjugates
        power[1 : (self.shape[0] + 1) // 2] *= 2.0
        return cast(Array, power)


def _fewer_pixels(pixels: int, length: float, limit: float, semi_axis: float) -> int:
    """Give the pixels that waves below a limit [1/a] need for a mean over few positions.

    For a tile of a length [a] with `pixels` pixels, along a semi-axis of the contact [a].
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
    """Waves of a tile with |q| below a limit [1/a], on as few pixels as they need.

    Also the rows and columns of the spectrum that remain. `ellipticity`: semi-axis of the contact
    across the motion over a.
    """
    axes = 1.0, ellipticity
    nx, ny = (
        _fewer_pixels(n, pixel * n, limit, axis)
        for n, pixel, axis in zip(spectrum.shape, spectrum.pixel, axes, strict=True)
    )
    index = spectrum.longest(nx, ny)
    return spectrum.kept(index, (nx, ny)).below(limit), index


def working_grid(topography: Topography, operating: AnyContact, positions: int) -> Topography:
    """Return the tile on a grid that resolves the contact.

    Its pixels along x are a multiple of `positions`, 0: of a default.

    InputError if that takes too many pixels.
    """
    nx, ny = topography.shape
    finest = (
        operating.hertz_radius / WORKING_PIXELS,
        (operating.hertz_radius * operating.ellipse.side / WORKING_PIXELS),
    )
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


# Numbers of wavenumbers and directions: the interpolated response T, deformed over undeformed
# amplitude, has an error of 1e-3. Both are odd, as are those of the coarse tables, which have every
# second one
TABLE = (73, 25)
# Number of components that are interpolated at a time, which fit into the cache
BLOCK = 1 << 12


def coarsened(values: NDArray[Any], times: int) -> NDArray[Any]:
    """Values of a table (..., m) at the entries of a coarse table (..., l)."""
    step = 2**times
    whole = values.reshape(*values.shape[:-1], *TABLE)
    return whole[..., ::step, ::step].reshape(*values.shape[:-1], -1)


class WaveTable:
    """Wavenumbers kx, ky (m,) [1/a] of a table of the response, and its interpolation to a tile."""

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

    def gathered(self, power: Array, times: int = 1) -> Array:
        """Sum the powers of the components of a tile at the entries of a coarse table, (l,).

        `power` (nx//2 + 1, ny). Each component counts at the nearest entry of the fine table; those
        are weighted as in a linear interpolation between the coarse ones. `times`: number of
        coarsenings, each of which omits every second wavenumber and direction.
        """
        half = self._shape[1]
        folded = power[:, :half].copy()
        folded[:, 1 : power.shape[1] - half + 1] += power[:, half:][:, ::-1]
        sums = np.bincount(self._nearest, folded.ravel(), self.kx.size)
        result: Array = np.asarray(sums, dtype=np.float64).reshape(TABLE)
        for _ in range(2 * times):
            between = 0.5 * result[1::2]
            result = result[::2].copy()
            result[:-1] += between
            result[1:] += between
            result = result.T
        return result.ravel()

    def coarse(self, times: int = 1) -> tuple[Array, Array]:
        """Wavenumbers of a coarse table, (l,) each."""
        kx, ky = (coarsened(values, times) for values in (self.kx, self.ky))
        return kx, ky

    def spread(self, **tables: Sequence[Complex]) -> dict[str, list[Complex]]:
        """Interpolate tables (m,), by names, to all components, linear in log |q| and direction."""
        in_all = [table for part in tables.values() for table in part]
        values = np.stack(in_all, axis=-1).view(np.float64)
        result = [np.empty((self._shape[0], self._mirror.size), dtype=complex) for _ in in_all]
        width = self._shape[1]
        step = max(1, BLOCK // width)
        for first in range(0, self._shape[0], step):
            part = slice(first * width, (first + step) * width)
            spread = _between(values, self._rows[part], self._columns[part]).view(np.complex128)
            for k, out in enumerate(result):
                out[first : first + step] = spread[:, k].reshape(-1, width)[:, self._mirror]
        each = iter(result)
        return {name: [next(each) for _ in part] for name, part in tables.items()}


def _between(values: Array, row: Array, column: Array) -> Array:
    """Interpolate a table (m, k) bilinearly at positions (n,): (n, k)."""
    i, j = (
        np.minimum(place.astype(np.int32), size - 2)
        for place, size in zip((row, column), TABLE, strict=True)
    )
    # positions beyond the last column are rounding errors
    u, v = row - i, np.minimum(column - j, 1.0)
    at = i * np.int32(TABLE[1]) + j
    result = values[at] * ((1.0 - u) * (1.0 - v))[:, np.newaxis]
    for step, weight in ((1, (1.0 - u) * v), (TABLE[1], u * (1.0 - v)), (TABLE[1] + 1, u * v)):
        result += values[at + step] * weight[:, np.newaxis]
    return result


# Tolerance with which a wave at the end of an octave belongs to the next one
ROUNDING = 1e-9
# Share of the largest mean square that counts as zero: rounding errors have a share of about 1e-32
NOTHING = 1e-20

# Attributes of a band, and their names in results
BAND_COLUMNS = {
    "longest": "longest_m",
    "shortest": "shortest_m",
    "rms_height": "rms_height_m",
    "rms_deformed": "rms_deformed_m",
    "rms_pressure": "rms_pressure_Pa",
    "increase": "increase",
}


@dataclass(frozen=True, slots=True)
class Band:
    """Contribution of a band of wavelengths."""

    # The band of wavelengths 2 pi/|q| [m]
    longest: float
    shortest: float
    rms_height: float  # of the undeformed roughness in the band [m]
    rms_deformed: float  # of the deformed roughness in the band [m]
    rms_pressure: float  # of delta p in the band [Pa]
    # Increase of mu_r/mu_s when this band is added to all the longer ones [-]; NaN where the model
    # does not hold
    increase: float


def octaves(q: Array, power: Array, *, only: int = 0) -> Iterator[tuple[float, Mask, bool]]:
    """Octaves of wavelengths with roughness, longest first; the last `only`, 0: all.

    `q` is |q| of the components, of any shape and unit, `power` their contributions to the mean
    square height; a share of `NOTHING` of the largest counts as zero, because a harmonic pattern
    has rounding errors in all other octaves. Yields the longest wavelength 2 pi/|q| of the octave,
    the mask of its components, and whether it is the last one.
    """
    lowest = float(q[q > 0.0].min())
    octave = np.full(q.shape, -1)
    octave[q > 0.0] = np.floor(np.log2(q[q > 0.0] / lowest) + ROUNDING).astype(int)
    present = power > NOTHING * power.max()
    filled = [k for k in range(int(octave.max()) + 1) if (present & (octave == k)).any()]
    for k in filled[-only:]:
        yield 2.0 * math.pi / (lowest * 2.0**k), octave == k, k == filled[-1]


def joining(
    waves: tuple[Array, Array, Array, Array],
    below: Callable[[float], float],
    total: float,
    operating: AnyContact,
    *,
    brief: bool,
) -> list[Band]:
    """Return the contribution of each octave added to all longer ones; `brief`: of the last one.

    `waves` are arrays of the same shape: |q| [1/a], mean square height [a^4/R^2], |T| [-] (see
    `TABLE`), pressure over roughness [p_h R/a^2]. `below` gives mu_r/mu_s of the waves with |q|
    below a limit [1/a], `total` is that of all waves.
    """
    q, power, deformed, pressure = waves
    a, film, p_h = operating.hertz_radius, operating.film_scale, operating.hertz_pressure
    result: list[Band] = []
    before = 1.0
    for longest, inside, last in octaves(q, power, only=2 if brief else 0):
        ratio = total if last else below(4.0 * np.pi / longest)
        if brief and not last:
            before = ratio
            continue
        rms = [
            math.sqrt(float((power * np.square(factor))[inside].sum()))
            for factor in (np.ones_like(pressure), deformed, pressure)
        ]
        result.append(
            Band(
                longest=longest * a,
                shortest=0.5 * longest * a,
                rms_height=rms[0] * film,
                rms_deformed=rms[1] * film,
                rms_pressure=rms[2] * p_h,
                increase=ratio - before,
            )
        )
        before = ratio
    return result


def cutoff_error(bands: Sequence[Band]) -> float:
    """Return the magnitude of the contribution of the last octave of wavelengths to mu_r/mu_s [-].

    It depends on the cut-off, and indicates the contribution of waves shorter than those of the
    map. NaN without bands.
    """
    return abs(bands[-1].increase) if bands else math.nan


def records(bands: Sequence[Band]) -> list[dict[str, float]]:
    """Give bands with the names and units of results."""
    return [{name: getattr(band, key) for key, name in BAND_COLUMNS.items()} for band in bands]
