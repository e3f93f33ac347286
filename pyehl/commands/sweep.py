# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl sweep``: many cases, one table."""

import argparse
from contextlib import closing
from pathlib import Path
from typing import Any

from pyehl.commands.arguments import add_overrides
from pyehl.commands.watching import Terminal, add_worker_arguments, jobs_of, report_missing
from pyehl.errors import EXIT_FAILED, EXIT_INTERRUPTED, EXIT_OK, InputError
from pyehl.studies.plan import MAX_CHECKED, duration, plan
from pyehl.studies.study import RUNS, make, parse_axis, read_study
from pyehl.studies.sweep import CASES, CSV, NETCDF, Outcome, perform
from pyehl.studies.tasks import FAILED, FINDINGS, why_none


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.description = (
        "Run a case with many values, in worker processes; a repeated call runs what is missing. "
        "Exit status: 0 all cases have a result, of which film breakdown is one, 1 at least one "
        "has none, 2 bad input (nothing has run), 130 interrupted."
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
    add_overrides(parser, "of all cases")
    parser.add_argument("--run", choices=RUNS, help="what to do with each case (default: solve)")
    parser.add_argument(
        "--outputs",
        type=lambda text: text.split(","),
        metavar="NAME,...",
        help="columns of the table, by their names in summary.json (default: all numbers but those "
        "over the tracks of a prediction, and `assessment`)",
    )
    parser.add_argument("--zip", action="store_true", help="all varied keys vary together")
    parser.add_argument("--keep", action="store_true", help="a result folder for each case")
    parser.add_argument("--retry", action="store_true", help="run failed cases again")
    parser.add_argument(
        "--plan",
        action="store_true",
        help=f"check all cases (at most about {MAX_CHECKED}), print the plan, run nothing",
    )
    add_worker_arguments(parser)


def _arguments(args: argparse.Namespace) -> dict[str, Any]:
    """Give the arguments of a study, from its file and the command line."""
    given: dict[str, Any] = {"case": args.case, "axes": [], "options": [], "zipped": False}
    if args.case.endswith(".toml"):
        given = read_study(args.case)
    if args.outputs is not None:
        given |= {"outputs": args.outputs, "origin": "--"}
    axes = [parse_axis(text) for text in args.vary]
    return given | {
        "axes": [*given["axes"], *axes],
        "options": [*given["options"], *args.overrides],
        "zipped": args.zip or given["zipped"],
        "run": args.run or given.get("run", "solve"),
    }


def report(outcome: Outcome, folder: Path, workers: int) -> str:
    """Return the lines that are printed at the end."""
    counts = ", ".join(f"{n} {status}" for status, n in sorted(outcome.statuses().items()))
    lines = [f"cases      {len(outcome.rows)} in the table: {counts or 'none'}"]
    if outcome.ran and outcome.wall > 0.0:
        busy = outcome.busy / (outcome.wall * workers)
        lines.append(
            f"           {outcome.ran} ran now in {duration(outcome.wall)}, "
            f"the workers {100.0 * min(busy, 1.0):.0f} % busy"
        )
    failed = outcome.statuses().get(FAILED, 0)
    if failed:
        lines.append(f"failed     {failed}: the same command with --retry runs them again")
    lines.append(f"results    {folder / CSV}, {folder / NETCDF}")
    return "\n".join(lines)


def execute(args: argparse.Namespace) -> int:
    jobs = jobs_of(args)
    folder = Path(args.output)
    try:
        study = make(**_arguments(args))
    except InputError as error:
        # an error of a study file names the file
        if args.case.endswith(".toml") and args.case not in str(error):
            raise InputError(f"{args.case}: error: {error}") from error
        raise
    todo = plan(study, folder.absolute() / CASES if args.keep else None, brief=args.plan)
    if args.plan:
        print(todo.text(jobs))
        return EXIT_OK
    with closing(Terminal(lambda done: todo.text(jobs, done), quiet=args.quiet)) as watcher:
        outcome = perform(
            todo,
            folder,
            jobs=jobs,
            scheduler=args.scheduler,
            retry=args.retry,
            force=args.force,
            watcher=watcher,
        )
    if not args.quiet:
        print(report(outcome, folder, max(1, min(jobs, outcome.ran))))
    if outcome.interrupted:
        watcher.interrupted(folder)
        return EXIT_INTERRUPTED
    size = todo.study.size
    missing = [
        f"case {point.number + 1} of {size} ({point}): {why}"
        for point in todo.points
        if outcome.rows[point.number]["status"] not in FINDINGS
        and (why := why_none(outcome.rows[point.number]))
    ]
    report_missing(missing, folder / CSV)
    return EXIT_FAILED if missing else EXIT_OK
