# SPDX-License-Identifier: BSD-3-Clause
"""Criteria of multiaxial fatigue over the history of stress of material points.

Both weigh the amplitude of the deviator against the hydrostatic stress, with two fatigue limits of
the material, in fully reversed torsion and bending. The amplitude is the radius of the smallest
hypersphere around the path of the deviator s, with the norm sqrt(s:s/2); its centre is the mean
(:class:`pyehl.subsurface.cycle.Cycle`).

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
from pyehl.subsurface.cycle import Cycle
from pyehl.subsurface.measures import deviator, hydrostatic, principal_shear

CRITERIA = ("dang-van", "crossland")


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

    def largest(self, cycle: Cycle) -> float:
        """Largest equivalent stress [Pa] of the material points of a cycle."""
        if self.criterion == "crossland":
            top = cycle.hydrostatic_mean + cycle.hydrostatic_amplitude
            return float(np.max(cycle.amplitude + self.weight * top))
        shear = principal_shear(deviator(cycle.history) - cycle.mean[:, np.newaxis])
        return float(np.max(shear + self.weight * hydrostatic(cycle.history)))
