# SPDX-License-Identifier: BSD-3-Clause
"""The edge of the dry contact in pictures."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.patches import Ellipse
from numpy.typing import NDArray

from pyehl.schema import summary_of

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.floating[Any]]


@dataclass(frozen=True, slots=True)
class Outline:
    """The Hertz ellipse in units of its semi-axis a.

    Attributes
    ----------
    ellipticity
        The other semi-axis over a [-].
    angle
        Of the axis of a against the motion, counter-clockwise [deg].
    """

    ellipticity: float = 1.0
    angle: float = 0.0

    @classmethod
    def of(cls, data: xr.Dataset) -> Outline:
        """Of a solution."""
        about = summary_of(data)
        return cls(float(about.get("ellipticity", 1.0)), float(about.get("angle_deg", 0.0)))

    @property
    def reach(self) -> tuple[float, float]:
        """How far it reaches along x and along y."""
        c, s = math.cos(math.radians(self.angle)), math.sin(math.radians(self.angle))
        return math.hypot(c, self.ellipticity * s), math.hypot(s, self.ellipticity * c)

    @property
    def slender(self) -> float:
        """How much further it reaches along y than along x."""
        along, across = self.reach
        return across / along

    @property
    def chords(self) -> tuple[float, float]:
        """Half of its width on the x axis and on the y axis."""
        c, s = math.cos(math.radians(self.angle)), math.sin(math.radians(self.angle))
        return 1.0 / math.hypot(c, s / self.ellipticity), 1.0 / math.hypot(s, c / self.ellipticity)

    def inside(self, x: Array, y: Array) -> NDArray[np.bool_]:
        """Which nodes are in it, (nx, ny)."""
        c, s = math.cos(math.radians(self.angle)), math.sin(math.radians(self.angle))
        along = c * x[:, None] + s * y[None, :]
        across = (c * y[None, :] - s * x[:, None]) / self.ellipticity
        return np.asarray(along**2 + across**2 <= 1.0)

    def patch(self, radius: float, **style: Any) -> Ellipse:  # noqa: ANN401
        """Draw it, `radius` being a in the unit of the axes."""
        size = 2.0 * radius, 2.0 * self.ellipticity * radius
        return Ellipse((0.0, 0.0), *size, angle=self.angle, fill=False, **style)


CIRCLE = Outline()
