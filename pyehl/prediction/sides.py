# SPDX-License-Identifier: BSD-3-Clause
"""What a result holds of each rough surface of a prediction."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from pyehl.prediction.contact import Response
from pyehl.prediction.friction import SecondPassage
from pyehl.prediction.spectrum import Spectrum
from pyehl.surfaces import Topography
from pyehl.types import Array

SECOND = "second_"
"""Before the names of what belongs to the second surface."""


def arrays(tile: Topography, response: Response, prefix: str = "") -> dict[str, Array]:
    """Coordinates (nx,), (ny,) [m], heights [m] and response (nx, ny) of a surface."""
    nx, ny = tile.shape
    found = {
        "x": np.arange(nx, dtype=float) * tile.pixel[0],
        "y": np.arange(ny, dtype=float) * tile.pixel[1],
        "surface": np.asfortranarray(tile.heights),
        "deformed": np.asfortranarray(response.deformed),
        "delta_p": np.asfortranarray(response.pressure),
    }
    return {prefix + name: values for name, values in found.items()}


def statistics(tile: Topography, response: Response, prefix: str = "") -> dict[str, Any]:
    """Numbers of a surface that a summary holds."""
    made = tile.preparation
    found = {
        "surface": tile.origin,
        "surface_preparation": made.record.summary if made else None,
        "seed": tile.seed,
        "pixels": list(tile.shape),
        "length_x_m": tile.length_x,
        "length_y_m": tile.length_y,
        "rms_height_m": tile.rms_height,
        "rms_deformed_m": float(np.std(response.deformed)),
        "rms_pressure_Pa": float(np.std(response.pressure)),
    }
    return {prefix + name: value for name, value in found.items()}


@dataclass(frozen=True, slots=True)
class Together:
    """The sum of two surfaces that move together."""

    tile: Topography  # undeformed
    deformed_rms: float  # [m]


@dataclass(frozen=True, slots=True)
class SecondSurface:
    """The second rough surface of a prediction."""

    surface: Topography  # the undeformed roughness
    velocity_ratio: float  # its velocity over the mean velocity [-]
    passage: SecondPassage  # delta p and deformed roughness, positions
    together: Together | None = None  # the sum of both where they move together

    @property
    def arrays(self) -> dict[str, Array]:
        """Arrays as those of the first surface."""
        return arrays(self.surface, self.passage.response, SECOND)

    def summary_with(self, first: Topography) -> dict[str, Any]:
        """Return what a summary holds of it, and of both beside the `first` one."""
        both = first, self.surface
        together = self.together.tile if self.together else None
        slopes = [_slope(tile) for tile in both]
        return {
            "second_velocity_ratio": self.velocity_ratio,
            **statistics(self.surface, self.passage.response, SECOND),
            "surface_rms_m": composite_rms(first, self.surface, together),
            "surface_slope": _slope(together) if together else math.hypot(*slopes),
            "surface_correlation": correlation(first, self.surface, together),
        }


def findings_of(*tiles: Topography | None) -> str | None:
    """Name what the maps have that is no roughness; None if there is nothing."""
    kinds = [
        finding.kind
        for tile in tiles
        if tile is not None and tile.preparation is not None
        for finding in tile.preparation.record.findings
    ]
    return ", ".join(dict.fromkeys(kinds)) or None


def composite_rms(first: Topography, second: Topography, together: Topography | None) -> float:
    """Rms height [m] of two surfaces: of their sum where they move `together`.

    Else that of surfaces that have nothing in common, as in the mean over all positions.
    """
    return together.rms_height if together else math.hypot(first.rms_height, second.rms_height)


def correlation(first: Topography, second: Topography, together: Topography | None) -> float:
    """Correlation of the heights of two surfaces that move `together`; NaN where they do not."""
    product = first.rms_height * second.rms_height
    if together is None or product == 0.0:
        return math.nan
    squares = first.rms_height**2 + second.rms_height**2
    return (together.rms_height**2 - squares) / (2.0 * product)


def _slope(tile: Topography) -> float:
    """Rms slope [-]."""
    waves = Spectrum.of(tile.heights, *tile.size)
    return math.sqrt(float((np.square(waves.q) * waves.power).sum()))
