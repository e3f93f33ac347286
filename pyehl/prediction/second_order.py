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
for every b.

What the inlet makes of second order was not derived but measured, in the fields of simulations
(docs/evidence/fields). The lubricant carries it at the mean velocity, as it does the free
wave: a pressure INLET_PRESSURE P0^2, P0 the pressure of first order that the waves would have
where they are if they had not slipped since the inlet. With slip P0 is less and less like P1: only
its part along P1^2, (<P0 P1>/s^2)^2 INLET_PRESSURE, is added to gamma. And the film regains
INLET_FILM t1^2/H of its loss t1. So it is nearly H exp(-t1/H), which it follows where the loss is
most of the film, too (docs/evidence/thin_film): :func:`film_left`.

Of two rough surfaces P1 holds the waves of both, and the sum the pairs of one wave of
each, too: they meet in all positions, so that no product of two has a mean.

Lengths along the surface are scaled by a, heights by a^2/R, pressures by p_h.
"""

from collections.abc import Sequence

import numpy as np

from pyehl.prediction.spectrum import WaveTable, coarsened
from pyehl.theory.transport import Zone, stiffness
from pyehl.types import Array, Complex

INLET_PRESSURE = 0.5
"""Pressure of second order that the inlet makes, over the square of that of first order [1/p_h]."""
INLET_FILM = 0.4
"""Film of second order that the inlet makes, over the square of the loss of first order, both over
the smooth film [-]."""

FILM_ENDS = 1.6
"""Loss of first order over the smooth film at which no full film is predicted [-]: films hold at
1.2 and 1.35, and fine grids have none at 1.8 (docs/evidence/thin_film)."""

# Loss over the film up to which the film of second order is taken; beyond it falls as an
# exponential that goes on from there
QUADRATIC = 0.6
_LEFT = 1.0 - QUADRATIC + INLET_FILM * QUADRATIC**2
_RATE = (1.0 - 2.0 * INLET_FILM * QUADRATIC) / _LEFT

# How often the table of the response is coarsened for the pairs of its waves: once, in place of
# twice, changes mu_r/mu_s of Table 1 by 0.01 % and takes 16 times as long
COARSER = 2


def film_left(loss: Array) -> Array:
    """Film over the smooth one that a loss of first order, over the smooth film, leaves [-]."""
    beyond = np.maximum(loss - QUADRATIC, 0.0)
    near = np.minimum(loss, QUADRATIC)
    return np.asarray((1.0 - near + INLET_FILM * np.square(near)) * np.exp(-_RATE * beyond))


def loss_at(film: Array) -> Array:
    """Loss of first order that leaves a film, both over the smooth film: `film_left` inverted.

    A film that is not positive asks for an infinite one.
    """
    with np.errstate(divide="ignore"):
        beyond = -np.log(np.clip(film, 0.0, _LEFT) / _LEFT) / _RATE
    root = np.sqrt(np.maximum(0.0, 1.0 - 4.0 * INLET_FILM * (1.0 - np.maximum(film, _LEFT))))
    return np.asarray((1.0 - root) / (2.0 * INLET_FILM) + beyond)


class SecondOrder:
    """gamma and s^2 of any surfaces on some tiles, from the response of the contact to their waves.

    At ascending stations X (n,) [a] of the smooth contact `zone`, for each tile: T of the waves of
    its table (n, m), their pressure over roughness (n, m) [p_h R/a^2], and that which they would
    have if they had not slipped since the inlet.
    """

    def __init__(
        self,
        zone: Zone,
        stations: Array,
        tables: Sequence[WaveTable],
        ratios: Sequence[Complex],
        pressures: Sequence[Complex],
        carried: Sequence[Complex],
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
        t, pressure, earlier = (
            np.concatenate([coarsened(part, COARSER) for part in parts], axis=1)
            for parts in (ratios, pressures, carried)
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
        # nothing in it, nothing of second order
        return sums / np.where(variance > 0.0, variance, 1.0) ** 2, variance
