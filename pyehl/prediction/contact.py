# SPDX-License-Identifier: BSD-3-Clause
"""Shear stress over the Hertz circle at one position of the surface: eqs 13 and 14."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from pyehl.prediction.flattening import Response
from pyehl.prediction.options import Options
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.shear import shear_stress

__all__ = ["Contact", "ShearedContact"]

Array = NDArray[np.float64]

# Fewest points per Hertz radius when not all pixels are visited
MIN_SAMPLES = 128


class ShearedContact:
    """Points of a contact, the shear stress integrals over them, and what was met so far."""

    thinnest: float  # least film, in the unit of films
    smooth: float  # sum of the stress of the smooth contact over the points, as `stress`
    points: int  # within the contact
    area: float  # that one of them stands for [m^2]

    def __init__(self, operating: OperatingPoint, lubricant: Lubricant) -> None:
        self.operating, self.lubricant = operating, lubricant
        # without sliding the shear stress is the Newtonian one
        self.thins = lubricant.shear.law != "newtonian" and operating.sliding_speed > 0.0
        self.cavitated = 0  # points where the pressure is not positive
        self.count = 0  # positions
        self.imbalance = 0.0  # greatest share of the load that delta p carries or takes off [-]

    def stress(self, pressure: Array, film: Array) -> Array:
        """Shear stress at a pressure [Pa] in a film [m].

        [Pa]; of a Newtonian oil divided by eta0 and the sliding speed.
        """
        ratio = self.lubricant.viscosity_ratio(pressure) / film
        if not self.thins:
            return ratio
        newtonian = ratio * (self.lubricant.viscosity * self.operating.sliding_speed)
        return shear_stress(newtonian, pressure, self.lubricant.shear)

    def mu_smooth(self) -> float:
        """Coefficient of friction of the smooth contact [-]; NaN where it overflows."""
        if not math.isfinite(self.smooth):
            return math.nan
        found = self.smooth * self.area / self.operating.load
        newtonian = self.lubricant.viscosity * self.operating.sliding_speed
        return found if self.thins else found * newtonian

    def cavitated_bound(self, least: float) -> float:
        """Bound of the share of friction where the pressure is zero, `least` the least ratio."""
        if self.cavitated == 0:
            return 0.0
        stress = float(self.stress(np.array(0.0), np.array(self.thinnest)))
        return self.cavitated * stress / (self.count * least * self.smooth)


class Contact(ShearedContact):
    """The pixels of the Hertz circle; `index` (n,) are their places in the flattened tile."""

    def __init__(
        self,
        field: Response,
        pixel: tuple[float, float],
        *,
        operating: OperatingPoint,
        lubricant: Lubricant,
        film: float,
        options: Options,
    ) -> None:
        super().__init__(operating, lubricant)
        self.film, self.options = film, options
        self.circle = math.pi * operating.hertz_radius**2
        self.hertz_pressure = operating.hertz_pressure
        nx, ny = field.pressure.shape
        a = operating.hertz_radius
        i, stride_x = _lattice(a / pixel[0], nx)
        j, stride_y = _lattice(a / pixel[1], ny)
        self.area = pixel[0] * pixel[1] * stride_x * stride_y
        square = (i * pixel[0] / a)[:, np.newaxis] ** 2 + (j * pixel[1] / a)[np.newaxis, :] ** 2
        inside = square < 1.0
        self.radius_squared = square[inside]
        self.index = ((i % nx)[:, np.newaxis] * ny + j % ny)[inside]
        self.points = self.index.size
        self.pressure, self.deformed = field.pressure, field.deformed
        # every height within |y| < a passes through the contact
        self.thinnest = film - float(field.deformed[:, np.unique(j % ny)].max())
        self.smooth_pressure = self.hertz_pressure * np.sqrt(1.0 - self.radius_squared)
        self.smooth = float(self.stress(self.smooth_pressure, np.array(film)).sum())

    def friction(self, step: int) -> float:
        """Integral of the shear stress over that of the smooth contact, `step` pixels on."""
        if self.thinnest <= 0.0:
            return math.nan
        delta = np.roll(self.pressure, step, axis=0).ravel().take(self.index)
        film = self.film - np.roll(self.deformed, step, axis=0).ravel().take(self.index)
        # times the area of the circle, not of its pixels
        carried = float(delta.mean()) * self.circle / self.operating.load
        self.imbalance = max(self.imbalance, abs(carried))
        if self.options.load_balance:
            if carried >= 1.0:
                return math.nan
            scale = (1.0 - carried) ** (1.0 / 3.0)
            inner = np.maximum(0.0, 1.0 - self.radius_squared / scale**2)
            pressure = (scale * self.hertz_pressure) * np.sqrt(inner) + delta
        else:
            pressure = self.smooth_pressure + delta
        tension = pressure <= 0.0
        lost = int(np.count_nonzero(tension))
        if lost:
            pressure[tension] = 0.0
            self.cavitated += lost
        self.count += 1
        with np.errstate(over="ignore"):
            return float(self.stress(pressure, film).sum()) / self.smooth


def _lattice(radius: float, pixels: int) -> tuple[NDArray[np.int_], int]:
    """Pixels of a diameter at which the stress is taken, and their stride.

    All of them unless the tile is much shorter than the contact and finely sampled. Then a stride
    without common divisor with the tile meets each of its pixels in turn, and the contact is still
    met at MIN_SAMPLES points and each pixel of the tile at eight places of it.
    """
    half = int(radius)
    stride = max(1, half // max(MIN_SAMPLES, 4 * pixels))
    while math.gcd(stride, pixels) > 1:
        stride -= 1
    reach = half // stride
    return np.arange(-reach, reach + 1) * stride, stride
