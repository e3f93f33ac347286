# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of `stress.py` and `workprec.py`."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from pyehl.plots import style
from pyehl.types import Array, Values

# On a screen, as in the documents
DPI = 110

# Outcome: marker and what is written in the key
OUTCOMES = {
    "converged": ("o", style.GREEN, "converged"),
    "ended": (".", "olive", "all steps asked for converged"),
    "no solution": ("v", style.GREY, "the equations have no solution"),
    "negative film": ("s", style.BLUE, "negative film"),
    "cycle limit": ("x", style.VERMILLION, "cycle limit"),
    "diverged": ("P", "purple", "diverged"),
    "other": ("*", "orange", "other"),
}


def _kind(row: Values) -> str:
    if row.get("second") == "no solution":
        return "no solution"
    outcome = str(row["outcome"])
    if outcome.startswith("ended"):
        return "ended"
    return outcome if outcome in OUTCOMES else "other"


def draw_outcomes(rows: Sequence[Values], path: Path) -> None:
    """Draw outcomes of a stress campaign over M and L: smooth contacts, and rough ones by grid."""
    grids = sorted({row["values"]["grid.points"] for row in rows})
    panels: list[tuple[str, list[Values]]] = [
        ("smooth, all grids", [row for row in rows if row["family"] == "smooth"])
    ]
    panels += [
        (
            f"rough, {n} x {n} nodes",
            [r for r in rows if r["family"] != "smooth" and r["values"]["grid.points"] == n],
        )
        for n in grids
    ]
    figure = style.new_figure(3.0 * len(panels), 3.4)
    axes = figure.subplots(1, len(panels), sharey=True, squeeze=False)[0]
    for ax, (title, mine) in zip(axes, panels, strict=True):
        for name, (marker, colour, text) in OUTCOMES.items():
            places = [(r["moes_m"], r["moes_l"]) for r in mine if _kind(r) == name]
            at: Array = np.array(places, dtype=float).reshape(-1, 2)
            ax.semilogx(
                at[:, 0], at[:, 1], marker, color=colour, ms=4, label=text, linestyle="none"
            )
        ax.set(title=title, xlabel="M")
    axes[0].set_ylabel("L")
    handles, labels = axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=4)
    style.save(figure, path, DPI, "bench")


def draw_work(rows: Sequence[Values], path: Path) -> None:
    """Draw error over processor seconds, a panel for each problem and quantity."""
    problems = list(dict.fromkeys((row["problem"], row["quantity"]) for row in rows))
    settings = list(dict.fromkeys(row["setting"] for row in rows))
    figure = style.new_figure(3.0 * len(problems), 3.6)
    axes = figure.subplots(1, len(problems), squeeze=False)[0]
    for ax, (problem, quantity) in zip(axes, problems, strict=True):
        mine = [row for row in rows if (row["problem"], row["quantity"]) == (problem, quantity)]
        for number, setting in enumerate(settings):
            line = [
                (row["seconds"], row["error"])
                for row in mine
                # the reference itself has no error
                if row["setting"] == setting and row["error"] and row["threads"] == 1
            ]
            at: Array = np.array(line, dtype=float).reshape(-1, 2)
            marker = "*" if setting == "prediction" else "os^vD<>pP"[number % 9]
            ax.loglog(at[:, 0], at[:, 1], marker=marker, ms=4, lw=0.8, label=setting)
        bars = [row["bar"] for row in mine if row["bar"]]
        if bars:
            lowest = 0.5 * min(bars[0], *(row["error"] for row in mine if row["error"]))
            ax.axhspan(lowest, bars[0], color="0.9", zorder=0)
            ax.set_ylim(bottom=lowest)
        ax.set(title=f"{problem}: {quantity}", xlabel="processor seconds")
    axes[0].set_ylabel("relative error")
    handles, labels = axes[-1].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=4)
    style.save(figure, path, DPI, "bench")
