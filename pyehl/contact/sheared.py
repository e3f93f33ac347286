# SPDX-License-Identifier: BSD-3-Clause
"""Integrals of the shear stress over the points of a contact, also for the model of the paper.

That model has a semi-elliptical pressure and a uniform film on all pixels of the Hertz circle.
Lengths along the surface are scaled by a, films by a^2/R, pressures by p_h.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from pyehl.theory.line_contact import AnyContact
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.shear import shear_stress
from pyehl.types import Array, Indices, Single

INNER = 0.8
"""Radius within which pressures are reported [a]: further out the roughness displaces the edge of
the contact. The errors of docs/evidence/thinning refer to INNER and NEAR."""
NEAR = 0.5
"""Radius within which the rms pressure increase is reported [a]."""
MIN_SAMPLES = 128
"""Minimum number of points per Hertz radius if pixels are skipped, in the model of the paper."""


def thins(lubricant: Lubricant, operating: AnyContact) -> bool:
    """Whether the shear stress is not Newtonian; without sliding it is Newtonian."""
    return lubricant.shear.law != "newtonian" and operating.sliding_speed > 0.0


class ShearedContact:
    """Points of a contact, with integrals of the shear stress and extremes over the positions."""

    minimum_film: float  # minimum film [a^2/R]; not positive: film breakdown
    smooth: float  # sum of the stress of the smooth contact over the points, as `stress`
    points: int  # number of points within the contact
    area: float  # area per point [m^2]

    def __init__(self, operating: AnyContact, lubricant: Lubricant) -> None:
        self.operating, self.lubricant = operating, lubricant
        self.thins = thins(lubricant, operating)
        self.cavitated = 0  # points where the pressure is not positive
        self.count = 0  # number of positions
        self.ended = 0  # points with film breakdown
        self.imbalance = 0.0  # maximum load of delta p over the load, in magnitude [-]
        self.lost = False  # whether the load of a ring of points would be negative
        self.max_increase = -math.inf  # maximum pressure increase by the roughness within INNER
        self.max_pressure = -math.inf  # maximum pressure within INNER
        self.squared_increase = 0.0  # sum over positions of the mean square increase within NEAR
        # Film thicknesses, and the number of points with a thinner film than each
        self.levels: tuple[float, ...] = ()
        self.below = np.zeros(0, dtype=np.int64)

    def watch(self, levels: tuple[float, ...]) -> None:
        """Start counting the points with a thinner film than each of some levels."""
        self.levels, self.below = levels, np.zeros(len(levels), dtype=np.int64)

    def accumulate(
        self, increase: Array | Single, pressure: Array, film: Array, inner: Indices, near: Indices
    ) -> None:
        """Update the extremes by a position; `inner`, `near`: points within INNER, NEAR."""
        squares = np.square(increase.take(near), dtype=np.float64)
        self.squared_increase += float(squares.mean()) if near.size else math.nan
        maximum = float(increase.take(inner).max(initial=-math.inf))
        self.max_increase = max(self.max_increase, maximum)
        maximum = float(pressure.take(inner).max(initial=-math.inf))
        self.max_pressure = max(self.max_pressure, maximum)
        for i, level in enumerate(self.levels):
            self.below[i] += np.count_nonzero(film < level)

    def min_film(self) -> float:
        """Return the minimum film so far."""
        return self.minimum_film

    def increase_rms(self) -> float:
        """Rms pressure increase within NEAR over all positions [p_h]."""
        return math.sqrt(self.squared_increase / max(1, self.count))

    def shares(self) -> Array:
        """Mean fraction of the contact with a thinner film than each level [-]."""
        return np.asarray(self.below / max(1, self.count * self.points))

    def stress(self, pressure: Array, film: Array) -> Array:
        """Shear stress [Pa]; for a Newtonian oil divided by eta0 and the sliding speed."""
        pressure = pressure * self.operating.hertz_pressure
        ratio = self.lubricant.viscosity_ratio(pressure)
        ratio /= film * self.operating.film_scale
        if not self.thins:
            return ratio
        newtonian = ratio * (self.lubricant.viscosity * self.operating.sliding_speed)
        return shear_stress(newtonian, pressure, self.lubricant.shear)

    def mu_smooth(self) -> float:
        """Coefficient of friction of the smooth contact [-]; NaN where it overflows."""
        return self.coefficient(self.smooth) if math.isfinite(self.smooth) else math.nan

    def coefficient(self, stress: float) -> float:
        """Coefficient of friction from a sum of `stress` over the points [-]."""
        result = stress * self.area / self.operating.load
        newtonian = self.lubricant.viscosity * self.operating.sliding_speed
        return result if self.thins else result * newtonian

    def cavitated_bound(self, minimum: float) -> float:
        """Bound on the fraction of friction at zero pressure, from the minimum friction ratio."""
        if self.cavitated == 0:
            return 0.0
        stress = float(self.stress(np.array(0.0), np.array(self.minimum_film)))
        return self.cavitated * stress / (self.count * minimum * self.smooth)


class HertzContact(ShearedContact):
    """Pixels of the Hertz circle with a semi-elliptical pressure and a uniform film.

    Parameters
    ----------
    pressure
        Pressure change by the roughness, on a periodic tile (nx, ny) [p_h].
    deformed
        Deformed roughness on that tile [a^2/R], peaks positive.
    film
        Film of the smooth contact [a^2/R].
    pixel
        Sizes of a pixel along x and y [a].
    operating, lubricant
        Operating point and lubricant.
    load_balance
        Whether the semi-ellipse is that of the load that the roughness leaves, not of the whole.
    """

    def __init__(
        self,
        pressure: Array,
        deformed: Array,
        film: float,
        *,
        pixel: tuple[float, float],
        operating: AnyContact,
        lubricant: Lubricant,
        load_balance: bool,
    ) -> None:
        super().__init__(operating, lubricant)
        self.pressure, self.deformed, self.film = pressure, deformed, film
        self.load_balance = load_balance
        nx, ny = pressure.shape
        i, stride_x = _lattice(1.0 / pixel[0], nx)
        j, stride_y = _lattice(1.0 / pixel[1], ny)
        self.area = pixel[0] * pixel[1] * stride_x * stride_y * operating.hertz_radius**2
        square = (i * pixel[0])[:, np.newaxis] ** 2 + (j * pixel[1])[np.newaxis, :] ** 2
        inside = square < 1.0
        self.radius_squared = square[inside]
        # indices in the flattened tile
        self.index = ((i % nx)[:, np.newaxis] * ny + j % ny)[inside]
        self.points = self.index.size
        # every height within |y| < a passes through the contact
        self.minimum_film = film - float(deformed[:, np.unique(j % ny)].max())
        self.semi_ellipse = np.sqrt(1.0 - self.radius_squared)
        self.inner, self.near = (np.flatnonzero(self.radius_squared < r**2) for r in (INNER, NEAR))
        self.smooth = float(self.stress(self.semi_ellipse, np.array(film)).sum())

    def friction(self, position: tuple[float, float]) -> float:
        """Integral of the shear stress over that of the smooth contact [-].

        `position` is the shift of the tile in whole pixels. NaN where the film ends, or with
        `load_balance` the roughness alone sustains the load.
        """
        pixels = [int(number) for number in position]
        moved = [np.roll(v, pixels, (0, 1)) for v in (self.pressure, self.deformed)]
        delta, deformed = (values.ravel().take(self.index) for values in moved)
        film = self.film - deformed
        if min(self.minimum_film, float(film.min())) <= 0.0:
            return math.nan
        # with the area of the circle, not of its pixels: the load is 2 pi/3
        carried = 1.5 * float(delta.mean())
        self.imbalance = max(self.imbalance, abs(carried))
        pressure = self.semi_ellipse
        if self.load_balance:
            if carried >= 1.0:
                return math.nan
            scale = (1.0 - carried) ** (1.0 / 3.0)
            pressure = scale * np.sqrt(np.maximum(0.0, 1.0 - self.radius_squared / scale**2))
        pressure = pressure + delta
        self.accumulate(delta, pressure, film, self.inner, self.near)
        tension = pressure <= 0.0
        self.cavitated += int(np.count_nonzero(tension))
        pressure[tension] = 0.0
        self.count += 1
        with np.errstate(over="ignore"):
            return float(self.stress(pressure, film).sum()) / self.smooth

    def frictions(self, positions: Sequence[tuple[float, float]]) -> list[float]:
        """Give `friction` at some positions."""
        return [self.friction(position) for position in positions]

    def ratios(self, positions: Sequence[tuple[float, float]]) -> list[float]:
        """Give the same."""
        return self.frictions(positions)

    def observe(self, positions: Sequence[tuple[float, float]]) -> None:
        """Update the extremes by some positions."""
        self.frictions(positions)


def _lattice(radius: float, pixels: int) -> tuple[Indices, int]:
    """Pixels along a diameter at which the stress is computed, and their stride.

    The stride is 1 unless the tile is much shorter than the contact and finely sampled. Then a
    stride without common divisor with the tile visits all its pixels in turn, at MIN_SAMPLES points
    or more per radius of the contact, and each pixel at eight positions or more along a diameter.
    """
    half = int(radius)
    stride = max(1, half // max(MIN_SAMPLES, 4 * pixels))
    while math.gcd(stride, pixels) > 1:
        stride -= 1
    reach = half // stride
    return np.arange(-reach, reach + 1) * stride, stride
