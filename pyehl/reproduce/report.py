# SPDX-License-Identifier: BSD-3-Clause
"""One page of all pieces, ``report.html``, with the pictures in it."""

from __future__ import annotations

import base64
import html
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import pandas as pd

from pyehl.destination import new_file
from pyehl.reproduce.level import Level
from pyehl.reproduce.piece import Result

__all__ = ["write_report"]

STYLE = (
    "body{font-family:sans-serif;max-width:62em;margin:2em auto;padding:0 1em;line-height:1.45}"
    "img{max-width:100%}table{border-collapse:collapse;font-size:.85em}"
    "td,th{border:1px solid #ccc;padding:.2em .5em;text-align:left}"
    ".FAIL{color:#b00020;font-weight:bold}.pass{color:#006e4e}.not{color:#8a5a00}pre{background:#f5f5f5;padding:.6em}"
)
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


def _head(results: Sequence[Result], level: Level, machine: Sequence[str]) -> list[str]:
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
        *machine,
    ]


def _html(folder: Path, results: Sequence[Result], level: Level, machine: Sequence[str]) -> str:
    text = html.escape
    first, second, *rest = _head(results, level, machine)
    out = [
        f"<!doctype html><html lang='en'><head><meta charset='utf-8'><title>The paper redone"
        f"</title><style>{STYLE}</style></head><body><h1>The paper redone</h1>",
        f"<p>{text(PAPER)}</p><p>{text(first)}</p><p>{text(second)}</p>",
        f"<pre>{text(chr(10).join(rest))}</pre><table>",
    ]
    out += [
        f"<tr><td><a href='#{r.folder.name}'>{text(r.name)}</a></td><td>{text(r.title)}</td>"
        f"<td class='{r.verdict}'>{text(r.line())}</td></tr>"
        for r in results
    ]
    out.append("</table>")
    findings = [f for r in results for f in r.findings]
    if findings:
        out.append("<h2>Where the paper is not reproduced, and why</h2><ul>")
        out += [f"<li><b>{text(f.title)}.</b> {text(f.text)}</li>" for f in findings]
        out.append("</ul>")
    for r in results:
        out.append(
            f"<h2 id='{r.folder.name}'>{text(r.name.capitalize())}: {text(r.title)}</h2>"
            f"<p class='{r.verdict}'>{text(r.line())}</p>"
        )
        if r.figure is not None:
            data = base64.b64encode(r.file(".png").read_bytes()).decode()
            out.append(
                f"<p><img alt='{text(r.caption, quote=True)}' src='data:image/png;base64,{data}'>"
                f"<br>{text(r.caption)}</p>"
            )
        if r.checks:
            table = pd.DataFrame([check.row() for check in r.checks])
            out.append(table.to_html(index=False, border=0))
        if r.notes:
            out.append("<ul>" + "".join(f"<li>{text(note)}</li>" for note in r.notes) + "</ul>")
        studies = ", ".join(f"studies/{made.name}" for made in r.studies) or "none"
        if r.table is not None:
            file = r.file(".csv")
            out.append(
                f"<p>Numbers: <a href='{file.relative_to(folder)}'>{file.name}</a>. Runs: "
                f"{text(studies)}. {text(_seconds(r))}.</p>"
            )
    return "\n".join([*out, "</body></html>"]) + "\n"


def write_report(
    folder: Path, results: Sequence[Result], level: Level, machine: Sequence[str]
) -> Path:
    """Write the page above the pictures and tables, whole or not at all; returns its path.

    `machine` names versions, machine and settings. FileError if it cannot be written.
    """
    page = folder / "report.html"
    with new_file(page) as partial:
        partial.write_text(_html(folder, results, level, machine), encoding="utf-8")
    return page
