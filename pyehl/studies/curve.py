# SPDX-License-Identifier: BSD-3-Clause
"""The table of a Stribeck curve, from the rows of its tasks.

theta_2 of Zhang et al. 2019, section 4.2, is defined for a pattern of one wavelength. Any other
surface is replaced by the pattern cos(2 pi x/wavelength) cos(2 pi y/wavelength) with the same rms
height (A_i = 2 sigma) and the same mean wavenumber, 2 sqrt(2) pi/wavelength; two rough surfaces are
replaced by one pattern with the power of both.
"""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from statistics import fmean
from typing import Any

import numpy as np
import pandas as pd
import scipy

from pyehl import surfaces
from pyehl.assessment import NO_INLET
from pyehl.case.line import TRANSVERSE
from pyehl.conclusion import Conclusion, conclude
from pyehl.contact.smooth import film_of
from pyehl.prediction.friction import BEYOND, NO_FRICTION
from pyehl.prediction.model import KNOWN_RATIO
from pyehl.prediction.summary import deformed_surfaces
from pyehl.reasons import OF_ROUGH
from pyehl.results import unit_of
from pyehl.studies.curve_plan import CurvePlan, CurvePoint
from pyehl.studies.tasks import FAILED, why_none
from pyehl.theory import stribeck
from pyehl.theory.friction import absolute_friction
from pyehl.theory.line_contact import AnyContact, contact_of, formula_film
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.transition import BREAKDOWN, FULL_FILM, MIXED, OUTSIDE, UNSOLVED, Curve
from pyehl.types import Settings, Values


@dataclass(frozen=True, slots=True)
class Pattern:
    """The pattern of one wavelength that replaces a surface: rms height and wavelength [m]."""

    rms_height: float
    wavelength: float


SMOOTH = Pattern(0.0, math.inf)


def pattern(settings: Settings, operating: AnyContact, film: float) -> Pattern:
    """Give the pattern for theta_2 of a resolved case with a rough surface.

    `film` is the central film [m], which may scale the amplitude of harmonic roughness.
    """
    if settings["surface"]["kind"] == "harmonic":
        lengths = [float(settings["surface"][f"wavelength_{axis}"]) for axis in "xy"]
        amplitude = surfaces.harmonic_amplitude(settings, operating, film)
        if operating.ellipse.is_line and lengths[1] >= TRANSVERSE:
            # one cosine instead of two
            root = math.sqrt(2.0)
            return Pattern(amplitude / root, root * lengths[0] * operating.hertz_radius)
        return Pattern(0.5 * amplitude, min(lengths) * operating.hertz_radius)
    tile = surfaces.from_settings(settings, operating, film)
    qx, qy = surfaces.wavenumbers(tile)
    power = np.abs(scipy.fft.rfft2(tile.heights)) ** 2
    power[0, 0] = 0.0
    # the other half of the spectrum has the same power
    last = -1 if tile.shape[1] % 2 == 0 else None
    power[:, 1:last] *= 2.0
    mean = float((np.hypot(qx, qy) * power).sum() / power.sum())
    return Pattern(tile.rms_height, 2.0 * math.sqrt(2.0) * math.pi / mean)


def cached_pattern(
    settings: Settings, operating: AnyContact, film: float, cache: dict[str, Pattern]
) -> Pattern:
    """Give the pattern of the rough surface of a case, or of both surfaces together.

    A surface that does not depend on the contact is generated once.
    """
    result = []
    for group in surfaces.rough_groups(settings):
        alone = {**settings, "surface": settings[group]}
        name = str(sorted(settings[group].items(), key=str))
        if settings[group]["kind"] == "harmonic" or name not in cache:
            cache[name] = pattern(alone, operating, film)
        result.append(cache[name])
    if len(result) == 1:
        return result[0]
    variance = sum(part.rms_height**2 for part in result)
    if not variance > 0.0:
        return SMOOTH
    # the mean wavenumber is weighted by the power of both
    number = sum(part.rms_height**2 / part.wavelength for part in result) / variance
    return Pattern(math.sqrt(variance), 1.0 / number)


_NUMBERS = """
h_c_m h_c_error_m h_min_m h_min_error_m lambda_ratio lambda_ratio_central lambda_ratio_deformed
lambda_ratio_deformed_error rms_deformed_m rms_deformed_error_m p_rise_rms_Pa p_rise_rms_error_Pa
p_rise_max_Pa p_rise_max_error_Pa h_min_rough_m h_min_rough_error_m film_below_limit_share
film_below_limit_error theta_2 theta_2_wavelength_m hersey mu_smooth mu_smooth_isothermal mu
mu_isothermal temperature_rise_max_K flash_temperature_K p_max_Pa p_max_rough_Pa mu_spread mu_ratio
mu_ratio_spread mu_ratio_model_error mu_ratio_ehl mu_ratio_ehl_error moes_m moes_l surfaces
"""
UNITS = {name: unit_of(name) for name in _NUMBERS.split()}
"""Columns that are numbers, and their units; `WORDS` follow them."""
WORDS = ("status", "message", "assessment")
CONTACT: dict[str, Callable[[Iterable[float]], float]] = {
    "contact_load_share": fmean,
    "contact_load_share_error": max,
    "contact_area_share": fmean,
    "contact_area_share_error": max,
}
"""Further columns of a case with a boundary film: means and maximum errors over surfaces."""
CONTACT_EHL = {
    "contact_load_share_ehl": "contact_load_share",
    "contact_load_share_ehl_error": "contact_load_share_error",
    "contact_area_share_ehl": "contact_area_share",
    "h_min_rough_ehl_m": "h_min_rough_m",
}
"""Further columns of its full simulation."""
EMPIRICAL = ("asperity_load_share_empirical", "mu_empirical")
"""Further columns of the empirical law of a thin film."""
CONCLUSION = "conclusion"
"""The last lines of a point: in the rows, but not in a file."""
NOT_DONE: Values = {"status": FAILED, "message": "not done"}


def units_of(plan: CurvePlan) -> dict[str, str]:
    """Give the columns of a curve that are numbers, and their units."""
    units = dict(UNITS)
    if any(p.settings["lubricant"]["boundary_film"] for p in plan.points):
        units |= dict.fromkeys(CONTACT, "1") | {name: unit_of(name) for name in CONTACT_EHL}
    return units | (dict.fromkeys(EMPIRICAL, "1") if plan.load_share is not None else {})


def curve_table(plan: CurvePlan, rows: Mapping[int, Values]) -> pd.DataFrame:
    """Give the varied keys and the columns of a curve at all points, in the order of the table.

    Names and units are those of `units_of`, followed by `WORDS` and `CONCLUSION`; None for a number
    that does not exist.
    """
    patterns: dict[str, Pattern] = {}
    result = [p.point.values | _row(plan, p, rows, patterns) for p in plan.points]
    columns = [*plan.study.keys, *units_of(plan), *WORDS, CONCLUSION]
    return pd.DataFrame(result, columns=columns, dtype=object)


def curves_of(plan: CurvePlan, table: pd.DataFrame, *, absolute: bool = False) -> list[Curve]:
    """Split a table into curves over the first key."""
    first, *others = plan.study.keys
    groups = table.groupby(others, sort=False) if others else [((), table)]
    return [
        Curve(
            ", ".join(f"{key} = {value}" for key, value in zip(others, values, strict=True)),
            first,
            rows,
            absolute,
        )
        for values, rows in groups
    ]


def _row(
    plan: CurvePlan, point: CurvePoint, rows: Mapping[int, Values], patterns: dict[str, Pattern]
) -> dict[str, Any]:
    """Compute the columns of a point."""
    operating = contact_of(point.settings)
    smooth = rows.get(point.smooth, NOT_DONE)
    result = [rows.get(number, NOT_DONE) for number in point.predictions]
    full = None if point.full is None else rows.get(point.full, NOT_DONE)
    viscosity = float(point.settings["lubricant"]["viscosity"])
    # a load per length has the unit of viscosity times velocity
    length = 1.0 if operating.ellipse.is_line else operating.radius
    values: dict[str, Any] = dict.fromkeys(units_of(plan)) | {
        **_film(smooth, operating),
        **{n: smooth.get(n) for n in ("temperature_rise_max_K", "flash_temperature_K", "p_max_Pa")},
        "hersey": viscosity * operating.mean_velocity * length / operating.load,
        "moes_m": operating.moes_m,
        "moes_l": operating.moes_l,
        "surfaces": len(result),
    }
    if result:
        values |= _film_ratios(point.settings, operating, values, patterns)
    values |= _rough_friction(result, smooth) if result else _smooth_friction(smooth)
    if (law := plan.load_share) is not None and values["lambda_ratio_central"] is not None:
        # at a film breakdown the film has the friction of the smooth contact
        ratio = values["lambda_ratio_central"]
        mu_film = smooth.get("mu_smooth") if values["mu"] is None else values["mu"]
        mu = None if mu_film is None else law.friction(ratio, mu_film)
        values |= dict(zip(EMPIRICAL, (law.share(ratio), mu), strict=True))
    if point.settings["lubricant"]["boundary_film"]:
        for name, over_all in CONTACT.items():
            values[name] = _over(result or [smooth], name, over_all)
        if full is not None and full["status"] == "converged":
            values |= {name: full.get(source) for name, source in CONTACT_EHL.items()}
    notes = [values["message"]]
    if full is not None and full["status"] == "converged":
        values["mu_ratio_ehl"] = full["mu_ratio"]
        values["mu_ratio_ehl_error"] = full["mu_ratio_error"]
    elif full is not None:
        notes.append(f"full simulation: {full['status']}")
    if smooth["status"] == "converged" and smooth["H_c_extrapolated"] is None:
        n = int(smooth["points"])
        notes.append(
            f"film of {n} nodes along X, not extrapolated: grid.points = {2 * n - 1} may help"
        )
    if values["mu_smooth"] is None and smooth.get("F_error_note", "").startswith(NO_INLET):
        notes.append(f"smooth contact: {smooth['F_error_note']}")
    if smooth["status"] != "converged":
        notes.append(f"smooth contact: {why_none(smooth)}")
        if values["status"] in (FULL_FILM, MIXED, OUTSIDE):
            values["status"] = UNSOLVED
    values["message"] = "; ".join(filter(None, notes))
    values[CONCLUSION] = _conclude(point.settings, values)
    return values | {"assessment": values[CONCLUSION].assessment}


def _conclude(settings: Settings, values: Values) -> Conclusion:
    """Give the last lines of a point, from its columns."""
    status = values["status"]
    if status in (FULL_FILM, MIXED, OUTSIDE):
        status = values.get("prediction_status", "predicted")
    message = values["message"].removeprefix(f"{status}: ")
    note = "" if values["mu_ratio_model_error"] is not None else message
    law = settings["lubricant"]["shear_law"]
    more = {"status": status, "message": message, "mu_ratio_error_note": note, "shear_law": law}
    # the ratio of smooth surfaces is 1 by definition
    left_out = () if values["surfaces"] else ("mu_ratio",)
    return conclude({k: v for k, v in values.items() if k not in left_out} | more)


def _film(smooth: Values, operating: AnyContact) -> dict[str, Any]:
    """Film of the smooth contact, extrapolated if possible, with its error."""
    if smooth["status"] != "converged":
        return {}
    values: dict[str, Any] = {}
    for name in ("c", "min"):
        best, error = film_of(smooth, f"H_{name}")
        values[f"h_{name}_m"] = best * operating.film_scale
        values[f"h_{name}_error_m"] = None if error is None else error * operating.film_scale
    return values


def _film_ratios(
    settings: Settings, operating: AnyContact, values: Values, patterns: dict[str, Pattern]
) -> dict[str, Any]:
    """Film over roughness, and theta_2 of the pattern that replaces it."""
    h_c = values["h_c_m"]
    if h_c is None:
        return {}
    pattern = cached_pattern(settings, operating, h_c, patterns)
    if not pattern.rms_height > 0.0:
        return {}
    place = (
        operating.moes_m,
        operating.moes_l,
        pattern.wavelength / operating.hertz_radius,
        h_c / (2.0 * pattern.rms_height),
    )
    # eq. 16 applies to circular contacts
    known = operating.moes_l > 0.0 and operating.radius_ratio == 1.0
    return {
        "lambda_ratio": values["h_min_m"] / pattern.rms_height,
        "lambda_ratio_central": h_c / pattern.rms_height,
        "theta_2": float(stribeck.theta_2(*place)) if known else None,
        "theta_2_wavelength_m": pattern.wavelength,
    }


def _in_contact(result: Sequence[Values]) -> bool:
    """Whether the bodies are in contact, by the summaries of a point."""
    return any((row.get("contact_load_share") or 0.0) > 0.0 for row in result)


def _smooth_friction(smooth: Values) -> dict[str, Any]:
    """Friction of smooth surfaces: their ratio is 1 by definition."""
    if smooth["status"] != "converged":
        return {"status": UNSOLVED, "message": ""}
    values: dict[str, Any] = {"mu_ratio": 1.0, "mu_ratio_model_error": 0.0, "message": ""}
    for name in ("mu", "mu_isothermal"):
        of_smooth = name.replace("mu", "mu_smooth")
        values[name] = values[of_smooth] = smooth.get(of_smooth)
    unresolved = str(smooth.get("contact_load_share_error_note", "")).startswith(NO_INLET)
    status = MIXED if _in_contact([smooth]) else FULL_FILM
    return values | {"status": UNSOLVED if unresolved else status}


def _rough_friction(result: Sequence[Values], smooth: Values) -> dict[str, Any]:
    """Mean and spread over the surfaces; no mean if one of them has no ratio.

    The coefficient of the smooth contact is that of its solution, which includes the inlet. With
    solid contact both coefficients are predicted, for consistency.
    """
    values: dict[str, Any] = {n: smooth.get(n) for n in ("mu_smooth", "mu_smooth_isothermal")}
    if failed := [row for row in result if row["status"] != "predicted"]:
        return values | _failure(failed, len(result))
    outside = sorted({row["outside_range"] for row in result if row.get("outside_range")})
    if any((row["mu_ratio"] or 0.0) > KNOWN_RATIO for row in result):
        outside.append(f"mu_ratio above {KNOWN_RATIO:g}")
    notes = [f"outside the range of the prediction: {'; '.join(outside)}"] if outside else []
    contact = _in_contact(result)
    if contact and any(row["mu_ratio"] is None for row in result):
        notes.append(NO_FRICTION)
        values["mu_note"] = NO_FRICTION
    coefficients = [
        {
            name: row[name]
            if _in_contact([row]) or None in (row.get("mu"), values[of_smooth])
            else row["mu_ratio"] * values[of_smooth]
            for name, of_smooth in (("mu", "mu_smooth"), ("mu_isothermal", "mu_smooth_isothermal"))
        }
        for row in result
    ]
    for name, rows in (("mu_ratio", result), ("mu", coefficients)):
        values |= {name: _over(rows, name, np.mean), f"{name}_spread": _over(rows, name, _spread)}
    values["mu_isothermal"] = _over(coefficients, "mu_isothermal", np.mean)
    if contact:
        own = all(row.get("mu_smooth") is not None for row in result)
        for name, mean in (("mu_smooth", "mu"), ("mu_smooth_isothermal", "mu_isothermal")):
            numbers = values[mean], values["mu_ratio"]
            known = None not in numbers and (own or name != "mu_smooth")
            values[name] = numbers[0] / numbers[1] if known else None
        if values["mu"] is not None and not own:
            notes.append(OF_ROUGH)
        for name in ("temperature_rise_max_K", "flash_temperature_K"):
            values[name] = _over(result, name, max)
    for name in ("p_max_rough_Pa", "mu_ratio_model_error"):
        values[name] = _over(result, name, max)
    status = MIXED if contact else OUTSIDE if outside else FULL_FILM
    return values | deformed_surfaces(result) | {"status": status, "message": "; ".join(notes)}


def _failure(failed: Sequence[Values], count: int) -> dict[str, Any]:
    """Status and message of a point with surfaces that have no ratio."""
    broken = [row for row in failed if row["status"] == BREAKDOWN]
    number = f"{len(broken or failed)} of {count} surfaces: " if count > 1 else ""
    values = {
        "status": BREAKDOWN if broken else UNSOLVED,
        "message": f"{number}{why_none((broken or failed)[0])}",
    }
    if all(row["status"] == BEYOND for row in failed):
        # the film is known
        values |= {"status": OUTSIDE, "prediction_status": BEYOND}
    return values


def _spread(numbers: Iterable[float]) -> float | None:
    values = np.array(numbers, dtype=float)
    return float(values.std(ddof=1)) if values.size > 1 else None


def _over(result: Sequence[Values], name: str, over_all: Callable[..., Any]) -> Any:  # noqa: ANN401
    """Apply a function to the values of several surfaces; None if one of them has none."""
    numbers = [row.get(name) for row in result]
    return None if None in numbers else over_all(numbers)


def no_coefficient(settings: Settings) -> str:
    """State why a friction coefficient of a resolved case is meaningless; '' if it is not."""
    operating, lubricant = contact_of(settings), Lubricant.from_settings(settings)
    film = formula_film(operating, lubricant)
    result = absolute_friction(operating, lubricant, film=film, mu_smooth=1.0, mu_ratio=1.0)
    return "" if math.isfinite(result["mu"]) else str(result["mu_note"])
