# SPDX-License-Identifier: BSD-3-Clause
"""The parts of the page of a sweep or a Stribeck curve, from its journal, table and picture."""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from pyehl import namelist
from pyehl.case import KEYS
from pyehl.errors import InputError
from pyehl.plots.study import Line, study_figure
from pyehl.plots.style import png
from pyehl.reports import page
from pyehl.reports.assessment import WELL_KNOWN, Assessment
from pyehl.reports.conditions import conditions, numbers
from pyehl.reports.limits import limits
from pyehl.reports.page import Block
from pyehl.studies.journal import read_header
from pyehl.studies.tasks import INSIDE
from pyehl.studies.tasks import OUTSIDE as OUTSIDE_FORMULA
from pyehl.theory.line_contact import scaling_contact
from pyehl.theory.transition import FULL_FILM, MIXED, OUTSIDE

STUDY_DPI = 110
TABLES = {"stribeck": "stribeck.csv"}
GOOD = ("converged", "predicted", INSIDE, FULL_FILM)
RESULTS = (*GOOD, OUTSIDE_FORMULA, OUTSIDE, MIXED)
"""Statuses of rows with a result; the results of the last three are to be taken with care."""
# Columns of the page, if they exist, each with the columns that may hold its error
COLUMNS: dict[str, tuple[str, ...]] = {
    "h_c_m": ("h_c_error_m",),
    "h_min_m": ("h_min_error_m",),
    "H_c": ("H_c_error",),
    "H_min": ("H_min_error",),
    "lambda_ratio": (),
    "theta_2": (),
    "mu_ratio": ("mu_ratio_error", "mu_ratio_model_error"),
    "mu_ratio_ehl": ("mu_ratio_ehl_error",),
    "mu": (),
}
DRAWN = ("h_c_m", "H_c", "h_min_m", "H_min", "mu_ratio")
MAX_ROWS, MAX_LINES, MAX_PANELS, MAX_MESSAGES = 200, 7, 3, 20


def study_parts(folder: Path) -> tuple[str, Assessment, list[Block]]:
    """Give title, assessment and parts of the page of a study.

    InputError if the folder has no journal that can be read, or no table.
    """
    header = read_header(folder)
    if header is None or "case" not in header:
        raise InputError(f"{folder}: its journal cannot be read")
    run = str(header["run"])
    path = folder / TABLES.get(run, "results.csv")
    try:
        rows = pd.read_csv(path, keep_default_na=True)
    except (OSError, ValueError) as error:
        raise InputError(f"{path}: cannot be read: {error}") from error
    keys = [str(key) for key in header["vary"]]
    title = "Stribeck curve" if run == "stribeck" else f"Sweep ({run})"
    # keys that vary together count once
    tied = {key for group in header["zip"] for key in group[1:]}
    size = math.prod(len(values) for key, values in header["vary"].items() if key not in tied)
    settings = namelist.values(str(header["case"]))
    parts = [page.heading("Conditions")]
    units = {key.name: key.unit for key in KEYS.values()}
    parts.append(
        page.facts(
            {
                _with_unit(key, units): ", ".join(f"{v}" for v in values)
                for key, values in header["vary"].items()
            }
        )
    )
    parts.append(page.paragraph("The first case has:"))
    parts += [page.facts(conditions(settings)), page.facts(numbers(settings))]
    parts.append(page.heading("Results"))
    point = scaling_contact(settings)
    about = (
        f"{title}; first case $M$ = {point.moes_m:.4g}, $L$ = {point.moes_l:.4g}, "
        f"$p_h$ = {point.hertz_pressure * 1e-9:.3g} GPa"
    )
    parts += _pictures(folder, rows, keys, units, about)
    parts += _table(rows, keys)
    messages = [text for text in rows["message"].dropna().astype(str).unique() if text.strip()]
    if messages:
        parts += [page.heading("Warnings"), page.bullets(messages[:MAX_MESSAGES])]
    parts.append(page.heading("Limits that apply"))
    kind = "prediction" if run in ("predict", "stribeck") else "solution"
    of_all = {"kind": kind, "contact_load_share": _max_load_share(rows)}
    parts.append(page.bullets(limits(settings, of_all)))
    parts.append(page.heading("The first case"))
    parts.append(page.preformatted(namelist.given(str(header["case"]))))
    return title, _assess(rows, size), parts


def _max_load_share(rows: pd.DataFrame) -> float | None:
    """Give the maximum load share of the boundary film; None if none is known."""
    name = "contact_load_share"
    return float(rows[name].max()) if name in rows and rows[name].notna().any() else None


def _with_unit(key: str, units: Mapping[str, str]) -> str:
    return f"{key} [{units[key]}]" if units.get(key, "-") != "-" else key


def _assess(rows: pd.DataFrame, size: int) -> Assessment:
    """Assess a study by status, assessment and errors of its rows."""
    counts = rows["status"].fillna("none").value_counts()
    known = int(counts[counts.index.isin(RESULTS)].sum())
    with_care = counts[counts.index.isin(RESULTS) & ~counts.index.isin(GOOD)]
    others = counts[~counts.index.isin(RESULTS)]
    missing = size - len(rows)
    unfinished = f"; {missing} are not done" if missing > 0 else ""
    why = f"{known} of {len(rows)} cases have a result{unfinished}."
    for words, those in (("With care", with_care), ("Others", others)):
        if len(those):
            why += f" {words}: {', '.join(f'{n} {word!r}' for word, n in those.items())}."
    thin = False
    if "assessment" in rows:
        words = rows["assessment"].dropna().str.partition(":")[0].value_counts()
        why += f" By their assessments: {', '.join(f'{n} {word}' for word, n in words.items())}."
        thin = any(word != "full film" for word in words.index)
    if known == 0:
        return Assessment("No result", why, "fail")
    errors = _errors(rows)
    if errors:
        why += f" Maximum errors: {', '.join(f'{n} {100.0 * v:.2g} %' for n, v in errors.items())}."
    doubtful = any(error > WELL_KNOWN for error in errors.values())
    if doubtful:
        why += f" Above {100.0 * WELL_KNOWN:g} % a finer grid is recommended."
    if len(others) or len(with_care) or unfinished or doubtful or thin:
        return Assessment("Take with care", why, "care")
    return Assessment("Holds", why, "pass")


def _errors(rows: pd.DataFrame) -> dict[str, float]:
    """Give the maximum relative error of each result with errors in the table."""
    result = {}
    for name in DRAWN:
        for column in COLUMNS[name]:
            if name in rows and column in rows and rows[column].notna().any():
                result[name] = float((rows[column] / rows[name].abs()).max())
                break
    return result


def _cell(value: Any) -> str:  # noqa: ANN401 (of a table)
    if isinstance(value, str):
        return value
    return "" if pd.isna(value) else f"{value:.5g}"


def _table(rows: pd.DataFrame, keys: Sequence[str]) -> list[Block]:
    names = [*keys]
    for name, errors in COLUMNS.items():
        names += [n for n in (name, *errors) if n in rows and rows[n].notna().any()]
    names.append("status")
    shown = rows[names].head(MAX_ROWS)
    kinds = ["pass" if word in GOOD else "care" for word in shown["status"]]
    parts = [page.table(names, [[_cell(v) for v in row] for row in shown.values.tolist()], kinds)]
    if len(rows) > MAX_ROWS:
        parts.append(page.paragraph(f"The first {MAX_ROWS} of {len(rows)} rows."))
    return parts


def _pictures(
    folder: Path, rows: pd.DataFrame, keys: Sequence[str], units: Mapping[str, str], title: str
) -> list[Block]:
    """Give the picture of a curve, or draw the results over the first key."""
    drawn = folder / "stribeck.png"
    if drawn.is_file():
        words = "Friction against the varied quantity"
        return [page.picture(drawn.read_bytes(), f"{words}; the numbers are in the table.", words)]
    if rows.empty or not pd.api.types.is_numeric_dtype(rows[keys[0]]):
        return []
    panels: list[tuple[str, list[Line]]] = []
    for name in DRAWN:
        if name in rows and rows[name].notna().any() and len(panels) < MAX_PANELS:
            label = f"{name.removesuffix('_m')} [m]" if name.endswith("_m") else name
            panels.append((label, _lines(rows, keys, name)))
    if not panels:
        return []
    figure = study_figure(panels, _with_unit(keys[0], units), title)
    names = ", ".join(label for label, _ in panels)
    count = len(rows[list(keys[1:])].drop_duplicates()) if keys[1:] else 1
    shown = len(panels[0][1])
    span = f"{rows[keys[0]].min():.4g} to {rows[keys[0]].max():.4g}"
    words = f"{names} over {keys[0]} from {span}"
    if shown < count:
        words += f" (the first {shown} of {count} lines)"
    return [page.picture(png(figure, STUDY_DPI), f"{words}; numbers in the table.", words)]


def _lines(rows: pd.DataFrame, keys: Sequence[str], name: str) -> list[Line]:
    """Give a line for each value of the other keys, at most `MAX_LINES`."""
    known = (e for e in COLUMNS[name] if e in rows and rows[e].notna().any())
    error = next(known, "")
    groups = rows.groupby(list(keys[1:]), sort=False) if keys[1:] else [("", rows)]
    lines = []
    for value, those in groups:
        values = value if isinstance(value, tuple) else (value,)
        label = ", ".join(f"{k} = {v}" for k, v in zip(keys[1:], values, strict=False))
        errors = those[error].to_numpy(float) if error else np.full(len(those), np.nan)
        lines.append(
            Line(label, those[keys[0]].to_numpy(float), those[name].to_numpy(float), errors)
        )
    return lines[:MAX_LINES]
