# SPDX-License-Identifier: BSD-3-Clause
"""Where the film of a rough surface ends, and what would carry.

With a measured surface some pixel nearly always touches. That is said with its place, its height
and its share of the contact, and the film is never clipped. What the film bears and what would
carry are given as functions, so that nothing here depends on the model.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from pyehl import lengths
from pyehl.prediction.carrying import Carries, carrying_outliers, carrying_wavelength
from pyehl.surfaces.cutting import cropped
from pyehl.surfaces.holes import prominence
from pyehl.surfaces.prepare import Preparation
from pyehl.surfaces.tile import Topography
from pyehl.types import Array

DeformedOf = Callable[[Topography], Array]
"""Deformed roughness of a tile on its pixels [m], (nx, ny)."""

Borne = Callable[[Array, Array], Array]
"""Deformed roughness that the smooth film bears [m] at x (m,) and y (n,) [m] from the centre of the
contact, (m, n): where it is higher the film ends."""

STATIONS = 64
"""Places along a row at which the smooth film is taken."""


@dataclass(frozen=True, slots=True)
class BelowZero:
    """Where the film of a tile ends."""

    # Mean share of the Hertz area where it has ended, over a whole passage of the tile [-]
    share: float
    # Least of what the film bears less the deformed roughness [m], not positive where the film ends
    deepest: float
    pixel: tuple[int, int]  # (i, j) of the tile where it is
    pixels: int  # pixels of the tile that pass through the contact and end the film


def below_zero(
    deformed: Array, pixel: tuple[float, float], semi_axes: tuple[float, float], borne: Borne
) -> BelowZero:
    """Find where the film over a tile ends, in the strip that passes through the contact.

    Every pixel of the tile within b of the track passes through the contact at some time, along
    its row, and meets the thinnest smooth film of that row. The share is the mean over the
    passage. The deformed roughness (nx, ny) [m], row 0 through the centre, is taken to be that at
    the centre on the whole way. Pixel size and the semi-axes a and b of the contact in m;
    `borne` says what the film bears.
    """
    ny = deformed.shape[1]
    a, b = semi_axes
    reach = int(b / pixel[1])
    row = np.arange(-reach, reach + 1)
    y = np.asarray(row * pixel[1], dtype=np.float64)
    x: Array = a * ((2.0 * np.arange(STATIONS) + 1.0) / STATIONS - 1.0)
    inside = np.hypot(x[:, np.newaxis], y[np.newaxis, :] * (a / b)) < a
    film = np.where(inside, borne(x, y), np.inf)
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


@dataclass(frozen=True, slots=True)
class Advice:
    """Where the film of a surface ends, and what would carry."""

    below: BelowZero
    # Place of the deepest point on the surface [m]; of a prepared map from the corner of what was
    # left of it after cropping and turning
    x: float
    y: float
    # `surface.shortest_wavelength` [m] with which the film is full, and the error of the predicted
    # friction known; None: there is none
    wavelength: float | None
    # `surface.outliers` with which both hold, and how many points that removes; None: the surface
    # is no map, or more than a few points would have to go
    outliers: float | None
    outlier_points: int | None
    # Options that take off what is no roughness, see :mod:`pyehl.surfaces.findings`: they come
    # first, and no wave or spike was looked for
    first: tuple[str, ...] = ()

    @property
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
            f"film ends  at x = {lengths.length(self.x, 4)}, y = {lengths.length(self.y, 4)} "
            f"of the surface: {-self.below.deepest * 1e9:.3g} nm higher than the film bears; "
            f"{self.below.pixels} pixels, "
            f"{100 * self.below.share:.3g} % of the contact in the mean over the passage"
        ]
        if self.first:
            lines += [first_of(option) for option in self.first]
            return lines
        if self.outliers is not None:
            lines.append(
                f"full film  with surface.outliers = {self.outliers:.4g}: "
                f"{self.outlier_points} points count as spikes and are removed"
            )
        if self.wavelength is not None:
            lines.append(
                f"full film  with surface.shortest_wavelength = {self.wavelength:.4g}: without "
                f"waves shorter than {lengths.length(self.wavelength, most='um')}"
            )
        if self.outliers is None and self.wavelength is None:
            lines.append("full film  with no cut of spikes or short waves alone")
        return lines


def advise(
    tile: Topography,
    deformed_of: DeformedOf,
    semi_axes: tuple[float, float],
    borne: Borne,
    without_shorter: Callable[[Topography, float], Topography],
    without_spikes: Callable[[float], Topography] | None = None,
    known: Carries | None = None,
) -> Advice:
    """Say where the film of a tile, which is not full, ends, and find what would carry.

    `without_shorter` takes a tile and a wavelength [m] and returns the tile without shorter waves,
    `without_spikes` a threshold of `surface.outliers` and returns the tile without them; None: the
    surface is no map. `known` tells whether the error of the predicted friction of a tile with a
    full film is known: what would carry must be worth a prediction, too.
    """

    def film(other: Topography) -> BelowZero:
        return below_zero(deformed_of(other), other.pixel, semi_axes, borne)

    def carries(other: Topography) -> bool:
        return film(other).deepest > 0.0 and (known is None or known(other))

    below = film(tile)
    made = tile.preparation
    x, y = place_of(tile, *below.pixel)
    if first := remedies_of(tile):
        return Advice(below, x, y, None, None, None, first)
    spikes: tuple[float, int] | None = None
    if made is not None and without_spikes is not None and not made.options.outliers > 0.0:
        spikes = _spikes(made, without_spikes, carries)
    return Advice(
        below, x, y,
        carrying_wavelength(
            2.0 * min(tile.pixel),
            max(tile.size),
            lambda shortest: carries(without_shorter(tile, shortest)),
        ),
        *(spikes or (None, None)),
    )  # fmt: skip


def remedies_of(tile: Topography) -> tuple[str, ...]:
    """Options that take form and line offsets off a map: cuts of waves would take them as well."""
    if tile.preparation is None:
        return ()
    found = tile.preparation.record.findings
    return tuple(f"{f.remedy} ({f.kind})" for f in found if f.kind in ("form", "line offsets"))


def first_of(remedy: str) -> str:
    """Line with an option that comes before all others."""
    return f"first      {remedy}: it is no roughness"


def place_of(tile: Topography, i: int, j: int) -> tuple[float, float]:
    """Place of a pixel on the surface [m]; of a prepared map on the map."""
    made = tile.preparation
    return made.place(i, j) if made else (i * tile.pixel[0], j * tile.pixel[1])


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
