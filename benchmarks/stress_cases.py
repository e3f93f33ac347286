# SPDX-License-Identifier: BSD-3-Clause
"""Cases of `stress.py`, drawn from a seed over the whole range of the keys."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from pyehl.case import Case
from pyehl.studies.study import Axis, Study, Value, make
from pyehl.theory.operating import OperatingPoint

ROELANDS_Z = 0.6684
"""Roelands z of waves, as in the second solver, which recomputes some; the default is 0.66841."""
GRIDS = (65, 129, 257)
MAX_STEPS = {65: 400, 129: 300, 257: 200}
"""Maximum number of steps of a case by its grid, at which it is ended."""
FAMILIES = {"smooth": 0.15, "wave": 0.5, "rest": 0.1, "fractal": 0.12, "feature": 0.13}
"""Kinds of problems, and the fraction of each."""
LAWS = ("newtonian", "eyring", "carreau")
"""Shear laws of a campaign; each case has its own stress and exponent."""
# X of the front where the roughness begins to have an effect, and where it fills the contact [a]
EFFECTIVE, FILLED = -1.25, 1.05
# Longest wavelengths along X and Y [a]; the latter is a wave without variation along Y
LONGEST_X, LONGEST_Y = 100.0, 1e6
WAVELENGTHS = tuple(0.125 * 2.0 ** (k / 2.0) for k in range(11))
VELOCITIES = (0.1, 0.25, 0.5, 0.75, 0.9, 1.0, 1.01, 1.1, 1.25, 1.5, 2.0)


@dataclass(frozen=True, slots=True)
class StressCase:
    """One case of a campaign."""

    family: str  # one of `FAMILIES`
    # Operating point and grid
    moes_m: float
    moes_l: float
    points: int
    # Keys of its case file
    values: Mapping[str, Value] = field(default_factory=dict)

    @property
    def mesh(self) -> float:
        """Mesh size [a]."""
        point = (f"contact.moes_m={self.moes_m}", f"contact.moes_l={self.moes_l}")
        grid = Case.from_text("", point).resolve()["grid"]
        return 2.0 * float(grid["y_extent"]) / (self.points - 1)


def draw(
    cases: int,
    seed: int,
    grids: Sequence[int] = GRIDS,
    law: str = "newtonian",
    *,
    layer: bool = False,
) -> list[StressCase]:
    """Draw the cases of a seed; each grid has half as many as the one before.

    `layer`: those with a shear law have a boundary film, too.
    """
    generator = np.random.default_rng(seed)
    names = list(FAMILIES)
    shares = np.cumsum(list(FAMILIES.values()))
    drawn = [
        _one(names[int(np.searchsorted(shares, (k + 0.5) / cases * shares[-1]))], generator, grids)
        for k in range(cases)
    ]
    if law == "newtonian":
        return drawn
    # all else is as without a law
    generator = np.random.default_rng((seed, LAWS.index(law)))
    drawn = [_with_law(case, law, generator) for case in drawn]
    if not layer:
        return drawn
    generator = np.random.default_rng((seed, len(LAWS)))
    return [_with_layer(case, generator) for case in drawn]


def _with_layer(case: StressCase, generator: np.random.Generator) -> StressCase:
    """Add a boundary film of 0.2 to 1.5 times the central film to a case in SI units."""
    film = generator.uniform(0.2, 1.5) * _film(case) * _point(case).film_scale
    values = dict(case.values)
    values["lubricant.boundary_film"] = float(f"{film:.3g}")
    values["lubricant.boundary_friction"] = float(f"{generator.uniform(0.05, 0.15):.3g}")
    if values.get("solver.coarsening") == "alcouffe":  # not with a boundary film
        values["solver.coarsening"] = "auto"
    return replace(case, values=values)


def _with_law(case: StressCase, law: str, generator: np.random.Generator) -> StressCase:
    """Add a shear law with its stress to a case, whose contact is converted to SI units."""
    case = replace(case, moes_l=max(case.moes_l, 1.0))
    values = {key: value for key, value in case.values.items() if not key.startswith("contact.")}
    values |= _si(case) | {"lubricant.shear_law": law}
    low, high = (3e5, 3e7) if law == "eyring" else (3e4, 1e7)
    stress = math.exp(generator.uniform(math.log(low), math.log(high)))
    values[f"lubricant.{law}_stress"] = float(f"{stress:.3g}")
    if law == "carreau":
        values["lubricant.carreau_exponent"] = float(f"{generator.uniform(0.3, 0.9):.3g}")
    if case.family == "smooth":
        values["contact.slide_to_roll"] = float(f"{generator.uniform(0.0, 1.9):.3g}")
    return replace(case, values=values)


def _one(family: str, generator: np.random.Generator, grids: Sequence[int]) -> StressCase:
    weights = np.array([0.5**k for k in range(len(grids))])
    points = int(generator.choice(grids, p=weights / weights.sum()))
    moes_m = float(f"{math.exp(generator.uniform(math.log(5.0), math.log(5000.0))):.4g}")
    moes_l = float(f"{generator.uniform(0.0, 25.0):.3g}")
    if family == "fractal":
        moes_l = max(moes_l, 1.0)  # heights in metres need a contact in SI units
    case = StressCase(family, moes_m, moes_l, points)
    values: dict[str, Value] = {"grid.points": points}
    if family == "smooth":
        values |= {"contact.moes_m": moes_m, "contact.moes_l": moes_l}
    elif family in ("wave", "rest"):
        values |= {"contact.moes_m": moes_m, "contact.moes_l": moes_l}
        values |= _wave(case, generator, at_rest=family == "rest")
    elif family == "fractal":
        values |= _si(case) | _fractal(case, generator)
    else:
        values |= {"contact.moes_m": moes_m, "contact.moes_l": moes_l}
        values |= _feature(case, generator)
    return StressCase(family, moes_m, moes_l, points, values)


def _wave(case: StressCase, generator: np.random.Generator, *, at_rest: bool) -> dict[str, Value]:
    velocity = 0.0 if at_rest else float(generator.choice(VELOCITIES))
    # the grid resolves waves longer than two mesh sizes, in space and in time
    minimum = 2.2 * case.mesh
    along = [w for w in WAVELENGTHS if w > minimum * max(1.0, velocity)]
    across = [w for w in WAVELENGTHS if w > minimum]
    wave_x = float(generator.choice([*along, LONGEST_X]))
    wave_y = float(generator.choice([*across, LONGEST_Y]))
    return {
        "surface.amplitude_over_film": float(f"{generator.uniform(0.0, 1.2):.3g}"),
        "surface.wavelength_x": wave_x,
        "surface.wavelength_y": wave_y,
        "surface.velocity_ratio": velocity,
        "time.scheme": str(generator.choice(("narrow", "narrow", "paper"))),
        "time.steps": 0 if at_rest else _steps(case, wave_x, wave_x, velocity),
        "solver.coarsening": str(generator.choice(("auto", "auto", "classical", "alcouffe"))),
    }


def _fractal(case: StressCase, generator: np.random.Generator) -> dict[str, Value]:
    velocity = float(generator.choice(VELOCITIES[2:]))
    point = _point(case)
    film = _film(case) * point.film_scale
    return {
        "surface.rms_height": float(f"{generator.uniform(0.02, 0.4) * film:.4g}"),
        "surface.hurst": float(f"{generator.uniform(0.4, 1.0):.3g}"),
        "surface.length_x": float(f"{2.0 * point.hertz_radius:.5g}"),
        "surface.length_y": float(f"{2.0 * point.hertz_radius:.5g}"),
        "surface.seed": int(generator.integers(1, 1000)),
        "surface.velocity_ratio": velocity,
        "time.scheme": str(generator.choice(("narrow", "narrow", "paper"))),
        "time.steps": _steps(case, 2.0, 0.5, velocity),
    }


def _feature(case: StressCase, generator: np.random.Generator) -> dict[str, Value]:
    velocity = float(generator.choice(VELOCITIES))
    minimum = 4.0 * case.mesh
    wide = [w for w in WAVELENGTHS if minimum <= w <= 2.0]
    return {
        "surface.kind": str(generator.choice(("dent", "bump", "ridge", "groove"))),
        "surface.amplitude_over_film": float(f"{generator.uniform(0.0, 1.2):.3g}"),
        "surface.width": float(generator.choice(wide)),
        "surface.angle": float(generator.integers(0, 90)),
        "surface.y_start": float(f"{generator.uniform(-0.5, 0.5):.3g}"),
        "surface.velocity_ratio": velocity,
        "time.scheme": str(generator.choice(("narrow", "narrow", "paper"))),
        "time.steps": MAX_STEPS[case.points],
    }


def _steps(case: StressCase, period: float, front: float, velocity: float) -> int:
    """Return the number of steps to end at; 0 if the run may end by itself."""
    start = max(-2.5, EFFECTIVE - 0.5 * front)
    needed = (FILLED - start + 1.5 * period) / (velocity * case.mesh)
    return 0 if needed <= MAX_STEPS[case.points] else MAX_STEPS[case.points]


def _film(case: StressCase) -> float:
    """Approximate central film [a^2/R], 1.3 M^-1/12 L^3/4 (3M/2)^-2/3 with L of at least 2."""
    piezo = 1.3 * case.moes_m ** (-1.0 / 12.0) * max(case.moes_l, 2.0) ** 0.75
    return float(piezo * (1.5 * case.moes_m) ** (-2.0 / 3.0))


def _point(case: StressCase) -> OperatingPoint:
    """Return a contact in SI units with the M and L of a case."""
    return OperatingPoint.from_moes(case.moes_m, case.moes_l)


def _si(case: StressCase) -> dict[str, Value]:
    point = _point(case)
    names = ("mean_velocity", "load", "radius", "reduced_modulus")
    return {f"contact.{name}": getattr(point, name) for name in names}


def study_of(
    family: str,
    cases: Sequence[StressCase],
    values: Sequence[Mapping[str, Any]] = (),
    *,
    fields: bool = False,
) -> Study:
    """Return the study of cases of one family, at least one, as for ``pyehl sweep``.

    `values` are keys that replace those of each case; None removes a key.
    """
    kinds = {"wave": "harmonic", "rest": "harmonic"}
    more = values or [{}] * len(cases)
    chosen = [{**case.values, **others} for case, others in zip(cases, more, strict=True)]
    axes = [
        Axis(key, tuple(row[key] for row in chosen))
        for key in chosen[0]
        if chosen[0][key] is not None
    ]
    options = [f"output.fields=.{str(fields).lower()}."]
    if family != "feature":
        options.append(f"surface.kind={kinds.get(family, family)}")
    if family in ("wave", "rest"):
        options.append(f"lubricant.roelands_z={ROELANDS_Z}")
    return make(Case.from_text(""), axes, options=options, zipped=True)
