# SPDX-License-Identifier: BSD-3-Clause
"""Figures of Zhang et al. 2019: friction of waves (2 to 4), rough surfaces (1, 5 to 7)."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from pyehl.plots import style
from pyehl.plots import surface as surface_plots
from pyehl.plots.style import COLUMN, GREY, PAGE, new_figure, styled
from pyehl.surfaces import Topography, psd_isotropic
from pyehl.types import Array, Indices, Mask

COLOURS = style.COLOURS
MARKERS = "os^"
LAMBDA = r"$\lambda/a$"
FIELD_COLOURS = (style.GREY, "black", style.BLUE, style.VERMILLION)


@styled()
def wave_history(runs: Sequence[tuple[str, Array, Array]], mean: float) -> Figure:
    """Draw mu_r/mu_s over time (Fig. 2), with the mean that the paper prints.

    `runs`: label, times (n,) [a/u] and mu_r/mu_s (n,) of each.
    """
    figure = new_figure(COLUMN, 3.0)
    ax = figure.subplots()
    # the means differ by less than the line width: magnify the end
    close = ax.inset_axes((0.6, 0.24, 0.38, 0.42))
    for (label, time, ratio), colour in zip(runs, COLOURS, strict=False):
        ax.plot(time, ratio, color=colour, lw=0.9, label=label)
        close.plot(time, ratio, color=colour, lw=0.9)
    for at in (ax, close):
        at.axhline(mean, color="black", lw=0.8, ls="--", label=f"mean of the paper: {mean:g}")
    ax.axhline(1.0, color=GREY, lw=0.8, ls=":")
    last = max(float(time[-1]) for _, time, _ in runs)
    close.set(xlim=(last - 1.3, last), ylim=(mean - 0.02, mean + 0.015))
    ax.set_xlabel(r"$\bar t = t\,\bar u/a$")
    ax.set_ylabel(r"$\mu_r/\mu_s$")
    figure.legend(*ax.get_legend_handles_labels(), loc="outside lower center")
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
        """Wavelength over the Hertz radius."""
        return f"{LAMBDA} = {self.wavelength:g}"


@styled()
def friction_over_film(panels: Sequence[tuple[str, Sequence[Series]]]) -> Figure:
    """Draw mu_r/mu_s over H_c/A_i, a panel for each ``time.scheme`` (Fig. 3).

    H_c is the central film of the smooth contact, A_i the amplitude of the undeformed wave.
    """
    figure = new_figure(PAGE, 3.4)
    axes = np.atleast_1d(figure.subplots(1, len(panels), sharey=True))
    for mark, ax, (title, series) in zip("abcd", axes, panels, strict=False):
        _points(ax, series, lines=True)
        ax.set_xlabel("$H_c/A_i$")
        ax.set_title(f"({mark}) {title}", loc="left")
        _logarithmic(ax)
    axes[0].set_ylabel(r"$\mu_r/\mu_s$")
    _legend_of_waves(figure, axes[0])
    return figure


def _points(ax: Axes, series: Sequence[Series], *, lines: bool) -> None:
    """Draw the waves, with a colour and a marker for each wavelength."""
    lengths = sorted({s.wavelength for s in series})
    for s in series:
        k = lengths.index(s.wavelength)
        marks: dict[str, Any] = {
            "ms": 3,
            "lw": 0.7,
            "color": COLOURS[k],
            "mfc": "none",
            "label": s.label,
        }
        ax.plot(s.place, s.friction, f"{MARKERS[k % 3]}{'-' * lines}", **marks)


def _legend_of_waves(figure: Figure, ax: Axes) -> None:
    """Draw a legend of the wavelengths below the panels."""
    handles, labels = ax.get_legend_handles_labels()
    waves = {label: h for h, label in zip(handles, labels, strict=True) if LAMBDA in label}
    figure.legend(
        [waves[label] for label in sorted(waves)],
        sorted(waves),
        loc="outside lower center",
        ncols=len(waves),
    )


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
    # Label, format, abscissa (m,) and mu_r/mu_s (m,) of fitted curves
    curves: Sequence[tuple[str, str, Array, Array]]


@styled()
def collapses(panels: Sequence[Collapse]) -> Figure:
    """Draw mu_r/mu_s over parameters that may collapse all waves to one curve (Fig. 4)."""
    rows = -(-len(panels) // 2)
    figure = new_figure(PAGE, 2.5 * rows + 0.8)
    axes = np.atleast_1d(figure.subplots(rows, 2, sharey=True)).ravel()
    for mark, ax, panel in zip("abcdef", axes, panels, strict=False):
        _points(ax, panel.series, lines=False)
        for label, line, place, friction in panel.curves:
            ax.plot(place, friction, line, lw=1.0, color="black", label=label, zorder=3)
        ax.set_title(f"({mark}) {panel.title}", loc="left")
        ax.set(xlabel=panel.abscissa, ylabel=r"$\mu_r/\mu_s$")
        _logarithmic(ax)
        handles, labels = ax.get_legend_handles_labels()
        count = len(panel.curves)
        if count:
            ax.legend(handles[-count:], labels[-count:], loc="upper right")
    _legend_of_waves(figure, axes[0])
    return figure


@dataclass(frozen=True, slots=True)
class Step:
    """One step of the prediction: title, field (nx, ny), unit, and whether it is signed."""

    title: str
    field: Array
    unit: str
    signed: bool


@styled()
def flow(steps: Sequence[Step]) -> Figure:
    """Draw the steps of the prediction with arrows from each to the next (Fig. 1)."""
    figure = style.new_figure(PAGE, 4.2)
    axes = figure.subplots(2, -(-len(steps) // 2)).ravel()
    for k, (ax, step) in enumerate(zip(axes, steps, strict=False)):
        inside = step.field[np.isfinite(step.field)]
        top = float(np.quantile(np.abs(inside), 0.999))
        low = -top
        if not step.signed:
            low, top = (float(v) for v in np.quantile(inside, (0.001, 0.999)))
        image = ax.imshow(
            step.field.T, origin="lower", cmap=style.DIVERGING if step.signed else style.SEQUENTIAL,
            vmin=low, vmax=top,
        )  # fmt: skip
        style.colour_bar(image, ax, step.unit)
        arrow = r"  $\longrightarrow$" if k + 1 < len(steps) else ""
        ax.set_title(f"{k + 1}. {step.title}{arrow}", loc="left")
        ax.set_xticks([])
        ax.set_yticks([])
    for ax in axes[len(steps) :]:
        ax.set_axis_off()
    return figure


@styled()
def spectrum(topography: Topography) -> Figure:
    """Draw a surface, its two-dimensional spectrum, and the radial mean (Fig. 5).

    A line with the slope of a Hurst exponent of 0.8 passes through a point of the mean.
    """
    figure = style.new_figure(PAGE, 2.2)
    axes = figure.subplots(1, 3)
    surface_plots.heights(topography, ax=axes[0])
    surface_plots.spectrum_map(topography, ax=axes[1])
    q, c_iso = psd_isotropic(topography)
    shown = c_iso > 0.0
    axes[2].loglog(q[shown], c_iso[shown], "o", ms=2.5, color=style.BLUE, label=r"$C^{iso}$")
    line = c_iso[8] * (q / q[8]) ** -3.6
    axes[2].loglog(q, line, "--", color="black", lw=1.0, label="$q^{-2-2H}$, $H$ = 0.8")
    axes[2].set(xlabel=r"$|q|$ [rad/m]", ylabel=r"$C^{iso}$ [m$^4$]")
    handles, labels = axes[2].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower right", ncols=2)
    style.letter(list(axes))
    return figure


@styled()
def deformed(x: Array, y: Array, inside: Mask, fields: Mapping[str, Array]) -> Figure:
    """Draw roughness fields, their height distributions and profiles on Y = 0 (Fig. 6).

    Coordinates (nx,), (ny,) [a]; drawn nodes `inside` (nx, ny); heights (nx, ny) [m] by name, the
    undeformed ones first, then the simulation.
    """
    figure = style.new_figure(PAGE, 4.4)
    grid = figure.add_gridspec(2, len(fields))
    maps = [figure.add_subplot(grid[0, k]) for k in range(len(fields))]
    top = 1e9 * max(float(np.abs(f[inside]).max()) for n, f in fields.items() if n != "undeformed")
    for ax, (name, field) in zip(maps, fields.items(), strict=True):
        image = ax.imshow(
            np.where(inside, field * 1e9, np.nan).T, origin="lower", extent=style.extent_of(x, y),
            cmap=style.DIVERGING, vmin=-top, vmax=top, interpolation="nearest",
        )  # fmt: skip
        rms = 1e9 * float(np.std(field[inside]))
        ax.set_title(f"{name}\nrms {rms:.3g} nm", loc="left")
        ax.set(xlabel="$X$", xticks=[-0.5, 0.0, 0.5], yticks=[-0.5, 0.0, 0.5])
        ax.tick_params(labelleft=ax is maps[0])
    maps[0].set_ylabel("$Y$")
    figure.colorbar(image, ax=maps, label="height [nm]", extend="both")
    half = len(fields) // 2
    histogram = figure.add_subplot(grid[1, :half])
    middle = figure.add_subplot(grid[1, half:])
    bins = np.linspace(-1.2 * top, 1.2 * top, 61).tolist()
    line = int(np.argmin(np.abs(y)))
    for (name, field), colour in zip(fields.items(), FIELD_COLOURS, strict=False):
        histogram.hist(
            1e9 * field[inside], bins=bins, density=True, histtype="step", color=colour, label=name
        )
        if name != "undeformed":
            shown = inside[:, line]
            middle.plot(x[shown], 1e9 * field[shown, line], color=colour, lw=1.1, label=name)
    histogram.set(xlabel="height [nm]", ylabel="probability density [1/nm]")
    figure.legend(*histogram.get_legend_handles_labels(), loc="outside lower center", ncols=4)
    middle.set(xlabel="$X$ on the line $Y$ = 0", ylabel="height [nm]")
    return figure


@styled()
def by_seed(seeds: Indices, simulated: Array, predicted: Sequence[tuple[str, Array]]) -> Figure:
    """Draw mu_r/mu_s by seed, simulated and predicted (Fig. 7)."""
    figure = style.new_figure(COLUMN, 2.8)
    ax = figure.subplots()
    ax.plot(seeds, simulated, "o", color="black", ms=4, label="simulation")
    for (label, values), marker, colour in zip(
        predicted, "sD^", (style.BLUE, style.VERMILLION, style.GREEN), strict=False
    ):
        ax.plot(seeds, values, marker, color=colour, mfc="none", ms=4, label=label)
    ax.axhline(1.0, color=style.GREY, lw=0.8, ls=":")
    ax.set_xticks(seeds)
    ax.set(xlabel="seed of the surface", ylabel=r"$\mu_r/\mu_s$")
    figure.legend(loc="outside lower center")
    return figure
