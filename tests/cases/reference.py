# SPDX-License-Identifier: BSD-3-Clause
"""Closed forms and published numbers to compare results with.

It imports nothing of this package, and nothing that computes results imports it, so that a test
against it can fail.
"""

import csv
from dataclasses import dataclass
from importlib import resources
from typing import cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

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

    `h_c` and `h_min` belong to `points`; `limit_c` and `limit_min` are Richardson limits.
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


def _table(name: str) -> list[dict[str, str]]:
    """Rows of a table in pyehl/studies/references, which states the source of its values."""
    text = resources.files("pyehl").joinpath("studies", "references", name).read_text("utf-8")
    return list(csv.DictReader(x for x in text.splitlines() if not x.startswith("#")))


def _smooth() -> tuple[SmoothRow, ...]:
    keys = ("contact.moes_m", "contact.moes_l", "lubricant.roelands_z", "grid.x_inlet")
    contacts: dict[tuple[str, ...], list[dict[str, str]]] = {}
    for row in _table("smooth.csv"):
        contacts.setdefault(tuple(row[key] for key in (*keys, "grid.y_extent")), []).append(row)
    result = []
    for contact, rows in contacts.items():
        m, ell, z, inlet, side = (float(value) for value in contact)
        points = tuple(int(row["grid.points"]) for row in rows)
        h_c, h_min = (tuple(float(row[name]) for row in rows) for name in ("H_c", "H_min"))
        limits = (float(rows[-1][f"{name}_extrapolated"]) for name in ("H_c", "H_min"))
        result.append(SmoothRow(m, ell, z, inlet, side, points, h_c, h_min, *limits))
    return tuple(result)


SMOOTH = _smooth()
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


WAVINESS = tuple(
    WavinessRow(
        int(row["grid.points"]),
        float(row["lubricant.roelands_z"]),
        row["time.scheme"],
        float(row["surface.amplitude"]),
        float(row["surface.wavelength"]),
        *(float(row[name]) for name in ("mu_ratio", "mu_ratio_min", "mu_ratio_max")),
    )
    for row in _table("waviness.csv")
)
"""Moving waviness. The last row shows the damping of its scheme: it tests the arithmetic only."""
