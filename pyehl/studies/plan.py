# SPDX-License-Identifier: BSD-3-Clause
"""The plan of a study: its cases resolved and checked, their time, and shared work.

Estimates of time are for one thread of the machine on which they were measured, within about a
factor of two: they start long cases first and show the order of magnitude of a study. Finished
cases correct them.
"""

import json
import os
import time
from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pyehl import library, surfaces
from pyehl.case import Case, files_of
from pyehl.case.line import TRANSVERSE
from pyehl.contact.smooth import POINTS, smooth_case
from pyehl.errors import InputError
from pyehl.given import key_of
from pyehl.prediction.predict import other_spectra_count, unpredictable
from pyehl.solver import Solver
from pyehl.studies.pool import processors
from pyehl.studies.study import Point, Study
from pyehl.studies.tasks import Task
from pyehl.surfaces import FEATURES, rough_groups
from pyehl.theory.line_contact import AnyContact, scaling_contact
from pyehl.theory.line_contact import formula_film as film_by_formula
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.shear import ShearLaw
from pyehl.types import Row, Settings

PREDICTION, PREDICTION_PIXEL = 0.1, 1.4e-6
"""Seconds of a prediction, and per pixel of its tile, without the smooth contact under it."""
FULL = 2.8
"""Time of a prediction with tracks and bands over that of one without."""
PAIR, THINS, WIDER = 3.5, 2.0, 1.2
"""Factors of the time: two rough surfaces together over both alone, and a shear-thinning flow;
exponent of b/a, or of a/b, in the time."""
CONTACT = 1.0
"""Seconds of the solid contact at a boundary film."""
HEAVY = (2500.0, 5000.0)
"""M above which the smooth contact of a prediction cannot be extrapolated on POINTS nodes, and on
twice as many per side."""
START = 0.7
"""Seconds to start a worker process."""
FILM = 2e-3
"""Seconds of a case by film formulas."""
SMOOTH_LINE, SMOOTH_NODE = 5e-4, 5e-7
"""Seconds of a smooth contact per line and per node of its finest grid."""
STEP_NODE, MANY_WAVES = 2.7e-7, 1.25
"""Seconds of a time step of a waviness per node; factor for surfaces of many waves."""


def smooth_seconds(points: int, aspect: float = 1.0) -> float:
    """Seconds of a smooth contact on points x (aspect points) nodes."""
    return aspect * (SMOOTH_LINE * points + SMOOTH_NODE * points**2)


def seconds_of(settings: Settings, run: str, *, shared: bool = False, full: bool = False) -> float:
    """Seconds of a resolved case on one thread of the machine of the measurements.

    `shared`: the smooth contact of a prediction is already solved; `full`: with tracks and bands.
    """
    if run == "film":
        return FILM
    rough = [settings[group] for group in rough_groups(settings)]
    grid = settings["grid"]
    points = int(grid["points"])
    line = settings["contact"].get("shape") == "line"
    aspect = _strip(settings) if line else (int(grid["points_y"]) - 1) / (points - 1)
    if run == "predict":
        return _predict_seconds(settings, aspect, shared=shared, full=full)
    smooth = smooth_seconds(points, aspect)
    moving = [surface for surface in rough if float(surface["velocity_ratio"]) > 0.0]
    if not moving:
        return smooth
    mesh = (float(grid["x_outlet"]) - float(grid["x_inlet"])) / (points - 1)
    # two surfaces count as the slower one, although their common period may be longer
    longest = max(_time_to_settle(surface, settings) for surface in moving)
    steps = int(settings["time"]["steps"]) or longest / mesh
    hard = 1.0 if all(surface["kind"] == "harmonic" for surface in moving) else MANY_WAVES
    coarser = 9.0 / 8.0 if settings["time"]["estimate_error"] else 1.0
    return smooth + hard * coarser * STEP_NODE * points**2 * aspect * steps


def _strip(settings: Settings) -> float:
    """Rows of the strip of a line contact over its nodes along X; at least one row."""
    grid, b = settings["grid"], scaling_contact(settings).hertz_radius
    widths = [0.0]
    for surface in (settings[group] for group in rough_groups(settings)):
        if surface["kind"] == "harmonic":
            widths.append(float(surface["wavelength_y"]) % TRANSVERSE)
        elif surface["kind"] not in FEATURES:
            widths.append(float(surface["length_y"]) / b)
    domain = float(grid["x_outlet"]) - float(grid["x_inlet"])
    return max(1.0 / int(grid["points"]), max(widths) / domain)


def _predict_seconds(settings: Settings, aspect: float, *, shared: bool, full: bool) -> float:
    rough = [settings[group] for group in rough_groups(settings)]
    point = scaling_contact(settings)
    thins = ShearLaw.from_settings(settings).in_flow
    sides = [int(s["pixels"]) if s["kind"] == "fractal" else 256 for s in rough]
    alone = sum(PREDICTION + PREDICTION_PIXEL * side**2 for side in sides)
    beside = other_spectra_count(settings, rough_groups(settings))
    alone *= (FULL + beside if full else 1.0) * (PAIR if len(rough) > 1 else 1.0)
    alone *= THINS if thins else 1.0
    kappa = point.ellipse.side
    alone *= max(kappa, 1.0 / kappa) ** WIDER
    if settings["lubricant"]["boundary_film"] > 0.0:
        alone += CONTACT
    if settings["psd"]["smooth"] != "solved" or shared:
        return alone
    grids = 1 + sum(point.moes_m > limit for limit in HEAVY)
    smooth = sum(smooth_seconds(2**k * (POINTS - 1) + 1, aspect) for k in range(grids))
    return alone + smooth * (THINS if thins else 1.0)


def _time_to_settle(surface: Mapping[str, Any], settings: Settings) -> float:
    """Time in a/u until the friction is known: entry into the contact and three periods.

    For a single feature, its passage.
    """
    if surface["kind"] in FEATURES:
        # from the inlet until it has left
        width = surface.get("width")
        if width is None:
            width = float(surface["width_m"]) / scaling_contact(settings).hertz_radius
        return (2.3 + 1.2 * float(width)) / float(surface["velocity_ratio"])
    if surface["kind"] == "harmonic":
        period = float(surface["wavelength_x"])
    elif settings["contact"].get("moes_l") == 0.0:
        period = 2.0  # no length follows from M alone
    else:
        period = float(surface["length_x"]) / scaling_contact(settings).hertz_radius
    entry = 1.05 - max(-1.5, float(surface["x_start"]))
    return (entry + 3.0 * period) / float(surface["velocity_ratio"])


def duration(seconds: float) -> str:
    """Give a time as text: '8 s', '3 min', '2.5 h'."""
    if seconds < 0.95:
        return f"{seconds:.1g} s"
    if seconds < 90.0:
        return f"{seconds:.0f} s"
    return f"{seconds / 60.0:.0f} min" if seconds < 5400.0 else f"{seconds / 3600.0:.1f} h"


class Remaining:
    """The time of the remaining tasks of a study, corrected by that of the finished ones."""

    def __init__(self, tasks: Sequence[Task], workers: int) -> None:
        self._tasks = {task.number: task for task in tasks}
        self._workers = workers
        self._began = time.monotonic()
        # Seconds by kind of task: estimated for remaining and for finished ones, and measured
        self._left: defaultdict[str, float] = defaultdict(float)
        self._estimated, self._measured = self._left.copy(), self._left.copy()
        for task in tasks:
            self._left[task.run] += task.seconds
        self.total = self.estimate

    @property
    def count(self) -> int:
        """Number of remaining tasks."""
        return len(self._tasks)

    @property
    def estimate(self) -> float:
        """Estimated seconds of the remaining tasks."""
        return sum(self._left.values())

    def remove(self, rows: Sequence[tuple[int, Row]]) -> None:
        """Remove finished tasks."""
        for number, row in rows:
            task = self._tasks.pop(number)
            self._left[task.run] -= task.seconds
            if row["seconds"] is not None:
                self._estimated[task.run] += task.seconds
                self._measured[task.run] += row["seconds"]

    @property
    def seconds(self) -> float:
        """Remaining wall time [s]: each kind of task is scaled by its finished ones."""
        done, estimated = sum(self._measured.values()), sum(self._estimated.values())
        mean = done / estimated if estimated else 1.0
        remaining = sum(
            seconds * (self._measured[run] / self._estimated[run] if self._estimated[run] else mean)
            for run, seconds in self._left.items()
        )
        if self._workers:
            return remaining / self._workers
        return remaining * (time.monotonic() - self._began) / done if done else remaining


def wall_seconds(seconds: Sequence[float], jobs: int, repeat: float = 1.0) -> float:
    """Wall time [s] of tasks in `jobs` worker processes under the present load of the machine.

    Each of the `seconds` represents `repeat` tasks.
    """
    workers = min(jobs, len(seconds))
    slower = max(1.0, (os.getloadavg()[0] + workers) / processors())
    return START + slower * max(repeat * sum(seconds) / workers, *seconds)


THREADS = "solver.threads"
MAX_CHECKED, MAX_SECONDS = 5000, 5.0
"""Maximum number of cases, and maximum seconds, of the checks of a plan without a run."""
CASE_BYTES = 12_000
"""Memory of a waiting case, mostly its resolved text."""
# Groups that may make a valid case unsolvable
GROUPS = ("grid", *surfaces.GROUPS, "time", "solver")


class TaskList:
    """A growing list of tasks with their estimated times."""

    def __init__(self) -> None:
        self.tasks: list[Task] = []
        self._contacts: set[str] = set()  # smooth contacts under predictions

    def add(
        self, number: int, case: Case, run: str, *, folder: str = "", tracks: bool = False
    ) -> int:
        """Add a task on a checked case; returns its number. A folder needs a full prediction."""
        settings = case.resolve()
        shares = smooth_case(settings) if run == "predict" else ""
        shared = shares in self._contacts
        seconds = seconds_of(settings, run, shared=shared, full=tracks or bool(folder))
        self._contacts.add(shares)
        self.tasks.append(Task(number, case.text, run, folder, seconds, shares, tracks))
        return number


@dataclass(frozen=True, slots=True)
class Plan:
    """Cases of a study, checked, with estimates of their run."""

    study: Study
    # Its cases in the order of the table; only some of a large study that is not run
    points: tuple[Point, ...]
    tasks: tuple[Task, ...]
    files: tuple[str, ...]  # height maps and tables that they read
    check_seconds: float  # time that the checks took [s]

    def identity(self) -> dict[str, Any]:
        """Give the identity of this study, as values of JSON."""
        return self.study.identity(self.tasks[0].text, self.files)

    def text(self, jobs: int, done: Sequence[int] = ()) -> str:
        """Report the plan in a few lines, for `jobs` worker processes and the remaining cases."""
        finished = set(done)
        remaining = [t for t in self.tasks if t.number not in finished]
        names = " x ".join(
            f"{len(axes[0].values)} {' with '.join(a.key for a in axes)}"
            for axes in self.study.dimensions
        )
        size, checked = self.study.size, len(self.tasks)
        lines = [f"study      {size} cases ({self.study.run}): {names}"]
        if checked < size:
            lines.append(
                f"checked    {checked} of them, spread over the values of each key; a run checks "
                f"all before the first, in about {duration(self.check_seconds * size / checked)}"
            )
        if finished:
            lines.append(f"           {len(finished)} of them are done")
        if not remaining:
            return "\n".join(lines)
        seconds = [t.seconds for t in remaining]
        workers = min(jobs, len(remaining))
        words = "1 worker process" if workers == 1 else f"{workers} worker processes"
        lines.append(
            f"time       about {duration(wall_seconds(seconds, jobs, size / checked))} by "
            f"estimate, {words} of one thread each; the longest case {duration(max(seconds))}"
        )
        return "\n".join(lines)


def check_memory(cases: int) -> None:
    """Refuse more cases than can wait in memory.

    InputError with the memory that they need, and that there is.
    """
    need, have = CASE_BYTES * cases, library.free_bytes()
    if need > have:
        raise InputError(
            f"{cases} waiting cases take {need / 2**30:.2g} GiB of memory, "
            f"{have / 2**30:.2g} GiB are available; take fewer values"
        )


def plan(study: Study, keep: str | os.PathLike[str] | None = None, *, brief: bool = False) -> Plan:
    """Resolve and check all cases of a study.

    `keep` is the folder for a result folder of each case. `brief`: the plan is not run, and of more
    than `MAX_CHECKED` cases it has only as many as can be checked in `MAX_SECONDS`. InputError
    names a case that is not acceptable and the reason, or reports more cases than fit into memory.
    """
    brief = brief and study.size > MAX_CHECKED
    if not brief:
        check_memory(study.size)
    fixed = {key_of(text) for text in study.options} | set(study.keys)
    one_thread = [] if THREADS in fixed else [f"{THREADS}=1"]
    digits = len(str(study.size))
    points, tasks = [], TaskList()
    checked: set[str] = set()
    files: dict[str, None] = {}
    began = time.monotonic()
    for number in study.spread(MAX_CHECKED) if brief else range(study.size):
        if brief and time.monotonic() - began > MAX_SECONDS:
            break
        point = study.point(number)
        case = study.resolved(point, *one_thread)
        settings = case.resolve()
        with study.named(point):
            _check(study, case, settings, checked)
        files |= dict.fromkeys(files_of(settings))
        folder = "" if keep is None else str(Path(keep) / f"{point.number + 1:0{digits}d}")
        points.append(point)
        tasks.add(number, case, study.run, folder=folder, tracks=study.tracks)
    return Plan(study, tuple(points), tuple(tasks.tasks), tuple(files), time.monotonic() - began)


def _check(study: Study, case: Case, settings: Settings, checked: set[str]) -> None:
    """Refuse a valid case that its run would refuse."""
    groups = json.dumps([settings.get(group) for group in GROUPS], default=str)
    known = groups in checked
    checked.add(groups)
    if study.run == "solve":
        if not known:
            with Solver(case):
                pass
        return
    why = unpredictable(settings)
    if study.run == "predict" and why:
        raise InputError(why)
    check_maps(settings, read=not known)


def formula_film(settings: Settings) -> tuple[AnyContact, float]:
    """Give the operating point of a resolved case and its central film by formula [m]."""
    contact = scaling_contact(settings)
    return contact, film_by_formula(contact, Lubricant.from_settings(settings))


def check_maps(settings: Settings, *, read: bool = True) -> None:
    """Refuse a resolved case without a film by formula, or whose height maps cannot be prepared."""
    film = formula_film(settings)
    for group in surfaces.rough_groups(settings):
        if read and settings[group]["kind"] == "map":
            surfaces.from_settings({**settings, "surface": settings[group]}, *film)
