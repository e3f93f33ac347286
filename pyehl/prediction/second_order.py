# SPDX-License-Identifier: BSD-3-Clause
"""Pressure of second order in the roughness: a lubricant that is pressed harder yields less.

A column of lubricant keeps its mass rho(P) (H - t) on its way through the contact. For a pressure
P1 and a loss of film t1 of first order, with c = d ln rho/dP, r = (d^2 rho/dP^2)/rho and C = K H c,
the pressure of second order that keeps it is

    P2 = K/(1 + C) (c P1 t1 - r/2 H P1^2),

K/(1 + C) taken wave by wave: the products hold sums and differences of the wavenumbers. No constant
in it is fitted. In place of the convolution the friction takes P2 = gamma (P1^2 - s^2) point by
point; s^2 is the variance of P1 and

    gamma s^4 = sum over all pairs of waves of K/(1 + C) at q + q' and q - q', times
                (c <P1 t1>' - r/2 H <P1^2>') <P1^2> of the two.

For Gaussian P1 the mean of P2 exp(b P1), and with it the friction, is then that of the convolution
for every b. Of two rough surfaces P1 holds the waves of both, and the sum the pairs of one wave of
each, too: they meet in all positions, so that no product of two has a mean.

Lengths along the surface are scaled by a, heights by a^2/R, pressures by p_h.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from pyehl.prediction.wave_table import WaveTable, coarsened
from pyehl.theory.transport import Zone, stiffness

__all__ = ["SecondOrder"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

# How often the table of the response is coarsened for the pairs of its waves
COARSER = 2


class SecondOrder:
    """gamma and s^2 of any surfaces on some tiles, from the response of the contact to their waves.

    At ascending stations X (n,) [a] of the smooth contact `zone`, for each tile: T of the waves of
    its table (n, m), and their pressure over roughness (n, m) [p_h R/a^2].
    """

    def __init__(
        self,
        zone: Zone,
        stations: Array,
        tables: Sequence[WaveTable],
        ratios: Sequence[Complex],
        pressures: Sequence[Complex],
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
        t, pressure = (
            np.concatenate([coarsened(part, COARSER) for part in parts], axis=1)
            for parts in (ratios, pressures)
        )
        self._squared = np.abs(pressure) ** 2
        mixed = (pressure * np.conj(t)).real
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
        # nothing in it, nothing of second order
        return sums / np.where(variance > 0.0, variance, 1.0) ** 2, variance
