# SPDX-License-Identifier: BSD-3-Clause
"""What the grid of a transient run does not resolve, by the prediction."""

from __future__ import annotations

from dataclasses import dataclass

from pyehl import surfaces
from pyehl.case import Case
from pyehl.prediction.by_response import RoughPassage
from pyehl.prediction.options import Options
from pyehl.prediction.smooth import solve_contact
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint

__all__ = ["Resolution", "resolution"]

NODES = 8
"""Nodes that a wave needs to be resolved."""
TOLERANCE = 0.01
"""Share of mu_r/mu_s that may hang on waves with fewer, without a warning."""


@dataclass(frozen=True, slots=True)
class Resolution:
    """How much of a predicted mu_r/mu_s a grid resolves.

    Attributes
    ----------
    mu_ratio
        Predicted with all waves [-]; NaN where there is no prediction.
    resolved
        The same without the waves that have fewer than NODES nodes [-].
    shortest
        Wavelength that has so many nodes [m].
    """

    mu_ratio: float
    resolved: float
    shortest: float

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
        )


def resolution(case: Case) -> Resolution | None:
    """Predict what the grid of a case resolves; None for surfaces that are no tile of heights.

    Raises
    ------
    ValueError, OSError
        If the surface is not usable.
    """
    settings = case.resolve()
    if settings["surface"]["kind"] not in ("map", "fractal"):
        return None
    operating = OperatingPoint.from_settings(settings)
    lubricant = Lubricant.from_settings(settings)
    grid = settings["grid"]
    mesh = max(float(grid["x_outlet"]) - float(grid["x_inlet"]), 2.0 * float(grid["y_extent"])) / (
        int(grid["points"]) - 1
    )
    contact = solve_contact(settings)
    tile = surfaces.from_settings(settings, operating, contact.central_film * operating.film_scale)
    ratio = float(settings["surface"]["velocity_ratio"])
    passage = RoughPassage(tile, contact, operating, lubricant, Options(), ratio)
    found, _, _ = passage.run(tracks=1)
    shortest = NODES * mesh
    return Resolution(found.mu_ratio, passage.below(shortest), shortest * operating.hertz_radius)
