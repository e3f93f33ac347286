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
from matplotlib.cm import ScalarMappable
from matplotlib.colors import ListedColormap, Normalize

from pyehl.plots import style
from pyehl.plots.outline import CIRCLE, Outline
from pyehl.types import Array

# Light of the interferogram [m]: red and green, as in two-colour interferometry; mineral oil
RED, GREEN = 633e-9, 532e-9
REFRACTIVE_INDEX = 1.5
# Films [m] that this light resolves; for others the fringe spacing is a fraction of the film
MIN_FILM, MAX_FILM = 0.9e-7, 1.2e-6
RED_FRACTION = 0.9
# Number of fringes after which the contrast fades, as under filtered light
COHERENT_FRINGES = 8.0
# Half sides of the maps over those of the contact
VIEW = 1.3
# Maximum film of the colour scale over that at the centre
SHOWN = 1.6


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
    scales
        For SI units; None for Hertz units.
    name
        Name of the coordinate, 'x' or 'y'.
    half
        Half of the dry contact on this line; if it is infinite, no Hertz pressure is drawn.
    ax
        Axes; None: a new figure. The film has a second axis on the right.
    """
    ax = style.axes_or_new(ax, 4.2, 3.3)
    unit, label = style.axis_unit(scales, name)
    unit_p, label_p = style.pressure_unit(scales)
    unit_h, label_h = style.film_unit(scales)
    if math.isfinite(half):
        hertz = np.linspace(-1.0, 1.0, 401)
        place, dry = half * hertz * unit, np.sqrt(1.0 - hertz**2) * unit_p
        ax.plot(place, dry, "--", color=style.GREY, lw=0.9, label="Hertz")
    ax.plot(along * unit, pressure * unit_p, color=style.BLUE, lw=1.4, label="pressure")
    twin = ax.twinx()
    twin.plot(along * unit, film * unit_h, color=style.VERMILLION, lw=1.4, label="film")
    twin.set_ylim(0.0, 5.0 * float(film[style.nearest(along, 0.0)]) * unit_h)
    style.y_label(twin, label_h, style.VERMILLION)
    ax.set(xlim=(along[0] * unit, along[-1] * unit))
    ax.set(ylim=(0.0, 1.08 * max(unit_p, float(pressure.max()) * unit_p)), xlabel=label)
    style.y_label(ax, label_p, style.BLUE)
    return ax


def fringe_spacings(central: float, scales: style.Scales | None) -> tuple[float, float]:
    """Film difference between fringes in red and in green.

    Parameters
    ----------
    central
        Central film, in the unit of films with scales and in Hertz units without.
    """
    metre = 1.0 if scales is None else style.film_unit(scales)[0] / scales.film
    if scales is not None and MIN_FILM <= central / metre <= MAX_FILM:
        red, green = (metre * light / (2.0 * REFRACTIVE_INDEX) for light in (RED, GREEN))
        return red, green
    return RED_FRACTION * central, RED_FRACTION * central * GREEN / RED


def fringe_colours(film: Array, red: float, green: float) -> Array:
    """Colours (..., 3) of two-colour interference fringes over a film.

    Fringes are dark where the paths differ by whole wavelengths: the reflection at one face shifts
    the phase by pi. The contrast fades with the film as under filtered light, before aliasing.

    Parameters
    ----------
    film
        Any shape.
    red, green
        Film difference between fringes, in the unit of the film.
    """
    colours = np.zeros((*film.shape, 3))
    for channel, spacing in enumerate((red, green)):
        contrast = np.exp(-((film / (COHERENT_FRINGES * spacing)) ** 2))
        colours[..., channel] = 0.5 * (1.0 - contrast * np.cos(2.0 * np.pi * film / spacing))
    # some blue beside red lightens the dark green for readers who do not see red
    colours[..., 2] = 0.15 * colours[..., 0]
    # white beyond the last fringe
    faded = (1.0 - np.exp(-((film / (COHERENT_FRINGES * red)) ** 2)))[..., np.newaxis] ** 2
    return np.asarray(colours + faded * (1.0 - colours))


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
    ax.set_aspect("auto" if outline.ends else "equal")
    across, up, _ = outline.seen(x, y, np.empty((x.size, y.size)))
    wide, high = outline.view(VIEW)
    ax.set(xlim=(max(across[0], -wide) * unit, min(across[-1], wide) * unit))
    ax.set(ylim=(max(up[0], -high) * unit, min(up[-1], high) * unit))
    style.place_labels(ax, label_x, label_y, outline)
    if scales is None and not outline.slender:
        style.hertz_ticks(ax, outline)
    else:
        style.few_ticks(ax)


def pressure_map(
    x: Array,
    y: Array,
    pressure: Array,
    scales: style.Scales | None = None,
    *,
    outline: Outline = CIRCLE,
    ax: Axes | None = None,
) -> Axes:
    """Pressure P (nx, ny) as a map with a colour bar; other arguments as in `contours`."""
    ax = style.axes_or_new(ax, 4.2, 3.6)
    unit_p, label = style.pressure_unit(scales)
    unit, _ = style.axis_unit(scales, "x")
    across, up, seen = outline.seen(x, y, pressure * unit_p)
    image = ax.imshow(
        seen.T, origin="lower", extent=style.extent_of(across, up, unit), cmap=style.SEQUENTIAL
    )
    _bar(image, ax, label, outline)
    _frame(ax, x, y, scales, outline)
    return ax


def _bar(image: ScalarMappable, ax: Axes, label: str, outline: Outline) -> None:
    style.colour_bar(image, ax, label, slender=outline.shape(VIEW))


def interferogram(
    x: Array,
    y: Array,
    film: Array,
    scales: style.Scales | None = None,
    *,
    fringes: tuple[float, float] | None = None,
    outline: Outline = CIRCLE,
    ax: Axes | None = None,
) -> Axes:
    """Film as interference fringes in red and green, with their scale.

    Parameters
    ----------
    x, y
        (nx,), (ny,) in Hertz radii.
    film
        H (nx, ny) in Hertz units.
    scales
        For SI units; the fringes are then those of light of 633 and 532 nm in oil, unless the film
        is too thin or too thick. Otherwise the spacing is a fraction of the central film.
    fringes
        Result of `fringe_spacings`, common to several films; None: that of this film.
    outline
        Outline of the dry contact.

    Raises
    ------
    ValueError
        If the film at the centre is not a positive number and `fringes` are not given.
    """
    ax = style.axes_or_new(ax, 4.2, 3.6)
    unit_h, label = style.film_unit(scales)
    unit, _ = style.axis_unit(scales, "x")
    h = film * unit_h
    central = _central(x, y, h) if fringes is None else 0.0
    red, green = fringes or fringe_spacings(central, scales)
    across, up, seen = outline.seen(x, y, h)
    wide, high = outline.view(VIEW)
    columns, rows = np.abs(across) <= wide, np.abs(up) <= high
    seen = seen[np.ix_(columns, rows)]
    factor = max(1, math.ceil(900 / max(seen.shape)))
    fine = scipy.ndimage.zoom(seen, factor, order=1, grid_mode=True, mode="nearest")
    extent = style.extent_of(across[columns], up[rows], unit)
    colours = fringe_colours(fine, red, green).transpose(1, 0, 2)
    ax.imshow(colours, origin="lower", extent=extent, interpolation="antialiased")
    top = SHOWN * (central or red / RED_FRACTION)
    shades = ListedColormap(fringe_colours(np.linspace(0.0, top, 512), red, green))
    _bar(ScalarMappable(Normalize(0.0, top), shades), ax, label, outline)
    _frame(ax, x, y, scales, outline)
    return ax


def contours(
    x: Array,
    y: Array,
    film: Array,
    scales: style.Scales | None = None,
    *,
    outline: Outline = CIRCLE,
    ax: Axes | None = None,
) -> Axes:
    """Film as contours with a colour bar; the thicker gap around the contact is white.

    Parameters
    ----------
    x, y
        (nx,), (ny,) in Hertz radii.
    film
        H (nx, ny) in Hertz units.
    scales
        For SI units; None for Hertz units.
    outline
        Outline of the dry contact.

    Raises
    ------
    ValueError
        If the film at the centre is not a positive number.
    """
    ax = style.axes_or_new(ax, 4.2, 3.6)
    unit_h, label = style.film_unit(scales)
    unit, _ = style.axis_unit(scales, "x")
    h = film * unit_h
    central, minimum = _central(x, y, h), float(h.min())
    step = style.round_below(max((central - minimum) / 4.0, central / 20.0))
    first = step * math.floor(minimum / step)
    levels = np.arange(first, SHOWN * central + 0.5 * step, step)
    shades = colormaps[style.SEQUENTIAL].with_extremes(over="white")
    across, up, seen = outline.seen(x * unit, y * unit, h)
    filled = ax.contourf(across, up, seen.T, levels=levels, cmap=shades, extend="max")
    ax.contour(across, up, seen.T, levels=levels, colors="black", linewidths=0.3, alpha=0.6)
    _bar(filled, ax, label, outline)
    _frame(ax, x, y, scales, outline)
    return ax
