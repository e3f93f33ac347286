# SPDX-License-Identifier: BSD-3-Clause
"""Pressure, film and friction of a contact at one position of one or two rough surfaces.

Pressure P_s + delta P and film H_s - rr_d with P_s and H_s of the smooth contact; friction is the
integral of the shear stress (Zhang et al. 2019, eqs 13, 14). To first order the waves of all
surfaces add up (:mod:`pyehl.prediction.moving_tile`); the pressure of second order is that of the
sum (:mod:`pyehl.prediction.response`); waves longer than half the contact radius also depend on the
edge of the contact, which they displace.

The points of the contact under one surface are pixels of its tile. Two tiles have different pixels
and lengths: there the points are on a grid of the contact, and the waves are computed on its lines.
Units: lengths along the surface by a, films by a^2/R, pressures by p_h.
"""

from __future__ import annotations

import copy
import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pyehl import extension
from pyehl.contact.sheared import INNER, NEAR, ShearedContact
from pyehl.contact.smooth import SmoothContact
from pyehl.prediction.moving_tile import (
    REACH,
    Component,
    LineTile,
    PixelTile,
    Position,
    WaveTiles,
    station_weights,
)
from pyehl.prediction.response import FILM_ENDS, INLET_FILM, QUADRATIC, STATIONS, film_beyond
from pyehl.theory.disc import EDGE_ANGLES
from pyehl.theory.line_contact import AnyContact
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.strip_edge import StripEdge
from pyehl.types import Array, Indices, Single

OUTER = 0.7
"""Distance from the centre beyond which the smooth film is displaced with the edge [semi-axes];
inside it is nearly uniform. 0.6 and 0.8 change mu_r/mu_s by at most 0.06 % at M = 1000 and L = 10,
by 0.2 % at M = 200."""
RINGS = np.array([0.0, 0.4, OUTER])
"""Inner radii of the rings in each of which the load is kept [semi-axes]: two rings more or fewer
change mu_r/mu_s by less than 1e-5 unless a ring loses its load."""


TOGETHER = 16
"""Number of positions whose polynomials of the edge are summed at a time."""


class _AtEdge(NamedTuple):
    """Effect of the edge of the contact at a position."""

    moved: Array  # outward displacement of the edge, as `moved` of the contact
    increase: Single | None  # of the pressure at the points in the contact; None: no effect


class _InLine(NamedTuple):
    """The same for a line contact."""

    moved: Array
    increase: Array  # at all points (m, n)


class RoughContact(ShearedContact):
    """Points of a contact at x (m,), y (n,) [a], with the waves of rough surfaces.

    `area`: area per point [m^2], of a line per length [m]; `powers` of the components, for which
    their transfers hold.
    """

    def __init__(
        self,
        smooth: SmoothContact,
        operating: AnyContact,
        lubricant: Lubricant,
        x: Array,
        y: Array,
        area: float,
        waves: Sequence[Component],
        powers: Sequence[Array] | None,
        tiles: Sequence[PixelTile | LineTile],
    ) -> None:
        super().__init__(operating, lubricant)
        self.x, self.y, self.area = x, y, area
        self.pressure, self.film = smooth.at(self.x, self.y)
        self.across = self.y / operating.ellipse.ellipticity
        self.radius = np.hypot(self.x[:, np.newaxis], self.across[np.newaxis, :])
        self.inside = (self.radius < REACH) & (self.pressure > 0.0)
        self.points = int(np.count_nonzero(self.inside))
        # only for points in the contact, in the order of `places`
        radius = self.radius[self.inside]
        self.inner, self.near = (np.flatnonzero(radius < r) for r in (INNER, NEAR))
        self.rings = (np.searchsorted(RINGS, radius, side="right") - 1).astype(np.int32)
        shape = waves[0].edge.shape
        self.contact, self.strip = smooth, shape if isinstance(shape, StripEdge) else None
        self.outer, self.lowest = self._outer(smooth), float(smooth.film.min())
        self.weights = station_weights(self.x).astype(np.float32)
        self.expansion = self._expansion(smooth)
        places = np.flatnonzero(self.inside)
        self.places = places.astype(np.int32)
        self.smooth_inside = self.pressure[self.inside], self.film[self.inside]
        # places of the points of `outer` among `places`
        self.outer_inside = np.searchsorted(places, self.outer[-1]).astype(np.int32)
        # first and last column, from 1, in each row (m, 2): all, and those of points in the contact
        m, n = self.film.shape
        self.whole = np.tile(np.array([1, n], dtype=np.int32), (m, 1))
        last = n - np.argmax(self.inside[:, ::-1], axis=1)
        spans = np.stack([np.argmax(self.inside, axis=1) + 1, last], axis=1)
        spans[~self.inside.any(axis=1)] = 1, 0
        self.spans = spans.astype(np.int32)
        # polynomials of the edge (n, points), so that sums over n read memory in order; None before
        # the first waves that need them
        self.polynomials: Single | None = None
        if self.strip:
            self.along, self.edge_waves = self.strip.polynomials(self.x), self.strip.waves(self.y)
        self.smooth = float(self.stress(self.pressure, self.film)[self.inside].sum())
        self._take(waves, powers, tiles)

    def _take(
        self,
        waves: Sequence[Component],
        powers: Sequence[Array] | None,
        tiles: Sequence[PixelTile | LineTile],
    ) -> None:
        """Take the waves, as in the constructor."""
        self.tiles, self.minimum = tiles, math.inf
        self.edge = max((wave.edge for wave in waves), key=lambda edge: edge.coefficients.shape)
        self.moved = np.zeros(self.edge.displacement.shape[0])
        order = waves[0].transfer.second
        # First-order loss of film over the smooth film at a film breakdown
        self.ends = FILM_ENDS if order else 1.0
        # gamma and s^2 of the pressure of second order
        self.second = order and [
            np.interp(self.x, STATIONS, value)
            for value in order.of(*(powers or [wave.spectrum.power for wave in waves]))
        ]
        self.minimum_film = float(self.film[self.inside].min())

    def with_waves(
        self,
        waves: Sequence[Component],
        powers: Sequence[Array] | None,
        tiles: Sequence[PixelTile | LineTile],
    ) -> RoughContact:
        """Return the contact with other waves at the same points."""
        other = copy.copy(self)
        ShearedContact.__init__(other, self.operating, self.lubricant)
        other._take(waves, powers, tiles)
        return other

    @classmethod
    def on_pixels(
        cls,
        smooth: SmoothContact,
        operating: AnyContact,
        lubricant: Lubricant,
        tile: PixelTile,
        powers: Sequence[Array] | None = None,
    ) -> RoughContact:
        """Make the contact under one surface, at pixels of its tile."""
        area = tile.stride**2 * tile.pixel[0] * tile.pixel[1] * operating.hertz_radius**2
        if operating.ellipse.is_line:
            area = tile.stride * tile.pixel[0] * operating.hertz_radius / tile.columns.size
        of, places = (smooth, operating, lubricant), (tile.x, tile.y, area)
        return cls(*of, *places, [tile.wave], powers, [tile])

    @classmethod
    def on_grid(
        cls,
        smooth: SmoothContact,
        operating: AnyContact,
        lubricant: Lubricant,
        waves: Sequence[Component],
        points: float,
        powers: Sequence[Array] | None = None,
        tracks: Sequence[float] = (0.0, 0.0),
        like: RoughContact | None = None,
    ) -> RoughContact:
        """Make it under two surfaces, at `points` points per semi-axis; `tracks` of both [a].

        `like`: a contact at the same points.
        """
        half = int(REACH * points)
        x = np.arange(-half, half + 1) / points
        shape = waves[0].edge.shape
        if isinstance(shape, StripEdge):
            count = math.ceil(shape.width * points)
            y = np.asarray(np.arange(count) * (shape.width / count), dtype=float)
        else:
            y = np.asarray(x * operating.ellipse.ellipticity, dtype=float)
        places = x, y, y / operating.ellipse.ellipticity
        tiles = [
            LineTile(wave, smooth.central_film, places, track, number)
            for number, (wave, track) in enumerate(zip(waves, tracks, strict=True))
        ]
        if like is not None:
            return like.with_waves(waves, powers, tiles)
        if operating.ellipse.is_line:
            area = operating.hertz_radius / (points * y.size)
        else:
            area = operating.hertz_radius * operating.semi_axes[1] / points**2
        return cls(smooth, operating, lubricant, x, y, area, waves, powers, tiles)

    def change(self, position: Position) -> Single:
        """Loss of film [a^2/R] and pressure increase [p_h] at a position (m, n, 2)."""
        (edge,) = self._edges([position])
        return self._change(position, edge, self.whole)

    def _change(
        self, position: Position, edge: _AtEdge | _InLine, spans: NDArray[np.int32]
    ) -> Single:
        """Give `change` in the columns `spans` of each row, and store the displacement."""
        total = np.zeros((*self.film.shape, 2), dtype=np.float32)
        for tile in self.tiles:
            tile.add(self, position, spans, total)
        self.moved[:] = edge.moved
        if isinstance(edge, _InLine):
            total[..., 1] += edge.increase
        elif edge.increase is not None:
            all_points = total.reshape(-1, 2).T
            extension.surface_functions.at_places(edge.increase, self.places, all_points)
        if self.second:
            gain, variance = self.second
            extension.surface_functions.second_order(gain, variance, spans.T, total.T)
        return total

    def friction(self, position: Position) -> float:
        """Friction over that of the smooth contact at a position; NaN as in `sheared`.

        The extremes are updated.
        """
        return self.frictions([position])[0]

    def frictions(self, positions: Sequence[Position]) -> list[float]:
        """Give `friction` at some positions."""
        return self._each(positions)

    def ratios(self, positions: Sequence[Position]) -> list[float]:
        """Friction at some positions as `friction`, without the extremes."""
        return self._each(positions, extremes=False)

    def observe(self, positions: Sequence[Position]) -> None:
        """Update the extremes by some positions, without the friction there."""
        self._each(positions, stress=False)

    def _each(
        self, positions: Sequence[Position], *, extremes: bool = True, stress: bool = True
    ) -> list[float]:
        """Give `friction` at some positions; without `stress` only update the extremes."""
        result = []
        for first in range(0, len(positions), TOGETHER):
            part = positions[first : first + TOGETHER]
            for position, edge in zip(part, self._edges(part), strict=True):
                change = self._change(position, edge, self.spans)
                smooth = self._film_inside()
                result.append(self._friction(change, smooth, extremes=extremes, stress=stress))
        return result

    def _expansion(self, contact: SmoothContact) -> Single:
        """Ratio of free waves to those on the centre line (m, n): a mass expands at lower P."""
        p_h = self.operating.hertz_pressure
        axis, _ = contact.at(STATIONS, np.zeros(1))
        made = self.weights @ self.lubricant.density_ratio(axis[:, 0] * p_h)
        here = self.lubricant.density_ratio(np.maximum(self.pressure, 0.0) * p_h)
        return np.ascontiguousarray(made[:, np.newaxis] / here, dtype=np.float32)

    def add_free(
        self,
        waves: WaveTiles,
        beside: Single | None,
        places: tuple[NDArray[np.int32], Single],
        columns: NDArray[np.int32],
        spans: NDArray[np.int32],
        shift: int,
        total: Single,
    ) -> None:
        """Add free waves, shifted by some rows, to loss of film and pressure increase (m, n, 2).

        `places` are the row before each point (m, 1 or n) and the weight of the next one; columns
        (n,); `spans` (m, 2): first and last of them, from 1; `beside`: :meth:`WaveTiles.beside`.
        """
        if waves.free is None or beside is None:
            return
        rows, between = places
        extension.surface_functions.free_waves(
            waves.free.T,
            beside.T,
            rows.T,
            columns,
            spans.T,
            between.T,
            self.weights.T,
            self.expansion.T,
            shift,
            total.T,
        )

    def _edges(self, positions: Sequence[Position]) -> Sequence[_AtEdge | _InLine]:
        """Effect of the edge of the contact at some positions."""
        moved, coefficients = [], []
        for position in positions:
            edges = [tile.at_edge(position) for tile in self.tiles]
            moved.append(sum((part for _, part in edges), np.zeros(self.moved.size)))
            # a surface without long waves has no coefficients
            values = np.zeros(max(part.size for part, _ in edges))
            for part, _ in edges:
                if part.size:
                    values += part
            coefficients.append(values)
        if not any(values.any() for values in coefficients):
            return [_AtEdge(one, None) for one in moved]
        if self.strip:
            products = [values.reshape(-1, self.along.shape[1]) for values in coefficients]
            each = (self.along @ (part.T @ self.edge_waves) for part in products)
            return [_InLine(one, more) for one, more in zip(moved, each, strict=True)]
        if self.polynomials is None:
            i, j = np.nonzero(self.inside)
            values = self.edge.polynomials(self.x[i], self.across[j])
            self.polynomials = values.astype(np.float32)
        sums = np.empty((len(positions), self.points), dtype=np.float32)
        extension.surface_functions.polynomials(
            self.polynomials.T, np.array(coefficients, dtype=np.float32).T, sums.T
        )
        return [_AtEdge(one, more) for one, more in zip(moved, sums, strict=True)]

    def _outer(self, contact: SmoothContact) -> tuple[NDArray[Any], ...]:
        """Points whose film is displaced with the edge, as arguments for `smooth_film`.

        Film (ny, nx), centre and points in nodes of the smooth contact; for each point the
        preceding node on the edge, the weights of this and the next one over the distance from the
        centre, and the index of the point.
        """
        i, j = np.nonzero(self.inside & (self.radius > OUTER))
        if self.strip:
            return self._outer_of_strip(contact, self.strip, i, j)
        steps = [axis[1] - axis[0] for axis in (contact.x, contact.y)]
        centre = np.array([-contact.x[0] / steps[0], -contact.y[0] / steps[1]])
        count = EDGE_ANGLES.size
        angle = np.arctan2(self.across[j], self.x[i]) * (0.5 * count / math.pi)
        before = np.floor(angle)
        weights = np.stack([1.0 - (angle - before), angle - before], axis=-1)
        weights /= self.radius[i, j][:, np.newaxis]
        return (
            np.asfortranarray(contact.film.T),
            centre,
            centre[0] + self.x[i] / steps[0],
            centre[1] + self.y[j] / steps[1],
            (before.astype(np.int32) % count).astype(np.int32),
            weights.T,
            np.ravel_multi_index((i, j), self.film.shape).astype(np.int32),
        )

    def _outer_of_strip(
        self, contact: SmoothContact, strip: StripEdge, i: Indices, j: Indices
    ) -> tuple[NDArray[Any], ...]:
        """Give the same for points (n,) of a line contact: the edges follow one another."""
        step = contact.x[1] - contact.x[0]
        at = self.y[j] % strip.width * (strip.places / strip.width)
        place = np.minimum(np.floor(at).astype(np.int32), strip.places - 1)
        weights = np.stack([1.0 - (at - place), at - place]) / self.radius[i, j]
        before = place + (self.x[i] > 0.0) * (strip.places + 1)
        return (
            np.asfortranarray(np.repeat(contact.film.T, 2, axis=0)),
            np.array([-contact.x[0] / step, 0.0]),
            (self.x[i] - contact.x[0]) / step,
            np.zeros(i.size),
            before.astype(np.int32),
            np.asfortranarray(weights),
            np.ravel_multi_index((i, j), self.film.shape).astype(np.int32),
        )

    def smooth_film(self) -> Array:
        """Film of the smooth contact with its displaced edge (m, n) [a^2/R]."""
        film, (*points, place) = self.film.copy(), self.outer
        extension.surface_functions.film_moved(*points, self.moved, place, film.reshape(-1))
        return film

    def min_film(self) -> float:
        """Minimum film over the positions, as reported [a^2/R]."""
        return self.minimum if self.minimum_film > 0.0 else self.minimum_film

    def _film_inside(self) -> Array:
        """Return `smooth_film` at `places`."""
        film, (*points, _) = self.smooth_inside[1].copy(), self.outer
        extension.surface_functions.film_moved(*points, self.moved, self.outer_inside, film)
        return film

    def sheared(self, change: Single, smooth: Array) -> float:
        """Friction over that of the smooth contact with changes (m, n, 2) of film and pressure.

        `smooth`: its film at this position (m, n). NaN if the film is not positive, or a ring of
        the contact would need tension.
        """
        return self._friction(change, smooth.take(self.places))

    def _friction(
        self, change: Single, smooth: Array, *, extremes: bool = True, stress: bool = True
    ) -> float:
        """Give `sheared`, `smooth` at `places`; without `stress` only update the extremes."""
        film, pressure, gain, ended, tensile = self.film_and_pressure(change, smooth)
        if extremes:
            self.count += 1
            # over the mean pressure of the dry contact
            imbalance = (4.0 / math.pi if self.strip else 1.5) * float(gain.sum()) / self.points
            self.imbalance = max(self.imbalance, abs(imbalance))
        if ended:
            left = self.ends * smooth - change[..., 0].take(self.places)
            if len(self.tiles) > 1:
                # under one surface :mod:`pyehl.prediction.breakdown` counts pixels instead
                self.ended += int(np.count_nonzero(left <= 0.0))
            sustained = float(left.min(initial=math.inf))
            if sustained <= 0.0:
                self.minimum_film = min(self.minimum_film, sustained)
                return math.nan
        if extremes:
            self.minimum_film = min(self.minimum_film, float(film.min(initial=math.inf)))
            self.cavitated += tensile
            whole = film + missing(self.contact, smooth, self.lowest)
            self.minimum = min(self.minimum, float(whole.min(initial=math.inf)))
            self.accumulate(gain, pressure, whole, self.inner, self.near)
        if tensile and extension.surface_functions.ring_loads(self.rings, pressure):
            self.lost = True
            return math.nan
        if not stress:
            return math.nan
        with np.errstate(over="ignore"):
            return float(self.stress(pressure, film).sum()) / self.smooth

    def film_and_pressure(
        self, change: Single, smooth: Array
    ) -> tuple[Array, Array, Single, int, int]:
        """Film, pressure and its increase at `places`, for changes (m, n, 2).

        With the numbers of points where the film may break down, and where the pressure is not
        positive.
        """
        film, pressure = np.empty(smooth.size), np.empty(smooth.size)
        gain, counts = np.empty(smooth.size, np.float32), np.empty(3, np.int32)
        limit = QUADRATIC if self.second else -1.0
        changes = change.reshape(-1, 2)
        given = changes.T, self.places, smooth, self.smooth_inside[0], limit, INLET_FILM, self.ends
        extension.surface_functions.film_pressure(*given, film, pressure, gain, counts)
        beyond, ended, tensile = (int(number) for number in counts)
        if beyond:
            loss = changes[:, 0].take(self.places) / smooth
            far = np.flatnonzero(loss > QUADRATIC)
            film[far] = smooth[far] * film_beyond(loss[far])
        return film, pressure, gain, ended, tensile


def missing(contact: SmoothContact, film: Array, minimum: float) -> Array | float:
    """Correction to be added to films H_s [a^2/R] of a smooth contact, for extrapolated ones.

    The films are scaled to the extrapolated central film already, where the correction is 0. At the
    `minimum` film of the grid it is the difference from the extrapolated minimum; in between it is
    linear in the film.
    """
    central = contact.central_film
    if not contact.extrapolated or minimum >= central:
        return 0.0
    share = np.clip((central - film) / (central - minimum), 0.0, 1.0)
    return np.asarray((contact.minimum_film - minimum) * share)
