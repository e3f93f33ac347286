# SPDX-License-Identifier: BSD-3-Clause
"""Friction of a contact at one position of a rough tile, on the pixels of the tile.

Units: lengths along the surface by a, films by a^2/R, pressures by p_h.
"""

import numpy as np

from pyehl import extension
from pyehl.prediction.edge import Edge
from pyehl.prediction.smooth import SmoothContact
from pyehl.prediction.waves import REFINEMENT, Waves
from pyehl.prediction.wavy_contact import REACH, WavyContact, slipped, two_lines
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Array, Single


class RoughContact(WavyContact):
    """Points of a contact at pixels of one tile with waves."""

    def __init__(
        self,
        waves: Waves,
        edge: Edge,
        contact: SmoothContact,
        *,
        pixel: tuple[float, float],
        stride: int,
        operating: OperatingPoint,
        lubricant: Lubricant,
        velocity_ratio: float,
        second: tuple[Array, Array] | None = None,
    ) -> None:
        self.waves, self.edge, self.pixel = waves, edge, pixel
        reach = REACH, REACH * operating.ellipse.ellipticity
        half = [int(r / (stride * p)) for r, p in zip(reach, pixel, strict=True)]
        self.rows, self.columns = (np.arange(-n, n + 1, dtype=np.int32) * stride for n in half)
        super().__init__(
            contact,
            np.asarray(self.rows * pixel[0], dtype=float),
            np.asarray(self.columns * pixel[1], dtype=float),
            edges=[edge],
            area=stride**2 * pixel[0] * pixel[1] * operating.hertz_radius**2,
            operating=operating,
            lubricant=lubricant,
            second=second,
        )
        # the free wave is that of the roughness where it was when the inlet made it; without a bend
        # it is so on all lines
        lines = self.across if waves.bent else np.zeros(1)
        way = slipped(self.x[:, np.newaxis], lines, velocity_ratio, bent=waves.bent)
        place = (self.x[:, np.newaxis] + way) / pixel[0] * REFINEMENT
        self.free_rows = np.floor(place).astype(np.int32)
        self.between = (place - self.free_rows).astype(np.float32)
        # of the track that was met last
        self.beside: dict[int, Single | None] = {}

    def change(self, shift: int, track: int = 0) -> Single:
        """Loss of film [a^2/R] and gain of pressure [p_h] at the points, (m, n, 2).

        The tile has moved by `shift` and `track` pixels along and across the motion; `track` is a
        multiple of the stride of the waves.
        """
        waves = self.waves
        columns = (self.columns - track) // waves.stride % waves.driven.shape[2]
        columns = columns.astype(np.int32)
        if track not in self.beside:
            self.beside = {track: waves.beside(columns, *two_lines(self.across))}
        beside = self.beside[track]
        total = np.zeros((*self.film.shape, 2), dtype=np.float32)
        extension.surface_functions.driven_waves(
            waves.driven.T, self.rows, columns, self.weights.T, shift, total.T
        )
        self.add_free(
            waves, beside, (self.free_rows, self.between), columns, shift * REFINEMENT, total
        )
        self.add_edge(total, self.edge.at(shift * self.pixel[0], track * self.pixel[1]))
        self.add_second(total)
        return total

    def friction(self, shift: int, track: int = 0) -> float:
        """Friction over that of the smooth contact; NaN where the film is not positive."""
        return self.sheared(self.change(shift, track))
