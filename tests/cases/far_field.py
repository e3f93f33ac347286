# SPDX-License-Identifier: BSD-3-Clause
"""Pressure far from a fully flooded contact, for the second solver.

Over H = r^2/2 it is lambda_bar g(angle)/r^3, the angle counted from the inlet, with g'' - 9 g = -8
cos(angle) and g = g' = 0 where the film ruptures.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

Array = NDArray[np.float64]

RUPTURE = brentq(lambda angle: np.tan(angle) + 3.0 * np.tanh(3.0 * angle), 1.6, 3.0)
"""Angle at which the film ruptures."""
SHARE = -0.8 * np.cos(RUPTURE) / np.cosh(3.0 * RUPTURE)
"""Coefficient of cosh(3 angle) in g."""


def around(angle: Array) -> Array:
    """Give g, dimensionless, at angles [rad] from the inlet."""
    g = 0.8 * np.cos(angle) + SHARE * np.cosh(3.0 * np.minimum(angle, RUPTURE))
    answer: Array = np.where(angle < RUPTURE, g, 0.0)
    return answer


def load_beyond(centre: float, inlet: float, outlet: float, side: float) -> float:
    """Load beyond a rectangle over lambda_bar, where H = centre + r^2/2.

    `inlet`, `outlet` and `side` are the distances [a] of its sides. Gauss quadrature in the angle
    and in 1/r.
    """
    angle, weight = np.polynomial.legendre.leggauss(200)
    angle = 0.5 * RUPTURE * (1.0 + angle)
    cosine, sine = np.cos(angle), np.sin(angle)
    last = np.maximum.reduce([cosine / inlet, sine / side, -cosine / outlet])
    u, du = np.polynomial.legendre.leggauss(20)
    u = 0.5 * last[:, None] * (1.0 + u)
    along = 0.5 * last * (du / (1.0 + 2.0 * centre * u**2) ** 2).sum(axis=1)
    return float(RUPTURE * (weight * around(angle) * along).sum())


def far_field(x: Array, y: Array, film: Array, h: float) -> tuple[Array, float]:
    """Give pressure of a flooded contact far from it and load beyond the nodes, over lambda_bar.

    For nodes (x, y) of a film in a rectangle with square cells of size h, Y >= 0.
    """
    pressure = np.hypot(x, y) / (4.0 * film**2) * around(np.arctan2(y, -x))
    inlet = int(np.flatnonzero((x == x.min()) & (y == 0.0))[0])
    centre = float(film[inlet] - 0.5 * x[inlet] ** 2)
    # the pressure of a border node acts on its whole cell
    borders = (0.5 * h - x.min(), 0.5 * h + x.max(), 0.5 * h + y.max())
    return pressure, load_beyond(centre, *borders)
