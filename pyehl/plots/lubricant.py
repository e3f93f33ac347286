# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of lubricants: viscosity and shear stress of an oil, measured and fitted curves."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pyehl.plots.style import (
    BLUE,
    COLUMN,
    GREEN,
    PAGE,
    VERMILLION,
    letter,
    new_figure,
    points,
    styled,
)
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.shear import ShearLaw, shear_stress
from pyehl.types import Array

# Picture of an oil: temperature increases [K], pressures [Pa], maximum pressure [Pa]
RISES = (0.0, 20.0, 60.0)
PRESSURES = (1e8, 5e8, 1e9)
HIGHEST = 1.5e9
# Range of stresses [Pa]: Newtonian lines end at the largest that an oil sustains
STRESSES = (1e3, 2e8)
COLOURS = (BLUE, GREEN, VERMILLION)


@styled()
def draw_oil(
    name: str, lubricant: Lubricant, measured: tuple[float, float, float], limit: float | None
) -> Figure:
    """Draw eta over p at some temperatures, and tau over the shear rate at some pressures.

    `measured` are minimum and maximum temperature [degC] and maximum pressure [Pa] of the
    measurements, beyond which lines are dashed; infinite if they are not known. `limit` is the
    limiting shear stress over pressure, None if it is not known.
    """
    figure = new_figure(PAGE, 2.7)
    left, right = figure.subplots(1, 2)
    p = np.linspace(0.0, HIGHEST, 301)
    for rise, colour in zip(RISES, COLOURS, strict=True):
        eta = lubricant.viscosity * lubricant.viscosity_ratio(p, rise)
        temperature = lubricant.temperature + rise
        inside = measured[0] <= temperature <= measured[1]
        known = (p <= measured[2]) & inside
        label = f"{temperature:g} °C"
        left.semilogy(1e-9 * p[known], eta[known], color=colour, label=label)
        beyond = ~known if inside else p >= 0.0
        left.semilogy(1e-9 * p[beyond], eta[beyond], "--", color=colour, lw=1)
    left.set(xlabel="p [GPa]", ylabel=r"$\eta$ [Pa s]")
    left.legend(title="dashed: beyond the range", title_fontsize=8)
    law = ShearLaw() if limit is None else ShearLaw("limiting", limiting_coefficient=limit)
    rate = np.geomspace(1.0, 1e8, 200)
    for pressure, colour in zip(PRESSURES, COLOURS, strict=True):
        newtonian = lubricant.viscosity * float(lubricant.viscosity_ratio(pressure)) * rate
        sustained = newtonian <= STRESSES[1]
        right.loglog(rate[sustained], newtonian[sustained], ":", color=colour, lw=1)
        if limit is not None:
            tau = shear_stress(newtonian, pressure, law)
            right.loglog(rate, tau, color=colour, label=f"{1e-9 * pressure:g} GPa")
        else:
            right.plot([], [], ":", color=colour, label=f"{1e-9 * pressure:g} GPa")
    right.set_xlim(rate[0], rate[-1])
    right.set_ylim(*STRESSES)
    right.set(xlabel=r"$\dot\gamma$ [1/s]", ylabel=r"$\tau$ [Pa]")
    words = "Newtonian" if limit is None else f"dotted: Newtonian; limit {limit:g} p"
    title = f"{lubricant.temperature:g} °C; {words}"
    right.legend(title=title, loc="lower right", title_fontsize=8)
    letter([left, right])
    figure.set_label(name)
    return figure


@styled()
def draw_fit(
    slide_to_roll: Array, measured: Array, error: Array, curve: tuple[Array, Array], words: str
) -> Figure:
    """Draw a measured traction curve with its errors (n,), and a fitted one (SRR, friction)."""
    figure, ax = _measured_and_fitted(slide_to_roll, measured, error, curve, words)
    ax.set(xlabel="slide-to-roll ratio", ylabel=r"$\mu$")
    ax.set_xlim(left=0.0)
    ax.set_ylim(bottom=0.0)
    return figure


@styled()
def draw_film_fit(
    speeds: Array, measured: Array, error: Array, curve: tuple[Array, Array], words: str
) -> Figure:
    """Draw measured films [m] over speeds [m/s] with errors (n,), and fitted ones."""
    nm = 1e9
    fitted = curve[0], curve[1] * nm
    figure, ax = _measured_and_fitted(speeds, measured * nm, error * nm, fitted, words)
    ax.set(xscale="log", yscale="log", xlabel="mean velocity [m/s]", ylabel="central film [nm]")
    return figure


def _measured_and_fitted(
    places: Array, measured: Array, error: Array, curve: tuple[Array, Array], words: str
) -> tuple[Figure, Axes]:
    figure = new_figure(COLUMN, 2.5)
    ax = figure.subplots()
    marks = {"fmt": "k^", "ms": 4, "mfc": "none", "capsize": 2, "lw": 0.8}
    points(ax, places, measured, error, **marks)
    ax.plot([], [], "k^", mfc="none", label="measured")
    ax.plot(*curve, "o-", ms=3, color=BLUE, label=words)
    ax.legend()
    return figure, ax
