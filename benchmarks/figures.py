# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of `stress.py` and `workprec.py`."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from pyehl.plots import style
from pyehl.types import Array, Values

# Outcome: marker, colour (Okabe & Ito) and what is written in the key
OUTCOMES = {
    "converged": ("o", style.GREEN, "converged"),
    "ended": (".", "0.45", "all steps asked for converged"),
    "no solution": ("v", style.GREY, "the equations have no solution"),
    "negative film": ("s", style.BLUE, "negative film"),
    "cycle limit": ("x", style.VERMILLION, "cycle limit"),
    "diverged": ("P", "#CC79A7", "diverged"),
    "other": ("*", "#E69F00", "other"),
}

COLOURS = ["#0072B2", "#E69F00", "#009E73", "#CC79A7", "#56B4E9", "#D55E00", "#000000"]
EXTRAPOLATED = ", extrapolated"


def _kind(row: Values) -> str:
    if row.get("second") == "no solution":
        return "no solution"
    outcome = str(row["outcome"])
    if outcome.startswith("ended"):
        return "ended"
    return outcome if outcome in OUTCOMES else "other"


@style.styled()
def draw_outcomes(rows: Sequence[Values], path: Path) -> None:
    """Draw outcomes of a stress campaign over M and L: smooth contacts, and rough ones by grid."""
    grids = sorted({row["values"]["grid.points"] for row in rows})
    panels: list[tuple[str, list[Values]]] = [
        ("smooth, all grids", [row for row in rows if row["family"] == "smooth"])
    ]
    panels += [
        (
            f"rough, {n} × {n} nodes",
            [r for r in rows if r["family"] != "smooth" and r["values"]["grid.points"] == n],
        )
        for n in grids
    ]
    lines = -(-len(panels) // 2)
    figure = style.new_figure(style.PAGE, 1.9 * lines + 0.6)
    axes = figure.subplots(lines, 2, sharex=True, sharey=True, squeeze=False)
    for ax, (words, mine) in zip(axes.flat, panels, strict=False):
        for name, (marker, colour, text) in OUTCOMES.items():
            places = [(r["moes_m"], r["moes_l"]) for r in mine if _kind(r) == name]
            at: Array = np.array(places, dtype=float).reshape(-1, 2)
            ax.semilogx(at[:, 0], at[:, 1], marker, color=colour, label=text, linestyle="none")
        ax.text(0.02, 1.02, words, transform=ax.transAxes)
    for ax in axes[-1]:
        ax.set(xlabel="M")
        ax.xaxis.set_major_formatter(style.POWERS)
    for ax in axes[:, 0]:
        ax.set_ylabel("L")
    for ax in axes.flat[len(panels) :]:
        ax.set_axis_off()
    handles, labels = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=4)
    style.save(figure, path, command="bench")


@style.styled()
def draw_work(rows: Sequence[Values], path: Path) -> None:
    """Draw error over processor seconds, a panel for each problem and quantity."""
    problems = list(dict.fromkeys((row["problem"], row["quantity"]) for row in rows))
    settings = list(dict.fromkeys(row["setting"] for row in rows))
    # extrapolated values have the colour of their setting, and open markers
    bases = list(dict.fromkeys(name.removesuffix(EXTRAPOLATED) for name in settings))
    colours = dict(zip(bases, COLOURS * len(bases), strict=False))
    markers = dict(zip(bases, "os^vD<>pP" * len(bases), strict=False)) | {"prediction": "*"}
    lines = -(-len(problems) // 2)
    figure = style.new_figure(style.PAGE, 2.2 * lines + 0.8)
    axes = figure.subplots(lines, 2, squeeze=False)
    for ax, (problem, quantity) in zip(axes.flat, problems, strict=False):
        mine = [row for row in rows if (row["problem"], row["quantity"]) == (problem, quantity)]
        for setting in settings:
            line = [
                (row["seconds"], row["error"])
                for row in mine
                # the reference itself has no error
                if row["setting"] == setting and row["error"] and row["threads"] == 1
            ]
            at: Array = np.array(line, dtype=float).reshape(-1, 2)
            base = setting.removesuffix(EXTRAPOLATED)
            ax.loglog(
                at[:, 0],
                at[:, 1],
                marker=markers[base],
                color=colours[base],
                linestyle="--" if setting != base else "-",
                markerfacecolor="none" if setting != base else colours[base],
                lw=0.8,
                label=setting,
            )
        bars = [row["bar"] for row in mine if row["bar"]]
        if bars:
            lowest = 0.5 * min(bars[0], *(row["error"] for row in mine if row["error"]))
            ax.axhspan(lowest, bars[0], color="0.9", zorder=0)
            ax.set_ylim(bottom=lowest)
        ax.text(0.98, 0.96, f"{problem}: {quantity}", transform=ax.transAxes, ha="right", va="top")
        for axis in (ax.xaxis, ax.yaxis):
            axis.set_major_formatter(style.POWERS)
    for ax in axes[-1]:
        ax.set_xlabel("processor time [s]")
    for ax in axes[:, 0]:
        ax.set_ylabel("relative error")
    for ax in axes.flat[len(problems) :]:
        ax.set_axis_off()
    handles, labels = axes.flat[len(problems) - 1].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=3)
    style.save(figure, path, command="bench")
