# SPDX-License-Identifier: BSD-3-Clause
"""The parts of the page of a bearing or a gear pair."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pandas as pd

from pyehl.destination import file_errors
from pyehl.machines.perform import CASE, CSV, PICTURE
from pyehl.machines.result import DONE
from pyehl.machines.text import cells, notes_of, sums
from pyehl.reports import page
from pyehl.reports.assessment import Assessment
from pyehl.reports.page import Block

KINDS = {"bearing": "Bearing", "gear": "Gear pair"}
# Λ above which the film is full, and below which it is mixed
FULL, MIXED = 3.0, 1.0


def machine_parts(folder: Path, summary: Mapping[str, Any]) -> tuple[str, Assessment, list[Block]]:
    """Give title, assessment and parts; FileError if a file of the folder cannot be read."""
    kind = str(summary["kind"])
    with file_errors(folder / CSV, "cannot be read"):
        table = pd.read_csv(folder / CSV)
    with file_errors(folder / CASE, "cannot be read"):
        case = (folder / CASE).read_text(encoding="utf-8")
    values = {name: float("nan") if value is None else value for name, value in summary.items()}
    columns = cells(kind, table)
    parts = [
        page.heading("Results"),
        page.facts(sums(table, values)),
        page.heading("Contacts"),
        page.table(list(columns), zip(*columns.values(), strict=True)),
    ]
    with file_errors(folder / PICTURE, "cannot be read"):
        drawn = (folder / PICTURE).read_bytes()
    where = "around the bearing" if kind == "bearing" else "along the path of contact"
    words = f"Film and pressure {where}"
    parts += [page.heading("Picture"), page.picture(drawn, f"{words}.", f"{words}.")]
    parts += [page.heading("Limits that apply"), page.bullets(notes_of(table, values))]
    parts += [page.heading("The file"), page.preformatted(case)]
    return KINDS[kind], _assess(table, values), parts


def _assess(table: pd.DataFrame, summary: Mapping[str, Any]) -> Assessment:
    """Assess the films of a machine element."""
    missing = int((~table["status"].isin(DONE)).sum())
    if missing:
        return Assessment("No result", f"{missing} of {len(table)} contacts have none.", "fail")
    film = f"The minimum film is {summary['h_min_m'] * 1e9:.4g} nm"
    ratio = summary.get("lambda_ratio_min")
    if ratio is None:
        return Assessment("Smooth", f"{film}; no finish is given.", "pass")
    why = f"{film}, Λ {ratio:.3g}."
    if ratio >= FULL:
        return Assessment("Full film", why, "pass")
    return Assessment("Take with care" if ratio >= MIXED else "Mixed film", why, "care")
