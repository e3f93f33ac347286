# SPDX-License-Identifier: BSD-3-Clause
"""What the grid of a transient run does not resolve, by the prediction."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from pyehl import surfaces
from pyehl.case import Case
from pyehl.errors import EhlError
from pyehl.prediction.by_response import RoughPassage
from pyehl.prediction.options import Options
from pyehl.prediction.smooth import solve_contact
from pyehl.solver import Solver
from pyehl.surfaces import Topography
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint

__all__ = ["Resolution", "add_resolution", "resolution"]

NODES = 8
"""Nodes that a wave needs to be resolved."""
CARRIED = 2
"""Nodes that a wave needs to be on the grid at all."""
TOLERANCE = 0.01
"""Share of mu_r/mu_s that may hang on waves that are not resolved, without a warning."""


@dataclass(frozen=True, slots=True)
class Resolution:
    """How much of a predicted mu_r/mu_s a grid resolves.

    Attributes
    ----------
    mu_ratio
        Predicted with all waves [-].
    resolved, carried
        The same without the waves that have fewer than NODES, or CARRIED nodes [-].
    shortest
        Wavelength that has NODES nodes [m].
    part
        Which part of a large surface it was predicted with; empty: the whole.
    """

    mu_ratio: float
    resolved: float
    carried: float
    shortest: float
    part: str = ""

    @property
    def matters(self) -> bool:
        """Whether more than TOLERANCE of the answer hangs on waves that are not resolved."""
        return abs(self.mu_ratio - self.resolved) > TOLERANCE * self.mu_ratio

    def __str__(self) -> str:
        """Say it in a line."""
        rise, part = self.mu_ratio - 1.0, self.mu_ratio - self.resolved
        return (
            f"predicted   mu_r/mu_s {self.mu_ratio:.3f}; of the rise {rise:+.3f}, {part:+.3f} come "
            f"from waves shorter than {self.shortest * 1e6:.3g} um, {NODES} nodes of this grid"
            + (f" (predicted with {self.part})" if self.part else "")
        )

    def report(self) -> list[str]:
        """Lines of the plan."""
        lines = [str(self)]
        if self.matters:
            lines.append(
                f"warning: more than {TOLERANCE:.0%} of mu_r/mu_s hangs on waves with fewer than "
                f"{NODES} nodes; a finer grid (grid.points) or surface.shortest_wavelength "
                "resolves what is left"
            )
        return lines

    def amend(self, values: dict[str, Any]) -> None:
        """Add to a summary what hangs on the waves, and to the error what the grid leaves out.

        The error from two grids knows nothing of waves that neither of them carries.
        """
        values["mu_ratio_unresolved"] = self.mu_ratio - self.resolved
        # waves that the grid carries in both directions are not left out, short as they may be
        out = self.mu_ratio - self.carried if values.get("variance_left_out") else 0.0
        values["mu_ratio_left_out"] = out
        if values.get("mu_ratio_error") is not None:
            values["mu_ratio_error"] += abs(out)


def add_resolution(solver: Solver, case: Case) -> None:
    """Predict what the grid of a solver does not resolve, for its plan and its summary.

    Nothing is added to a case without such waves, or without a prediction.
    """
    try:
        tile = solver.part and surfaces.finished(solver.part, case.resolve()["surface"])
        solver.resolution = resolution(case, tile, tile.origin if tile else "")
    except (ValueError, OSError, EhlError):
        # the run itself says what is wrong with the case
        solver.resolution = None


def resolution(case: Case, tile: Topography | None = None, part: str = "") -> Resolution | None:
    """Predict what the grid of a case resolves.

    None for surfaces that are no tile of heights on the move, for those without waves that the grid
    does not resolve, and where the prediction gives no ratio.

    Parameters
    ----------
    case
        Its grid is that of the run.
    tile
        Its surface; None: made as the case says, of a large one the part of
        :func:`pyehl.surfaces.part_of`.
    part
        Name of the part, if `tile` is one.

    Raises
    ------
    InputError, FileError
        If the surface is not usable.
    """
    settings = case.resolve()
    ratio = float(settings["surface"]["velocity_ratio"])
    if settings["surface"]["kind"] not in ("map", "fractal") or ratio == 0.0:
        return None
    operating = OperatingPoint.from_settings(settings)
    lubricant = Lubricant.from_settings(settings)
    grid = settings["grid"]
    mesh = max(float(grid["x_outlet"]) - float(grid["x_inlet"]), 2.0 * float(grid["y_extent"])) / (
        int(grid["points"]) - 1
    )
    contact = solve_contact(settings)
    if tile is None:
        film = contact.central_film * operating.film_scale
        tile = surfaces.from_settings(settings, operating, film)
        middle = surfaces.part_of(tile.heights, tile.pixel, tile.origin)
        if middle is not None:
            tile, part = middle, middle.origin
    passage = RoughPassage(tile, contact, operating, lubricant, Options(), ratio)
    if not passage.variance_below(NODES * mesh) > 0.0:
        return None
    found, _, _ = passage.run(0, brief=True)
    if not math.isfinite(found.mu_ratio):
        return None
    resolved, carried = (passage.below(nodes * mesh) for nodes in (NODES, CARRIED))
    shortest = NODES * mesh * operating.hertz_radius
    return Resolution(found.mu_ratio, resolved, carried, shortest, part)
