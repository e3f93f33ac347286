# SPDX-License-Identifier: BSD-3-Clause
"""Pressure and film of a contact: lines, interference fringes, contours.

Each function draws on `ax`, or on a new figure, and returns the axes; arrays have their first
index along x, the direction of motion. Units as in `pyehl.plots.style`.
"""

import math

import numpy as np
import scipy
from matplotlib import colormaps
from matplotlib.axes import Axes

from pyehl.plots import style
from pyehl.plots.outline import CIRCLE, Outline
from pyehl.types import Array

# Light of the interferogram [m]: red and green, as in two-colour interferometry; mineral oil
RED, GREEN = 633e-9, 532e-9
REFRACTIVE_INDEX = 1.5
# Films [m] whose fringes this light distinguishes; for others the fringes are a share of the film
THINNEST, THICKEST = 0.9e-7, 1.2e-6
RED_SHARE = 0.9
# Fringes after which the contrast has faded, as under filtered light
COHERENT_FRINGES = 8.0
# Half side of the film maps [a]
VIEW = 1.3
# Maps that are so much higher than broad have few ticks, and captions of several lines
SLENDER = 3.0


def pressure_and_film(
    along: Array,
    pressure: Array,
    film: Array,
    scales: style.Scales | None = None,
    *,
    name: str = "x",
    half: float = 1.0,
    ax: Axes | None = None,
) -> Axes:
    """Pressure and film on a line through the centre, with the Hertz pressure.

    Parameters
    ----------
    along
        (n,) coordinate in Hertz radii.
    pressure, film
        P and H, (n,), in Hertz units.
    name
        Of the coordinate, 'x' or 'y'.
    half
        Half of the dry contact on this line.
    ax
        Where to draw; None: a new figure. The film has a second axis on the right.
    """
    ax = style.axes_or_new(ax, 4.2, 3.3)
    unit, label = style.axis_unit(scales, name)
    unit_p, label_p = style.pressure_unit(scales)
    unit_h, label_h = style.film_unit(scales)
    hertz = np.linspace(-1.0, 1.0, 401)
    ax.plot(
        half * hertz * unit,
        np.sqrt(1.0 - hertz**2) * unit_p,
        "--",
        color=style.GREY,
        lw=0.9,
        label="Hertz",
    )
    ax.plot(along * unit, pressure * unit_p, color=style.BLUE, lw=1.4, label="pressure")
    twin = ax.twinx()
    twin.plot(along * unit, film * unit_h, color=style.VERMILLION, lw=1.4, label="film")
    twin.set_ylim(0.0, 5.0 * float(film[style.nearest(along, 0.0)]) * unit_h)
    style.y_label(twin, label_h, style.VERMILLION)
    ax.set(xlim=(along[0] * unit, along[-1] * unit))
    ax.set(ylim=(0.0, 1.08 * max(unit_p, float(pressure.max()) * unit_p)), xlabel=label)
    style.y_label(ax, label_p, style.BLUE)
    return ax


def fringe_spacings(central: float, scales: style.Scales | None) -> tuple[float, float, str]:
    """Difference in film from fringe to fringe in red and in green, and a caption.

    Parameters
    ----------
    central
        Central film, in um with scales and in Hertz units without.
    """
    if scales is not None and THINNEST <= central * 1e-6 <= THICKEST:
        red, green = (1e6 * light / (2.0 * REFRACTIVE_INDEX) for light in (RED, GREEN))
        return red, green, f"{RED * 1e9:.0f} and {GREEN * 1e9:.0f} nm, n = {REFRACTIVE_INDEX:g}"
    red, green = RED_SHARE * central, RED_SHARE * central * GREEN / RED
    of = "ΔH" if scales is None else "Δh [µm]"
    return red, green, f"fringes {of} = {red:.2g} and {green:.2g}"


def fringe_colours(film: Array, red: float, green: float) -> Array:
    """Colours (..., 3) of two-colour interference fringes over a film.

    Dark where the paths differ by whole wavelengths: the reflection at one face turns the phase.
    Contrast fades with the film as under filtered light, before the screen aliases.

    Parameters
    ----------
    film
        Any shape.
    red, green
        Difference in film from fringe to fringe, in the unit of the film.
    """
    colours = np.zeros((*film.shape, 3))
    for channel, spacing in enumerate((red, green)):
        contrast = np.exp(-((film / (COHERENT_FRINGES * spacing)) ** 2))
        colours[..., channel] = 0.5 * (1.0 - contrast * np.cos(2.0 * np.pi * film / spacing))
    # a little of the red light lightens the dark green for those who see no red
    colours[..., 2] = 0.15 * colours[..., 0]
    return colours


def _central(x: Array, y: Array, h: Array) -> float:
    central = float(h[style.nearest(x, 0.0), style.nearest(y, 0.0)])
    if not (math.isfinite(central) and central > 0.0):
        raise ValueError(f"the film at the centre is {central:.4g}: no map of it can be drawn")
    return central


def _frame(ax: Axes, x: Array, y: Array, scales: style.Scales | None, outline: Outline) -> None:
    """Hertz ellipse, limits and labels of a map."""
    unit, label_x = style.axis_unit(scales, "x")
    _, label_y = style.axis_unit(scales, "y")
    ax.add_patch(outline.patch(unit, ls="--", lw=0.9, ec=style.VERMILLION))
    along, across = (VIEW * reach for reach in outline.reach)
    ax.set_aspect("equal")
    ax.set(xlim=(max(x[0], -along) * unit, min(x[-1], along) * unit))
    ax.set(ylim=(max(y[0], -across) * unit, min(y[-1], across) * unit), xlabel=label_x)
    ax.set(ylabel=label_y)
    if scales is None:
        style.hertz_ticks(ax, outline)
    elif outline.slender > SLENDER:
        ax.locator_params(axis="x", nbins=2)
        ax.tick_params(axis="x", rotation=90)


def pressure_map(
    x: Array,
    y: Array,
    pressure: Array,
    scales: style.Scales | None = None,
    *,
    outline: Outline = CIRCLE,
    ax: Axes | None = None,
) -> Axes:
    """Pressure P (nx, ny) as a map with a colour bar; other arguments as of `contours`."""
    ax = style.axes_or_new(ax, 4.2, 3.6)
    unit_p, label = style.pressure_unit(scales)
    unit, _ = style.axis_unit(scales, "x")
    image = ax.imshow(
        pressure.T * unit_p,
        origin="lower",
        extent=style.extent_of(x, y, unit),
        cmap=style.SEQUENTIAL,
    )
    style.colour_bar(image, ax, label, shrink=0.9, slender=outline.slender)
    _frame(ax, x, y, scales, outline)
    return ax


def interferogram(
    x: Array,
    y: Array,
    film: Array,
    scales: style.Scales | None = None,
    *,
    fringes: tuple[float, float, str] | None = None,
    outline: Outline = CIRCLE,
    ax: Axes | None = None,
) -> Axes:
    """Film as interference fringes in red and green.

    Parameters
    ----------
    x, y
        (nx,), (ny,) in Hertz radii.
    film
        H (nx, ny) in Hertz units.
    scales
        For SI units; the fringes are then those of light of 633 and 532 nm in oil, unless the film
        is too thin or too thick for them. Else they are a share of the central film.
    fringes
        As `fringe_spacings` gives them, for several films in the same light; None: for this film.
    outline
        Of the dry contact.

    Raises
    ------
    ValueError
        If the film at the centre is not a positive number and `fringes` are not given.
    """
    ax = style.axes_or_new(ax, 3.6, 3.6)
    unit_h, _ = style.film_unit(scales)
    unit, _ = style.axis_unit(scales, "x")
    h = film * unit_h
    red, green, caption = fringes or fringe_spacings(_central(x, y, h), scales)
    inner_x, inner_y = (
        np.abs(place) <= VIEW * reach for place, reach in zip((x, y), outline.reach, strict=True)
    )
    view = h[np.ix_(inner_x, inner_y)]
    factor = max(1, math.ceil(900 / max(view.shape)))
    fine = scipy.ndimage.zoom(view, factor, order=1, grid_mode=True, mode="nearest")
    extent = style.extent_of(x[inner_x], y[inner_y], unit)
    colours = fringe_colours(fine, red, green).transpose(1, 0, 2)
    ax.imshow(colours, origin="lower", extent=extent, interpolation="antialiased")
    if outline.slender > SLENDER:
        caption = caption.replace(" and ", " and\n").replace(", ", ",\n")
    ax.text(
        0.03, 0.03, caption, transform=ax.transAxes, fontsize="small",
        bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.85, "pad": 2.0},
    )  # fmt: skip
    _frame(ax, x, y, scales, outline)
    return ax


def _round_step(value: float) -> float:
    """Return the 1, 2 or 5 times a power of ten nearest below a positive value."""
    power = 10.0 ** math.floor(math.log10(value))
    return max(step for step in (1.0, 2.0, 5.0) if step * power <= value * (1 + 1e-12)) * power


def contours(
    x: Array,
    y: Array,
    film: Array,
    scales: style.Scales | None = None,
    *,
    outline: Outline = CIRCLE,
    ax: Axes | None = None,
) -> Axes:
    """Film as contours with a colour bar; what is thicker is the gap around, left white.

    Parameters
    ----------
    x, y
        (nx,), (ny,) in Hertz radii.
    film
        H (nx, ny) in Hertz units.
    outline
        Of the dry contact.

    Raises
    ------
    ValueError
        If the film at the centre is not a positive number.
    """
    ax = style.axes_or_new(ax, 4.2, 3.6)
    unit_h, label = style.film_unit(scales)
    unit, _ = style.axis_unit(scales, "x")
    h = film * unit_h
    central, least = _central(x, y, h), float(h.min())
    step = _round_step(max((central - least) / 4.0, central / 20.0))
    first = step * math.floor(least / step)
    levels = np.arange(first, 1.6 * central + 0.5 * step, step)
    shades = colormaps[style.SEQUENTIAL].with_extremes(over="white")
    filled = ax.contourf(x * unit, y * unit, h.T, levels=levels, cmap=shades, extend="max")
    ax.contour(x * unit, y * unit, h.T, levels=levels, colors="black", linewidths=0.3, alpha=0.6)
    style.colour_bar(filled, ax, label, shrink=0.9, slender=outline.slender)
    _frame(ax, x, y, scales, outline)
    return ax
