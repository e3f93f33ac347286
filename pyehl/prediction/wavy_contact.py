# SPDX-License-Identifier: BSD-3-Clause
"""Friction of a contact at one position of a rough tile, by the response of the contact.

Pressure P_s + delta P and film H_s - rr_d with P_s and H_s of the smooth contact; friction is the
integral of the shear stress (Zhang et al. 2019, eqs 13, 14). The waves that the tile makes come
from :mod:`pyehl.prediction.waves`, the pressure of second order is that of
:mod:`pyehl.prediction.second_order`; a wave longer than half the contact radius also feels the edge
of the contact, which it moves (:mod:`pyehl.prediction.edge`).
"""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pyehl import extension
from pyehl.prediction.contact import INNER, NEAR, ShearedContact
from pyehl.prediction.edge import Edge
from pyehl.prediction.second_order import FILM_ENDS, film_left
from pyehl.prediction.smooth import SmoothContact
from pyehl.prediction.transfer import AXIS, LINES, STATIONS
from pyehl.prediction.waves import Waves
from pyehl.theory.disc import RIM_ANGLES
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Array, Single

REACH = 1.0
"""Friction is taken within this distance from the centre [semi-axes]."""
OUTER = 0.7
"""Distance from the centre beyond which the smooth film moves with the edge [semi-axes]; further
inside it is level. 0.6 and 0.8 change mu_r/mu_s by 0.06 % at the most at M = 1000 and L = 10, by
0.2 % at M = 200."""
RINGS = np.array([0.0, 0.4, OUTER])
"""Inner radii of the rings in which the pressure carries what the waves leave [semi-axes]: two more
or less change mu_r/mu_s by less than 1e-5 where no ring loses its load."""


def station_weights(x: Array) -> Array:
    """Weights (..., n) of the stations in the waves at places X [a]."""
    return np.stack([np.interp(x, STATIONS, unit) for unit in np.eye(STATIONS.size)], axis=-1)


def line_weights(y: Array) -> Array:
    """Weights (n, lines) of LINES but the centre line in the free wave at places Y [semi-axis]."""
    lines = np.delete(np.eye(LINES.size), AXIS, 0)
    return np.stack([np.interp(y, LINES, unit) for unit in lines], axis=-1)


def two_lines(y: Array) -> tuple[NDArray[np.int32], Single]:
    """`line_weights` at places Y (n,): the first of two lines after each other, weights (2, n)."""
    weights = line_weights(y)
    first = np.minimum(np.argmax(weights > 0.0, axis=1), weights.shape[1] - 2)
    both = np.stack([np.take_along_axis(weights, (first + k)[:, np.newaxis], 1) for k in (0, 1)])
    return first.astype(np.int32), both[..., 0].astype(np.float32)


def slipped(x: Array, y: Array, velocity_ratio: float, *, bent: bool) -> Array:
    """Way of the roughness past the free wave since the inlet made that [a].

    At places X [a] and Y [semi-axis].
    """
    inlet = np.sqrt(np.maximum(0.0, 1.0 - y * y)) if bent else np.ones_like(y)
    return (velocity_ratio - 1.0) * (x + inlet)


class WavyContact(ShearedContact):
    """Points of a contact that waves change: pressures in p_h, films in a^2/R.

    At places x (m,), y (n,) [a]; a point stands for an `area` [m^2]. `edges` of the tiles;
    `second`: gamma and s^2 of the pressure of second order at the stations.
    """

    def __init__(
        self,
        contact: SmoothContact,
        x: Array,
        y: Array,
        *,
        edges: Sequence[Edge],
        area: float,
        operating: OperatingPoint,
        lubricant: Lubricant,
        second: tuple[Array, Array] | None = None,
    ) -> None:
        super().__init__(operating, lubricant)
        self.x, self.y, self.area = x, y, area
        self.pressure, self.film = contact.at(self.x, self.y)
        self.across = self.y / operating.ellipse.ellipticity
        self.radius = np.hypot(self.x[:, np.newaxis], self.across[np.newaxis, :])
        self.inside = (self.radius < REACH) & (self.pressure > 0.0)
        self.points = int(np.count_nonzero(self.inside))
        # of the points of the contact alone, in the order of `places`
        radius = self.radius[self.inside]
        self.inner, self.near = (radius < r for r in (INNER, NEAR))
        self.rings = np.searchsorted(RINGS, radius, side="right") - 1
        self.contact, self.moved = contact, np.zeros(RIM_ANGLES.size)
        self.outer, self.lowest = self._outer(contact), float(contact.film.min())
        self.least = math.inf
        self.weights = station_weights(self.x).astype(np.float32)
        self.expansion = self._expansion(contact)
        # (n, points): what is summed over them is read in order
        edge = max(edges, key=lambda edge: edge.coefficients.shape)
        i, j = np.nonzero(self.inside)
        self.places = np.ravel_multi_index((i, j), self.film.shape).astype(np.int32)
        self.polynomials = edge.polynomials(self.x[i], self.across[j]).astype(np.float32)
        # Loss of first order over the film at which the film ends
        self.ends = FILM_ENDS if second else 1.0
        # of the pressure of second order
        self.second = second and [np.interp(self.x, STATIONS, v)[:, np.newaxis] for v in second]
        self.smooth = float(self.stress(self.pressure, self.film)[self.inside].sum())
        self.thinnest = float(self.film[self.inside].min())

    def _expansion(self, contact: SmoothContact) -> Single:
        """Free waves over those of the centre line (m, n): a mass fills more where P is lower."""
        p_h = self.operating.hertz_pressure
        axis, _ = contact.at(STATIONS, np.zeros(1))
        made = self.weights @ self.lubricant.density_ratio(axis[:, 0] * p_h)
        here = self.lubricant.density_ratio(np.maximum(self.pressure, 0.0) * p_h)
        return np.ascontiguousarray(made[:, np.newaxis] / here, dtype=np.float32)

    def add_free(
        self,
        waves: Waves,
        beside: Single | None,
        places: tuple[NDArray[np.int32], Single],
        columns: NDArray[np.int32],
        shift: int,
        total: Single,
    ) -> None:
        """Add free waves to loss of film and gain of pressure (m, n, 2), moved by some rows.

        `places` are the row before each point (m, 1 or n) and the share of the next one; columns
        (n,); `beside`: :meth:`Waves.beside`.
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
        """Add what the edge does to the pressure (:meth:`Edge.at`), keep how far it is moved."""
        coefficients = np.zeros(self.polynomials.shape[0])
        self.moved[:] = 0.0
        for found, moved in edges:
            self.moved += moved
            if found.size:
                coefficients += found
        if not coefficients.any():
            return
        extension.surface_functions.polynomials(
            self.polynomials.T,
            coefficients.astype(np.float32),
            self.places,
            total.reshape(-1, 2).T,
        )

    def _outer(self, contact: SmoothContact) -> tuple[NDArray[Any], ...]:
        """Points whose film moves with the edge, as `smooth_film` asks for them.

        Film (ny, nx), centre and points in nodes of the smooth contact, the place on the rim before
        each and the shares of this and the next one over the distance from the centre, and the
        place of the point.
        """
        i, j = np.nonzero(self.inside & (self.radius > OUTER))
        steps = [axis[1] - axis[0] for axis in (contact.x, contact.y)]
        centre = np.array([-contact.x[0] / steps[0], -contact.y[0] / steps[1]])
        count = RIM_ANGLES.size
        angle = np.arctan2(self.across[j], self.x[i]) * (0.5 * count / math.pi)
        rim = np.floor(angle)
        share = np.stack([1.0 - (angle - rim), angle - rim], axis=-1)
        share /= self.radius[i, j][:, np.newaxis]
        return (
            np.asfortranarray(contact.film.T),
            centre,
            centre[0] + self.x[i] / steps[0],
            centre[1] + self.y[j] / steps[1],
            (rim.astype(np.int32) % count).astype(np.int32),
            share.T,
            np.ravel_multi_index((i, j), self.film.shape).astype(np.int32),
        )

    def smooth_film(self) -> Array:
        """Film of the smooth contact with its edge where it was moved to (m, n) [a^2/R]."""
        film, (*points, place) = self.film.copy(), self.outer
        extension.surface_functions.film_moved(*points, self.moved, place, film.reshape(-1))
        return film

    def add_second(self, total: Single) -> None:
        """Add the pressure of second order to that of the waves."""
        if self.second:
            gain, variance = self.second
            total[..., 1] += gain * (np.square(total[..., 1]) - variance)

    def least_film(self) -> float:
        """Least film over the positions, as it is told [a^2/R]."""
        return self.least if self.thinnest > 0.0 else self.thinnest

    def sheared(self, change: Single, smooth: Array | None = None) -> float:
        """Friction over that of the smooth contact, film and pressure changed by (m, n, 2).

        `smooth`: what `smooth_film` gives, if it was asked for. NaN where the film is not positive,
        or a ring of the contact would have to pull.
        """
        # of the points of the contact alone
        smooth = (self.smooth_film() if smooth is None else smooth).take(self.places)
        loss, gain = change.reshape(-1, 2).take(self.places, axis=0).T
        film = smooth * film_left(loss / smooth) if self.second else smooth - loss
        pressure = self.pressure.take(self.places) + gain
        self.count += 1
        imbalance = 1.5 * float(gain.sum()) / self.points
        self.imbalance = max(self.imbalance, abs(imbalance))
        borne = float((self.ends * smooth - loss).min(initial=math.inf))
        if borne <= 0.0:
            self.thinnest = min(self.thinnest, borne)
            return math.nan
        self.thinnest = min(self.thinnest, float(film.min(initial=math.inf)))
        pulling = np.flatnonzero(pressure <= 0.0)
        self.cavitated += pulling.size
        whole = film + missing(self.contact, smooth, self.lowest)
        self.least = min(self.least, float(whole.min(initial=math.inf)))
        self.meet(gain, pressure, whole, self.inner, self.near)
        if pulling.size:
            carried = np.bincount(self.rings, pressure, len(RINGS))
            pulls = np.bincount(self.rings[pulling], pressure[pulling], len(RINGS))
            if (carried < 0.0).any():
                self.lost = True
                return math.nan
            pressure[pulling] = 0.0
            # what cannot pull leaves less to carry for what is around
            pushes = carried - pulls
            share = np.divide(carried, pushes, out=np.ones_like(carried), where=pushes > 0.0)
            pressure *= share[self.rings]
        with np.errstate(over="ignore"):
            return float(self.stress(pressure, film).sum()) / self.smooth


def missing(contact: SmoothContact, film: Array, least: float) -> Array | float:
    """Give what films H_s [a^2/R] of a smooth contact lack beside those extrapolated.

    They are scaled to the extrapolated central film; the minimum film lacks more than that, on the
    grid of the smooth contact, whose `least` film it is. In between it is linear in the film.
    """
    central = contact.central_film
    if not contact.extrapolated or least >= central:
        return 0.0
    share = np.clip((central - film) / (central - least), 0.0, 1.0)
    return np.asarray((contact.minimum_film - least) * share)
