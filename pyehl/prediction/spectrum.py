# SPDX-License-Identifier: BSD-3-Clause
"""The Fourier components of rough tiles, a table over wavenumber and direction, sums of two tiles.

Units: lengths along the surface by a, heights by a^2/R.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from numpy.typing import NDArray

from pyehl.errors import InputError
from pyehl.surfaces import MAX_PIXELS, Topography, resampled, shifted
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Array, Complex, Indices

if TYPE_CHECKING:
    from pyehl.prediction.rough_contact import Response

FIRST_POSITIONS = 8
"""Fewest positions of a tile in a passage, and those of a mean over a few."""
MAX_POSITIONS = 4096
"""Most positions of a passage, as the schema of cases has it."""
SAME = 1e-9
"""Relative difference of two lengths or times that is none."""
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
        """Keep |q|, which all that follows needs."""
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


# Wavenumbers and directions: the interpolated T is right to 1e-3. Both are odd, and so are those of
# the coarse tables, which every second one makes
TABLE = (73, 25)
# Components that are interpolated at a time: few enough to stay in the cache
BLOCK = 1 << 12


def coarsened(values: NDArray[Any], times: int) -> NDArray[Any]:
    """Values of a table (..., m) at the places of a coarse one (..., l)."""
    step = 2**times
    whole = values.reshape(*values.shape[:-1], *TABLE)
    return whole[..., ::step, ::step].reshape(*values.shape[:-1], -1)


class WaveTable:
    """Wavenumbers at which a response is taken, kx, ky (m,) [1/a], and the way to a tile."""

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
        """Sum what the components of a tile have, at the places of a coarse table, (l,).

        Weighted as for a linear interpolation between them. `times`: how often every second
        wavenumber and direction is left out.
        """
        half = self._shape[1]
        folded = power[:, :half].copy()
        folded[:, 1 : power.shape[1] - half + 1] += power[:, half:][:, ::-1]
        sums = np.bincount(self._nearest, folded.ravel(), self.kx.size)
        found: Array = np.asarray(sums, dtype=np.float64).reshape(TABLE)
        for _ in range(2 * times):
            between = 0.5 * found[1::2]
            found = found[::2].copy()
            found[:-1] += between
            found[1:] += between
            found = found.T
        return found.ravel()

    def coarse(self, times: int = 1) -> tuple[Array, Array]:
        """Wavenumbers of a coarse table, (l,) each."""
        kx, ky = (coarsened(values, times) for values in (self.kx, self.ky))
        return kx, ky

    def spread(self, **tables: Sequence[Complex]) -> dict[str, list[Complex]]:
        """Interpolate tables (m,), by names, to all components, linear in log |q| and direction."""
        in_all = [table for part in tables.values() for table in part]
        values = np.stack(in_all, axis=-1).view(np.float64)
        found = [np.empty((self._shape[0], self._mirror.size), dtype=complex) for _ in in_all]
        width = self._shape[1]
        step = max(1, BLOCK // width)
        for first in range(0, self._shape[0], step):
            part = slice(first * width, (first + step) * width)
            spread = _between(values, self._rows[part], self._columns[part]).view(np.complex128)
            for k, out in enumerate(found):
                out[first : first + step] = spread[:, k].reshape(-1, width)[:, self._mirror]
        each = iter(found)
        return {name: [next(each) for _ in part] for name, part in tables.items()}


def _between(values: Array, row: Array, column: Array) -> Array:
    """Interpolate a table (m, k) bilinearly at places (n,): (n, k)."""
    i, j = (
        np.minimum(place.astype(np.int32), size - 2)
        for place, size in zip((row, column), TABLE, strict=True)
    )
    # what rounding puts beyond the last column is on it
    u, v = row - i, np.minimum(column - j, 1.0)
    at = i * np.int32(TABLE[1]) + j
    found = values[at] * ((1.0 - u) * (1.0 - v))[:, np.newaxis]
    for step, weight in ((1, (1.0 - u) * v), (TABLE[1], u * (1.0 - v)), (TABLE[1] + 1, u * v)):
        found += values[at + step] * weight[:, np.newaxis]
    return found


SECOND = "second_"
"""Before the names of what belongs to the second surface."""
MOST_TILES = 12
"""Tiles beside each other, along one way, that are added to those of the other surface, as many as
passages of a common period (:data:`pyehl.prediction.relative_positions.MOST_PASSAGES`)."""


def arrays(tile: Topography, response: Response, prefix: str = "") -> dict[str, Array]:
    """Coordinates (nx,), (ny,) [m], heights [m] and response (nx, ny) of a surface."""
    nx, ny = tile.shape
    found = {
        "x": np.arange(nx, dtype=float) * tile.pixel[0],
        "y": np.arange(ny, dtype=float) * tile.pixel[1],
        "surface": np.asfortranarray(tile.heights),
        "deformed": np.asfortranarray(response.deformed),
        "delta_p": np.asfortranarray(response.pressure),
    }
    return {prefix + name: values for name, values in found.items()}


def statistics(tile: Topography, response: Response, prefix: str = "") -> dict[str, Any]:
    """Numbers of a surface that a summary holds."""
    made = tile.preparation
    found = {
        "surface": tile.origin,
        "surface_preparation": made.record.summary if made else None,
        "seed": tile.seed,
        "pixels": list(tile.shape),
        "length_x_m": tile.length_x,
        "length_y_m": tile.length_y,
        "rms_height_m": tile.rms_height,
        "rms_deformed_m": float(np.std(response.deformed)),
        "rms_pressure_Pa": float(np.std(response.pressure)),
    }
    return {prefix + name: value for name, value in found.items()}


@dataclass(frozen=True, slots=True)
class Together:
    """The sum of two surfaces that move together."""

    tile: Topography  # undeformed
    deformed_rms: float  # [m]


def second_summary(
    tiles: Sequence[Topography],
    response: Response,
    velocity_ratio: float,
    together: Topography | None,
) -> dict[str, Any]:
    """Return what a summary holds of the second of two surfaces, and of both.

    `together`: their sum where they move so.
    """
    slopes = [_slope(tile) for tile in tiles]
    return {
        "second_velocity_ratio": velocity_ratio,
        **statistics(tiles[1], response, SECOND),
        "surface_rms_m": composite_rms(tiles, together),
        "surface_slope": _slope(together) if together else math.hypot(*slopes),
        "surface_correlation": correlation(tiles[0], tiles[1], together),
    }


def findings_of(tiles: Sequence[Topography]) -> str | None:
    """Name what the maps have that is no roughness; None if there is nothing."""
    kinds = [
        finding.kind
        for tile in tiles
        if tile.preparation is not None
        for finding in tile.preparation.record.findings
    ]
    return ", ".join(dict.fromkeys(kinds)) or None


def composite_rms(tiles: Sequence[Topography], together: Topography | None = None) -> float:
    """Rms height [m] of one or two surfaces: of their sum where they move `together`.

    Else that of surfaces that have nothing in common, as in the mean over all positions.
    """
    if together is None and len(tiles) == 1:
        return tiles[0].rms_height
    return together.rms_height if together else math.hypot(*(tile.rms_height for tile in tiles))


def correlation(first: Topography, second: Topography, together: Topography | None) -> float:
    """Correlation of the heights of two surfaces that move `together`; NaN where they do not."""
    product = first.rms_height * second.rms_height
    if together is None or product == 0.0:
        return math.nan
    squares = first.rms_height**2 + second.rms_height**2
    return (together.rms_height**2 - squares) / (2.0 * product)


def _slope(tile: Topography) -> float:
    """Rms slope [-]."""
    waves = Spectrum.of(tile.heights, *tile.size)
    return math.sqrt(float((np.square(waves.q) * waves.power).sum()))


def sum_of(
    groups: Sequence[Mapping[str, Any]], tiles: Sequence[Topography], hertz_radius: float
) -> Topography | None:
    """Return the sum of the tiles of two groups of a case; None where they do not move together."""
    one, two = groups
    if float(one["velocity_ratio"]) != float(two["velocity_ratio"]):
        return None
    way = float(two["x_start"]) - float(one["x_start"])
    return merged(tiles[0], tiles[1], way * hertz_radius)


def merged(first: Topography, second: Topography, ahead: float) -> Topography | None:
    """Return a tile with the heights of two, the second one ahead by a way [m] along the motion.

    It holds whole tiles of both. None: not so few of both are as long, or they have too many
    pixels.
    """
    if ahead != 0.0:
        second = shifted(second, ahead)
    counts = [Fraction(b / a) for a, b in zip(first.size, second.size, strict=True)]
    counts = [ratio.limit_denominator(MOST_TILES) for ratio in counts]
    for ratio, a, b in zip(counts, first.size, second.size, strict=True):
        if ratio.numerator > MOST_TILES or not math.isclose(ratio * a, b, rel_tol=SAME):
            return None
    nx, ny = (
        max(ratio.numerator * m, ratio.denominator * n)
        for ratio, m, n in zip(counts, first.shape, second.shape, strict=True)
    )
    if nx * ny > MAX_PIXELS:
        return None
    first = _repeated(first, [ratio.numerator for ratio in counts])
    second = _repeated(second, [ratio.denominator for ratio in counts])
    heights = resampled(first, (nx, ny)).heights + resampled(second, (nx, ny)).heights
    return Topography(heights, first.size, f"{first.origin} and {second.origin}")


def _repeated(tile: Topography, times: Sequence[int]) -> Topography:
    """Return so many of a tile beside each other along x and y."""
    size = tile.length_x * times[0], tile.length_y * times[1]
    return replace(tile, heights=np.tile(tile.heights, times), size=size)
