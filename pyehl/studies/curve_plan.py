# SPDX-License-Identifier: BSD-3-Clause
"""The plan of a Stribeck curve: its points and tasks.

At each point the smooth contact is solved, the friction of one or several surfaces is predicted,
and at some points the passage of the surface is solved in full. All of these are tasks of one
study, so that an interrupted curve can be resumed.
"""

import os
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from pyehl import surfaces
from pyehl.case import Case, files_of
from pyehl.case.duty import refuse_duty
from pyehl.contact.smooth import CYCLES, touching_points
from pyehl.errors import InputError
from pyehl.prediction.predict import oblique, unpredictable
from pyehl.studies.plan import TaskList, check_maps, check_memory, duration, wall_seconds
from pyehl.studies.study import MAX_CASES, Axis, Point, Study, make
from pyehl.studies.tasks import Task
from pyehl.theory.line_contact import contact_of
from pyehl.theory.load_share import LoadShare
from pyehl.types import Settings

KEYS = {
    "speed": "contact.mean_velocity",
    "viscosity": "lubricant.viscosity",
    "load": "contact.load",
    "load-per-length": "contact.load_per_length",
    "temperature": "lubricant.temperature",
    "slide-to-roll": "contact.slide_to_roll",
}
"""Keys that a curve may vary, by the option of the command."""
MAX_SURFACES = 1000


@dataclass(frozen=True, slots=True)
class CurvePoint:
    """One point of a curve and its tasks."""

    point: Point  # its index and varied values
    settings: Settings  # the resolved case
    smooth: int  # number of the task that solves the smooth contact
    # Numbers of the prediction tasks, one for each surface; empty for a smooth one
    predictions: tuple[int, ...]
    full: int | None  # number of the task that solves the passage of the surface


@dataclass(frozen=True, slots=True)
class CurvePlan:
    """A curve to be computed."""

    study: Study  # the varied keys
    points: tuple[CurvePoint, ...]  # points in the order of the table
    tasks: tuple[Task, ...]  # all tasks
    surfaces: int  # surfaces at each point
    load_share: LoadShare | None = None  # the empirical law of a thin film, if requested

    def identity(self) -> dict[str, Any]:
        """Give the identity of this curve, as values of JSON."""
        full = [p.point.number for p in self.points if p.full is not None]
        files = {name: None for p in self.points for name in files_of(p.settings)}
        first = (*self.points[0].predictions, self.points[0].smooth)[0]
        result = self.study.identity(self.tasks[first].text, files)
        return result | {"run": "stribeck", "surfaces": self.surfaces, "ehl": full}

    def text(self, jobs: int, done: Sequence[int] = ()) -> str:
        """Report the plan in a few lines, for `jobs` worker processes and the remaining tasks."""
        finished = set(done)
        remaining = [t.seconds for t in self.tasks if t.number not in finished]
        full = sum(p.full is not None for p in self.points)
        each = "surface" if self.surfaces == 1 else f"{self.surfaces} surfaces"
        rough = any(p.predictions for p in self.points)
        lines = [
            f"curve      {len(self.points)} points over {', '.join(self.study.keys)}: at each the "
            "smooth contact"
            + (f" and a prediction for the {each}" if rough else "")
            + (f"; the full simulation at {full}" if full else "")
        ]
        if finished:
            lines.append(f"           {len(finished)} of {len(self.tasks)} tasks are done")
        if remaining:
            lines.append(f"time       about {duration(wall_seconds(remaining, jobs))} by estimate")
        return "\n".join(lines)


def plan_curve(
    case: Case | str | os.PathLike[str],
    axes: Sequence[Axis],
    *,
    options: Iterable[str] = (),
    ehl: int = 0,
    seeds: int = 1,
    load_share: LoadShare | None = None,
) -> CurvePlan:
    """Resolve and check all points of a curve. Smooth surfaces have mu_r/mu_s = 1.

    The points are all combinations of the values of the axes, keys of `KEYS`. The passage of the
    surface is solved in full at `ehl` points, spread over the curve; each point has `seeds`
    surfaces, with consecutive seeds from that of the case. `load_share` adds friction by an
    empirical law for thin films. InputError names a case that is not acceptable, or reports too
    many.
    """
    study = make(case, axes, options=options, run="predict")
    size = study.size
    if not 0 <= ehl <= size:
        raise InputError(f"ehl = {ehl}: expected 0 to {size}, the number of points")
    if not 1 <= seeds <= MAX_SURFACES:
        raise InputError(
            f"surfaces = {seeds}: expected 1 to {MAX_SURFACES}; the spread of {MAX_SURFACES} is "
            "uncertain by 2 %"
        )
    count = size * (1 + seeds) + ehl
    if count > MAX_CASES:
        raise InputError(
            f"{size} points with {seeds} surfaces each are {count} cases; a study can have "
            f"{MAX_CASES}"
        )
    check_memory(count)
    chosen = {int((k + 0.5) * size / ehl) for k in range(ehl)}
    points: list[CurvePoint] = []
    tasks = TaskList()

    def add(made: Case, run: str) -> int:
        return tasks.add(len(tasks.tasks), made, run)

    for point in study.points():
        rough = study.resolved(point)
        settings = rough.resolve()
        with study.named(point):
            refuse_duty(settings)
            _check(settings, seeds, ehl)
            if load_share is not None:
                _check_share(settings)
        groups = surfaces.rough_groups(settings)
        varied = [_with_seeds(rough, settings, k) for k in range(seeds if groups else 0)]
        points.append(
            CurvePoint(
                point,
                settings,
                smooth=add(_smooth(rough, settings), "solve"),
                predictions=tuple(add(made, "predict") for made in varied),
                full=add(rough, "solve") if point.number in chosen else None,
            )
        )
    return CurvePlan(study, tuple(points), tuple(tasks.tasks), seeds, load_share)


def _check_share(settings: Settings) -> None:
    """Refuse cases that the empirical law of a thin film does not cover."""
    if not surfaces.rough_groups(settings):
        raise InputError(
            "boundary friction: surface.kind = 'smooth' has no Lambda\nexpected: a rough surface"
        )
    if settings["lubricant"]["shear_law"] == "newtonian":
        raise InputError(
            "boundary friction: a Newtonian lubricant gives a friction ratio only\n"
            "expected: lubricant.shear_law = 'eyring', 'limiting' or 'carreau'"
        )


def _check(settings: Settings, seeds: int, ehl: int) -> None:
    """Refuse cases that have no curve."""
    groups = surfaces.rough_groups(settings)
    why = unpredictable(settings) if groups else oblique(settings)
    if why:
        raise InputError(why)
    if not groups and ehl:
        raise InputError(f"ehl = {ehl}: surface.kind = 'smooth' has no passage to solve")
    if seeds > 1 and not _fractal(settings):
        kinds = " and ".join(f"{g}.kind = '{settings[g]['kind']}'" for g in groups or ["surface"])
        raise InputError(f"surfaces = {seeds}: {kinds} has no seed")
    if not contact_of(settings).si:
        raise InputError("a Stribeck curve needs a contact in SI units (load, mean_velocity)")
    check_maps(settings)


def _fractal(settings: Settings) -> list[str]:
    """Name the groups of the surfaces that have a seed."""
    groups = surfaces.rough_groups(settings)
    return [group for group in groups if settings[group]["kind"] == "fractal"]


def _with_seeds(case: Case, settings: Settings, offset: int) -> Case:
    """Give a case with `offset` added to the seeds of its surfaces."""
    groups = _fractal(settings) if offset else []
    seeds = {f"{group}.seed": int(settings[group]["seed"]) + offset for group in groups}
    return case.with_options(seeds) if seeds else case


def _smooth(case: Case, settings: Settings) -> Case:
    """Give a case without its roughness, on a grid that resolves the inlet if bodies may touch."""
    points = touching_points(settings)
    if points > int(settings["grid"]["points"]) and not settings["grid"]["target_error"]:
        cycles = max(CYCLES, int(settings["solver"]["max_cycles"]))
        case = case.with_options({"grid.points": points, "solver.max_cycles": cycles})
    return case.smooth()
