# SPDX-License-Identifier: BSD-3-Clause
"""Measure waves in shear-thinning lubricants: ``NAME.npz``, one file per run of `PLAN`.

    python docs/evidence/thinning/waves.py FOLDER [NAME ...]

Each run is a tile of 4 a with 25 waves of small amplitude on 257 x 257 nodes, as in
docs/evidence/response, and has a twin with Newtonian flow, ``NAME-newtonian``; two more are on
513 x 513 nodes. Existing files stay.
"""

from __future__ import annotations

import math
import sys
from dataclasses import asdict, dataclass, replace
from pathlib import Path

import numpy as np

from pyehl.case import Case
from pyehl.measured_response.superposition import WaveSet, superpose
from pyehl.theory.operating import OperatingPoint

POINTS = 257
TILE = 4.0
# Distance that the slowest wave travels before the record begins [a]
SETTLED = 4.0
# Wavelengths per tile along the motion: at least eight nodes per wavelength
ALONG = (*range(1, 17), 18, 19, 20, 22, 24, 26, 28, 30, 32)
# Angles of the crests of consecutive waves from across the motion [deg]
ANGLES = {
    "even": (85, 0, 45, 26, 0, 63, 45, 0, 30, 56, 0, 45, 70, 18, 0, 45, 60, 0, 35, 50, 0, 70, 22),
    "steep": (85, 80, 70, 76, 84, 66, 73, 87, 62, 79, 83, 68, 75, 86, 64, 81, 71, 77, 60, 82, 74),
}


def by_moes(moes_m: float, moes_l: float) -> str:
    """Keys of a contact with M and L, the reference radius, modulus and lubricant."""
    o = OperatingPoint.from_moes(moes_m, moes_l)
    return (
        f"load = {o.load!r} mean_velocity = {o.mean_velocity!r} radius = {o.radius!r} "
        f"reduced_modulus = {o.reduced_modulus!r}"
    )


TABLE1 = "load = 600 mean_velocity = 0.84 radius = 0.018 reduced_modulus = 2.26e11"
BALL = "load = 300 mean_velocity = 0.5 radius = 0.0127 reduced_modulus = 1.24e11"
THICK = "viscosity = 0.5 pressure_viscosity = 1.8e-8"


@dataclass(frozen=True, slots=True)
class Run:
    """A contact with a lubricant, and the waves that pass through it."""

    contact: str  # keys of the group
    lubricant: str
    velocity_ratio: float  # the slide-to-roll ratio is twice its distance from 1
    angles: str = "even"  # key of ANGLES
    points: int = POINTS  # nodes per side


PLAN = {
    "table1-eyring-02": Run(TABLE1, "shear_law = 'eyring'", 1.01),
    "table1-eyring-20": Run(TABLE1, "shear_law = 'eyring'", 1.1),
    "ball-carreau-10": Run(
        BALL, f"{THICK} shear_law = 'carreau' carreau_stress = 1e5 carreau_exponent = 0.8", 1.05
    ),
    "m300-eyring-10": Run(by_moes(300.0, 12.0), "shear_law = 'eyring'", 1.05),
    "m500-carreau-20": Run(
        by_moes(500.0, 8.0),
        "shear_law = 'carreau' carreau_stress = 1e6 carreau_exponent = 0.6",
        1.1,
    ),
    "table1-carreau-02": Run(
        TABLE1, "shear_law = 'carreau' carreau_stress = 5e6 carreau_exponent = 0.5", 1.01
    ),
    "m200-eyring-01": Run(by_moes(200.0, 10.0), "shear_law = 'eyring' eyring_stress = 1e7", 1.005),
    "m500-eyring-40": Run(by_moes(500.0, 5.0), "shear_law = 'eyring'", 0.8),
    "m2000-eyring-04": Run(by_moes(2000.0, 12.0), "shear_law = 'eyring' eyring_stress = 8e6", 1.02),
    "table1-eyring-100": Run(TABLE1, "shear_law = 'eyring'", 1.5),
    "m500-carreau-100": Run(
        by_moes(500.0, 8.0),
        "shear_law = 'carreau' carreau_stress = 1e6 carreau_exponent = 0.6",
        0.5,
    ),
    "ball-carreau-01": Run(
        BALL, f"{THICK} shear_law = 'carreau' carreau_stress = 3e6 carreau_exponent = 0.7", 1.005
    ),
    "table1-eyring-02-steep": Run(TABLE1, "shear_law = 'eyring'", 1.01, "steep"),
    "m500-carreau-20-steep": Run(
        by_moes(500.0, 8.0),
        "shear_law = 'carreau' carreau_stress = 1e6 carreau_exponent = 0.6",
        1.1,
        "steep",
    ),
    "table1-eyring-02-fine": Run(TABLE1, "shear_law = 'eyring'", 1.01, points=513),
    "m500-carreau-20-fine": Run(
        by_moes(500.0, 8.0),
        "shear_law = 'carreau' carreau_stress = 1e6 carreau_exponent = 0.6",
        1.1,
        points=513,
    ),
}


def twin(run: Run) -> Run:
    """Return the same contact with Newtonian flow."""
    return replace(run, lubricant=f"{run.lubricant} flow = 'newtonian'")


def runs() -> dict[str, Run]:
    """Give all runs by their names; those on finer grids have no twins."""
    twins = {f"{name}-newtonian": twin(r) for name, r in PLAN.items() if r.points == POINTS}
    return PLAN | twins


def waves_of(run: Run) -> WaveSet:
    """Waves of a run."""
    angles = ANGLES[run.angles]
    across = [
        min(round(n * math.tan(math.radians(angles[i % len(angles)]))), ALONG[-1])
        for i, n in enumerate(ALONG)
    ]
    phase = np.random.default_rng(5).uniform(0.0, 2.0 * np.pi, len(ALONG))
    return WaveSet(TILE, np.array(ALONG), np.array(across), phase)


def case_of(run: Run) -> Case:
    """Make the case of contact, lubricant and velocity ratio of a run."""
    text = (
        f"&contact {run.contact} /\n&lubricant {run.lubricant} /\n"
        f"&surface velocity_ratio = {run.velocity_ratio} /\n"
    )
    return Case.from_text(text)


def main(arguments: list[str]) -> None:
    """Measure missing runs."""
    folder = Path(arguments[0])
    folder.mkdir(parents=True, exist_ok=True)
    for name, run in runs().items():
        path = folder / f"{name}.npz"
        if path.exists() or (arguments[1:] and name not in arguments[1:]):
            continue
        waves = waves_of(run)
        print(name, flush=True)
        result = superpose(
            case_of(run).resolve(),
            waves,
            points=run.points,
            velocity_ratio=run.velocity_ratio,
            filling=SETTLED,
            solver={"threads": 1},
        )
        unfinished = path.with_suffix(".unfinished.npz")
        np.savez(unfinished, **asdict(waves), **asdict(result))
        unfinished.rename(path)


if __name__ == "__main__":
    main(sys.argv[1:])
