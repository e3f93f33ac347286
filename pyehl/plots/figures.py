# SPDX-License-Identifier: BSD-3-Clause
"""Figures of a solution (film, pressure, friction in time) and of a prediction."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from pyehl import namelist
from pyehl.plots import contact, surface, transient
from pyehl.plots.outline import Outline
from pyehl.plots.panels import MARGIN, drop_second_label, drop_x_labels, headline, panels, rows
from pyehl.plots.style import (
    BLUE,
    THIN,
    VERMILLION,
    Scales,
    film_unit,
    nearest,
    pressure_unit,
    styled,
)
from pyehl.schema import summary_of
from pyehl.surfaces import Topography, wavenumbers
from pyehl.theory.ellipse import LINE, ellipse
from pyehl.theory.line_contact import scaling_contact
from pyehl.theory.transport import stiffness
from pyehl.types import Array

if TYPE_CHECKING:
    import xarray as xr


def scales_of(data: xr.Dataset, units: str = "auto") -> Scales | None:
    """Scales of a solution for `units`: 'si', 'hertz', or 'auto' for SI if the case has them."""
    point = scaling_contact(namelist.values(data.attrs["case"]))
    if units == "si" or (units == "auto" and point.si):
        thin = float(summary_of(data).get("H_c") or 0.0) * point.film_scale < THIN
        return Scales(point.hertz_radius, point.hertz_pressure, point.film_scale, thin)
    return None


def _maps(count: int, conditions: str, outline: Outline, lines: float = 0.0) -> Figure:
    """Make a figure with `count` maps of the contact, stacked for a slender one.

    `lines`: height over width of a panel below the maps of a slender contact; 0: none.
    """
    if not outline.slender:
        return panels(count, (1.0, 1.0 if count == 1 else 0.92), conditions, sharey=True)
    return rows([outline.shape(contact.VIEW)] * count + ([lines] if lines else []), conditions)


@styled()
def solution_figures(data: xr.Dataset, units: str = "auto") -> dict[str, Figure]:
    """All figures of a solution, by the names of their files.

    `units`: 'si', 'hertz', or 'auto' for SI when the case was given in SI.
    """
    scales = scales_of(data, units)
    title = headline(summary_of(data), scales)
    figures = {}
    line = summary_of(data).get("shape") == "line"
    if "P" in data and line:
        # a line has no map
        figures["pressure_and_film"] = _one_row(data, scales, title)
    elif "P" in data:
        figures["centre_lines"] = _centre_lines(data, scales, title)
        # fringes and contours need a positive film
        if data.H.values[nearest(data.X.values, 0.0), nearest(data.Y.values, 0.0)] > 0.0:
            figures["film"] = _film(data, scales, title)
    if "A_d" in data and not line:
        figures["deformed_roughness"] = _deformed(data, scales, title)
    if "A_d" in data:
        figures["rough_and_smooth"] = _rough_and_smooth(data, scales, title)
    if "history_t_s" in data and data.sizes["history"] > 1:
        figures["duty"] = _duty(data, title)
    elif "history_T" in data and data.sizes["history"] > 1:
        figures["friction"] = _friction(data, scales, title)
        if "P_rise_max" in summary_of(data):
            figures["extremes"] = _extremes(data, scales, title)
    return figures


def _centre_lines(data: xr.Dataset, scales: Scales | None, title: str) -> Figure:
    figure = panels(2, (1.0, 0.85), title)
    left, right = figure.axes
    x, y, p, h = (data[name].values for name in "XYPH")
    i, j = nearest(x, 0.0), nearest(y, 0.0)
    along, across = Outline.of(data).chords
    contact.pressure_and_film(x, p[:, j], h[:, j], scales, name="x", half=along, ax=left)
    contact.pressure_and_film(y, p[i, :], h[i, :], scales, name="y", half=across, ax=right)
    twins = [ax for ax in figure.axes if ax not in (left, right)]
    lines = [*left.get_lines(), *twins[0].get_lines()]
    figure.legend(handles=lines, loc="outside lower center", ncols=3)
    return figure


def _one_row(data: xr.Dataset, scales: Scales | None, title: str) -> Figure:
    """Pressure and film over x of a line contact, in the middle of its strip."""
    figure = panels(1, (1.0, 0.6), title)
    (ax,) = figure.axes
    row = nearest(data["Y"].values, 0.0)
    pressure, film = (data[name].values[:, row] for name in "PH")
    contact.pressure_and_film(data["X"].values, pressure, film, scales, ax=ax)
    lines = [line for axes in figure.axes for line in axes.get_lines()]
    figure.legend(handles=lines, loc="outside lower center", ncols=3)
    return figure


def _film(data: xr.Dataset, scales: Scales | None, title: str) -> Figure:
    """Film as fringes and as contours; for a slender contact also pressure and centre lines."""
    outline = Outline.of(data)
    figure = _maps(3 if outline.slender else 2, title, outline, lines=0.28)
    left, right, *more = figure.axes
    x, y, film = (data[name].values for name in "XYH")
    fringes = None
    if "H_smooth" in data:
        central = float(data.H_smooth.values[nearest(x, 0.0), nearest(y, 0.0)])
        fringes = contact.fringe_spacings(central * film_unit(scales)[0], scales)
    contact.interferogram(x, y, film, scales, fringes=fringes, outline=outline, ax=left)
    contact.contours(x, y, film, scales, outline=outline, ax=right)
    if more:
        pressure = data["P"].values
        contact.pressure_map(x, y, pressure, scales, outline=outline, ax=more[0])
        name, place, at = ("y", y, np.s_[nearest(x, 0.0), :]) if outline.turned else (
            "x", x, np.s_[:, nearest(y, 0.0)]
        )  # fmt: skip
        half = outline.chords[outline.turned]
        limits = left.get_xlim()
        contact.pressure_and_film(
            place, pressure[at], film[at], scales, name=name, half=half, ax=more[1]
        )
        more[1].set_xlim(limits)
        more[1].xaxis.set_major_locator(MaxNLocator(4))
        if not outline.turned:
            more[1].set_xlabel(left.get_xlabel())
        drop_x_labels(left, right, more[0])
    else:
        drop_second_label(right)
    return figure


def _deformed(data: xr.Dataset, scales: Scales | None, title: str) -> Figure:
    x, y, rough, deformed = (data[name].values for name in ("X", "Y", "RR", "A_d"))
    outline = Outline.of(data)
    figure = _maps(2, title, outline)
    top = transient.roughness_top(x, y, rough, deformed, outline=outline)
    names = ("(a) undeformed,", "(b) deformed,")
    for ax, field, name in zip(list(figure.axes), (rough, deformed), names, strict=True):
        transient.roughness(
            x, y, field, scales,
            top=top, name=name, bar=field is deformed, outline=outline, ax=ax,
        )  # fmt: skip
    _share_labels(list(figure.axes), outline)
    return figure


def _share_labels(axes: list[Axes], outline: Outline) -> None:
    """Remove repeated labels of two maps."""
    if outline.slender:
        drop_x_labels(axes[0])
    else:
        drop_second_label(axes[1])


def _rough_and_smooth(data: xr.Dataset, scales: Scales | None, title: str) -> Figure:
    figure = panels(2, (1.0, 0.85), title)
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
    figure = panels(1, (1.0, 0.75), title)
    settings, about = namelist.values(data.attrs["case"]), summary_of(data)
    transient.friction_history(
        data.history_T.values,
        data.history_mu_ratio.values,
        period=float(about["T_mean"]),
        mean=about.get("mu_ratio"),
        formula=transient.eq_16(about, settings),
        seconds=scaling_contact(settings).time_scale if scales else 0.0,
        ax=figure.axes[0],
    )
    return figure


def _extremes(data: xr.Dataset, scales: Scales | None, title: str) -> Figure:
    figure = panels(1, (1.0, 0.8), title)
    films = {
        "minimum film": data.history_H_min.values,
        "film at the centre": data.history_H_c.values,
    }
    transient.extremes_history(
        data.history_T.values, data.history_P_max.values, films, scales, ax=figure.axes[0]
    )
    return figure


def _duty(data: xr.Dataset, title: str) -> Figure:
    """Films over time, with those of steady contacts, above the conditions."""
    figure = rows([0.47, 0.26], title, MARGIN)
    upper, lower = figure.axes
    history, solved = (
        {str(n).removeprefix(table): data[n].values for n in data if str(n).startswith(table)}
        for table in ("history_", "steady_")
    )
    settings = namelist.values(data.attrs["case"])
    if "oil_layer" in history:
        history["layer"] = history["oil_layer"] / settings["inlet"]["film_hertz"]
    formula = None
    if not solved:
        formula = transient.quasi_static(history, settings, float(data.h_c_m))
    transient.duty_history(history, formula, solved or None, ax=upper)
    transient.duty_conditions(history, ax=lower)
    drop_x_labels(upper)
    return figure


def prediction_figures(
    about: Mapping[str, Any], arrays: Mapping[str, Array], tables: Mapping[str, Mapping[str, Array]]
) -> dict[str, Figure]:
    """All figures of a prediction, by the names of their files.

    `about` is its summary; the `tables` ``passage`` and ``bands`` are drawn.
    """
    return {name: draw() for name, draw in prediction_pictures(about, arrays, tables).items()}


def prediction_pictures(
    about: Mapping[str, Any], arrays: Mapping[str, Array], tables: Mapping[str, Mapping[str, Array]]
) -> dict[str, Callable[[], Figure]]:
    """Give functions that draw the figures of a prediction, by the names of their files."""
    title = headline(about)
    result: dict[str, Callable[[], Figure]] = {}
    for prefix in ("", "second_") if "second_surface" in about else ("",):
        of = about, arrays, prefix, title
        result[f"{prefix}surface_spectrum"] = partial(_spectra, *of)
        result[f"{prefix}roughness"] = partial(_roughness, *of)
    if about["status"] == "predicted":
        result["passage"] = partial(_passage, tables, about["length_x_m"], title)
    return result


@styled()
def _spectra(
    about: Mapping[str, Any], arrays: Mapping[str, Array], prefix: str, title: str
) -> Figure:
    """Draw heights and spectra of the rough surface with a prefix in its names."""
    tile, deformed = _tile(about, arrays, prefix), arrays[f"{prefix}deformed"]
    figure = panels(3, (1.0, 0.9), title, room=(0.55, 1.34, 0.65))
    first, second, third = figure.axes
    third.set_box_aspect(1.0)
    surface.heights(tile, ax=first)
    surface.spectrum_map(tile, ax=second)
    flattened = flattening(about, Topography(arrays[f"{prefix}delta_p"], tile.size))
    surface.spectrum_line(tile, deformed, flattened, ax=third)
    figure.axes[-1].set_box_aspect(1.0)
    return figure


@styled()
def _roughness(
    about: Mapping[str, Any], arrays: Mapping[str, Array], prefix: str, title: str
) -> Figure:
    """Draw the rough surface with a prefix in its names inside the contact."""
    tile, deformed = _tile(about, arrays, prefix), arrays[f"{prefix}deformed"]
    outline = Outline(about.get("ellipticity", 1.0))
    if outline.slender:
        figure = _maps(2, title, outline)
    else:
        figure = panels(2, (1.0, 0.85), title, sharey=True, room=(0.55, 0.25, 0.85))
    for ax, values, name in zip(
        list(figure.axes),
        (tile.heights, deformed),
        ("(a) undeformed,", "(b) deformed,"),
        strict=True,
    ):
        last = values is deformed
        a, kappa = about["hertz_radius_m"], about.get("ellipticity", 1.0)
        surface.roughness(tile, values, a, name=name, bar=last, ellipticity=kappa, ax=ax)
    _share_labels(list(figure.axes), outline)
    return figure


def _tile(about: Mapping[str, Any], arrays: Mapping[str, Array], prefix: str) -> Topography:
    """Return the undeformed surface with a prefix in its names."""
    size = about[f"{prefix}length_x_m"], about[f"{prefix}length_y_m"]
    return Topography(arrays[f"{prefix}surface"], size, about[f"{prefix}surface"])


def flattening(about: Mapping[str, Any], tile: Topography) -> Array:
    """Return the flattening [m] by a pressure [Pa] of a tile: p/(E'|q|/4)."""
    shape = LINE if about.get("shape") == "line" else ellipse(about.get("radius_ratio", 1.0))
    stiff = stiffness(np.hypot(*wavenumbers(tile)) * about["hertz_radius_m"]) / shape.kernel_ratio
    # the mean is not flattened
    stiff[0, 0] = np.inf
    unit = about["film_scale_m"] / about["hertz_pressure_Pa"]
    part = np.fft.rfft2(tile.heights) * unit / stiff
    return np.asarray(np.fft.irfft2(part, s=tile.shape))


@styled()
def _passage(tables: Mapping[str, Mapping[str, Array]], length: float, title: str) -> Figure:
    figure = panels(2, (1.0, 0.8), title, room=(0.7, 0.9, 0.1))
    left, right = figure.axes
    shift, ratio = tables["passage"]["shift_m"], tables["passage"]["mu_ratio"]
    second = tables["passage"].get("second_shift_m")
    surface.passage(shift, ratio, length, second=second, ax=left)
    columns = [tables["bands"][name] for name in ("longest_m", "shortest_m", "increase")]
    surface.octaves(
        [(float(a), float(b), float(c)) for a, b, c in zip(*columns, strict=True)], ax=right
    )
    return figure
