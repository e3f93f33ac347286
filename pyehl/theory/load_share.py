# SPDX-License-Identifier: BSD-3-Clause
"""Friction of a contact whose film is thinner than its roughness, by an empirical law.

Asperities carry the fraction exp(-B (h_c/sigma)^C) of the load (Zhou & Hoeprich 1991, J. Tribol.
113, 590, eq. 29), h_c/sigma being the central film over the composite rms height, with the boundary
friction; the film carries the rest with its own friction. B and C depend on the pair of surfaces.
"""

import math
from dataclasses import dataclass

from pyehl.errors import InputError

AIHARA = 1.8, 1.2
"""B and C of Aihara 1987, J. Tribol. 109, 471, eq. 13 [-]."""


@dataclass(frozen=True, slots=True)
class LoadShare:
    """The empirical law with its constants.

    The constants of Aihara are a fit to the partial elastohydrodynamic contacts of Patir & Cheng:
    below 0.4 GPa, roughness mostly along the motion; above Lambda = 2 the film carries nearly all
    of the load. InputError for a number out of range.
    """

    boundary_friction: float  # coefficient of friction of the asperities [-], up to 1
    b: float = AIHARA[0]  # [-]
    c: float = AIHARA[1]  # [-]

    def __post_init__(self) -> None:
        """Check the numbers."""
        for name, number, maximum in (
            ("boundary friction", self.boundary_friction, 1.0),
            ("B", self.b, 100.0),
            ("C", self.c, 10.0),
        ):
            if not (math.isfinite(number) and 0.0 < number <= maximum):
                raise InputError(
                    f"{name} = {number!r}: expected a number above 0, up to {maximum:g}"
                )

    @property
    def words(self) -> str:
        """The law with its numbers, and the source of its constants."""
        source = (
            "constants of Aihara 1987 for pressures below 0.4 GPa and h_c/sigma up to 2"
            if (self.b, self.c) == AIHARA
            else "constants as given"
        )
        return (
            f"empirical: exp(-{self.b:g} (h_c/sigma)^{self.c:g}) of the load, at a "
            f"boundary friction of {self.boundary_friction:g} (Zhou & Hoeprich 1991; {source})"
        )

    def share(self, lambda_ratio: float) -> float:
        """Fraction of the load that asperities carry [-], from h_c/sigma [-]."""
        return math.exp(-self.b * lambda_ratio**self.c)

    def friction(self, lambda_ratio: float, film: float) -> float:
        """Coefficient of friction [-] from h_c/sigma [-] and the coefficient of the film [-]."""
        share = self.share(lambda_ratio)
        return share * self.boundary_friction + (1.0 - share) * film
