# SPDX-License-Identifier: BSD-3-Clause
"""Film and pressure around a bearing, or along a path of contact."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from pyehl.plots.style import BLUE, GREEN, GREY, PAGE, VERMILLION, new_figure, styled

LABELS = {"h_c_m": r"$h_\mathrm{c}$", "h_min_m": r"$h_\mathrm{min}$"}
COLOURS = {"inner": BLUE, "outer": VERMILLION}


@styled()
def figure(kind: str, table: pd.DataFrame, summary: Mapping[str, Any]) -> Figure:
    """Draw the table of a machine element.

    A 'bearing' has panels of film and p_h over the azimuth, for both rings; a 'gear' has panels of
    film, p_h, slide-to-roll ratio and friction along the path of contact.
    """
    return _bearing(table, summary) if kind == "bearing" else _gear(table, summary)


def _bearing(table: pd.DataFrame, summary: Mapping[str, Any]) -> Figure:
    made = new_figure(PAGE, 2.8)
    film, pressure = made.subplots(1, 2)
    for ring, part in table.groupby("ring", sort=False):
        azimuth = (part["azimuth_deg"] + 180.0) % 360.0 - 180.0
        order = np.argsort(azimuth.to_numpy())
        x = azimuth.to_numpy()[order]
        colour = COLOURS[str(ring)]
        for name, line in (("h_c_m", "-"), ("h_min_m", "--")):
            y = part[name].to_numpy(float)[order] * 1e9
            film.plot(x, y, f"o{line}", ms=3, color=colour, label=f"{LABELS[name]}, {ring} ring")
        y = part["hertz_pressure_Pa"].to_numpy(float)[order] * 1e-9
        pressure.plot(x, y, "o-", ms=3, color=colour, label=f"{ring} ring")
    _sigma(film, summary)
    film.set(ylabel="film [nm]", ylim=(0.0, None))
    pressure.set(ylabel=r"$p_\mathrm{h}$ [GPa]", ylim=(0.0, None))
    for ax in (film, pressure):
        ax.set(xlabel="azimuth from the radial load [deg]")
        ax.legend()
    return made


def _gear(table: pd.DataFrame, summary: Mapping[str, Any]) -> Figure:
    made = new_figure(PAGE, 4.6)
    (film, pressure), (slide, friction) = made.subplots(2, 2, sharex=True)
    x = table["s_m"].to_numpy(float) * 1e3
    friction.margins(y=0.15)
    for ax, name, factor, label, colour in (
        (film, "h_c_m", 1e9, LABELS["h_c_m"], BLUE),
        (film, "h_min_m", 1e9, LABELS["h_min_m"], VERMILLION),
        (pressure, "hertz_pressure_Pa", 1e-9, "p_h", BLUE),
        (slide, "slide_to_roll", 1.0, "SRR", BLUE),
        (friction, "mu", 1.0, "mu", GREEN),
    ):
        if name in table:
            ax.plot(x, table[name].to_numpy(float) * factor, color=colour, label=label)
    _sigma(film, summary)
    film.set(ylabel="film [nm]", ylim=(0.0, None))
    film.legend()
    pressure.set(ylabel=r"$p_\mathrm{h}$ [GPa]", ylim=(0.0, None))
    slide.set(ylabel="slide-to-roll ratio")
    friction.set(ylabel="coefficient of friction", ylim=(0.0, None))
    for ax in (slide, friction):
        ax.set(xlabel="path of contact from the pitch point [mm]")
    for ax in (film, pressure, slide, friction):
        ax.axvline(0.0, lw=0.6, color=GREY)
    return made


def _sigma(ax: Any, summary: Mapping[str, Any]) -> None:  # noqa: ANN401 (axes)
    """Mark three times the rms height, Lambda = 3."""
    # not if the films would be flat lines beside it
    if 0.0 < 3e9 * summary["rms_height_m"] < 1.5 * ax.get_ylim()[1]:
        ax.axhline(3e9 * summary["rms_height_m"], lw=0.8, ls=":", color=GREY, label="Λ = 3")
