# SPDX-License-Identifier: BSD-3-Clause
"""What the grid of a transient run does not resolve, by the prediction."""

from __future__ import annotations

import math
from dataclasses import dataclass

from pyehl import surfaces
from pyehl.case import Case
from pyehl.errors import EhlError, InputError
from pyehl.prediction.by_response import RoughPassage
from pyehl.prediction.options import Options, turned, unpredictable
from pyehl.prediction.smooth import solve_contact
from pyehl.prediction.spectrum import Spectrum
from pyehl.surfaces import Topography
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint

__all__ = ["Resolution", "resolution"]

NODES = 8
"""Nodes that a wave needs to be resolved."""
CARRIED = 2
"""Nodes that a wave needs to be on the grid at all."""
TOLERANCE = 0.01
"""Share of mu_r/mu_s that may hang on waves that are not resolved, without a warning."""


@dataclass(frozen=True, slots=True)
class Resolution:
    """How much of a predicted mu_r/mu_s a grid resolves."""

    mu_ratio: float  # predicted with all waves [-]
    # The same without the waves that have fewer than NODES, or CARRIED nodes [-]
    resolved: float
    carried: float
    shortest: float  # wavelength that has NODES nodes [m]
    part: str = ""  # which part of a large surface it was predicted with; empty: the whole

    @property
    def matters(self) -> bool:
        """Whether more than TOLERANCE of the answer hangs on waves that are not resolved."""
        return abs(self.unresolved) > TOLERANCE * self.mu_ratio

    def __str__(self) -> str:
        """Say it in a line."""
        rise, part = self.mu_ratio - 1.0, self.unresolved
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

    @property
    def unresolved(self) -> float:
        """Part of the ratio in waves with fewer than NODES nodes [-]."""
        return self.mu_ratio - self.resolved

    @property
    def left_out(self) -> float:
        """Part of the ratio in waves with fewer than CARRIED nodes [-].

        The error from two grids knows nothing of them: neither grid carries them.
        """
        return self.mu_ratio - self.carried


def resolution(case: Case, tile: Topography | None = None) -> Resolution | None:
    """Predict what the grid of a case resolves.

    None for surfaces that are no tile of heights on the move, and for those without waves that the
    grid does not resolve. `tile` is the surface on its track, of a large one a part, before the
    spectrum is cut; None: made as the case says, of a large one the part of
    :func:`pyehl.surfaces.part_of`. EhlError if the smooth contact has no solution, or the
    prediction gives no ratio; InputError or FileError if the surface is not usable, InputError if
    there are two rough ones and one is such a tile.
    """
    settings = surfaces.one_rough(case.resolve())
    rough = [settings[group] for group in surfaces.rough_groups(settings)]
    if not any(s["kind"] in ("map", "fractal") and s["velocity_ratio"] != 0.0 for s in rough):
        return None
    if len(rough) > 1:
        raise InputError(unpredictable(settings))
    ratio = float(settings["surface"]["velocity_ratio"])
    operating = OperatingPoint.from_settings(settings)
    if turned(settings):
        raise InputError(turned(settings))
    lubricant = Lubricant.from_settings(settings)
    grid = settings["grid"]
    mesh = max(
        (float(grid["x_outlet"]) - float(grid["x_inlet"])) / (int(grid["points"]) - 1),
        2.0 * float(grid["y_extent"]) / (int(grid["points_y"]) - 1),
    )
    part = ""
    if tile is not None:
        tile = surfaces.finished(tile, {**settings["surface"], "track": 0.0})
        part = tile.origin
    else:
        # the film is the scale of harmonic patterns alone
        tile = surfaces.from_settings(settings, operating, film=0.0)
        middle = surfaces.part_of(tile.heights, tile.pixel, tile.origin)
        if middle is not None:
            tile, part = middle, middle.origin
    shortest = NODES * mesh * operating.hertz_radius
    if not Spectrum.of(tile.heights, tile.length_x, tile.length_y).share_below(shortest) > 0.0:
        return None
    contact = solve_contact(settings)
    passage = RoughPassage(tile, contact, operating, lubricant, Options(), ratio)
    found, _, _ = passage.run(0, brief=True)
    if not math.isfinite(found.mu_ratio):
        raise EhlError(f"{found.status}: {found.message}")
    resolved, carried = (passage.below(nodes * mesh) for nodes in (NODES, CARRIED))
    return Resolution(found.mu_ratio, resolved, carried, shortest, part)
