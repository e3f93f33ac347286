# SPDX-License-Identifier: BSD-3-Clause
"""Table 1 surfaces under Figs 5 to 7 and Table 2: simulations, and predictions by three models."""

from pyehl import surfaces
from pyehl.case import Case
from pyehl.reproduce.piece import Level
from pyehl.reproduce.runs import Made, Runs
from pyehl.reproduce.table1 import CASE
from pyehl.surfaces import Topography
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Row

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


def tile(seed: int = SEED) -> tuple[Topography, OperatingPoint]:
    """Make the surface of a seed, with its operating point."""
    settings = Case.from_text(CASE, [f"surface.seed={seed}"], "table 1").resolve()
    point = OperatingPoint.from_settings(settings)
    return surfaces.from_settings(settings, point, 1e-7), point


def deformed_run(runs: Runs, level: Level) -> Made:
    """Simulate the surface of `SEED` with its fields, which its result folder keeps."""
    return runs.study(
        f"surface-{level.surface_grid}",
        CASE + TIME.format(scheme="narrow") + f"&grid points = {level.surface_grid} /\n",
        {"surface.seed": [SEED]},
        keep=True,
    )


def simulations(runs: Runs, level: Level) -> tuple[list[Row], list[Made]]:
    """Simulate the surfaces of the seeds 1, 2, ...: rows in the order of the seeds, studies."""
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


def carried(points: int) -> list[str]:
    """Options that leave the waves that a grid carries: longer than two nodes."""
    _, point = tile()
    shortest = 2.0 * WIDTH / (points - 1) * point.hertz_radius
    return [f"surface.shortest_wavelength={shortest:.6g}"]


def predictions(runs: Runs, level: Level, model: str) -> Made:
    """Predict the same surfaces by one of `MODELS`, with the waves that the simulation has."""
    return runs.study(
        f"predictions-{model}-{level.surfaces}-{level.surface_grid}",
        CASE + MODELS[model],
        {"surface.seed": list(range(SEED, SEED + level.surfaces))},
        options=carried(level.surface_grid),
        run="predict",
    )
