# SPDX-License-Identifier: BSD-3-Clause
"""How the model is read: conventions, stiffness, positions."""

from __future__ import annotations

from dataclasses import dataclass, fields

from pyehl.surfaces import FEATURES, rough_groups
from pyehl.theory.operating import OperatingPoint
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
    """Say why an elliptical contact has no response; '' where an axis lies along the motion."""
    contact = settings["contact"]
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
