# SPDX-License-Identifier: BSD-3-Clause
"""Cases shared by several figures: moving waves, and Table 1 surfaces with their predictions."""

from dataclasses import dataclass

import numpy as np
from piece import Level
from runs import Made, Runs, friction_of
from table1 import CASE

from pyehl import surfaces
from pyehl.case import Case
from pyehl.surfaces import Topography
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Array, Mask, Row

SEED = 1
"""Seed of the surface of Figs 1, 5, 6 and of Table 2."""
WIDTH = 4.0
"""Width of the domain [a]."""
TIME = "&time scheme = '{scheme}' estimate_error = .false. /\n"
MODELS = {
    "response": "",
    "paper": "&psd reduction = 'amplitude' smooth = 'hertz' /\n",
    "literal": (
        "&psd reduction = 'amplitude' smooth = 'hertz' stiffness = 'paper' "
        "viscosity_law = 'barus' /\n"
    ),
}
"""Predictions: ours; the paper's model; the same with eq. 11 read literally and Barus' law."""
SCHEME_NAMES = {"paper": "scheme of the paper", "narrow": "narrow scheme"}
SCHEMES = tuple(SCHEME_NAMES)
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
"""M, L, wavelength [a], at the corners and in the middle of the ranges of eq. 16."""
RATIOS = (1.0, 1.6, 2.5, 5.0, 10.0)
"""H_c/A_i."""
# The domain of the paper, for all M
DOMAIN = "&grid points = {points} x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0 /\n"
SMOOTH = "&contact moes_m = 1000.0 moes_l = 10.0 /\n" + DOMAIN
WAVE = (
    "&contact moes_m = 1000.0 moes_l = 10.0 /\n"
    + DOMAIN
    + "&surface kind = 'harmonic' velocity_ratio = 1.01 amplitude = 0.001 wavelength = 0.5 /\n"
    "&time scheme = '{scheme}' estimate_error = .false. /\n"
    "&output fields = .false. /\n"
)


def tile(seed: int = SEED) -> tuple[Topography, OperatingPoint]:
    """Make the surface of a seed, with its operating point."""
    settings = Case.from_text(CASE, f"surface.seed={seed}", origin="table 1").resolve()
    point = OperatingPoint.from_settings(settings)
    return surfaces.from_settings(settings, point, 1e-7), point


def deformed_run(runs: Runs, level: Level) -> Made:
    """Simulate the surface of `SEED`, with its fields in its result folder."""
    return runs.study(
        f"surface-{level.surface_grid}",
        CASE + TIME.format(scheme="narrow") + f"&grid points = {level.surface_grid} /\n",
        {"surface.seed": [SEED]},
        keep=True,
    )


def simulations(runs: Runs, level: Level) -> tuple[list[Row], list[Made]]:
    """Simulate the surfaces of the seeds 1, 2, ...; returns rows in order of the seeds, studies."""
    made = deformed_run(runs, level)
    if level.surfaces < 2:
        return list(made.rows), [made]
    others = runs.study(
        f"surfaces-{level.surfaces}-{level.surface_grid}",
        CASE
        + TIME.format(scheme="narrow")
        + f"&grid points = {level.surface_grid} /\n&output fields = .false. /\n",
        {"surface.seed": list(range(SEED + 1, SEED + level.surfaces))},
    )
    return [*made.rows, *others.rows], [made, others]


def resolved_waves(points: int) -> list[str]:
    """Options that keep only the waves that a grid resolves: longer than two mesh sizes."""
    _, point = tile()
    shortest = 2.0 * WIDTH / (points - 1) * point.hertz_radius
    return [f"surface.shortest_wavelength={shortest:.6g}"]


def predictions(runs: Runs, level: Level, model: str) -> Made:
    """Predict the same surfaces by one of `MODELS`, with the waves that the simulation resolves."""
    return runs.study(
        f"predictions-{model}-{level.surfaces}-{level.surface_grid}",
        CASE + MODELS[model],
        {"surface.seed": list(range(SEED, SEED + level.surfaces))},
        options=resolved_waves(level.surface_grid),
        run="predict",
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
    """Waves simulated with one scheme; arrays (n,)."""

    scheme: str  # as ``time.scheme``
    # M, L, wavelength [a], H_c/A_i
    moes_m: Array
    moes_l: Array
    wavelength: Array
    ratio: Array
    amplitude: Array  # A_i [a^2/R]
    friction: Array  # mu_r/mu_s; NaN without a result
    status: tuple[str, ...]  # of the runs
    made: Made

    @property
    def known(self) -> Mask:
        """Where there is a result."""
        return np.isfinite(self.friction)


def waves(runs: Runs, level: Level, scheme: str) -> WaveSet:
    """Run the waves of `CURVES` and `RATIOS` with a scheme.

    Amplitudes are absolute, fractions of the film on the grid of the paper: as fractions of the
    film of a coarser grid they would be too small, and the friction increase is proportional to
    their square.
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
