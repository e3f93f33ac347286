# SPDX-License-Identifier: BSD-3-Clause
"""Life modification factor of rolling bearings by the film ratio, for comparison."""

from __future__ import annotations

import math

from pyehl.errors import InputError

BEARINGS = ("ball", "roller")
# Range of the viscosity ratio in which the factor has formulas, and its largest value
KAPPA_MIN, KAPPA_MAX, LARGEST = 0.1, 4.0, 50.0
# Radial bearings, ISO 281:2007, 9.3.3.3: constants by the upper end of kappa: A, B and exponent of
# A - B/kappa^n; then the exponents of the bracket and of the contamination term
_BALL = (
    (0.4, 2.5671, 2.2649, 0.054381),
    (1.0, 2.5671, 1.9987, 0.19087),
    (4.0, 2.5671, 1.9987, 0.071739),
)
_ROLLER = (
    (0.4, 1.5859, 1.3993, 0.054381),
    (1.0, 1.5859, 1.2348, 0.19087),
    (4.0, 1.5859, 1.2348, 0.071739),
)
_EXPONENTS = {"ball": (0.83, 1.0 / 3.0, -9.3), "roller": (1.0, 0.4, -9.185)}


def kappa(lambda_ratio: float) -> float:
    """Viscosity ratio kappa [-] of a film ratio Lambda: Lambda^1.3 (ISO/TR 1281-2)."""
    return lambda_ratio**1.3


def a_iso(kappa: float, contamination: float, bearing: str) -> float:
    """Life modification factor a_ISO [-] of a radial bearing.

    Parameters
    ----------
    kappa
        Viscosity ratio [-], `KAPPA_MIN` to `KAPPA_MAX`; above it counts as `KAPPA_MAX`.
    contamination
        e_C C_u/P: contamination factor times fatigue load limit over equivalent load [-].
    bearing
        One of `BEARINGS`.

    Returns
    -------
    float
        At most 50, as the standard says. NaN below `KAPPA_MIN`, where it gives none.

    Raises
    ------
    InputError
        For another bearing, or a contamination term that is not positive.
    """
    if bearing not in BEARINGS:
        raise InputError(f"bearing = {bearing!r}: expected one of {', '.join(BEARINGS)}")
    if not (math.isfinite(contamination) and 0.0 < contamination <= 5.0):
        raise InputError(f"contamination = {contamination!r}: expected e_C C_u/P, 0 ... 5 [-]")
    if not kappa >= KAPPA_MIN:
        return math.nan
    within = min(kappa, KAPPA_MAX)
    table = _BALL if bearing == "ball" else _ROLLER
    first, second, last = _EXPONENTS[bearing]
    _, a, b, n = next(row for row in table if within <= row[0])
    bracket = 1.0 - (a - b / within**n) ** first * contamination**second
    return min(LARGEST, 0.1 * bracket**last) if bracket > 0.0 else LARGEST
