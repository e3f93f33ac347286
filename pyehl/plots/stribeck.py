# SPDX-License-Identifier: BSD-3-Clause
"""The picture of Stribeck curves: friction over Hersey number, Lambda and theta_2 side by side."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from textwrap import wrap
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pyehl.plots import style
from pyehl.plots.stribeck_contact import draw_contact
from pyehl.theory import stribeck
from pyehl.types import Array

ABSCISSAE = {
    "hersey": r"Hersey number $\eta_0 \bar u R/w$",
    "lambda_ratio": r"$\Lambda = h_\mathrm{min}/\sigma$",
    "theta_2": r"$\theta_2$",
}
COLOURS = (style.BLUE, style.VERMILLION, style.GREEN, "#CC79A7", "#E69F00", "#56B4E9")


@dataclass(frozen=True, slots=True)
class Points:
    """Friction at some places: places by abscissa, values and errors, all (n,)."""

    places: Mapping[str, Array]
    friction: Array
    error: Array

    def draw(self, ax: Axes, abscissa: str) -> None:
        """Draw them as measured ones, with bars where an error is known."""
        how = {"fmt": "k^", "ms": 4, "mfc": "none", "capsize": 2, "lw": 0.8, "label": "measured"}
        style.points(ax, self.places[abscissa], self.friction, self.error, **how)


@dataclass(frozen=True, slots=True)
class Curve:
    """One curve; a number of its table that does not exist is NaN."""

    label: str  # its name in the legend; '' for the only one
    rows: Sequence[Mapping[str, Any]]  # of its table
    ends: str  # where full film ends, in words
    broken: tuple[int, ...]  # rows where the film breaks down
    absolute: bool  # whether friction is a coefficient, else a ratio

    def column(self, name: str) -> Array:
        """Give a column (n,)."""
        return np.array([np.nan if r[name] is None else r[name] for r in self.rows], dtype=float)

    def friction(self, name: str = "mu_ratio") -> Array:
        """Give a column of ratios (n,), as coefficients where these are drawn."""
        if not self.absolute:
            return self.column(name)
        smooth = self.column("mu_smooth")
        if name.startswith("mu_ratio_ehl"):
            return self.column(name) * smooth
        # where bodies touch a prediction has a smooth contact of its own
        own = self.column("mu") / self.column("mu_ratio")
        return self.column(name) * np.where(np.isfinite(own), own, smooth)


def draw_stribeck(
    curves: Sequence[Curve], surface: str, measured: Points | None = None, law: str = ""
) -> Figure:
    """Draw friction over all abscissae, a coefficient or a ratio mu_r/mu_s.

    `surface` says what the surface is in a few words; measured friction is laid over, and over
    theta_2 the curve of Zhang et al. 2019; `law` says what an empirical curve is.
    """
    absolute = curves[0].absolute
    # smooth surfaces have neither Lambda nor theta_2
    shown = {
        name: label
        for name, label in ABSCISSAE.items()
        if any(np.isfinite(curve.column(name)).any() for curve in curves)
    }
    touching = [c for c in curves if "contact_load_share" in c.rows[0]]
    figure = style.new_figure(11.5 if len(shown) > 1 else 7.0, 7.4 if touching else 4.4)
    panels = figure.subplots(
        3 if touching else 1, len(shown), sharex="col", sharey="row", squeeze=False
    )
    axes = panels[0]
    if touching:
        draw_contact(panels[1:], list(shown), list(zip(curves, COLOURS * 9, strict=False)))
    for ax, (name, label) in zip(axes, shown.items(), strict=True):
        for curve, colour in zip(curves, COLOURS * 9, strict=False):
            _draw_curve(ax, curve, name, colour)
        _shade(ax, curves, name)
        if measured is not None:
            measured.draw(ax, name)
        if name == "theta_2" and not absolute:
            _draw_eq_16(ax)
        ax.set_xscale("log")
        style.label_log_ticks(ax)
        panels[-1, list(axes).index(ax)].set_xlabel(label)
        ax.grid(visible=True, which="major", color="0.92", lw=0.6)
        ax.set_axisbelow(True)
    axes[0].set_ylabel(r"$\mu$" if absolute else r"$\mu_r/\mu_s$")
    style.letter(axes)
    # the last panel has all that the others have
    handles, labels = axes[-1].get_legend_handles_labels()
    unique = dict(zip(labels, handles, strict=True))
    figure.legend(
        unique.values(), unique.keys(), loc="outside lower center", ncols=5, fontsize="small"
    )
    words = "; ".join(f"{c.label + ': ' if c.label else ''}{c.ends}" for c in curves if c.ends)
    figure.suptitle("\n".join((surface, words, *wrap(law, 100))), fontsize="medium")
    return figure


def _draw_curve(ax: Axes, curve: Curve, name: str, colour: str) -> None:
    x, y = curve.column(name), curve.friction()
    known = np.isfinite(x) & np.isfinite(y)
    tail = f" ({curve.label})" if curve.label else ""
    ax.plot(x[known], y[known], "o-", ms=3, lw=1.2, color=colour, label=f"prediction{tail}")
    for width, alpha, label in (
        (curve.friction("mu_ratio_spread"), 0.15, "spread over the surfaces"),
        (curve.friction("mu_ratio_model_error"), 0.35, "error of the model"),
    ):
        style.band(ax, x, y, width, color=colour, alpha=alpha, label=label)
    if curve.absolute and "mu_empirical" in curve.rows[0]:
        empirical = curve.column("mu_empirical")
        there = np.isfinite(x) & np.isfinite(empirical)
        ax.plot(x[there], empirical[there], "--", lw=1.2, color=colour, label=f"empirical{tail}")
    full = curve.friction("mu_ratio_ehl")
    if np.isfinite(full).any():
        how = {"fmt": "s", "ms": 5, "mfc": "white", "color": colour, "capsize": 3}
        error = curve.friction("mu_ratio_ehl_error")
        style.points(ax, x, full, error, label=f"full simulation{tail}", **how)


def _shade(ax: Axes, curves: Sequence[Curve], name: str) -> None:
    """Shade where the film breaks down: up to half-way to the first point of full film."""
    for curve in curves:
        x = curve.column(name)
        ends = np.isin(np.arange(x.size), curve.broken)
        broken = ends & np.isfinite(x)
        if not broken.any():
            continue
        low, high = float(x[broken].min()), float(x[broken].max())
        others = x[~ends & np.isfinite(x) & np.isfinite(curve.friction())]
        above = others[others > high]
        if above.size:
            high = float(np.sqrt(high * above.min()))
        below = others[others < low]
        low = float(np.sqrt(low * below.max())) if below.size else min(low, ax.get_xlim()[0])
        ax.axvspan(low, high, color=style.GREY, alpha=0.2, lw=0, label="no full film")


def _draw_eq_16(ax: Axes) -> None:
    low, high = ax.get_xlim()
    theta = np.geomspace(max(low, 0.3), max(high, 0.6), 100)
    bottom, top = ax.get_ylim()
    ratio = stribeck.relative_friction(theta)
    shown = ratio < top
    ax.plot(theta[shown], ratio[shown], "--", lw=1, color="black", label="harmonic waves (eq. 16)")
    ax.set(xlim=(low, high), ylim=(min(bottom, float(ratio.min()) - 0.02), top))
