# SPDX-License-Identifier: BSD-3-Clause
"""Friction of a contact at one position of a rough tile, by the response of the contact.

Pressure P_s + delta P and film H_s - rr_d with P_s and H_s of the smooth contact; friction is the
integral of the shear stress (Zhang et al. 2019, eqs 13, 14). The waves that the tile makes come
from :mod:`pyehl.prediction.waves`, the pressure of second order is that of
:mod:`pyehl.prediction.second_order`; a wave longer than half the contact radius also feels the edge
of the contact (:mod:`pyehl.theory.disc`).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from pyehl import library
from pyehl.prediction.contact import INNER, NEAR, ShearedContact
from pyehl.prediction.smooth import SmoothContact
from pyehl.prediction.spectrum import Spectrum
from pyehl.prediction.transfer import OFF_CENTRE, STATIONS
from pyehl.prediction.waves import REFINEMENT, Waves
from pyehl.theory.disc import LARGEST, RADIUS, disc_correction, monomials
from pyehl.theory.ellipse import Ellipse
from pyehl.theory.ellipse_edge import ellipse_edge
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint

__all__ = [
    "REACH",
    "Edge",
    "RoughContact",
    "WavyContact",
    "away_from_centre",
    "pairs",
    "slipped",
    "station_weights",
]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Single = NDArray[np.float32]

REACH = 1.0
"""Friction is taken within this distance from the centre [semi-axes]."""
# The polynomials of the edge of a circle are held constant beyond this radius
EDGE_RADIUS = 0.85
# The change of T off the centre line is linear in Y^2 up to here
FARTHEST = 0.75


def station_weights(x: Array) -> Array:
    """Weights (..., n) of the stations in the waves at places X [a]."""
    return np.stack([np.interp(x, STATIONS, unit) for unit in np.eye(STATIONS.size)], axis=-1)


def away_from_centre(y: Array) -> Array:
    """Share of the change off the centre line in the free wave at places Y [semi-axis]."""
    return np.minimum(np.abs(y), FARTHEST) ** 2 / OFF_CENTRE**2


def slipped(x: Array, y: Array, velocity_ratio: float, *, bent: bool) -> Array:
    """Way of the roughness past the free wave since the inlet made that [a].

    At places X [a] and Y [semi-axis].
    """
    inlet = np.sqrt(np.maximum(0.0, 1.0 - y * y)) if bent else np.ones_like(y)
    return (velocity_ratio - 1.0) * (x + inlet)


class Edge:
    """What the edge of the contact does to the pressure of the long waves of a tile.

    `coefficients` (n, m) of the polynomials [p_h] for the waves of the tile with wavenumbers
    qx >= 0, qy (m,) [1/a]: of :func:`pyehl.theory.disc.monomials` (n = 28) in a circle, of
    :mod:`pyehl.theory.ellipse_edge` in an ellipse.
    """

    def __init__(self, qx: Array, qy: Array, coefficients: Complex, shape: Ellipse) -> None:
        self.qx, self.qy, self.coefficients, self.shape = qx, qy, coefficients, shape

    @classmethod
    def of(cls, spectrum: Spectrum, flattened: Complex, shape: Ellipse) -> Edge:
        """Of a tile, each component flattened by a factor (shape of the spectrum)."""
        nx, ny = spectrum.shape
        q = spectrum.q
        strong = np.abs(spectrum.values) > 1e-9 * np.abs(spectrum.values).max()
        ellipse = None if shape.radius_ratio == 1.0 else ellipse_edge(shape)
        i, j = np.nonzero((q > 0.0) & (q < (ellipse.largest if ellipse else LARGEST)) & strong)
        qx, qy = spectrum.qx[i], spectrum.qy[j]
        # a component stands for its conjugate at -q too, unless both are in the half spectrum
        twice = np.where((i == 0) | ((nx % 2 == 0) & (i == nx // 2)), 1.0, 2.0)
        amplitude = twice * spectrum.values[i, j] * flattened[i, j] / (nx * ny)
        if not i.size:
            return cls(qx, qy, np.zeros((0, 0), complex), shape)
        found = ellipse.correction(qx, qy) if ellipse else disc_correction(qx, qy)
        return cls(qx, qy, found * amplitude, shape)

    def below(self, limit: float) -> Edge:
        """Return the part of the waves with |q| below a limit [1/a]."""
        keep = np.hypot(self.qx, self.qy) < limit
        return Edge(self.qx[keep], self.qy[keep], self.coefficients[:, keep], self.shape)

    def at(self, shift: float, track: float) -> Array:
        """Coefficients (n,) for a tile moved along and across the motion [a]."""
        phase = np.exp(-1j * (self.qx * shift + self.qy * track))
        return np.asarray((self.coefficients @ phase).real)

    def polynomials(self, x: Array, y: Array) -> Array:
        """Polynomials (n, ...) at places by the semi-axes, held constant near the edge."""
        ellipse = None if self.shape.radius_ratio == 1.0 else ellipse_edge(self.shape)
        held = np.minimum(
            1.0, (RADIUS if ellipse else EDGE_RADIUS) / np.maximum(np.hypot(x, y), 1e-12)
        )
        if not self.coefficients.size:
            return np.zeros((self.coefficients.shape[0], *held.shape))
        if ellipse:
            return ellipse.functions(held * x, held * y)
        return monomials(held * x, held * y, axis=0)


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
        self.inner, self.near = (self.inside & (self.radius < r) for r in (INNER, NEAR))
        self.missing = _missing(contact, self.film)
        self.least = math.inf
        self.weights = station_weights(self.x).astype(np.float32)
        self.off = away_from_centre(self.across).astype(np.float32)
        grid = np.meshgrid(self.x, self.across, indexing="ij")
        # (n, points): what is summed over them is read in order
        edge = max(edges, key=lambda edge: edge.coefficients.shape)
        shape = edge.coefficients.shape[0], self.film.size
        self.polynomials = edge.polynomials(*grid).reshape(shape).astype(np.float32)
        # of the pressure of second order
        self.second = second and [np.interp(self.x, STATIONS, v)[:, np.newaxis] for v in second]
        self.smooth = float(self.stress(self.pressure, self.film)[self.inside].sum())
        self.thinnest = float(self.film[self.inside].min())

    def add_edge(self, total: Single, edge: Array) -> None:
        """Add what the edge of the contact does, by its coefficients (28,), to the pressure."""
        if not edge.size:
            return
        # threads of a product of matrices cost more than they bring
        wide = np.einsum("k,kn->n", edge.astype(np.float32), self.polynomials)
        total[..., 1] += wide.reshape(self.film.shape)

    def add_second(self, total: Single) -> None:
        """Add the pressure of second order to that of the waves."""
        if self.second:
            gain, variance = self.second
            total[..., 1] += gain * (np.square(total[..., 1]) - variance)

    def least_film(self) -> float:
        """Least film over the positions, as it is told [a^2/R]."""
        return self.least if self.thinnest > 0.0 else self.thinnest

    def sheared(self, change: Single) -> float:
        """Friction over that of the smooth contact, film and pressure changed by (m, n, 2).

        NaN where the film is not positive.
        """
        film = self.film - change[..., 0]
        pressure = self.pressure + change[..., 1]
        self.count += 1
        carried = 1.5 * float(change[..., 1].sum(where=self.inside)) / self.points
        self.imbalance = max(self.imbalance, abs(carried))
        self.thinnest = min(self.thinnest, float(film.min(where=self.inside, initial=math.inf)))
        if self.thinnest <= 0.0:
            return math.nan
        self.cavitated += int(np.count_nonzero((pressure <= 0.0) & self.inside))
        # outside nothing is counted: any film and pressure will do
        film[~self.inside] = math.inf
        whole = film + self.missing
        self.least = min(self.least, float(whole.min()))
        self.meet(change[..., 1], whole, self.inner, self.near)
        film[~self.inside] = 1.0
        np.maximum(pressure, 0.0, out=pressure)
        with np.errstate(over="ignore"):
            return float(self.stress(pressure, film).sum(where=self.inside)) / self.smooth


def _missing(contact: SmoothContact, film: Array) -> Array | float:
    """Give what films H_s [a^2/R] of a smooth contact lack beside those extrapolated.

    They are scaled to the extrapolated central film; the minimum film lacks more than that, on the
    grid of the smooth contact. In between it is linear in the film.
    """
    least, central = float(contact.film.min()), contact.central_film
    if not contact.extrapolated or least >= central:
        return 0.0
    share = np.clip((central - film) / (central - least), 0.0, 1.0)
    return np.asarray((contact.minimum_film - least) * share)


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

    def change(self, shift: int, track: int = 0) -> Single:
        """Loss of film [a^2/R] and gain of pressure [p_h] at the points, (m, n, 2).

        The tile has moved by `shift` and `track` pixels along and across the motion; `track` is a
        multiple of the stride of the waves.
        """
        waves = self.waves
        columns = (self.columns - track) // waves.stride % waves.driven.shape[2]
        columns = columns.astype(np.int32)
        total = np.zeros((*self.film.shape, 2), dtype=np.float32)
        library.waves.driven_waves(
            pairs(waves.driven), self.rows, columns, self.weights.T, shift, pairs(total)
        )
        for tile, weights, part in (
            (waves.free, self.weights, np.ones_like(self.off)),
            (waves.off_centre, np.ones_like(self.weights[:, :1]), self.off),
        ):
            if tile is not None:
                library.waves.free_waves(
                    pairs(tile),
                    self.free_rows.T,
                    columns,
                    self.between.T,
                    weights.T,
                    part,
                    shift * REFINEMENT,
                    pairs(total),
                )
        self.add_edge(total, self.edge.at(shift * self.pixel[0], track * self.pixel[1]))
        self.add_second(total)
        return total

    def friction(self, shift: int, track: int = 0) -> float:
        """Friction over that of the smooth contact; NaN where the film is not positive."""
        return self.sheared(self.change(shift, track))


def pairs(values: NDArray[np.float32]) -> NDArray[np.complex64]:
    """Film and pressure of the last dimension as one number, the dimensions reversed."""
    return values.view(np.complex64)[..., 0].T
