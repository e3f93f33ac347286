# SPDX-License-Identifier: BSD-3-Clause
"""Do what is missing of some tasks, and keep what is finished."""

import signal
import time
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from contextlib import closing, nullcontext
from dataclasses import dataclass
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
    """What a driver does when a study reports something; this one does nothing."""

    def began(self, tasks: Sequence[Task], done: Sequence[int], workers: int) -> None:
        """Take all tasks, the numbers of those done, and of the workers (0: not known)."""

    def finished(self, rows: Sequence[tuple[int, Row]]) -> None:
        """Take rows that are in the journal now."""


@dataclass(slots=True)
class Outcome:
    """How a study ended."""

    rows: dict[int, Row]  # results by the number of the task
    ran: int = 0  # tasks that were done now
    interrupted: bool = False  # whether it was stopped
    busy: float = 0.0  # seconds that these tasks took, all workers together
    wall: float = 0.0  # seconds from the first task to the last row

    def statuses(self) -> dict[str, int]:
        """How many rows have each status."""
        return dict(Counter(str(row.get("status")) for row in self.rows.values()))


def gather(
    tasks: Sequence[Task],
    identity: Mapping[str, Any],
    place: Destination | None = None,
    *,
    jobs: int = 0,
    scheduler: str = "",
    retry: bool = False,
    watcher: Watcher | None = None,
    write: Callable[[Mapping[int, Row]], None] | None = None,
) -> Outcome:
    """Do the tasks that are not in the journal of a folder.

    `identity` is what makes them another study than others; `place` is the folder with the names
    of its files, None: nothing is kept on disk. `jobs` worker processes do the tasks (0: as many
    as processors), or those of a dask scheduler; `retry`: those that failed are done again. `write`
    writes tables of the rows, now and then and at the end. InputError if the folder holds another
    study or something else, or is in use; FileError if it cannot be written.
    """
    watcher = watcher or Watcher()
    with nullcontext() if place is None else Journal(place.folder, identity, place) as journal:
        rows = {} if journal is None else journal.rows
        if retry:
            for number in [n for n, row in rows.items() if row.get("status") == FAILED]:
                del rows[number]
        left = [task for task in tasks if task.number not in rows]
        jobs = min(jobs or pool.processors(), len(left))
        watcher.began(tasks, sorted(rows), 0 if scheduler else jobs)
        outcome = Outcome(rows)
        began = written = time.monotonic()
        workers = pool.cluster_rows(left, scheduler) if scheduler else pool.rows(left, jobs)
        try:
            # a transaction of the journal that is interrupted is whole, or not there
            with signals_to(signal.default_int_handler), closing(workers) as source:
                for found in source:
                    if journal is not None:
                        journal.append(found)
                    rows.update(found)
                    outcome.ran += len(found)
                    outcome.busy += sum(row.get("seconds") or 0.0 for _, row in found)
                    watcher.finished(found)
                    if write is not None and time.monotonic() - written > TABLE_INTERVAL:
                        write(rows)
                        written = time.monotonic()
        except KeyboardInterrupt:
            outcome.interrupted = True
        outcome.wall = time.monotonic() - began
        if write is not None:
            write(rows)
    return outcome
