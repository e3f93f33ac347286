# SPDX-License-Identifier: BSD-3-Clause
"""Do what is missing of some tasks, and keep what is finished."""

import os
import time
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import closing, contextmanager
from dataclasses import dataclass
from types import FrameType
from typing import Any

from pyehl.destination import Destination
from pyehl.run import signals_to
from pyehl.studies import pool
from pyehl.studies.journal import Journal
from pyehl.studies.tasks import FAILED, Task
from pyehl.types import Row

# Seconds between tables that are written while a study runs
TABLE_INTERVAL = 30.0


class Watcher:
    """What a driver does when a study tells something; this one does nothing."""

    def began(self, tasks: Sequence[Task], done: Sequence[int], damaged: int) -> None:
        """Take all tasks, the numbers of those done before, and how many rows were damaged."""

    def finished(self, rows: Sequence[tuple[int, Row]]) -> None:
        """Take rows that are in the journal now."""


@dataclass(slots=True)
class Outcome:
    """How a study ended."""

    rows: dict[int, Row]  # results by the number of the task
    ran: int = 0  # tasks that were done now
    interrupted: bool = False  # whether somebody stopped it
    busy: float = 0.0  # seconds that these tasks took, all workers together
    wall: float = 0.0  # seconds from the first task to the last row

    def statuses(self) -> dict[str, int]:
        """How many rows have each status."""
        return dict(Counter(str(row.get("status")) for row in self.rows.values()))


class _Stop:
    """SIGINT and SIGTERM as KeyboardInterrupt, but not between a row and its journal."""

    def __init__(self) -> None:
        self._held = self._wanted = False

    def take(self, number: int, frame: FrameType | None) -> None:
        """Take a signal."""
        if not self._held:
            raise KeyboardInterrupt
        self._wanted = True

    @contextmanager
    def held(self) -> Iterator[None]:
        """Take signals at the end only."""
        self._held = True
        try:
            yield
        finally:
            self._held = False
        if self._wanted:
            raise KeyboardInterrupt


def gather(
    tasks: Sequence[Task],
    folder: str | os.PathLike[str],
    identity: Mapping[str, Any],
    *,
    jobs: int = 0,
    scheduler: str = "",
    retry: bool = False,
    place: Destination | None = None,
    watcher: Watcher | None = None,
    write: Callable[[Mapping[int, Row]], None] | None = None,
) -> Outcome:
    """Do the tasks that are not in the journal of a folder.

    `identity` is what makes them another study than others; `jobs` worker processes do them (0: as
    many as processors), or those of a dask scheduler; `retry`: those that failed are done again.
    `place` is the folder with the names of its tables; `write` writes tables of the rows, now and
    then and at the end. InputError if the folder holds another study or something else, or is in
    use; FileError if it cannot be written.
    """
    watcher = watcher or Watcher()
    with Journal(folder, identity, place) as journal:
        if retry:
            journal.forget([n for n, row in journal.rows.items() if row.get("status") == FAILED])
        watcher.began(tasks, sorted(journal.rows), journal.damaged)
        outcome = Outcome(journal.rows)
        left = [task for task in tasks if task.number not in journal.rows]
        stop = _Stop()
        began = written = time.monotonic()
        workers = pool.cluster_rows(left, scheduler) if scheduler else pool.rows(left, jobs)
        try:
            with signals_to(stop.take), closing(workers) as source:
                for rows in source:
                    with stop.held():
                        journal.append(rows)
                        outcome.ran += len(rows)
                        outcome.busy += sum(row.get("seconds") or 0.0 for _, row in rows)
                        watcher.finished(rows)
                        if write is not None and time.monotonic() - written > TABLE_INTERVAL:
                            write(journal.rows)
                            written = time.monotonic()
        except KeyboardInterrupt:
            outcome.interrupted = True
        outcome.wall = time.monotonic() - began
        if write is not None:
            write(journal.rows)
    return outcome
