# SPDX-License-Identifier: BSD-3-Clause
"""Common part of subcommands that run many cases: arguments and progress."""

import argparse
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path

from tqdm import tqdm

from pyehl.commands.arguments import add_force
from pyehl.errors import InputError
from pyehl.studies.plan import Remaining, duration
from pyehl.studies.pool import processors
from pyehl.studies.sweep import Watcher
from pyehl.studies.tasks import FAILED, Task
from pyehl.types import Row

MAX_MESSAGES = 100
# Seconds between lines where the output is not a terminal
LINE_INTERVAL = 5.0


class Bar:
    """A bar that counts estimated seconds; lines at intervals without a terminal."""

    def __init__(self, total: float) -> None:
        self._start = self._last = time.monotonic()
        form = "{percentage:3.0f}%|{bar}|{desc} [{elapsed}]"
        self._bar = tqdm(total=total or None, bar_format=form, disable=not sys.stderr.isatty())
        self._total = total

    def show(self, done: float, text: str, left: float | None = None) -> None:
        """Show the seconds done, a text, and the seconds left (default: extrapolated)."""
        now = time.monotonic()
        if left is None and 0.0 < done:
            left = (now - self._start) * (self._total / done - 1.0)
        if left is not None and done < self._total:
            text = f"{text}, about {duration(left)} left"
        self._bar.set_description_str(f" {text}", refresh=False)
        self._bar.update(done - self._bar.n)
        if self._bar.disable and now - self._last > LINE_INTERVAL and 0.0 < done < self._total:
            self._last = now
            print(text, flush=True)

    def close(self) -> None:
        """End the bar."""
        self._bar.close()


class Terminal(Watcher):
    """Prints the plan, then shows a bar of estimated seconds."""

    def __init__(self, plan: Callable[[Sequence[int]], str], *, quiet: bool = False) -> None:
        self._plan, self._quiet = plan, quiet
        self._size = self._failed = 0
        self._bar: Bar | None = None
        self._remaining = Remaining((), 1)

    def began(self, tasks: Sequence[Task], done: Sequence[int], workers: int) -> None:
        """Print the plan."""
        self._size = len(tasks)
        finished = set(done)
        self._remaining = Remaining([t for t in tasks if t.number not in finished], workers)
        if not self._quiet:
            print(self._plan(done), flush=True)
            self._bar = Bar(self._remaining.total)

    def finished(self, rows: Sequence[tuple[int, Row]]) -> None:
        """Show the progress."""
        self._failed += sum(row.get("status") == FAILED for _, row in rows)
        self._remaining.remove(rows)
        if self._bar is not None:
            count = self._size - self._remaining.count
            failed = f", {self._failed} failed" if self._failed else ""
            done = self._remaining.total - self._remaining.estimate
            left = self._remaining.seconds
            self._bar.show(done, f"{count} of {self._size} cases{failed}", left)

    def close(self) -> None:
        """End the bar."""
        if self._bar is not None:
            self._bar.close()

    def interrupted(self, folder: Path) -> None:
        """Print how to resume an interrupted study."""
        print(f"interrupted; the same command resumes it in {folder}", file=sys.stderr)


def add_worker_arguments(parser: argparse.ArgumentParser, *, required: bool = True) -> None:
    """Add the arguments of all subcommands that run many cases; `required`: -o is needed."""
    parser.add_argument(
        "-o", "--output", metavar="DIR", required=required, help="folder of the study"
    )
    add_force(parser)
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


def report_missing(messages: Sequence[str], table: Path) -> None:
    """Print the messages of cases without a result, at most `MAX_MESSAGES`."""
    for text in messages[:MAX_MESSAGES]:
        print(" ".join(text.split()), file=sys.stderr)
    if len(messages) > MAX_MESSAGES:
        print(f"and {len(messages) - MAX_MESSAGES} more: see status in {table}", file=sys.stderr)


def jobs_of(args: argparse.Namespace) -> int:
    """Give the number of worker processes; InputError if it is negative."""
    if args.jobs < 0:
        raise InputError(f"--jobs {args.jobs}: expected a number of worker processes")
    return int(args.jobs) or processors()
