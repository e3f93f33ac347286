# SPDX-License-Identifier: BSD-3-Clause
"""Where the film of a rough surface ends, and what would carry.

With a measured surface some pixel nearly always touches. That is said with its place, its depth
and its share of the contact, and the film is never clipped. What would carry is found by bisection
with the prediction itself, given as a function, so that nothing here depends on the model.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pyehl.surfaces.cutting import cropped
from pyehl.surfaces.prepare import Preparation
from pyehl.surfaces.spikes import prominence
from pyehl.surfaces.tile import Topography

__all__ = [
    "Advice",
    "BelowZero",
    "advise",
    "below_zero",
    "carrying_outliers",
    "carrying_wavelength",
]

Array = NDArray[np.float64]

Carries = Callable[[Topography], bool]
"""Whether the film of a tile is full."""

DeformedOf = Callable[[Topography], Array]
"""Deformed roughness of a tile on its pixels [m], (nx, ny)."""

SmoothFilm = Callable[[Array, Array], Array]
"""Smooth film [m] at x (m,) and y (n,) [m] from the centre of the contact, (m, n)."""

STATIONS = 64
"""Places along a row at which the smooth film is taken."""

FEW = 0.01
"""Largest share of a map that counts as a few spikes."""

LEAST_THRESHOLD = 5.0
"""Below it, points of a normal distribution would be taken for spikes."""


@dataclass(frozen=True, slots=True)
class BelowZero:
    """Where the film of a tile is below zero.

    Attributes
    ----------
    share
        Mean share of the Hertz area with a film below zero, over a whole passage of the tile [-].
    deepest
        Least film [m], not positive where the film ends.
    pixel
        (i, j) of the tile where it is.
    pixels
        Pixels of the tile with a film below zero that pass through the contact.
    """

    share: float
    deepest: float
    pixel: tuple[int, int]
    pixels: int


def below_zero(
    deformed: Array, pixel: tuple[float, float], hertz_radius: float, smooth_film: SmoothFilm
) -> BelowZero:
    """Find where the film over a tile is below zero.

    Every pixel of the tile within a of the track passes through the contact at some time, along its
    row, and meets the thinnest smooth film of that row. The share is the mean over the passage.
    The deformed roughness is taken to be that at the centre on the whole way.

    Parameters
    ----------
    deformed
        (nx, ny) deformed roughness [m]; row 0 passes through the centre.
    pixel
        Pixel size along x and y [m].
    hertz_radius
        a [m].
    smooth_film
        Takes x (m,) and y (n,) [m] from the centre and returns the smooth film there, (m, n) [m].

    Returns
    -------
    BelowZero
        Of the strip of the tile that passes through the contact.
    """
    ny = deformed.shape[1]
    reach = int(hertz_radius / pixel[1])
    row = np.arange(-reach, reach + 1)
    y = np.asarray(row * pixel[1], dtype=np.float64)
    x: Array = hertz_radius * ((2.0 * np.arange(STATIONS) + 1.0) / STATIONS - 1.0)
    inside = np.hypot(x[:, np.newaxis], y[np.newaxis, :]) < hertz_radius
    film = np.where(inside, smooth_film(x, y), np.inf)
    least = film.min(axis=0)
    top = deformed.max(axis=0)[row % ny]
    below = 0
    # a pixel may pass through the contact on several rows of a small tile
    limit = np.full(ny, np.inf)
    np.minimum.at(limit, row % ny, least)
    for k in np.nonzero(top > least)[0]:
        heights = np.sort(deformed[:, row[k] % ny])
        at = np.searchsorted(heights, film[inside[:, k], k], side="right")
        below += int((heights.size - at).sum())
    share = below / (deformed.shape[0] * int(inside.sum()))
    worst = int(np.argmin(least - top))
    j = int(row[worst] % ny)
    return BelowZero(
        share,
        float(least[worst] - top[worst]),
        (int(np.argmax(deformed[:, j])), j),
        int(np.count_nonzero(deformed > limit[np.newaxis, :])),
    )


def carrying_wavelength(
    tile: Topography,
    without_shorter: Callable[[Topography, float], Topography],
    carries: Carries,
    *,
    tolerance: float = 0.05,
) -> float | None:
    """Find the cut-off at which the film of a tile is full: waves shorter than it are taken off.

    Bisection in the logarithm of the wavelength, between two pixels and the length of the tile;
    the film need not be full for every longer cut-off, but it is for the one returned.

    Parameters
    ----------
    tile
        The tile, whose film is not full.
    without_shorter
        Takes a tile and a wavelength [m] and returns the tile without shorter waves.
    carries
        Whether the film of a tile is full.
    tolerance
        Relative, of the wavelength.

    Returns
    -------
    float or None
        [m]; None if even the longest waves break the film.
    """
    low = math.log(2.0 * min(tile.pixel))
    high = math.log(max(tile.length_x, tile.length_y))
    if not carries(without_shorter(tile, math.exp(high))):
        return None
    while high - low > tolerance:
        middle = 0.5 * (low + high)
        if carries(without_shorter(tile, math.exp(middle))):
            high = middle
        else:
            low = middle
    return _rounded_up(math.exp(high), lambda v: carries(without_shorter(tile, v)))


def carrying_outliers(
    prominence: Array,
    without_spikes: Callable[[float], Topography],
    carries: Carries,
    *,
    few: float = FEW,
    tolerance: float = 0.1,
) -> tuple[float, int] | None:
    """Find the threshold of spikes at which the film is full, if a few points are what breaks it.

    Parameters
    ----------
    prominence
        (nx, ny) distance of each point from the median around it over its spread, see
        :func:`pyehl.surfaces.spikes.prominence`.
    without_spikes
        Takes a threshold and returns the tile without the points beyond it.
    carries
        Whether the film of a tile is full.
    few
        Largest share of the points that may be removed.
    tolerance
        Relative, of the threshold.

    Returns
    -------
    (float, int) or None
        Threshold and number of points beyond it; None if the film needs more than a few removed.
    """
    allowed = float(np.quantile(prominence, 1.0 - few))
    low = max(LEAST_THRESHOLD, allowed)
    high = float(prominence.max())
    if low >= high or not carries(without_spikes(low)):
        return None
    least, most = math.log(low), math.log(high)
    while most - least > tolerance:
        middle = 0.5 * (least + most)
        if carries(without_spikes(math.exp(middle))):
            least = middle
        else:
            most = middle
    # a threshold that a person would write, on the safe side
    rounded = float(f"{math.exp(least):.2g}")
    if rounded > math.exp(least) or rounded < low or not carries(without_spikes(rounded)):
        rounded = math.exp(least)
    return rounded, int(np.count_nonzero(prominence > rounded))


def _rounded_up(value: float, good: Callable[[float], bool]) -> float:
    """Two digits of a wavelength, rounded up, if that is good, too."""
    scale = 10.0 ** (math.floor(math.log10(value)) - 1)
    rounded = float(f"{math.ceil(value / scale - 1e-9) * scale:.2g}")
    return rounded if good(rounded) else value


@dataclass(frozen=True, slots=True)
class Advice:
    """Where the film of a surface ends, and what would carry.

    Attributes
    ----------
    below
        Where the film is below zero.
    x, y
        Place of the deepest point on the surface [m]; of a prepared map from the corner of what
        was left of it after cropping and turning.
    wavelength
        `surface.shortest_wavelength` [m] with which the film is full; None: there is none.
    outliers, outlier_points
        `surface.outliers` with which it is full, and how many points that removes; None: the
        surface is no map, or more than a few points would have to go.
    """

    below: BelowZero
    x: float
    y: float
    wavelength: float | None
    outliers: float | None
    outlier_points: int | None

    def summary(self) -> dict[str, float | int | None]:
        """Return what ``summary.json`` holds of it."""
        return {
            "x_m": self.x,
            "y_m": self.y,
            "film_m": self.below.deepest,
            "pixels": self.below.pixels,
            "share_of_contact": self.below.share,
            "carrying_shortest_wavelength_m": self.wavelength,
            "carrying_outliers": self.outliers,
            "carrying_outliers_points": self.outlier_points,
        }

    def report(self) -> list[str]:
        """Return the lines that ``pyehl predict`` prints."""
        lines = [
            f"film ends   at x = {self.x * 1e3:.4g} mm, y = {self.y * 1e3:.4g} mm of the surface: "
            f"{-self.below.deepest * 1e6:.3g} um below zero; {self.below.pixels} pixels, "
            f"{100 * self.below.share:.3g} % of the contact in the mean over the passage"
        ]
        if self.outliers is not None:
            lines.append(
                f"would carry surface.outliers = {self.outliers:.4g}: "
                f"{self.outlier_points} points are spikes and go"
            )
        if self.wavelength is not None:
            lines.append(
                f"would carry surface.shortest_wavelength = {self.wavelength:.4g}: waves shorter "
                f"than {self.wavelength * 1e6:.3g} um go"
            )
        if self.outliers is None and self.wavelength is None:
            lines.append("would carry nothing that takes off spikes or short waves alone")
        return lines


def advise(
    tile: Topography,
    deformed_of: DeformedOf,
    hertz_radius: float,
    smooth_film: SmoothFilm,
    without_shorter: Callable[[Topography, float], Topography],
    without_spikes: Callable[[float], Topography] | None = None,
) -> Advice:
    """Say where the film of a tile ends, and find what would carry.

    Parameters
    ----------
    tile
        The tile, whose film is not full.
    deformed_of
        The prediction of its deformed roughness.
    hertz_radius
        a [m].
    smooth_film
        The smooth film, see :func:`below_zero`.
    without_shorter
        Takes a tile and a wavelength [m] and returns the tile without shorter waves.
    without_spikes
        Takes a threshold of `surface.outliers` and returns the tile without them; None: the
        surface is no map.
    """

    def film(other: Topography) -> BelowZero:
        return below_zero(deformed_of(other), other.pixel, hertz_radius, smooth_film)

    def carries(other: Topography) -> bool:
        return film(other).deepest > 0.0

    below = film(tile)
    made = tile.preparation
    i, j = below.pixel
    x, y = made.place(i, j) if made else (i * tile.pixel[0], j * tile.pixel[1])
    spikes: tuple[float, int] | None = None
    if made is not None and without_spikes is not None and not made.options.outliers > 0.0:
        spikes = _spikes(made, without_spikes, carries)
    return Advice(
        below, x, y,
        carrying_wavelength(tile, without_shorter, carries),
        *(spikes or (None, None)),
    )  # fmt: skip


def _spikes(
    made: Preparation, without_spikes: Callable[[float], Topography], carries: Carries
) -> tuple[float, int] | None:
    """Threshold that carries, and the number of points beyond it."""
    heights = made.scan.heights
    if any(made.options.crop):
        nx, ny = heights.shape
        pixel = (made.scan.length_x / nx, made.scan.length_y / ny)
        heights = cropped(heights, pixel, made.options.crop)
    try:
        away = prominence(heights)
    except ValueError:
        # no spread to tell spikes by
        return None
    return carrying_outliers(away, without_spikes, carries)
