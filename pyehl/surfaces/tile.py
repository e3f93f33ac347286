# SPDX-License-Identifier: BSD-3-Clause
"""A periodic tile of heights."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pyehl.errors import InputError
from pyehl.surfaces.prepare import Preparation

__all__ = ["MAX_PIXELS", "Topography"]

Array = NDArray[np.float64]

MAX_PIXELS = 2**26
"""Most pixels a map may have (512 MB of heights)."""


@dataclass(frozen=True, slots=True)
class Topography:
    """A periodic tile of heights.

    Attributes
    ----------
    heights
        (nx, ny) [m], peaks positive.
    length_x, length_y
        Size of the tile [m].
    origin
        Where it came from, in words.
    seed
        Seed of a generated surface, else None.
    preparation
        How a map became this tile, else None.

    Raises
    ------
    InputError
        If the heights are not a finite matrix of at least 2 x 2 or a length is not positive.
    """

    heights: Array
    length_x: float
    length_y: float
    origin: str = ""
    seed: int | None = None
    preparation: Preparation | None = None

    def __post_init__(self) -> None:
        """Check shape, numbers and size."""
        z = self.heights
        if z.ndim != 2 or min(z.shape) < 2:
            raise InputError(
                f"{self.origin or 'surface'}: heights must be a matrix (nx, ny) of at least 2 x 2, "
                f"not of shape {z.shape}"
            )
        bad = int(z.size - np.count_nonzero(np.isfinite(z)))
        if bad:
            i, j = np.argwhere(~np.isfinite(z))[0]
            raise InputError(
                f"{self.origin or 'surface'}: {bad} of {z.size} heights are not finite, the first "
                f"at row {i}, column {j}; fill the holes of the map first"
            )
        for name, value in (("length_x", self.length_x), ("length_y", self.length_y)):
            if not (math.isfinite(value) and value > 0.0):
                raise InputError(f"{name} must be positive [m], not {value!r}")

    @property
    def shape(self) -> tuple[int, int]:
        """Pixels along x and y."""
        return self.heights.shape[0], self.heights.shape[1]

    @property
    def pixel(self) -> tuple[float, float]:
        """Pixel size along x and y [m]."""
        return self.length_x / self.shape[0], self.length_y / self.shape[1]

    @property
    def rms_height(self) -> float:
        """Root mean square of the heights about their mean [m]."""
        return float(np.std(self.heights))
