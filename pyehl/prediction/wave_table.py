# SPDX-License-Identifier: BSD-3-Clause
"""A table over wavenumber and direction, and the way between it and the components of a tile."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pyehl.prediction.spectrum import Spectrum
from pyehl.types import Array, Complex

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
