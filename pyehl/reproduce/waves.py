# SPDX-License-Identifier: BSD-3-Clause
"""The moving waves under Figs 2 to 4: cases, and friction over what they are plotted against."""

from dataclasses import dataclass

import numpy as np

from pyehl.reproduce.piece import Level
from pyehl.reproduce.runs import Made, Runs, friction_of
from pyehl.types import Array, Mask

SCHEMES = ("paper", "narrow")
VELOCITY_RATIO = 1.01
CURVES = (
    (1000.0, 10.0, 0.25),
    (1000.0, 10.0, 0.5),
    (1000.0, 10.0, 1.0),
    (500.0, 10.0, 0.5),
    (2000.0, 10.0, 0.5),
    (1000.0, 5.0, 0.5),
    (1000.0, 15.0, 0.5),
    (500.0, 5.0, 0.25),
    (500.0, 5.0, 1.0),
    (2000.0, 5.0, 0.5),
    (500.0, 15.0, 1.0),
    (2000.0, 15.0, 0.25),
    (2000.0, 15.0, 1.0),
    (500.0, 5.0, 0.5),
)
"""M, L, wavelength [a]: the corners and the middle of the ranges of eq. 16."""
RATIOS = (1.0, 1.6, 2.5, 5.0, 10.0)
"""H_c/A_i."""

# The domain of the paper, whatever M
DOMAIN = "&grid points = {points} x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0 /\n"
SMOOTH = "&contact moes_m = 1000.0 moes_l = 10.0 /\n" + DOMAIN
WAVE = (
    "&contact moes_m = 1000.0 moes_l = 10.0 /\n"
    + DOMAIN
    + "&surface kind = 'harmonic' velocity_ratio = 1.01 amplitude = 0.001 wavelength = 0.5 /\n"
    "&time scheme = '{scheme}' estimate_error = .false. /\n"
    "&output fields = .false. /\n"
)


def smooth_films(runs: Runs, level: Level) -> dict[tuple[float, float], float]:
    """H_c [a^2/R] of the smooth contacts of `CURVES`, on the grid of the paper, by (M, L)."""
    contacts = sorted({(m, ell) for m, ell, _ in CURVES})
    made = runs.study(
        f"smooth-{level.film_grid}",
        SMOOTH.format(points=level.film_grid),
        {"contact.moes_m": [c[0] for c in contacts], "contact.moes_l": [c[1] for c in contacts]},
    )
    return {c: float(made.solved(k)["H_c"]) for k, c in enumerate(contacts)}


@dataclass(frozen=True, slots=True)
class WaveSet:
    """Waves under one scheme; arrays (n,)."""

    scheme: str  # as ``time.scheme``
    # M, L, wavelength [a], H_c/A_i
    moes_m: Array
    moes_l: Array
    wavelength: Array
    ratio: Array
    amplitude: Array  # A_i [a^2/R]
    friction: Array  # mu_r/mu_s; NaN where there is none
    status: tuple[str, ...]  # of the runs
    made: Made

    @property
    def known(self) -> Mask:
        """Where there is a result."""
        return np.isfinite(self.friction)


def waves(runs: Runs, level: Level, scheme: str) -> WaveSet:
    """Run the waves of `CURVES` and `RATIOS` under a scheme.

    Amplitudes are absolute, shares of the film on the grid of the paper: as shares of the film of
    a coarse grid they would be too small, and the rise goes with their square.
    """
    films = smooth_films(runs, level)
    cases = [(m, ell, lam, ratio) for m, ell, lam in CURVES for ratio in RATIOS]
    m, ell, lam, ratio = (np.array(column) for column in zip(*cases, strict=True))
    film = np.array([films[c[0], c[1]] for c in cases])
    amplitude = np.array([float(f"{a:.6g}") for a in film / ratio])
    made = runs.study(
        f"waves-{scheme}-{level.collapse_grid}",
        WAVE.format(points=level.collapse_grid, scheme=scheme),
        {
            "contact.moes_m": m.tolist(),
            "contact.moes_l": ell.tolist(),
            "surface.wavelength": lam.tolist(),
            "surface.amplitude": amplitude.tolist(),
        },
    )
    friction = friction_of(made.rows)
    status = tuple(str(row["status"]) for row in made.rows)
    return WaveSet(scheme, m, ell, lam, ratio, amplitude, friction, status, made)
