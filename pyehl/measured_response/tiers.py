# SPDX-License-Identifier: BSD-3-Clause
"""Which waves are measured together, on which grid."""

from dataclasses import dataclass

import numpy as np

from pyehl.measured_response.superposition import WaveSet, step_counts

# Angles of the crests to those across the motion, one wave after the other [deg]
DIRECTIONS = (0, 45, 80, 26, 0, 63, 15, 75, 0, 56, 35, 70, 0, 45, 62, 20)
NODES = 8
"""Least number of nodes a wavelength."""


@dataclass(frozen=True, slots=True)
class Tier:
    """One run."""

    name: str  # of the tier and of its file
    tile: float  # side of the tile [a]
    points: int  # nodes per side of the domain, 4 a by 4 a
    # Wavelengths along the motion, and shortest of all [a]
    longest: float
    shortest: float

    def steps(self, velocity_ratio: float) -> int:
        """Count the steps of the run."""
        return step_counts(self.points, self.tile, velocity_ratio)[1]


TIERS = (
    Tier("long", 4.0, 257, 4.0, 0.125),
    Tier("middle", 1.0, 513, 0.5, 0.0625),
    Tier("short", 0.5, 1025, 0.125, 0.03125),
)
"""The tiers of the command; all but the last are those of a quick measurement."""


def tier_waves(tier: Tier) -> WaveSet:
    """Waves of a tier: all wavelengths it can tell apart, up to 24, in scattered directions.

    ValueError if the grid has fewer than NODES nodes for the shortest wave.
    """
    nodes = tier.shortest * (tier.points - 1) / 4.0
    if nodes < NODES - 1e-9:
        raise ValueError(f"tier '{tier.name}': {nodes:g} nodes for the shortest wave, not {NODES}")
    first, last = round(tier.tile / tier.longest), round(tier.tile / tier.shortest)
    along = np.unique(np.round(np.geomspace(first, last, 24)).astype(np.int64))
    angles = np.resize(np.array(DIRECTIONS, dtype=float), along.size)
    across = np.round(along * np.tan(np.radians(angles))).astype(np.int64)
    # no wave is shorter than the shortest
    limit = np.floor(np.sqrt(last**2 - along**2)).astype(np.int64)
    phase = np.random.default_rng(5).uniform(0.0, 2.0 * np.pi, along.size)
    return WaveSet(tier.tile, along, np.minimum(across, limit), phase)
