# SPDX-License-Identifier: BSD-3-Clause
"""What the edge of the contact does to the long waves of a tile, and they to it.

Waves longer than half the contact radius feel the edge (:mod:`pyehl.theory.disc`), and they move
it: the contact is wider where they press and narrower where they give way.
"""

from __future__ import annotations

import numpy as np

from pyehl.prediction.response import Transfer
from pyehl.prediction.spectrum import Spectrum
from pyehl.theory.disc import LARGEST, RADIUS, RIM_ANGLES, disc_correction, disc_rim, monomials
from pyehl.theory.ellipse import Ellipse
from pyehl.theory.ellipse_edge import ellipse_edge
from pyehl.theory.transport import harmonics
from pyehl.types import Array, Complex

# The polynomials of the edge of a circle are held constant beyond this radius; 0.8 and 0.9 change
# mu_r/mu_s of Table 1 by 1e-6
EDGE_RADIUS = 0.85


class Edge:
    """What the edge of the contact does to the pressure of the long waves of a tile.

    `coefficients` (n, m) of the polynomials [p_h] for the waves of the tile with wavenumbers
    qx >= 0, qy (m,) [1/a]: of :func:`pyehl.theory.disc.monomials` (n = 28) in a circle, of
    :mod:`pyehl.theory.ellipse_edge` in an ellipse. `rim` (k, m): how far they move the edge
    outwards at RIM_ANGLES [semi-axes].
    """

    def __init__(
        self, qx: Array, qy: Array, coefficients: Complex, rim: Complex, shape: Ellipse
    ) -> None:
        self.qx, self.qy, self.coefficients, self.rim = qx, qy, coefficients, rim
        self.shape = shape

    @classmethod
    def of(
        cls, spectrum: Spectrum, transfer: Transfer, velocity_ratio: float, shape: Ellipse
    ) -> Edge:
        """Of a tile that moves, by what is left of its components."""
        flattened = 1.0 - transfer.at_centre(spectrum, velocity_ratio)
        # by how much less on lines beside the centre line of an ellipse (lines, ...)
        beside = transfer.beside(spectrum.qx, velocity_ratio)
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
            nothing = np.zeros((0, 0), complex), np.zeros((RIM_ANGLES.size, 0), complex)
            return cls(qx, qy, *nothing, shape)
        found = ellipse.correction(qx, qy) if ellipse else disc_correction(qx, qy)
        rim = ellipse.rim(qx, qy) if ellipse else disc_rim(qx, qy)
        found, rim = found * amplitude, rim * amplitude
        if ellipse and beside is not None:
            # a wave whose amplitude changes across the motion is a sum of waves
            parts = -twice * spectrum.values[i, j] / (nx * ny) * beside[:, i, j]
            for k, part in zip(*harmonics(parts), strict=True):
                there = qy + k / shape.ellipticity
                q = np.hypot(qx, there)
                feels = (q > 1e-9) & (q < ellipse.largest)
                if feels.any():
                    wave = qx[feels], there[feels]
                    found[:, feels] += ellipse.correction(*wave) * part[feels]
                    rim[:, feels] += ellipse.rim(*wave) * part[feels]
        return cls(qx, qy, found, rim, shape)

    def below(self, limit: float) -> Edge:
        """Return the part of the waves with |q| below a limit [1/a]."""
        keep = np.hypot(self.qx, self.qy) < limit
        parts = self.coefficients[:, keep], self.rim[:, keep]
        return Edge(self.qx[keep], self.qy[keep], *parts, self.shape)

    def at(self, shift: float, track: float) -> tuple[Array, Array]:
        """Coefficients (n,) and how far the edge is moved outwards at RIM_ANGLES (k,).

        For a tile moved along and across the motion [a].
        """
        phase = np.exp(-1j * (self.qx * shift + self.qy * track))
        return (self.coefficients @ phase).real, (self.rim @ phase).real

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
