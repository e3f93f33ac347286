# SPDX-License-Identifier: BSD-3-Clause
"""Pressure of waves of film whose amplitude changes across the motion.

The sides of a narrow contact flatten a wave as long as it is wide more than the middle does. A
half-space does not answer to that line by line: where the amplitude is a sum of waves across the
motion, so is the film, and each of them has its own stiffness. The amplitude is known on some
lines (:data:`LINES`) and linear between them; beyond the contact it falls to zero, and what is
there is no film: the edge takes it off (:class:`pyehl.prediction.edge.Edge`). No constant in it is
fitted.
"""

import numpy as np

from pyehl.theory.transport import free_stiffness
from pyehl.types import Array, Complex

LINES = np.array([-0.95, -0.8, -0.6, -0.3, 0.0, 0.3, 0.6, 0.8, 0.95])
"""Lines along the motion on which the free wave is made [semi-axis], symmetric about the centre
line; between them it is interpolated."""

# Waves across the motion: their period and where they have fallen to zero [semi-axis], and how many
# there are: shorter ones than half a semi-axis the lines do not tell apart
PERIOD, END, SHORTEST = 4.0, 1.7, 8
SAMPLES = 256


def harmonics(amplitudes: Complex) -> tuple[Array, Complex]:
    """Wavenumbers (n,) [1/semi-axis] and parts (n, ...) of amplitudes on LINES (lines, ...)."""
    y = PERIOD * (np.arange(SAMPLES) / SAMPLES - 0.5)
    places = np.concatenate([[-END, -1.0], LINES, [1.0, END]])
    held = np.pad(np.pad(np.eye(LINES.size), ((1, 1), (0, 0)), mode="edge"), ((1, 1), (0, 0)))
    hats = np.stack([np.interp(y, places, one) for one in held.T], axis=1)
    k = 2.0 * np.pi / PERIOD * np.arange(-SHORTEST, SHORTEST + 1, dtype=np.float64)
    parts = np.tensordot(np.exp(-1j * np.outer(k, y)) @ hats / SAMPLES, amplitudes, 1)
    return np.asarray(k, dtype=np.float64), np.asarray(parts, dtype=np.complex128)


def pressed(
    amplitudes: Complex, kx: Array, ky: Array, velocity_ratio: float, ellipticity: float
) -> Complex:
    """Pressure on LINES by which waves of film give way, of a half-space under a circle.

    Amplitudes (lines, ...) of free waves that roughness (kx, ky) [1/a] makes.
    """
    here = free_stiffness(kx, ky, velocity_ratio)
    found = here * amplitudes
    for k, part in zip(*harmonics(amplitudes), strict=True):
        there = free_stiffness(kx, ky + k / ellipticity, velocity_ratio)
        found += np.multiply.outer(np.exp(1j * k * LINES), (there - here) * part)
    return np.asarray(found)
