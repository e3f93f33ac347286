# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl sweep``: many cases, one table."""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from tqdm import tqdm

from pyehl.errors import InputError
from pyehl.studies.plan import Plan, duration, plan
from pyehl.studies.pool import processors
from pyehl.studies.study import RUNS, make, read_study
from pyehl.studies.sweep import CASES, CSV, NETCDF, Outcome, Watcher, perform
from pyehl.studies.tasks import FAILED
from pyehl.studies.vary import parse_axis

__all__ = ["Terminal", "add_arguments", "add_worker_arguments", "execute"]

EXIT_OK, EXIT_FAILED, EXIT_INTERRUPTED = 0, 1, 130
# Seconds between lines where the output is not a terminal
LINE_INTERVAL = 5.0


class Terminal(Watcher):
    """Prints the plan, then a bar that counts estimated seconds, or a line now and then."""

    def __init__(self, jobs: int, *, quiet: bool = False) -> None:
        self._jobs, self._quiet = jobs, quiet
        self._seconds: dict[int, float] = {}
        self._count = self._failed = self._size = 0
        self._bar: tqdm | None = None
        self._last = self._start = time.monotonic()
        self._done = 0.0

    def began(self, plan: Plan, done: Sequence[int], damaged: int) -> None:
        """Print the plan."""
        self._size = len(plan.tasks)
        self._count = len(done)
        finished = set(done)
        self._seconds = {t.number: t.seconds for t in plan.tasks if t.number not in finished}
        if self._quiet:
            return
        if damaged:
            print(f"note       {damaged} damaged rows of the journal run again", file=sys.stderr)
        print(plan.text(self._jobs, done), flush=True)
        self._start = self._last = time.monotonic()
        self._bar = tqdm(
            total=sum(self._seconds.values()) or None,
            bar_format="{percentage:3.0f}%|{bar}|{desc} [{elapsed}, left {remaining}]",
            disable=not sys.stderr.isatty(),
        )

    def finished(self, rows: Sequence[tuple[int, dict[str, Any]]]) -> None:
        """Show how far it is."""
        self._count += len(rows)
        self._failed += sum(row.get("status") == FAILED for _, row in rows)
        seconds = sum(self._seconds[number] for number, _ in rows)
        self._done += seconds
        if self._bar is None:
            return
        if not self._bar.disable:
            self._bar.set_description_str(f" {self._told()}", refresh=False)
            self._bar.update(seconds)
        elif time.monotonic() - self._last > LINE_INTERVAL and self._count < self._size:
            self._last = time.monotonic()
            left = (self._last - self._start) * (sum(self._seconds.values()) / self._done - 1.0)
            print(f"{self._told()}, about {duration(max(left, 0.0))} left", flush=True)

    def _told(self) -> str:
        failed = f", {self._failed} failed" if self._failed else ""
        return f"{self._count} of {self._size} cases{failed}"

    def close(self) -> None:
        """End the bar."""
        if self._bar is not None:
            self._bar.close()


def add_worker_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of all subcommands that run many cases."""
    parser.add_argument("-o", "--output", metavar="DIR", required=True, help="folder of the study")
    parser.add_argument(
        "--jobs", type=int, default=0, metavar="N", help="worker processes (default: processors)"
    )
    parser.add_argument(
        "--scheduler",
        default="",
        metavar="ADDRESS",
        help="use the workers of a dask scheduler, as tcp://host:8786 (extra 'cluster')",
    )
    parser.add_argument("-q", "--quiet", action="store_true", help="print nothing but errors")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of ``pyehl sweep``."""
    parser.description = (
        "Run a case with many values, in worker processes; started again it runs what is missing. "
        "Exit status: 0 all cases ran, 1 some failed, 2 bad input (nothing has run), "
        "130 interrupted."
    )
    parser.add_argument("case", metavar="CASE.nml|STUDY.toml", help="case file or study file")
    parser.add_argument(
        "--vary",
        action="append",
        default=[],
        metavar="GROUP.KEY=VALUES",
        help="start:stop:count, start:stop:countlog, start:stop (whole numbers) or a,b,c; "
        "may be repeated",
    )
    parser.add_argument(
        "--set",
        dest="overrides",
        action="append",
        default=[],
        metavar="GROUP.KEY=VALUE",
        help="replace a value in all cases; may be repeated",
    )
    parser.add_argument("--run", choices=RUNS, help="what to do with each case (default: solve)")
    parser.add_argument("--zip", action="store_true", help="all varied keys move together")
    parser.add_argument("--keep", action="store_true", help="a result folder for each case")
    parser.add_argument("--retry", action="store_true", help="run cases again that failed")
    parser.add_argument(
        "--plan", action="store_true", help="check all cases, print the plan, run nothing"
    )
    add_worker_arguments(parser)


def _arguments(args: argparse.Namespace) -> dict[str, Any]:
    """Give the arguments of a study, from its file and the command line."""
    given: dict[str, Any] = {"case": args.case, "axes": [], "options": [], "zipped": False}
    if args.case.endswith(".toml"):
        given = read_study(args.case)
    axes = [parse_axis(text) for text in args.vary]
    return given | {
        "axes": [*given["axes"], *axes],
        "options": [*given["options"], *args.overrides],
        "zipped": args.zip or given["zipped"],
        "run": args.run or given.get("run", "solve"),
    }


def report(outcome: Outcome, folder: Path, workers: int) -> str:
    """Return the lines that are printed at the end."""
    counts = ", ".join(f"{n} {status}" for status, n in sorted(outcome.statuses.items()))
    lines = [f"cases      {len(outcome.rows)} in the table: {counts or 'none'}"]
    if outcome.ran and outcome.wall > 0.0:
        share = outcome.busy / (outcome.wall * workers)
        saved = f"; shared parts saved {duration(outcome.saved)}" if outcome.saved > 0.0 else ""
        lines.append(
            f"           {outcome.ran} ran now in {duration(outcome.wall)}, "
            f"the workers {100.0 * min(share, 1.0):.0f} % busy{saved}"
        )
    lines.append(f"results    {folder / CSV}, {folder / NETCDF}")
    return "\n".join(lines)


def execute(args: argparse.Namespace) -> int:
    """Run ``pyehl sweep``."""
    if args.jobs < 0:
        raise InputError(f"--jobs {args.jobs}: expected a number of worker processes")
    jobs = args.jobs or processors()
    folder = Path(args.output)
    todo = plan(make(**_arguments(args)), folder.absolute() / CASES if args.keep else None)
    if args.plan:
        print(todo.text(jobs))
        return EXIT_OK
    watcher = Terminal(jobs, quiet=args.quiet)
    try:
        outcome = perform(
            todo,
            folder,
            jobs=jobs,
            scheduler=args.scheduler,
            retry=args.retry,
            watcher=watcher,
        )
    finally:
        watcher.close()
    if not args.quiet:
        print(report(outcome, folder, max(1, min(jobs, outcome.ran))))
    if outcome.interrupted:
        print(f"interrupted; the same command goes on in {folder}", file=sys.stderr)
        return EXIT_INTERRUPTED
    return EXIT_FAILED if FAILED in outcome.statuses else EXIT_OK
