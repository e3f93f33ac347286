# SPDX-License-Identifier: BSD-3-Clause
"""Assessment of a solution or a prediction: one line, from its summary."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from pyehl.number_text import fixed, percent, rounded

HOLDS, WITH_CARE, NO_RESULT = "holds", "with care", "no result"
# Pressure [Pa] above which a ball leaves a permanent indentation of 1e-4 of its diameter in
# bearing steel (ISO 76:2006); the solids of the model are elastic
YIELDS = 4.2e9
# Film [m] as thin as additive films on steel and as roughness below the resolution of a scan
MOLECULAR = 10e-9
# Lambda ratio below which asperities touch, and above which they do not (Tallian 1967)
TOUCHING, NOT_TOUCHING = 1.0, 3.0
# Relative error above which a result is assessed as 'with care'
WELL_KNOWN = 0.05
# Correlation above which two surfaces are not independent
ALIKE = 0.5
# Status of a prediction with a known film and with pressures outside the model
BEYOND = "beyond linear response"
RESULTS = ("converged", "predicted", "target missed", BEYOND)
# Flash temperature rise [K] above which neglected heating is remarked on
HOT = 10.0
# Contact radius and film over the radius of curvature above which the limits of the theory are
# remarked on, and mean strain over the former (Tabor 1951)
SLENDER_CONTACT, SLENDER_FILM, MEAN_STRAIN = 0.1, 0.01, 0.2
# Fraction of the flow that the boundary film may supply (as fortran/reynolds/touching.f90)
MUCH_MASS_DEFECT = 0.1
# Beginning of the note that the bodies touch because the grid is too coarse
NO_INLET = "the grid does not resolve the inlet"


@dataclass(frozen=True, slots=True)
class Assessment:
    """Assessment of a result.

    Attributes
    ----------
    text
        'no result', 'film breakdown', 'beyond the solids', 'unresolved inlet', 'mixed film',
        'yielding solids', 'thin film', 'unresolved waves' or 'full film', the reason, and further
        remarks.
    confidence
        'holds', 'with care' or 'no result'.
    """

    text: str
    confidence: str


class Summary:
    """Typed access to a summary: NaN for a missing number, '' for a missing text."""

    def __init__(self, values: Mapping[str, Any]) -> None:
        self.values = values

    def number(self, name: str) -> float:
        """Give a number; NaN where it is not known."""
        value = self.values.get(name)
        if isinstance(value, bool) or not isinstance(value, int | float):
            return math.nan
        return float(value)

    def text(self, name: str) -> str:
        """Give a text in one line, a list with commas; '' if it is missing."""
        value = self.values.get(name)
        if isinstance(value, list) and all(isinstance(word, str) for word in value):
            return ", ".join(value)
        return " ".join(value.split()) if isinstance(value, str) else ""

    def has(self, name: str) -> bool:
        """Whether there is such a quantity, known or not."""
        return name in self.values

    def known(self, name: str) -> bool:
        """Whether a number is known."""
        return math.isfinite(self.number(name))


def assess(values: Mapping[str, Any]) -> Assessment:
    """Assess a solution or a prediction from its summary."""
    s = Summary(values)
    status, message = s.text("status"), s.text("message")
    # with H_c known, the smooth contact was solved and the rough one failed
    if status == "film breakdown" or (status == "negative film" and s.known("H_c")):
        return Assessment(f"film breakdown: {message}".rstrip(), NO_RESULT)
    if status not in RESULTS:
        why = f": {message}" if message else ""
        return Assessment(f"no result: the status is '{status}'{why}", NO_RESULT)
    doubts = [*_pressure(s), *_contact(s), *_yielding(s), *_waves(s)]
    more = [*_errors(s), *_heat(s), *_two_alike(s), *_slenderness(s)]
    if s.text("surface_findings"):
        more.append(f"the map is not roughness alone: {s.text('surface_findings')}")
    if status == "target missed":
        more.insert(0, "grid.target_error is missed")
    if status == BEYOND:
        more.insert(0, f"mu_r/mu_s is not known: {message}")
    text = "; ".join(doubts) or f"full film: {_minimum_film(s)}"
    text += _starvation(s)
    confidence = WITH_CARE if doubts or more else HOLDS
    return Assessment(f"{text}; but {'; '.join(more)}" if more else text, confidence)


def _pressure(s: Summary) -> list[str]:
    """Report a pressure at which the solids would yield."""
    if s.has("load_share_at_hardness"):
        return []
    rough = s.number("p_max_rough_Pa")
    pressure = rough if _finite_above(rough, 0.0) else s.number("p_max_Pa")
    if not _finite_above(pressure, YIELDS):
        return []
    return [
        f"beyond the solids: the pressure reaches {rounded(pressure * 1e-9)} GPa, bearing steel "
        f"yields above {rounded(YIELDS * 1e-9, 2)} GPa (ISO 76), and the solids of the model do not"
    ]


def _contact(s: Summary) -> list[str]:
    """Report solid contact, an unresolved inlet, or a thin film."""
    share = s.number("contact_load_share")
    if not _finite_above(share, 0.0):
        note = s.text("H_c_error_note")
        return [f"unresolved inlet: {note}"] if note.startswith(NO_INLET) else _film(s)
    error, supply = s.number("contact_load_share_error"), s.number("mass_defect")
    known = f"an error of {percent(error)} of the load" if math.isfinite(error) else ""
    result = [
        f"mixed film: {percent(share)} of the load is sustained by the boundary film, with "
        f"{known or 'an error that is not known'}"
    ]
    if _finite_above(supply, MUCH_MASS_DEFECT):
        result.append(
            f"the boundary film would have to supply {percent(supply)} of the flow, where the "
            "model ends"
        )
    return result


def _yielding(s: Summary) -> list[str]:
    """Report the load that is sustained at the hardness."""
    share = s.number("load_share_at_hardness")
    if not _finite_above(share, 0.0):
        return []
    return [
        f"yielding solids: {percent(share)} of the load is sustained at their hardness, with a "
        f"plastic depth of up to {rounded(s.number('plastic_depth_max_m') * 1e9)} nm, "
        "as in a first pass"
    ]


def _film(s: Summary) -> list[str]:
    """Report a film that is thin relative to molecules or to the roughness."""
    ratio = s.number("lambda_ratio")
    if _finite_above(MOLECULAR, _h_min(s)):
        return [
            f"thin film: {_minimum_film(s)}, below {rounded(MOLECULAR * 1e9, 2)} nm, where "
            "additives and roughness finer than a scan matter, and asperities may touch"
        ]
    if _finite_above(TOUCHING, ratio):
        return [
            f"thin film: Lambda = {rounded(ratio)} is below {rounded(TOUCHING, 1)} for the "
            f"undeformed roughness; {_minimum_film(s)}"
        ]
    return []


def _waves(s: Summary) -> list[str]:
    """Report waves that the grid does not resolve."""
    if not s.has("mu_ratio_unresolved"):
        return []
    predicted = abs(s.number("mu_ratio_unresolved"))
    fraction, what = predicted / s.number("mu_ratio"), "mu_r/mu_s by prediction"
    if not math.isfinite(predicted):
        fraction, what = s.number("variance_unresolved"), "the variance of the surface"
    if not _finite_above(fraction, WELL_KNOWN):
        return []
    return [f"unresolved waves: they hold {percent(fraction)} of {what}, use a larger grid.points"]


def _starvation(s: Summary) -> str:
    """Report the starvation of the solution and that of a formula."""
    ratio = s.number("starvation")
    if not math.isfinite(ratio):
        return ""
    text = f"; starved as in the case: H_c is {percent(ratio)} of the flooded film by formula"
    if s.known("starvation_by_formula"):
        name = "Hamrock & Dowson IV" if s.known("inlet_position") else "Chevalier et al."
        if s.text("shape") == "line":
            name = "conservation of mass"
        text += f" ({percent(s.number('starvation_by_formula'))} by {name})"
    return text


def _errors(s: Summary) -> list[str]:
    """Report errors that are large or unknown, and a contact outside the range of a model."""
    result = []
    for name in ("H_c", "H_min", "mu_ratio"):
        value = s.number(name)
        if not math.isfinite(value):
            continue
        model = f"{name}_model_error"
        relative = s.number(model if s.has(model) else f"{name}_error") / abs(value or math.nan)
        word = "mu_r/mu_s" if name == "mu_ratio" else name
        if not math.isfinite(relative):
            result.append(f"the error of {word} is not known")
        elif relative > WELL_KNOWN:
            result.append(f"{word} is uncertain by {percent(relative)}")
    note = s.text("pressure_viscosity_note")
    if "estimate" in note:
        result.append("alpha is an estimate (-17 to +12 % of the film)")
    elif note:
        result.append("alpha is that of another oil")
    if s.text("outside_range"):
        result.append(f"{s.text('outside_range')} outside of the range of the response")
    return result


def _heat(s: Summary) -> list[str]:
    """Report heating that the model neglects."""
    rise = s.number("flash_temperature_K")
    if not _finite_above(rise, HOT) or s.known("temperature_rise_max_K"):
        return []
    return [f"the flash temperature rise is {rounded(rise)} K, which the model neglects in the oil"]


def _two_alike(s: Summary) -> list[str]:
    """Report two surfaces that move together and are correlated."""
    correlation = s.number("surface_correlation")
    if not _finite_above(abs(correlation), ALIKE):
        return []
    return [
        f"the two surfaces move together and are alike (correlation {fixed(correlation, 2)}), so "
        "that their waves add up"
    ]


def _slenderness(s: Summary) -> list[str]:
    """Report a contact radius or a film that is not small against the radius of curvature.

    The half-space, the parabolic gap and the Reynolds equation assume that both are small. The
    mean strain of a dry contact is about 0.2 a/R (Tabor 1951). Hertz: p_h/E' is a/(pi R) of a
    circle, and b/(4 R) of a line.
    """
    radius = s.number("hertz_radius_m") or math.nan
    wide = s.number("film_scale_m") / radius
    thick = s.number("h_c_m") / radius * wide
    ellipse = s.has("ellipticity")
    if ellipse:
        across = wide * s.number("ellipticity") * s.number("radius_ratio")
        wide = across if across > wide or not math.isfinite(wide) else wide
    result = []
    if _finite_above(wide, SLENDER_CONTACT):
        line = s.text("shape") in ("line", "roller")
        size = "half width of the contact" if line else "contact radius"
        ratio = wide / (4.0 if line else math.pi)
        strain = "" if ellipse else f" (p_h/E' = {rounded(ratio, 2)})"
        result.append(
            f"the {size} is {rounded(wide, 2)} of the radius of curvature{strain}, a "
            f"strain of about {percent(MEAN_STRAIN * wide)}, and the half-space model holds for "
            "small strains"
        )
    if _finite_above(thick, SLENDER_FILM):
        result.append(
            f"the film is {rounded(thick, 2)} of the radius, and the Reynolds equation holds for "
            "slender gaps"
        )
    return result


def _minimum_film(s: Summary) -> str:
    """Give the minimum film as text."""
    film, ratio = _h_min(s), s.number("lambda_ratio")
    if s.known("h_min_rough_m"):
        return f"the minimum film over the roughness is {rounded(film * 1e9)} nm"
    if math.isfinite(film):
        text = f"the minimum film is {rounded(film * 1e9)} nm"
        if s.has("lambda_ratio"):
            return text
        rms = rounded(film / NOT_TOUCHING * 1e9)
        return f"{text}: Lambda = {rounded(NOT_TOUCHING, 1)} with an rms roughness of {rms} nm"
    if math.isfinite(ratio):
        return f"Lambda = {rounded(ratio)}"
    return "smooth surfaces; the case gives no size in metres"


def _h_min(s: Summary) -> float:
    """Give the minimum film [m], that over the roughness if it is known."""
    return s.number("h_min_rough_m" if s.known("h_min_rough_m") else "h_min_m")


def _finite_above(a: float, b: float) -> bool:
    """Whether both are finite and a > b."""
    return math.isfinite(a) and math.isfinite(b) and a > b
