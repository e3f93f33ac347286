# SPDX-License-Identifier: BSD-3-Clause
"""Stated errors, time steps, fields and the response, from their tables."""

from __future__ import annotations

import contextlib
import io

import numpy as np
from records import Values, percent, read, script

from pyehl.prediction.response import INLET_FILM

TABLES = script("tables.py")


def steps() -> Values:
    """Algebraic errors of time steps; one of them is above a tenth."""
    rows = read("steps/table.csv")
    lines = {
        row["case"]: " | ".join(
            [
                row["points"],
                f"{float(row['cycles_per_step']):.2f}",
                f"{float(row['mu_ratio']):.5f}",
                *(row[name] for name in ("algebraic_error", "grid_error", "share")),
            ]
        )
        for row in rows
    }
    (beyond,) = (row for row in rows if float(row["share"]) >= 0.1)
    assert "without waves shorter than a/8" in beyond["case"]
    laws = [float(row["share"]) for row in rows if "Eyring" in row["case"] or "Carr" in row["case"]]
    assert len(laws) == 4
    return locals()


def smooth_errors() -> Values:
    """Changes by the doubled domain, and how many true errors the stated ones cover."""
    make = script("errors/make.py")
    rows = make.numbers("smooth")
    changed = [row for row in rows if row["H_c_doubled"] and row["H_c"]]
    assert {row["status"] for row in rows} == {"converged"}
    bounds: dict[str, tuple[float, float]]
    bounds = {"0.1 to 1": (0, 1), "1 to 5": (1, 5), "5 to 10": (5, 10), "10 to 500": (10, 500)}
    bounds["from 500 on, P = 0 at the border"] = (500, 1e9)
    lines = {}
    for name, (low, high) in bounds.items():
        part = [row for row in changed if low <= row["moes_m"] < high]
        points = {(row["moes_m"], row["moes_l"]) for row in part}
        change = [100.0 * abs(1.0 - row["H_c"] / row["H_c_doubled"]) for row in part]
        said = [100.0 * row["H_c_error_domain"] / row["H_c"] for row in part]
        values = max(change), np.median(change), np.median(said)
        lines[name] = " | ".join([str(len(points)), *(f"{value:.2f} %" for value in values)])
    counts = {
        stated: TABLES.shares(rows, name, f"{name}_doubled", stated, 1.0)
        for name in ("H_c", "H_min")
        for stated in (f"{name}_error_domain", f"{name}_error")
    }
    assert {known for _, known in counts.values()} == {len(changed)}
    assert sum(good == len(changed) for good, _ in counts.values()) == 3
    least = counts["H_min_error_domain"][0]
    twice = {
        name: "{} of {}".format(*TABLES.shares(rows, name, f"{name}_limit", f"{name}_error", 2.0))
        for name in ("H_c", "H_min", "P_max", "F")
    }
    return locals()


def borders_by_moes() -> Values:
    """Error of H_c on the domain of the paper, by the border condition."""
    lines: dict[str, list[str]] = {}
    for border in ("zero", "flooded"):
        rows = [{k: float(v or "nan") for k, v in r.items()} for r in read(f"errors/{border}.csv")]
        for point in dict.fromkeys((row["moes_m"], row["moes_l"]) for row in rows):
            here = [row for row in rows if (row["moes_m"], row["moes_l"]) == point]
            small = [row for row in here if (row["x_inlet"], row["y_extent"]) == (-2.5, 2.0)]
            if small:
                wide = max(here, key=lambda row: row["y_extent"])
                change = percent(100.0 * (small[0]["H_c"] / wide["H_c"] - 1.0), 2)
                lines.setdefault("{:g}, {:g}".format(*point), []).append(change)
    return locals()


def ratio_errors() -> Values:
    """How many stated errors of ratios cover the true ones, by grid."""
    make = script("errors/make.py")
    every = make.numbers("rough")
    rows = [row for row in every if row["mu_ratio_error"] is not None]

    def good(points: int = 0) -> str:
        part = [row for row in rows if not points or row["points"] == points]
        result = TABLES.shares(part, "mu_ratio", "mu_ratio_limit", "mu_ratio_error", 2.0)
        return "{} of {}".format(*result)

    within, known = TABLES.shares(rows, "mu_ratio", "mu_ratio_limit", "mu_ratio_error", 2.0)
    assert within >= 0.9 * known
    low = [row for row in rows if row["mu_ratio_limit"] and row["mu_ratio_limit"] <= 5.0]
    within_low, known_low = TABLES.shares(low, "mu_ratio", "mu_ratio_limit", "mu_ratio_error", 2.0)
    cases = {tuple(row[key] for key in make.ROUGH_NAMES) for row in rows if row["mu_ratio_limit"]}
    assert len(cases) >= 40
    whole = {tuple(row[key] for key in make.ROUGH_NAMES) for row in every}
    without = whole - {tuple(row[key] for key in make.ROUGH_NAMES) for row in rows}
    assert all(case[0] < 50.0 or case[1] > 16.0 for case in without)
    return locals()


def ellipse_errors() -> Values:
    """How many stated errors of ellipses cover the true ones, with and without a flooded border."""
    show = script("errors_ellipses/show.py")
    rows = TABLES.numbers_of(show.HERE / "errors.csv")
    assert {row["status"] for row in rows} == {"converged"}
    points = {(row["kappa"], row["moes_m"]) for row in rows}

    def good(limit: str, stated: str, factor: float, border: str = "") -> str:
        part = [row for row in rows if not border or row["border"] == border]
        result = [
            TABLES.shares(part, n, f"{n}_{limit}", f"{n}_{stated}", factor)
            for n in ("H_c", "H_min")
        ]
        assert all(hold >= (0.95 if factor > 1.0 else 0.88) * known for hold, known in result)
        return " | ".join("{} of {}".format(*pair) for pair in result)

    cells = TABLES.numbers_of(show.HERE / "cells.csv")
    quarter, half = (show.over_estimate(cells, ratio) for ratio in (0.25, 0.5))
    spans = [f"{min(result):.1f} to {max(result):.1f}" for result in half]
    return locals()


def best_fields() -> Values:
    """Correlations and slopes of c8s12c, and the second-order part of film and pressure."""
    rows = read("fields/table.csv")
    best = [r for r in rows if r["name"] == "c8s12c" and r["place"][0] != "X"]
    slopes = [[float(r[n]) for r in best] for n in ("p_slope", "film_slope")]
    pressure, film = (
        ", ".join(f"{v:.3f}" for v in part[:2]) + f" and {part[2]:.3f}" for part in slopes
    )
    lines = {
        name: " | ".join(f"{float(r[f'{name}_correlation']):.{digits}f}" for r in best)
        for name, digits in (("p", 4), ("film", 3))
    }
    # first order at the centre; the constant of the prediction is that of the inlet
    centre = [r for r in rows if (r["points"], r["place"]) == ("513", "r < 0.4")]
    assert all(abs(float(r["p_slope"]) - 1.0) <= 0.005 for r in centre)
    assert all(abs(float(r["film_slope"]) - 1.0) <= 0.013 for r in centre)
    assert abs(np.mean([float(r["film_square"]) for r in centre]) + INLET_FILM) <= 0.02
    inner = [
        float(r["film_square"]) for r in rows if r["points"] == "513" and r["place"] == "r < 0.4"
    ]
    return locals()


def residuals() -> Values:
    """Maximum residuals of T, of fitted and of other waves."""
    moving = [row for row in read("response/residuals.csv") if row["moes_m"]]
    centre, every = (max(float(r[n]) for r in moving) for n in ("largest_at_centre", "largest"))
    waves = read("response/waves.csv")
    points = {(r["moes_m"], r["moes_l"]) for r in waves}
    with_ratios = {(r["moes_m"], r["moes_l"], r["velocity_ratio"]) for r in waves}
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        script("response/unfitted.py").main()
    unfitted = [line.split() for line in printed.getvalue().splitlines()[1:]]
    worst = max(float(line[-1]) for line in unfitted)
    slow = max(float(line[-1]) for line in unfitted if abs(float(line[2]) - 1.0) < 0.02)
    return locals()
