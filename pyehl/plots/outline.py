# SPDX-License-Identifier: BSD-3-Clause
"""The edge of the dry contact in pictures."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.patches import Ellipse, Patch, Rectangle
from numpy.typing import NDArray

from pyehl.schema import summary_of

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.floating[Any]]
# Long over short side from which a contact is slender
SLENDER = 2.5
# Minimum height over width of a map, and of a map of a roller, whose axes have different scales
FLATTEST, FLATTEST_ROLLER = 0.11, 0.22


@dataclass(frozen=True, slots=True)
class Outline:
    """The Hertz ellipse in units of its semi-axis a, or the strip of a roller in units of b.

    Attributes
    ----------
    ellipticity
        The other semi-axis over a [-].
    angle
        Angle of the axis of a from the motion, counter-clockwise [deg].
    ends
        Whether it is a roller, with `ellipticity` as half its length.
    """

    ellipticity: float = 1.0
    angle: float = 0.0
    ends: bool = False

    @classmethod
    def of(cls, data: xr.Dataset) -> Outline:
        """Outline of a solution."""
        about = summary_of(data)
        if about.get("shape") == "roller":
            return cls(0.5 * float(about["length"]), ends=True)
        return cls(float(about.get("ellipticity", 1.0)), float(about.get("angle_deg", 0.0)))

    @property
    def reach(self) -> tuple[float, float]:
        """Half extents along x and y [a]."""
        c, s = math.cos(math.radians(self.angle)), math.sin(math.radians(self.angle))
        return math.hypot(c, self.ellipticity * s), math.hypot(s, self.ellipticity * c)

    @property
    def turned(self) -> bool:
        """Whether pictures show y from left to right, and the motion upwards."""
        along, across = self.reach
        return across > SLENDER * along

    @property
    def slender(self) -> bool:
        """Whether one side is so much longer that maps are stacked."""
        along, across = self.reach
        return max(along, across) > SLENDER * min(along, across)

    @property
    def box(self) -> tuple[float, float]:
        """Half extents to the right and up in a picture [a]."""
        along, across = self.reach
        return (across, along) if self.turned else (along, across)

    def view(self, margin: float) -> tuple[float, float]:
        """Half width and half height of a map [a], `margin` times those of the contact.

        A roller has no margin at its ends. The map of an ellipse is at least FLATTEST times as
        high as wide.
        """
        wide, high = (margin * reach for reach in self.box)
        if self.ends:
            # a roller ends with its domain
            return (wide / margin, high) if self.turned else (wide, high / margin)
        return wide, max(high, FLATTEST * wide)

    def shape(self, margin: float) -> float:
        """Height over width of a map [-]; of a roller not below FLATTEST_ROLLER."""
        wide, high = self.view(margin)
        return max(high / wide, FLATTEST_ROLLER) if self.ends else high / wide

    def seen(self, x: Array, y: Array, field: Array) -> tuple[Array, Array, Array]:
        """Coordinates to the right and up in a picture, and a field over them."""
        return (y, x, field.swapaxes(0, 1)) if self.turned else (x, y, field)

    @property
    def chords(self) -> tuple[float, float]:
        """Half of its width on the x and on the y axis [a]; of a roller infinite on the y axis."""
        if self.ends:
            return 1.0, math.inf
        c, s = math.cos(math.radians(self.angle)), math.sin(math.radians(self.angle))
        return 1.0 / math.hypot(c, s / self.ellipticity), 1.0 / math.hypot(s, c / self.ellipticity)

    def inside(self, x: Array, y: Array) -> NDArray[np.bool_]:
        """Which nodes are in it, (nx, ny)."""
        c, s = math.cos(math.radians(self.angle)), math.sin(math.radians(self.angle))
        along = c * x[:, None] + s * y[None, :]
        across = (c * y[None, :] - s * x[:, None]) / self.ellipticity
        if self.ends:
            return np.asarray(np.maximum(abs(along), abs(across)) <= 1.0)
        return np.asarray(along**2 + across**2 <= 1.0)

    def patch(self, radius: float, **style: Any) -> Patch:  # noqa: ANN401
        """Make a patch of it, `radius` being a in the unit of the axes."""
        size = 2.0 * radius, 2.0 * self.ellipticity * radius
        # x and y change places: a reflection
        size, angle = (size[::-1], -self.angle) if self.turned else (size, self.angle)
        if self.ends:
            return Rectangle((-0.5 * size[0], -0.5 * size[1]), *size, fill=False, **style)
        return Ellipse((0.0, 0.0), *size, angle=angle, fill=False, **style)


CIRCLE = Outline()
