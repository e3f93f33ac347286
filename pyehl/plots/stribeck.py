# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of Stribeck curves and of traction curves.

A Stribeck curve shows friction over the varied key with Lambda on an upper axis, and solid contact
below it; a traction curve shows friction and temperature over the slide-to-roll ratio.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pyehl.plots import style
from pyehl.plots.panels import page
from pyehl.plots.surface import RATIO
from pyehl.theory import stribeck
from pyehl.theory.transition import Curve
from pyehl.types import Array

LABELS = {
    "contact.mean_velocity": r"mean velocity $\bar u$ [m/s]",
    "lubricant.viscosity": r"viscosity $\eta_0$ [Pa s]",
    "contact.load": "load w [N]",
    "lubricant.temperature": "temperature [°C]",
    "contact.slide_to_roll": "slide-to-roll ratio",
}
# Maximum over minimum of the varied key from which the axis is logarithmic
WIDE = 3.0


@dataclass(frozen=True, slots=True)
class Points:
    """Measured friction: positions by abscissa, values and errors, all (n,)."""

    places: Mapping[str, Array]
    friction: Array
    error: Array

    def draw(self, ax: Axes, abscissa: str) -> None:
        """Draw them, with bars where an error is known."""
        marks = {"fmt": "k^", "ms": 4, "mfc": "none", "capsize": 2, "lw": 0.8, "label": "measured"}
        style.points(ax, self.places[abscissa], self.friction, self.error, **marks)


@style.styled()
def draw_stribeck(
    curves: Sequence[Curve], conditions: str, measured: Points | None = None, law: str = ""
) -> Figure:
    """Draw friction over the varied key, a coefficient or a ratio mu_r/mu_s.

    `conditions` go into the metadata of a file, with the end of full film and a description of an
    empirical `law`. Measured friction is drawn in the same axes, and with a ratio the curve of
    Zhang et al. 2019. A single curve with monotonic Lambda has it on an upper axis.
    """
    absolute, key = curves[0].absolute, curves[0].key
    # two surfaces have load shares of full simulations only
    shares = ("contact_load_share", "contact_load_share_ehl")
    contact = any(_known(curve, name) for curve in curves for name in shares)
    # solid contact with unknown friction has no panel of friction
    friction = not contact or any(_has_friction(curve) for curve in curves)
    rows = friction + 2 * contact
    width = page(1)
    figure = style.new_figure(width, 0.6 + width * (0.68 * friction + 0.9 * contact))
    heights = [1.5] * friction + [1.0] * 2 * contact
    axes = figure.subplots(rows, 1, sharex=True, squeeze=False, height_ratios=heights)[:, 0]
    coloured = list(zip(curves, style.COLOURS * 9, strict=False))
    if contact:
        draw_contact(axes[-2], axes[-1], coloured)
    _scale(axes[-1], np.concatenate([curve.places for curve in curves]))
    axes[-1].set_xlabel(LABELS.get(key, key))
    if friction:
        for curve, colour in coloured:
            _draw_curve(axes[0], curve, colour)
        if not absolute:
            _draw_eq_16(axes[0], curves)
        if measured is not None:
            measured.draw(axes[0], key)
        axes[0].set_ylabel(r"$\mu$" if absolute else RATIO)
    _shade(axes[0], curves)
    for ax in axes:
        ax.grid(visible=True, which="major")
    style.letter(list(axes))
    if len(curves) == 1:
        _lambda_above(axes[0], curves[0])
    style.legend_below(figure, *axes)
    words = (f"{c.label + ': ' if c.label else ''}{c.ends}" for c in curves if c.ends)
    figure.set_label("; ".join(filter(None, (conditions, *words, law))))
    return figure


def _named(curve: Curve) -> str:
    """Label of a curve, its keys as on the axes; '' for a single one."""
    name = curve.label
    for key, words in LABELS.items():
        name = name.replace(key, words)
    return name


def _scale(ax: Axes, places: Array) -> None:
    """Make the x axis logarithmic over a wide range, with readable numbers."""
    if places.min() > 0.0 and places.max() >= WIDE * places.min():
        ax.set_xscale("log")
        ax.set_xlim(places.min() / 1.1, places.max() * 1.1)
        style.label_decades(ax.xaxis)
    elif np.ptp(places) > 0.0:
        room = 0.04 * float(np.ptp(places))
        ax.set_xlim(places.min() - room, places.max() + room)


def _lambda_above(ax: Axes, curve: Curve) -> None:
    """Add an upper axis with Lambda if it is monotonic along the curve."""
    x, result = curve.places, curve.column("lambda_ratio")
    known = np.isfinite(result) & (result > 0.0)
    x, result = x[known], result[known]
    if result.size < 2 or np.unique(np.sign(np.diff(result))).size > 1:
        return
    log = ax.get_xscale() == "log"
    order = np.argsort(result)
    decades = 10.0 ** np.arange(np.floor(np.log10(result.min())), np.log10(result.max()) + 1)
    values = np.outer(decades, (1.0, 2.0, 5.0)).ravel()
    values = values[(result.min() <= values) & (values <= result.max())]
    at = np.interp(np.log(values), np.log(result[order]), np.log(x[order]) if log else x[order])
    above = ax.secondary_xaxis("top")
    above.set_xticks(np.exp(at) if log else at, [f"{value:g}" for value in values])
    above.set_xticks([], minor=True)
    above.set_xlabel(r"$\Lambda = h_\mathrm{min}/\sigma$")


def _known(curve: Curve, name: str) -> bool:
    """Whether a curve has a column with a number in it."""
    return name in curve.table and bool(curve.table[name].notna().any())


def _has_friction(curve: Curve) -> bool:
    empirical = curve.absolute and _known(curve, "mu_empirical")
    return empirical or _known(curve, "mu_ratio") or _known(curve, "mu_ratio_ehl")


def _draw_curve(ax: Axes, curve: Curve, colour: str) -> None:
    x, y = curve.places, curve.friction()
    known = np.isfinite(x) & np.isfinite(y)
    ax.plot(x[known], y[known], "o-", color=colour, label=_named(curve) or "prediction")
    if curve.absolute and "mu_empirical" in curve.table:
        empirical = curve.column("mu_empirical")
        there = np.isfinite(x) & np.isfinite(empirical)
        ax.plot(x[there], empirical[there], "--", color=colour, label="empirical")
    for width, alpha, label in (
        (curve.friction("mu_ratio_spread"), 0.15, "spread over the surfaces"),
        (curve.friction("mu_ratio_model_error"), 0.35, "error of the model"),
    ):
        style.band(ax, x, y, width, color=colour, alpha=alpha, label=label)
    full = curve.friction("mu_ratio_ehl")
    if np.isfinite(full).any():
        marks = {"fmt": "s", "ms": 5, "mfc": "white", "color": colour, "capsize": 3}
        error = curve.friction("mu_ratio_ehl_error")
        style.points(ax, x, full, error, label="full simulation", **marks)


def _shade(ax: Axes, curves: Sequence[Curve]) -> None:
    """Shade mixed film and film breakdown, on each side half-way to the next point of full film.

    On a side without one, to the limit of the axis.
    """
    for curve in curves:
        x = curve.places
        no_full_film = np.isin(np.arange(x.size), curve.broken)
        broken = no_full_film & np.isfinite(x)
        if not broken.any():
            continue
        low, high = float(x[broken].min()), float(x[broken].max())
        others = x[~no_full_film & np.isfinite(x) & np.isfinite(curve.friction())]
        above = others[others > high]
        if above.size:
            high = _middle(ax, high, float(above.min()))
        below = others[others < low]
        low = _middle(ax, low, float(below.max())) if below.size else min(low, ax.get_xlim()[0])
        high = high if above.size else max(high, ax.get_xlim()[1])
        ax.axvspan(low, high, color=style.GREY, alpha=0.2, lw=0, label="no full film")


def _middle(ax: Axes, low: float, high: float) -> float:
    """Middle between two places, as the axis shows it."""
    return float(np.sqrt(low * high)) if ax.get_xscale() == "log" else 0.5 * (low + high)


def _draw_eq_16(ax: Axes, curves: Sequence[Curve]) -> None:
    """Draw eq. 16 of Zhang et al. 2019 at theta_2 of each point; the limits of the axes stay."""
    limits = ax.get_ylim()
    for curve in curves:
        theta = curve.column("theta_2")
        known = np.isfinite(theta)
        ratio = stribeck.relative_friction(theta[known])
        ax.plot(
            curve.places[known], ratio, "--", lw=1, color="black", label="harmonic waves (eq. 16)"
        )
    ax.set_ylim(limits[0], limits[1])


def draw_contact(share: Axes, film: Axes, curves: Sequence[tuple[Curve, str]]) -> None:
    """Draw load share and area share in one panel, minimum film in the other.

    Lines are predictions, squares and diamonds full simulations.
    """
    for curve, colour in curves:
        x = curve.places
        _band(share, x, curve, "contact_load_share", colour)
        share.plot(x, curve.column("contact_area_share"), "--", lw=1, color=colour)
        _points(share, x, curve, "contact_load_share_ehl", colour)
        _points(share, x, curve, "contact_area_share_ehl", colour, marker="D")
        _band(film, x, curve, "h_min_rough_m", colour, 1e9)
        _points(film, x, curve, "h_min_rough_ehl_m", colour, 1e9)
    share.set_ylim(-0.03, 1.03)
    film.set_ylim(bottom=0.0)
    share.set_ylabel("load, area (dashed)")
    film.set_ylabel("minimum film [nm]")


def _band(ax: Axes, x: Array, curve: Curve, name: str, colour: str, factor: float = 1.0) -> None:
    """Draw a column with its error."""
    y, error = factor * curve.column(name), factor * curve.column(_error(name))
    ax.plot(x, y, "o-", ms=3, lw=1.2, color=colour)
    style.band(ax, x, y, error, color=colour, alpha=0.35, label="error of the model")


def _points(
    ax: Axes, x: Array, curve: Curve, name: str, colour: str, factor: float = 1.0, marker: str = "s"
) -> None:
    """Draw a column of the full simulation; a load share with its error."""
    y = factor * curve.column(name)
    error = curve.column(_error(name)) if name.startswith("contact_load") else 0.0 * y
    style.points(ax, x, y, error, fmt=marker, ms=5, mfc="white", color=colour, capsize=3)


def _error(name: str) -> str:
    return name.removesuffix("_m") + ("_error_m" if name.endswith("_m") else "_error")


@style.styled()
def draw_traction(
    curves: Sequence[Curve],
    conditions: str,
    measured: Points | None = None,
    law: str = "",
) -> Figure:
    """Draw coefficients of friction, and the maximum temperature increase if it was computed.

    Friction is 0 without sliding. `conditions`, `measured` and `law` as in `draw_stribeck`.
    """
    warm = any(np.isfinite(curve.column("temperature_rise_max_K")).any() for curve in curves)
    width = page(1)
    figure = style.new_figure(width, width * (1.25 if warm else 0.8))
    axes = figure.subplots(2 if warm else 1, 1, sharex=True, squeeze=False)[:, 0]
    for curve, colour in zip(curves, style.COLOURS * 9, strict=False):
        slip = curve.places
        rolling = slip == 0.0
        for name, line, words in (
            ("mu", "o-", "with heat" if warm else "friction"),
            ("mu_isothermal", ":", "isothermal"),
            ("mu_empirical", "--", "empirical"),
        ):
            if name not in curve.table or (name == "mu_isothermal" and not warm):
                continue
            mu = np.where(rolling, 0.0, curve.column(name))
            known = np.isfinite(mu)
            axes[0].plot(
                slip[known],
                mu[known],
                line,
                color=colour,
                label=(name == "mu" and _named(curve)) or words,
            )
        if warm:
            rise = np.where(rolling, 0.0, curve.column("temperature_rise_max_K"))
            known = np.isfinite(rise)
            axes[1].plot(slip[known], rise[known], "o-", ms=3, lw=1.2, color=colour)
    if measured is not None:
        measured.draw(axes[0], "contact.slide_to_roll")
    for ax in axes:
        ax.grid(visible=True, which="major")
        ax.set_ylim(bottom=0.0)
    axes[-1].set_xlabel("slide-to-roll ratio")
    axes[0].set_ylabel(r"$\mu$")
    if warm:
        axes[1].set_ylabel("maximum increase of\nfilm temperature [K]")
        style.letter(list(axes))
    style.legend_below(figure, axes[0])
    ends = (f"{c.label + ': ' if c.label else ''}{c.ends}" for c in curves if c.ends)
    figure.set_label("; ".join(filter(None, (conditions, *ends, law))))
    return figure
