# SPDX-License-Identifier: BSD-3-Clause
"""Figures 2 to 4 of Zhang et al. 2019: friction of waves, with the numbers of the paper over it."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from pyehl.plots.style import BLUE, GREY, VERMILLION, new_figure
from pyehl.types import Array

COLOURS = (BLUE, VERMILLION, "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "black")
MARKERS = "osD^vP*"


def wave_history(runs: Sequence[tuple[str, Array, Array]], mean: float) -> Figure:
    """Draw mu_r/mu_s over time (Fig. 2), with the mean that the paper prints.

    `runs`: label, times (n,) [a/u] and mu_r/mu_s (n,) of each.
    """
    figure = new_figure(6.4, 3.8)
    ax = figure.subplots()
    for (label, time, ratio), colour in zip(runs, COLOURS, strict=False):
        ax.plot(time, ratio, color=colour, lw=1.2, label=label)
    ax.axhline(mean, color="black", lw=1.0, ls="--", label=f"paper: mean {mean:g}")
    ax.axhline(1.0, color=GREY, lw=0.8, ls=":")
    ax.set_xlabel("$T = t\\,u/a$")
    ax.set_ylabel(r"$\mu_r/\mu_s$")
    ax.legend(fontsize="small", loc="lower right")
    return figure


@dataclass(frozen=True, slots=True)
class Series:
    """One curve: M, L, wavelength [a]; abscissa and mu_r/mu_s (n,)."""

    moes_m: float
    moes_l: float
    wavelength: float
    place: Array
    friction: Array

    @property
    def label(self) -> str:
        """M, L and wavelength."""
        return f"{self.moes_m:g}, {self.moes_l:g}, {self.wavelength:g}"


def friction_over_film(panels: Sequence[tuple[str, Sequence[Series]]]) -> Figure:
    """Draw mu_r/mu_s over H_c/A_i, a panel for each scheme (Fig. 3)."""
    figure = new_figure(5.2 * len(panels), 4.6)
    axes = np.atleast_1d(figure.subplots(1, len(panels), sharey=True))
    for mark, ax, (title, series) in zip("abcd", axes, panels, strict=False):
        _points(ax, series, lines=True)
        ax.set_xlabel("$H_c/A_i$")
        ax.set_title(f"({mark}) {title}", fontsize="medium", loc="left")
        _logarithmic(ax)
    axes[0].set_ylabel(r"$\mu_r/\mu_s$")
    axes[-1].legend(fontsize="x-small", title="$M$, $L$, $\\lambda/a$", ncols=2)
    return figure


def _points(ax: Axes, series: Sequence[Series], *, lines: bool) -> None:
    for k, s in enumerate(series):
        colour, marker = COLOURS[k % len(COLOURS)], MARKERS[(k // len(COLOURS) * 3 + k) % 7]
        style = f"{marker}-" if lines else marker
        ax.plot(s.place, s.friction, style, ms=4, lw=0.9, color=colour, mfc="none", label=s.label)


def _logarithmic(ax: Axes) -> None:
    ax.set(xscale="log", yscale="log")
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    left, right = ax.get_xlim()
    if right < 200.0 * left:
        ax.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    ax.xaxis.set_minor_formatter(NullFormatter())
    low, high = ax.get_ylim()
    if high < 20.0 * low:
        ticks = [t for t in (1.0, 1.2, 1.5, 2.0, 3.0, 5.0, 10.0) if low <= t <= high]
        ax.set_yticks(ticks)
        ax.yaxis.set_minor_formatter(NullFormatter())
    ax.grid(visible=True, which="major", color="0.92", lw=0.6)
    ax.set_axisbelow(True)


@dataclass(frozen=True, slots=True)
class Collapse:
    """One panel of Fig. 4."""

    title: str
    abscissa: str
    series: Sequence[Series]
    # Label, format, abscissa (m,) and mu_r/mu_s (m,) of lines through them
    curves: Sequence[tuple[str, str, Array, Array]]


def collapses(panels: Sequence[Collapse]) -> Figure:
    """Draw mu_r/mu_s over parameters that may bring all waves on one curve (Fig. 4)."""
    rows = -(-len(panels) // 2)
    figure = new_figure(10.0, 4.0 * rows)
    axes = np.atleast_1d(figure.subplots(rows, 2, sharey=True)).ravel()
    for mark, ax, panel in zip("abcdef", axes, panels, strict=False):
        _points(ax, panel.series, lines=False)
        for label, style, place, friction in panel.curves:
            ax.plot(place, friction, style, lw=1.3, color="black", label=label, zorder=3)
        ax.set_title(f"({mark}) {panel.title}", fontsize="medium", loc="left")
        ax.set(xlabel=panel.abscissa, ylabel=r"$\mu_r/\mu_s$")
        _logarithmic(ax)
        handles, labels = ax.get_legend_handles_labels()
        count = len(panel.curves)
        if count:
            ax.legend(handles[-count:], labels[-count:], fontsize="x-small", loc="upper right")
    handles, labels = axes[0].get_legend_handles_labels()
    count = len(panels[0].curves)
    figure.legend(
        handles[: len(handles) - count],
        labels[: len(labels) - count],
        loc="outside lower center",
        ncols=7,
        fontsize="x-small",
        title="$M$, $L$, $\\lambda/a$",
    )
    return figure
