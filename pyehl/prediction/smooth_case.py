# SPDX-License-Identifier: BSD-3-Clause
"""The case of the smooth contact under a prediction: everything but the surface, and its grid."""

from typing import Any

from pyehl import namelist
from pyehl.surfaces import GROUPS
from pyehl.theory.film import central_film
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.shear import ShearLaw
from pyehl.types import Settings

# Keys that pressure and film of a smooth contact do not depend on. Those of slip and oil they do
# where the inlet is heated by shear, those of slip and law where the flow thins
OF_SLIP = ("slide_to_roll", "rough_surface")
OF_SOLIDS = (
    "hardness",
    *("thermal_conductivity", "thermal_diffusivity"),
    *("thermal_conductivity_2", "thermal_diffusivity_2"),
)
# (a temperature is refused without something that it changes)
OF_OIL = ("thermal_conductivity",)
OF_SHEAR = (
    *("shear_law", "flow", "eyring_stress", "limiting_stress", "limiting_coefficient"),
    *("carreau_stress", "carreau_exponent"),
)
# The prediction is that of a full film
OF_CONTACT = ("boundary_film", "boundary_friction")
# Groups without a say in a smooth contact (the radii of the bodies are in the group contact), and
# keys of the grid of a run, in place of which the prediction has grids of its own
OF_OTHERS = ("bodies", *GROUPS, "time", "psd", "output")
OF_RUN = ("points", "points_y", "target_error", "max_points")

INLET, RESOLVED = 1.3, 0.12
"""A grid misses the share INLET (h/H^(2/3))^2 of the film that the inlet makes; what it may miss
where bodies touch (``fortran/steady/inlet.f90``)."""
THINNEST, THICKER = 0.3, 1.15
"""Minimum film of a smooth contact over the central one, and the error of the formula for that."""
FINEST = 1025
"""Nodes per side of the finest grid that is tried."""


def without_surface(settings: Settings) -> dict[str, dict[str, Any]]:
    """Give a resolved case without its surfaces and the grid of its run."""
    return {
        group: {k: v for k, v in keys.items() if group != "grid" or k not in OF_RUN}
        for group, keys in settings.items()
        if group not in OF_OTHERS
    }


def smooth_case(settings: Settings, *, layer: bool = False) -> str:
    """Text of the case whose solution is the smooth contact under a resolved case.

    All of the case but its surface and what a smooth contact does not depend on, so that a new key
    is obeyed. `layer`: with its boundary film. Cases that differ in their surface or the heat of
    friction alone have the same; where the flow is Newtonian and the inlet not heated by shear, so
    have those that differ in their slip or their shear law.
    """
    thins = ShearLaw.from_settings(settings).in_flow
    heated = bool(settings["lubricant"]["thermal_reduction"])
    of_contact = OF_SOLIDS + (() if thins or heated else OF_SLIP)
    of_lubricant = OF_CONTACT + (() if thins else OF_SHEAR) + (() if heated else OF_OIL)
    if layer:
        of_contact = tuple(key for key in of_contact if key != "hardness")
        of_lubricant = tuple(key for key in of_lubricant if key != "boundary_film")
    left_out = {"contact": of_contact, "lubricant": of_lubricant}
    groups = {
        group: {k: v for k, v in keys.items() if k not in left_out.get(group, ())}
        for group, keys in without_surface(settings).items()
    }
    groups["lubricant"]["thermal_friction"] = "never"
    return namelist.text_of(groups)


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
