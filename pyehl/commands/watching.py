# SPDX-License-Identifier: BSD-3-Clause
"""What subcommands that run many cases share: arguments, and what they print meanwhile."""

import argparse
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from tqdm import tqdm

from pyehl.commands.arguments import add_force
from pyehl.errors import InputError
from pyehl.studies.gather import Watcher
from pyehl.studies.plan import duration
from pyehl.studies.pool import processors
from pyehl.studies.tasks import FAILED, Task

MOST_MESSAGES = 100
# Seconds between lines where the output is not a terminal
LINE_INTERVAL = 5.0


class Bar:
    """A bar that counts estimated costs; lines now and then where there is no terminal."""

    def __init__(self, total: float) -> None:
        self._total, self._last = total, time.monotonic()
        self._start = self._last
        form = "{percentage:3.0f}%|{bar}|{desc} [{elapsed}, left {remaining}]"
        self._bar = tqdm(total=total or None, bar_format=form, disable=not sys.stderr.isatty())

    def show(self, done: float, text: str) -> None:
        """Show how much is done, and a text about it."""
        self._bar.set_description_str(f" {text}", refresh=False)
        self._bar.update(done - self._bar.n)
        now = time.monotonic()
        if self._bar.disable and now - self._last > LINE_INTERVAL and 0.0 < done < self._total:
            self._last = now
            left = (now - self._start) * (self._total / done - 1.0)
            print(f"{text}, about {duration(left)} left", flush=True)

    def close(self) -> None:
        """End the bar."""
        self._bar.close()


class Terminal(Watcher):
    """Prints the plan, then shows a bar of estimated seconds."""

    def __init__(self, told: Callable[[Sequence[int]], str], *, quiet: bool = False) -> None:
        self._plan, self._quiet = told, quiet
        self._seconds: dict[int, float] = {}
        self._count = self._failed = self._size = 0
        self._bar: Bar | None = None
        self._done = 0.0

    def began(self, tasks: Sequence[Task], done: Sequence[int], damaged: int) -> None:
        """Print the plan."""
        self._size = len(tasks)
        self._count = len(done)
        finished = set(done)
        self._seconds = {t.number: t.seconds for t in tasks if t.number not in finished}
        if self._quiet:
            return
        if damaged:
            print(f"note       {damaged} damaged rows of the journal run again", file=sys.stderr)
        print(self._plan(done), flush=True)
        self._bar = Bar(sum(self._seconds.values()))

    def finished(self, rows: Sequence[tuple[int, dict[str, Any]]]) -> None:
        """Show how far it is."""
        self._count += len(rows)
        self._failed += sum(row.get("status") == FAILED for _, row in rows)
        self._done += sum(self._seconds[number] for number, _ in rows)
        if self._bar is not None:
            failed = f", {self._failed} failed" if self._failed else ""
            self._bar.show(self._done, f"{self._count} of {self._size} cases{failed}")

    def close(self) -> None:
        """End the bar."""
        if self._bar is not None:
            self._bar.close()

    def goes_on(self, folder: Path) -> None:
        """Say how an interrupted study is resumed."""
        print(f"interrupted; the same command resumes it in {folder}", file=sys.stderr)


def add_worker_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of all subcommands that run many cases."""
    parser.add_argument("-o", "--output", metavar="DIR", required=True, help="folder of the study")
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


def tell_lost(lost: Sequence[str], table: Path) -> None:
    """Print a message for each case without a result; of very many the first."""
    for text in lost[:MOST_MESSAGES]:
        print(" ".join(text.split()), file=sys.stderr)
    if len(lost) > MOST_MESSAGES:
        print(f"and {len(lost) - MOST_MESSAGES} more: see status in {table}", file=sys.stderr)


def jobs_of(args: argparse.Namespace) -> int:
    """Give the number of worker processes; InputError if it is negative."""
    if args.jobs < 0:
        raise InputError(f"--jobs {args.jobs}: expected a number of worker processes")
    return int(args.jobs) or processors()
