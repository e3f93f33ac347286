# SPDX-License-Identifier: BSD-3-Clause
"""The last lines of a run or a prediction, from its summary."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from pyehl.assessment import Summary, assess
from pyehl.number_text import fixed, with_error

NM, GPA = 1e9, 1e-9


@dataclass(frozen=True, slots=True)
class Conclusion:
    """The last lines of a solution or a prediction.

    Attributes
    ----------
    lines
        Results by name, then the assessment.
    assessment
        A term and its reason.
    confidence
        'holds', 'with care' or 'no result'.
    """

    lines: Mapping[str, str]
    assessment: str
    confidence: str

    def __str__(self) -> str:
        """Give the lines as ``pyehl run`` prints them."""
        return "\n".join(f"{name:11}{text}" for name, text in self.lines.items())


def conclude(values: Mapping[str, Any]) -> Conclusion:
    """Give the last lines of a solution or a prediction from its summary, and assess it.

    Films and pressure with their errors, in nm and GPa where the case has a size, friction, heat,
    and how reliable they are.
    """
    s = Summary(values)
    result = assess(values)
    parts = (
        _film(s, "c", ""), _film(s, "min", _rough_film(s)), _pressure(s), _film_ratio(s),
        _friction_ratio(s), _friction(s), _heat(s),
    )  # fmt: skip
    lines = {name: text for part in parts for name, text in part.items()}
    return Conclusion(lines | {"assessment": result.text}, result.text, result.confidence)


RESUMPTION = {
    "interrupted": "to resume",
    "failed": "to resume",
    "not settled": "to continue with a larger time.max_periods or time.steps (--set)",
    "cycle limit": "to continue with a larger solver.max_cycles (--set)",
}


def resumption(status: str, results: str) -> str:
    """Say how to resume a run with this status; '' if it would end the same way."""
    purpose = RESUMPTION.get(status)
    return f"{purpose}: pyehl run --resume {results}" if purpose else ""


def _of(s: Summary, source: str, error: str) -> str:
    """Name the source of the error of a value; '' if the error is not known."""
    return f" ({source})" if s.known(error) else ""


def _film(s: Summary, which: str, more: str) -> dict[str, str]:
    """Central ('c') or minimum ('min') film."""
    metres, units = "", f"h_{which}"
    if s.known(f"h_{which}_m"):
        film, error = s.number(f"h_{which}_m"), s.number(f"h_{which}_error_m")
        metres = with_error(film * NM, error * NM, 2, " nm")
    if s.known(f"H_{which}"):
        name = f"H_{which}"
        text = with_error(s.number(name), s.number(f"{name}_error"), 6, "")
        text += f", {units} {metres}" if metres else ""
        a_priori = s.text("error_estimate") == "a priori"
        text += " (grid, a priori)" if a_priori else _of(s, "grid", f"{name}_error")
        return {name: text + more}
    if not metres:
        return {}
    return {units: f"{metres}{_of(s, 'grid', f'h_{which}_error_m')}, smooth contact{more}"}


def _rough_film(s: Summary) -> str:
    """Minimum film of the rough contact, if it is known."""
    film, error = s.number("h_min_rough_m") * NM, s.number("h_min_rough_error_m") * NM
    if s.known("h_min_rough_m") and s.known("h_min_rough_error_m"):
        return f"; rough {with_error(film, error, 2, ' nm')} (model)"
    if s.known("h_min_rough_m"):
        return f"; rough {fixed(film, 2)} nm"
    return f"; rough {fixed(s.number('H_min_rough'), 6)}" if s.known("H_min_rough") else ""


def _giga(s: Summary, name: str) -> str:
    return f"{fixed(s.number(name) * GPA, 4)} GPa"


def _pressure(s: Summary) -> dict[str, str]:
    """Maximum pressures of the smooth and the rough contact."""
    name, text = "p_max", ""
    in_pa = f"; rough {_giga(s, 'p_max_rough_Pa')}" if s.known("p_max_rough_Pa") else ""
    if s.known("P_max"):
        text = with_error(s.number("P_max"), s.number("P_max_error"), 4, " p_h")
        text += _of(s, "grid", "P_max_error")
        text += f", {_giga(s, 'p_max_Pa')}" if s.known("p_max_Pa") else ""
        units = f"; rough {fixed(s.number('P_max_rough'), 4)} p_h" if s.known("P_max_rough") else ""
        text += in_pa or units
    elif s.known("p_max_Pa"):
        text = _giga(s, "p_max_Pa") + in_pa
    elif s.known("h_c_m"):
        name, text = "p_h", _giga(s, "hertz_pressure_Pa")
    # of a prediction
    if s.known("p_rise_max_Pa"):
        rise, error = s.number("p_rise_max_Pa"), s.number("p_rise_max_error_Pa")
        alone = s.known("p_max_Pa") and not s.known("p_max_rough_Pa")
        text = f"{text or 'not known'}{'; rough ' if alone else ', up to '}"
        text += with_error(rise * GPA, error * GPA, 4, " GPa above the smooth contact")
        text += _of(s, "model", "p_rise_max_error_Pa")
    return {name: text} if text else {}


def _film_ratio(s: Summary) -> dict[str, str]:
    """Film over roughness."""
    if not s.known("lambda_ratio"):
        return {}
    text, central = fixed(s.number("lambda_ratio"), 3), s.number("lambda_ratio_central")
    text += f" (h_c/sigma {fixed(central, 3)})" if math.isfinite(central) else ""
    return {"Lambda": f"{text}, smooth films over undeformed roughness"}


def _friction_ratio(s: Summary) -> dict[str, str]:
    """Friction over that of the smooth contact, with its error or why that is not known.

    For a prediction, the mean over the tracks of the surface comes first.
    """
    if not s.known("mu_ratio"):
        return {}
    model = s.has("mu_ratio_model_error")
    error, source = ("mu_ratio_model_error", "model") if model else ("mu_ratio_error", "grid")
    text = with_error(s.number("mu_ratio"), s.number(error), 5, "") + _of(s, source, error)
    if s.known("mu_ratio_tracks") and s.number("tracks") > 1.0:
        mean, spread = s.number("mu_ratio_tracks"), s.number("mu_ratio_tracks_spread")
        text = (
            f"{with_error(mean, spread, 5, '', 3)} (mean and scatter over "
            f"{round(s.number('tracks'))} tracks); on the track of the case {text}"
        )
    note = s.text("mu_ratio_error_note")
    return {"mu_r/mu_s": f"{text}: {note}" if note else text}


def _friction(s: Summary) -> dict[str, str]:
    """Coefficient of friction with its shear law, or why there is none."""
    smooth = f"smooth contact {fixed(s.number('mu_smooth'), 5)}" if s.known("mu_smooth") else ""
    if s.known("mu"):
        text = fixed(s.number("mu"), 5) + (f", {smooth}" if s.has("mu_ratio") and smooth else "")
    elif smooth:
        text = smooth
    elif s.text("mu_note") and (s.known("H_c") or s.known("h_c_m")):
        return {"mu": f"not reported: {s.text('mu_note')}"}
    else:
        return {}
    return {"mu": f"{text}; law '{s.text('shear_law')}'"}


def _heat(s: Summary) -> dict[str, str]:
    """Temperature rises of film and surfaces."""
    film, surfaces = "temperature_rise_max_K", "flash_temperature_K"
    parts = [f"temperature rise of the film {fixed(s.number(film), 1)} K"] if s.known(film) else []
    if s.known(surfaces):
        parts.append(f"flash temperature rise {fixed(s.number(surfaces), 1)} K")
    return {"heat": ", ".join(parts)} if parts else {}
