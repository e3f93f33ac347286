# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of Stribeck curves and of traction curves.

Friction over Hersey number, Lambda and theta_2 side by side, below it contact at a boundary film;
friction and temperature over the slide-to-roll ratio.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from textwrap import wrap
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from pyehl.plots import style
from pyehl.theory import stribeck
from pyehl.theory.transition import Curve
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
    # none of two surfaces without full simulations
    shares = ("contact_load_share", "contact_load_share_ehl")
    contact = any(_known(curve, name) for curve in curves for name in shares)
    # none with solid contact whose friction is not known
    friction = not contact or any(_has_friction(curve) for curve in curves)
    rows = friction + 2 * contact
    figure = style.new_figure(11.5 if len(shown) > 1 else 7.0, 2.9 + 1.5 * rows)
    panels = figure.subplots(rows, len(shown), sharex="col", sharey="row", squeeze=False)
    axes = panels[0]
    if contact:
        draw_contact(panels[friction:], list(shown), list(zip(curves, COLOURS * 9, strict=False)))
    for ax, (name, label) in zip(axes, shown.items(), strict=True):
        for curve, colour in zip(curves if friction else [], COLOURS * 9, strict=False):
            _draw_curve(ax, curve, name, colour)
        _shade(ax, curves, name)
        if measured is not None:
            measured.draw(ax, name)
        if name == "theta_2" and friction and not absolute:
            _draw_eq_16(ax)
        ax.set_xscale("log")
        style.label_log_ticks(ax.xaxis)
        panels[-1, list(axes).index(ax)].set_xlabel(label)
        ax.grid(visible=True, which="major", color="0.92", lw=0.6)
        ax.set_axisbelow(True)
    if friction:
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


def _known(curve: Curve, name: str) -> bool:
    """Whether a curve has a column with a number in it."""
    return name in curve.table and bool(curve.table[name].notna().any())


def _has_friction(curve: Curve) -> bool:
    empirical = curve.absolute and _known(curve, "mu_empirical")
    return empirical or _known(curve, "mu_ratio") or _known(curve, "mu_ratio_ehl")


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
    if curve.absolute and "mu_empirical" in curve.table:
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


def draw_contact(
    panels: NDArray[Any], abscissae: Sequence[str], curves: Sequence[tuple[Curve, str]]
) -> None:
    """Draw shares of load and area on the first row of panels (2, n), minimum film on the second.

    Lines are predictions, squares and diamonds full simulations.
    """
    for (share, film), name in zip(panels.T, abscissae, strict=True):
        for curve, colour in curves:
            x = curve.column(name)
            _band(share, x, curve, "contact_load_share", colour)
            share.plot(x, curve.column("contact_area_share"), "--", lw=1, color=colour)
            _points(share, x, curve, "contact_load_share_ehl", colour)
            _points(share, x, curve, "contact_area_share_ehl", colour, marker="D")
            _band(film, x, curve, "h_min_rough_m", colour, 1e9)
            _points(film, x, curve, "h_min_rough_ehl_m", colour, 1e9)
        share.set_ylim(-0.03, 1.03)
        film.set_ylim(bottom=0.0)
        for ax in (share, film):
            ax.grid(visible=True, which="major", color="0.92", lw=0.6)
            ax.set_axisbelow(True)
    panels[0, 0].set_ylabel("load, area (dashed)")
    panels[1, 0].set_ylabel("minimum film [nm]")


def _band(ax: Axes, x: Array, curve: Curve, name: str, colour: str, factor: float = 1.0) -> None:
    """Draw a column with its error."""
    y, error = factor * curve.column(name), factor * curve.column(_error(name))
    ax.plot(x, y, "o-", ms=3, lw=1.2, color=colour)
    style.band(ax, x, y, error, color=colour, alpha=0.35)


def _points(
    ax: Axes, x: Array, curve: Curve, name: str, colour: str, factor: float = 1.0, marker: str = "s"
) -> None:
    """Draw a column of the full simulation; a load share with its error."""
    y = factor * curve.column(name)
    error = curve.column(_error(name)) if name.startswith("contact_load") else 0.0 * y
    style.points(ax, x, y, error, fmt=marker, ms=5, mfc="white", color=colour, capsize=3)


def _error(name: str) -> str:
    return name.removesuffix("_m") + ("_error_m" if name.endswith("_m") else "_error")


def draw_traction(
    curves: Sequence[Curve],
    surface: str,
    measured: Points | None = None,
    law: str = "",
) -> Figure:
    """Draw coefficients of friction, and the maximum temperature increase where it was computed.

    Without sliding there is no friction of sliding. `surface` says what the surface is; measured
    friction is laid over; `law` says what an empirical curve is.
    """
    warm = any(np.isfinite(curve.column("temperature_rise_max_K")).any() for curve in curves)
    figure = style.new_figure(10.0 if warm else 6.0, 4.4)
    axes = figure.subplots(1, 2 if warm else 1, squeeze=False)[0]
    for curve, colour in zip(curves, COLOURS * 9, strict=False):
        tail = f" ({curve.label})" if curve.label else ""
        slip = curve.places
        resting = slip == 0.0
        for name, line, words in (
            ("mu", "o-", "with heat" if warm else "friction"),
            ("mu_isothermal", ":", "isothermal"),
            ("mu_empirical", "--", "empirical"),
        ):
            if name not in curve.table or (name == "mu_isothermal" and not warm):
                continue
            mu = np.where(resting, 0.0, curve.column(name))
            known = np.isfinite(mu)
            axes[0].plot(
                slip[known], mu[known], line, ms=3, lw=1.2, color=colour, label=f"{words}{tail}"
            )
        if warm:
            rise = np.where(resting, 0.0, curve.column("temperature_rise_max_K"))
            known = np.isfinite(rise)
            axes[1].plot(slip[known], rise[known], "o-", ms=3, lw=1.2, color=colour)
    if measured is not None:
        measured.draw(axes[0], "contact.slide_to_roll")
    for ax in axes:
        ax.set_xlabel("slide-to-roll ratio")
        ax.grid(visible=True, which="major", color="0.92", lw=0.6)
        ax.set_axisbelow(True)
        ax.set_ylim(bottom=0.0)
    axes[0].set_ylabel(r"$\mu$")
    if warm:
        axes[1].set_ylabel("maximum temperature increase of the film [K]")
        style.letter(axes)
    axes[0].legend(fontsize="small")
    words = "; ".join(f"{c.label + ': ' if c.label else ''}{c.ends}" for c in curves if c.ends)
    figure.suptitle("\n".join((surface, words, *wrap(law, 90))), fontsize="medium")
    return figure
