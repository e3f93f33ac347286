# SPDX-License-Identifier: BSD-3-Clause
"""A transient run: friction in time, roughness in the contact, rough and smooth profiles.

Each function draws on `ax`, or on a new figure, and returns the axes; arrays have their first
index along x, the direction of motion. Units as in `pyehl.plots.style`.
"""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import ArrayLike

from pyehl.plots import style
from pyehl.plots.outline import CIRCLE, Outline
from pyehl.theory import stribeck
from pyehl.theory.film import central_film
from pyehl.theory.line_contact import LineContact, scaling_contact
from pyehl.theory.line_contact import central_film as line_film
from pyehl.theory.lubricant import Lubricant
from pyehl.types import Array, Mask, Settings


def eq_16(summary: Mapping[str, Any], settings: Settings) -> float | None:
    """mu_r/mu_s by eq. 16 of Zhang et al. 2019 for the waviness of a run, with its H_c.

    Parameters
    ----------
    summary, settings
        Scalars of the run, and groups and values of its case.

    Returns
    -------
    float or None
        None unless the equation applies to the run: a circular contact, one rough surface,
        equal wavelengths along X and Y, inside the range of the fit.
    """
    surface = settings["surface"]
    film, amplitude = summary.get("H_c"), summary.get("amplitude")
    if settings.get("second_surface", {}).get("kind", "smooth") != "smooth":
        return None
    elliptical = float(summary.get("ellipticity", 1.0)) != 1.0 or summary.get("shape") == "line"
    if surface["kind"] != "harmonic" or elliptical or not film or not amplitude:
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
    ax: Axes | None = None,
) -> Axes:
    """mu_r/mu_s over time (as Fig. 2 of Zhang et al. 2019).

    Parameters
    ----------
    time, ratio
        (n,) T [a/u] and mu_r/mu_s [-].
    period
        Averaging time; the last one is shaded; 0: none.
    mean
        Mean over it; None: not drawn.
    formula
        mu_r/mu_s by eq. 16; None: not drawn.
    seconds
        a/u [s], for a second axis in SI units; 0: none.
    """
    ax = style.axes_or_new(ax, 5.4, 3.4)
    end = float(time[-1])
    if mean is not None and period > 0.0:
        ax.axvspan(end - period, end, color=style.VERMILLION, alpha=0.13, lw=0.0)
    ax.axhline(1.0, color=style.GREY, lw=0.8, ls=":", label="smooth")
    ax.plot(time, ratio, color=style.BLUE, lw=1.4, label="rough")
    if formula is not None:
        ax.axhline(formula, color=style.GREEN, lw=1.0, ls="--", label=f"eq. 16: {formula:.3f}")
    if mean is not None:
        label = f"mean {mean:.3f}"
        ax.plot([end - period, end], [mean, mean], color=style.VERMILLION, lw=2.0, label=label)
    ax.set_xlim(float(time[0]), end)
    low, high = min(1.0, float(ratio.min())), max(float(ratio.max()), formula or 1.0)
    # space for the legend above the lines
    ax.set(ylim=(low - 0.05 * (high - low), high + 0.3 * (high - low)))
    ax.set(xlabel=r"$\bar t = t\,\bar u/a$")
    ax.ticklabel_format(axis="y", useOffset=False)
    ax.set_ylabel(r"$\mu_r/\mu_s$")
    if seconds > 0.0:
        scale = seconds * 1e3

        def milliseconds(values: ArrayLike) -> Array:
            return np.asarray(values, dtype=np.float64) * scale

        def back(values: ArrayLike) -> Array:
            return np.asarray(values, dtype=np.float64) / scale

        top = ax.secondary_xaxis("top", functions=(milliseconds, back))
        top.set_xlabel("t [ms]")
    ax.legend(loc="upper center", ncols=4 if formula is None else 2)
    return ax


def extremes_history(
    time: Array,
    pressure: Array,
    films: Mapping[str, Array],
    scales: style.Scales | None = None,
    *,
    ax: Axes | None = None,
) -> Axes:
    """Maximum pressure and films over time, while a single feature passes.

    Parameters
    ----------
    time
        (n,) T [a/u].
    pressure
        (n,) maximum pressure in Hertz units.
    films
        (n,) films in Hertz units by their labels.
    scales
        For SI units of pressure and film; None for Hertz units.
    """
    ax = style.axes_or_new(ax, 5.4, 3.4)
    factor, label = style.pressure_unit(scales)
    ax.plot(time, pressure * factor, color=style.BLUE, lw=1.4, label="maximum pressure")
    ax.set_xlabel(r"$\bar t = t\,\bar u/a$")
    style.y_label(ax, label, style.BLUE)
    ax.set_xlim(float(time[0]), float(time[-1]))
    twin = ax.twinx()
    factor, label = style.film_unit(scales)
    for (name, values), line in zip(films.items(), ("-", "--", ":"), strict=False):
        twin.plot(time, values * factor, line, color=style.VERMILLION, lw=1.4, label=name)
    twin.set_ylim(0.0, 1.1 * max(float(v.max()) for v in films.values()) * factor)
    style.y_label(twin, label, style.VERMILLION)
    ax.legend(
        handles=[*ax.get_lines(), *twin.get_lines()], loc="lower center", ncols=2,
        bbox_to_anchor=(0.5, 1.0),
    )  # fmt: skip
    return ax


def quasi_static(history: Mapping[str, Array], settings: Settings, film: float) -> Array | None:
    """Central film [m] of steady contacts at the times of a duty, (n,).

    By the film formula, scaled to the solved `film` [m] of the case; NaN where the lubricant is at
    rest; None if the radius across the motion changes, which is not in the history, or if the inlet
    has an oil layer.
    """
    if "radius_y" in settings["duty"] or "layer" in history:
        return None
    point, lubricant = scaling_contact(settings), Lubricant.from_settings(settings)

    def formula(load: float, speed: float, radius: float, viscosity: float) -> float:
        if speed <= 0.0:
            return float("nan")
        common: dict[str, Any] = {
            "mean_velocity": point.mean_velocity * speed,
            "radius": point.radius * radius,
            "viscosity": point.viscosity * viscosity,
        }
        if isinstance(point, LineContact):
            line = replace(point, load_per_length=point.load_per_length * load, **common)
            return line_film(line, lubricant)
        ratio = point.radius_ratio * radius
        return central_film(
            replace(point, load=point.load * load, radius_ratio=ratio, **common), lubricant
        )

    columns = (history[name] for name in ("load", "speed", "radius_x", "viscosity"))
    factor = film / formula(1.0, 1.0, 1.0, 1.0)
    result = [factor * formula(w, abs(u), r, v) for w, u, r, v in zip(*columns, strict=True)]
    return np.array(result)


def duty_history(
    history: Mapping[str, Array],
    steady: Array | None = None,
    solved: Mapping[str, Array] | None = None,
    *,
    ax: Axes | None = None,
) -> Axes:
    """Central and minimum film over the time of a duty.

    Parameters
    ----------
    history
        Columns of the history, (n,) each: t_s [s], h_c_m, h_min_m [m].
    steady
        (n,) central films of steady contacts [m] by formula; None: not drawn.
    solved
        The same columns of solved steady contacts; None: not drawn.
    """
    ax = style.axes_or_new(ax, 5.4, 3.0)
    time, nm = history["t_s"] * 1e3, 1e9
    if steady is not None:
        ax.plot(
            time, steady * nm, color=style.GREY, lw=1.0, ls="--", label="centre, steady (formula)"
        )
    ax.plot(time, history["h_c_m"] * nm, color=style.VERMILLION, lw=1.4, label="centre")
    ax.plot(time, history["h_min_m"] * nm, color=style.BLUE, lw=1.4, label="minimum")
    for name, label, colour in (
        ("h_c_m", "centre, steady", style.VERMILLION),
        ("h_min_m", "minimum, steady", style.BLUE),
    ):
        if solved is not None:
            at, film = solved["t_s"] * 1e3, solved[name] * nm
            ax.plot(at, film, "o", ms=3.5, mfc="none", color=colour, label=label, clip_on=False)
    ax.set(xlim=(0.0, float(time[-1])), ylabel="h [nm]")
    # space for the legend above the lines
    ax.set_ylim(0.0, (1.18 if solved is None else 1.3) * ax.get_ylim()[1])
    ax.legend(loc="upper center", ncols=3 if solved is None else 2)
    return ax


def duty_conditions(history: Mapping[str, Array], *, ax: Axes | None = None) -> Axes:
    """Draw load, velocity, radius, viscosity and layer relative to the case, if they change."""
    ax = style.axes_or_new(ax, 5.4, 1.6)
    time = history["t_s"] * 1e3
    labels = {"load": "load", "speed": "velocity", "radius_x": "radius", "viscosity": "viscosity"}
    labels["layer"] = "oil layer"
    for (name, label), line in zip(labels.items(), ("-", "--", "-.", ":", "-"), strict=True):
        if name in history and np.ptp(history[name]) > 0.0:
            ax.plot(time, history[name], line, color=style.GREEN, lw=1.2, label=label)
    ax.set(xlim=(0.0, float(time[-1])), xlabel="t [ms]", ylabel="over the case")
    ax.legend(loc="best")
    return ax


def _box(x: Array, y: Array, outline: Outline) -> tuple[tuple[Any, ...], Array, Array, Mask]:
    """Index of the box around the contact, its x and y, and which nodes are in the contact."""
    along, across = outline.reach
    columns, rows = np.abs(x) <= along, np.abs(y) <= across
    x, y = x[columns], y[rows]
    return np.ix_(columns, rows), x, y, outline.inside(x, y)


def roughness_top(x: Array, y: Array, *fields: Array, outline: Outline = CIRCLE) -> float:
    """Maximum height of several fields inside the Hertz ellipse, for a common scale."""
    at, _, _, circle = _box(x, y, outline)
    return max(float(np.abs(field[at][circle]).max()) for field in fields)


def roughness(
    x: Array,
    y: Array,
    heights: Array,
    scales: style.Scales | None = None,
    *,
    top: float = 0.0,
    name: str = "",
    bar: bool = True,
    outline: Outline = CIRCLE,
    ax: Axes | None = None,
) -> Axes:
    """Heights inside the Hertz ellipse as a map (as Fig. 6 of Zhang et al. 2019, left).

    Parameters
    ----------
    x, y
        (nx,), (ny,) in Hertz radii.
    heights
        RR or A_d = H_smooth - H, (nx, ny), in Hertz units.
    scales
        For SI units; None for Hertz units.
    top
        Maximum height of the scale, in Hertz units; 0: that of the field.
    name
        Name of the field in the title, which also gives its rms.
    bar
        Whether it has a colour bar.
    outline
        Outline of the dry contact.
    """
    ax = style.axes_or_new(ax, 4.0, 3.4)
    at, within_x, within_y, circle = _box(x, y, outline)
    top = top or roughness_top(x, y, heights, outline=outline)
    if scales is None:
        unit, label = 1e3, "10⁻³ a²/R"
    else:
        unit, label = style.height_unit(top * scales.film)
        unit *= scales.film
    unit_x, label_x = style.axis_unit(scales, "x")
    _, label_y = style.axis_unit(scales, "y")
    shown = np.where(circle, heights[at], np.nan) * unit
    style.contact_heights(
        shown, within_x * unit_x, within_y * unit_x, unit_x, top * unit, label,
        name=name, bar=bar, ax=ax, outline=outline,
    )  # fmt: skip
    style.place_labels(ax, label_x, label_y, outline)
    if scales is None and not outline.slender:
        style.hertz_ticks(ax, outline)
    else:
        style.few_ticks(ax)
    return ax


def profiles(
    x: Array,
    rough: Array,
    smooth: Array,
    scales: style.Scales | None = None,
    *,
    unit: tuple[float, str] = (1.0, ""),
    colour: str = style.BLUE,
    ax: Axes | None = None,
) -> Axes:
    """Rough over smooth values on the line y = 0.

    Parameters
    ----------
    x
        (nx,) in Hertz radii.
    rough, smooth
        (nx,) pressure or film in Hertz units.
    scales
        For SI units of x; None for Hertz units.
    unit
        Factor to the unit of the values, and their label, see `pyehl.plots.style`.
    colour
        Colour of the rough line.
    """
    ax = style.axes_or_new(ax, 3.8, 3.2)
    unit_x, label_x = style.axis_unit(scales, "x")
    ax.plot(x * unit_x, rough * unit[0], color=colour, lw=1.3, label="rough")
    ax.plot(x * unit_x, smooth * unit[0], "--", color="black", lw=0.9, label="smooth")
    ax.set(xlabel=label_x, ylabel=unit[1], xlim=(-1.5 * unit_x, 1.5 * unit_x))
    ax.legend(loc="best", framealpha=0.9)
    return ax
