# SPDX-License-Identifier: BSD-3-Clause
"""Throughput of studies, overhead per case, and the time estimate.

Each problem runs as a study, in one worker process and in several. The start of the workers, which
import the package, is subtracted: it ends when the case of the first row begins.
"""

import argparse
import sys
import tempfile
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from common import add_list, columns, measure, parser, show

from pyehl.case import Case
from pyehl.studies.plan import Plan, plan
from pyehl.studies.study import axis, make
from pyehl.studies.sweep import Watcher, perform
from pyehl.studies.tasks import Task
from pyehl.types import Row

COLUMNS = columns(
    "problem:s cases:d processes:d wall_seconds:.2f estimate_seconds:.2f "
    "cases_per_core_hour:.0f busy:.2f overhead_ms:.2f efficiency:.2f"
)
MEANING = (
    "wall seconds: from the first case to the last row; estimate: of the plan; busy: "
    "fraction of the workers' time in cases;\noverhead: of a case, in the plan and in one "
    "worker; efficiency: throughput over that of the first number of processes"
)
"""Meaning of the columns."""


@dataclass(frozen=True, slots=True)
class Problem:
    """The cases of a study."""

    # Its name, and the kind of run of each case
    name: str
    run: str
    cases: int  # number of cases over the largest number of processes
    # Options ``group.key=value``. The mean velocity is varied, or the key without a value
    options: tuple[str, ...]


FRACTAL = ("surface.kind=fractal",)
WAVE = ("surface.kind=harmonic", "surface.amplitude_over_film=0.3")
SEEDS = "surface.seed"
PROBLEMS = (
    Problem("film", "film", 200, FRACTAL),
    Problem("predict", "predict", 40, FRACTAL),
    Problem("predict shared", "predict", 40, (*FRACTAL, SEEDS)),
    Problem("smooth 257", "solve", 8, ("grid.points=257",)),
    Problem("transient 257", "solve", 2, (*WAVE, "grid.points=257")),
    Problem("transient 513", "solve", 1, (*WAVE, "grid.points=513")),
)
"""Films by formula, predictions of fractal surfaces, smooth contacts, passages of a waviness."""


class _FirstRow(Watcher):
    """Watcher that measures the start of the workers."""

    def __init__(self) -> None:
        self.began_at = self.started = 0.0

    def began(self, tasks: Sequence[Task], done: Sequence[int], workers: int) -> None:
        self.began_at = time.monotonic()

    def finished(self, rows: Sequence[tuple[int, Mapping[str, Any]]]) -> None:
        if not self.started:
            first = float(rows[0][1].get("seconds") or 0.0)
            self.started = time.monotonic() - self.began_at - first


def sweep_rows(problems: Sequence[Problem], processes: Sequence[int]) -> list[Row]:
    """Run problems with each number of worker processes.

    `overhead_ms` is the overhead per case, in the plan (without its fixed cost) and in one worker
    process; `busy` the fraction of the time of the workers spent in cases; `efficiency` the
    throughput over that of the first number of processes times their ratio.
    """
    rows: list[Row] = []
    for problem in problems:
        count = problem.cases * max(processes)
        slowest: float | None = None
        for jobs in processes:
            row = _run(problem, count, jobs)
            rate = count / row["wall_seconds"]
            slowest = slowest or rate / jobs
            row["efficiency"] = rate / (slowest * jobs)
            rows.append(row)
    return rows


def _planned(problem: Problem, count: int) -> tuple[float, Plan]:
    """Plan `count` cases of a problem; returns the time and the plan."""
    began = time.monotonic()
    varied = axis("contact.mean_velocity", f"0.7:1.0:{count}")
    if SEEDS in problem.options:
        varied = axis(SEEDS, f"1:{count}")
    options = [text for text in problem.options if "=" in text]
    todo = plan(make(Case.from_text(""), [varied], options=options, run=problem.run))
    return time.monotonic() - began, todo


def _run(problem: Problem, count: int, jobs: int) -> Row:
    single, _ = _planned(problem, 1)
    planned, todo = _planned(problem, count)
    watcher = _FirstRow()
    with tempfile.TemporaryDirectory(prefix="pyehl-") as folder:
        outcome = perform(todo, folder, jobs=jobs, watcher=watcher)
    if outcome.interrupted:
        raise KeyboardInterrupt
    wall = outcome.wall - watcher.started
    spent = wall * jobs
    return {
        "problem": problem.name,
        "cases": count,
        "processes": jobs,
        "wall_seconds": wall,
        "estimate_seconds": sum(task.seconds for task in todo.tasks) / min(jobs, count),
        "cases_per_core_hour": 3600.0 * count / spent,
        "busy": outcome.busy / spent,
        # with several processes it would include the wait for the last case
        "overhead_ms": 1e3 * (planned - single + wall - outcome.busy) / count
        if jobs == 1
        else None,
        "start_seconds": watcher.started,
        "plan_seconds": planned,
        "statuses": outcome.statuses(),
    }


def work(args: argparse.Namespace) -> Row:
    """Measure and print."""
    rows = sweep_rows(
        [problem for problem in PROBLEMS if problem.name in args.problems], args.threads
    )
    show(rows, COLUMNS, MEANING)
    return {"rows": rows}


def main(words: Sequence[str] | None = None) -> int:
    """Run the script."""
    made = parser(__doc__)
    add_list(made, "threads", (1, 2), "numbers of worker processes")
    names = [problem.name for problem in PROBLEMS]
    add_list(made, "problems", names, known=names)
    return measure(work, made, words)


if __name__ == "__main__":
    sys.exit(main())
