# SPDX-License-Identifier: BSD-3-Clause
"""Pressure of a wave of roughness on the Hertz disc, in closed form.

A half-space resists a periodic wave of flattening exp(i q x) with the pressure E'|q|/4. The contact
is a disc, and its edge affects waves longer than about half its radius: the pressure inside differs
from that of the periodic wave because there is none outside, and the approach of the bodies
balances the load that a wave carries.

On the unit disc, with z = sqrt(1 - r^2), a pressure Y_lm/z with l - m even deflects the disc in
proportion to Y_lm (Copson 1947; Boersma & Danicki 1993), Y_lm(r, theta) = P_lm(z) cos(m theta).
These are spherical harmonics on the hemisphere over the disc, so the expansion of a plane wave with
a wavevector in the plane is the well-known one, with spherical Bessel functions. Only l = 0 carries
load; it is omitted. Lengths are scaled by the Hertz radius a, heights by a^2/R, pressures by p_h.
"""

import math
from functools import lru_cache
from typing import cast

import numpy as np
from numpy.polynomial import legendre

from pyehl.types import Array, Complex

DEGREE = 6
"""Degree of the polynomials in x, y that represent the correction."""
MAX_WAVENUMBER = 14.0
"""Largest |q| that is corrected [1/a]: the edge does not affect wavelengths below 0.45 a."""
RADIUS = 0.8
"""Radius [a] of the fit; most of the friction arises within it. Nearer to the edge the pressure of
a disc with a fixed edge is singular; that of a contact is not."""

NEXT_TO_EDGE = 1e-5
"""z at which the pressure next to the edge is taken."""
EDGE_ANGLES = np.linspace(0.0, 2.0 * math.pi, 96, endpoint=False)
"""Angles at which the displacement of the edge is computed."""


def monomials(x: Array, y: Array, axis: int = -1) -> Array:
    """x^i y^j for all i + j <= DEGREE, 28 along an axis, for x, y of any shape."""
    powers = [[np.ones_like(values)] for values in (x, y)]
    for values, result in zip((x, y), powers, strict=True):
        for _ in range(DEGREE):
            result.append(result[-1] * values)
    pairs = [(i, j) for i in range(DEGREE + 1) for j in range(DEGREE + 1 - i)]
    terms = np.empty((len(pairs), *np.shape(x)))
    for out, (i, j) in zip(terms, pairs, strict=True):
        np.multiply(powers[0][i], powers[1][j], out=out)
    return np.moveaxis(terms, 0, axis)


def _radial(z: Array, last: int) -> list[tuple[range, Array]]:
    """Return, for each m up to `last`, its degrees l and P_lm(z)/z times the factor of each.

    z (n,); the functions (n, number of l).
    """
    # the last point is the edge, where the weights take P_lm
    values = _legendre(last, np.append(z, 0.0))
    result = []
    for m in range(last + 1):
        degrees = range(m or 2, last + 1, 2)
        weighted = [_weight(n, m, values[n, m, -1]) * values[n, m, :-1] / z for n in degrees]
        result.append((degrees, np.stack(weighted, axis=-1)))
    return result


def _series(qx: Array, qy: Array, theta: Array, radial: list[tuple[range, Array]]) -> Complex:
    """Sum the series of waves (m,) [1/a] at angles (n,) [rad]: (n, m) [p_h per a^2/R].

    `radial` parts are (n, number of l), or (1, number of l) for all angles.
    """
    q, phi = np.hypot(qx, qy), np.arctan2(qy, qx)
    bessel = spherical_bessel(radial[0][0].stop, q)
    total = np.zeros((theta.size, q.size), dtype=complex)
    for m, (degrees, values) in enumerate(radial):
        part = values @ np.stack(
            [(-1) ** ((n - m) // 2) * (2 * n + 1) * bessel[n] for n in degrees]
        )
        # i^l = i^m (-1)^((l - m)/2); cos(m(theta - phi)) by the addition theorem
        turned = np.cos(m * theta)[:, np.newaxis] * np.cos(m * phi) + (
            np.sin(m * theta)[:, np.newaxis] * np.sin(m * phi)
        )
        total += 1j**m * part * turned
    return total


def _legendre(last: int, z: Array) -> Array:
    """P_lm(z), l and m up to `last`, with the phase (-1)^m (DLMF 14.7.15, 14.10.3): (l, m, n)."""
    values = np.zeros((last + 1, last + 1, z.size))
    values[0, 0] = 1.0
    for m in range(last + 1):
        if m:
            values[m, m] = (1 - 2 * m) * np.sqrt(1.0 - z * z) * values[m - 1, m - 1]
        for n in range(m, last):
            before = (n + m) * values[n - 1, m] if n > m else 0.0
            values[n + 1, m] = ((2 * n + 1) * z * values[n, m] - before) / (n - m + 1)
    return values


def spherical_bessel(count: int, q: Array) -> Array:
    """Spherical Bessel functions of the orders below `count`, (count, m) (DLMF 10.54.2)."""
    place, weight, polynomials = _gauss(count)
    waves = np.exp(1j * np.outer(q, place)) * weight
    turned = (-1j) ** np.arange(count)
    return np.asarray((waves @ polynomials * turned).real.T)


@lru_cache(maxsize=4)
def _gauss(count: int) -> tuple[Array, Array, Array]:
    """Nodes, half of the weights and Legendre polynomials there of the orders below `count`."""
    place, weight = legendre.leggauss(2 * count)
    polynomials = np.asarray(legendre.legvander(place, count - 1), dtype=float)
    return place, 0.5 * weight, polynomials


@lru_cache(maxsize=1024)
def _weight(n: int, m: int, at_edge: float) -> float:
    """Pressure per deflection of Y_nm times its coefficient in a plane wave; `at_edge` P_nm(0)."""
    inverse = math.lgamma((n + m + 2) / 2) + math.lgamma((n - m + 2) / 2)
    inverse -= math.lgamma((n + m + 1) / 2) + math.lgamma((n - m + 1) / 2)
    weight = math.exp(inverse + math.lgamma(n - m + 1) - math.lgamma(n + m + 1))
    weight *= at_edge
    return weight * (2.0 if m else 1.0) * math.pi / 2.0


@lru_cache(maxsize=1)
def _fit() -> tuple[Array, Array, list[tuple[range, Array]], Array]:
    """Points x, y of the fit within RADIUS, their radial functions, and the pseudo-inverse."""
    line = np.linspace(-RADIUS, RADIUS, 13)
    x, y = (values.ravel() for values in np.meshgrid(line, line, indexing="ij"))
    inside = np.hypot(x, y) <= RADIUS
    x, y = x[inside], y[inside]
    radial = _radial(np.sqrt(1.0 - x * x - y * y), math.ceil(MAX_WAVENUMBER) + 12)
    return x, y, radial, np.asarray(np.linalg.pinv(monomials(x, y)), dtype=float)


@lru_cache(maxsize=1)
def _next_to_edge() -> list[tuple[range, Array]]:
    """Radial functions next to the edge."""
    return _radial(np.array([NEXT_TO_EDGE]), math.ceil(MAX_WAVENUMBER) + 12)


def disc_correction(qx: Array, qy: Array) -> Complex:
    """Return the pressure of a wave on the disc minus that of the periodic wave, pi/4 |q|.

    Wavenumbers (m,) [1/a]; coefficients (28, m) of :func:`monomials` [p_h per a^2/R], accurate to
    1.5 % of the pressure of the wave within 0.75 a, for |q| up to MAX_WAVENUMBER.
    """
    x, y, radial, inverse = _fit()
    local = 0.25 * math.pi * np.hypot(qx, qy) * np.exp(1j * (np.outer(x, qx) + np.outer(y, qy)))
    return cast(Complex, inverse @ (_series(qx, qy, np.arctan2(y, x), radial) - local))


def edge_of_disc(qx: Array, qy: Array) -> Complex:
    """Outward displacement of the edge by waves (m,) [1/a] at EDGE_ANGLES: (n, m).

    Unit: a per amplitude a^2/R.

    A pressure c/z next to the fixed edge is the change of the Hertz pressure z when the edge moves
    outward by c.
    """
    return NEXT_TO_EDGE * _series(qx, qy, EDGE_ANGLES, _next_to_edge())
