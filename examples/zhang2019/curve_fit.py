# SPDX-License-Identifier: BSD-3-Clause
"""Fits of the form of eq. 16, mu_r/mu_s = 1 + a theta^-2 + b theta^-4, and the scatter about them.

Relative deviations of mu_r/mu_s are minimised: the ratio spans two decades, so that the two or
three largest values would dominate a fit of absolute ones. Points of one curve (one M, L and
wavelength) are not independent; the confidence interval is from a bootstrap over the curves.
"""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import nnls

from pyehl.types import Array, Indices

CONFIDENCE = 0.95
SAMPLES = 2000
SEED = 16


@dataclass(frozen=True, slots=True)
class Fit:
    """Coefficients of theta^-2 and theta^-4, and their confidence intervals (low, high)."""

    second: float
    fourth: float
    second_interval: tuple[float, float]
    fourth_interval: tuple[float, float]
    points: int
    curves: int

    def at(self, theta: Array) -> Array:
        """mu_r/mu_s [-]."""
        return evaluate(theta, self.second, self.fourth)

    def __str__(self) -> str:
        """Return the equation with its intervals."""
        (a, b), (c, d) = self.second_interval, self.fourth_interval
        return (
            f"1 + {self.second:.3g} theta^-2 + {self.fourth:.3g} theta^-4, "
            f"{100.0 * CONFIDENCE:g} % intervals {a:.3g} ... {b:.3g} and {c:.3g} ... {d:.3g}, "
            f"{self.points} waves of {self.curves} curves"
        )


def evaluate(theta: Array, second: float, fourth: float) -> Array:
    """1 + second theta^-2 + fourth theta^-4 [-]."""
    return np.asarray(1.0 + second * theta**-2 + fourth * theta**-4)


def scatter(friction: Array, curve: Array) -> float:
    """Rms of ln(mu_r/mu_s over the curve) [-]: a relative deviation."""
    return float(np.sqrt(np.mean(np.log(friction / curve) ** 2)))


def fit(theta: Array, friction: Array, curve: Indices) -> Fit:
    """Fit the form of eq. 16 to the parameter and mu_r/mu_s of waves (n,), all finite.

    `curve` (n,) is the number of the curve of each wave; ValueError for fewer than three curves.
    """
    members = [np.flatnonzero(curve == k) for k in np.unique(curve)]
    if len(members) < 3:
        raise ValueError(f"a fit needs three curves at least, not {len(members)}")
    columns = np.stack([theta**-2, theta**-4], axis=1)
    best = _solve(columns, friction)
    random = np.random.default_rng(SEED)
    result = np.empty((SAMPLES, 2))
    for k in range(SAMPLES):
        drawn = random.integers(len(members), size=len(members))
        chosen = np.concatenate([members[m] for m in drawn])
        result[k] = _solve(columns[chosen], friction[chosen])
    tail = 0.5 * (1.0 - CONFIDENCE)
    low, high = np.quantile(result, [tail, 1.0 - tail], axis=0)
    return Fit(
        float(best[0]),
        float(best[1]),
        (float(low[0]), float(high[0])),
        (float(low[1]), float(high[1])),
        theta.size,
        len(members),
    )


def _solve(columns: Array, friction: Array) -> Array:
    """Minimise the squares of relative deviations, with coefficients that are not negative."""
    weight = 1.0 / friction
    solution, _ = nnls(columns * weight[:, np.newaxis], (friction - 1.0) * weight)
    return np.asarray(solution)
