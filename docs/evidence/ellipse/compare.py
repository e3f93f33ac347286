# SPDX-License-Identifier: BSD-3-Clause
"""Compare the prediction with the simulated cases on ellipses.

Writes table.csv and ellipse.png beside this file and prints bias, scatter and coverage. With
--predict it only adds missing predictions to predicted.csv, which predates the simulations:

    python docs/evidence/ellipse/compare.py [--predict]
"""

from __future__ import annotations

import csv
import itertools
import sys
from typing import Any

import matplotlib as mpl
import numpy as np

from cases import HERE, case, read, surface
from pyehl.contact.smooth import solve_contact
from pyehl.plots.style import GREY, PAGE, letter, new_figure, save, styled
from pyehl.prediction.friction import run
from pyehl.prediction.model import Model, ModelOptions, model_error
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint

LIMITS = (0.0, 1.5, 2.5)


def prediction(row: dict[str, Any]) -> float:
    """mu_r/mu_s of a row."""
    settings = case(row).resolve()
    operating, oil = OperatingPoint.from_settings(settings), Lubricant.from_settings(settings)
    model = Model.of_one(
        surface(row), solve_contact(settings), operating, oil, ModelOptions(), row["velocity_ratio"]
    )
    return run(model, 0, brief=True).friction.mu_ratio


def _error(run: dict[str, Any]) -> float | None:
    """Error of a simulation; None if the coarse grid has no full film."""
    grid = run["mu_ratio_error_grid"]
    return None if grid is None else round(grid + run["mu_ratio_error_stop"], 4)


def write(name: str, table: list[dict[str, Any]]) -> None:
    """Write a table beside this file."""
    with (HERE / name).open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, table[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(table)


def predict() -> None:
    """Add missing cases to predicted.csv."""
    table = read("predicted.csv")
    there = {row["name"] for row in table}
    for row in read("cases.csv"):
        if row["name"] in there:
            continue
        result = prediction(row)
        table.append(
            {
                "name": row["name"],
                "prediction": round(result, 4),
                "model_error": round(model_error(result, ellipticity=row["ellipticity"]), 4),
            }
        )
        print(*table[-1].values(), flush=True)
    write("predicted.csv", table)


def compare() -> None:
    """Write table.csv and the figure."""
    before = {row["name"]: row for row in read("predicted.csv")}
    simulated = {row["name"]: row for row in read("simulated.csv")}
    table = []
    for row in read("cases.csv"):
        run = simulated.get(row["name"])
        if run is None or run["status"] != "converged":
            continue
        there, now = run["mu_ratio"], prediction(row)
        first = before[row["name"]]["prediction"]
        error = model_error(now, ellipticity=row["ellipticity"])
        table.append(
            {
                "name": row["name"],
                "ellipticity": row["ellipticity"],
                "moes_m": row["moes_m"],
                "moes_l": row["moes_l"],
                "velocity_ratio": row["velocity_ratio"],
                "mu_ratio": there,
                "mu_ratio_error": _error(run),
                "predicted_before": first,
                "deviation_before_percent": round(100.0 * (first / there - 1.0), 2),
                "covered_before": int(abs(first - there) <= before[row["name"]]["model_error"]),
                "prediction": round(now, 4),
                "deviation_percent": round(100.0 * (now / there - 1.0), 2),
                "model_error": round(error, 4),
                "covered": int(abs(now - there) <= error),
            }
        )
        print(*table[-1].values(), flush=True)
    write("table.csv", table)
    report(table)
    draw(table)


def report(table: list[dict[str, Any]]) -> None:
    """Print bias, scatter and coverage for ranges of the ratio."""
    for low, high in itertools.pairwise(LIMITS):
        part = [r for r in table if low < r["mu_ratio"] <= high]
        for name in ("deviation_before_percent", "deviation_percent"):
            d = np.array([r[name] for r in part])
            if d.size:
                print(
                    f"{low} < mu_r/mu_s <= {high}: {d.size} cases, {name} mean {d.mean():.2f}, "
                    f"largest {np.abs(d).max():.2f}"
                )
    for name in ("covered_before", "covered"):
        print(f"{name}: {sum(r[name] for r in table)} of {len(table)}")
    print("\n".join(fine_lines()))


def fine_lines() -> list[str]:
    """Give the table of the cases that were also simulated on 1025 nodes along X."""
    result = [
        "| case | κ | 513 nodes | deviation of the prediction "
        "| 1025 nodes | deviation of the prediction |",
        "|---|---|---|---|---|---|",
    ]
    fine = {row["name"]: row for row in read("fine.csv")}
    for row in read("table.csv"):
        if row["name"] not in fine:
            continue
        run = fine[row["name"]]
        cells = [f"{row['name']} | {row['ellipticity']:g}"]
        for ratio, error in (
            (row["mu_ratio"], row["mu_ratio_error"]),
            (run["mu_ratio"], _error(run)),
        ):
            cells.append(f"{ratio:.4f}" + (f" ± {error:.4f}" if error else ""))
            cells.append(f"{100.0 * (row['prediction'] / ratio - 1.0):+.1f} %".replace("-", "−"))
        result.append(f"| {' | '.join(cells)} |")
    return result


@styled()
def draw(table: list[dict[str, Any]]) -> None:
    """Draw the deviations over the ellipticity."""
    figure = new_figure(PAGE, 3.2)
    axes = figure.subplots(1, 2)
    ratio, error, before, model, kappa = (
        np.array([r[name] for r in table], dtype=float)
        for name in ("mu_ratio", "mu_ratio_error", "predicted_before", "model_error", "ellipticity")
    )
    style = {"fmt": "o", "ecolor": GREY, "elinewidth": 0.8}
    line = np.array([1.0, 2.6])
    axes[0].plot(line, line, color=GREY, linewidth=0.8)
    axes[0].errorbar(ratio, before, xerr=error, yerr=model, **style)
    axes[0].set(
        xlim=line,
        ylim=line,
        xticks=[1.0, 1.5, 2.0, 2.5],
        yticks=[1.0, 1.5, 2.0, 2.5],
        aspect="equal",
        xlabel=r"$\mu_r/\mu_s$ simulated, 513 nodes along $X$",
        ylabel=r"$\mu_r/\mu_s$, original prediction",
    )
    axes[1].axhline(0.0, color=GREY, linewidth=0.8)
    off = before - ratio
    axes[1].errorbar(kappa, off, yerr=error, **style)
    axes[1].set(
        xscale="log",
        xlabel=r"ellipticity $\kappa$: semi-axis across the motion over $a$",
        ylabel="prediction minus simulation",
    )
    ticks = [0.4, 0.6, 1.0, 1.5, 2.0, 3.0, 4.0]
    axes[1].xaxis.set_major_locator(mpl.ticker.FixedLocator(ticks))
    axes[1].xaxis.set_major_formatter(mpl.ticker.FormatStrFormatter("%g"))
    axes[1].xaxis.set_minor_locator(mpl.ticker.NullLocator())
    letter(list(axes))
    save(figure, HERE / "ellipse.png")


if __name__ == "__main__":
    predict() if "--predict" in sys.argv[1:] else compare()
