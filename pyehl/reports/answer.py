# SPDX-License-Identifier: BSD-3-Clause
"""The answer of a result in rows with errors, and a judgement of it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from pyehl.display import with_error
from pyehl.reports.limits import unheated

__all__ = ["WELL_KNOWN", "Judgement", "answer", "judge"]

Summary = Mapping[str, Any]

# A result whose error is a larger share of it is to be taken with care
WELL_KNOWN = 0.05
NM = 1e9


class Judgement(NamedTuple):
    """What a result is worth: a word, why, and 'pass', 'care' or 'fail'."""

    word: str
    why: str
    kind: str


def answer(summary: Summary) -> dict[str, str]:
    """Give names and values of what was found; nothing where there is no answer."""
    if not _has_answer(summary):
        return {}
    if summary["kind"] == "prediction":
        return _predicted(summary)
    return _solved(summary)


def _has_answer(summary: Summary) -> bool:
    return summary["status"] in ("converged", "predicted")


def _solved(s: Summary) -> dict[str, str]:
    scale = s.get("film_scale_m")
    found = {}
    for name, small, words in (("H_c", "h_c", "central film"), ("H_min", "h_min", "minimum film")):
        text = f"{name} = {with_error(s[name], s.get(f'{name}_error'))}"
        if s.get(f"{small}_m") is not None and scale is not None:
            error = s.get(f"{name}_error")
            error = None if error is None else error * scale * NM
            text = f"{small} = {with_error(s[f'{small}_m'] * NM, error, 'nm')}; {text}"
        limit = s.get(f"{name}_extrapolated")
        if limit is not None:
            text += f"; extrapolated to fine grids {with_error(limit)}"
        found[words] = text
    found["largest pressure"] = f"{with_error(s['P_max'], s.get('P_max_error'))} p_h"
    if s.get("p_max_Pa") is not None:
        found["largest pressure"] += f", {s['p_max_Pa'] * 1e-9:.4g} GPa"
    if s.get("mu_ratio") is not None:
        found["μ_r/μ_s"] = _ratio(s, "mu_ratio_error")
    _rough_film(s, found)
    _friction(s, found)
    found["grid"] = f"{s['points']} nodes along X; errors from {s.get('error_estimate', 'none')}"
    return found


def _predicted(s: Summary) -> dict[str, str]:
    found = {"μ_r/μ_s": _ratio(s, "mu_ratio_model_error")}
    found["over the tracks"] = (
        f"{with_error(s['mu_ratio_tracks'], s['mu_ratio_tracks_spread'])} "
        f"(spread of {s['tracks']} tracks)"
    )
    found["central film, smooth"] = f"{s['h_c_m'] * NM:.4g} nm, {s['h_c_source']}"
    if s.get("h_min_m") is not None:
        found["minimum film, smooth"] = f"{s['h_min_m'] * NM:.4g} nm"
    _rough_film(s, found)
    _friction(s, found)
    found["rms height"] = (
        f"{s['rms_height_m'] * NM:.4g} nm, in the contact {s['rms_deformed_m'] * NM:.4g} nm"
    )
    return found


def _ratio(s: Summary, error: str) -> str:
    text = with_error(s["mu_ratio"], s.get(error))
    if s.get("mu_ratio_min") is not None:
        text += f", between {s['mu_ratio_min']:.4g} and {s['mu_ratio_max']:.4g} over the passage"
    return text


def _rough_film(s: Summary, found: dict[str, str]) -> None:
    if s.get("h_min_rough_m") is not None:
        found["least film, rough"] = f"{s['h_min_rough_m'] * NM:.4g} nm"
    elif s.get("H_min_rough") is not None:
        found["least film, rough"] = f"H = {s['H_min_rough']:.4g}"
    if s.get("lambda_ratio") is not None:
        found["film ratio Λ = h_min/σ"] = f"{s['lambda_ratio']:.4g}"


def _friction(s: Summary, found: dict[str, str]) -> None:
    if s.get("mu") is not None:
        found["coefficient of friction"] = f"{s['mu']:.4g}; smooth {s['mu_smooth']:.4g}"
    elif s.get("mu_smooth") is not None:
        found["coefficient of friction"] = f"smooth {s['mu_smooth']:.4g}"


def judge(summary: Summary) -> Judgement:
    """Judge a result by its status, its errors and its range."""
    status = summary["status"]
    if not _has_answer(summary):
        why = f": {summary['message']}" if summary.get("message") else ""
        carries = (summary.get("film_breakdown") or {}) if status == "film breakdown" else {}
        hint = " What would carry stands below." if carries else ""
        return Judgement(
            "No answer", f"The status is '{status}'{why}. No number is a result.{hint}", "fail"
        )
    known: list[str] = []
    doubts: list[str] = []
    names = {"H_c": "H_c_error", "H_min": "H_min_error", "mu_ratio": "mu_ratio_error"}
    if summary["kind"] == "prediction":
        names = {"mu_ratio": "mu_ratio_model_error"}
    for name, error_name in names.items():
        value, error = summary.get(name), summary.get(error_name)
        if value is None:
            continue
        word = "μ_r/μ_s" if name == "mu_ratio" else name
        if error is None:
            doubts.append(f"the error of {word} is not known")
            continue
        share = error / abs(value)
        (known if share <= WELL_KNOWN else doubts).append(
            f"{word} is known to {100.0 * share:.2g} %"
        )
    outside = summary.get("outside_range")
    if outside:
        doubts.append(f"{', '.join(outside)} outside of the range of the response")
    heat = unheated(summary)
    if heat is not None:
        doubts.append(f"the flash temperature is {heat:.3g} K")
    first = f"The status is '{status}'; {', '.join(known)}" if known else f"The status is {status}"
    if doubts:
        advice = f" Above {100.0 * WELL_KNOWN:g} % a finer grid is worth its time."
        graded = any("known to" in text for text in doubts)
        return Judgement(
            "Take with care",
            f"{first}. But {'; '.join(doubts)}.{advice if graded else ''}",
            "care",
        )
    return Judgement("Holds", f"{first}.", "pass")
