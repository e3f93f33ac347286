# SPDX-License-Identifier: BSD-3-Clause
"""Pressure of a wave of roughness on the strip of a line contact, as :mod:`.disc` on a circle.

A pressure p(X) exp(i k_Y Y) on |X| < 1 deflects the half-space by (1/pi) times the integral of
K_0(|k_Y| |X - X'|) p(X'), of -ln|X - X'| at k_Y = 0 (Johnson 1985, Contact Mechanics, chapter 2).
With p a sum of T_n(X)/sqrt(1 - X^2) the logarithm gives T_n/n, and the rest of the kernel, which is
smooth, is integrated at Chebyshev points: each k_Y has a small system of equations. At k_Y = 0 the
load per length is fixed, so that there is no T_0. Lengths are scaled by the half-width b, heights
by b^2/R, pressures by p_h; the half-space then has the stiffness |q|.
"""

import math
from collections.abc import Iterator

import numpy as np
from numpy.polynomial import chebyshev

from pyehl.theory.disc import MAX_WAVENUMBER, RADIUS
from pyehl.types import Array, Complex, Indices

DEGREE = 10
"""Degree of the polynomials in X."""
PLACES = 41
"""Points at which the polynomials are fitted."""
NODES = 256
"""Number of Chebyshev points of the integrals."""
PER_WAVE = 16
"""Intervals along an edge per shortest wavelength across the motion."""
ORDERS = math.ceil(MAX_WAVENUMBER) + 12
"""Highest order n: those above are negligible in a plane wave up to MAX_WAVENUMBER."""


class StripEdge:
    """Effect of the edges of a strip on the pressure of long waves.

    Represented by products of polynomials in X and waves across the motion with wavenumbers |k_Y|
    (m,) [1/b] and the common period `width` [b].
    """

    largest = MAX_WAVENUMBER
    """Largest wavenumber that an edge affects [1/b]."""

    def __init__(self, across: Array, width: float) -> None:
        self.across, self.width = np.asarray(across, dtype=float), width
        shortest = 2.0 * math.pi / float(self.across.max(initial=0.0) or 1.0)
        self.places = math.ceil(PER_WAVE * max(1.0, width / shortest))
        """Number of intervals along an edge; its displacement is computed at their ends."""
        self._x = np.asarray(np.linspace(-RADIUS, RADIUS, PLACES), dtype=float)
        basis = chebyshev.chebvander(self._x / RADIUS, DEGREE)
        self._inverse = np.asarray(np.linalg.pinv(basis), dtype=float)
        self._solved = [_equations(float(k)) for k in self.across]

    def polynomials(self, x: Array) -> Array:
        """Polynomials (n, DEGREE + 1) in X [b], held constant beyond RADIUS."""
        held = np.clip(x, -RADIUS, RADIUS)
        return np.asarray(chebyshev.chebvander(held / RADIUS, DEGREE))

    def waves(self, y: Array) -> Array:
        """Cosines and sines (2 m, n) across the motion at Y (n,) [b]."""
        phase = np.outer(self.across, y)
        return np.stack([np.cos(phase), np.sin(phase)], axis=1).reshape(
            2 * self.across.size, y.size
        )

    def correction(self, qx: Array, qy: Array) -> Complex:
        """Return the pressure of waves (l,) [1/b] on the strip minus that on the half-space.

        Coefficients (2 m (DEGREE + 1), l) of the products of `waves` and `polynomials` [p_h per
        b^2/R].
        """
        result = np.zeros((self.across.size, 2, DEGREE + 1, qx.size), dtype=complex)
        orders = chebyshev.chebvander(self._x, ORDERS) / np.sqrt(1.0 - self._x**2)[:, np.newaxis]
        for k, wave, there in self.waves_and_weights(qx, qy):
            local = np.hypot(qx[wave], qy[wave]) * np.exp(1j * np.outer(self._x, qx[wave]))
            part = self._inverse @ (orders @ there - local)
            result[k, 0][:, wave] = part
            # exp(i k_Y Y) from the cosine and the sine of |k_Y| Y
            result[k, 1][:, wave] = 1j * np.sign(qy[wave]) * part
        return result.reshape(2 * self.across.size * (DEGREE + 1), qx.size)

    def displacement(self, qx: Array, qy: Array) -> Complex:
        """Outward displacement of the edges by waves (l,) [1/b]; unit: b per b^2/R.

        First at X = -1, then at X = 1, at the ends (n,) of the intervals: (2 n, l). As
        :func:`pyehl.theory.disc.edge_of_disc`.
        """
        y = np.linspace(0.0, self.width, self.places + 1)
        result = np.zeros((2, y.size, qx.size), dtype=complex)
        for _, wave, there in self.waves_and_weights(qx, qy):
            phase = np.exp(1j * np.outer(y, qy[wave]))
            for side, sign in enumerate(((-1.0) ** np.arange(ORDERS + 1), np.ones(ORDERS + 1))):
                result[side][:, wave] = phase * (sign @ there)
        return result.reshape(2 * y.size, qx.size)

    def waves_and_weights(self, qx: Array, qy: Array) -> Iterator[tuple[int, Indices, Complex]]:
        """Yield each |k_Y| that has waves, by number, with their indices and pressure weights.

        The weights (ORDERS + 1, number of its waves) are those of T_n/sqrt(1 - X^2).
        """
        from scipy.special import jv  # noqa: PLC0415 (takes as long to load as all the rest)

        if not qx.size:
            return
        n = np.arange(ORDERS + 1)
        nearest = np.argmin(np.abs(np.abs(qy)[:, np.newaxis] - self.across), axis=1)
        for k, solved in enumerate(self._solved):
            wave = np.flatnonzero(nearest == k)
            if wave.size:
                plane = (math.pi * 1j**n)[:, np.newaxis] * jv(n[:, np.newaxis], qx[wave])
                yield k, wave, solved @ plane


def _equations(k: float) -> Array:
    """Matrix from the integrals of T_n f/sqrt(1 - X^2), f a deflection, to pressure weights."""
    n = np.arange(ORDERS + 1)
    # of the logarithmic kernel
    diagonal = np.append(math.pi * math.log(2.0), 0.5 * math.pi / n[1:])
    if k == 0.0:
        return np.diag(np.append(0.0, 1.0 / diagonal[1:]))
    from scipy.special import k0  # noqa: PLC0415

    angle = (np.arange(NODES) + 0.5) * (math.pi / NODES)
    x = np.cos(angle)
    # the limit of K_0(k d) + ln d at d = 0
    apart = np.abs(x[:, np.newaxis] - x)
    np.fill_diagonal(apart, 1.0)
    rest = k0(k * apart) + np.log(apart)
    np.fill_diagonal(rest, -math.log(0.5 * k) - np.euler_gamma)
    waves = np.cos(np.outer(n, angle)) * (math.pi / NODES)
    return np.asarray(np.linalg.inv(np.diag(diagonal) + waves @ rest @ waves.T / math.pi))
