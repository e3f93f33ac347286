# SPDX-License-Identifier: BSD-3-Clause
"""A periodic tile of heights."""

import math
from dataclasses import dataclass

import numpy as np

from pyehl.errors import InputError
from pyehl.given import real_numbers
from pyehl.surfaces.prepare import Preparation
from pyehl.types import Array

MAX_PIXELS = 2**26
"""Most pixels a map may have (512 MB of heights)."""


@dataclass(frozen=True, slots=True)
class Topography:
    """A periodic tile of heights.

    Attributes
    ----------
    heights
        (nx, ny) [m], first index along the motion, peaks positive.
    size
        Length of the tile along x and y [m].
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

    Examples
    --------
    >>> import numpy as np
    >>> import pyehl
    >>> x = np.arange(64) / 64
    >>> ridges = 1e-8 * np.cos(2.0 * np.pi * x)[:, None] * np.ones(32)
    >>> tile = pyehl.Topography(ridges, size=(2e-4, 1e-4))
    >>> tile.shape, float(round(tile.rms_height * 1e9, 3))
    ((64, 32), 7.071)
    """

    heights: Array
    size: tuple[float, float]
    origin: str = ""
    seed: int | None = None
    preparation: Preparation | None = None

    def __post_init__(self) -> None:
        """Check shape, numbers and size."""
        what = self.origin or "surface"
        # a hole of a masked array is no height
        z = np.asarray(real_numbers(self.heights, what), dtype=np.float64)
        object.__setattr__(self, "heights", z)
        if z.ndim != 2 or min(z.shape) < 2:
            raise InputError(
                f"{what}: heights must be a matrix (nx, ny) of at least 2 x 2, "
                f"not of shape {z.shape}"
            )
        bad = int(z.size - np.count_nonzero(np.isfinite(z)))
        if bad:
            i, j = np.argwhere(~np.isfinite(z))[0]
            raise InputError(
                f"{what}: {bad} of {z.size} heights are not finite, the first "
                f"at row {i}, column {j}; fill the holes of the map first"
            )
        try:
            length_x, length_y = map(float, self.size)
        except (TypeError, ValueError):
            raise InputError(
                f"{what}: size = {self.size!r}: expected the two lengths of the tile [m]"
            ) from None
        for name, value in (("length_x", length_x), ("length_y", length_y)):
            if not (math.isfinite(value) and value > 0.0):
                raise InputError(f"{what}: {name} must be positive [m], not {value!r}")
        object.__setattr__(self, "size", (length_x, length_y))

    @property
    def length_x(self) -> float:
        """Length of the tile along x [m]."""
        return self.size[0]

    @property
    def length_y(self) -> float:
        """Length of the tile along y [m]."""
        return self.size[1]

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
