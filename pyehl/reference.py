# SPDX-License-Identifier: BSD-3-Clause
"""Closed forms and published numbers to compare results with.

A leaf: it imports nothing of this package, and nothing that computes results imports it, so that
a test against it can fail.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = [
    "FIG_2",
    "PSD_TABLE_2",
    "SMOOTH",
    "TABLE_1",
    "TABLE_2",
    "WAVINESS",
    "SmoothRow",
    "WavinessRow",
    "hertz_deflection",
    "hertz_pressure",
]

Array = NDArray[np.float64]


def hertz_pressure(x: ArrayLike, y: ArrayLike) -> Array:
    """P = sqrt(1 - X^2 - Y^2) inside the unit circle, 0 outside [p_h]; arguments broadcast."""
    r2 = np.asarray(x, dtype=float) ** 2 + np.asarray(y, dtype=float) ** 2
    return cast(Array, np.sqrt(np.maximum(0.0, 1.0 - r2)))


def hertz_deflection(x: ArrayLike, y: ArrayLike) -> Array:
    """Deflection (2/pi^2) int int P/r of the Hertz pressure [a^2/R]; arguments broadcast.

    Johnson 1985, Contact Mechanics, eqs 3.41a and 3.42a: 1 - r^2/2 inside the unit circle, and
    ((2 - r^2) arcsin(1/r) + sqrt(r^2 - 1))/pi outside.
    """
    r2 = np.asarray(x, dtype=float) ** 2 + np.asarray(y, dtype=float) ** 2
    far = np.sqrt(np.maximum(1.0, r2))
    outside = ((2.0 - r2) * np.arcsin(1.0 / far) + np.sqrt(far * far - 1.0)) / np.pi
    return cast(Array, np.where(r2 <= 1.0, 1.0 - 0.5 * r2, outside))


# Zhang, Biboulet, Venner & Lubrecht 2019, doi 10.1016/j.triboint.2019.01.028
TABLE_1 = {
    # printed there [N, m/s, m, Pa, 1/Pa, Pa s, m, m]
    "load": 600.0,
    "mean_velocity": 0.84,
    "radius": 0.018,
    "reduced_modulus": 2.26e11,
    "pressure_viscosity": 2.2e-8,
    "viscosity": 0.04,
    "rms_height": 5e-8,
    "length": 8.29e-4,
    "hurst": 0.8,
    # derived by hand from the above: a [m], p_h [Pa], M, L, speed parameter, Roelands z
    "hertz_radius": 4.1540e-4,
    "hertz_pressure": 1.6602e9,
    "moes_m": 1000.0,
    "moes_l": 10.024,
    "speed_parameter": 1.0978e-3,
    "roelands_z": 0.66841,
}
"""Operating conditions of the paper's table 1."""

TABLE_2 = {257: 1.48, 513: 1.51, 1025: 1.51}
"""mu_r/mu_s of one unpublished fractal surface by full simulation, by points per side (table 2)."""

PSD_TABLE_2 = 1.53
"""mu_r/mu_s of the same surface by the paper's prediction, on all grids (table 2)."""

FIG_2 = {
    "moes_m": 1000.0,
    "moes_l": 10.0,
    "amplitude": 9.734e-3,
    "amplitude_over_film": 0.4,
    "wavelength": 0.5,
    "velocity_ratio": 1.01,
    "mu_ratio": 1.461,
}
"""The harmonic case of fig. 2 on 513 points; amplitude in a^2/R, so H_c = 0.024335."""


@dataclass(frozen=True, slots=True)
class SmoothRow:
    """Central and minimum film of a smooth contact in Hertz units, by points per side.

    `h_c` and `h_min` go with `points`; `limit_c` and `limit_min` are Richardson limits.
    """

    moes_m: float
    moes_l: float
    roelands_z: float
    x_inlet: float
    y_extent: float
    points: tuple[int, ...]
    h_c: tuple[float, ...]
    h_min: tuple[float, ...]
    limit_c: float
    limit_min: float


# Computed before this package existed by two independent programs, a multigrid solver and a Newton
# solver with FFT deflection, which agree within 0.2 %: second-order upstream wedge, constant
# pressure per cell, Roelands with p0 = 1.96e8 Pa, alpha = 2.2e-8 1/Pa, Dowson-Higginson density,
# X up to 1.5. Unless said, the domain is -2.5 <= X <= 1.5, |Y| <= 2.
SMOOTH = (
    SmoothRow(1000.0, 10.0, 0.6684, -2.5, 2.0, (129, 257, 513),
              (0.02058, 0.02355, 0.024335), (0.00577, 0.00793, 0.00833), 0.02459, 0.00847),
    SmoothRow(1000.0, 10.0, 0.68, -2.5, 2.0, (257, 513, 1025),
              (0.023583, 0.024367, 0.024567), (0.007921, 0.008320, 0.008448), 0.024633, 0.00849),
    SmoothRow(200.0, 10.0, 0.68, -2.5, 2.0, (129, 257, 513),
              (0.07902, 0.08103, 0.08155), (0.03725, 0.03847, 0.03874), 0.08172, 0.03883),
    SmoothRow(500.0, 15.0, 0.68, -2.5, 2.0, (129, 257, 513),
              (0.04891, 0.05163, 0.05232), (0.01975, 0.02164, 0.02212), 0.05255, 0.02228),
    SmoothRow(20.0, 10.0, 0.6684, -4.5, 3.0, (129, 257, 513),
              (0.42872, 0.43115, 0.43177), (0.29094, 0.29218, 0.29237), 0.43197, 0.29243),
)  # fmt: skip
"""Smooth steady contacts."""


@dataclass(frozen=True, slots=True)
class WavinessRow:
    """Period mean and extremes of mu_r/mu_s [-] of the moving harmonic pattern, M = 1000, L = 10.

    `points` per side, `scheme` as in ``time.scheme``, `amplitude` A_i [a^2/R], `wavelength` [a].
    """

    points: int
    roelands_z: float
    scheme: str
    amplitude: float
    wavelength: float
    mu_ratio: float
    mu_ratio_min: float
    mu_ratio_max: float


# Computed before this package existed by a Newton solver with FFT deflection, residual 1e-5 or
# below, velocity ratio 1.01, time step = mesh size, mean over whole periods; amplitude in a^2/R,
# wavelength in a, F_smooth of the same grid and z.
WAVINESS = (
    WavinessRow(513, 0.6684, "paper", 9.734e-3, 0.5, 1.4607, 1.4541, 1.4670),
    WavinessRow(513, 0.6684, "narrow", 9.734e-3, 0.5, 1.4631, 1.4565, 1.4694),
    WavinessRow(257, 0.6684, "paper", 9.734e-3, 0.5, 1.4513, 1.4450, 1.4574),
    WavinessRow(257, 0.68, "paper", 9.4330927e-3, 0.5, 1.4435, 1.4373, 1.4495),
    WavinessRow(257, 0.68, "narrow", 9.4330927e-3, 0.5, 1.4464, 1.4402, 1.4524),
    WavinessRow(129, 0.68, "paper", 8.2362474e-3, 0.5, 1.3457, 1.3409, 1.3503),
    WavinessRow(129, 0.68, "narrow", 8.2362474e-3, 0.5, 1.3128, 1.3087, 1.3168),
    WavinessRow(257, 0.68, "paper", 4.7165463e-3, 0.5, 1.0987, 1.0964, 1.1010),
    WavinessRow(257, 0.68, "paper", 9.4330927e-3, 0.25, 3.4719, 3.4673, 3.4762),
)
"""Moving waviness. The last row is damped by its scheme: right arithmetic, wrong physics."""
