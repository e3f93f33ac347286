# SPDX-License-Identifier: BSD-3-Clause
"""Waves in the inlet: the full linearised Reynolds equation, with elastic half-spaces.

Roughness, T, Pi, mu and the units are those of :mod:`pyehl.theory.transport`. That module assumes
coefficients that change slowly, which in the inlet holds only for short waves. Here the equation is
solved on the nodes of the centre line: with D = d/dX + i k, the flow along the motion is

    F = eps D Pi + eps P' ((c - d ln eta/dP) Pi - 3 T/H),   T = 1 - K^-1 * Pi,

and D F - eps k_Y^2 Pi + (d/dX - i k (U - 1)) mu = 0, mu = rho (T - c H Pi). K^-1 * is the integral
over X of (4/pi^2) K_0(kappa |X - X'|) exp(i k (X' - X)), kappa^2 = k_Y^2 + (exp(-gamma)/b)^2 with
the semi-axis b across the motion and Euler's gamma: a wave across the motion deflects as in a strip
as wide as the contact. Downstream of the last node the wave continues without leaking and fades
towards the edge at X = 1. Nothing is fitted. The effect of the side flow of the smooth contact on
the wave is neglected.
"""

from __future__ import annotations

import pickle
from dataclasses import replace
from functools import lru_cache

import numpy as np
import scipy
from numpy.typing import ArrayLike

from pyehl.theory.transport import INLET, Flow, Zone, stiffness, upstream
from pyehl.types import Array, Complex

# Spacing of the nodes, first and last node to the nearest spacing, downstream edge of the contact
# [a]; INLET is a node
SPACING, START, END, EDGE = 1.0 / 64.0, -1.6, -0.6, 1.0
# Quadrature of the kernel over a cell of constant pressure, except the cell with the singularity
GAUSS = np.polynomial.legendre.leggauss(4)
# |q| [1/a] and directions at which `interpolated_inlet` solves and between which it interpolates
WAVENUMBERS = np.geomspace(1.0, 128.0, 24)
DIRECTIONS = np.linspace(0.0, 0.5 * np.pi, 7)
# |q| at which the subtracted transport solution has the weight 1/2 [1/a]
SHORT = 16.0


def at_inlet(zone: Zone, qx: Array, qy: Array, velocity_ratio: float) -> Complex:
    """Solve for mu/rho at INLET (m,) and refer it to X = -1 as a wave that does not leak [-].

    Wavenumbers qx, qy (m,) [1/a], qx >= 0, not both 0; U = `velocity_ratio`.
    """
    h, last = SPACING, round((END - INLET) / SPACING)
    x = np.asarray(INLET + h * np.arange(round((START - INLET) / h), last + 1), dtype=np.float64)
    n, place = x.size, x.size - 1 - last
    slip = qx * (velocity_ratio - 1.0)
    nodes, middles = Flow(zone, x), Flow(zone, x[:-1] + 0.5 * h)
    flattening = wave_flattening(zone, qx, qy, slip, x)
    one = np.eye(n)
    loss = flattening + np.diag(nodes.compressibility * nodes.film)
    mean = 0.5 * (one[1:] + one[:-1])
    turned = 1j * qx[:, np.newaxis, np.newaxis]
    change = (one[1:] - one[:-1]) / h + turned * mean
    softening = middles.gradient * middles.softening
    bending = middles.gradient * middles.power / middles.film
    flow = bending[:, np.newaxis] * (mean @ flattening)
    flow += middles.along[:, np.newaxis] * change + softening[:, np.newaxis] * mean
    # D F at the inner nodes; the last node takes that of its neighbour
    inner = np.arange(n - 2)
    spread = np.zeros((qx.size, n, n - 1), dtype=complex)
    spread[:, inner + 1, inner] = -1.0 / h + 0.5 * turned[:, 0]
    spread[:, inner + 1, inner + 1] = 1.0 / h + 0.5 * turned[:, 0]
    spread[:, -1] = spread[:, -2]
    convected = convected_by(n, h, slip) * nodes.density
    leak = (nodes.across * np.square(qy)[:, np.newaxis])[:, :, np.newaxis] * one
    system = spread @ flow - leak - convected @ loss
    right = spread @ bending - convected.sum(-1)
    # no pressure wave at the start
    system[:, 0], right[:, 0] = one[0], 0.0
    pressure = np.linalg.solve(system, right[..., np.newaxis])[..., 0]
    transfer = 1.0 - np.einsum("mi,mi->m", loss[:, place], pressure)
    return np.asarray(transfer * np.exp(-1j * slip * (INLET + 1.0)))


def wave_flattening(zone: Zone, qx: Array, qy: Array, slip: Array, x: Array) -> Complex:
    """Matrices (m, n, n) of the flattening at nodes x (n,) by the pressure wave at these nodes.

    Waves qx, qy (m,) [1/a]; `slip` is k (U - 1) (m,) [1/a].
    """
    h, n = SPACING, x.size
    more = round((EDGE - x[-1]) / h)
    far = h * np.arange(1, n + more)
    k = np.maximum(qx, 1e-9)[:, np.newaxis]
    # a wave across a line carries no load per length: the width has no effect
    wide = zone.ellipticity if np.isfinite(zone.ellipticity) else 1.0
    strip = np.exp(-np.euler_gamma) / wide
    kappa = np.hypot(qy, strip)[:, np.newaxis]
    half = 0.5 * h
    # K_0(z) is -ln(z/2) - gamma next to 0
    sine, integral = np.sin(k * half), scipy.special.sici(k * half)[0]
    near = (2.0 / k) * (integral - sine * (np.log(0.5 * kappa * half) + np.euler_gamma))
    beside = np.zeros((qx.size, far.size), dtype=complex)
    for node, weight in zip(*GAUSS, strict=True):
        away = far + half * node
        beside += (half * weight) * scipy.special.k0(kappa * away) * np.exp(1j * k * away)
    # by the distance i - j in nodes, upstream and downstream
    kernel = np.hstack([np.conj(beside[:, n - 2 :: -1]), near, beside])
    kernel *= 1.0 / (np.pi * float(stiffness(1.0)) * zone.stiffness)
    i, behind = np.arange(n)[:, np.newaxis], np.arange(1, more + 1)
    result = kernel[:, np.arange(n) - i + n - 1]
    tail = np.exp(1j * np.outer(slip, h * behind)) * np.cos(0.5 * np.pi * behind / more)
    result[:, :, -1] += np.einsum("mij,mj->mi", kernel[:, behind - i + 2 * n - 2], tail)
    return result


def convected_by(n: int, h: float, slip: Array) -> Complex:
    """d/dX - i slip at n nodes `h` apart (m, n, n), exact for a wave exp(i slip X)."""
    i = np.arange(2, n - 1)
    difference = np.zeros((n, n))
    for step, weight in zip((-2, -1, 0, 1), (1.0, -6.0, 3.0, 2.0), strict=True):
        difference[i, i + step] = weight / (6.0 * h)
    difference[1, :2] = np.array([-1.0, 1.0]) / h
    difference[-1, -3:] = np.array([0.5, -2.0, 1.5]) / h
    apart = h * (np.arange(n) - np.arange(n)[:, np.newaxis])
    return np.asarray(difference * np.exp(-1j * slip[:, np.newaxis, np.newaxis] * apart))


def interpolated_inlet(zone: Zone, qx: ArrayLike, qy: ArrayLike, velocity_ratio: float) -> Complex:
    """Interpolate `at_inlet` to waves (m,) [1/a].

    The interpolated quantity is the difference from `_weighted_upstream`, which is smooth over
    wavenumber and direction. Beyond WAVENUMBERS it is constant.
    """
    kx, ky = np.asarray(qx, dtype=float), np.asarray(qy, dtype=float)
    table = _difference_table(pickle.dumps(replace(zone, newtonian=None)), velocity_ratio)
    low, high = np.log(WAVENUMBERS[[0, -1]])
    q = np.clip(np.log(np.maximum(np.hypot(kx, ky), 1e-12)), low, high)
    column = (q - low) * ((WAVENUMBERS.size - 1) / (high - low))
    row = np.arctan2(ky, kx) * (2.0 / np.pi * (DIRECTIONS.size - 1))
    result = scipy.ndimage.map_coordinates(table, [row, column], order=3, mode="mirror")
    return np.asarray(_weighted_upstream(zone, kx, ky, velocity_ratio) + result)


def _weighted_upstream(zone: Zone, qx: Array, qy: Array, velocity_ratio: float) -> Complex:
    """:func:`pyehl.theory.transport.upstream` times a weight, 1 for short and 0 for long waves."""
    weight = 1.0 / (1.0 + (SHORT / np.maximum(np.hypot(qx, qy), 1e-12)) ** 3)
    return np.asarray(weight * upstream(zone, qx, qy, velocity_ratio))


@lru_cache(maxsize=16)
def _difference_table(pickled: bytes, velocity_ratio: float) -> Complex:
    """Return `at_inlet` minus `_weighted_upstream` by direction and |q|; the last few are cached.

    The zone is pickled so that zones of equal numbers share a cache entry.
    """
    zone = pickle.loads(pickled)
    rows = []
    for direction in DIRECTIONS:
        x, y = WAVENUMBERS * np.cos(direction), WAVENUMBERS * np.sin(direction)
        wave = zone, x, y, velocity_ratio
        rows.append(at_inlet(*wave) - _weighted_upstream(*wave))
    # a wave that travels against the motion is the conjugate of one that travels along it
    return np.array([*rows, *np.conj(rows[-2::-1])])
