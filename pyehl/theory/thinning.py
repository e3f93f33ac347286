# SPDX-License-Identifier: BSD-3-Clause
"""Flow and sliding of lubricants that thin by shear, by the laws of the compiled library.

A gradient of pressure drives phi_x times as much along X, the direction of the sliding, and phi_y
times as much along Y as in a Newtonian lubricant. The factors are those of
``fortran/physics/flow_factors.f90``, exact through the film.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from pyehl import extension
from pyehl.errors import EhlError
from pyehl.types import Array

CODES = {"eyring": 1, "carreau": 2}
"""Laws that thin a flow, by the numbers that the library has for them."""


@dataclass(frozen=True, slots=True)
class FlowFactors:
    """Flow factors of films and how that along X changes, all of one shape [-]."""

    along: Array  # phi_x
    across: Array  # phi_y
    by_sliding: Array  # d ln(phi_x)/d ln(B)
    by_gradient: Array  # d ln(phi_x)/d ln(S)
    tangent: Array  # d(phi_x S_x)/dS_x


def flow_factors(
    law: str, exponent: float, sliding: ArrayLike, gradient: tuple[ArrayLike, ArrayLike]
) -> FlowFactors:
    """Give the factors of films by B and S = (S_x, S_y).

    Parameters
    ----------
    law, exponent
        One of `CODES`, and the exponent n of Carreau.
    sliding
        B = eta |u1 - u2|/h over the stress of the law, any shape [-].
    gradient
        S = h grad p over the stress of the law, along X and Y; broadcast to that shape [-].

    Raises
    ------
    EhlError
        If the stress through a film is not found.
    """
    b = np.asarray(sliding, dtype=float)
    s = np.empty((2, b.size), order="F")
    for i, part in enumerate(gradient):
        s[i] = np.broadcast_to(part, b.shape).ravel()
    found = np.empty((5, b.size), order="F")
    extension.lubricants.flow_factors(CODES[law], exponent, b.ravel().copy(), s, found)
    if not np.all(np.isfinite(found)):
        raise EhlError(f"no flow factors of a film that obeys {law} at a stress beyond all bounds")
    return FlowFactors(*(row.reshape(b.shape) for row in found))


def sliding_stress(law: str, exponent: float, sliding: ArrayLike) -> Array:
    """Stress over that of the law in films that slide alone, by B of any shape [-].

    NaN where it is not found.
    """
    b = np.asarray(sliding, dtype=float)
    stress = np.empty(b.size)
    extension.lubricants.sliding_stresses(CODES[law], exponent, b.ravel().copy(), stress)
    return stress.reshape(b.shape)
