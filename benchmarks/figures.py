# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of `stress.py` and `workprec.py`."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from pyehl.plots import style
from pyehl.types import Array, Values

# Outcome: marker, colour (Okabe & Ito) and entry in the legend
OUTCOMES = {
    "converged": ("o", style.GREEN, "converged"),
    "ended": (".", "0.45", "all steps done, mean not settled"),
    "no solution": ("v", style.GREY, "no solution"),
    "negative film": ("s", style.BLUE, "negative film"),
    "cycle limit": ("x", style.VERMILLION, "cycle limit"),
    "diverged": ("P", style.PURPLE, "diverged"),
    "other": ("*", style.ORANGE, "other"),
}

# Settings in the picture, with label, colour and marker; the others, whose lines would cover that
# of the default, are only in the table
SETTINGS = {
    "default": ("default", style.BLUE, "o"),
    "fft": ("deflection by FFT", style.ORANGE, "s"),
    "paper": ("scheme of the paper", style.GREEN, "^"),
    "prediction": ("prediction", style.VERMILLION, "D"),
}
PROBLEMS = {
    "smooth": "smooth contact",
    "wave": "wave of Fig. 2",
    "fractal": "surface of Table 1",
    "resolved fractal": "the same without wavelengths below a/8",
}
SYMBOLS = {"H_c": "$H_c$", "H_min": r"$H_\mathrm{min}$", "F": "$F$", "mu_ratio": r"$\mu_r/\mu_s$"}
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
    """Draw outcomes of a stress campaign over M and L: smooth contacts, then rough ones by grid."""
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
            if places:
                ax.semilogx(at[:, 0], at[:, 1], marker, color=colour, label=text, linestyle="none")
        ax.set_title(words, loc="left")
    for ax in axes[-1]:
        ax.set(xlabel="$M$")
        ax.xaxis.set_major_formatter(style.POWERS)
    for ax in axes[:, 0]:
        ax.set_ylabel("$L$")
    for ax in axes.flat[len(panels) :]:
        ax.set_axis_off()
    _legend(figure, axes, 3)
    style.save(figure, path, command="bench")


def _legend(figure: Figure, axes: NDArray[Any], columns: int) -> None:
    """Draw one legend below all panels, with each entry once."""
    pairs = [zip(*ax.get_legend_handles_labels(), strict=True) for ax in axes.flat]
    known = {label: handle for part in pairs for handle, label in part}
    figure.legend(known.values(), known.keys(), loc="outside lower center", ncols=columns)


@style.styled()
def draw_work(rows: Sequence[Values], path: Path) -> None:
    """Draw error over processor seconds, a panel for each problem and quantity.

    Extrapolated values have the colour of their setting, and open markers.
    """
    problems = list(dict.fromkeys((row["problem"], row["quantity"]) for row in rows))
    lines = -(-len(problems) // 2)
    figure = style.new_figure(style.PAGE, 2.2 * lines + 0.6)
    axes = figure.subplots(lines, 2, squeeze=False)
    for ax, (problem, quantity) in zip(axes.flat, problems, strict=False):
        mine = [row for row in rows if (row["problem"], row["quantity"]) == (problem, quantity)]
        for setting, (name, colour, marker) in SETTINGS.items():
            # the deflection dominates the time of a smooth contact, not of a time step
            if setting == "fft" and problem != "smooth":
                continue
            for more, line, face in (("", "-", colour), (EXTRAPOLATED, "--", "none")):
                result = [
                    (row["seconds"], row["error"])
                    for row in mine
                    # the reference itself has no error
                    if row["setting"] == setting + more and row["error"] and row["threads"] == 1
                ]
                if result:
                    options = {
                        "ls": line,
                        "mfc": face,
                        "color": colour,
                        "marker": marker,
                        "lw": 0.8,
                    }
                    ax.loglog(*zip(*result, strict=True), label=name + more, **options)
        bars = [row["bar"] for row in mine if row["bar"]]
        if bars:
            lowest = 0.5 * min(bars[0], *(row["error"] for row in mine if row["error"]))
            ax.axhspan(lowest, bars[0], color="0.9", zorder=0)
            ax.set_ylim(bottom=lowest)
        words = PROBLEMS.get(problem, problem)
        ax.set_title(f"{words}: {SYMBOLS.get(quantity, quantity)}", loc="left")
        for axis in (ax.xaxis, ax.yaxis):
            axis.set_major_formatter(style.POWERS)
    for ax in axes[-1]:
        ax.set_xlabel("processor time [s]")
    for ax in axes[:, 0]:
        ax.set_ylabel("relative error")
    for ax in axes.flat[len(problems) :]:
        ax.set_axis_off()
    _legend(figure, axes, 3)
    style.save(figure, path, command="bench")
