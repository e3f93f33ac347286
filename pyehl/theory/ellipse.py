# SPDX-License-Identifier: BSD-3-Clause
"""Hertz contact ellipse from the ratio of the radii of curvature."""

import math
from dataclasses import dataclass
from functools import lru_cache

from pyehl.errors import InputError
from pyehl.given import positive


@dataclass(frozen=True, slots=True)
class Ellipse:
    """Shape of a dry contact, in terms of its semi-axis a along the motion.

    Attributes
    ----------
    radius_ratio
        D = R_x/R_y [-], R_x in the plane of the motion.
    ellipticity
        kappa [-], the semi-axis across the motion over a.
    kernel_ratio
        Factor k_b of the deflection over 2/pi^2, that of a circle [-].
    """

    radius_ratio: float
    ellipticity: float
    kernel_ratio: float

    @property
    def is_line(self) -> bool:
        """Whether the contact is an infinite line."""
        return math.isinf(self.ellipticity)

    @property
    def side(self) -> float:
        """Unit of length across the motion [a]: the semi-axis, for a line 1."""
        return 1.0 if self.is_line else self.ellipticity

    @property
    def load_factor(self) -> float:
        """Product kappa k_b over that of a circle [-]: a^3 = 3 w R_x/(2 E' load_factor)."""
        return self.ellipticity * self.kernel_ratio

    @property
    def potential(self) -> float:
        """Integral of P/r about the centre over that for a circle of radius a [-], P Hertzian."""
        if self.radius_ratio in (0.0, 1.0):
            return 1.0 if self.radius_ratio else math.inf
        from scipy.special import elliprf  # noqa: PLC0415 (as below)

        result = elliprf(0.0, 1.0, self.ellipticity**2)
        return 2.0 / math.pi * self.ellipticity * float(result)


LINE = Ellipse(0.0, math.inf, 0.25 * math.pi)
"""Dry contact of an infinite line: its semi-axis across the motion is infinite."""


RATIOS = (1e-6, 1e6)
"""Minimum and maximum radius ratio of :func:`ellipse`, wider than those of a case."""


@lru_cache(maxsize=64)
def ellipse(radius_ratio: float) -> Ellipse:
    """Return the ellipse of R_x/R_y = `radius_ratio` [-]; a circle where it is 1.

    Hertz 1881, in Carlson's form of the elliptic integrals: D = R_D(0, 1, kappa^2)/R_D(0, kappa^2,
    1), and k_b = 3/(2 pi kappa R_D(0, kappa^2, 1)).

    Raises
    ------
    InputError
        For a ratio that is not positive, or outside 1e-6 ... 1e6.

    Examples
    --------
    >>> from pyehl.theory.ellipse import ellipse
    >>> round(ellipse(0.35177164).ellipticity, 6)
    2.0
    """
    ratio = positive("radius_ratio", radius_ratio, "-")
    if ratio == 1.0:
        return Ellipse(1.0, 1.0, 1.0)
    if not RATIOS[0] <= ratio <= RATIOS[1]:
        raise InputError(f"radius_ratio must be 1e-6 ... 1e6 [-], not {ratio!r}")
    from scipy.optimize import brentq  # noqa: PLC0415 (takes as long to load as all the rest)
    from scipy.special import elliprd  # noqa: PLC0415

    def miss(log_kappa: float) -> float:
        square = math.exp(2.0 * log_kappa)
        return math.log(elliprd(0.0, 1.0, square) / elliprd(0.0, square, 1.0) / ratio)

    # kappa is within a factor of 4 of D^(-2/3) for these ratios
    middle = -2.0 / 3.0 * math.log(ratio)
    kappa = math.exp(brentq(miss, middle - math.log(4.0), middle + math.log(4.0), xtol=1e-15))
    factor = 1.5 / (math.pi * kappa * float(elliprd(0.0, kappa**2, 1.0)))
    return Ellipse(ratio, kappa, factor * math.pi**2 / 2.0)
