# SPDX-License-Identifier: BSD-3-Clause
"""Reproduce figures and tables of Zhang, Biboulet, Venner & Lubrecht 2019, and compare.

Runs all of them unless some are named, compares them with the numbers of the paper (doi
10.1016/j.triboint.2019.01.028), and writes a report. Started again it computes what is missing.
Exit status: 0 all deviations are within their tolerances or explained by runs of the report, 1 at
least one is neither, 2 bad input, 130 interrupted.
"""

import argparse
import os
import platform
import sys
from collections.abc import Sequence
from importlib import metadata
from pathlib import Path

from driver import PIECES, reproduce
from piece import LEVELS, Level, Result

from pyehl import library
from pyehl.cli import status_of
from pyehl.commands.arguments import add_force
from pyehl.commands.watching import Terminal, jobs_of
from pyehl.studies.plan import Plan

MINUTES = {"quick": 10, "full": 90}


def parser() -> argparse.ArgumentParser:
    """Make the parser of the script."""
    made = argparse.ArgumentParser(description=__doc__, allow_abbrev=False)
    for kind in ("figure", "table"):
        known = [name.split()[1] for name in PIECES if name.startswith(kind)]
        made.add_argument(
            f"--{kind}",
            action="extend",
            nargs="+",
            default=[],
            choices=sorted(known),
            metavar="N",
            help=f"{kind}s {min(known)} to {max(known)}",
        )
    level = made.add_mutually_exclusive_group()
    for name, minutes in MINUTES.items():
        text = f"at most {minutes} minutes on two idle cores; left out: {LEVELS[name].leaves_out}"
        level.add_argument(f"--{name}", dest="level", action="store_const", const=name, help=text)
    made.set_defaults(level="quick")
    made.add_argument("-o", "--output", metavar="DIR", required=True, help="folder of the report")
    add_force(made)
    made.add_argument(
        "--jobs", type=int, default=0, metavar="N", help="worker processes (default: processors)"
    )
    made.add_argument("-q", "--quiet", action="store_true", help="print nothing but errors")
    return made


def _machine(level: Level, jobs: int) -> list[str]:
    names = ("numpy", "scipy", "matplotlib")
    versions = ", ".join(f"{name} {metadata.version(name)}" for name in names)
    load = ", ".join(f"{v:.1f}" for v in os.getloadavg())
    return [
        f"pyehl      {metadata.version('pyehl')}, library {library.version()}, {library.build()}",
        f"python     {platform.python_version()}, {versions}",
        f"machine    {platform.machine()}, {os.cpu_count()} processors, {platform.platform()}",
        f"load       {load} (mean of 1, 5, 15 minutes at the start)",
        f"settings   {level.name}, {jobs} worker processes of one thread each",
    ]


def _run(args: argparse.Namespace) -> int:
    wanted = [f"{kind} {n}" for kind in ("figure", "table") for n in getattr(args, kind)]
    level, jobs, folder = LEVELS[args.level], jobs_of(args), Path(args.output)
    watchers: list[Terminal] = []

    def report(text: str) -> None:
        if not args.quiet:
            print(text, flush=True)

    def watch(name: str, todo: Plan) -> Terminal:
        report(name)
        watchers.append(Terminal(lambda finished: todo.text(jobs, finished), quiet=args.quiet))
        return watchers[-1]

    def done(result: Result) -> None:
        report(f"{result.name:10} {result.line()}  [{result.wall:.0f} s]")
        for check in result.checks:
            if not check.passed:
                report(f"           {check}")

    try:
        results = reproduce(
            wanted or list(PIECES),
            level,
            folder,
            jobs=jobs,
            force=args.force,
            machine=_machine(level, jobs),
            watch=watch,
            done=done,
        )
    except KeyboardInterrupt as stop:
        raise KeyboardInterrupt(f"the same command resumes it in {folder}") from stop
    finally:
        for watcher in watchers:
            watcher.close()
    report(f"report     {folder / 'report.html'}")
    return 0 if all(r.passed for r in results) else 1


def main(words: Sequence[str] | None = None) -> int:
    """Run the script."""
    args = parser().parse_args(words)
    return status_of(lambda: _run(args))


if __name__ == "__main__":
    sys.exit(main())
