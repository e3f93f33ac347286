# SPDX-License-Identifier: BSD-3-Clause
"""Studies of the figures: run as by ``pyehl sweep``, hence resumed; only failed cases are repeated.

Each study is a folder with its journal and its table, whose rows the figures show.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from pyehl.case import Case
from pyehl.errors import EhlError
from pyehl.studies.plan import Plan, plan
from pyehl.studies.study import axis, make
from pyehl.studies.sweep import CASES, Watcher, perform
from pyehl.studies.tasks import why_none
from pyehl.types import Array, Row


class RunFailed(EhlError):  # noqa: N818 (what happened)
    """A run that a figure needs has no result."""


@dataclass(frozen=True, slots=True)
class Made:
    """A finished study."""

    name: str
    folder: Path
    # Results by their names in ``summary.json`` with the varied keys, in the order of the cases
    rows: tuple[Row, ...]
    kept: tuple[Path, ...] = ()  # result folders of the cases; empty if none were kept

    def solved(self, place: int) -> Row:
        """Return the row of a case that a figure needs; RunFailed if it has no result."""
        row = self.rows[place]
        if why := why_none(row):
            raise RunFailed(f"case {place + 1} of the study '{self.name}': {why}")
        return row

    @property
    def seconds(self) -> float:
        """Processor time of its cases [s], each on one thread."""
        return float(sum(row.get("seconds") or 0.0 for row in self.rows))


@dataclass(slots=True)
class Runs:
    """Runs studies in a folder."""

    folder: Path
    jobs: int = 0  # worker processes; 0: as many as processors
    # Returns the watcher of a study from its name and plan; None: without watcher
    watch: Callable[[str, Plan], Watcher] | None = None
    made: dict[str, Made] = field(default_factory=dict)  # finished studies by name

    def study(
        self,
        name: str,
        case: str,
        vary: Mapping[str, Sequence[Any]],
        *,
        options: Sequence[str] = (),
        run: str = "solve",
        keep: bool = False,
    ) -> Made:
        """Run the missing cases of a study, and return it.

        The cases share a namelist text and options; all keys of `vary` vary together. `keep`: each
        case keeps its result folder. InputError if the folder has another study of that name, or a
        case is not valid; KeyboardInterrupt if it is interrupted: finished cases are kept.
        """
        if name in self.made:
            return self.made[name]
        axes = [axis(key, list(values)) for key, values in vary.items()]
        base = Case.from_text(case, origin=name)
        study = make(base, axes, options=options, zipped=True, run=run)
        folder = self.folder / name
        todo = plan(study, folder.absolute() / CASES if keep else None)
        watcher = self.watch(name, todo) if self.watch is not None else None
        outcome = perform(todo, folder, jobs=self.jobs, retry=True, watcher=watcher)
        if outcome.interrupted:
            raise KeyboardInterrupt
        rows = tuple(point.values | outcome.rows[point.number] for point in todo.points)
        kept = tuple(Path(task.folder) for task in todo.tasks) if keep else ()
        self.made[name] = Made(name, folder, rows, kept)
        return self.made[name]


def friction_of(rows: Sequence[Row]) -> Array:
    """Return mu_r/mu_s of rows (n,); NaN where a run has none."""
    return np.array([np.nan if r.get("mu_ratio") is None else r["mu_ratio"] for r in rows])
