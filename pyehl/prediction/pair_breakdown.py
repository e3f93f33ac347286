# SPDX-License-Identifier: BSD-3-Clause
"""Where the film between two rough surfaces ends, and what would carry.

Each point of the one meets points of the other on its line. Where the two have no short common
period, it meets all of them in the course of time.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from pyehl import lengths
from pyehl.prediction.breakdown import STATIONS, Borne, first_of, place_of, remedies_of
from pyehl.prediction.carrying import carrying_wavelength
from pyehl.prediction.pair import RoughPair
from pyehl.surfaces import GROUPS
from pyehl.types import Array

Pixels = tuple[tuple[int, int], tuple[int, int]]


@dataclass(frozen=True, slots=True)
class PairBelowZero:
    """Where the film between two tiles is nearest to its end."""

    # Mean share of the contact where it has ended, over the positions of the prediction [-]
    share: float
    # Least of what the film bears less the deformed roughness, wherever they meet [m]
    deepest: float
    pixels: Pixels  # (i, j) of each tile where it is


def pair_below_zero(pair: RoughPair, deformed: Sequence[Array], film: Borne) -> PairBelowZero:
    """Find the least film between two deformed tiles (nx, ny) [m], within b of their tracks.

    Over all positions in which they meet. As of a single surface, each is taken to be that at the
    centre on its whole way. The share is NaN: it needs the positions of a prediction.
    """
    a, b = pair.of[0].operating.semi_axes
    tiles = [one.topography for one in pair.of]
    pixel = min(tile.pixel[1] for tile in tiles)
    reach = int(b / pixel)
    y = np.asarray(np.arange(-reach, reach + 1) * pixel, dtype=float)
    x: Array = a * ((2.0 * np.arange(STATIONS) + 1.0) / STATIONS - 1.0)
    inside = np.hypot(x[:, np.newaxis], y[np.newaxis, :] * (a / b)) < a
    smooth = np.where(inside, film(x, y), np.inf)
    columns = [np.rint(y / tile.pixel[1]).astype(int) % tile.shape[1] for tile in tiles]
    heights = [values[:, column] for values, column in zip(deformed, columns, strict=True)]
    # the highest points of a line meet where its smooth film is least
    least = smooth.min(axis=0) - heights[0].max(axis=0) - heights[1].max(axis=0)
    j = int(np.argmin(least))
    deepest, rows = float(least[j]), [int(np.argmax(values[:, j])) for values in heights]
    if deepest <= 0.0 and pair.meeting.passages is not None:
        deepest, j, rows = _in_common_period(pair, heights, smooth, x / a)
    first, second = ((row, int(column[j])) for row, column in zip(rows, columns, strict=True))
    return PairBelowZero(math.nan, deepest, (first, second))


def _in_common_period(
    pair: RoughPair, heights: Sequence[Array], smooth: Array, x: Array
) -> tuple[float, int, list[int]]:
    """Least film [m] over a common period, the line where it is, and the rows of both there.

    By steps of a pixel. Heights (nx, m) and smooth film (n, m) [m] on the lines, at X (n,) [a].
    """
    a = pair.of[0].operating.hertz_radius
    meeting, order = pair.meeting, pair.order
    pixels = [one.topography.pixel[0] / a for one in pair.of]
    period = max(
        passages * length / u
        for passages, length, u in zip(
            meeting.passages or (), meeting.lengths, meeting.velocity_ratios, strict=True
        )
        if u > 0.0
    )
    steps = math.ceil(period * max(meeting.velocity_ratios) / min(pixels))
    found: tuple[float, int, list[int]] = (math.inf, 0, [0, 0])
    for k in range(steps):
        shifts = meeting.shifts(k, steps)
        rows = [
            np.rint((x - shifts[order.index(i)]) / pixels[i]).astype(int) % heights[i].shape[0]
            for i in (0, 1)
        ]
        film = smooth - heights[0][rows[0]] - heights[1][rows[1]]
        place = int(film.argmin())
        if film.flat[place] < found[0]:
            i, j = divmod(place, film.shape[1])
            found = float(film[i, j]), j, [int(row[i]) for row in rows]
    return found


@dataclass(frozen=True, slots=True)
class PairAdvice:
    """Where the film between two surfaces ends, and what would carry."""

    below: PairBelowZero
    places: tuple[tuple[float, float], tuple[float, float]]  # x, y on each surface [m]
    # `shortest_wavelength` [m] of the first, of the second, or of both with which the film is full;
    # None: there is none
    wavelengths: tuple[float | None, float | None, float | None]
    first: tuple[str, ...] = ()  # as of Advice

    @property
    def summary(self) -> dict[str, float | int | None]:
        """Return what ``summary.json`` holds of it."""
        (x, y), (second_x, second_y) = self.places
        first, second, both = self.wavelengths
        return {
            "x_m": x,
            "y_m": y,
            "second_x_m": second_x,
            "second_y_m": second_y,
            "film_m": self.below.deepest,
            "share_of_contact": self.below.share,
            "carrying_shortest_wavelength_m": first,
            "carrying_second_shortest_wavelength_m": second,
            "carrying_both_shortest_wavelength_m": both,
        }

    def report(self) -> list[str]:
        """Return the lines that ``pyehl predict`` prints."""
        places = " meets ".join(
            f"x = {lengths.length(x, 4)}, y = {lengths.length(y, 4)} of {group}"
            for group, (x, y) in zip(GROUPS, self.places, strict=True)
        )
        lines = [
            f"film ends  where {places}: {-self.below.deepest * 1e9:.3g} nm higher than the film "
            f"bears; {100 * self.below.share:.3g} % of the contact in the mean over the passage"
        ]
        if self.first:
            return lines + [first_of(option) for option in self.first]
        for name, length in zip((*GROUPS, "both"), self.wavelengths, strict=True):
            if length is not None:
                key = f"{name}{' ' if name == 'both' else '.'}shortest_wavelength"
                lines.append(
                    f"full film  with {key} = {length:.4g}: without waves shorter than "
                    f"{lengths.length(length, most='um')}"
                )
        if not any(self.wavelengths):
            lines.append("full film  with no cut of short waves alone")
        return lines


def advise_pair(pair: RoughPair, below: PairBelowZero, film: Borne) -> PairAdvice:
    """Say where the film of a pair, which is not full, ends, and find what would carry.

    What would carry has a prediction whose error is known, too.
    """

    def carries(numbers: Sequence[int]) -> Callable[[float], bool]:
        def good(shortest: float) -> bool:
            cut = pair.without_shorter(numbers, shortest)
            deformed = [response.deformed for response in cut.responses()]
            return pair_below_zero(cut, deformed, film).deepest > 0.0 and cut.known()

        return good

    places = [place_of(one.topography, *at) for one, at in zip(pair.of, below.pixels, strict=True)]
    remedies = tuple(
        option.replace("surface.", f"{group}.")
        for group, one in zip(GROUPS, pair.of, strict=True)
        for option in remedies_of(one.topography)
    )
    if remedies:
        return PairAdvice(below, (places[0], places[1]), (None, None, None), remedies)
    first, second, both = (
        _carrying(pair, numbers, carries(numbers)) for numbers in ((0,), (1,), (0, 1))
    )
    return PairAdvice(below, (places[0], places[1]), (first, second, both))


def _carrying(
    pair: RoughPair, numbers: Sequence[int], good: Callable[[float], bool]
) -> float | None:
    """Cut-off [m] of the surfaces so numbered at which the film is full."""
    tiles = [pair.of[k].topography for k in numbers]
    shortest = min(min(tile.pixel) for tile in tiles)
    longest = max(max(tile.size) for tile in tiles)
    return carrying_wavelength(2.0 * shortest, longest, good)
