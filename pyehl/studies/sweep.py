# SPDX-License-Identifier: BSD-3-Clause
"""Run a study: many cases, one table (CSV, xarray Dataset), and a journal of finished cases."""

import os
import signal
import time
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import closing, nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from pyehl import arrays
from pyehl.case import KEYS, Case
from pyehl.destination import AnyPath, Destination
from pyehl.given import Option, bare, check_kind, options_of, path_of
from pyehl.netcdf import write_netcdf
from pyehl.results import unit_of
from pyehl.run import signals_to
from pyehl.studies import pool
from pyehl.studies.journal import FILES as JOURNAL
from pyehl.studies.journal import Journal
from pyehl.studies.plan import Plan, plan
from pyehl.studies.pool import check_jobs
from pyehl.studies.study import Point, Study, axes_of, make
from pyehl.studies.tasks import FAILED, LAST, Task
from pyehl.types import Row, Values

# Seconds between tables that are written while a study runs
TABLE_INTERVAL = 30.0


class Watcher:
    """Callbacks of a study; the default ones do nothing."""

    def began(self, tasks: Sequence[Task], done: Sequence[int], workers: int) -> None:
        """Receive all tasks, the numbers of the finished ones, and of workers (0: not known)."""

    def finished(self, rows: Sequence[tuple[int, Row]]) -> None:
        """Receive rows that are now in the journal."""


@dataclass(slots=True)
class Outcome:
    """Outcome of a study."""

    rows: dict[int, Row]  # results by the number of the task
    ran: int = 0  # tasks of this run
    interrupted: bool = False
    busy: float = 0.0  # seconds of these tasks, all workers together
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
    """Run the tasks that are not in the journal of a folder.

    `identity` distinguishes them from other studies; `place` is the folder with the names of its
    files, None: no files are written. `jobs` worker processes (0: as many as processors), or those
    of a dask scheduler, run the tasks; `retry`: failed ones run again. `write` writes tables of the
    rows, at intervals and at the end. InputError if the folder holds another study or something
    else, or is in use; FileError if it cannot be written.
    """
    watcher = watcher or Watcher()
    with nullcontext() if place is None else Journal(place.folder, identity, place) as journal:
        rows = {} if journal is None else journal.rows
        if retry:
            for number in [n for n, row in rows.items() if row.get("status") == FAILED]:
                del rows[number]
        waiting = [task for task in tasks if task.number not in rows]
        jobs = min(jobs or pool.processors(), len(waiting))
        watcher.began(tasks, sorted(rows), 0 if scheduler else jobs)
        outcome = Outcome(rows)
        began = written = time.monotonic()
        workers = pool.cluster_rows(waiting, scheduler) if scheduler else pool.rows(waiting, jobs)
        try:
            # an interrupted transaction of the journal is complete or absent
            with signals_to(signal.default_int_handler), closing(workers) as source:
                for result in source:
                    if journal is not None:
                        journal.append(result)
                    rows.update(result)
                    outcome.ran += len(result)
                    outcome.busy += sum(row.get("seconds") or 0.0 for _, row in result)
                    watcher.finished(result)
                    if write is not None and time.monotonic() - written > TABLE_INTERVAL:
                        write(rows)
                        written = time.monotonic()
        except KeyboardInterrupt:
            outcome.interrupted = True
            if journal is not None:
                # include rows written at that moment
                rows.update(journal.read())
        outcome.wall = time.monotonic() - began
        if write is not None:
            write(rows)
    return outcome


# Texts that are always in the table, and texts that are in it by default; others are on request
TEXTS = ("status", "message")
WORDS = ("flags", "outside_range", "assessment")


def columns(study: Study, rows: Mapping[int, Values]) -> list[str]:
    """Names of the results in the table, after the varied keys."""
    if study.outputs:
        result: Iterable[str] = study.outputs
    else:
        names: dict[str, bool] = {}
        for number in sorted(rows):
            for name, value in rows[number].items():
                text = isinstance(value, str) and name not in WORDS
                names[name] = names.get(name, False) or text
        result = [name for name, text in names.items() if not text]
    skipped = {*LAST, *study.keys}
    return [*(name for name in result if name not in skipped), *LAST]


def results(study: Study, points: Iterable[Point], rows: Mapping[int, Values]) -> pd.DataFrame:
    """Give the varied values and the results of all finished cases."""
    names = columns(study, rows)
    result = (
        [*point.values.values(), *map(rows[point.number].get, names)]
        for point in points
        if point.number in rows
    )
    return pd.DataFrame(result, columns=[*study.keys, *names], dtype=object)


def write_csv(path: Path, table: pd.DataFrame) -> None:
    """Write a table, whole or not at all. FileError if it cannot be written."""
    arrays.write_csv(path, list(table.columns), table.itertuples(index=False, name=None))


def dataset(study: Study, points: Sequence[Point], rows: Mapping[int, Values]) -> xr.Dataset:
    """Give the results over the varied keys."""
    table = results(study, points, {number: rows.get(number, {}) for number in range(study.size)})
    films = ("h_c_m_", "h_min_m_")
    units = {name: "m" if name.startswith(films) else unit_of(name) for name in table}
    attributes = {"title": "study of pyehl", "run": study.run}
    attributes |= {"set": "\n".join(map(bare, study.options))} if study.options else {}
    return over(study, table, units, attributes)


def over(
    study: Study,
    table: pd.DataFrame,
    units: Mapping[str, str],
    attributes: Mapping[str, str],
    kind: type | None = None,
) -> xr.Dataset:
    """Give a table of all cases as a Dataset over the varied keys.

    Dimensions have the names of `Study.names`, and their keys as attributes; keys that vary
    together are coordinates of the dimension of the first of them, converted to `kind` if it is
    given. Missing numbers are NaN, missing texts ''.
    """
    called = study.names
    names = tuple(called[axes[0].key] for axes in study.dimensions)
    coords = {}
    for axes, name in zip(study.dimensions, names, strict=True):
        for a in axes:
            about = {"key": a.key, "units": "1"}
            if known := KEYS.get(a.key):
                about["long_name"] = known.meaning
                if known.unit not in ("", "-"):
                    about["units"] = known.unit
            coords[called[a.key]] = xr.Variable((name,), np.array(a.values, dtype=kind), about)
    variables = {}
    for name in table.columns.drop(study.keys):
        if name in coords:
            # it repeats the coordinate, see `ECHOED`
            continue
        column = table[name]
        if name in TEXTS or column.map(type).eq(str).any():
            values, about = column.fillna("").astype(str).to_numpy(str), {}
        else:
            values, about = column.to_numpy(float), {"units": units[name]}
        variables[name] = xr.Variable(names, values.reshape(study.shape), about)
    return xr.Dataset(variables, coords, attributes)


CSV, NETCDF, CASES = "results.csv", "results.nc", "cases"


def perform(
    todo: Plan,
    folder: AnyPath | None,
    *,
    force: bool = False,
    **options: Any,  # noqa: ANN401 (as in `gather`)
) -> Outcome:
    """Run the missing cases of a study.

    A folder gets the journal, ``results.csv`` and ``results.nc``. InputError if it holds another
    study or something else, or is in use; FileError if it cannot be written.
    """
    if folder is None:
        return gather(todo.tasks, todo.identity(), **options)
    folder = Path(folder)

    def write(rows: Mapping[int, Row]) -> None:
        write_csv(folder / CSV, results(todo.study, todo.points, rows))

    place = Destination(folder, "sweep", (*JOURNAL, CSV, NETCDF, CASES), force=force)
    outcome = gather(todo.tasks, todo.identity(), place, write=write, **options)
    write_netcdf(folder / NETCDF, dataset(todo.study, todo.points, outcome.rows))
    return outcome


def sweep(
    case: Case | str | os.PathLike[str],
    vary: Mapping[str, Any],
    *options: Option,
    zipped: bool | Sequence[Sequence[str]] = False,
    run: str = "solve",
    outputs: Sequence[str] = (),
    output: str | os.PathLike[str] | None = None,
    force: bool = False,
    jobs: int = 0,
    scheduler: str = "",
) -> xr.Dataset:
    """Run a case many times with other values, in worker processes of one thread each.

    Parameters
    ----------
    case
        A case, or the path of a case file.
    vary
        Values by ``group.key``, or by group and key: a sequence, or a text as in ``pyehl sweep
        --vary``.
    *options
        Values for all cases, as for `Case`.
    zipped
        True: all keys vary together; else lists of the keys that do. By default the cases are all
        combinations.
    run
        'solve', 'predict' or 'film'.
    outputs
        Names of results; none: all numbers, ``flags``, ``outside_range`` and ``assessment``. Mean
        and spread over the tracks of a prediction, which take nearly three times the time, are
        computed only if they are named.
    output
        Folder for the journal and the table, from which an interrupted study is resumed; None: no
        files are written.
    force
        Accept other files in that folder; they stay.
    jobs
        Worker processes; 0: as many as processors.
    scheduler
        Address of a dask scheduler (extra ``cluster``), whose workers are used instead.

    Returns
    -------
    xarray.Dataset
        Its dimensions are the varied keys without their groups, `load` for ``contact.load``, or
        with them, `grid_points`, if another key or a result has that name; the attribute ``key`` is
        the full key. Results by their names in ``summary.json`` (units as there), ``status``,
        ``seconds`` and ``message``; NaN for a missing number.

    Raises
    ------
    InputError
        If any case is not acceptable (nothing runs then), or `output` holds another study.
    FileError
        If `output` cannot be written.
    KeyboardInterrupt
        If it was interrupted; `output` has all finished cases.

    Examples
    --------
    >>> import pyehl
    >>> ds = pyehl.sweep(
    ...     "cases/quick.nml", {"contact.moes_m": [100.0, 200.0]}, "grid.points=65", jobs=1
    ... )
    >>> ds.H_c.dims, ds.status.values.tolist()
    (('moes_m',), ['converged', 'converged'])
    """
    check_kind(run, str, "run", "'solve', 'predict' or 'film'")
    check_kind(outputs, Sequence, "outputs", "names of results")
    check_jobs(jobs)
    check_kind(zipped, (bool, Sequence), "zipped", "True, False or lists of keys")
    study = make(
        case,
        axes_of(vary),
        options=options_of(options),
        zipped=zipped,
        run=run,
        outputs=[outputs] if isinstance(outputs, str) else outputs,
    )
    todo = plan(study)
    folder = None if output is None else path_of(output, "output")
    outcome = perform(todo, folder, jobs=jobs, scheduler=scheduler, force=force)
    if outcome.interrupted:
        raise KeyboardInterrupt
    return dataset(todo.study, todo.points, outcome.rows)
