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
        "surface_preparation": made.record.summary() if made else None,
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
class SecondSurface:
    """The second rough surface of a prediction."""

    surface: Topography  # the undeformed roughness
    velocity_ratio: float  # its velocity over the mean velocity [-]
    passage: SecondPassage  # delta p and deformed roughness, positions

    @property
    def arrays(self) -> dict[str, Array]:
        """Arrays as those of the first surface."""
        return arrays(self.surface, self.passage.response, SECOND)

    def summary(self, first: Topography) -> dict[str, Any]:
        """Return what a summary holds of it, and of both beside the `first` one."""
        both = first, self.surface
        return {
            "second_velocity_ratio": self.velocity_ratio,
            **statistics(self.surface, self.passage.response, SECOND),
            "surface_rms_m": math.hypot(*(tile.rms_height for tile in both)),
            "surface_slope": math.hypot(*(_slope(tile) for tile in both)),
        }


def _slope(tile: Topography) -> float:
    """Rms slope [-]."""
    waves = Spectrum.of(tile.heights, *tile.size)
    return math.sqrt(float((np.square(waves.q) * waves.power).sum()))
