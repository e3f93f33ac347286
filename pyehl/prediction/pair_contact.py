# SPDX-License-Identifier: BSD-3-Clause
"""Friction of a contact at one position of each of two rough tiles.

To first order film and pressure of the waves of both add up. The pressure of second order is that
of the sum. Their tiles have pixels and lengths of their own, so that the points are on a grid of
their own, and the waves are made on its lines.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from pyehl import extension
from pyehl.prediction.edge import Edge
from pyehl.prediction.smooth import SmoothContact
from pyehl.prediction.spectrum import Spectrum
from pyehl.prediction.transfer import Transfer
from pyehl.prediction.waves import REFINEMENT, Waves
from pyehl.prediction.wavy_contact import REACH, WavyContact, slipped, two_lines
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Array, Single

PairParts = list[tuple[Spectrum, Transfer, Edge]]

POINTS = 60.5
"""Points per semi-axis; half a one more, so that the next semi-axis has other ones."""


class TileOnPoints:
    """The waves of a moving tile on the points of a contact.

    `points`: X and Y [a], and Y by the semi-axis across the motion. `track`: how far the tile is
    moved across the motion [a].
    """

    def __init__(
        self,
        spectrum: Spectrum,
        transfer: Transfer,
        edge: Edge,
        central_film: float,
        velocity_ratio: float,
        points: tuple[Array, Array, Array],
        track: float = 0.0,
    ) -> None:
        x, y, across = points
        self.edge, self.track = edge, track
        self.waves = Waves.of(spectrum, transfer, central_film, velocity_ratio, lines=y - track)
        every = np.arange(y.size, dtype=np.int32)
        self.beside = self.waves.beside(every, *two_lines(across))
        self.scale = REFINEMENT / spectrum.pixel[0]
        self.places = x[:, np.newaxis]
        lines = across if transfer.bent else np.zeros(1)
        way = slipped(self.places, lines, velocity_ratio, bent=transfer.bent)
        self.free_places = self.places + way

    def _rows(self, places: Array) -> tuple[NDArray[np.int32], Single]:
        """Row of the waves before places [a], and the share of the next one."""
        at = places * self.scale
        low = np.floor(at)
        return low.astype(np.int32), (at - low).astype(np.float32)

    def add(self, contact: PairContact, shift: float, total: Single) -> None:
        """Add loss of film and gain of pressure (m, n, 2) where the tile has moved by a shift."""
        columns = np.arange(contact.y.size, dtype=np.int32)
        driven, free = (self._rows(places - shift) for places in (self.places, self.free_places))
        rows, between = driven
        extension.surface_functions.waves_between(
            self.waves.driven.T, rows[:, 0], columns, between[:, 0], contact.weights.T, total.T
        )
        contact.add_free(self.waves, self.beside, free, columns, 0, total)


class PairContact(WavyContact):
    """Points of a contact with the waves of two tiles.

    `parts` of both move by velocity `ratios`; `powers` of the components as the transfers were made
    for them, `tracks`: how far both are moved across the motion [a].
    """

    def __init__(
        self,
        contact: SmoothContact,
        operating: OperatingPoint,
        lubricant: Lubricant,
        parts: PairParts,
        ratios: Sequence[float],
        *,
        powers: Sequence[Array] | None = None,
        tracks: tuple[float, float] = (0.0, 0.0),
    ) -> None:
        second = parts[0][1].second
        powers = powers or [spectrum.power for spectrum, _, _ in parts]
        half = int(REACH * POINTS)
        line = np.arange(-half, half + 1) / POINTS
        super().__init__(
            contact,
            line,
            line * operating.ellipse.ellipticity,
            edges=[edge for _, _, edge in parts],
            area=operating.hertz_radius * operating.semi_axis_y / POINTS**2,
            operating=operating,
            lubricant=lubricant,
            second=second.of(*powers) if second else None,
        )
        points = self.x, self.y, self.across
        self.tiles = tuple(
            TileOnPoints(*part, contact.central_film, ratio, points, track)
            for part, ratio, track in zip(parts, ratios, tracks, strict=True)
        )
        self.touching = 0  # points with a film that is not positive, at all positions

    def friction(self, shifts: tuple[float, float]) -> float:
        """Friction over that of the smooth contact, the tiles moved by shifts [a].

        NaN where the film is not positive.
        """
        total = np.zeros((*self.film.shape, 2), dtype=np.float32)
        for tile, shift in zip(self.tiles, shifts, strict=True):
            tile.add(self, shift, total)
        shifted = zip(self.tiles, shifts, strict=True)
        self.add_edge(total, *(tile.edge.at(shift, tile.track) for tile, shift in shifted))
        self.add_second(total)
        smooth = self.smooth_film()
        ended = total[..., 0] >= self.ends * smooth
        self.touching += int(np.count_nonzero(ended & self.inside))
        return self.sheared(total, smooth)
