# SPDX-License-Identifier: BSD-3-Clause
"""The positions in which two rough tiles meet as they pass a contact, each at its own speed.

Where they are back at their start after a few passages, the friction is that of this common period:
a line over all pairs of positions. Else they meet in all positions in the course of time, and a
lattice of points over these takes the mean: positions k/n of the one and m k/n of the other tile,
k = 0 ... n - 1, with n = m^2 - 1. As m^2 is 1 modulo n, it is the same for either order of the two.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import Any

import numpy as np

from pyehl.prediction.options import MAX_POSITIONS
from pyehl.prediction.passage import POSITION_TOLERANCE
from pyehl.surfaces import MAX_PIXELS, Topography, resampled, shifted
from pyehl.types import Array

Friction = Callable[[tuple[float, float]], float]
"""mu_r/mu_s where two tiles have moved by so much [a]."""

MOST_PASSAGES = 12
"""Passages of a tile in a common period that is followed: products of waves that have a mean over
a longer one are of that order."""
SAME = 1e-9
"""Relative difference of two times that is none."""
LATTICES = (9, 13, 19, 27)
"""m of the lattices of a mean over all positions, the next one where one is not enough."""
SHORT = 7
"""m of the lattice of a mean over a few positions."""
FEW = 16
"""Positions per passage of a mean over a few of them along a line."""
MOST = 12
"""Tiles beside each other, along one way, that are added to those of the other surface."""


def common_passages(
    lengths: tuple[float, float], velocity_ratios: tuple[float, float]
) -> tuple[int, int] | None:
    """Numbers of passages after which two tiles of these lengths are back; None: of no few."""
    one, other = (u / length for u, length in zip(velocity_ratios, lengths, strict=True))
    if one == 0.0 or other == 0.0:
        return int(one > 0.0), int(other > 0.0)
    ratio = one / other
    found = Fraction(ratio).limit_denominator(MOST_PASSAGES)
    if found.numerator > MOST_PASSAGES or not math.isclose(found, ratio, rel_tol=SAME):
        return None
    return found.numerator, found.denominator


@dataclass(frozen=True)
class Meeting:
    """Two tiles on the move: their lengths [a], their velocity ratios, and where they begin [a]."""

    lengths: tuple[float, float]
    velocity_ratios: tuple[float, float]
    fronts: tuple[float, float]

    @cached_property
    def passages(self) -> tuple[int, int] | None:
        """Passages of both in their common period; None: they meet in all positions."""
        return common_passages(self.lengths, self.velocity_ratios)

    def moved(self, k: int, n: int, m: int = 0) -> tuple[float, float]:
        """How far the tiles have moved at the k-th of n positions [a].

        Of the common period, or of the lattice of `m`, where it is that within a tile.
        """
        one, other = self.lengths
        if self.passages:
            return one * (self.passages[0] * k) / n, other * (self.passages[1] * k) / n
        return one * k / n, other * (m * k % n) / n

    def shifts(self, k: int, n: int, m: int = 0) -> tuple[float, float]:
        """Where the tiles begin at the k-th of n positions [a], as `moved`."""
        first, second = self.moved(k, n, m)
        return self.fronts[0] + first, self.fronts[1] + second

    def short_mean(self, friction: Friction) -> float:
        """Mean of mu_r/mu_s over a few positions."""
        passages = self.passages
        n = FEW * max(passages) if passages else SHORT**2 - 1
        return float(np.mean([friction(self.shifts(k, n, SHORT)) for k in range(n)]))

    def mean(
        self, friction: Friction, positions: int, largest: float
    ) -> tuple[Array, Array, Array, float]:
        """How far both have moved [a] (n,), mu_r/mu_s there, and what is undecided (relative).

        `positions`: how many, of a lattice the next larger number; 0: as many as it takes. No more
        are added to a mean above `largest`.
        """
        if self.passages:
            return self._along(friction, positions, largest)
        fewest = math.isqrt(positions) + 1 if positions else 0
        before = math.nan
        for m in [fewest] if positions else LATTICES:
            n = m * m - 1
            places = np.array([self.moved(k, n, m) for k in range(n)])
            ratios = np.array([friction(self.shifts(k, n, m)) for k in range(n)])
            mean = float(ratios.mean())
            error = _undecided(ratios)
            if not math.isfinite(mean) or mean > largest:
                break
            if not math.isnan(before):
                error = max(error, abs(mean - before) / mean)
                if error <= POSITION_TOLERANCE:
                    break
            before = mean
        return places[:, 0], places[:, 1], ratios, error

    def _along(
        self, friction: Friction, positions: int, largest: float
    ) -> tuple[Array, Array, Array, float]:
        n = positions or FEW * max(self.passages or ())
        ratios = np.array([friction(self.shifts(k, n)) for k in range(n)])
        error = _undecided(ratios)
        while not positions and error > POSITION_TOLERANCE and 2 * n <= MAX_POSITIONS:
            if float(ratios.mean()) > largest:
                break
            between = [friction(self.shifts(k, 2 * n)) for k in range(1, 2 * n, 2)]
            ratios = np.stack([ratios, between], axis=1).ravel()
            n, error = 2 * n, _undecided(ratios)
        places = np.array([self.moved(k, n) for k in range(n)])
        return places[:, 0], places[:, 1], ratios, error


def _undecided(ratios: Array) -> float:
    """Return what every second position would miss of the mean, relative to it.

    An upper estimate of what all of them leave undecided. NaN where there are not twice as many.
    """
    if ratios.size % 2:
        return math.nan
    halves = ratios[::2].mean(), ratios[1::2].mean()
    return float(0.5 * abs(halves[0] - halves[1]) / ratios.mean())


def sum_of(
    groups: Sequence[Mapping[str, Any]], tiles: Sequence[Topography], hertz_radius: float
) -> Topography | None:
    """Return the sum of the tiles of two groups of a case; None where they do not move together."""
    one, two = groups
    if float(one["velocity_ratio"]) != float(two["velocity_ratio"]):
        return None
    way = float(two["x_start"]) - float(one["x_start"])
    return as_one(tiles[0], tiles[1], way * hertz_radius)


def as_one(first: Topography, second: Topography, ahead: float) -> Topography | None:
    """Return a tile with the heights of two, the second one ahead by a way [m] along the motion.

    It holds whole tiles of both. None: not so few of both are as long, or they have too many
    pixels.
    """
    if ahead != 0.0:
        second = shifted(second, ahead)
    counts = [Fraction(b / a) for a, b in zip(first.size, second.size, strict=True)]
    counts = [ratio.limit_denominator(MOST) for ratio in counts]
    for ratio, a, b in zip(counts, first.size, second.size, strict=True):
        if ratio.numerator > MOST or not math.isclose(ratio * a, b, rel_tol=SAME):
            return None
    nx, ny = (
        max(ratio.numerator * m, ratio.denominator * n)
        for ratio, m, n in zip(counts, first.shape, second.shape, strict=True)
    )
    if nx * ny > MAX_PIXELS:
        return None
    first = _repeated(first, [ratio.numerator for ratio in counts])
    second = _repeated(second, [ratio.denominator for ratio in counts])
    heights = resampled(first, (nx, ny)).heights + resampled(second, (nx, ny)).heights
    return Topography(heights, first.size, f"{first.origin} and {second.origin}")


def _repeated(tile: Topography, times: Sequence[int]) -> Topography:
    """Return so many of a tile beside each other along x and y."""
    size = tile.length_x * times[0], tile.length_y * times[1]
    return replace(tile, heights=np.tile(tile.heights, times), size=size)
