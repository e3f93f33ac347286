# SPDX-License-Identifier: BSD-3-Clause
"""The positions of one or two rough tiles as they pass a contact, and means over them.

The positions of one tile repeat after its length. Two tiles move at different speeds. If their
positions repeat after a few passages, friction is averaged over this common period: a line in the
plane of all pairs of positions. Otherwise all relative positions occur in the course of time, and
the mean is taken over a lattice: positions k/n of one and m k/n of the other tile, k = 0 ... n - 1,
with n = m^2 - 1. Because m^2 is 1 modulo n, the lattice is the same for either order of the two.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Protocol

import numpy as np

from pyehl.prediction.moving_tile import Position
from pyehl.prediction.spectrum import FIRST_POSITIONS, MAX_POSITIONS
from pyehl.surfaces import interpolated
from pyehl.surfaces.pair import SAME
from pyehl.types import Array

Ratios = Callable[[Sequence[Position]], Sequence[float]]
"""mu_r/mu_s at some positions."""

POSITION_TOLERANCE = 2e-3
"""Relative error of half of the positions below which no more are added: a fifth of the constant
part of the error of the model (:data:`pyehl.prediction.model.CONSTANT`)."""
EXTREMES = 32
"""Number of positions for minimum film and maximum pressure increase: with twice as many these
differ by at most 1 % (docs/evidence/thinning)."""

MAX_PASSAGES = 12
"""Maximum number of passages of a tile in a common period: over a longer one only products of waves
of that order have a mean."""
LATTICES = (9, 13, 19, 27)
"""m of successive lattices for a mean over all positions, each with about twice as many positions
as the one before."""
SHORT_LATTICE = 7
"""m of the lattice for a mean over a few positions: over its 48 positions no product of waves, up
to the third of each of the two tiles, has a mean."""
PER_PASSAGE = 16
"""Number of positions per passage in a common period, for a mean over a few positions and initially
for the full mean: half and twice as many change mu_r/mu_s of two fractal surfaces by at most 0.06
%."""


class MovingContact(Protocol):
    """A contact under moving surfaces."""

    def frictions(self, positions: Sequence[Position]) -> list[float]:
        """mu_r/mu_s at some positions; minimum film and maximum pressure increase are updated."""

    def observe(self, positions: Sequence[Position]) -> None:
        """Update minimum film and maximum pressure increase by some positions."""


@dataclass(frozen=True, slots=True)
class Passage:
    """mu_r/mu_s at all positions of a passage."""

    shifts: tuple[Array, ...]  # displacement of each tile (n,) [m]
    ratios: Array  # (n,)
    # Relative error with half of the positions, of one tile that of the interpolation, of two that
    # of the mean; NaN: not known
    undecided: float
    periodic: bool = True  # whether the positions are successive and periodic


@dataclass(frozen=True, slots=True)
class TilePositions:
    """Positions of one tile, displaced by whole pixels over its length."""

    pixels: int
    pixel: float  # [m]

    def short_mean(self, ratios: Ratios, track: int = 0) -> float:
        """Mean of mu_r/mu_s over a few positions, on a track displaced by some pixels."""
        steps = np.arange(FIRST_POSITIONS) * (self.pixels // FIRST_POSITIONS)
        return float(np.mean(ratios([(int(step), track) for step in steps])))

    def passage(self, contact: MovingContact, positions: int, largest: float) -> Passage:
        """Give mu_r/mu_s at equally spaced positions over the length of the tile.

        `positions` is their number; 0: as many as the tolerance requires, without refinement if the
        mean is above `largest`.
        """
        n, error = positions or FIRST_POSITIONS, math.nan
        steps = np.arange(n) * (self.pixels // n)
        ratios = np.array(contact.frictions([(int(step), 0) for step in steps]))
        while np.all(np.isfinite(ratios)):
            error = self._undecided(ratios)
            enough = error <= POSITION_TOLERANCE or float(ratios.mean()) > largest
            if positions or enough or self.pixels % (2 * n) or 2 * n > MAX_POSITIONS:
                break
            between = steps + self.pixels // (2 * n)
            more = contact.frictions([(int(step), 0) for step in between])
            ratios = np.stack([ratios, more], 1).ravel()
            steps, n, error = np.stack([steps, between], 1).ravel(), 2 * n, math.nan
        if not positions:
            self._find_extremes(contact, n)
        return Passage((np.asarray(steps * self.pixel, dtype=float),), ratios, error)

    def _find_extremes(self, contact: MovingContact, n: int) -> None:
        """Evaluate positions between the `n` of the friction, as many as the extremes require."""
        spacing = self.pixels // n
        between = max(1, EXTREMES // n)
        while spacing % between:
            between -= 1
        for part in range(1, between):
            more = part * (spacing // between)
            contact.observe([(k * spacing + more, 0) for k in range(n)])

    @staticmethod
    def _undecided(ratios: Array) -> float:
        """Return the error of an interpolation from every second position, relative to the mean.

        It is an upper estimate of the error with all positions, since the interpolant converges
        faster than any power. NaN for an odd number.
        """
        if ratios.size % 2:
            return math.nan
        between = interpolated(ratios[::2], 2)[1::2]
        return float(np.abs(between - ratios[1::2]).max() / ratios.mean())


def common_passages(
    lengths: tuple[float, float], velocity_ratios: tuple[float, float]
) -> tuple[int, int] | None:
    """Numbers of passages of two tiles in their common period; None: it is too long."""
    one, other = (u / length for u, length in zip(velocity_ratios, lengths, strict=True))
    if one == 0.0 or other == 0.0:
        return int(one > 0.0), int(other > 0.0)
    ratio = one / other
    result = Fraction(ratio).limit_denominator(MAX_PASSAGES)
    if result.numerator > MAX_PASSAGES or not math.isclose(result, ratio, rel_tol=SAME):
        return None
    return result.numerator, result.denominator


@dataclass(frozen=True)
class RelativePositions:
    """Positions of two tiles from their lengths [a], velocity ratios and initial fronts [a]."""

    lengths: tuple[float, float]
    velocity_ratios: tuple[float, float]
    fronts: tuple[float, float]
    radius: float = 1.0  # a [m]

    @cached_property
    def passages(self) -> tuple[int, int] | None:
        """Numbers of passages in the common period; None: all relative positions occur."""
        return common_passages(self.lengths, self.velocity_ratios)

    def moved(self, k: int, n: int, m: int = 0) -> tuple[float, float]:
        """Displacements of the tiles at the k-th of n positions [a].

        In the common period, or on the lattice of `m`, then within the length of a tile.
        """
        one, other = self.lengths
        if self.passages:
            return one * (self.passages[0] * k) / n, other * (self.passages[1] * k) / n
        return one * k / n, other * (m * k % n) / n

    def shifts(self, k: int, n: int, m: int = 0) -> tuple[float, float]:
        """Fronts of the tiles at the k-th of n positions [a], arguments as for `moved`."""
        first, second = self.moved(k, n, m)
        return self.fronts[0] + first, self.fronts[1] + second

    def short_mean(self, ratios: Ratios) -> float:
        """Mean of mu_r/mu_s over a few positions; the contact defines the tracks."""
        passages = self.passages
        n = PER_PASSAGE * max(passages) if passages else SHORT_LATTICE**2 - 1
        return float(np.mean(ratios([self.shifts(k, n, SHORT_LATTICE) for k in range(n)])))

    def passage(self, contact: MovingContact, positions: int, largest: float) -> Passage:
        """Give mu_r/mu_s over the common period, or on the lattice with the next larger number."""
        n, m, ratios, error = (
            self._along(contact, positions, largest)
            if self.passages
            else self._over_all(contact, positions, largest)
        )
        moved = np.array([self.moved(k, n, m) for k in range(n)]) * self.radius
        return Passage((moved[:, 0], moved[:, 1]), ratios, error, self.passages is not None)

    def _over_all(
        self, contact: MovingContact, positions: int, largest: float
    ) -> tuple[int, int, Array, float]:
        before = math.nan
        for m in (math.isqrt(positions) + 1,) if positions else LATTICES:
            n = m * m - 1
            ratios = np.array(contact.frictions([self.shifts(k, n, m) for k in range(n)]))
            mean, error = float(ratios.mean()), _undecided(ratios)
            if not math.isfinite(mean) or mean > largest:
                break
            if not math.isnan(before):
                error = max(error, abs(mean - before) / mean)
                if error <= POSITION_TOLERANCE:
                    break
            before = mean
        return n, m, ratios, error

    def _along(
        self, contact: MovingContact, positions: int, largest: float
    ) -> tuple[int, int, Array, float]:
        n = positions or PER_PASSAGE * max(self.passages or ())
        ratios = np.array(contact.frictions([self.shifts(k, n) for k in range(n)]))
        error = _undecided(ratios)
        while not positions and error > POSITION_TOLERANCE and 2 * n <= MAX_POSITIONS:
            if float(ratios.mean()) > largest:
                break
            between = contact.frictions([self.shifts(k, 2 * n) for k in range(1, 2 * n, 2)])
            ratios = np.stack([ratios, between], axis=1).ravel()
            n, error = 2 * n, _undecided(ratios)
        return n, 0, ratios, error


def _undecided(ratios: Array) -> float:
    """Return the relative error of the mean over every second position.

    It is an upper estimate of the error with all positions. NaN for an odd number.
    """
    if ratios.size % 2:
        return math.nan
    halves = ratios[::2].mean(), ratios[1::2].mean()
    return float(0.5 * abs(halves[0] - halves[1]) / ratios.mean())
