# SPDX-License-Identifier: BSD-3-Clause
"""What ``pyehl stribeck`` prints: the table, the deviation of measured friction, the last lines."""

from collections import Counter
from collections.abc import Sequence

import numpy as np

from pyehl.studies.curve import FULL_FILM, MIXED, OUTSIDE, conclude, full_film_ends
from pyehl.studies.curve_contact import lift_off
from pyehl.studies.curve_plan import CurvePlan
from pyehl.studies.measured_friction import Measured
from pyehl.types import Array, Values


def curves_of(plan: CurvePlan, rows: Sequence[Values]) -> list[tuple[str, Array, Sequence[Values]]]:
    """Split a table into curves: name, values of the first key, rows."""
    keys = plan.study.keys
    found: dict[str, tuple[list[float], list[Values]]] = {}
    for point, row in zip(plan.points, rows, strict=True):
        name = ", ".join(f"{key} = {point.point.values[key]}" for key in keys[1:])
        places, those = found.setdefault(name, ([], []))
        places.append(float(point.point.values[keys[0]]))
        those.append(row)
    return [(name, np.array(places), those) for name, (places, those) in found.items()]


def absolute_friction(plan: CurvePlan, rows: Sequence[Values]) -> bool:
    """Whether all answers are coefficients of friction, where there is sliding.

    A point whose smooth contact has no solution has a ratio, and is left out.
    """
    answers = [
        row
        for point, row in zip(plan.points, rows, strict=True)
        if row["status"] in (FULL_FILM, MIXED, OUTSIDE)
        and point.settings["contact"]["slide_to_roll"]
        and (row["status"] != OUTSIDE or row["mu_ratio"] is not None)
    ]
    return bool(answers) and all(row["mu"] is not None for row in answers)


def report(plan: CurvePlan, rows: Sequence[Values]) -> str:
    """Return the table that is printed."""
    keys = plan.study.keys
    columns = {
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
        "temperature_rise_max_K": "rise [K]",
        "contact_load_share": "contact",
        "contact_load_share_error": "+- contact",
        "contact_area_share": "area",
        "mu_empirical": "empirical",
        "mu_ratio_ehl": "simulated",
    }
    names = [name for name in columns if any(row.get(name) is not None for row in rows)]
    head = [*(f"{key:>21}" for key in keys), *(f"{columns[name]:>10}" for name in names)]
    lines = ["  ".join([*head, "status"])]
    for point, row in zip(plan.points, rows, strict=True):
        cells = [f"{point.point.values[key]:>21}" for key in keys]
        cells += [f"{'-' if row.get(n) is None else format(row[n], '.4g'):>10}" for n in names]
        lines.append("  ".join([*cells, str(row["status"])]))
    for label, places, those in curves_of(plan, rows):
        lines.append(f"{label + ': ' if label else ''}{full_film_ends(keys[0], places, those)[0]}")
        if ends := lift_off(keys[0], places, those):
            lines.append(ends.words)
    if plan.load_share is not None:
        lines.append(plan.load_share.words)
    return "\n".join(lines)


def last_lines(plan: CurvePlan, rows: Sequence[Values]) -> str:
    """Tell all of the point with the thinnest film, and what the points are worth."""
    known = [k for k, row in enumerate(rows) if row["h_min_m"] is not None]
    if not known:
        return "judgement  no answer: no point has a film"

    def least(k: int) -> float:
        rough = rows[k]["h_min_rough_m"]
        return float(rows[k]["h_min_m"] if rough is None else rough)

    thinnest = min(known, key=least)
    words = Counter(
        OUTSIDE if row["status"] == OUTSIDE else str(row["judgement"]).partition(":")[0]
        for row in rows
    )
    counts = ", ".join(f"{word} at {n}" for word, n in words.items())
    point = plan.points[thinnest]
    return (
        f"the thinnest film is at {point.point}:\n{conclude(point, rows[thinnest])}\n"
        f"curve      {counts} of {len(rows)} points"
    )


def deviation(plan: CurvePlan, rows: Sequence[Values], measured: Measured) -> list[str]:
    """Say how far the curve is from measured friction."""
    key = plan.study.keys[0]
    places = np.array([float(p.point.values[key]) for p in plan.points])
    lines = []
    for name in (measured.ordinate, "mu_empirical"):
        if name not in rows[0]:
            continue
        found = measured.deviation(name, key, places, rows)
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
