# SPDX-License-Identifier: BSD-3-Clause
"""How far a prediction can be trusted."""

import math
from collections.abc import Sequence

from pyehl.prediction.bands import Band
from pyehl.prediction.options import ModelOptions
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.response import fitted_range

# Error of mu_r/mu_s against the full simulation: a part that small waves and tracks make at any
# ratio, and a part that grows with the rise. Measured in docs/evidence/prediction.
CONSTANT = 0.01
SHARE_OF_RISE = 0.07
# The same where the flow obeys a shear law, which hardly lets the friction rise
# (docs/evidence/thinning)
CONSTANT_THINNING = 0.004
SHARE_THINNING = 0.1
# What is added where the contact is narrower than long, times that by which a/b exceeds 1
# (docs/evidence/ellipse)
NARROW = 0.025
# Largest ratio at which it was measured
KNOWN_RATIO = 5.0
# Ellipticities between which it was
ELLIPTICITY = [0.39, 4.1]
# Velocity ratios between which waves were (docs/evidence/response/slip.csv)
VELOCITY_RATIO = [0.5, 1.5]
# Of the viscosity, by the film of lubricants that thin in the inlet (docs/evidence/thinning)
THINNING = [0.95, 1.5]


def model_error(mu_ratio: float, *, thins: bool = False, ellipticity: float = 1.0) -> float:
    """Error of a predicted mu_r/mu_s [-]; NaN beyond the largest ratio that was measured.

    It covers the deviation from the full simulation of this package on 513 x 513 nodes in at least
    nine of ten cases of docs/evidence/prediction; `thins`, where the flow obeys a shear law, on 257
    x 257 nodes of docs/evidence/thinning.
    """
    if not mu_ratio <= KNOWN_RATIO:
        return math.nan
    constant, share = CONSTANT, SHARE_OF_RISE
    if thins:
        constant, share = CONSTANT_THINNING, SHARE_THINNING
    return constant + share * abs(mu_ratio - 1.0) + NARROW * max(0.0, 1.0 / ellipticity - 1.0)


def why_no_error(
    mu_ratio: float, outside: Sequence[str], options: ModelOptions, *, friction_alone_thins: bool
) -> str:
    """Say why `model_error` is not known of a prediction; '' where it is.

    `outside`: what lies outside of the range of the response; `friction_alone_thins`: a shear law
    holds for the friction and not for the flow.
    """
    if not math.isfinite(mu_ratio):
        return "there is no mu_ratio"
    if outside:
        return f"outside the range of the response by {', '.join(outside)}"
    if not options.measured:
        return "psd.reduction and psd.smooth are not those that it was measured with"
    if friction_alone_thins:
        return "with a shear law it was measured with lubricant.flow = 'consistent'"
    if mu_ratio > KNOWN_RATIO:
        return f"it was measured up to mu_r/mu_s = {KNOWN_RATIO:g}"
    return ""


def cutoff_error(bands: Sequence[Band]) -> float:
    """Return what the last octave of wavelengths adds to mu_r/mu_s [-], by its modulus.

    This much hangs on the cut-off: a measure of what waves shorter than those of the map would
    add. NaN without bands.
    """
    return abs(bands[-1].increase) if bands else math.nan


def outside_range(
    operating: OperatingPoint, velocity_ratio: float, options: ModelOptions, thinning: float = 1.0
) -> list[str]:
    """Names of the numbers that lie outside the range in which the response was measured.

    `moes_m` and `moes_l` of an elliptical contact are those of the circle with the same dry inlet.
    `thinning`: viscosity at low shear over that of a Newtonian lubricant with as thick a film.
    """
    if options.reduction != "response":
        return []
    moes_m, moes_l = operating.equivalent_moes
    values = {
        "moes_m": moes_m,
        "moes_l": moes_l,
        "velocity_ratio": velocity_ratio,
        "ellipticity": operating.ellipse.ellipticity,
        "thinning": thinning,
    }
    limits = fitted_range() | {
        "velocity_ratio": VELOCITY_RATIO,
        "ellipticity": ELLIPTICITY,
        "thinning": THINNING,
    }
    return [name for name, v in values.items() if not limits[name][0] <= v <= limits[name][1]]
