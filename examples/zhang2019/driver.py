# SPDX-License-Identifier: BSD-3-Clause
"""Reproduce figures and tables of the paper, and write the report.

A piece runs before the numbers of the paper are read, so that these cannot affect the computation.
"""

import time
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import replace
from html import escape
from pathlib import Path
from typing import cast

import figure1
import figure2
import figure3
import figure4
import figure5
import figure6
import figure7
import table1
import table2
from piece import Level, Piece, References, Result, read_references
from runs import RunFailed, Runs

from pyehl.arrays import write_csv
from pyehl.destination import Destination, file_errors
from pyehl.errors import InputError
from pyehl.plots.style import DPI, save
from pyehl.reports import page
from pyehl.studies.plan import Plan
from pyehl.studies.sweep import Watcher

# In the order of the computation and of the report
MODULES = (table1, figure1, figure2, figure3, figure4, figure5, figure6, table2, figure7)
PIECES: dict[str, Piece] = {module.NAME: cast(Piece, module) for module in MODULES}
"""Figures and tables by name."""
PAPER = (
    "Zhang, Biboulet, Venner & Lubrecht 2019, Prediction of the Stribeck curve under full-film "
    "elastohydrodynamic lubrication, doi 10.1016/j.triboint.2019.01.028"
)


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
    """Reproduce pieces of the paper, by their names in `PIECES`, in the order of `PIECES`.

    Writes ``report.html``, a folder for each piece and ``studies``; existing studies of the same
    level are not run again. `machine` are lines of the report, `watch` returns the watcher of a
    study, `done` is called with each result, `references` replace the numbers of the paper.
    InputError if there is no such piece, or the folder has other files; FileError if something
    cannot be written; KeyboardInterrupt if it is interrupted: finished studies are kept.
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


def _seconds(result: Result) -> str:
    theirs = f"; the paper: {result.paper_seconds}" if result.paper_seconds else ""
    return (
        f"{result.seconds:.0f} s of processor time in its runs (shared runs count for each piece), "
        f"{result.wall:.0f} s now{theirs}"
    )


def _head(results: Sequence[Result], level: Level) -> list[str]:
    count = Counter(r.verdict for r in results)
    judged = len(results) - count["nothing to judge"]
    more = f" Not reproduced: {n}, explained below." if (n := count["not reproduced"]) else ""
    more += f" Nothing to judge: {n}." if (n := count["nothing to judge"]) else ""
    return [
        f"{count['pass']} of {judged} pieces are within all their tolerances.{more} "
        f"Level: {level.name}; it leaves out: {level.leaves_out}.",
        "All computed numbers come from runs in the folder `studies`, a table and a journal for "
        "each. Ratios mu_r/mu_s are those of a Newtonian lubricant; shear thinning at real sliding "
        "speeds brings them close to 1.",
    ]


def _kind(result: Result) -> str:
    """Return the CSS class of the verdict."""
    return {"pass": "pass", "FAIL": "fail"}.get(result.verdict, "care")


def _piece(folder: Path, r: Result) -> list[page.Part]:
    out: list[page.Part] = [
        page.heading(f"{r.name.capitalize()}: {r.title}", r.folder.name),
        page.paragraph(r.line(), _kind(r)),
    ]
    if r.figure is not None:
        out.append(page.picture(r.file(".png").read_bytes(), r.caption, r.caption))
    if r.checks:
        rows = [check.row() for check in r.checks]
        out.append(page.table(list(rows[0]), [list(row.values()) for row in rows]))
    if r.notes:
        out.append(page.bullets(r.notes))
    if r.table is not None:
        studies = ", ".join(f"studies/{made.name}" for made in r.studies) or "none"
        file = r.file(".csv")
        out.append(
            f"<p>Numbers: <a href='{escape(str(file.relative_to(folder)))}'>{escape(file.name)}"
            f"</a>. Runs: {escape(studies)}. {escape(_seconds(r))}.</p>"
        )
    return out


def write_report(
    folder: Path, results: Sequence[Result], level: Level, machine: Sequence[str]
) -> Path:
    """Write the page with the pictures and tables, completely or not at all; returns its path.

    `machine` names versions, processor and settings. FileError if it cannot be written.
    """
    parts: list[page.Part] = [page.paragraph(text) for text in (PAPER, *_head(results, level))]
    parts.append(page.preformatted("\n".join(machine)))
    links = "".join(
        f"<tr><td><a href='#{escape(r.folder.name)}'>{escape(r.name)}</a></td>"
        f"<td>{escape(r.title)}</td><td class='{_kind(r)}'>{escape(r.line())}</td></tr>"
        for r in results
    )
    parts.append(f'<div class="wide"><table>{links}</table></div>')
    findings = [f for r in results for f in r.findings]
    if findings:
        parts.append(page.heading("Where the paper is not reproduced, and why"))
        parts.append(page.bullets(f"{f.title}. {f.text}" for f in findings))
    for r in results:
        parts += _piece(folder, r)
    return page.write_page(folder / "report.html", "Reproduction of the paper", parts, "reproduce")
