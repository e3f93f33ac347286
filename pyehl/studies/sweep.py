# SPDX-License-Identifier: BSD-3-Clause
"""Run a study: many cases, one table; what is finished is kept."""

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import xarray as xr

from pyehl.case import Case
from pyehl.destination import AnyPath, Destination
from pyehl.given import Option, check_kind, options_of, path_of
from pyehl.netcdf import write_netcdf
from pyehl.studies import table
from pyehl.studies.gather import Outcome, gather
from pyehl.studies.journal import FILES as JOURNAL
from pyehl.studies.plan import Plan, plan
from pyehl.studies.pool import check_jobs
from pyehl.studies.study import make
from pyehl.studies.vary import axes_of
from pyehl.types import Row

CSV, NETCDF, CASES = "results.csv", "results.nc", "cases"


def perform(
    todo: Plan,
    folder: AnyPath | None,
    *,
    force: bool = False,
    **how: Any,  # noqa: ANN401 (as of `gather`)
) -> Outcome:
    """Run what is missing of a study.

    A folder gets the journal, ``results.csv`` and ``results.nc``. InputError if it holds another
    study or something else, or is in use; FileError if it cannot be written.
    """
    if folder is None:
        return gather(todo.tasks, todo.identity(), **how)
    folder = Path(folder)

    def write(rows: Mapping[int, Row]) -> None:
        table.write_csv(folder / CSV, table.results(todo.study, todo.points, rows))

    place = Destination(folder, "sweep", (*JOURNAL, CSV, NETCDF, CASES), force=force)
    outcome = gather(todo.tasks, todo.identity(), place, write=write, **how)
    write_netcdf(folder / NETCDF, table.dataset(todo.study, todo.points, outcome.rows))
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
        Values by ``group.key``, or by group and key: a sequence, or a text as behind ``pyehl sweep
        --vary``.
    *options
        Values that hold for all cases, as of `Case`.
    zipped
        True: all keys move together; else lists of the keys that do. Otherwise every value of a
        key meets every value of the others.
    run
        'solve', 'predict' or 'film'.
    outputs
        Names of results wanted; none: all numbers and ``assessment``. Mean and
        spread over the tracks of a prediction, which take twice the time, are made only where they
        are named.
    output
        Folder for the journal and the table, from which an interrupted study is resumed; None:
        nothing is kept on disk.
    force
        Other files may be in that folder; they stay.
    jobs
        Worker processes; 0: as many as processors.
    scheduler
        Address of a dask scheduler (extra ``cluster``), whose workers are used instead.

    Returns
    -------
    xarray.Dataset
        Its dimensions are what was varied, `load` of ``contact.load``; its attribute ``key`` is the
        key, and its group is in its name where another key or a result is called so,
        `grid_points`. Results by their names in ``summary.json`` (units as there), ``status``,
        ``seconds`` and ``message``; NaN where there is no number.

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
    return table.dataset(todo.study, todo.points, outcome.rows)
