# SPDX-License-Identifier: BSD-3-Clause
"""Contact of elastic bodies on nodes, by conjugate gradients (Polonsky & Keer 1999, Wear 231, 206).

With the gap g without solid contact, the contact pressure p and a linear compliance G it solves

    p >= 0,   g + G p + s >= 0,   p (g + G p + s) = 0,   s >= 0,   sum p <= load:

s lifts all nodes alike and is zero unless the sum of p would exceed the load: then the sum of p is
the load. The iteration also finds the nodes in contact, p > 0. If that with s = 0 fails, one with
the load as the sum of p follows; a negative s is then no solution, because contact with s = 0 would
sustain less than the load.
"""

import math
from dataclasses import dataclass

import numpy as np
import scipy

from pyehl.types import Array, Mask

FILM_TOLERANCE, DEPTH_TOLERANCE = 2e-3, 1e-2
"""Tolerances over `scale`: rms error of the film at nodes in contact, and penetration of the
boundary film elsewhere. A quarter of both changes the load share in docs/howto/mixed.md by 0.03 %
of itself."""
MAX_ITERATIONS = 300
"""Maximum number of conjugate-gradient iterations."""


@dataclass(frozen=True, slots=True)
class Compliance:
    """Lift of the film by pressures on nodes (m, n), computed by FFT on a larger, padded box."""

    kernel: Array  # of the half spectrum (box[0]//2 + 1, box[1]), real, not negative
    box: tuple[int, int]

    def __call__(self, pressure: Array) -> Array:
        """Lift (m, n) by a pressure (m, n)."""
        m, n = pressure.shape
        # the half spectrum is along the first index
        size, axes = (self.box[1], self.box[0]), (1, 0)
        waves = scipy.fft.rfft2(pressure, size, axes)
        return np.asarray(scipy.fft.irfft2(self.kernel * waves, size, axes)[:m, :n])


@dataclass(frozen=True, slots=True)
class SolidContact:
    """Pressure of solid contact, and the lift of the film that it causes."""

    pressure: Array  # p (m, n)
    lift: Array  # G p + s (m, n)
    uniform: float = 0.0  # s


def contact_pressures(
    gap: Array, compliance: Compliance, scale: float, load: float, start: SolidContact | None = None
) -> SolidContact | None:
    """Find the pressures for a gap (m, n), inf where no contact is possible; None: not solved.

    `scale`: film for the tolerances; `load`: largest sum of pressures; `start`: the solution for a
    similar gap.
    """
    if not (gap < 0.0).any():
        return SolidContact(np.zeros_like(gap), np.zeros_like(gap))
    allowed = np.isfinite(gap)
    gap = np.where(allowed, gap, 0.0)
    # as if each node were alone
    guess = np.where(allowed, np.maximum(-gap, 0.0), 0.0) / float(compliance.kernel.max())
    first = start.pressure if start is not None and start.pressure.any() else guess
    result = iterated(gap, allowed, compliance, scale, first)
    if result is None or result.pressure.sum() > load:
        result = iterated(
            gap, allowed, compliance, scale, guess * (load / guess.sum()), fixed_load=True
        )
        if result is not None and result.uniform < -DEPTH_TOLERANCE * scale:
            return None
    return result


def iterated(
    gap: Array,
    allowed: Mask,
    compliance: Compliance,
    scale: float,
    pressure: Array,
    *,
    fixed_load: bool = False,
) -> SolidContact | None:
    """Iterate from a first guess; `fixed_load` keeps its sum; None: not solved."""
    total, lift = float(pressure.sum()), compliance(pressure)
    step, last, restart = np.zeros_like(gap), 1.0, True
    for _ in range(MAX_ITERATIONS):
        in_contact = pressure > 0.0
        error = np.where(allowed, gap + lift, 0.0)
        raised = -float(error[in_contact].mean()) if fixed_load else 0.0
        error[allowed] += raised
        square = float(np.square(error[in_contact]).sum())
        rms = math.sqrt(square / max(1, int(in_contact.sum())))
        if rms < FILM_TOLERANCE * scale and -float(error.min()) < DEPTH_TOLERANCE * scale:
            return SolidContact(pressure, lift + raised, raised)
        step = np.where(in_contact, error + (0.0 if restart else square / last) * step, 0.0)
        last = square
        change = compliance(step)
        if fixed_load:
            change -= change[in_contact].mean()
        down = float((change * step)[in_contact].sum())
        if not down > 0.0:
            return None
        length = float((error * step)[in_contact].sum()) / down
        pressure = np.maximum(pressure - length * step, 0.0)
        enters = allowed & (pressure <= 0.0) & (error < 0.0)
        restart = bool((enters | (in_contact & (pressure <= 0.0))).any())
        pressure[enters] -= length * error[enters]
        if fixed_load:
            pressure *= total / pressure.sum()
        lift = compliance(pressure)
    return None
