# SPDX-License-Identifier: BSD-3-Clause
"""Contact of elastic bodies on nodes, by conjugate gradients.

With the gap g before any pressure of solid contact p, and a linear compliance G,

    p >= 0,   g + G p + s >= 0,   one of both 0,   s >= 0,   sum p <= most,   one of both equal:

the nodes with p > 0 are found on the way (Polonsky & Keer 1999, Wear 231, 206); s is a lift of all
nodes, which is zero unless the sum of p would exceed the load.
"""

import math
from dataclasses import dataclass

import numpy as np
import scipy

from pyehl.types import Array, Mask

ENOUGH, DEEPEST = 2e-3, 1e-2
"""Tolerances over the given scale: of the rms error of the film at nodes in contact, and of the
depth below the boundary film elsewhere. A quarter of both changes the load share in
docs/howto/mixed.md by 0.03 % of itself."""
MOST_STEPS = 300
"""Of conjugate gradients, before a contact counts as not solved."""


@dataclass(frozen=True, slots=True)
class Compliance:
    """Lift of the film by pressures on nodes (m, n), by Fourier components on a larger box."""

    kernel: Array  # of the half spectrum (box[0]//2 + 1, box[1]), real, not negative
    box: tuple[int, int]

    def __call__(self, pressure: Array) -> Array:
        """Lift (m, n) by a pressure (m, n)."""
        m, n = pressure.shape
        # the half spectrum is that of the first index
        size, axes = (self.box[1], self.box[0]), (1, 0)
        waves = scipy.fft.rfft2(pressure, size, axes)
        return np.asarray(scipy.fft.irfft2(self.kernel * waves, size, axes)[:m, :n])


@dataclass(frozen=True, slots=True)
class Lifted:
    """What holds the film off the boundary film."""

    pressure: Array  # p (m, n)
    lift: Array  # G p + s (m, n)


def lifted(
    gap: Array, compliance: Compliance, scale: float, most: float, start: Lifted | None = None
) -> Lifted | None:
    """Find the pressures for a gap (m, n), inf where no contact is possible; None: not solved.

    `scale`: film for the tolerances; `most`: largest sum of pressures; `start`: the solution for a
    similar gap.
    """
    if not (gap < 0.0).any():
        return Lifted(np.zeros_like(gap), np.zeros_like(gap))
    allowed = np.isfinite(gap)
    gap = np.where(allowed, gap, 0.0)
    # as if each node was alone
    guess = np.where(allowed, np.maximum(-gap, 0.0), 0.0) / float(compliance.kernel.max())
    first = start.pressure if start is not None and start.pressure.any() else guess
    result = _solved(gap, allowed, compliance, scale, first)
    if result is None or result.pressure.sum() > most:
        result = _solved(
            gap, allowed, compliance, scale, guess * (most / guess.sum()), fixed_load=True
        )
    return result


def _solved(
    gap: Array,
    allowed: Mask,
    compliance: Compliance,
    scale: float,
    pressure: Array,
    *,
    fixed_load: bool = False,
) -> Lifted | None:
    """Solve from a first guess, whose sum stays as it is with `fixed_load`; None: not solved."""
    total, lift = float(pressure.sum()), compliance(pressure)
    step, last, restart = np.zeros_like(gap), 1.0, True
    for _ in range(MOST_STEPS):
        touching = pressure > 0.0
        error = np.where(allowed, gap + lift, 0.0)
        raised = -float(error[touching].mean()) if fixed_load else 0.0
        error[allowed] += raised
        square = float(np.square(error[touching]).sum())
        rms = math.sqrt(square / max(1, int(touching.sum())))
        if rms < ENOUGH * scale and -float(error.min()) < DEEPEST * scale:
            return Lifted(pressure, lift + raised)
        step = np.where(touching, error + (0.0 if restart else square / last) * step, 0.0)
        last = square
        change = compliance(step)
        if fixed_load:
            change -= change[touching].mean()
        down = float((change * step)[touching].sum())
        if not down > 0.0:
            return None
        length = float((error * step)[touching].sum()) / down
        pressure = np.maximum(pressure - length * step, 0.0)
        comes = allowed & (pressure <= 0.0) & (error < 0.0)
        restart = bool((comes | (touching & (pressure <= 0.0))).any())
        pressure[comes] -= length * error[comes]
        if fixed_load:
            pressure *= total / pressure.sum()
        lift = compliance(pressure)
    return None
