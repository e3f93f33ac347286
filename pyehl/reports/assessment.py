# SPDX-License-Identifier: BSD-3-Clause
"""The numbers of a result with their errors, and an assessment of it."""

from typing import NamedTuple

from pyehl.conclusion import conclude
from pyehl.display import with_error
from pyehl.types import Values

# Relative error above which a result is assessed as 'with care'
WELL_KNOWN = 0.05
NM = 1e9
KINDS = {"holds": "pass", "with care": "care", "no result": "fail"}
SIGNS = {"mu_r/mu_s": "μ_r/μ_s", "Lambda": "Λ", "+-": "±", "sigma": "σ", "mu ": "μ "}
WORDS = {
    "H_c": "central film",
    "h_c": "central film",
    "H_min": "minimum film",
    "h_min": "minimum film",
    "p_max": "maximum pressure",
    "p_h": "Hertz pressure",
    "Lambda": "film ratio Λ",
    "mu_r/mu_s": "μ_r/μ_s",
    "mu": "coefficient of friction",
    "heat": "temperature increase",
}


class Assessment(NamedTuple):
    """An assessment of a result: a term, its reason, and 'pass', 'care' or 'fail'."""

    word: str
    why: str
    kind: str


def numbers_of(summary: Values) -> dict[str, str]:
    """Give names and values of the results, empty if there is none."""
    conclusion = conclude(summary)
    if conclusion.confidence == "no result":
        return {}
    result = {
        WORDS[name]: f"{name} = {_signs(text)}" if name in ("H_c", "H_min") else _signs(text)
        for name, text in conclusion.lines.items()
        if name in WORDS
    }
    if summary.get("mu_ratio_min") is not None:
        low, high = summary["mu_ratio_min"], summary["mu_ratio_max"]
        result["μ_r/μ_s"] += f"; between {low:.4g} and {high:.4g} over the passage"
    return result | (_predicted(summary) if summary["kind"] == "prediction" else _solved(summary))


def _signs(text: str) -> str:
    for plain, sign in SIGNS.items():
        text = text.replace(plain, sign)
    return text


def _solved(s: Values) -> dict[str, str]:
    limits = [
        f"{name} = {with_error(s[f'{name}_extrapolated'])}"
        for name in ("H_c", "H_min")
        if s.get(f"{name}_extrapolated") is not None
    ]
    result = {"extrapolated to fine grids": ", ".join(limits)} if limits else {}
    grid = f"{s['points']} nodes along X; errors from {s.get('error_estimate', 'none')}"
    return result | {"grid": grid}


def _predicted(s: Values) -> dict[str, str]:
    heights = f"{s['rms_height_m'] * NM:.4g} nm, in the contact {s['rms_deformed_m'] * NM:.4g} nm"
    return {
        "smooth contact": str(s["h_c_source"]),
        "rms height": heights,
    }


def assess(summary: Values) -> Assessment:
    """Assess a result as the last of its printed lines does."""
    conclusion = conclude(summary)
    word, _, why = _signs(conclusion.assessment).partition(": ")
    hint = ""
    if summary.get("film_breakdown"):
        hint = " No number is a result. Remedies for a full film are listed below."
    return Assessment(
        word.capitalize(),
        f"{why[:1].upper()}{why[1:]}.{hint}",
        KINDS[conclusion.confidence],
    )
