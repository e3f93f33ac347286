# SPDX-License-Identifier: BSD-3-Clause
"""What ``pyehl stribeck`` prints: the table, the deviation of measured friction, the last lines."""

from collections import Counter

import numpy as np
import pandas as pd

from pyehl.studies.curve import CONCLUSION, curves_of
from pyehl.studies.curve_plan import CurvePlan
from pyehl.studies.measured_friction import Measured
from pyehl.theory.transition import FULL_FILM, MIXED, OUTSIDE, Curve

COLUMNS = {
    "h_c_m": "h_c [m]",
    "h_min_m": "h_min [m]",
    "h_min_rough_m": "rough [m]",
    "lambda_ratio": "Lambda",
    "theta_2": "theta_2",
    "hersey": "Hersey",
    "mu_ratio": "mu_r/mu_s",
    "mu_ratio_model_error": "+- model",
    "mu": "mu",
    "mu_isothermal": "isothermal",
    "temperature_rise_max_K": "dT [K]",
    "contact_load_share": "contact",
    "contact_load_share_error": "+- contact",
    "contact_area_share": "area",
    "mu_empirical": "empirical",
    "mu_ratio_ehl": "simulated",
}


def absolute_friction(plan: CurvePlan, table: pd.DataFrame) -> bool:
    """Whether all results are coefficients of friction, where there is sliding.

    A point whose smooth contact has no solution has a ratio, and is left out.
    """
    sliding = np.array([bool(p.settings["contact"]["slide_to_roll"]) for p in plan.points])
    found = table[sliding & table["status"].isin((FULL_FILM, MIXED, OUTSIDE))]
    found = found[(found["status"] != OUTSIDE) | found["mu_ratio"].notna()]
    return bool(len(found) and found["mu"].notna().all())


def report(plan: CurvePlan, table: pd.DataFrame) -> str:
    """Return the table that is printed."""
    keys = plan.study.keys
    names = [name for name in COLUMNS if name in table and table[name].notna().any()]
    head = [*(f"{key:>21}" for key in keys), *(f"{COLUMNS[name]:>10}" for name in names)]
    lines = ["  ".join([*head, "status"])]
    for row in table.to_dict("records"):
        cells = [f"{row[key]:>21}" for key in keys]
        cells += [f"{'-' if pd.isna(row[n]) else format(row[n], '.4g'):>10}" for n in names]
        lines.append("  ".join([*cells, row["status"]]))
    for curve in curves_of(plan, table):
        lines.append(f"{curve.label + ': ' if curve.label else ''}{curve.ends}")
        if ends := curve.lift_off:
            lines.append(ends.words)
    if plan.load_share is not None:
        lines.append(plan.load_share.words)
    return "\n".join(lines)


def last_lines(plan: CurvePlan, table: pd.DataFrame) -> str:
    """Report the point with the minimum film in full, and count the assessments of all."""
    film = table["h_min_rough_m"].fillna(table["h_min_m"]).astype(float)
    film = film[table["h_min_m"].notna()]
    if film.empty:
        return "assessment no result: no point has a film"
    thinnest = int(film.idxmin())
    words = table["assessment"].str.partition(":")[0].where(table["status"] != OUTSIDE, OUTSIDE)
    counts = ", ".join(f"{word} at {n}" for word, n in Counter(words).items())
    return (
        f"the minimum film is at {plan.points[thinnest].point}:\n"
        f"{table[CONCLUSION][thinnest]}\n"
        f"curve      {counts} of {len(table)} points"
    )


def deviation(curve: Curve, measured: Measured) -> list[str]:
    """Report how far a curve is from measured friction."""
    lines = []
    for name in (measured.ordinate, "mu_empirical"):
        if name not in curve.table:
            continue
        found = measured.deviation(name, curve)
        known = np.isfinite(found)
        if not known.any():
            lines.append(f"measured   no point where there is {name}")
            continue
        worst = int(np.nanargmax(np.abs(found)))
        lines.append(
            f"measured   {name} is off by {np.mean(found[known]):+.1%} in the mean, "
            f"{np.sqrt(np.mean(found[known] ** 2)):.1%} rms, {found[worst]:+.1%} at the most "
            f"({measured.abscissa} = {measured.places[worst]:.4g}); {known.sum()} of "
            f"{known.size} points"
        )
    return lines
