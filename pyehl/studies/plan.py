# SPDX-License-Identifier: BSD-3-Clause
"""The plan of a study: every case resolved and checked, how long, and what is shared."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pyehl import surfaces
from pyehl.case import Case
from pyehl.errors import EhlError, InputError
from pyehl.prediction.options import Options, unpredictable
from pyehl.solver import Solver
from pyehl.studies.estimate import seconds_of, shares_of, speed
from pyehl.studies.study import Point, Study
from pyehl.studies.tasks import Task
from pyehl.theory.film import central_film
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint

__all__ = ["Plan", "duration", "plan"]

Settings = Mapping[str, Mapping[str, Any]]

THREADS = "solver.threads"
# What may make a case that can be read one that cannot be solved
GROUPS = ("grid", "surface", "time", "solver")


@dataclass(frozen=True, slots=True)
class Plan:
    """All cases of a study, checked, with what can be told before they run.

    Attributes
    ----------
    study
        The study.
    points, tasks
        Its cases in the order of the table.
    contacts, surfaces
        Smooth contacts and rough surfaces that differ.
    """

    study: Study
    points: tuple[Point, ...]
    tasks: tuple[Task, ...]
    contacts: int
    surfaces: int

    def text(self, jobs: int, done: Sequence[int] = ()) -> str:
        """Tell the plan in a few lines, for `jobs` worker processes and the cases left."""
        finished = set(done)
        left = [t for t in self.tasks if t.number not in finished]
        names = " x ".join(
            f"{len(axes[0].values)} {' with '.join(a.key for a in axes)}"
            for axes in self.study.dimensions
        )
        lines = [f"study      {len(self.tasks)} cases ({self.study.run}): {names}"]
        if finished:
            lines.append(f"           {len(finished)} of them are done")
        if not left:
            return "\n".join(lines)
        total = sum(t.seconds for t in left)
        longest = max(t.seconds for t in left)
        workers = min(jobs, len(left))
        words = "1 worker process" if workers == 1 else f"{workers} worker processes"
        lines.append(
            f"time       about {duration(max(total / workers, longest))} by estimate, "
            f"{words} of one thread each; the longest case {duration(longest)}"
        )
        if self.study.run == "predict" and len(self.tasks) > 1:
            lines.append(
                f"shared     {self.contacts} smooth contacts and {self.surfaces} surfaces "
                f"for {len(self.tasks)} cases"
            )
        return "\n".join(lines)


def duration(seconds: float) -> str:
    """Give a time in words: '8 s', '3 min', '2.5 h'."""
    if seconds < 0.95:
        return f"{seconds:.1g} s"
    if seconds < 90.0:
        return f"{seconds:.0f} s"
    return f"{seconds / 60.0:.0f} min" if seconds < 5400.0 else f"{seconds / 3600.0:.1f} h"


def plan(study: Study, keep: str | os.PathLike[str] | None = None) -> Plan:
    """Resolve and check all cases of a study.

    Parameters
    ----------
    study
        What to do.
    keep
        Folder for a result folder of each case; None: none is kept.

    Raises
    ------
    InputError
        If a case is not acceptable; the message names the case and what is wrong with it.
    """
    fixed = {text.partition("=")[0].strip().lower() for text in study.options} | set(study.keys)
    one_thread = [] if THREADS in fixed else [f"{THREADS}=1"]
    factor = speed()
    digits = len(str(study.size))
    points, tasks = [], []
    seen: dict[str, set[str]] = {"contact": set(), "surface": set(), "checked": set()}
    for point in study.points():
        case = study.resolved(point, *one_thread)
        settings = case.resolve()
        _check(study, point, case, settings, seen["checked"])
        seen["surface"].add(json.dumps(settings["surface"], default=str))
        folder = "" if keep is None else str(Path(keep) / f"{point.number + 1:0{digits}d}")
        shares = shares_of(settings, study.run)
        full = study.tracks or bool(folder)
        shared = shares in seen["contact"]
        seconds = factor * seconds_of(settings, study.run, shared=shared, full=full)
        seen["contact"].add(shares)
        points.append(point)
        tasks.append(
            Task(point.number, case.text, study.run, folder, seconds, shares, study.tracks)
        )
    return Plan(study, tuple(points), tuple(tasks), len(seen["contact"]), len(seen["surface"]))


def _check(study: Study, point: Point, case: Case, settings: Settings, checked: set[str]) -> None:
    """Refuse a case that can be read but not done, as its run would do."""
    try:
        groups = json.dumps([settings[group] for group in GROUPS], default=str)
        known = groups in checked
        checked.add(groups)
        if study.run == "solve":
            if not known:
                with Solver(case):
                    pass
            return
        operating = OperatingPoint.from_settings(settings)
        lubricant = Lubricant.from_settings(settings)
        film = central_film(operating, lubricant)
        why = unpredictable(str(settings["surface"]["kind"]))
        if study.run == "predict":
            Options.from_settings(settings)
            if why:
                raise InputError(why)
        if settings["surface"]["kind"] == "map" and not known:
            surfaces.from_settings(settings, operating, film)
    except (EhlError, ValueError, OSError) as error:
        raise InputError(f"case {point.number + 1} of {study.size} ({point}):\n{error}") from error
