# SPDX-License-Identifier: BSD-3-Clause
"""Compare the prediction, and the model of the paper, with the simulated cases of cases.csv.

Writes table.csv and prediction.png beside this file and prints bias, scatter and coverage:

    python docs/evidence/prediction/compare.py
"""

from __future__ import annotations

import csv

import matplotlib as mpl
import numpy as np

from cases import HERE, case, rows, surface
from pyehl.contact.smooth import hertz_contact, solve_contact
from pyehl.plots.style import BLUE, COLUMN, VERMILLION, new_figure, save, styled
from pyehl.prediction.friction import run
from pyehl.prediction.model import Model, ModelOptions, model_error
from pyehl.theory.film import central_film
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint


def predictions(row: dict[str, float]) -> tuple[float, float]:
    """mu_r/mu_s of a row by the response, and by the model of the paper."""
    settings = case(row).resolve()
    operating, oil = OperatingPoint.from_settings(settings), Lubricant.from_settings(settings)
    tile = surface(row)
    dry = hertz_contact(central_film(operating, oil) / operating.film_scale, "formula")
    ratios = [
        run(
            Model.of_one(tile, contact, operating, oil, options, row["velocity_ratio"]),
            0,
            brief=True,
        ).friction.mu_ratio
        for contact, options in (
            (solve_contact(settings), ModelOptions()),
            (dry, ModelOptions(reduction="amplitude", smooth="hertz")),
        )
    ]
    return ratios[0], ratios[1]


def main() -> None:
    """Compare all cases whose simulation converged."""
    table = []
    for row in rows():
        if row["status"] != "converged":
            continue
        ours, paper = predictions(row)
        simulated, error = row["mu_ratio"], row["mu_ratio_error"]
        fine = row["mu_ratio_1025"]
        table.append(
            {
                "name": row["name"],
                "moes_m": row["moes_m"],
                "moes_l": row["moes_l"],
                "velocity_ratio": row["velocity_ratio"],
                "mu_ratio": simulated,
                "mu_ratio_error": error,
                "prediction": round(ours, 4),
                "deviation_percent": round(100.0 * (ours / simulated - 1.0), 2),
                "model_error": round(model_error(ours), 4),
                "covered": int(abs(ours - (fine or simulated)) <= model_error(ours)),
                "drawn": int(row["name"].startswith("n")),
                "mu_ratio_1025": fine or "",
                "mu_ratio_error_1025": row["mu_ratio_error_1025"] or "",
                "deviation_1025_percent": fine and round(100.0 * (ours / fine - 1.0), 2),
                "paper": round(paper, 4),
                "paper_deviation_percent": round(100.0 * (paper / simulated - 1.0), 2),
            }
        )
        print(*table[-1].values(), flush=True)
    with (HERE / "table.csv").open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, table[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(table)
    report(table)
    draw(table)


def report(table: list[dict[str, float]]) -> None:
    """Print bias, scatter and coverage for ranges of the ratio."""
    for low, high in ((0.0, 1.3), (1.3, 1.6), (1.6, 2.5), (2.5, 9.9)):
        part = [r for r in table if low < r["mu_ratio"] <= high]
        for name in ("deviation_percent", "paper_deviation_percent"):
            d = np.array([r[name] for r in part])
            print(
                f"{low} < mu_r/mu_s <= {high}: {len(part)} cases, {name} mean {d.mean():.2f}, "
                f"rms {np.sqrt((d**2).mean()):.2f}, largest {np.abs(d).max():.2f}"
            )
    fine = [r for r in table if r["mu_ratio_1025"]]
    for name in ("deviation_percent", "deviation_1025_percent"):
        d = np.array([r[name] for r in fine])
        print(
            f"simulated on 1025 x 1025 nodes too: {len(fine)} cases, {name} mean {d.mean():.2f}, "
            f"rms {np.sqrt((d**2).mean()):.2f}, largest {np.abs(d).max():.2f}"
        )
    for drawn, words in ((0, "which chose the stated error"), (1, "drawn afterwards")):
        known = [r for r in table if r["drawn"] == drawn and np.isfinite(r["model_error"])]
        covered = sum(r["covered"] for r in known)
        print(f"cases {words}: {covered} of {len(known)} covered by it")


@styled()
def draw(table: list[dict[str, float]]) -> None:
    """Draw prediction and model of the paper against the simulation."""
    figure = new_figure(COLUMN, COLUMN)
    ax = figure.subplots()
    x = np.array([r["mu_ratio_1025"] or r["mu_ratio"] for r in table])
    errors = [
        r["mu_ratio_error_1025"] if r["mu_ratio_1025"] else r["mu_ratio_error"] for r in table
    ]
    error = np.array([float(v or np.nan) for v in errors])
    ours = np.array([r["prediction"] for r in table])
    paper = np.array([r["paper"] for r in table])
    line = np.array([0.85, 6.0])
    ax.plot(line, line, color="0.6", linewidth=1, zorder=0)
    ax.errorbar(x, ours, xerr=error, fmt="o", color=BLUE, lw=0.8, label="prediction")
    rolling = np.array([float(r["velocity_ratio"]) == 1.0 for r in table])
    for part, face, words in ((rolling, VERMILLION, "rolling"), (~rolling, "none", "slip")):
        ax.plot(
            x[part], paper[part], "s", color=VERMILLION, markerfacecolor=face,
            label=f"model of the paper, {words}",
        )  # fmt: skip
    ax.set(
        xscale="log",
        yscale="log",
        xlim=line,
        ylim=line,
        xlabel=r"$\mu_r/\mu_s$ by full simulation",
        ylabel=r"$\mu_r/\mu_s$ predicted",
    )
    ticks = [0.9, 1.0, 1.2, 1.5, 2.0, 3.0, 5.0]
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_major_locator(mpl.ticker.FixedLocator(ticks))
        axis.set_major_formatter(mpl.ticker.FormatStrFormatter("%g"))
        axis.set_minor_locator(mpl.ticker.NullLocator())
    ax.legend(frameon=False, loc="upper left")
    save(figure, HERE / "prediction.png")


if __name__ == "__main__":
    main()
