# SPDX-License-Identifier: BSD-3-Clause
"""The smooth contact of a prediction.

It is the case without its surface, solved on grids of the prediction, or the dry contact of the
paper. :mod:`pyehl.contact.result_folder` reads a solution of a run.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pyehl import namelist
from pyehl.case import Case
from pyehl.contact.heat import HeatOf
from pyehl.errors import EhlError
from pyehl.handle import SolverHandle, results_of
from pyehl.reasons import words_of
from pyehl.surfaces import GROUPS
from pyehl.theory.heat import Heat
from pyehl.theory.line_contact import AnyContact, circle_with_same_inlet, formula_film
from pyehl.theory.line_contact import contact_of as operating_of
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.shear import ShearLaw
from pyehl.theory.transport import Zone, zone_on
from pyehl.types import Array, Settings

# Keys that do not affect pressure and film of a smooth contact; but slip and oil do if shear heats
# the inlet, and slip and shear law do if the flow is shear-thinning
OF_SLIP = ("slide_to_roll", "rough_surface")
OF_SOLIDS = (
    "hardness",
    *("thermal_conductivity", "thermal_diffusivity"),
    *("thermal_conductivity_2", "thermal_diffusivity_2"),
)
# (lubricant.temperature stays: it is refused where nothing depends on it)
OF_OIL = ("thermal_conductivity",)
OF_SHEAR = (
    *("shear_law", "flow", "eyring_stress", "limiting_stress", "limiting_coefficient"),
    *("carreau_stress", "carreau_exponent"),
)
# The prediction assumes a full film
OF_CONTACT = ("boundary_film", "boundary_friction")
# Groups that do not affect a smooth contact (the radii of the bodies are in the group contact), and
# keys of the grid of a run, for which the prediction has its own grids
OF_OTHERS = ("bodies", *GROUPS, "time", "psd", "output")
OF_RUN = ("points", "points_y", "target_error", "max_points")

INLET, RESOLVED = 1.3, 0.12
"""Relative error of the film from the inlet on a grid of mesh size h, INLET (h/H^(2/3))^2, and its
largest value allowed with solid contact (``fortran/steady/inlet.f90``)."""
MINIMUM, THICKER = 0.3, 1.15
"""Lower bound of minimum over central film, and upper bound of central film over its formula."""
FINEST = 1025
"""Nodes per side of the finest grid that is tried."""
POINTS_OF_LINE, FINEST_OF_LINE = 1025, 8193
"""Number of nodes of the first and of the finest grid of a line contact, which has one row."""


def without_surface(settings: Settings) -> dict[str, dict[str, Any]]:
    """Return a resolved case without its surfaces and the grid of its run."""
    return {
        group: {k: v for k, v in keys.items() if group != "grid" or k not in OF_RUN}
        for group, keys in settings.items()
        if group not in OF_OTHERS
    }


def smooth_case(settings: Settings, *, boundary: bool = False) -> str:
    """Text of the case whose solution is the smooth contact of a resolved case.

    It has all keys except the surface and those that do not affect a smooth contact, so that new
    keys are included. `boundary`: with its boundary film. Cases that differ only in their surface
    or in frictional heating have the same text; with a Newtonian flow and no shear heating of the
    inlet, so do cases that differ in slip or shear law.
    """
    thins = ShearLaw.from_settings(settings).in_flow
    heated = bool(settings["lubricant"]["thermal_reduction"])
    of_contact = OF_SOLIDS + (() if thins or heated else OF_SLIP)
    of_lubricant = OF_CONTACT + (() if thins else OF_SHEAR) + (() if heated else OF_OIL)
    if boundary:
        of_contact = tuple(key for key in of_contact if key != "hardness")
        of_lubricant = tuple(key for key in of_lubricant if key != "boundary_film")
    left_out = {"contact": of_contact, "lubricant": of_lubricant}
    groups = {
        group: {k: v for k, v in keys.items() if k not in left_out.get(group, ())}
        for group, keys in without_surface(settings).items()
    }
    groups["lubricant"]["thermal_friction"] = "never"
    groups.pop("duty", None)
    return namelist.text_of(groups)


def touching_points(settings: Settings) -> int:
    """Nodes along X needed to decide whether a smooth contact has solid contact.

    No fewer than those of the resolved case; they resolve the inlet as
    ``fortran/steady/inlet.f90`` requires, up to FINEST.
    """
    if not settings["lubricant"].get("boundary_film", 0.0):
        return int(settings["grid"]["points"])
    operating, lubricant = operating_of(settings), Lubricant.from_settings(settings)
    grid = settings["grid"]
    points, length = int(grid["points"]), float(grid["x_outlet"]) - float(grid["x_inlet"])
    film = formula_film(operating, lubricant) / operating.film_scale
    density = float(lubricant.density_ratio(operating.density_pressure))
    boundary = float(settings["lubricant"]["boundary_film"]) / operating.film_scale / density
    if boundary >= THICKER * film:
        return points
    while 2 * points - 1 <= FINEST:
        missed = INLET * (length / (points - 1)) ** 2 * film ** (-4.0 / 3.0)
        # the minimum film has a larger error than the central film
        if missed <= RESOLVED or boundary <= MINIMUM * (1.0 - 2.0 * missed) * film:
            break
        points = 2 * points - 1
    return points


SHARE_NOTE = "contact_load_share_error_note"
POINTS = 257
"""Nodes per side of the solution. Scaling its film to the extrapolated central film removes the
inlet error of the grid (4 % at M = 1000). Finer grids up to FINEST are tried if it does not
converge or cannot be extrapolated: at high loads (M above about 2000) the inlet is steep."""
CYCLES = 100
"""Minimum of `max_cycles` with a boundary film: of the 112 contacts of
docs/evidence/inlet/share.csv that converge 13 take more than 30 cycles, and none more than 90."""
TOUCHES = 1.2
"""Film over boundary film above which solid contact is excluded: at this ratio the contacts of
docs/evidence/inlet, on 257 x 257 nodes, have a load share of at most 2.4e-4, and 0 if that grid
resolves the inlet; with a boundary film as thick as the film 3.5e-4."""

THINNING_POWER = -4.0 / 3.0
"""Exponent of the film in the effective inlet viscosity for waves: the length of the inlet relative
to a wave enters nabla_2, and M/L is proportional to the power -4/3 of the film in Hertz units."""


@dataclass(frozen=True, slots=True)
class SmoothContact:
    """Pressure and film of the smooth contact."""

    # Ascending and equidistant [a], (nx,) and (ny,)
    x: Array
    y: Array
    pressure: Array  # P (nx, ny) [p_h]
    film: Array  # H (nx, ny) [a^2/R]
    central_film: float  # H_c, extrapolated [a^2/R]
    central_film_error: float  # its estimated error [a^2/R]; NaN: not known
    source: str  # its origin, in words
    minimum_film: float = math.nan  # H_min, extrapolated as H_c [a^2/R]; NaN where it is not known
    extrapolated: bool = False  # whether `central_film` is extrapolated
    newtonian: SmoothContact | None = None  # the contact with a Newtonian flow; None: this one
    minimum_film_error: float = math.nan  # estimated error of `minimum_film` [a^2/R]
    load_share: float = math.nan  # load share of the boundary film [-]; NaN: not known

    @property
    def thinning(self) -> float:
        """Viscosity at low shear over that of a Newtonian lubricant with the same film [-]."""
        if self.newtonian is None:
            return 1.0
        return float((self.central_film / self.newtonian.central_film) ** THINNING_POWER)

    def at(self, x: Array, y: Array) -> tuple[Array, Array]:
        """Interpolate P and H (m, n) to x (m,) and y (n,); outside the domain P is zero."""
        if self.y.size == 1:
            # a line contact is the same on all lines
            ends = {"left": 0.0, "right": 0.0}
            film = np.interp(x, self.x, self.film[:, 0])
            row = np.interp(x, self.x, self.pressure[:, 0], **ends)
            on_lines = np.ones((1, y.size))
            return row[:, np.newaxis] * on_lines, film[:, np.newaxis] * on_lines
        rows, columns = _linear(x, self.x), _linear(y, self.y)
        result = []
        for values in (self.pressure, self.film):
            (i, u), (j, v) = rows, columns
            along = values[i] * (1.0 - u)[:, np.newaxis] + values[i + 1] * u[:, np.newaxis]
            result.append(along[:, j] * (1.0 - v) + along[:, j + 1] * v)
        inside = [(x >= axis[0]) & (x <= axis[-1]) for x, axis in ((x, self.x), (y, self.y))]
        result[0][~np.logical_and.outer(*inside)] = 0.0
        return result[0], result[1]


def _linear(places: Array, axis: Array) -> tuple[NDArray[np.intp], Array]:
    """Node before each position (m,) on an equidistant axis, and the weight of the next node."""
    at = (places - axis[0]) / (axis[1] - axis[0])
    before = np.clip(np.floor(at), 0, axis.size - 2).astype(np.intp)
    return before, np.clip(at - before, 0.0, 1.0)


def solve_contact(settings: Settings) -> SmoothContact:
    """Solve the smooth contact of a resolved case on POINTS x POINTS nodes, or on a finer grid.

    A line contact has one row of POINTS_OF_LINE nodes or more. The last few are cached, see
    `smooth_case`. EhlError if no grid up to FINEST, or FINEST_OF_LINE, converges.
    """
    result = solved_text(smooth_case(settings))
    if not ShearLaw.from_settings(settings).in_flow:
        return result
    newtonian = {**settings, "lubricant": {**settings["lubricant"], "flow": "newtonian"}}
    return replace(result, newtonian=solved_text(smooth_case(newtonian)))


def with_boundary_film(
    settings: Settings, contact: SmoothContact, lubricant: Lubricant
) -> SmoothContact:
    """Return the smooth contact with the boundary film of a case; `contact` is that without it.

    It is `contact` with a load share of 0 if its film is thick enough; else the solution on the
    first grid that resolves the inlet. If no grid does, or it does not converge, films are NaN and
    the source states why.
    """
    operating = operating_of(settings)
    boundary = float(settings["lubricant"]["boundary_film"]) / operating.film_scale
    pressure = np.maximum(contact.pressure, 0.0) * operating.hertz_pressure
    held = lubricant.density_ratio(pressure) * contact.film
    if float(held.min()) > TOUCHES * boundary:
        return replace(contact, load_share=0.0)
    cycles = max(CYCLES, int(settings["solver"]["max_cycles"]))
    result, why = _solved_with_boundary_film(smooth_case(settings, boundary=True), cycles)
    if result is not None:
        return result
    n = math.nan
    source = f"not known: with the boundary film {why}"
    return SmoothContact(contact.x, contact.y, n * pressure, n * pressure, n, n, source)


def circle_of(
    contact: SmoothContact, operating: AnyContact, lubricant: Lubricant
) -> tuple[float, float]:
    """M and L [-] of the circular contact with the same inlet, for a Newtonian flow."""
    film = (contact.newtonian or contact).central_film
    return circle_with_same_inlet(operating, lubricant, film)


def forget() -> None:
    """Clear the caches of solved contacts, as `benchmarks/skips.py` needs to time a solution."""
    solved_text.cache_clear()
    _solved_with_boundary_film.cache_clear()


@lru_cache(maxsize=8)
def solved_text(text: str) -> SmoothContact:
    """Solve a case of a smooth contact, on finer grids until its films can be extrapolated."""
    best = None
    points, finest = _grids(text)
    while points <= finest:
        result, status = _on_grid(text, points)
        best = result or best
        if result is not None and result.extrapolated:
            return result
        points = 2 * points - 1
    if best is None:
        raise EhlError(
            f"the smooth contact under the prediction did not converge on {finest} nodes along "
            f"X: {status}; reduce the load or enlarge the contact, or use 'pyehl predict --smooth' "
            "with a smooth contact that 'pyehl run' has solved on another grid"
        )
    return best


@lru_cache(maxsize=8)
def _solved_with_boundary_film(text: str, cycles: int) -> tuple[SmoothContact | None, str]:
    """Solve with a boundary film; None, and why, if no grid has a load share.

    If no finer grid has one, a grid of half as many nodes is tried; in docs/evidence/inlet finer
    grids have a load share for every contact for which 129 nodes have one.
    """
    options = [f"solver.max_cycles={cycles}"]
    why, (points, finest) = "it does not converge", _grids(text)
    while points <= finest:
        result, status = _on_grid(text, points, options)
        if result is not None and not status:
            return result, ""
        why = status if result is not None else why
        points = 2 * points - 1
    result, status = _on_grid(text, _grids(text)[0] // 2 + 1, options)
    return (None, why) if status else (result, "")


def _grids(text: str) -> tuple[int, int]:
    """Nodes along X of the first and of the finest grid for a case."""
    line = namelist.values(text)["contact"].get("shape") == "line"
    return (POINTS_OF_LINE, FINEST_OF_LINE) if line else (POINTS, FINEST)


def _on_grid(
    text: str, points: int, options: Sequence[str] = ()
) -> tuple[SmoothContact | None, str]:
    """Solve on a grid; None if there is no solution, with its status.

    With a solution '', or the reason why its load share is not known.
    """
    case = Case.from_text(text, [f"grid.points={points}", *options], origin="smooth contact")
    with SolverHandle(case.text) as solver:
        solver.run()
        result = results_of(solver)
        summary = result.values
        if summary["status"] != "converged":
            return None, str(summary["status"])
        (x, y), pressure, film = solver.axes(), solver.field("P"), solver.field("H")
    where = f"solved on {x.size} x {y.size} nodes"
    # with solid contact on a grid that does not resolve the inlet there is no load share
    touches = summary.get("contact_load_share", 0.0) is None
    why = words_of(result, case.resolve())[result.codes[SHARE_NOTE]] if touches else ""
    return contact_of(summary, (x, y), pressure, film, where), why


def contact_of(
    summary: Mapping[str, Any], axes: tuple[Array, Array], pressure: Array, film: Array, where: str
) -> SmoothContact:
    """Smooth contact from the summary of a run, its fields P and H (nx, ny), and its origin.

    The films are scaled to the extrapolated central film if there is one, which needs a solution on
    the next coarser grid.
    """
    limit = summary["H_c_extrapolated"]
    extrapolated = "extrapolated" if limit is not None else "not extrapolated"
    (central, error), (minimum, minimum_error) = (
        film_of(summary, name) for name in ("H_c", "H_min")
    )
    share = summary.get("contact_load_share")
    film = film * (central / summary["H_c"])
    for values in (*axes, pressure, film):
        values.flags.writeable = False
    return SmoothContact(
        *axes,
        pressure,
        film,
        central,
        math.nan if error is None else error,
        f"{where}, {extrapolated}",
        minimum,
        limit is not None,
        minimum_film_error=math.nan if minimum_error is None else minimum_error,
        load_share=math.nan if share is None else share,
    )


def film_of(summary: Mapping[str, Any], name: str) -> tuple[float, float | None]:
    """Film ``H_c`` or ``H_min`` of a run, extrapolated if possible, and its error."""
    limit = summary.get(f"{name}_extrapolated")
    return summary[name] if limit is None else limit, summary.get(f"{name}_error")


def hertz_contact(central_film: float, source: str) -> SmoothContact:
    """Semi-elliptical pressure and a uniform film [a^2/R], as in Zhang et al. 2019, section 3."""
    line = np.linspace(-1.0, 1.0, POINTS)
    square = line[:, np.newaxis] ** 2 + line[np.newaxis, :] ** 2
    pressure = np.sqrt(np.maximum(0.0, 1.0 - square))
    film = np.full(pressure.shape, central_film)
    return SmoothContact(line, line, pressure, film, central_film, float("nan"), source)


def zone_of(contact: SmoothContact, operating: AnyContact, lubricant: Lubricant) -> Zone:
    """Return the centre line of a smooth contact, for the transport of waves."""
    middle = int(np.argmin(np.abs(contact.y)))
    pressure = np.maximum(contact.pressure[:, middle], 0.0)
    film = contact.film[:, middle]
    zone = zone_on(contact.x, pressure, film, operating, lubricant)
    if contact.newtonian is None:
        return zone
    oil = replace(lubricant, shear=replace(lubricant.shear, in_flow=False))
    return replace(zone, newtonian=zone_of(contact.newtonian, operating, oil))


def heat_of(settings: Settings, contact: SmoothContact, lubricant: Lubricant) -> Heat:
    """Return the effect of frictional heating on the smooth contact of a resolved case.

    Computed from pressure and film of the prediction. InputError if the case is not valid.
    """
    # mirrored rows have the same temperature
    even = float(settings["contact"].get("angle", 0.0)) == 0.0 and contact.y.size > 1
    first = int(np.argmin(np.abs(contact.y))) if even else 0
    pressure, film = contact.pressure[:, first:], contact.film[:, first:]
    nodes = HeatOf(settings, lubricant, contact.x, contact.y[first:], even=even)
    return nodes(pressure, film, np.zeros(film.shape, dtype=bool))
