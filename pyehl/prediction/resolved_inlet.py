# SPDX-License-Identifier: BSD-3-Clause
"""The grid that resolves the inlet of a smooth contact that may touch."""

from pyehl.prediction.smooth import FINEST
from pyehl.theory.film import central_film
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Settings

INLET, RESOLVED = 1.3, 0.12
"""A grid misses the share INLET (h/H^(2/3))^2 of the film that the inlet makes; what it may miss
where bodies touch (``fortran/steady/inlet.f90``)."""
THINNEST, THICKER = 0.3, 1.15
"""Least film of a smooth contact over the central one, and the error of the formula for that."""


def touching_points(settings: Settings) -> int:
    """Nodes along X that tell whether the smooth contact of a resolved case touches.

    No fewer than it has; they resolve the inlet as ``fortran/steady/inlet.f90`` asks for, up to
    FINEST.
    """
    if not settings["lubricant"].get("boundary_film", 0.0):
        return int(settings["grid"]["points"])
    operating, lubricant = OperatingPoint.from_settings(settings), Lubricant.from_settings(settings)
    grid = settings["grid"]
    points, length = int(grid["points"]), float(grid["x_outlet"]) - float(grid["x_inlet"])
    film = central_film(operating, lubricant) / operating.film_scale
    density = float(lubricant.density_ratio(operating.hertz_pressure))
    layer = float(settings["lubricant"]["boundary_film"]) / operating.film_scale / density
    if layer >= THICKER * film:
        return points
    while 2 * points - 1 <= FINEST:
        missed = INLET * (length / (points - 1)) ** 2 * film ** (-4.0 / 3.0)
        # the film of a grid is thinner by more than it misses where it is thinnest
        if missed <= RESOLVED or layer <= THINNEST * (1.0 - 2.0 * missed) * film:
            break
        points = 2 * points - 1
    return points
