# SPDX-License-Identifier: BSD-3-Clause
"""A second solver of the same discrete equations, to check the first.

The two share only the equations: this one has no coarser grids, no multi-integration and no
relaxation. Each time step is solved by Newton's method with the cavitated nodes as an active set;
the linear systems by GMRES, with the LU factors of an earlier, full matrix as preconditioner.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy.fft
from far_field import far_field
from numpy.typing import NDArray
from scipy import linalg, sparse
from scipy.sparse.linalg import LinearOperator, gmres
from scipy.special import elliprd

Array = NDArray[np.float64]

ALPHA, P_0, Z = 2.2e-8, 1.96e8, 0.6684
# The domain of Zhang et al. 2019, where the roughness begins too
X_INLET, X_OUTLET = -2.5, 1.5
START = X_INLET
VELOCITY = 1.01
# The roughness has no effect until its front plus half a wavelength is at this X
X_MATTERS = -1.25
# Residual (rms) and error of the load of a solution
TOLERANCE, LOAD_TOLERANCE = 1e-8, 1e-9
# Relative change of the border pressure of a flooded contact that ends its iteration
BORDER_TOLERANCE = 1e-6
# The factors are made anew after more products with the matrix than this
MAX_PRODUCTS = 30
# Columns of the full matrix that are computed at once
BLOCK = 500


def cell(dx: Array, dy: Array, h: float) -> Array:
    """(2/pi^2) int int 1/r over the cell of a node at (dx, dy) (Johnson 1985, eq. 3.25)."""

    def corner(x: Array, y: Array) -> Array:
        return x * np.arcsinh(y / np.abs(x)) + y * np.arcsinh(x / np.abs(y))

    e, w, n, s = dx + h / 2, dx - h / 2, dy + h / 2, dy - h / 2
    return 2.0 / np.pi**2 * (corner(e, n) - corner(w, n) - corner(e, s) + corner(w, s))


class NotSolvedError(Exception):
    """Newton's method did not converge."""


@dataclass(frozen=True, slots=True)
class Wave:
    """A waviness: amplitude [a^2/R], wavelengths [a], velocity over the mean one."""

    amplitude: float
    length_x: float
    length_y: float
    velocity: float = VELOCITY


class SecondSolver:
    """A contact on the half Y >= 0 of the grid, all nodes in one vector, X first.

    `borders` are inlet and outlet [a], `side` the largest Y, by default half the length. At the
    border P = 0 or, `flooded`, the pressure of a fully flooded contact. `kappa` is the semi-axis
    across the motion over that along it; only a round contact is flooded.
    """

    def __init__(
        self,
        moes_m: float,
        moes_l: float,
        points: int,
        *,
        narrow: bool = True,
        borders: tuple[float, float] = (X_INLET, X_OUTLET),
        flooded: bool = False,
        kappa: float = 1.0,
        side: float | None = None,
    ) -> None:
        assert kappa == 1.0 or not flooded
        self.flooded, self.start, self.kappa = flooded, borders[0], kappa
        length = borders[1] - borders[0]
        self.h = length / (points - 1)
        self.points = points
        self.rows = round((length / 2 if side is None else side) / self.h) + 1
        self.across = 2 * self.rows - 1
        self.narrow = narrow
        x = self.start + self.h * np.arange(points)
        y = self.h * np.arange(self.rows)
        self.x, self.y = (a.ravel(order="F") for a in np.meshgrid(x, y, indexing="ij"))
        self.p_hertz = moes_l / np.pi * (1.5 * moes_m) ** (1.0 / 3.0) / ALPHA
        self.speed = (128.0 * np.pi**3 / (3.0 * moes_m**4)) ** (1.0 / 3.0)
        # Hertz: sqrt(1 - X^2 - (Y/kappa)^2) deflects by a constant less c_x X^2 + c_y Y^2
        c_x = np.pi * kappa / 3.0 * elliprd(0.0, kappa**2, 1.0)
        c_y = np.pi * kappa / 3.0 * elliprd(0.0, 1.0, kappa**2)
        self.radius_ratio, stiff = c_y / c_x, np.pi**2 / (4.0 * c_x)
        self.p_hertz *= (kappa * stiff) ** (2.0 / 3.0) / kappa
        self.speed *= kappa * (kappa * stiff) ** (1.0 / 3.0)
        self.weight = np.where(self.y == 0.0, 1.0, 2.0) * self.h**2
        # deflection by the pressure of one cell, at (i, j) nodes from it
        far, wide = (self.h * np.arange(count, dtype=np.float64) for count in (points, self.across))
        self.cells = stiff * cell(far[:, None], wide[None, :], self.h)
        wrapped = np.zeros((2 * points, 2 * self.across))
        wrapped[:points, : self.across] = self.cells
        wrapped[1 - points :, : self.across] = self.cells[:0:-1]
        wrapped[:, 1 - self.across :] = wrapped[:, self.across - 1 : 0 : -1]
        self.transform = scipy.fft.rfft2(wrapped)
        self.border, self.load = np.zeros(self.x.size), 2.0 * np.pi / 3.0 * kappa
        self.inside = (self.x > x[0]) & (self.x < x[-1]) & (self.y < y[-1])
        self.first = np.isclose(self.x, x[1])
        self.neighbours = [self.at(*move) for move in ((1, 0), (-1, 0), (0, 1), (0, -1))]
        self.column = np.tile(np.arange(points), self.rows)
        self.row = np.repeat(np.arange(self.rows), points)
        # deflection, by the pressure of a node, of the nodes whose film its equation contains
        concerned = sparse.eye_array(self.x.size) + self.at(-2, 0)
        pattern = sparse.coo_array(sum(self.neighbours, concerned))
        here, there = pattern.coords
        self.near = sparse.csr_array((self.kernel(there, here), (here, there)), pattern.shape)
        # LU factors of a full matrix, and the nodes for which it was computed
        self.factors: Any = None
        self.set: NDArray[np.intp] = np.zeros(0, dtype=np.intp)

    def at(self, di: int, dj: int) -> sparse.csr_array:
        """Matrix that takes values from nodes shifted by (di, dj); 0 from outside."""
        i, j = np.meshgrid(np.arange(self.points), np.arange(self.rows), indexing="ij")
        to = (i + di, abs(j + dj))
        inside = ((to[0] >= 0) & (to[0] < self.points) & (to[1] < self.rows)).ravel(order="F")
        row = np.flatnonzero(inside)
        column = (to[0] + self.points * to[1]).ravel(order="F")[inside]
        shape = (self.x.size, self.x.size)
        return sparse.csr_array((np.ones(row.size), (row, column)), shape)

    def kernel(self, of: NDArray[np.intp], by: NDArray[np.intp]) -> Array:
        """Deflection of nodes `of` by the pressure of nodes `by` and of their mirror images."""
        across = abs(self.column[of] - self.column[by])
        image = self.cells[across, self.row[of] + self.row[by]] * (self.row[by] > 0)
        return np.asarray(self.cells[across, abs(self.row[of] - self.row[by])] + image)

    def deflect(self, p: Array) -> Array:
        """Deflection of all nodes."""
        half = p.reshape(self.rows, self.points)
        whole = np.concatenate([half[:0:-1], half]).T
        size = (2 * self.points, 2 * self.across)
        w = scipy.fft.irfft2(scipy.fft.rfft2(whole, s=size) * self.transform, s=size)
        return np.asarray(w[: self.points, self.rows - 1 : self.across].T.ravel())

    def rough(self, waves: Iterable[Wave], step: int) -> Array:
        """Heights of eq. 15, summed over waves."""
        answer: Array = np.zeros_like(self.x)
        for wave in waves:
            along = (self.x - self.start - wave.velocity * step * self.h) / wave.length_x
            fade = 10.0 ** (-10.0 * np.maximum(0.0, along) ** 2)
            across = np.cos(2.0 * np.pi * self.y / wave.length_y)
            answer += wave.amplitude * fade * np.cos(2.0 * np.pi * along) * across
        return answer

    def viscosity(self, p: Array) -> tuple[Array, Array]:
        """Roelands: eta, d ln eta/dP."""
        r = 1.0 + p * self.p_hertz / P_0
        return np.exp(ALPHA * P_0 / Z * (r**Z - 1.0)), ALPHA * self.p_hertz * r ** (Z - 1.0)

    def density(self, p: Array) -> tuple[Array, Array]:
        """Dowson & Higginson: rho, d rho/dP."""
        q = p * self.p_hertz
        return (5.9e8 + 1.34 * q) / (5.9e8 + q), 0.34 * 5.9e8 * self.p_hertz / (5.9e8 + q) ** 2

    def friction(self, p: Array, film: Array) -> float:
        """Integral of eta/H."""
        return float((self.weight * self.viscosity(p)[0] / film).sum())

    def solve(
        self, p: Array, h00: float, separation: Array, transport: sparse.sparray, known: Array
    ) -> tuple[Array, float, Array]:
        """P, H00 and H with -div(eps grad P) + transport (rho H) + known = 0 or P = 0."""
        n = p.size
        for _ in range(80):
            film = h00 + separation + self.deflect(p)
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
            diagonal = by_p.diagonal() + by_film.multiply(self.near).sum(axis=1)
            fixed = ~self.inside | (p - residual / np.abs(diagonal) <= 0.0)
            residuals = np.append(
                np.where(fixed, p - self.border, residual), self.weight @ p - self.load
            )
            error = np.sqrt(np.mean(residuals[:n] ** 2))
            if error < TOLERANCE and abs(residuals[n]) < LOAD_TOLERANCE:
                return p, h00, film
            change = self.newton_step(by_film, by_p, fixed, residuals, diagonal)
            damp = min(1.0, 0.3 / np.abs(change[:n]).max())
            p, h00 = np.maximum(0.0, p + damp * change[:n]), h00 + damp * change[n]
        raise NotSolvedError(f"Newton's method does not converge: residual {error}")

    def newton_step(
        self,
        by_film: sparse.sparray,
        by_p: sparse.sparray,
        fixed: NDArray[np.bool_],
        residuals: Array,
        diagonal: Array,
    ) -> Array:
        """Give the changes of P and H00; fixed nodes get the border pressure, which is 0 inside."""
        n = fixed.size
        # scales all equations to pressure
        free = sparse.diags_array(np.where(fixed, 0.0, 1.0 / diagonal))
        by_film, by_p = (free @ by_film).tocsr(), (free @ by_p).tocsr()
        wanted = np.append(
            np.where(fixed, -residuals[:n], -residuals[:n] / diagonal), -residuals[n]
        )

        def product(v: Array) -> Array:
            film = self.deflect(v[:n]) + v[n]
            answer = by_film @ film + by_p @ v[:n] + np.where(fixed, v[:n], 0.0)
            return np.append(answer, self.weight @ v[:n])

        def precondition(v: Array) -> Array:
            answer = v.copy()
            where = np.append(self.set, n)
            answer[where] = linalg.lu_solve(self.factors, v[where], check_finite=False)
            return answer

        matrix = LinearOperator((n + 1, n + 1), product, dtype=np.float64)
        inverse = LinearOperator((n + 1, n + 1), precondition, dtype=np.float64)
        for fresh in (False, True):
            if fresh or self.factors is None:
                self.factor(by_film, by_p, np.flatnonzero(~fixed))
            change, failed = gmres(
                matrix, wanted, M=inverse, rtol=1e-3, atol=0.0, restart=MAX_PRODUCTS, maxiter=1
            )
            if not failed:
                break
        return np.asarray(change)

    def factor(
        self, by_film: sparse.sparray, by_p: sparse.sparray, nodes: NDArray[np.intp]
    ) -> None:
        """Keep the LU factors of the full matrix of some nodes and the load."""
        rows = by_film[nodes]
        touched = np.unique(rows.indices)
        m = nodes.size
        matrix = np.empty((m + 1, m + 1), order="F")
        for part in np.array_split(np.arange(m), m // BLOCK + 1):
            matrix[:m, part] = rows[:, touched] @ self.kernel(touched[:, None], nodes[None, part])
        matrix[:m, :m] += by_p[nodes][:, nodes].toarray()
        matrix[:m, m] = rows.sum(axis=1)
        matrix[m, :m] = self.weight[nodes]
        matrix[m, m] = 0.0
        self.factors = linalg.lu_factor(matrix, overwrite_a=True, check_finite=False)
        self.set = nodes

    def upstream(self) -> sparse.sparray:
        """Give the second-order upstream difference along X, of first order in the first column."""
        order = np.where(self.first, 0.0, 1.0)
        answer = (
            sparse.diags_array(1.0 + 0.5 * order)
            - sparse.diags_array(1.0 + order) @ self.at(-1, 0)
            + sparse.diags_array(0.5 * order) @ self.at(-2, 0)
        )
        return answer / self.h

    def smooth(self) -> tuple[Array, float, Array]:
        """Solve the steady contact."""
        p = np.sqrt(np.maximum(0.0, 1.0 - self.x**2 - (self.y / self.kappa) ** 2))
        shape = 0.5 * (self.x**2 + self.radius_ratio * self.y**2)
        p, h00, film = self.solve(p, -0.9, shape, self.upstream(), np.zeros_like(p))
        while self.flooded:
            before = self.border
            pressure, beyond = far_field(self.x, self.y, film, self.h)
            self.border = np.where(self.inside, 0.0, self.speed * pressure)
            self.load = 2.0 * np.pi / 3.0 - self.speed * beyond
            p, h00, film = self.solve(p, h00, shape, self.upstream(), np.zeros_like(p))
            if np.abs(self.border - before).max() < BORDER_TOLERANCE * self.border.max():
                break
        return p, h00, film

    def steps(self, *waves: Wave) -> Iterator[tuple[float, Array]]:
        """mu_r/mu_s and the film after each step of one mesh size, for a sum of waves."""
        shape = 0.5 * (self.x**2 + self.radius_ratio * self.y**2)
        p, h00, film = self.smooth()
        smooth = self.friction(p, film)
        ways = [(X_MATTERS - 0.5 * w.length_x - self.start) / w.velocity for w in waves]
        step = max(0, int(min(ways) / self.h))
        mass = [self.density(p)[0] * (film - self.rough(waves, step - k)) for k in (0, 1)]
        order = np.where(self.first, 0.0, 1.0)
        if self.narrow:
            transport = sparse.diags_array((1.0 + 0.5 * order) / self.h)
        else:
            transport = self.upstream() + 1.5 / self.h * sparse.eye_array(p.size)
        while True:
            step += 1
            separation = shape - self.rough(waves, step)
            if self.narrow:
                known = -(1.0 + order) * (self.at(-1, 0) @ mass[0])
                known = (known + 0.5 * order * (self.at(-2, 0) @ mass[1])) / self.h
            else:
                known = (-2.0 * mass[0] + 0.5 * mass[1]) / self.h
            p, h00, film = self.solve(p, h00, separation, transport, known)
            mass = [self.density(p)[0] * film, mass[0]]
            yield self.friction(p, film) / smooth, film
