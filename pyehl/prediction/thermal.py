# SPDX-License-Identifier: BSD-3-Clause
"""The heat of sliding in the contacts of a prediction."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from pyehl import namelist
from pyehl.errors import check
from pyehl.extension import functions
from pyehl.prediction.smooth import SmoothContact
from pyehl.reasons import NOT_CONVERGED, heat_words
from pyehl.theory.heat import Heat
from pyehl.theory.lubricant import Lubricant
from pyehl.types import Array, Mask, Settings


def heat_of(settings: Settings, contact: SmoothContact, lubricant: Lubricant) -> Heat:
    """Give what the heat of sliding makes of friction in the smooth contact of a resolved case.

    On the pressure and the film of the prediction. InputError if the case is not acceptable.
    """
    # rows that mirror each other have the same temperature
    even = float(settings["contact"]["angle"]) == 0.0
    first = int(np.argmin(np.abs(contact.y))) if even else 0
    pressure, film = contact.pressure[:, first:], contact.film[:, first:]
    nodes = HeatOf(settings, lubricant, contact.x, contact.y[first:], even=even)
    return nodes(pressure, film, np.zeros(film.shape, dtype=bool))


@dataclass(frozen=True, slots=True)
class HeatOf:
    """The heat of sliding on the nodes x (m,), y (n,) [a] of a resolved case.

    The same as in a run (``fortran/reynolds/heated_friction.f90``); `even`: the rows are those of
    Y >= 0.
    """

    settings: Settings
    lubricant: Lubricant
    x: Array
    y: Array
    even: bool = False

    def __call__(self, pressure: Array, film: Array, touching: Mask) -> Heat:
        """Give it for P [p_h], H [a^2/R] and where bodies touch at a boundary film, (m, n) each."""
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
            y[1] - y[0],
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
    """Heat of a rough contact in some positions: of friction a mean, of the rises the greatest."""
    ratio = float(np.average([part.ratio for part in parts], weights=weights))
    first, second, third = (float(v) for v in np.max([part.rises for part in parts], axis=0))
    note = parts[0].note if math.isfinite(ratio) else NOT_CONVERGED
    return Heat(ratio, (first, second, third), note, rough=math.isfinite(first))
