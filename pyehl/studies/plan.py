# SPDX-License-Identifier: BSD-3-Clause
"""The plan of a study: its cases resolved and checked, how long, and what is shared."""

import json
import os
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pyehl import library, surfaces
from pyehl.case import Case, files_of
from pyehl.errors import InputError
from pyehl.given import key_of
from pyehl.prediction.model import unpredictable
from pyehl.prediction.smooth import smooth_case
from pyehl.solver import Solver
from pyehl.studies.estimate import duration, seconds_of, wall_seconds
from pyehl.studies.study import Point, Study
from pyehl.studies.tasks import Task
from pyehl.theory.film import central_film
from pyehl.theory.line_contact import LineContact, contact_of
from pyehl.theory.line_contact import central_film as central_film_of_line
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Settings

THREADS = "solver.threads"
MOST, PATIENCE = 5000, 5.0
"""Maximum number of cases that a plan without a run checks, and seconds that it takes for them."""
CASE_BYTES = 12_000
"""Memory of a case that waits, most of it its resolved text."""
# What may make a case that can be read one that cannot be solved
GROUPS = ("grid", *surfaces.GROUPS, "time", "solver")


class TaskList:
    """Tasks with the time that each may take, as they are added."""

    def __init__(self) -> None:
        self.tasks: list[Task] = []
        self._contacts: set[str] = set()  # smooth contacts under predictions

    def add(
        self, number: int, case: Case, run: str, *, folder: str = "", tracks: bool = False
    ) -> int:
        """Add a task on a checked case; gives its number. With a folder a prediction is whole."""
        settings = case.resolve()
        shares = smooth_case(settings) if run == "predict" else ""
        shared = shares in self._contacts
        seconds = seconds_of(settings, run, shared=shared, full=tracks or bool(folder))
        self._contacts.add(shares)
        self.tasks.append(Task(number, case.text, run, folder, seconds, shares, tracks))
        return number


@dataclass(frozen=True, slots=True)
class Plan:
    """Cases of a study, checked, with what is known before they run."""

    study: Study
    # Its cases in the order of the table; of a large study that is not to run, some of them
    points: tuple[Point, ...]
    tasks: tuple[Task, ...]
    files: tuple[str, ...]  # height maps and tables that they read
    check_seconds: float  # time that the checks took [s]

    def identity(self) -> dict[str, Any]:
        """Give what makes this study another one than others, as values of JSON."""
        return self.study.identity(self.tasks[0].text, self.files)

    def text(self, jobs: int, done: Sequence[int] = ()) -> str:
        """Report the plan in a few lines, for `jobs` worker processes and the cases left."""
        finished = set(done)
        left = [t for t in self.tasks if t.number not in finished]
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
        if not left:
            return "\n".join(lines)
        seconds = [t.seconds for t in left]
        workers = min(jobs, len(left))
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
            f"{cases} cases take {need / 2**30:.2g} GiB of memory to wait in, "
            f"{have / 2**30:.2g} GiB are available; take fewer values"
        )


def plan(study: Study, keep: str | os.PathLike[str] | None = None, *, brief: bool = False) -> Plan:
    """Resolve and check all cases of a study.

    `keep` is the folder for a result folder of each case. `brief`: a plan that is not to run has,
    of a study with more than `MOST` cases, as many as `PATIENCE` allows. InputError if a case is
    not acceptable, with the case and what is wrong with it, or if there are more than fit into
    memory.
    """
    brief = brief and study.size > MOST
    if not brief:
        check_memory(study.size)
    fixed = {key_of(text) for text in study.options} | set(study.keys)
    one_thread = [] if THREADS in fixed else [f"{THREADS}=1"]
    digits = len(str(study.size))
    points, tasks = [], TaskList()
    checked: set[str] = set()
    files: dict[str, None] = {}
    began = time.monotonic()
    for number in study.spread(MOST) if brief else range(study.size):
        if brief and time.monotonic() - began > PATIENCE:
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
    """Refuse a case that can be read but not done, as its run would do."""
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


def formula_film(settings: Settings) -> tuple[OperatingPoint | LineContact, float]:
    """Give the operating point of a resolved case and its central film by formula [m]."""
    contact, lubricant = contact_of(settings), Lubricant.from_settings(settings)
    if isinstance(contact, LineContact):
        return contact, central_film_of_line(contact, lubricant)
    return contact, central_film(contact, lubricant)


def check_maps(settings: Settings, *, read: bool = True) -> None:
    """Refuse a resolved case without a film by formula, or whose height maps cannot be prepared."""
    film = formula_film(settings)
    for group in surfaces.rough_groups(settings):
        if read and settings[group]["kind"] == "map":
            surfaces.from_settings({**settings, "surface": settings[group]}, *film)
