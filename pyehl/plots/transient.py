# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of a march: friction in time, deformed roughness, rough and smooth centre lines.

Each function returns a figure; arrays have their first index along x. Units as in
`pyehl.plots.style`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle
from numpy.typing import ArrayLike, NDArray

from pyehl.plots.style import (
    BLUE,
    DIVERGING,
    GREEN,
    GREY,
    VERMILLION,
    Scales,
    axis_unit,
    edges,
    height_unit,
    letter,
    nearest,
    new_figure,
)
from pyehl.theory import stribeck

__all__ = ["deformed_roughness", "eq_16", "friction_history", "rough_and_smooth"]

Array = NDArray[np.float64]


def eq_16(summary: Mapping[str, Any], settings: Mapping[str, Mapping[str, Any]]) -> float | None:
    """mu_r/mu_s by eq. 16 of Zhang et al. 2019 for the waviness of a run, with its own H_c.

    Parameters
    ----------
    summary, settings
        Scalars of the run, and groups and values of its case.

    None when the run is none that the equation is for: equal wavelengths along X and Y, inside
    the range of the fit.
    """
    surface = settings["surface"]
    film, amplitude = summary.get("H_c"), summary.get("amplitude")
    if surface["kind"] != "harmonic" or not film or not amplitude:
        return None
    wavelength = float(surface["wavelength_x"])
    if wavelength != float(surface["wavelength_y"]):
        return None
    point = float(summary["moes_m"]), float(summary["moes_l"]), wavelength, film / amplitude
    if stribeck.in_range(*point):
        return None
    return float(stribeck.relative_friction(stribeck.theta_2(*point)))


def friction_history(
    time: Array,
    ratio: Array,
    *,
    period: float = 0.0,
    mean: float | None = None,
    formula: float | None = None,
    seconds: float = 0.0,
) -> Figure:
    """Draw mu_r/mu_s over time (as Fig. 2 of Zhang et al. 2019).

    Parameters
    ----------
    time, ratio
        (n,) T [a/u] and mu_r/mu_s [-].
    period
        Time over which the mean was taken: the last one is shaded; 0: none.
    mean
        Mean over it; None: not drawn.
    formula
        mu_r/mu_s by eq. 16; None: not drawn.
    seconds
        a/u [s] for a second axis in SI units; 0: none.
    """
    figure = new_figure(5.4, 3.4)
    ax = figure.subplots()
    end = float(time[-1])
    if mean is not None and period > 0.0:
        ax.axvspan(end - period, end, color=VERMILLION, alpha=0.13, lw=0.0)
    ax.axhline(1.0, color=GREY, lw=0.8, ls=":", label="smooth")
    ax.plot(time, ratio, color=BLUE, lw=1.4, label="rough")
    if formula is not None:
        ax.axhline(formula, color=GREEN, lw=1.0, ls="--", label=f"eq. 16: {formula:.3f}")
    if mean is not None:
        label = f"mean {mean:.3f}"
        ax.plot([end - period, end], [mean, mean], color=VERMILLION, lw=2.0, label=label)
    ax.set_xlim(float(time[0]), end)
    low, high = min(1.0, float(ratio.min())), max(float(ratio.max()), formula or 1.0)
    ax.set_ylim(low - 0.05 * (high - low), high + 0.05 * (high - low))
    ax.set_xlabel("$T = t\\,u/a$")
    ax.set_ylabel(r"$\mu_r/\mu_s$")
    if seconds > 0.0:
        scale = seconds * 1e3

        def milliseconds(values: ArrayLike) -> Array:
            return np.asarray(values, dtype=np.float64) * scale

        def back(values: ArrayLike) -> Array:
            return np.asarray(values, dtype=np.float64) / scale

        top = ax.secondary_xaxis("top", functions=(milliseconds, back))
        top.set_xlabel("$t$ [ms]")
    figure.legend(loc="outside lower center", ncols=4, fontsize="small", columnspacing=1.2)
    return figure


def deformed_roughness(
    x: Array, y: Array, roughness: Array, deformed: Array, scales: Scales | None = None
) -> Figure:
    """Roughness and what is left of it in the contact, X^2 + Y^2 <= 1, on one scale (Fig. 6, left).

    Parameters
    ----------
    x, y
        (nx,), (ny,) in Hertz radii.
    roughness, deformed
        RR and A_d = H_smooth - H, (nx, ny), in Hertz units.
    scales
        For SI units; None for Hertz units.
    """
    inner_x, inner_y = np.abs(x) <= 1.0, np.abs(y) <= 1.0
    at = np.ix_(inner_x, inner_y)
    inside = x[inner_x][:, None] ** 2 + y[inner_y][None, :] ** 2 <= 1.0
    top = max(float(np.abs(field[at][inside]).max()) for field in (roughness, deformed))
    if scales is None:
        unit, height = 1e3, r"$10^{-3}\,a^2/R$"
    else:
        unit, height = height_unit(top * scales.film)
        unit *= scales.film
    unit_x, label_x = axis_unit(scales, "x")
    _, label_y = axis_unit(scales, "y")
    left, right = (v * unit_x for v in edges(x[inner_x]))
    bottom, upper = (v * unit_x for v in edges(y[inner_y]))
    figure = new_figure(7.2, 3.6)
    axes: list[Axes] = list(figure.subplots(1, 2, sharey=True))
    names = "(a) undeformed", "(b) deformed"
    for ax, field, name in zip(axes, (roughness, deformed), names, strict=True):
        shown = np.where(inside, field[at], np.nan) * unit
        image = ax.imshow(
            shown.T, origin="lower", extent=(left, right, bottom, upper), cmap=DIVERGING,
            vmin=-top * unit, vmax=top * unit, interpolation="nearest",
        )  # fmt: skip
        ax.add_patch(Circle((0.0, 0.0), unit_x, fill=False, lw=0.8, ec=GREY))
        rms = float(np.std(field[at][inside])) * unit
        ax.set_title(f"{name}, rms {rms:.3g} {height}", loc="left", fontsize="medium")
        ax.set_xlabel(label_x)
        ax.set_xlim(-1.05 * unit_x, 1.05 * unit_x)
        ax.set_ylim(-1.05 * unit_x, 1.05 * unit_x)
        if scales is None:
            ax.set_xticks([-1.0, -0.5, 0.0, 0.5, 1.0])
            ax.set_yticks([-1.0, -0.5, 0.0, 0.5, 1.0])
    axes[0].set_ylabel(label_y)
    figure.colorbar(image, ax=axes, shrink=0.8).set_label(f"height [{height}]")
    return figure


def rough_and_smooth(
    x: Array,
    y: Array,
    pressures: tuple[Array, Array],
    films: tuple[Array, Array],
    scales: Scales | None = None,
) -> Figure:
    """Pressure and film on the line y = 0, rough over smooth.

    Parameters
    ----------
    x, y
        (nx,), (ny,) in Hertz radii.
    pressures, films
        Rough and smooth field, (nx, ny), in Hertz units.
    scales
        For SI units; None for Hertz units.
    """
    figure = new_figure(7.2, 3.2)
    axes: list[Axes] = list(figure.subplots(1, 2))
    row = nearest(y, 0.0)
    unit_x, label_x = axis_unit(scales, "x")
    unit_p = 1.0 if scales is None else scales.pressure * 1e-9
    unit_h = 1.0 if scales is None else scales.film * 1e6
    label_p = r"$P = p/p_h$" if scales is None else r"$p$ [GPa]"
    label_h = r"$H = hR/a^2$" if scales is None else r"$h$ [$\mu$m]"
    central = float(films[1][nearest(x, 0.0), row]) * unit_h
    for ax, pair, unit, label, colour in (
        (axes[0], pressures, unit_p, label_p, BLUE),
        (axes[1], films, unit_h, label_h, VERMILLION),
    ):
        ax.plot(x * unit_x, pair[0][:, row] * unit, color=colour, lw=1.3, label="rough")
        ax.plot(x * unit_x, pair[1][:, row] * unit, "--", color="black", lw=0.9, label="smooth")
        ax.set_xlabel(label_x)
        ax.set_ylabel(label)
        ax.set_xlim(-1.5 * unit_x, 1.5 * unit_x)
        ax.legend(loc="best", fontsize="small", framealpha=0.9)
    axes[0].set_ylim(0.0, 1.06 * max(float(p[:, row].max()) for p in pressures) * unit_p)
    axes[1].set_ylim(0.0, 3.0 * central)
    letter(axes)
    return figure
