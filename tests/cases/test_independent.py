# SPDX-License-Identifier: BSD-3-Clause
"""A second solver of the same discrete equations comes to the same friction.

It shares nothing with the first but the equations: no coarser grids, no multi-integration, no
relaxation. The deflection is a full matrix, and each time step is solved by Newton's method with
the cavitated nodes as an active set. It takes what full matrices take, so the grids are coarse.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import linalg, sparse

Array = NDArray[np.float64]

ALPHA, P_0, Z = 2.2e-8, 1.96e8, 0.6684
X_INLET, X_OUTLET = -2.5, 1.5
VELOCITY, START = 1.01, -2.5
# The roughness changes nothing before its front, with half its length, is here
X_MATTERS = -1.25


def cell(dx: Array, dy: Array, h: float) -> Array:
    """(2/pi^2) int int 1/r over the cell of a node at (dx, dy) (Johnson 1985, eq. 3.25)."""

    def corner(x: Array, y: Array) -> Array:
        return x * np.arcsinh(y / np.abs(x)) + y * np.arcsinh(x / np.abs(y))

    e, w, n, s = dx + h / 2, dx - h / 2, dy + h / 2, dy - h / 2
    return 2.0 / np.pi**2 * (corner(e, n) - corner(w, n) - corner(e, s) + corner(w, s))


class Newton:
    """A contact on the half Y >= 0 of the grid, all nodes in one vector, X first."""

    def __init__(self, moes_m: float, moes_l: float, points: int) -> None:
        self.h = (X_OUTLET - X_INLET) / (points - 1)
        self.points, self.rows = points, (points + 1) // 2
        x = X_INLET + self.h * np.arange(points)
        y = self.h * np.arange(self.rows)
        self.x, self.y = (a.ravel(order="F") for a in np.meshgrid(x, y, indexing="ij"))
        self.p_hertz = moes_l / np.pi * (1.5 * moes_m) ** (1.0 / 3.0) / ALPHA
        self.speed = (128.0 * np.pi**3 / (3.0 * moes_m**4)) ** (1.0 / 3.0)
        self.weight = np.where(self.y == 0.0, 1.0, 2.0) * self.h**2
        # the pressure of a node and of its mirror image
        dx = self.x[:, None] - self.x
        near, far = (cell(dx, self.y[:, None] + side * self.y, self.h) for side in (-1.0, 1.0))
        self.kernel = near + far * (self.y > 0.0)
        self.inside = (self.x > x[0]) & (self.x < x[-1]) & (self.y < y[-1])
        self.first = np.isclose(self.x, x[1])
        self.neighbours = [self.at(*move) for move in ((1, 0), (-1, 0), (0, 1), (0, -1))]

    def at(self, di: int, dj: int) -> sparse.csr_array:
        """Matrix that takes values from so many nodes further; 0 from outside."""
        i, j = np.meshgrid(np.arange(self.points), np.arange(self.rows), indexing="ij")
        to = (i + di, abs(j + dj))
        good = ((to[0] >= 0) & (to[0] < self.points) & (to[1] < self.rows)).ravel(order="F")
        row = np.flatnonzero(good)
        column = (to[0] + self.points * to[1]).ravel(order="F")[good]
        shape = (self.x.size, self.x.size)
        return sparse.csr_array((np.ones(row.size), (row, column)), shape)

    def wave(self, amplitude: float, wavelength: float, time: float) -> Array:
        """Eq. 15."""
        along = (self.x - START - VELOCITY * time) / wavelength
        fade = 10.0 ** (-10.0 * np.maximum(0.0, along) ** 2)
        across = np.cos(2.0 * np.pi * self.y / wavelength)
        return amplitude * fade * np.cos(2.0 * np.pi * along) * across

    def viscosity(self, p: Array) -> tuple[Array, Array]:
        """Roelands: eta, d ln eta/dP."""
        r = 1.0 + p * self.p_hertz / P_0
        return np.exp(ALPHA * P_0 / Z * (r**Z - 1.0)), ALPHA * self.p_hertz * r ** (Z - 1.0)

    def density(self, p: Array) -> tuple[Array, Array]:
        """Dowson & Higginson: rho, d rho/dP."""
        q = p * self.p_hertz
        return (5.9e8 + 1.34 * q) / (5.9e8 + q), 0.34 * 5.9e8 * self.p_hertz / (5.9e8 + q) ** 2

    def friction(self, p: Array, film: Array) -> float:
        return float((self.weight * self.viscosity(p)[0] / film).sum())

    def solve(
        self, p: Array, h00: float, separation: Array, transport: Any, known: Array
    ) -> tuple[Array, float, Array]:
        """P, H00 and H with -div(eps grad P) + transport (rho H) + known = 0 or P = 0."""
        n = p.size
        for _ in range(60):
            film = h00 + separation + self.kernel @ p
            (eta, d_eta), (rho, d_rho) = self.viscosity(p), self.density(p)
            eps = rho * film**3 / (eta * self.speed)
            couple, slope = sparse.csr_array((n, n)), sparse.csr_array((n, n))
            for move in self.neighbours:
                mean = sparse.diags_array(0.5 * (move @ eps + eps) / self.h**2)
                couple = couple + mean @ (move - sparse.eye_array(n))
                drop = sparse.diags_array(0.5 * (move @ p - p) / self.h**2)
                slope = slope + drop @ (move + sparse.eye_array(n))
            residual = -couple @ p + transport @ (rho * film) + known
            by_film = transport @ sparse.diags_array(rho) - slope @ sparse.diags_array(
                3.0 * eps / film
            )
            by_p = transport @ sparse.diags_array(d_rho * film) - couple
            by_p = by_p - slope @ sparse.diags_array(eps * (d_rho / rho - d_eta))
            matrix = np.zeros((n + 1, n + 1))
            matrix[:n, :n] = by_film @ self.kernel
            matrix[:n, :n] += by_p.toarray()
            matrix[:n, n] = by_film @ np.ones(n)
            matrix[n, :n] = self.weight
            rest = np.append(residual, self.weight @ p - 2.0 * np.pi / 3.0)
            fixed = ~self.inside | (p - residual / np.abs(matrix.diagonal()[:n]) <= 0.0)
            rows = np.flatnonzero(fixed)
            matrix[rows] = 0.0
            matrix[rows, rows] = 1.0
            rest[rows] = p[rows]
            error = np.sqrt(np.mean(rest[:n] ** 2))
            if error < 1e-8 and abs(rest[n]) < 1e-9:
                return p, h00, film
            change = linalg.solve(matrix, -rest, overwrite_a=True, check_finite=False)
            damp = min(1.0, 0.3 / np.abs(change[:n]).max())
            p, h00 = np.maximum(0.0, p + damp * change[:n]), h00 + damp * change[n]
        raise AssertionError(f"Newton's method does not converge: residual {error}")

    def smooth(self) -> tuple[Array, float, Array]:
        """The steady contact, second-order upstream."""
        identity = sparse.eye_array(self.x.size)
        order = np.where(self.first, 0.0, 1.0)
        transport = (
            sparse.diags_array(1.0 + 0.5 * order) @ identity
            - sparse.diags_array(1.0 + order) @ self.at(-1, 0)
            + sparse.diags_array(0.5 * order) @ self.at(-2, 0)
        ) / self.h
        p = np.sqrt(np.maximum(0.0, 1.0 - self.x**2 - self.y**2))
        shape = 0.5 * (self.x**2 + self.y**2)
        return self.solve(p, -0.9, shape, transport, np.zeros_like(p))

    def march(self, amplitude: float, wavelength: float, steps: int) -> Array:
        """mu_r/mu_s of so many steps, narrow upstream, the step being the mesh size."""
        shape = 0.5 * (self.x**2 + self.y**2)
        p, h00, film = self.smooth()
        smooth = self.friction(p, film)
        skipped = int((X_MATTERS - 0.5 * wavelength - START) / VELOCITY / self.h)
        mass = [
            self.density(p)[0] * (film - self.wave(amplitude, wavelength, (skipped - k) * self.h))
            for k in (0, 1)
        ]
        order = np.where(self.first, 0.0, 1.0)
        transport = sparse.diags_array((1.0 + 0.5 * order) / self.h)
        ratios = []
        for step in range(skipped + 1, skipped + steps + 1):
            separation = shape - self.wave(amplitude, wavelength, step * self.h)
            known = -(1.0 + order) * (self.at(-1, 0) @ mass[0])
            known = (known + 0.5 * order * (self.at(-2, 0) @ mass[1])) / self.h
            p, h00, film = self.solve(p, h00, separation, transport, known)
            mass = [self.density(p)[0] * film, mass[0]]
            ratios.append(self.friction(p, film) / smooth)
        return np.array(ratios)


@pytest.mark.parametrize(
    ("point", "points", "amplitude", "wavelength"),
    [
        ((100.0, 6.0), 33, 0.03, 1.0),
        pytest.param((500.0, 5.0), 65, 0.012, 0.5, marks=pytest.mark.slow),
        pytest.param((700.0, 12.0), 65, 0.012, 0.7, marks=pytest.mark.slow),
    ],
)
def test_same_friction(
    solve, point: tuple[float, float], points: int, amplitude: float, wavelength: float
):
    wave = {
        "lubricant.roelands_z": Z,
        "surface.kind": "harmonic",
        "surface.amplitude": amplitude,
        "surface.wavelength": wavelength,
        "surface.velocity_ratio": VELOCITY,
        "time.estimate_error": False,
        "solver.deflection": "fft",
        "solver.accuracy": 0.0005,
    }
    done = solve(point, points, wave)
    assert done.converged
    ratios = Newton(*point, points).march(amplitude, wavelength, done["steps"])
    assert ratios.max() > 1.05
    # Both are the solution of the same equations: what differs is the algebraic error
    assert done.history["mu_ratio"] == pytest.approx(ratios, rel=1e-4)
