# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of pressure and film: centre lines, fringes and contours.

Each function returns a figure; arrays have their first index along x.
"""

from __future__ import annotations

import math

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle
from numpy.typing import NDArray
from scipy.ndimage import zoom

from pyehl.plots.style import (
    BLUE,
    GREY,
    SEQUENTIAL,
    VERMILLION,
    Scales,
    axis_unit,
    edges,
    letter,
    nearest,
    new_figure,
)

__all__ = ["centre_lines", "film_maps"]

Array = NDArray[np.float64]

# Light and lubricant of the pseudo-interferogram: red laser line, mineral oil
LIGHT = 633e-9
REFRACTIVE_INDEX = 1.5
COHERENT_FRINGES = 8.0
# Half side of the film maps [a]
VIEW = 1.3


def centre_lines(
    x: Array, y: Array, pressure: Array, film: Array, scales: Scales | None = None
) -> Figure:
    """Pressure and film on the centre lines y = 0 and x = 0, with the Hertz ellipse.

    Parameters
    ----------
    x, y
        (nx,), (ny,) in Hertz radii.
    pressure, film
        P and H, (nx, ny), in Hertz units.
    scales
        For SI units; None for Hertz units.
    """
    figure = new_figure(7.2, 3.3)
    unit_p = 1.0 if scales is None else scales.pressure * 1e-9
    unit_h = 1.0 if scales is None else scales.film * 1e6
    label_p = r"$P = p/p_h$" if scales is None else r"$p$ [GPa]"
    label_h = r"$H = hR/a^2$" if scales is None else r"$h$ [$\mu$m]"
    i0, j0 = nearest(x, 0.0), nearest(y, 0.0)
    central = float(film[i0, j0]) * unit_h
    p_top = 1.08 * max(unit_p, float(pressure.max()) * unit_p)
    axes = list(figure.subplots(1, 2, sharey=True))
    twins: list[Axes] = []
    for ax, along, name, p, h in (
        (axes[0], x, "x", pressure[:, j0], film[:, j0]),
        (axes[1], y, "y", pressure[i0, :], film[i0, :]),
    ):
        unit, label = axis_unit(scales, name)
        hertz = np.linspace(-1.0, 1.0, 401)
        (dashed,) = ax.plot(
            hertz * unit, np.sqrt(1.0 - hertz**2) * unit_p, "--", color=GREY, lw=0.9, label="Hertz"
        )
        (solid,) = ax.plot(along * unit, p * unit_p, color=BLUE, lw=1.4, label="pressure")
        twin = ax.twinx()
        (thick,) = twin.plot(along * unit, h * unit_h, color=VERMILLION, lw=1.4, label="film")
        twin.set_ylim(0.0, 5.0 * central)
        twin.tick_params(axis="y", colors=VERMILLION)
        twins.append(twin)
        ax.set_xlim(along[0] * unit, along[-1] * unit)
        ax.set_ylim(0.0, p_top)
        ax.set_xlabel(label)
        ax.tick_params(axis="y", colors=BLUE)
        if name == "y":
            figure.legend(handles=[solid, dashed, thick], loc="outside lower center", ncols=3)
    axes[0].set_ylabel(label_p, color=BLUE)
    twins[1].set_ylabel(label_h, color=VERMILLION)
    twins[0].set_yticklabels([])
    letter(axes)
    return figure


def _round_step(value: float) -> float:
    """Return the 1, 2 or 5 times a power of ten nearest below a positive value."""
    power = 10.0 ** math.floor(math.log10(value))
    return max(step for step in (1.0, 2.0, 5.0) if step * power <= value * (1 + 1e-12)) * power


def film_maps(x: Array, y: Array, film: Array, scales: Scales | None = None) -> Figure:
    """Draw the film as a pseudo-interferogram and as contours.

    Parameters
    ----------
    x, y
        (nx,), (ny,) in Hertz radii.
    film
        H (nx, ny) in Hertz units.
    scales
        For SI units; the interferogram is then that of red light (633 nm) in oil, else its fringe
        is a round share of the central film.

    Raises
    ------
    ValueError
        If the film at the centre is not a positive number.
    """
    figure = new_figure(7.2, 3.3)
    axes = list(figure.subplots(1, 2, sharey=True))
    unit_x, label_x = axis_unit(scales, "x")
    _, label_y = axis_unit(scales, "y")
    unit = 1.0 if scales is None else scales.film * 1e6
    h = film * unit
    central = float(h[nearest(x, 0.0), nearest(y, 0.0)])
    if not (math.isfinite(central) and central > 0.0):
        raise ValueError(f"the film at the centre is {central:.4g}: no map of it can be drawn")
    if scales is None:
        fringe = _round_step(0.5 * central)
        caption = f"fringe $\\Delta H$ = {fringe:g}"
    else:
        fringe = 1e6 * LIGHT / (2.0 * REFRACTIVE_INDEX)
        caption = f"fringe {fringe:.3f} $\\mu$m ({LIGHT * 1e9:.0f} nm, n = {REFRACTIVE_INDEX:g})"
    inner_x, inner_y = np.abs(x) <= VIEW, np.abs(y) <= VIEW
    view = h[np.ix_(inner_x, inner_y)]
    factor = max(1, math.ceil(1200 / max(view.shape)))
    fine = zoom(view, factor, order=1, grid_mode=True, mode="nearest")
    extent = (
        *(v * unit_x for v in edges(x[inner_x])),
        *(v * unit_x for v in edges(y[inner_y])),
    )
    # Dark where the paths differ by whole wavelengths: the reflection at one face turns the
    # phase. Contrast fades with the film as under filtered light, before the screen aliases.
    contrast = np.exp(-((fine / (COHERENT_FRINGES * fringe)) ** 2))
    intensity = 0.5 * (1.0 - contrast * np.cos(2.0 * np.pi * fine / fringe))
    axes[0].imshow(
        intensity.T, origin="lower", extent=extent, cmap="gray", vmin=0.0, vmax=1.0,
        interpolation="antialiased",
    )  # fmt: skip
    axes[0].set_xlabel(label_x)
    axes[0].set_ylabel(label_y)
    axes[0].text(
        0.03, 0.03, caption, transform=axes[0].transAxes, fontsize="small",
        bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.85, "pad": 2.0},
    )  # fmt: skip

    least = float(h.min())
    step = _round_step(max((central - least) / 4.0, central / 20.0))
    first = step * math.floor(least / step)
    levels = np.arange(first, 1.6 * central + 0.5 * step, step)
    # what is thicker is the gap around the contact: left white
    shades = colormaps[SEQUENTIAL].with_extremes(over="white")
    filled = axes[1].contourf(x * unit_x, y * unit_x, h.T, levels=levels, cmap=shades, extend="max")
    axes[1].contour(
        x * unit_x, y * unit_x, h.T, levels=levels, colors="black", linewidths=0.3, alpha=0.6
    )
    bar = figure.colorbar(filled, ax=axes[1], shrink=0.9)
    bar.set_label(r"$H = hR/a^2$" if scales is None else r"$h$ [$\mu$m]")
    axes[1].set_xlabel(label_x)
    for ax in axes:
        ax.add_patch(Circle((0.0, 0.0), unit_x, fill=False, ls="--", lw=0.9, ec=VERMILLION))
        ax.set_aspect("equal")
        ax.set_xlim(max(x[0], -VIEW) * unit_x, min(x[-1], VIEW) * unit_x)
        ax.set_ylim(max(y[0], -VIEW) * unit_x, min(y[-1], VIEW) * unit_x)
        if scales is None:
            ax.set_xticks([-1.0, -0.5, 0.0, 0.5, 1.0])
            ax.set_yticks([-1.0, -0.5, 0.0, 0.5, 1.0])
    letter(axes)
    return figure
