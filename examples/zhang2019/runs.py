# SPDX-License-Identifier: BSD-3-Clause
"""Studies under the figures: made by the machinery of ``pyehl sweep``, hence resumed, never redone.

Each study is a folder with its journal and its table; their rows are where the figures come from.
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
    """A run has no result without which there is no figure."""


@dataclass(frozen=True, slots=True)
class Made:
    """A finished study."""

    # Of the study
    name: str
    folder: Path
    # Results by their names in ``summary.json`` with what was varied, in the order asked for
    rows: tuple[Row, ...]
    kept: tuple[Path, ...] = ()  # result folders of the cases; empty where none were kept

    def solved(self, place: int) -> Row:
        """Row of a case without which there is no figure; RunFailed if it has no result."""
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
    """Makes studies in a folder."""

    folder: Path  # where they go
    jobs: int = 0  # worker processes; 0: as many as processors
    # Gives the watcher of a study, from its name and plan; None: nobody looks
    watch: Callable[[str, Plan], Watcher] | None = None
    made: dict[str, Made] = field(default_factory=dict)  # the studies that were asked for, by name

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
        """Run what is missing of a study, and give its rows.

        The cases share a namelist text and options; all keys of `vary` move together. `keep`: each
        case keeps its result folder. InputError if the folder holds another study of that name, or
        a case is not acceptable; KeyboardInterrupt if somebody stopped it: what was finished is
        kept.
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
    """mu_r/mu_s of rows (n,); NaN where a run has none."""
    return np.array([np.nan if r.get("mu_ratio") is None else r["mu_ratio"] for r in rows])
