# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl reproduce``: the figures and tables of a paper by our own runs, beside its numbers."""

import argparse
import os
import platform
import sys
from importlib import metadata
from pathlib import Path

from pyehl import library
from pyehl.commands.arguments import add_force
from pyehl.commands.watching import Terminal, jobs_of
from pyehl.errors import EXIT_FAILED, EXIT_INTERRUPTED, EXIT_OK, InputError
from pyehl.reproduce.driver import PIECES, reproduce
from pyehl.reproduce.piece import LEVELS, Level, Result
from pyehl.studies.plan import Plan

PAPERS = ("zhang2019",)
LIBRARIES = ("numpy", "scipy", "matplotlib")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    left_out = " ".join(f"--{level.name}: {level.leaves_out}." for level in LEVELS.values())
    parser.description = (
        "Redo figures and tables of a paper (all unless some are named), compare them with its "
        "numbers, and write a report. Started again it computes what is missing. What is left "
        f"out: {left_out} Exit status: 0 all deviations are within their tolerances or explained "
        "by runs of the report, 1 at least one neither, 2 bad input, 130 interrupted."
    )
    parser.add_argument("paper", choices=PAPERS, help="which paper")
    for kind in ("figure", "table"):
        numbers = [name.split()[1] for name in PIECES if name.startswith(kind)]
        parser.add_argument(
            f"--{kind}",
            action="append",
            nargs="+",
            default=[],
            metavar="N",
            help=f"{kind}s {min(numbers)} to {max(numbers)}",
        )
    level = parser.add_mutually_exclusive_group()
    for name, minutes in (("quick", 10), ("full", 90)):
        level.add_argument(
            f"--{name}",
            dest="level",
            action="store_const",
            const=name,
            help=f"at most {minutes} minutes on two idle cores"
            + (" (default)" if name == "quick" else ""),
        )
    parser.set_defaults(level="quick")
    parser.add_argument("-o", "--output", metavar="DIR", required=True, help="folder of the report")
    add_force(parser)
    parser.add_argument(
        "--jobs", type=int, default=0, metavar="N", help="worker processes (default: processors)"
    )
    parser.add_argument("-q", "--quiet", action="store_true", help="print nothing but errors")


def _names(args: argparse.Namespace) -> list[str]:
    """Names of the pieces that are asked for; InputError if one is not in the paper."""
    wanted = [
        f"{kind} {number}"
        for kind in ("figure", "table")
        for group in getattr(args, kind)
        for number in group
    ]
    for name in wanted:
        if name not in PIECES:
            kind = name.partition(" ")[0]
            known = ", ".join(p.split()[1] for p in PIECES if p.startswith(kind))
            raise InputError(f"--{name}: the paper has no such {kind}; expected one of {known}")
    return wanted or list(PIECES)


def _machine(args: argparse.Namespace, level: Level, jobs: int) -> list[str]:
    versions = ", ".join(f"{name} {metadata.version(name)}" for name in LIBRARIES)
    load = ", ".join(f"{v:.1f}" for v in os.getloadavg())
    return [
        f"pyehl      {metadata.version('pyehl')}, library {library.version()}, {library.build()}",
        f"python     {platform.python_version()}, {versions}",
        f"machine    {platform.machine()}, {os.cpu_count()} processors, {platform.platform()}",
        f"load       {load} (mean of 1, 5, 15 minutes at the start)",
        f"settings   {args.paper}, {level.name}, {jobs} worker processes of one thread each",
    ]


def execute(args: argparse.Namespace) -> int:
    names, level, jobs = _names(args), LEVELS[args.level], jobs_of(args)
    folder = Path(args.output)
    watchers: list[Terminal] = []

    def watch(name: str, todo: Plan) -> Terminal:
        if not args.quiet:
            print(f"{name}", flush=True)
        watchers.append(Terminal(lambda finished: todo.text(jobs, finished), quiet=args.quiet))
        return watchers[-1]

    def done(result: Result) -> None:
        if not args.quiet:
            print(f"{result.name:10} {result.line()}  [{result.wall:.0f} s]", flush=True)
            for check in result.checks:
                if not check.passed:
                    print(f"           {check}", flush=True)

    try:
        results = reproduce(
            names,
            level,
            folder,
            jobs=jobs,
            force=args.force,
            machine=_machine(args, level, jobs),
            watch=watch,
            done=done,
        )
    except KeyboardInterrupt:
        print(f"interrupted; the same command resumes it in {folder}", file=sys.stderr)
        return EXIT_INTERRUPTED
    finally:
        for watcher in watchers:
            watcher.close()
    if not args.quiet:
        print(f"report     {folder / 'report.html'}")
    return EXIT_OK if all(r.passed for r in results) else EXIT_FAILED
