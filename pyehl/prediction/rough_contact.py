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

import math
from collections.abc import Sequence
from typing import Any

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
from pyehl.prediction.response import FILM_ENDS, STATIONS, film_left
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
        self.x, self.y, self.area, self.tiles = x, y, area, tiles
        self.pressure, self.film = smooth.at(self.x, self.y)
        self.across = self.y / operating.ellipse.ellipticity
        self.radius = np.hypot(self.x[:, np.newaxis], self.across[np.newaxis, :])
        self.inside = (self.radius < REACH) & (self.pressure > 0.0)
        self.points = int(np.count_nonzero(self.inside))
        # only for points in the contact, in the order of `places`
        radius = self.radius[self.inside]
        self.inner, self.near = (np.flatnonzero(radius < r) for r in (INNER, NEAR))
        self.rings = np.searchsorted(RINGS, radius, side="right") - 1
        edge = max((wave.edge for wave in waves), key=lambda edge: edge.coefficients.shape)
        self.contact, self.moved = smooth, np.zeros(edge.displacement.shape[0])
        self.strip = edge.shape if isinstance(edge.shape, StripEdge) else None
        self.outer, self.lowest = self._outer(smooth), float(smooth.film.min())
        self.minimum = math.inf
        self.weights = station_weights(self.x).astype(np.float32)
        self.expansion = self._expansion(smooth)
        # (n, points), so that sums over n read memory in order
        i, j = np.nonzero(self.inside)
        self.places = np.ravel_multi_index((i, j), self.film.shape).astype(np.int32)
        if self.strip:
            self.along, self.edge_waves = self.strip.polynomials(self.x), self.strip.waves(self.y)
        else:
            self.polynomials = edge.polynomials(self.x[i], self.across[j]).astype(np.float32)
        order = waves[0].transfer.second
        # First-order loss of film over the smooth film at a film breakdown
        self.ends = FILM_ENDS if order else 1.0
        # gamma and s^2 of the pressure of second order
        self.second = order and [
            np.interp(self.x, STATIONS, value)[:, np.newaxis]
            for value in order.of(*(powers or [wave.spectrum.power for wave in waves]))
        ]
        self.smooth = float(self.stress(self.pressure, self.film)[self.inside].sum())
        self.minimum_film = float(self.film[self.inside].min())

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
    ) -> RoughContact:
        """Make it under two surfaces, at `points` points per semi-axis; `tracks` of both [a]."""
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
        if operating.ellipse.is_line:
            area = operating.hertz_radius / (points * y.size)
        else:
            area = operating.hertz_radius * operating.semi_axes[1] / points**2
        return cls(smooth, operating, lubricant, x, y, area, waves, powers, tiles)

    def change(self, position: Position) -> Single:
        """Loss of film [a^2/R] and pressure increase [p_h] at a position (m, n, 2)."""
        total = np.zeros((*self.film.shape, 2), dtype=np.float32)
        for tile in self.tiles:
            tile.add(self, position, total)
        self.add_edge(total, *(tile.at_edge(position) for tile in self.tiles))
        if self.second:
            gain, variance = self.second
            total[..., 1] += gain * (np.square(total[..., 1]) - variance)
        return total

    def friction(self, position: Position) -> float:
        """Friction over that of the smooth contact at a position; NaN as in `sheared`."""
        change = self.change(position)
        smooth = self.smooth_film()
        if len(self.tiles) > 1:
            # under one surface :mod:`pyehl.prediction.breakdown` counts pixels instead
            ended = (change[..., 0] >= self.ends * smooth) & self.inside
            self.ended += int(np.count_nonzero(ended))
        return self.sheared(change, smooth)

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
        shift: int,
        total: Single,
    ) -> None:
        """Add free waves, shifted by some rows, to loss of film and pressure increase (m, n, 2).

        `places` are the row before each point (m, 1 or n) and the weight of the next one; columns
        (n,); `beside`: :meth:`WaveTiles.beside`.
        """
        if waves.free is None or beside is None:
            return
        rows, between = places
        extension.surface_functions.free_waves(
            waves.free.T,
            beside.T,
            rows.T,
            columns,
            between.T,
            self.weights.T,
            self.expansion.T,
            shift,
            total.T,
        )

    def add_edge(self, total: Single, *edges: tuple[Array, Array]) -> None:
        """Add the effect of the edge on the pressure, and store its displacement.

        `edges`: results of :meth:`pyehl.prediction.moving_tile.Edge.at`.
        """
        # a surface without long waves has none
        coefficients = np.zeros(max(result.size for result, _ in edges))
        self.moved[:] = 0.0
        for result, moved in edges:
            self.moved += moved
            if result.size:
                coefficients += result
        if not coefficients.any():
            return
        if self.strip:
            products = coefficients.reshape(-1, self.along.shape[1])
            total[..., 1] += self.along @ (products.T @ self.edge_waves)
            return
        extension.surface_functions.polynomials(
            self.polynomials.T,
            coefficients.astype(np.float32),
            self.places,
            total.reshape(-1, 2).T,
        )

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
        share = np.stack([1.0 - (angle - before), angle - before], axis=-1)
        share /= self.radius[i, j][:, np.newaxis]
        return (
            np.asfortranarray(contact.film.T),
            centre,
            centre[0] + self.x[i] / steps[0],
            centre[1] + self.y[j] / steps[1],
            (before.astype(np.int32) % count).astype(np.int32),
            share.T,
            np.ravel_multi_index((i, j), self.film.shape).astype(np.int32),
        )

    def _outer_of_strip(
        self, contact: SmoothContact, strip: StripEdge, i: Indices, j: Indices
    ) -> tuple[NDArray[Any], ...]:
        """Give the same for points (n,) of a line contact: the edges follow one another."""
        step = contact.x[1] - contact.x[0]
        at = self.y[j] % strip.width * (strip.places / strip.width)
        place = np.minimum(np.floor(at).astype(np.int32), strip.places - 1)
        share = np.stack([1.0 - (at - place), at - place]) / self.radius[i, j]
        before = place + (self.x[i] > 0.0) * (strip.places + 1)
        return (
            np.asfortranarray(np.repeat(contact.film.T, 2, axis=0)),
            np.array([-contact.x[0] / step, 0.0]),
            (self.x[i] - contact.x[0]) / step,
            np.zeros(i.size),
            before.astype(np.int32),
            np.asfortranarray(share),
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

    def sheared(self, change: Single, smooth: Array) -> float:
        """Friction over that of the smooth contact with changes (m, n, 2) of film and pressure.

        `smooth`: its film at this position (m, n). NaN if the film is not positive, or a ring of
        the contact would need tension.
        """
        # only at points in the contact
        smooth = smooth.take(self.places)
        loss, gain = change.reshape(-1, 2).take(self.places, axis=0).T
        film = smooth * film_left(loss / smooth) if self.second else smooth - loss
        pressure = self.pressure.take(self.places) + gain
        self.count += 1
        # over the mean pressure of the dry contact
        imbalance = (4.0 / math.pi if self.strip else 1.5) * float(gain.sum()) / self.points
        self.imbalance = max(self.imbalance, abs(imbalance))
        sustained = float((self.ends * smooth - loss).min(initial=math.inf))
        if sustained <= 0.0:
            self.minimum_film = min(self.minimum_film, sustained)
            return math.nan
        self.minimum_film = min(self.minimum_film, float(film.min(initial=math.inf)))
        tensile = np.flatnonzero(pressure <= 0.0)
        self.cavitated += tensile.size
        whole = film + missing(self.contact, smooth, self.lowest)
        self.minimum = min(self.minimum, float(whole.min(initial=math.inf)))
        self.accumulate(gain, pressure, whole, self.inner, self.near)
        if tensile.size:
            load = np.bincount(self.rings, pressure, len(RINGS))
            tension = np.bincount(self.rings[tensile], pressure[tensile], len(RINGS))
            if (load < 0.0).any():
                self.lost = True
                return math.nan
            pressure[tensile] = 0.0
            # compression in the rest of a ring carries its load
            compression = load - tension
            share = np.divide(load, compression, out=np.ones_like(load), where=compression > 0.0)
            pressure *= share[self.rings]
        with np.errstate(over="ignore"):
            return float(self.stress(pressure, film).sum()) / self.smooth


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
