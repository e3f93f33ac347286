# SPDX-License-Identifier: BSD-3-Clause
"""Bearings and gears in one call: film by formulas, or solved or predicted as one study."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from pathlib import Path
from types import EllipsisType
from typing import Any

from pyehl import namelist
from pyehl.arrays import write_csv
from pyehl.case import files_of, resolved_case
from pyehl.case.inlet import refuse_inlet
from pyehl.case.machine import Machine, read_machine
from pyehl.destination import Destination, finite, write_json
from pyehl.errors import InputError, did_you_mean
from pyehl.given import Option, path_of
from pyehl.machines.bearing import Bearing, ball_bearing, roller_bearing
from pyehl.machines.contact import Film, film_of
from pyehl.machines.gear import GearPair, gear_pair
from pyehl.machines.gear_duty import FILES as DUTY
from pyehl.machines.gear_duty import has_duty, write_duty
from pyehl.machines.result import MachineResult, row_of, sigma_of, summary_of, table_of
from pyehl.plots import machine as pictures
from pyehl.plots.style import save
from pyehl.prediction.predict import unpredictable
from pyehl.studies.journal import FILES as JOURNAL
from pyehl.studies.journal import NAME
from pyehl.studies.plan import TaskList
from pyehl.studies.pool import check_jobs
from pyehl.studies.study import contents
from pyehl.studies.sweep import Outcome, Watcher, gather
from pyehl.surfaces import rough_groups
from pyehl.types import Row

RUNS = ("film", "solve", "predict")
CSV, SUMMARY, PICTURE, CASE = "contacts.csv", "summary.json", "contacts.png", "machine.nml"
FILES = (CSV, SUMMARY, PICTURE, CASE)
MAKERS: dict[str, Callable[[Machine], Bearing | GearPair]] = {
    "ball_bearing": ball_bearing,
    "roller_bearing": roller_bearing,
    "spur_gear": gear_pair,
}
AnyCase = str | os.PathLike[str] | EllipsisType


class Prepared:
    """A machine element with its contacts, before any of them is solved.

    Parameters
    ----------
    path
        A file that describes it, or an ellipsis for the options alone.
    options
        Values that replace those of the file.
    kinds
        Groups of which the file must have one.
    run
        One of `RUNS`.

    Attributes
    ----------
    run
        One of `RUNS`.
    machine, made
        The machine element as it was read, and with its contacts under load.
    films
        Its contacts with their films by formulas.
    tasks
        The different contacts to be solved or predicted, each once.
    number
        Number of the task of each contact; None: film by formulas.
    """

    def __init__(self, path: AnyCase, options: Any, kinds: tuple[str, ...], run: str) -> None:  # noqa: ANN401
        if run not in RUNS:
            expected = f"expected one of {', '.join(RUNS)}{did_you_mean(run, RUNS)}"
            raise InputError(f"run = '{run}': {expected}")
        self.run = run
        self.machine = read_machine(path, options, kinds)
        self.made = MAKERS[self.machine.kind](self.machine)
        self.films: list[Film] = [film_of(one, self.machine) for one in self.made.contacts]
        rough = rough_groups(self.films[0].settings)
        if run == "predict" and not rough:
            raise InputError(
                "run = 'predict': both surfaces are smooth\nexpected: a finish in &surface (the "
                "elements or the pinion) or in &second_surface; or run = 'solve'"
            )
        self.tasks = TaskList()
        numbers: dict[str, int] = {}
        self.number: list[int | None] = []
        for one in self.films:
            if run == "film" or not one.is_solvable:
                what = f"{one.contact.place}: formulas of flooded contacts give its film"
                expected = "run = 'solve' and contacts that the solver accepts, or no &inlet"
                refuse_inlet(one.settings, what, expected)
                self.number.append(None)
                continue
            if one.text not in numbers:
                case = resolved_case(one.text)
                if run == "solve":
                    case = case.smooth() if rough else case
                elif why := unpredictable(one.settings):
                    raise InputError(f"{one.contact.place}: {why}")
                numbers[one.text] = self.tasks.add(len(numbers), case, run)
            self.number.append(numbers[one.text])

    def identity(self) -> dict[str, Any]:
        """Return what identifies this study, as JSON values."""
        texts = [task.text for task in self.tasks.tasks]
        files = {name: None for text in texts for name in files_of(namelist.values(text))}
        return {
            "run": f"machine {self.run}",
            "machine": self.machine.text(),
            "case": texts[0],
            "contacts": len(texts),
            "file": contents(files),
        }

    def result(self, rows: Mapping[int, Row]) -> MachineResult:
        """Return the result from the tasks finished so far."""
        missing: Row = {"status": "not run", "message": "the study was interrupted"}
        sigma = sigma_of(self.films[0])
        table = table_of(
            [
                row_of(film, sigma, None if n is None else rows.get(n, missing), place)
                for film, n, place in zip(self.films, self.number, self.made.places, strict=True)
            ]
        )
        summary = summary_of(self.machine, self.made, table, sigma)
        return MachineResult(str(summary["kind"]), table, summary)


def perform(
    todo: Prepared,
    folder: str | os.PathLike[str] | None,
    command: str,
    *,
    inputs: tuple[str, ...] = (),
    force: bool = False,
    watcher: Watcher | None = None,
    **execution: Any,  # noqa: ANN401 (as in `gather`)
) -> tuple[MachineResult, Outcome]:
    """Run the missing contacts of a machine element, and write its folder.

    Parameters
    ----------
    todo
        The machine element.
    folder
        Folder of its result; None: nothing is kept on disk.
    command
        'bearing' or 'gear', the kind of the folder.
    inputs
        Files that must not be replaced.
    force
        Accept other files in the folder; they stay.
    watcher
        Receives the progress.
    **execution
        As in `pyehl.studies.sweep.gather`.

    Returns
    -------
    MachineResult, Outcome
        The result, and how the study of its contacts ended.

    Raises
    ------
    InputError
        If the folder has another study or other files.
    FileError
        If it cannot be written.
    """
    outcome = Outcome({})
    files: tuple[str, ...] = FILES
    if isinstance(todo.made, GearPair) and has_duty(todo.made):
        files = (*FILES, *DUTY)
    names = (*JOURNAL, *files) if todo.tasks.tasks else files
    place = None
    if folder is not None:
        place = Destination(Path(folder), command, names, inputs, force=force)
    if todo.tasks.tasks:
        outcome = gather(todo.tasks.tasks, todo.identity(), place, watcher=watcher, **execution)
        result = todo.result(outcome.rows)
        if place is not None:
            _write(Path(place.folder), todo, result, names)
        return result, outcome
    if place is not None:
        if (Path(place.folder) / NAME).exists():
            raise InputError(
                f"{place.folder}: error: holds contacts that were solved or predicted, which "
                f"formulas would replace\nexpected: another folder"
            )
        place.check()
    result = todo.result({})
    if place is not None:
        with place.fresh() as fresh:
            _write(fresh, todo, result, names)
    return result, outcome


def _write(folder: Path, todo: Prepared, result: MachineResult, names: tuple[str, ...]) -> None:
    """Write the files of a result."""
    write_csv(folder / CSV, list(result.table), result.table.itertuples(index=False, name=None))
    save(pictures.figure(result.kind, result.table, result.summary), folder / PICTURE)
    (folder / CASE).write_text(todo.machine.text(), encoding="utf-8")
    if isinstance(todo.made, GearPair) and has_duty(todo.made):
        write_duty(folder, todo.made, todo.films)
    values = {name: finite(value) for name, value in result.summary.items()}
    write_json(folder / SUMMARY, {**values, "files": list(names)})


def _call(
    command: str,
    kinds: tuple[str, ...],
    case: AnyCase,
    options: tuple[Option, ...],
    groups: Mapping[str, Mapping[str, Any]],
    run: str,
    output: str | os.PathLike[str] | None,
    **execution: Any,  # noqa: ANN401 (as in `gather`)
) -> MachineResult:
    check_jobs(execution["jobs"])
    todo = Prepared(case, [*options, groups], kinds, run)
    folder = None if output is None else path_of(output, "output")
    inputs = () if case is ... else (path_of(case, "case"),)
    result, outcome = perform(todo, folder, command, inputs=inputs, **execution)
    if outcome.interrupted:
        raise KeyboardInterrupt
    return result


def bearing(
    case: AnyCase = ...,
    *options: Option,
    run: str = "film",
    output: str | os.PathLike[str] | None = None,
    force: bool = False,
    jobs: int = 0,
    scheduler: str = "",
    **groups: Mapping[str, Any],
) -> MachineResult:
    """Compute the film of every contact of a rolling bearing.

    Parameters
    ----------
    case
        Path of a file with ``&ball_bearing`` or ``&roller_bearing``; without it the options alone.
    *options
        Values that replace those of the file, as in `Case`.
    run
        'film': formulas, at once; 'solve': smooth contacts; 'predict': with the roughness.
    output
        Folder for the table and the picture, and the journal from which an interrupted study is
        resumed; None: nothing is kept on disk.
    force
        Other files may be in that folder; they stay.
    jobs
        Worker processes; 0: as many as processors.
    scheduler
        Address of a dask scheduler (extra ``cluster``), whose workers are used instead.
    **groups
        Values by key of their groups.

    Returns
    -------
    MachineResult
        With ``table``, a row for each element and ring that carries load, ``summary`` with the
        friction torque of rolling and sliding in the contacts, ``data`` and ``plot()``.

    Raises
    ------
    InputError
        If the dimensions or loads of the bearing are not possible, or `output` has other files.
    FileError
        If `output` cannot be written.
    KeyboardInterrupt
        If it was interrupted; `output` has all that was finished.

    Examples
    --------
    >>> import pyehl
    >>> result = pyehl.bearing("cases/bearing_6206.nml", {"ball_bearing.radial_load": 2000.0})
    >>> result.table.ring.unique().tolist(), result.summary["left_out"][:4]
    (['inner', 'outer'], 'cage')
    """
    kinds = ("ball_bearing", "roller_bearing")
    execution = {"force": force, "jobs": jobs, "scheduler": scheduler}
    return _call("bearing", kinds, case, options, groups, run, output, **execution)


def gear(
    case: AnyCase = ...,
    *options: Option,
    run: str = "film",
    output: str | os.PathLike[str] | None = None,
    force: bool = False,
    jobs: int = 0,
    scheduler: str = "",
    **groups: Mapping[str, Any],
) -> MachineResult:
    """Compute the film along the path of contact of a pair of spur gears.

    Parameters
    ----------
    case
        Path of a file with ``&spur_gear``; without it the options alone.
    *options
        Values that replace those of the file, as in `Case`.
    run, output, force, jobs, scheduler, **groups
        As in `bearing`.

    Returns
    -------
    MachineResult
        With ``table``, a row for each station on the path of contact, ``summary`` with the mean
        coefficient of friction and the losses, ``data`` and ``plot()``.

    Raises
    ------
    InputError
        If the gears are not possible or do not mesh, or `output` has other files.
    FileError
        If `output` cannot be written.
    KeyboardInterrupt
        If it was interrupted; `output` has all that was finished.

    Examples
    --------
    >>> import pyehl
    >>> result = pyehl.gear("cases/fzg_c.nml")
    >>> round(result.summary["contact_ratio"], 2)
    1.44
    """
    execution = {"force": force, "jobs": jobs, "scheduler": scheduler}
    return _call("gear", ("spur_gear",), case, options, groups, run, output, **execution)
