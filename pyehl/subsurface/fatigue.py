# SPDX-License-Identifier: BSD-3-Clause
"""Criteria of multiaxial fatigue over the history of stress of material points.

Both weigh the amplitude of the deviator against the hydrostatic stress, with two fatigue limits of
the material, in fully reversed torsion and bending. The amplitude is the radius of the smallest
hypersphere around the path of the deviator s, with the norm sqrt(s:s/2).

- Dang Van 1993 (ASTM STP 1191, 120): max over time of tau(t) + a p(t), where tau is the largest
  shear of s(t) less the centre of the sphere, p the hydrostatic stress, a = 3 (t/f - 1/2).
- Crossland 1956 (Int. Conf. Fatigue of Metals, London, 138): the radius, plus a times the largest
  p, a = 3 t/f - sqrt(3).

Each is below the limit in torsion t where the material endures.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from pyehl.errors import InputError
from pyehl.subsurface.measures import (
    deviator,
    hydrostatic,
    principal_shear,
    second_invariant,
)
from pyehl.types import Array, Indices

CRITERIA = ("dang-van", "crossland")
# Steps of the way to the centre of the sphere; the radius is then right to about 1/STEPS of itself
STEPS = 200
# Points for which the sphere is found, those of the largest bounds
CANDIDATES = 64


@dataclass(frozen=True, slots=True)
class Fatigue:
    """A criterion with the limits in torsion and bending [Pa]; InputError where it has no sense."""

    criterion: str
    torsion_limit: float
    bending_limit: float

    def __post_init__(self) -> None:
        """Check the criterion and the limits."""
        if self.criterion not in CRITERIA:
            raise InputError(f"fatigue = {self.criterion!r}: expected one of {', '.join(CRITERIA)}")
        for name in ("torsion_limit", "bending_limit"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0.0):
                raise InputError(f"{name} = {value!r}: expected a fatigue limit > 0 [Pa]")
        if not self.weight >= 0.0:
            least = 0.5 if self.criterion == "dang-van" else 1.0 / math.sqrt(3.0)
            raise InputError(
                f"torsion_limit/bending_limit = {self.torsion_limit / self.bending_limit:.3g}: "
                f"{self.criterion} is for a ratio of {least:.3g} or more (ductile metals)"
            )

    @property
    def weight(self) -> float:
        """Weight a of the hydrostatic stress [-]."""
        ratio = 3.0 * self.torsion_limit / self.bending_limit
        return ratio - (1.5 if self.criterion == "dang-van" else math.sqrt(3.0))

    def largest(self, history: Array) -> float:
        """Largest equivalent stress [Pa] of points whose history is (6, times, points) [Pa]."""
        history = history[:, :, _candidates(history, self.weight)]
        centre, radius = smallest_sphere(deviator(history))
        pressure = hydrostatic(history)
        if self.criterion == "crossland":
            return float(np.max(radius + self.weight * pressure.max(axis=0)))
        shear = principal_shear(deviator(history) - centre[:, np.newaxis])
        return float(np.max(shear + self.weight * pressure))


def _norm(s: Array) -> Array:
    """sqrt(s:s/2) of deviators (6, ...)."""
    return np.asarray(np.sqrt(second_invariant(s)))


def _candidates(history: Array, weight: float) -> Indices:
    """Points with the largest bounds of the criterion: the sphere around the box of the path."""
    s = deviator(history)
    bound = _norm(0.5 * (s.max(axis=1) - s.min(axis=1)))
    bound += weight * hydrostatic(history).max(axis=0)
    return np.argsort(bound)[-CANDIDATES:]


def smallest_sphere(path: Array) -> tuple[Array, Array]:
    """Centre (6, points) and radius (points,) of the smallest spheres around paths.

    Paths are (6, times, points). By steps of falling length towards the farthest point (Badoiu &
    Clarkson 2003); the radius is the distance of the farthest point from the centre found, so that
    it is an upper bound.
    """
    centre = 0.5 * (path.max(axis=1) + path.min(axis=1))
    best, radius = centre.copy(), np.full(centre.shape[1], np.inf)
    points = np.arange(centre.shape[1])
    for step in range(1, STEPS + 1):
        distance = _norm(path - centre[:, np.newaxis])
        farthest = distance.argmax(axis=0)
        longest = distance[farthest, points]
        nearer = longest < radius
        radius = np.where(nearer, longest, radius)
        best[:, nearer] = centre[:, nearer]
        centre = centre + (path[:, farthest, points] - centre) / (step + 1)
    return best, radius
