# SPDX-License-Identifier: BSD-3-Clause
"""An independent solver of a starved line contact over time; a layer of oil arrives at its inlet.

Newton's method, dense, with the oil S at a node (density times film, or less where P = 0) and the
pressure as unknowns: P >= 0, S <= m, P (m - S) = 0, and S of second order upstream. Shares no code
with the library. Scales and the rest of the equations: `line_newton`.
"""

from collections.abc import Mapping, Sequence

import line_newton
import numpy as np


class StarvedLine(line_newton.Line):
    """The equations of a line with a layer [b^2/R], for a mean velocity along x."""

    def transport(self, speed, now):
        """Matrix of d(US)/dX and `now` S; the first face has the flow of the layer."""
        n, h = self.n, self.h
        matrix = np.zeros((n + 1, n + 1))
        for i in range(1, n):
            matrix[i, i] = 1.5 * speed / h + now
            matrix[i, i - 1] = -0.5 * speed / h
            if i > 1:
                matrix[i, i - 1] -= 1.5 * speed / h
                matrix[i, i - 2] = 0.5 * speed / h
        return matrix

    def starved(
        self, p, missing, h00, layer, *, speed=1.0, load=1.0, curvature=1.0, viscosity=1.0, now=0.0,
        past=0.0,
    ):  # fmt: skip
        """Pressure, missing oil m - S, separation; `now` S + `past` is the squeeze term."""
        h, n = self.h, self.n
        inner = np.arange(1, n)
        matrix = self.transport(speed, now)
        inflow = np.zeros(n + 1)
        inflow[1] = -speed * layer / h
        own = matrix.copy()
        own[:, 0] = 0.0
        full = (p > 0.0) & (missing <= 0.0)
        for _ in range(100):
            gap = self.gap(p, h00, curvature)
            residual, jacobian = self.linearised(p, gap, viscosity, own)
            oil = self.mass(p, h00, curvature) - missing
            oil[0] = layer
            residual[inner] -= (matrix @ oil + inflow + past)[inner]
            residual[-1] = h * p.sum() - load * np.pi / 2.0
            # at a node that is not full the unknown is its missing oil
            thin = inner[~full[inner]]
            jacobian[:-1, thin] = own[:, thin]
            jacobian[-1, thin] = 0.0
            for end in (0, n):
                jacobian[end], jacobian[:, end], jacobian[end, end] = 0.0, 0.0, 1.0
            step = np.linalg.solve(jacobian, -residual)
            damping = 1.0
            while damping > 1e-3:
                tried = np.where(full, np.maximum(0.0, p + damping * step[:-1]), p)
                if self.gap(tried, h00 + damping * step[-1], curvature).min() > 0.3 * gap.min():
                    break
                damping *= 0.5
            new = np.where(full, p, missing) + damping * step[:-1]
            new, changes = np.maximum(new, 0.0), new < 0.0
            p, missing = np.where(full, new, 0.0), np.where(full, 0.0, new)
            p[[0, n]] = 0.0
            changes[[0, n]] = False
            full ^= changes
            h00 += damping * step[-1]
            if np.abs(step).max() < 1e-9 and not changes.any():
                return p, missing, h00
        raise AssertionError("no solution")


def march(
    line: StarvedLine,
    film: float,
    times: np.ndarray,
    duty: Sequence[Mapping[str, float]],
    layers: Sequence[float],
) -> np.ndarray:
    """Central film and smallest nodal film over time, (n, 2), by BDF2 with variable steps.

    Starts from the steady contact of the first state and layer.
    """
    p = np.sqrt(np.maximum(0.0, 1.0 - line.x**2))
    p, h00 = line.newton(p, film - 0.25 - 0.5 * np.log(2.0), **duty[0])
    missing = np.where(p > 0.0, 0.0, np.maximum(0.0, line.mass(p, h00) - layers[0]))
    p, missing, h00 = line.starved(p, missing, h00, layers[0], **duty[0])
    before = last = line.mass(p, h00, duty[0].get("curvature", 1.0)) - missing
    films = [(line.films(p, h00)[0], line.gap(p, h00).min())]
    steps = np.diff(times)
    for k, (step, state) in enumerate(zip(steps, duty[1:], strict=True)):
        r = step / steps[k - 1] if k else 1.0
        now, one, two = (1.0 + 2.0 * r) / (1.0 + r), -1.0 - r, r**2 / (1.0 + r)
        past = (one * last + two * before) / step
        p, missing, h00 = line.starved(
            p, missing, h00, layers[k + 1], now=now / step, past=past, **state
        )
        curvature = state.get("curvature", 1.0)
        before, last = last, line.mass(p, h00, curvature) - missing
        films.append((line.films(p, h00, curvature)[0], line.gap(p, h00, curvature).min()))
    return np.array(films)
