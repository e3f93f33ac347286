# SPDX-License-Identifier: BSD-3-Clause
"""The depths at which stress is computed, from the waves that a distribution of pressure has."""

from __future__ import annotations

import math

import numpy as np
import scipy.fft

from pyehl.types import Array

# Depth over depth of the row, and the deepest over the short side of the loaded area
RATIO, DEEPEST = 1.3, 3.0
# Share of the pressure, as a root mean square over the loaded area, whose waves are not resolved
UNRESOLVED = 0.003
# First depth over the one 1/k at which the shear of the shortest wave is largest
FIRST = 0.4


def shortest_wavenumber_depth(pressure: Array, mesh: tuple[float, float]) -> float:
    """1/k of the shortest wave that counts, in the unit of the mesh sizes.

    Waves are left out from the short end on until their pressure is `UNRESOLVED` of the whole.
    """
    power = np.square(np.abs(scipy.fft.rfft2(pressure)))
    kx = 2.0 * np.pi * scipy.fft.fftfreq(pressure.shape[0], mesh[0])[:, None]
    ky = 2.0 * np.pi * scipy.fft.rfftfreq(pressure.shape[1], mesh[1])[None, :]
    k = np.hypot(kx, ky).ravel()
    order = np.argsort(k)[::-1]
    left_out = np.cumsum(power.ravel()[order])
    first = int(np.searchsorted(left_out, UNRESOLVED**2 * left_out[-1]))
    return 1.0 / max(float(k[order][first]), float(k[k > 0.0].min()))


def depths(pressure: Array, mesh: tuple[float, float], short_side: float) -> Array:
    """Depths (n,) from the surface down, the first one 0, in the unit of the mesh sizes.

    The shear of a wave k is largest at the depth 1/k. The row begins above that of the shortest
    wave that the pressure (nx, ny) has, and grows by `RATIO` to `DEEPEST` times the half width
    `short_side` of the contact.
    """
    first = FIRST * min(shortest_wavenumber_depth(pressure, mesh), 0.5 * short_side)
    last = DEEPEST * short_side
    number = math.ceil(math.log(last / first) / math.log(RATIO)) + 1
    return np.concatenate([[0.0], np.geomspace(first, last, number)])
