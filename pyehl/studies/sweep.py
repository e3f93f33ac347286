# SPDX-License-Identifier: BSD-3-Clause
"""Run a study: many cases, one table, and nothing lost."""

from __future__ import annotations

import os
import signal
import tempfile
import threading
import time
from collections.abc import Generator, Iterable, Iterator, Mapping, Sequence
from contextlib import closing, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from types import FrameType
from typing import Any

import xarray as xr

from pyehl.case import Case, Option
from pyehl.errors import InputError
from pyehl.studies import cluster, pool, table
from pyehl.studies.journal import Journal
from pyehl.studies.plan import Plan, plan
from pyehl.studies.study import make
from pyehl.studies.tasks import FAILED, Task
from pyehl.studies.vary import axis

__all__ = ["Outcome", "Watcher", "perform", "sweep"]

Row = dict[str, Any]

CSV, NETCDF, CASES = "results.csv", "results.nc", "cases"
# Seconds between tables that are written while a study runs
TABLE_INTERVAL = 30.0
# What a worker tells beside its row: seconds that shared parts saved
SAVED = "saved_seconds"


class Watcher:
    """What a driver does when a study tells something; this one does nothing."""

    def began(self, plan: Plan, done: Sequence[int], damaged: int) -> None:
        """Take the plan, the cases that are done already, and how many rows were damaged."""

    def finished(self, rows: Sequence[tuple[int, Row]]) -> None:
        """Take rows that are in the journal now."""


@dataclass(slots=True)
class Outcome:
    """How a study ended.

    Attributes
    ----------
    rows
        Results by the number of the case.
    data
        The same as a Dataset.
    ran
        Cases that ran now.
    interrupted
        Whether somebody stopped it.
    saved
        Seconds that parts shared between cases saved.
    busy
        Seconds that the cases took, all workers together.
    wall
        Seconds from the first task to the last row.
    """

    rows: dict[int, Row]
    data: xr.Dataset | None = None
    ran: int = 0
    interrupted: bool = False
    saved: float = 0.0
    busy: float = 0.0
    wall: float = 0.0
    statuses: dict[str, int] = field(default_factory=dict)


@contextmanager
def _stopped_by_sigterm() -> Iterator[None]:
    """SIGTERM is as Ctrl-C."""

    def stop(number: int, frame: FrameType | None) -> None:
        raise KeyboardInterrupt

    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGTERM, stop)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


def perform(
    todo: Plan,
    folder: str | os.PathLike[str],
    *,
    jobs: int = 0,
    scheduler: str = "",
    retry: bool = False,
    watcher: Watcher | None = None,
) -> Outcome:
    """Run what is missing of a study, and write its table.

    Parameters
    ----------
    todo
        The plan.
    folder
        Gets ``journal.jsonl``, ``results.csv`` and ``results.nc``.
    jobs
        Worker processes; 0: as many as processors.
    scheduler
        Address of a dask scheduler; '': workers on this machine.
    retry
        Run cases again that failed.
    watcher
        Who is told what happens.

    Raises
    ------
    InputError
        If the folder holds another study or something else, or is in use.
    FileError
        If it cannot be written.
    """
    watcher = watcher or Watcher()
    folder = Path(folder)
    with Journal(folder, todo.study.identity()) as journal:
        if retry:
            journal.forget([n for n, row in journal.rows.items() if row.get("status") == FAILED])
        watcher.began(todo, sorted(journal.rows), journal.damaged)
        outcome = Outcome(journal.rows)
        tasks = [task for task in todo.tasks if task.number not in journal.rows]
        began = written = time.monotonic()
        try:
            with _stopped_by_sigterm(), closing(_source(tasks, jobs, scheduler)) as source:
                for rows in source:
                    for _, row in rows:
                        outcome.saved += row.pop(SAVED, 0.0)
                        outcome.busy += row.get("seconds") or 0.0
                    journal.append(rows)
                    outcome.ran += len(rows)
                    watcher.finished(rows)
                    if time.monotonic() - written > TABLE_INTERVAL:
                        table.write_csv(folder / CSV, todo.study, todo.points, journal.rows)
                        written = time.monotonic()
        except KeyboardInterrupt:
            outcome.interrupted = True
        outcome.wall = time.monotonic() - began
        outcome.data = table.dataset(todo.study, todo.points, journal.rows)
        table.write_csv(folder / CSV, todo.study, todo.points, journal.rows)
        table.write_netcdf(folder / NETCDF, outcome.data)
    for row in outcome.rows.values():
        status = str(row.get("status"))
        outcome.statuses[status] = outcome.statuses.get(status, 0) + 1
    return outcome


def _source(tasks: Sequence[Task], jobs: int, scheduler: str) -> Generator[list[tuple[int, Row]]]:
    if scheduler:
        return cluster.rows(tasks, scheduler)
    return pool.rows(tasks, jobs or pool.processors())


def sweep(
    case: Case | str | os.PathLike[str],
    vary: Mapping[str, Any],
    *options: Option,
    zip: bool | Sequence[Sequence[str]] = False,
    run: str = "solve",
    outputs: Iterable[str] = (),
    output: str | os.PathLike[str] | None = None,
    jobs: int = 0,
    scheduler: str = "",
) -> xr.Dataset:
    """Run a case many times with other values, in worker processes of one thread each.

    Parameters
    ----------
    case
        A case, or the path of a case file.
    vary
        Values by key ``group.key``: a sequence, or a text as behind ``pyehl sweep --vary``.
    *options
        Texts ``group.key=value`` that hold for all cases.
    zip
        True: all keys move together; else lists of the keys that do. Otherwise every value of a
        key meets every value of the others.
    run
        'solve', 'predict' or 'film'.
    outputs
        Names of results wanted; none: all numbers.
    output
        Folder for the journal and the table, in which an interrupted study goes on; None: nothing
        is kept on disk.
    jobs
        Worker processes; 0: as many as processors.
    scheduler
        Address of a dask scheduler (extra ``cluster``), whose workers are used instead.

    Returns
    -------
    xarray.Dataset
        Its dimensions are what was varied. Results by their names in ``summary.json`` (units as
        there), ``status``, ``seconds`` and ``message``; NaN where there is no number.

    Raises
    ------
    InputError
        If any case is not acceptable (nothing runs then), or `output` holds another study.
    KeyboardInterrupt
        If it was interrupted; `output` has all that was finished.

    Examples
    --------
    >>> import pyehl
    >>> ds = pyehl.sweep(
    ...     "cases/quick.nml", {"contact.moes_m": [100.0, 200.0]}, "grid.points=33", jobs=1
    ... )
    >>> ds.H_c.dims, ds.status.values.tolist()
    (('contact.moes_m',), ['converged', 'converged'])
    """
    flat = [text for o in options for text in ([o] if isinstance(o, str) else o)]
    study = make(
        case,
        [axis(key, values) for key, values in vary.items()],
        options=flat,
        zipped=zip,
        run=run,
        outputs=outputs,
    )
    if jobs < 0:
        raise InputError(f"jobs = {jobs}: expected a number of worker processes")
    todo = plan(study)
    if output is not None:
        outcome = perform(todo, output, jobs=jobs, scheduler=scheduler)
    else:
        with tempfile.TemporaryDirectory(prefix="pyehl-") as place:
            outcome = perform(todo, place, jobs=jobs, scheduler=scheduler)
    if outcome.interrupted:
        raise KeyboardInterrupt
    assert outcome.data is not None
    return outcome.data
