# SPDX-License-Identifier: BSD-3-Clause
"""An independent solver of the line contact: Newton's method, dense, pressure linear in cells.

Shares no code with the library. Film and pressure by the equations of docs/theory/line.md, with the
second-order upstream wedge term, P = 0 at both ends.
"""

from collections.abc import Mapping, Sequence

import numpy as np

ALPHA, Z, P0 = 2.2e-8, 0.68, 1.96e8
# M, L of a line, H_c at X = 0 and H_min [b^2/R]: limits of three meshes of another one-dimensional
# solver within 0.1 %, on -4 <= X <= 1.5 with P = 0 at both ends, Roelands with the constants above,
# Dowson-Higginson. H_min of the last row is by `solve` on finer meshes, with a limit of 0.01214 to
# 0.01215 as the library has (docs/evidence/validation/line.csv); the other solver has 0.01196, as
# `solve` has on 110, 220 and 440 intervals
FILMS = (
    (3, 5, 0.5401, 0.4306),
    (5, 5, 0.3005, 0.2422),
    (10, 10, 0.1884, 0.1602),
    (20, 5, 0.06049, 0.05037),
    (20, 10, 0.08561, 0.07414),
    (50, 10, 0.02993, 0.02649),
    (100, 10, 0.01349, 0.01214),
)


class Line:
    """The equations on a grid, scaled by a reference state with M and L."""

    def __init__(
        self,
        moes_m: float,
        moes_l: float,
        intervals: int,
        domain: tuple[float, float],
        exponent: float = Z,
    ) -> None:
        self.x = np.linspace(*domain, intervals + 1)
        self.h, self.n, self.z = self.x[1] - self.x[0], intervals, exponent
        self.p_h = moes_l * np.sqrt(moes_m / (2.0 * np.pi)) / ALPHA
        self.inverse_speed = 8.0 * moes_m**2 / (3.0 * np.pi**2)

        def antiderivative(s):
            s = np.abs(s)
            return np.where(s > 0.0, s**2 / 2.0 * (np.log(np.where(s > 0.0, s, 1.0)) - 1.5), 0.0)

        h, lag = self.h, np.arange(intervals + 1) * self.h
        hat = antiderivative(lag + h) - 2.0 * antiderivative(lag) + antiderivative(lag - h)
        kernel = -hat / h / np.pi
        self.k = kernel[
            np.abs(np.subtract.outer(np.arange(intervals + 1), np.arange(intervals + 1)))
        ]

    def gap(self, p, h00, curvature=1.0):
        """Film."""
        return h00 + curvature * self.x**2 / 2.0 + self.k @ p

    def mass(self, p, h00, curvature=1.0):
        """Mass content, density times film."""
        rho = (5.9e8 + 1.34 * self.p_h * p) / (5.9e8 + self.p_h * p)
        return rho * self.gap(p, h00, curvature)

    def wedge(self, speed):
        """Matrix of the wedge term, of second order upstream."""
        n, h = self.n, self.h
        wedge = np.zeros((n + 1, n + 1))
        inner = np.arange(1, n)
        side = 1 if speed >= 0.0 else -1
        first = 1 if side > 0 else n - 1
        wedge[first, [first, first - side]] = 1.0 / h, -1.0 / h
        for shift, factor in enumerate((1.5, -2.0, 0.5)):
            at = inner[inner != first]
            wedge[at, at - side * shift] = factor / h
        return abs(speed) * wedge

    def linearised(self, p, gap, viscosity, transport):
        """Poiseuille term, and the Jacobian of that less `transport` @ m."""
        h, n, p_h = self.h, self.n, self.p_h
        inner = np.arange(1, n)
        c, ratio = ALPHA * P0 / self.z, 1.0 + p_h * p / P0
        rho = (5.9e8 + 1.34 * p_h * p) / (5.9e8 + p_h * p)
        drho = p_h * 0.34 * 5.9e8 / (5.9e8 + p_h * p) ** 2
        eps = self.inverse_speed / viscosity * rho * gap**3 * np.exp(-c * (ratio**self.z - 1.0))
        by_p = eps * (drho / rho - c * self.z * p_h / P0 * ratio ** (self.z - 1.0))
        east = 0.5 * (eps[1:-1] + eps[2:]) / h**2
        west = 0.5 * (eps[1:-1] + eps[:-2]) / h**2
        up, down = (p[2:] - p[1:-1]) / (2.0 * h**2), (p[:-2] - p[1:-1]) / (2.0 * h**2)
        residual = np.zeros(n + 2)
        residual[inner] = east * (p[2:] - p[1:-1]) + west * (p[:-2] - p[1:-1])
        by_film, direct = -transport * rho, -transport * (drho * gap)
        for coupling, part, side in ((east, up, 1), (west, down, -1)):
            for offset in (0, side):
                at = inner, inner + offset
                by_film[at] += part * (3.0 * eps / gap)[inner + offset]
                direct[at] += part * by_p[inner + offset]
            direct[inner, inner + side] += coupling
            direct[inner, inner] -= coupling
        jacobian = np.zeros((n + 2, n + 2))
        jacobian[:-1, :-1] = by_film @ self.k + direct
        jacobian[:-1, -1] = by_film.sum(axis=1)
        jacobian[-1, :-1] = h
        return residual, jacobian

    def newton(
        self, p, h00, *, speed=1.0, load=1.0, curvature=1.0, viscosity=1.0, now=0.0, past=0.0
    ):
        """Pressure and separation by Newton's method; `now` m + `past` is the squeeze term."""
        x, h, n, k = self.x, self.h, self.n, self.k
        inner = np.arange(1, n)
        wedge = self.wedge(speed)
        wedge[inner, inner] += now
        for _ in range(60):
            gap = self.gap(p, h00, curvature)
            residual, jacobian = self.linearised(p, gap, viscosity, wedge)
            residual[:-1] -= wedge @ self.mass(p, h00, curvature) + past
            residual[-1] = h * p.sum() - load * np.pi / 2.0
            # zero pressure where the node alone would need a negative one
            alone = p[inner] - residual[inner] / jacobian[inner, inner]
            held = np.r_[0, inner[alone <= 0.0], n]
            jacobian[held], residual[held] = 0.0, p[held]
            jacobian[held, held] = 1.0
            step = np.linalg.solve(jacobian, -residual)
            damping = 1.0
            while damping > 1e-3:
                tried = np.maximum(0.0, p + damping * step[:-1])
                if (
                    h00 + damping * step[-1] + curvature * x**2 / 2.0 + k @ tried
                ).min() > 0.3 * gap.min():
                    break
                damping *= 0.5
            p, h00 = np.maximum(0.0, p + damping * step[:-1]), h00 + damping * step[-1]
            if np.abs(step).max() < 1e-9:
                break
        return p, h00

    def films(self, p, h00, curvature=1.0):
        """Central film by a cubic through four nodes, minimum film by a parabola."""
        x, gap = self.x, self.gap(p, h00, curvature)
        centre, low = np.searchsorted(x, 0.0), int(gap.argmin())
        around = slice(centre - 2, centre + 2)
        a, b, c = np.polyfit(x[low - 1 : low + 2] - x[low], gap[low - 1 : low + 2], 2)
        return float(np.polyfit(x[around], gap[around], 3)[-1]), float(c - b**2 / (4.0 * a))


def solve(
    moes_m: float, moes_l: float, intervals: int, film: float, domain: tuple[float, float]
) -> tuple[float, float]:
    """Central and minimum film [b^2/R] of a steady contact; `film`: guess of the central one."""
    line = Line(moes_m, moes_l, intervals, domain)
    p = np.sqrt(np.maximum(0.0, 1.0 - line.x**2))
    return line.films(*line.newton(p, film - 0.25 - 0.5 * np.log(2.0)))


def march(
    line: Line, film: float, times: np.ndarray, duty: Sequence[Mapping[str, float]]
) -> np.ndarray:
    """Central film and smallest nodal film over time, (n, 2), by BDF2 with variable steps.

    Starts from the steady contact of the first state; the arguments of `newton` are given for each
    time.
    """
    p = np.sqrt(np.maximum(0.0, 1.0 - line.x**2))
    p, h00 = line.newton(p, film - 0.25 - 0.5 * np.log(2.0), **duty[0])
    before = last = line.mass(p, h00, duty[0].get("curvature", 1.0))
    films = [(line.films(p, h00)[0], line.gap(p, h00).min())]
    steps = np.diff(times)
    for k, (step, state) in enumerate(zip(steps, duty[1:], strict=True)):
        r = step / steps[k - 1] if k else 1.0
        now, one, two = (1.0 + 2.0 * r) / (1.0 + r), -1.0 - r, r**2 / (1.0 + r)
        past = (one * last + two * before) / step
        past[[0, -1]] = 0.0
        p, h00 = line.newton(p, h00, now=now / step, past=past, **state)
        curvature = state.get("curvature", 1.0)
        before, last = last, line.mass(p, h00, curvature)
        films.append((line.films(p, h00, curvature)[0], line.gap(p, h00, curvature).min()))
    return np.array(films)
