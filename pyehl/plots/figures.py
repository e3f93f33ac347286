# SPDX-License-Identifier: BSD-3-Clause
"""Whole figures of results: panels side by side under a line that says what they show."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from pyehl import namelist
from pyehl.plots import contact, surface, transient
from pyehl.plots.outline import Outline
from pyehl.plots.style import (
    BLUE,
    PAGE_WIDTH,
    VERMILLION,
    Scales,
    film_unit,
    letter,
    nearest,
    new_figure,
    pressure_unit,
    wrapped,
)
from pyehl.surfaces import Topography, wavenumbers
from pyehl.theory.ellipse import ellipse
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.transport import stiffness

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["headline", "prediction_figures", "scales_of", "solution_figures"]

Array = NDArray[np.float64]

# Room below and above a row of panels [in]
BELOW, ABOVE = 0.52, 0.57
# Panels narrower than this are put below one another [in]
LEAST_PANEL = 2.0


def headline(summary: Mapping[str, Any], scales: Scales | None = None) -> str:
    """M, L, p_h, film and direction of motion in one line; the status unless it is a good one.

    Of the scalars of a solution or a prediction, with scales in SI units, else in Hertz units.
    """
    parts = [f"$M$ = {summary['moes_m']:.4g}", f"$L$ = {summary['moes_l']:.4g}"]
    parts.append(f"$p_h$ = {summary['hertz_pressure_Pa'] * 1e-9:.3g} GPa")
    for name, word in (("c", "c"), ("min", r"\min")):
        si, big = summary.get(f"h_{name}_m"), summary.get(f"H_{name}")
        if si is None and scales is not None and big is not None:
            si = big * scales.film
        if si is not None and (scales is not None or big is None):
            parts.append(rf"$h_{{{word}}}$ = {si * 1e6:.3g} $\mu$m")
        elif big is not None:
            parts.append(f"$H_{{{word}}}$ = {big:.3g}")
    if summary["status"] not in ("converged", "predicted"):
        parts.append(str(summary["status"]).upper())
    return ",  ".join(parts) + r",  motion $\rightarrow$"


def scales_of(data: xr.Dataset, units: str = "auto") -> Scales | None:
    """Scales of a solution for `units`: 'si', 'hertz', or 'auto' for SI when the case has them."""
    operating = OperatingPoint.from_settings(namelist.values(data.attrs["case"]))
    if units == "si" or (units == "auto" and operating.si):
        return Scales(operating.hertz_radius, operating.hertz_pressure, operating.film_scale)
    return None


def _stretch(data: xr.Dataset) -> float:
    """How much higher maps of a wide contact are, to be as broad as those of a circle."""
    along, across = Outline.of(data).reach
    return min(2.0, max(1.0, across / along))


def _row(
    count: int,
    size: tuple[float, float],
    title: str,
    *,
    sharey: bool = False,
    room: tuple[float, float, float] | None = None,
) -> Figure:
    """Make a figure with panels side by side.

    `room`: left of, between and right of the panels in inches, where it is known. Then nothing is
    measured, which takes as long as to draw.
    """
    page = PAGE_WIDTH.get()
    if page:
        return _on_page(count, size, wrapped(title, page), page, sharey=sharey)
    if room is None:
        figure = new_figure(*size)
    else:
        (width, height), (left, between, right) = size, room
        panel = (width - left - right - (count - 1) * between) / count
        figure = Figure(figsize=size)
        figure.subplots_adjust(
            left / width, BELOW / height, 1.0 - right / width, 1.0 - ABOVE / height, between / panel
        )
    letter(list(figure.subplots(1, count, sharey=sharey, squeeze=False)[0]))
    figure.suptitle(title, fontsize="medium")
    return figure


def _on_page(
    count: int, size: tuple[float, float], title: str, width: float, *, sharey: bool
) -> Figure:
    """Make a figure as wide as a page, its panels below one another where they would be small."""
    columns = count if width >= count * LEAST_PANEL else 1
    rows = count // columns
    height = max(LEAST_PANEL, size[1] * width / columns * count / size[0])
    figure = new_figure(width, rows * height)
    letter(list(figure.subplots(rows, columns, sharey=sharey, squeeze=False).ravel()))
    figure.suptitle(title, fontsize="medium")
    return figure


def _no_second_label(ax: Axes) -> None:
    """Leave out the label of the y axis that panels side by side share."""
    place = ax.get_subplotspec()
    if place is not None and not place.is_first_col():
        ax.set_ylabel("")


def solution_figures(data: xr.Dataset, units: str = "auto") -> dict[str, Figure]:
    """All figures of a solution, by the names of their files.

    `units`: 'si', 'hertz', or 'auto' for SI when the case was given in SI.
    """
    scales = scales_of(data, units)
    title = headline(data.attrs, scales)
    figures = {}
    if "P" in data:
        figures["centre_lines"] = _centre_lines(data, scales, title)
        figures["film"] = _film(data, scales, title)
    if "A_d" in data:
        figures["deformed_roughness"] = _deformed(data, scales, title)
        figures["rough_and_smooth"] = _rough_and_smooth(data, scales, title)
    if "history_T" in data and data.sizes["history"] > 1:
        figures["friction"] = _friction(data, scales, title)
        if "P_rise_max" in data.attrs:
            figures["extremes"] = _extremes(data, scales, title)
    return figures


def _centre_lines(data: xr.Dataset, scales: Scales | None, title: str) -> Figure:
    figure = _row(2, (8.0, 3.5), title)
    left, right = figure.axes
    x, y, p, h = (data[name].values for name in "XYPH")
    i, j = nearest(x, 0.0), nearest(y, 0.0)
    contact.pressure_and_film(
        x, p[:, j], h[:, j], scales, name="x", half=Outline.of(data).chords[0], ax=left
    )
    contact.pressure_and_film(
        y, p[i, :], h[i, :], scales, name="y", half=Outline.of(data).chords[1], ax=right
    )
    twins = [ax for ax in figure.axes if ax not in (left, right)]
    lines = [*left.get_lines(), *twins[0].get_lines()]
    figure.legend(handles=lines, loc="outside lower center", ncols=3)
    return figure


def _film(data: xr.Dataset, scales: Scales | None, title: str) -> Figure:
    figure = _row(2, (7.2, 3.6 * _stretch(data)), title, sharey=True)
    left, right = figure.axes
    x, y, film = (data[name].values for name in "XYH")
    fringes = None
    if "H_smooth" in data:
        fringes = contact.fringe_spacings(
            float(data.H_smooth.values[nearest(x, 0.0), nearest(y, 0.0)]) * film_unit(scales)[0],
            scales,
        )
    outline = Outline.of(data)
    contact.interferogram(x, y, film, scales, fringes=fringes, outline=outline, ax=left)
    contact.contours(x, y, film, scales, outline=outline, ax=right)
    _no_second_label(right)
    return figure


def _deformed(data: xr.Dataset, scales: Scales | None, title: str) -> Figure:
    figure = _row(2, (8.2, 3.6 * _stretch(data)), title, sharey=True)
    x, y, rough, deformed = (data[name].values for name in ("X", "Y", "RR", "A_d"))
    outline = Outline.of(data)
    top = transient.roughness_top(x, y, rough, deformed, outline=outline)
    names = ("(a) undeformed,", "(b) deformed,")
    for ax, field, name in zip(list(figure.axes), (rough, deformed), names, strict=True):
        transient.roughness(
            x, y, field, scales,
            top=top, name=name, bar=field is deformed, outline=outline, ax=ax,
        )  # fmt: skip
    _no_second_label(figure.axes[1])
    return figure


def _rough_and_smooth(data: xr.Dataset, scales: Scales | None, title: str) -> Figure:
    figure = _row(2, (7.6, 3.4), title)
    left, right = figure.axes
    x, row = data["X"].values, nearest(data["Y"].values, 0.0)
    for ax, name, unit, colour in (
        (left, "P", pressure_unit(scales), BLUE),
        (right, "H", film_unit(scales), VERMILLION),
    ):
        rough, smooth = (data[n].values[:, row] for n in (name, f"{name}_smooth"))
        transient.profiles(x, rough, smooth, scales, unit=unit, colour=colour, ax=ax)
        if name == "P":
            ax.set_ylim(0.0, 1.06 * max(float(rough.max()), float(smooth.max())) * unit[0])
        else:
            ax.set_ylim(0.0, 3.0 * float(smooth[nearest(x, 0.0)]) * unit[0])
    return figure


def _friction(data: xr.Dataset, scales: Scales | None, title: str) -> Figure:
    figure = _row(1, (6.4, 3.6), title)
    settings = namelist.values(data.attrs["case"])
    transient.friction_history(
        data.history_T.values,
        data.history_mu_ratio.values,
        period=float(data.attrs["T_mean"]),
        mean=data.attrs.get("mu_ratio"),
        formula=transient.eq_16(data.attrs, settings),
        seconds=OperatingPoint.from_settings(settings).time_scale if scales else 0.0,
        ax=figure.axes[0],
    )
    return figure


def _extremes(data: xr.Dataset, scales: Scales | None, title: str) -> Figure:
    figure = _row(1, (6.4, 3.8), title)
    films = {"least film": data.history_H_min.values, "film at the centre": data.history_H_c.values}
    transient.extremes_history(
        data.history_T.values, data.history_P_max.values, films, scales, ax=figure.axes[0]
    )
    return figure


def prediction_figures(
    about: Mapping[str, Any],
    arrays: Mapping[str, Array],
    tables: Mapping[str, Mapping[str, Array]],
) -> dict[str, Figure]:
    """All figures of a prediction, by the names of their files.

    `about` is its summary; of the `tables` ``passage`` and ``bands`` are shown.
    """
    title = headline(about)
    figures: dict[str, Figure] = {}
    for prefix in ("", "second_") if "second_surface" in about else ("",):
        figures |= _side(about, arrays, prefix, title)
    if about["status"] == "predicted":
        figures["passage"] = _passage(tables, about["length_x_m"], title)
    return figures


def _side(
    about: Mapping[str, Any], arrays: Mapping[str, Array], prefix: str, title: str
) -> dict[str, Figure]:
    """Figures of the rough surface whose names begin with a prefix."""
    size = about[f"{prefix}length_x_m"], about[f"{prefix}length_y_m"]
    tile = Topography(arrays[f"{prefix}surface"], size, about[f"{prefix}surface"])
    deformed = arrays[f"{prefix}deformed"]
    figure = _row(3, (11.6, 3.2), title, room=(0.8, 1.9, 0.8))
    first, second, third = figure.axes
    third.set_box_aspect(1.0)
    surface.heights(tile, ax=first)
    surface.spectrum_map(tile, ax=second)
    flattened = _flattened(about, Topography(arrays[f"{prefix}delta_p"], size))
    surface.spectrum_line(tile, deformed, flattened, ax=third)
    figure.axes[-1].set_box_aspect(1.0)
    figures = {f"{prefix}surface_spectrum": figure}
    figure = _row(2, (7.2, 3.4), title, sharey=True, room=(0.75, 0.35, 1.15))
    for ax, values, name in zip(
        list(figure.axes),
        (tile.heights, deformed),
        ("(a) undeformed,", "(b) deformed,"),
        strict=True,
    ):
        last = values is deformed
        a = about["hertz_radius_m"]
        axes = a, about.get("semi_axis_y_m", a)
        surface.roughness(tile, values, axes, name=name, bar=last, ax=ax)
    _no_second_label(figure.axes[1])
    figures[f"{prefix}roughness"] = figure
    return figures


def _flattened(about: Mapping[str, Any], tile: Topography) -> Array:
    """Return what pressure [Pa] flattens of a tile [m]: it over E'|q|/4 of the half-space."""
    kernel_ratio = ellipse(about.get("radius_ratio", 1.0)).kernel_ratio
    stiff = stiffness(np.hypot(*wavenumbers(tile)) * about["hertz_radius_m"]) / kernel_ratio
    # the mean is not flattened
    stiff[0, 0] = np.inf
    unit = about["film_scale_m"] / about["hertz_pressure_Pa"]
    part = np.fft.rfft2(tile.heights) * unit / stiff
    return np.asarray(np.fft.irfft2(part, s=tile.shape))


def _passage(tables: Mapping[str, Mapping[str, Array]], length: float, title: str) -> Figure:
    figure = _row(2, (7.6, 3.2), title, room=(0.9, 1.05, 0.15))
    left, right = figure.axes
    shift, ratio = tables["passage"]["shift_m"], tables["passage"]["mu_ratio"]
    second = tables["passage"].get("second_shift_m")
    surface.passage(shift, ratio, length, second=second, ax=left)
    columns = [tables["bands"][name] for name in ("longest_m", "shortest_m", "rise")]
    surface.octaves(
        [(float(a), float(b), float(c)) for a, b, c in zip(*columns, strict=True)], ax=right
    )
    return figure
