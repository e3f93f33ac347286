# SPDX-License-Identifier: BSD-3-Clause
"""Common part of ``pyehl bearing`` and ``pyehl gear``."""

import argparse
import json
from collections.abc import Sequence
from contextlib import closing
from pathlib import Path

from pyehl.commands.arguments import add_case_arguments
from pyehl.commands.watching import Terminal, add_worker_arguments, jobs_of
from pyehl.destination import finite
from pyehl.errors import EXIT_FAILED, EXIT_INTERRUPTED, EXIT_OK
from pyehl.machines.perform import CSV, RUNS, Prepared, perform
from pyehl.studies.plan import duration, wall_seconds


def add_machine_arguments(parser: argparse.ArgumentParser, what: str) -> None:
    """Add the arguments of both; the table has a row for each `what`."""
    parser.description = (
        f"{what}: load, pressure, film, friction. By formulas at once, or solved or predicted in "
        "worker processes; a repeated call runs what is missing. Exit status: 0 every contact has "
        "a result, 1 at least one has none, 2 bad input (nothing has run), 130 interrupted."
    )
    add_case_arguments(parser)
    parser.add_argument(
        "--run",
        choices=RUNS,
        default="film",
        help="film formulas, smooth solutions or predictions with roughness (default: film)",
    )
    add_worker_arguments(parser, required=False)
    parser.add_argument(
        "--json", action="store_true", help="print the summary as JSON, in SI units"
    )


def execute_machine(args: argparse.Namespace, command: str, kinds: tuple[str, ...]) -> int:
    """Run the command on a file with one of the groups `kinds`."""
    jobs = jobs_of(args)
    todo = Prepared(args.case, args.overrides, kinds, args.run)
    tasks = todo.tasks.tasks

    def plan(done: Sequence[int]) -> str:
        remaining = [task.seconds for task in tasks if task.number not in set(done)]
        time = duration(wall_seconds(remaining, jobs)) if remaining else "nothing left"
        return f"contacts   {len(todo.films)}, {len(tasks)} to run ({todo.run}): about {time}"

    quiet = args.quiet or args.json
    with closing(Terminal(plan, quiet=quiet)) as watcher:
        result, outcome = perform(
            todo,
            args.output,
            command,
            inputs=(args.case,),
            force=args.force,
            watcher=watcher,
            jobs=jobs,
            scheduler=args.scheduler,
        )
    if outcome.interrupted and args.output is not None:
        watcher.interrupted(Path(args.output))
    if outcome.interrupted:
        return EXIT_INTERRUPTED
    if args.json:
        print(json.dumps({name: finite(value) for name, value in result.summary.items()}, indent=2))
    elif not args.quiet:
        print(result)
        if args.output is not None:
            print(f"results    {Path(args.output) / CSV}")
    return EXIT_OK if result.complete else EXIT_FAILED
