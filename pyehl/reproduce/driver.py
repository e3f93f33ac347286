# SPDX-License-Identifier: BSD-3-Clause
"""Redo pieces of the paper, and write the report.

A piece is run before the numbers of the paper are read for it: nothing that computes sees them.
"""

import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import cast

from pyehl.arrays import write_csv
from pyehl.destination import Destination, file_errors
from pyehl.errors import InputError
from pyehl.plots.style import save
from pyehl.reproduce import (
    figure1,
    figure2,
    figure3,
    figure4,
    figure5,
    figure6,
    figure7,
    table1,
    table2,
)
from pyehl.reproduce.level import Level
from pyehl.reproduce.piece import Piece, Result
from pyehl.reproduce.references import References, read_references
from pyehl.reproduce.report import write_report
from pyehl.reproduce.runs import RunFailed, Runs
from pyehl.studies.gather import Watcher
from pyehl.studies.plan import Plan

DPI = 130
# In the order of the report; the order of the work is the same
MODULES = (table1, figure1, figure2, figure3, figure4, figure5, figure6, table2, figure7)
PIECES: dict[str, Piece] = {module.NAME: cast(Piece, module) for module in MODULES}
"""Figures and tables by name."""


def reproduce(
    names: Sequence[str],
    level: Level,
    folder: Path,
    *,
    jobs: int = 0,
    force: bool = False,
    machine: Sequence[str] = (),
    watch: Callable[[str, Plan], Watcher] | None = None,
    done: Callable[[Result], None] | None = None,
    references: References | None = None,
) -> list[Result]:
    """Redo pieces of the paper, by their names in `PIECES`, in the order there.

    The folder gets ``report.html``, a folder for each piece and ``studies``; what is there of the
    same level is not computed again. `machine` are lines of the report, `watch` gives the watcher
    of a study, `done` is told each piece, `references` are compared with in place of those of the
    paper. InputError if there is no such piece, or the folder holds something else; FileError if
    something cannot be written; KeyboardInterrupt if somebody stopped it: what was finished is
    kept.
    """
    for name in names:
        if name not in PIECES:
            raise InputError(f"'{name}' is no piece of the paper; expected {', '.join(PIECES)}")
    names_of_all = ("report.html", "studies", *map(_folder_of, PIECES))
    Destination(folder, "reproduce", names_of_all, force=force).claim({"level": level.name})
    runs = Runs(folder / "studies", jobs, watch)
    results = []
    for name, piece in PIECES.items():
        if name not in names:
            continue
        place = folder / _folder_of(name)
        with file_errors(place, "cannot be made"):
            place.mkdir(exist_ok=True)
        began = time.perf_counter()
        try:
            data = piece.run(runs, level)
        except RunFailed as error:
            result = Result(failed=str(error))
        else:
            numbers = read_references() if references is None else references
            result = piece.show(data, numbers, level)
        wall = time.perf_counter() - began
        result = replace(result, name=name, title=piece.TITLE, folder=place, wall=wall)
        if result.table is not None:
            write_csv(result.file(".csv"), *result.table)
        if result.figure is not None:
            save(result.figure, result.file(".png"), DPI, "reproduce")
        results.append(result)
        if done is not None:
            done(result)
    write_report(folder, results, level, machine)
    return results


def _folder_of(name: str) -> str:
    return name.replace(" ", "")
