# SPDX-License-Identifier: BSD-3-Clause
"""The heat of sliding in the smooth contact under a prediction."""

import numpy as np

from pyehl import namelist
from pyehl.errors import check
from pyehl.extension import functions
from pyehl.library import returned
from pyehl.prediction.smooth import SmoothContact
from pyehl.theory.heat import Heat
from pyehl.theory.lubricant import Lubricant
from pyehl.types import Settings

NOT_SOLVED = "the temperature is not converged"


def heat_of(settings: Settings, contact: SmoothContact, lubricant: Lubricant) -> Heat:
    """Give what the heat of sliding makes of friction in the smooth contact of a resolved case.

    The same as in a run (``fortran/reynolds/heated_friction.f90``), on the pressure and the film of
    the prediction. InputError if the case is not acceptable.
    """
    groups = {
        "contact": settings["contact"],
        "lubricant": {**settings["lubricant"], "viscosity_law": lubricant.viscosity_law},
    }
    # rows that mirror each other have the same temperature
    even = float(settings["contact"]["angle"]) == 0.0
    first = int(np.argmin(np.abs(contact.y))) if even else 0
    x, y = contact.x, contact.y[first:]
    counts, ratio, rises, note, status, message = functions.heated(
        namelist.text_of(groups).encode(),
        contact.pressure[:, first:].copy(order="F"),
        contact.film[:, first:].copy(order="F"),
        x[0],
        y[0],
        x[1] - x[0],
        y[1] - y[0],
        int(even),
    )
    check(status, message)
    if not counts:
        return Heat(note=returned(note))
    first_rise, second_rise, third_rise = map(float, rises)
    words = returned(note) if np.isfinite(ratio) else NOT_SOLVED
    return Heat(float(ratio), (first_rise, second_rise, third_rise), words)
