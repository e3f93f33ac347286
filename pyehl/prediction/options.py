# SPDX-License-Identifier: BSD-3-Clause
"""How the model is read, where it holds, and how far it is from the full simulation there."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields

from pyehl.surfaces import FEATURES, rough_groups
from pyehl.theory.operating import NO_LINE, OperatingPoint
from pyehl.theory.response import fitted_range
from pyehl.types import Settings

FIRST_POSITIONS = 8
"""Fewest positions of a tile in a passage, and those of a mean over a few."""
MAX_POSITIONS = 4096
"""Most positions of a passage, as the schema of cases has it."""


def unpredictable(settings: Settings) -> str:
    """Say why nothing is predicted of a resolved case; '' where something is."""
    if turned(settings):
        return turned(settings)
    groups = rough_groups(settings)
    if not groups:
        return "surface.kind = 'smooth': a prediction needs a rough surface"
    for group in groups:
        kind = str(settings[group]["kind"])
        if kind in FEATURES:
            return (
                f"{group}.kind = {kind!r}: a single feature passes once. A prediction is the mean "
                "friction of roughness that fills the contact\nexpected: 'pyehl run', or "
                f"{group}.kind = 'harmonic', 'map' or 'fractal'"
            )
    return ""


def turned(settings: Settings) -> str:
    """Say why a line or an ellipse has no response; '' where an axis lies along the motion."""
    contact = settings["contact"]
    if contact.get("shape") == "line":
        return NO_LINE
    angle = float(contact["angle"])
    if angle == 0.0 or OperatingPoint.from_settings(settings).radius_ratio == 1.0:
        return ""
    return (
        f"contact.angle = {angle:g}: the response of an elliptical contact is known where an axis "
        "lies along the motion. What is missing: an inlet that is oblique on the centre line\n"
        "expected: contact.angle = 0 (at 90 degrees with the radii exchanged), or 'pyehl run'"
    )


@dataclass(frozen=True, slots=True)
class ModelOptions:
    """How the model is read: the group ``psd`` of a case, whose schema has the allowed words."""

    # What is left of a wave in the contact: ``"response"``, the complex response of
    # :mod:`pyehl.theory.response`, or ``"amplitude"``, the real ratio of the paper
    reduction: str = "response"
    # Pressure and film under the roughness: ``"solved"``, of the smooth contact, or ``"hertz"``,
    # semi-ellipse and uniform film, as in the paper
    smooth: str = "solved"
    wavelength_convention: str = "components"  # one of :data:`pyehl.theory.amplitude.CONVENTIONS`
    stiffness: str = "exact"  # ``"exact"``: E'|q|/4; ``"paper"``: eq. 11 with wavelength 2 pi/|q|
    # Whether the semi-ellipse gives up the load that delta p carries inside the contact: a Hertz
    # contact under the remaining load, p_h and a scaled by its cube root
    load_balance: bool = False
    # Film below which the share of the contact is reported [m]; 0: none
    film_limit: float = 0.0
    # Positions of the surface over one passage; 0: doubled until mu_r/mu_s is resolved
    positions: int = 0

    @property
    def as_in_paper(self) -> bool:
        """Whether both the reduction and the smooth contact are those of the paper."""
        return self.reduction == "amplitude" and self.smooth == "hertz"

    @property
    def measured(self) -> bool:
        """Whether the errors of the model were measured of it read so."""
        return self.reduction == "response" and self.smooth == "solved"

    @classmethod
    def from_settings(cls, settings: Settings) -> ModelOptions:
        """From the group ``psd`` of a resolved case."""
        group = settings["psd"]
        return cls(**{field.name: group[field.name] for field in fields(cls)})


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
