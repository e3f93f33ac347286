# SPDX-License-Identifier: BSD-3-Clause
"""Frictional heating of a contact: temperatures, and their effect on friction."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from pyehl import namelist
from pyehl.errors import check
from pyehl.extension import functions
from pyehl.reasons import NOT_CONVERGED, heat_words
from pyehl.theory.heat import Heat
from pyehl.theory.lubricant import Lubricant
from pyehl.types import Array, Mask, Settings


@dataclass(frozen=True, slots=True)
class HeatOf:
    """Frictional heating on the nodes x (m,), y (n,) [a] of a resolved case.

    Computed as in a run (``fortran/reynolds/heated_friction.f90``); `even`: y are the nodes with
    Y >= 0 of a symmetric contact.
    """

    settings: Settings
    lubricant: Lubricant
    x: Array
    y: Array
    even: bool = False

    def __call__(self, pressure: Array, film: Array, touching: Mask) -> Heat:
        """Return the heating for P [p_h], H [a^2/R] and the nodes in solid contact, (m, n) each."""
        law = {"viscosity_law": self.lubricant.viscosity_law}
        groups = {
            "contact": self.settings["contact"],
            "lubricant": {**self.settings["lubricant"], **law},
        }
        x, y = self.x, self.y
        counts, ratio, rises, reason, estimate, status, message = functions.frictional_heat(
            namelist.text_of(groups).encode(),
            np.array(pressure, order="F"),
            np.array(film, order="F"),
            np.array(touching, dtype=np.int32, order="F"),
            x[0],
            y[0],
            x[1] - x[0],
            y[1] - y[0] if y.size > 1 else 1.0,
            int(self.even),
        )
        check(status, message)
        words = heat_words(reason, estimate)
        if not counts:
            return Heat(note=words)
        first, second, third = map(float, rises)
        note = words if np.isfinite(ratio) else NOT_CONVERGED
        return Heat(float(ratio), (first, second, third), note)


def mean_heat(parts: Sequence[Heat], weights: Sequence[float]) -> Heat:
    """Heating of a rough contact over its positions: mean friction ratio, maximum increases.

    `weights` are those of the positions in the mean.
    """
    ratio = float(np.average([part.ratio for part in parts], weights=weights))
    first, second, third = (float(v) for v in np.max([part.rises for part in parts], axis=0))
    note = parts[0].note if math.isfinite(ratio) else NOT_CONVERGED
    return Heat(ratio, (first, second, third), note, rough=math.isfinite(first))
