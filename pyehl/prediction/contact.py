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

__all__ = ["Contact"]

Array = NDArray[np.float64]

# Fewest points per Hertz radius when not all pixels are visited
MIN_SAMPLES = 128


class Contact:
    """The pixels of the Hertz circle and the shear stress integrals over them.

    `sliding` is |u1 - u2| [m/s]; `thins`: the shear stress is another than the Newtonian one,
    which it is not without sliding. One pixel of the circle stands for `area` of the tile [m^2];
    `index` (n,) are their places in the flattened tile. `thinnest` is the least h_c - rr_d of all
    that passes through the contact [m]; `smooth` the sum of the shear stress of the smooth contact
    over the pixels [Pa], of a Newtonian oil divided by eta0 and the sliding speed. So far
    `cavitated` pixels had p_s + delta p <= 0 at `count` positions, and delta p has carried or
    taken off at most the share `imbalance` of the load.
    """

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
        self.lubricant, self.film, self.options = lubricant, film, options
        self.load = operating.load
        self.circle = math.pi * operating.hertz_radius**2
        self.hertz_pressure = operating.hertz_pressure
        self.sliding = operating.sliding_speed
        self.thins = lubricant.shear.law != "newtonian" and self.sliding > 0.0
        nx, ny = field.pressure.shape
        a = operating.hertz_radius
        i, stride_x = _lattice(a / pixel[0], nx)
        j, stride_y = _lattice(a / pixel[1], ny)
        self.area = pixel[0] * pixel[1] * stride_x * stride_y
        square = (i * pixel[0] / a)[:, np.newaxis] ** 2 + (j * pixel[1] / a)[np.newaxis, :] ** 2
        inside = square < 1.0
        self.radius_squared = square[inside]
        self.index = ((i % nx)[:, np.newaxis] * ny + j % ny)[inside]
        self.pressure, self.deformed = field.pressure, field.deformed
        # every height within |y| < a passes through the contact
        self.thinnest = film - float(field.deformed[:, np.unique(j % ny)].max())
        self.smooth_pressure = self.hertz_pressure * np.sqrt(1.0 - self.radius_squared)
        self.smooth = float(self._stress(self.smooth_pressure, np.array(film)).sum())
        self.cavitated = 0
        self.imbalance = 0.0
        self.count = 0

    def _stress(self, pressure: Array, film: Array) -> Array:
        """Shear stress at a pressure [Pa] in a film [m].

        [Pa]; of a Newtonian oil divided by eta0 and the sliding speed.
        """
        ratio = self.lubricant.viscosity_ratio(pressure) / film
        if not self.thins:
            return ratio
        newtonian = ratio * (self.lubricant.viscosity * self.sliding)
        return shear_stress(newtonian, pressure, self.lubricant.shear)

    def friction(self, step: int) -> float:
        """Integral of the shear stress over that of the smooth contact, `step` pixels on."""
        if self.thinnest <= 0.0:
            return math.nan
        delta = np.roll(self.pressure, step, axis=0).ravel().take(self.index)
        film = self.film - np.roll(self.deformed, step, axis=0).ravel().take(self.index)
        # times the area of the circle, not of its pixels
        carried = float(delta.mean()) * self.circle / self.load
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
            return float(self._stress(pressure, film).sum()) / self.smooth

    def cavitated_bound(self, least: float) -> float:
        """Bound of the share of friction at cavitated pixels, `least` the least F_r/F_s."""
        if self.cavitated == 0:
            return 0.0
        stress = float(self._stress(np.array(0.0), np.array(self.thinnest)))
        return self.cavitated * stress / (self.count * least * self.smooth)


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
