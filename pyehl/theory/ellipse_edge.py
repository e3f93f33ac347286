# SPDX-License-Identifier: BSD-3-Clause
"""Pressure of a wave of roughness on a Hertz ellipse, as :mod:`pyehl.theory.disc` on a circle.

With x and y over the semi-axes, a pressure sum over m of a_m P_lm(z) cos(m theta)/z of one degree l
deflects the ellipse into functions of the same degree (Galin 1953; Johnson 1985, Contact Mechanics,
section 3.3). In Fourier space the ellipse is the disc with a kernel g(phi)/Q, 1/g^2 = cos^2 phi +
sin^2 phi/kappa^2. The integrals of j_l j_l' over Q vanish unless l = l', so each l has a separate
small system of equations, with the harmonics of g. The wavevector enters as Q = (q_x,
kappa q_Y). Lengths are scaled by a, heights by a^2/R_x, pressures by p_h.
"""

import math
from functools import lru_cache

import numpy as np
from numpy.polynomial import chebyshev

from pyehl.theory.disc import (
    DEGREE,
    EDGE_ANGLES,
    MAX_WAVENUMBER,
    NEXT_TO_EDGE,
    RADIUS,
    spherical_bessel,
)
from pyehl.theory.ellipse import Ellipse
from pyehl.types import Array, Complex

# Points along the short axis at which the polynomials are fitted, and angles of the integrals
PLACES = 13
ANGLES = 4096


class EllipseEdge:
    """Effect of the edge of an ellipse on the pressure of long waves, as polynomials.

    Products of Chebyshev polynomials in x/a and y/b. Their degree along the short axis is that of
    the disc; along the long axis it is higher in proportion to the length.
    """

    def __init__(self, shape: Ellipse) -> None:
        self.shape = shape
        kappa = shape.ellipticity
        short = min(1.0, kappa)
        # largest wavenumber on which the edge has an effect [1/a]
        self.largest = MAX_WAVENUMBER / short
        degrees = math.ceil(DEGREE / short), math.ceil(DEGREE * kappa / short)
        i, j = np.meshgrid(*(np.arange(n + 1) for n in degrees), indexing="ij")
        kept = i * degrees[1] + j * degrees[0] <= degrees[0] * degrees[1]
        self._powers = i[kept], j[kept]
        lines = (
            np.linspace(-RADIUS, RADIUS, math.ceil(PLACES * long / short)) for long in (1.0, kappa)
        )
        x, y = (values.ravel() for values in np.meshgrid(*lines, indexing="ij"))
        inside = np.hypot(x, y) <= RADIUS
        self.x, self.y = x, y = x[inside], y[inside]
        self._inverse = np.asarray(np.linalg.pinv(self.functions(x, y).T), dtype=float)
        # over the semi-axes
        largest = self.largest * max(1.0, kappa)
        self._inside = Series(shape, x, y, largest, self._inverse)
        radius = math.sqrt(1.0 - NEXT_TO_EDGE * NEXT_TO_EDGE)
        x, y = radius * np.cos(EDGE_ANGLES), radius * np.sin(EDGE_ANGLES)
        self._at_edge = Series(shape, x, y, largest)

    def functions(self, x: Array, y: Array) -> Array:
        """Polynomials (n, ...) at points x/a and y/b within RADIUS."""
        i, j = self._powers
        along, across = (
            np.moveaxis(chebyshev.chebvander(values / RADIUS, int(powers.max())), -1, 0)
            for values, powers in ((x, i), (y, j))
        )
        return np.asarray(along[i] * across[j])

    def correction(self, qx: Array, qy: Array) -> Complex:
        """Return the pressure of waves (m,) [1/a] on the ellipse minus that on the half-space.

        Coefficients (n, m) of `functions` [p_h per a^2/R_x].
        """
        return self._correction(qx, qy, self._inside.of(qx, qy))

    def _correction(self, qx: Array, qy: Array, series: Complex) -> Complex:
        """Give `correction` from the series inside the ellipse."""
        kappa = self.shape.ellipticity
        local = 0.25 * math.pi / self.shape.kernel_ratio * np.hypot(qx, qy)
        phase = np.outer(self.x, qx) + np.outer(kappa * self.y, qy)
        return np.asarray(series - self._inverse @ (local * np.exp(1j * phase)))

    def displacement(self, qx: Array, qy: Array) -> Complex:
        """Outward displacement of the edge by waves (m,), :func:`pyehl.theory.disc.edge_of_disc`.

        As a fraction of the distance from the centre, at EDGE_ANGLES of (x/a, y/b): (n, m).
        """
        return NEXT_TO_EDGE * self._at_edge.of(qx, qy)

    def both(self, qx: Array, qy: Array) -> tuple[Complex, Complex]:
        """Give `correction` and `displacement`, which share the expansion of the waves."""
        waves = self._inside.expansion(qx, qy)
        correction = self._correction(qx, qy, self._inside.sum(waves))
        return correction, NEXT_TO_EDGE * self._at_edge.sum(waves)


@lru_cache(maxsize=4)
def ellipse_edge(shape: Ellipse) -> EllipseEdge:
    """Return the edge effect of an ellipse; the last few are cached."""
    return EllipseEdge(shape)


class Series:
    """Pressure at points, or a linear function of it, as a sum over the waves of the roughness.

    `part` (k, n) is the matrix of that function of the pressure at points (n,), None for the
    pressure itself; points and q are over the semi-axes, |q| up to `largest`.
    """

    def __init__(
        self, shape: Ellipse, x: Array, y: Array, largest: float, part: Array | None = None
    ) -> None:
        self.shape, self.last = shape, math.ceil(largest) + 12
        z, theta = np.sqrt(1.0 - x * x - y * y), np.arctan2(y, x)
        legendre = _legendre(self.last, np.append(z, 0.0))
        harmonics = _harmonics(shape.ellipticity, self.last)
        self._terms = []
        for n in range(1, self.last + 1):
            orders = np.arange(n % 2, n + 1, 2)
            radial = legendre[n, orders]
            radial = (radial[:, :-1] / radial[:, -1:] / z).T
            together = harmonics[np.add.outer(orders, orders)]
            apart = harmonics[np.abs(np.subtract.outer(orders, orders))]
            for sign, wave in ((1.0, np.cos), (-1.0, np.sin)):
                # there is no sine of order 0
                first = 1 if sign < 0.0 and orders[0] == 0 else 0
                m = orders[first:]
                if m.size:
                    matrix = 0.5 * (apart + sign * together)[first:, first:]
                    there = radial[:, first:] * wave(np.outer(theta, m))
                    there = there if part is None else part @ there
                    self._terms.append((n, m, wave, np.linalg.solve(matrix, there.T).T))

    def of(self, qx: Array, qy: Array) -> Complex:
        """Return it for waves exp(i q r) [a^2/R_x], wavevectors (m,) [1/a]: (k, m) [p_h]."""
        return self.sum(self.expansion(qx, qy))

    def expansion(self, qx: Array, qy: Array) -> tuple[Array, dict[np.ufunc, Array]]:
        """Bessel functions and circular functions of waves (m,): (l, m) each."""
        kappa = self.shape.ellipticity
        q, phi = np.hypot(qx, kappa * qy), np.arctan2(kappa * qy, qx)
        last = min(self.last, math.ceil(float(q.max())) + 12)
        bessel = spherical_bessel(last + 1, q)
        return bessel, {wave: wave(np.outer(np.arange(last + 1), phi)) for wave in (np.cos, np.sin)}

    def sum(self, expansion: tuple[Array, dict[np.ufunc, Array]]) -> Complex:
        """Give the same for an `expansion`."""
        bessel, waves = expansion
        last = bessel.shape[0] - 1
        even, odd = (np.zeros((self._terms[0][3].shape[0], bessel.shape[1])) for _ in range(2))
        for n, m, wave, there in self._terms:
            if n <= last:
                factor = (-1) ** (n // 2) * (2 * n + 1) * bessel[n]
                total = odd if n % 2 else even
                total += (there @ waves[wave][m]) * factor
        return np.asarray(math.pi / self.shape.kernel_ratio * (even + 1j * odd))


def _harmonics(kappa: float, last: int) -> Array:
    """Integrals of g(phi) cos(n phi) over the circle for n up to 2 `last`."""
    phi = 2.0 * math.pi / ANGLES * np.arange(ANGLES)
    g = 1.0 / np.hypot(np.cos(phi), np.sin(phi) / kappa)
    return np.asarray(2.0 * math.pi / ANGLES * np.fft.rfft(g).real[: 2 * last + 1])


def _legendre(last: int, z: Array) -> Array:
    """Orthonormal associated Legendre functions up to degree `last` at z (n,): (l, m, n)."""
    from scipy.special import assoc_legendre_p_all  # noqa: PLC0415 (takes as long to load as pyehl)

    # scipy 1.17 does not normalise them at z = 1
    result = assoc_legendre_p_all(last, last, np.minimum(z, np.nextafter(1.0, 0.0)), norm=True)
    return np.asarray(result[0, :, : last + 1])
