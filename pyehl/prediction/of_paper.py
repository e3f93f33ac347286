# SPDX-License-Identifier: BSD-3-Clause
"""The model of Zhang et al. 2019, section 3, over a passage, over its tracks, and by bands."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pyehl.prediction.bands import Band, contributions
from pyehl.prediction.flattening import response
from pyehl.prediction.friction import RoughFriction, predict_friction
from pyehl.prediction.options import Options
from pyehl.surfaces import Topography, shifted, track_offsets
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint

__all__ = ["PaperPassage"]


@dataclass(frozen=True, slots=True)
class PaperPassage:
    """A rough tile in the dry contact with a uniform film, asked as `by_response.RoughPassage`."""

    topography: Topography
    operating: OperatingPoint
    lubricant: Lubricant
    film: float  # central film h_c [m]
    options: Options

    def run(
        self, tracks: int, *, brief: bool = False
    ) -> tuple[RoughFriction, tuple[float, float], list[Band]]:
        """Friction over the passage, mean and spread over the tracks, and what each band adds.

        `brief`: of the bands the shortest alone. No tracks: NaN for mean and spread, as where one
        of them has no ratio.
        """
        rest = self.operating, self.lubricant, self.film, self.options
        friction = predict_friction(self.topography, *rest)
        bands = contributions(self.topography, *rest, brief=brief)
        if not tracks:
            return friction, (math.nan, math.nan), bands
        tiles = (shifted(self.topography, 0.0, d) for d in track_offsets(self.topography, tracks))
        ratios = np.array([predict_friction(tile, *rest).mu_ratio for tile in tiles])
        return friction, (float(ratios.mean()), float(ratios.std())), bands

    def deformed(self) -> NDArray[np.float64]:
        """Deformed roughness (nx, ny) [m]."""
        return response(self.topography, self.operating, self.options).deformed

    def known(self) -> bool:
        """Whether the error of the ratio is; that of the paper never is, and is not asked for."""
        return True
