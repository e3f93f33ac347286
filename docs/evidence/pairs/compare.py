# SPDX-License-Identifier: BSD-3-Clause
"""Compare earlier predictions with the later simulations of the same pairs.

Writes table.csv and pairs.png beside this file and prints deviations and coverage:

    python docs/evidence/pairs/compare.py
"""

from __future__ import annotations

import csv
from typing import Any

import matplotlib as mpl
import numpy as np

import pyehl
from cases import HERE, case, rows, surfaces
from pyehl.plots.style import COLUMN, new_figure, save, styled
from pyehl.theory.operating import OperatingPoint

PARTS = ("grid", "stop", "window", "left_out")


def read(name: str) -> dict[str, dict[str, str]]:
    """Read a table by the names of its rows."""
    with (HERE / name).open(encoding="utf-8") as stream:
        return {row["name"]: row for row in csv.DictReader(stream)}


def compared() -> list[dict[str, Any]]:
    """Merge the rows of all pairs whose simulation converged."""
    before, simulated = read("predicted.csv"), read("simulated.csv")
    table = []
    for row in rows():
        result = simulated.get(row["name"])
        if result is None or result["status"] != "converged":
            continue
        ratio = float(result["mu_ratio"])
        error = sum(float(result[f"mu_ratio_error_{part}"] or 0.0) for part in PARTS)
        first, stated = (float(before[row["name"]][k]) for k in ("mu_ratio", "model_error"))
        now = pyehl.predict(case(row), **surfaces(row), tracks=1).mu_ratio
        operating = OperatingPoint.from_settings(case(row).resolve())
        table.append(
            {
                "name": row["name"],
                "moes_m": round(operating.moes_m, 1),
                "moes_l": round(operating.moes_l, 2),
                "slide_to_roll": row["slide_to_roll"],
                "first": row["first"],
                "second": row["second"],
                "points": result["points"],
                "mu_ratio": round(ratio, 5),
                "mu_ratio_error": round(error, 5),
                "predicted": first,
                "deviation_percent": round(100.0 * (first / ratio - 1.0), 2),
                "model_error": round(stated, 4),
                "covered": int(abs(first - ratio) <= stated),
                "prediction_now": round(now, 5),
            }
        )
        print(*table[-1].values(), flush=True)
    return table


def report(table: list[dict[str, Any]]) -> None:
    """Print deviations and coverage for ranges of the ratio."""
    for low, high in ((0.0, 1.5), (1.5, 2.5)):
        part = [row for row in table if low < row["mu_ratio"] <= high]
        if part:
            d = np.array([row["deviation_percent"] for row in part])
            print(
                f"{low} < mu_r/mu_s <= {high}: {len(part)} pairs, deviation mean {d.mean():.2f} %, "
                f"rms {np.sqrt((d**2).mean()):.2f} %, largest {np.abs(d).max():.2f} %"
            )
    print(f"covered by the stated error: {sum(row['covered'] for row in table)} of {len(table)}")


@styled()
def draw(table: list[dict[str, Any]]) -> None:
    """Draw the predictions against the simulations."""
    figure = new_figure(COLUMN, COLUMN)
    ax = figure.subplots()
    line = np.array([0.95, 2.6])
    ax.plot(line, line, color="0.6", linewidth=1, zorder=0)
    for kinds, marker in (("fractal", "o"), ("wave", "s"), ("worn", "^")):
        part = [
            row
            for row in table
            if kinds in (row["first"], row["second"])
            and (kinds != "fractal" or row["first"] == row["second"])
        ]
        ax.errorbar(
            [row["mu_ratio"] for row in part],
            [row["predicted"] for row in part],
            xerr=[row["mu_ratio_error"] for row in part],
            yerr=[row["model_error"] for row in part],
            fmt=marker,
            markersize=3,
            linewidth=1,
            label=f"fractal and {kinds}",
        )
    ax.set(
        xscale="log",
        yscale="log",
        xlim=line,
        ylim=line,
        xlabel=r"$\mu_r/\mu_s$ by full simulation",
        ylabel=r"$\mu_r/\mu_s$, original prediction",
    )
    ticks = [1.0, 1.2, 1.5, 2.0, 2.5]
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_major_locator(mpl.ticker.FixedLocator(ticks))
        axis.set_major_formatter(mpl.ticker.FormatStrFormatter("%g"))
        axis.set_minor_locator(mpl.ticker.NullLocator())
    ax.legend(frameon=False, loc="upper left")
    save(figure, HERE / "pairs.png")


def main() -> None:
    """Compare, print and draw."""
    table = compared()
    with (HERE / "table.csv").open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, table[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(table)
    report(table)
    draw(table)


if __name__ == "__main__":
    main()
