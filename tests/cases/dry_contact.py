# SPDX-License-Identifier: BSD-3-Clause
"""Dry contact of rough elastic bodies, to check what the solver makes of slow motion.

Conjugate gradients with the pressures as unknowns (Polonsky & Keer 1999), the deflection by FFT on
a doubled grid; a hardness bounds the pressures, and a gap that is missing under one of them is
plastic depth. Nothing is shared with the solver but the half-space.
"""

from __future__ import annotations

import numpy as np
import scipy.fft
from numpy.typing import NDArray

__all__ = ["dry_pressure"]

Array = NDArray[np.float64]

# Error of the gap in contact, over its largest value
ENOUGH, MOST_STEPS = 1e-9, 2000


def dry_pressure(gap: Array, mesh: float, load: float, limit: float = np.inf) -> Array:
    """Pressure [p_h] under a load [a^2 p_h] of bodies with a gap [a^2/R] on square cells [a].

    `limit`: hardness [p_h] of bodies that are elastic and perfectly plastic.
    """
    shape = [2 * n for n in gap.shape]
    kernel = scipy.fft.rfft2(_kernel(shape, mesh))

    def deflection(pressure: Array) -> Array:
        spectrum = kernel * scipy.fft.rfft2(pressure, shape)
        return np.asarray(scipy.fft.irfft2(spectrum, shape)[: gap.shape[0], : gap.shape[1]])

    pressure = np.full(gap.shape, load / (mesh**2 * gap.size))
    if np.isfinite(limit):
        pressure = np.minimum(dry_pressure(gap, mesh, load), limit)
    step, last, restart = np.zeros_like(gap), 1.0, True
    for _ in range(MOST_STEPS):
        error = gap + deflection(pressure)
        # neither apart nor at the limit
        free = (pressure > 0.0) & (pressure < limit)
        error -= error[free].mean()
        wrong = free | ((pressure <= 0.0) & (error < 0.0)) | ((pressure >= limit) & (error > 0.0))
        square = (error[free] ** 2).sum()
        if np.sqrt((error[wrong] ** 2).sum() / free.sum()) < ENOUGH * gap.max():
            return pressure
        step = np.where(free, error + (0.0 if restart else square / last) * step, 0.0)
        last = square
        change = deflection(step)
        change -= change[free].mean()
        length = (error * step)[free].sum() / (change * step)[free].sum()
        pressure = np.clip(pressure - length * step, 0.0, limit)
        comes = ((pressure <= 0.0) & (error < 0.0)) | ((pressure >= limit) & (error > 0.0))
        pressure[comes] -= length * error[comes]
        restart = bool(comes.any())
        pressure = np.clip(pressure, 0.0, limit)
        free = (pressure > 0.0) & (pressure < limit)
        pressure[free] *= (load / mesh**2 - pressure[~free].sum()) / pressure[free].sum()
    msg = "the dry contact is not solved"
    raise AssertionError(msg)


def _kernel(shape: list[int], mesh: float) -> Array:
    """Deflection at all distances by a unit pressure in one cell (Love 1929), k_b = 2/pi^2."""
    x, y = (mesh * np.concatenate([np.arange(n // 2 + 1), np.arange(1 - n // 2, 0)]) for n in shape)

    def corner(a: Array, b: Array) -> Array:
        return a * np.arcsinh(b / np.abs(a)) + b * np.arcsinh(a / np.abs(b))

    right, left = x[:, None] + 0.5 * mesh, x[:, None] - 0.5 * mesh
    upper, lower = y[None] + 0.5 * mesh, y[None] - 0.5 * mesh
    whole = corner(right, upper) - corner(right, lower) - corner(left, upper) + corner(left, lower)
    return np.asarray(2.0 / np.pi**2 * whole)
