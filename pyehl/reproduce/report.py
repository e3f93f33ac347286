# SPDX-License-Identifier: BSD-3-Clause
"""One page of all pieces, ``report.html``, with the pictures in it."""

from collections import Counter
from collections.abc import Sequence
from html import escape
from pathlib import Path

from pyehl.reports import page
from pyehl.reproduce.level import Level
from pyehl.reproduce.piece import Result

PAPER = (
    "Zhang, Biboulet, Venner & Lubrecht 2019, Prediction of the Stribeck curve under full-film "
    "elastohydrodynamic lubrication, doi 10.1016/j.triboint.2019.01.028"
)


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
        "Every number of ours comes from runs in the folder `studies`, a table and a journal for "
        "each. Ratios mu_r/mu_s are those of a Newtonian lubricant; shear thinning at real sliding "
        "speeds brings them close to 1.",
    ]


def _kind(result: Result) -> str:
    """Give the class of the verdict in the page."""
    return {"pass": "pass", "FAIL": "fail"}.get(result.verdict, "care")


def _piece(folder: Path, r: Result) -> list[str]:
    out = [
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
    """Write the page above the pictures and tables, whole or not at all; returns its path.

    `machine` names versions, machine and settings. FileError if it cannot be written.
    """
    parts = [page.paragraph(text) for text in (PAPER, *_head(results, level))]
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
    return page.write_page(folder / "report.html", "The paper redone", parts, "reproduce")
