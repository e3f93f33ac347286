# SPDX-License-Identifier: BSD-3-Clause
"""Which waves are measured together, on which grid."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from pyehl.studies.superposition import WaveSet, step_counts

__all__ = ["DIRECTIONS", "TIERS", "Tier", "ridge_wavelengths", "tier_waves"]

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
    # Wavelengths along the motion, and shortest of all [a]. Of ridges: across it
    longest: float
    shortest: float
    # Steady solutions with ridges along the motion (:mod:`pyehl.studies.ridges`)
    ridges: bool = False

    def steps(self, velocity_ratio: float) -> int:
        """Count the steps of the run; of ridges the solutions."""
        if self.ridges:
            return 1 + len(ridge_wavelengths(self))
        return step_counts(self.points, self.tile, velocity_ratio)[1]


TIERS = (
    Tier("ridges", 4.0, 257, 2.0, 0.125, ridges=True),
    Tier("long", 4.0, 257, 4.0, 0.125),
    Tier("middle", 1.0, 513, 0.5, 0.0625),
    Tier("short", 0.5, 1025, 0.125, 0.03125),
)
"""The tiers of the command; the first three are those of a quick measurement."""


def ridge_wavelengths(tier: Tier) -> list[float]:
    """Wavelengths of ridges, an octave apart [a]."""
    octaves = round(math.log2(tier.longest / tier.shortest))
    return [tier.longest / 2**k for k in range(octaves + 1)]


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
