# SPDX-License-Identifier: BSD-3-Clause
"""A Stribeck curve from the rows of its tasks: its columns, and where full film ends."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from pyehl import library
from pyehl.prediction.deformed import deformed_surfaces
from pyehl.prediction.errors import KNOWN_RATIO
from pyehl.prediction.friction import BEYOND
from pyehl.prediction.mixed_lubrication import NO_FRICTION
from pyehl.prediction.smooth import film_of
from pyehl.results import unit_of
from pyehl.studies.curve_contact import contact_columns, touches
from pyehl.studies.curve_pattern import SMOOTH, Pattern, kept_pattern
from pyehl.studies.curve_plan import CurvePlan, CurvePoint
from pyehl.studies.tasks import FAILED, why_none
from pyehl.theory import stribeck
from pyehl.theory.film import central_film
from pyehl.theory.friction import OF_ROUGH, absolute_friction
from pyehl.theory.load_share import LoadShare
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Array, Settings, Values

STATUSES = ("full film", "mixed film", "film breakdown", "outside the range", "not solved")
"""What a point of a curve can be."""
FULL_FILM, MIXED, BREAKDOWN, OUTSIDE, UNSOLVED = STATUSES
# How a run begins to say that bodies may touch because of their grid
NO_INLET = "the grid does not resolve the inlet"
_NUMBERS = """
h_c_m h_c_error_m h_min_m h_min_error_m lambda_ratio lambda_ratio_central lambda_ratio_deformed
lambda_ratio_deformed_error rms_deformed_m rms_deformed_error_m p_rise_rms_Pa p_rise_rms_error_Pa
p_rise_max_Pa p_rise_max_error_Pa h_min_rough_m h_min_rough_error_m film_below_limit_share
film_below_limit_error theta_2 theta_2_wavelength_m hersey mu_smooth mu_smooth_isothermal mu
mu_isothermal temperature_rise_max_K flash_temperature_K p_max_Pa p_max_rough_Pa mu_spread mu_ratio
mu_ratio_spread mu_ratio_model_error mu_ratio_ehl mu_ratio_ehl_error moes_m moes_l surfaces
"""
UNITS = {name: unit_of(name) for name in _NUMBERS.split()}
"""Columns that are numbers, and their units; behind them come `WORDS`."""
WORDS = ("status", "message", "judgement")
EMPIRICAL = {"asperity_load_share_empirical": "1", "mu_empirical": "1"}
"""More of them where an empirical law of a thin film is asked for."""


def curve_rows(plan: CurvePlan, rows: Mapping[int, Values]) -> list[dict[str, Any]]:
    """Give the columns of a curve at all points, in the order of the table.

    Names and units are those of `UNITS` and, where the plan has an empirical law, `EMPIRICAL`; None
    for a number that does not exist.
    """
    kept: dict[str, Pattern] = {}
    return [_at(point, rows, kept, plan.load_share) for point in plan.points]


def _empirical(values: Values, smooth: float | None, law: LoadShare) -> dict[str, Any]:
    """Give what the law says; the film has the friction of the smooth contact where it ends."""
    ratio = values["lambda_ratio_central"]
    film = smooth if values["mu"] is None else values["mu"]
    if ratio is None:
        return dict.fromkeys(EMPIRICAL)
    mu = None if film is None else law.friction(ratio, film)
    return {"asperity_load_share_empirical": law.share(ratio), "mu_empirical": mu}


def _at(
    point: CurvePoint, rows: Mapping[int, Values], kept: dict[str, Pattern], law: LoadShare | None
) -> dict[str, Any]:
    operating = OperatingPoint.from_settings(point.settings)
    nothing = {"status": FAILED, "message": "not done"}
    smooth = rows.get(point.smooth, nothing)
    found = [rows.get(number, nothing) for number in point.predictions]
    values: dict[str, Any] = dict.fromkeys(UNITS)
    values |= _film(smooth, operating)
    for name in ("temperature_rise_max_K", "flash_temperature_K", "p_max_Pa"):
        values[name] = smooth.get(name)
    h_c, h_min = values["h_c_m"], values["h_min_m"]
    film = h_c or central_film(operating, Lubricant.from_settings(point.settings))
    values |= {
        "hersey": float(point.settings["lubricant"]["viscosity"])
        * operating.mean_velocity
        * operating.radius
        / operating.load,
        "moes_m": operating.moes_m,
        "moes_l": operating.moes_l,
        "surfaces": len(found),
    }
    likeness = kept_pattern(point.settings, operating, film, kept) if found else SMOOTH
    if h_c is not None and likeness.rms_height > 0.0:
        wavelength = likeness.wavelength / operating.hertz_radius
        ratio = h_c / (2.0 * likeness.rms_height)
        place = (operating.moes_m, operating.moes_l, wavelength, ratio)
        # eq. 16 is for circular contacts
        known = operating.moes_l > 0.0 and operating.radius_ratio == 1.0
        values["lambda_ratio"] = h_min / likeness.rms_height
        values["lambda_ratio_central"] = h_c / likeness.rms_height
        values["theta_2"] = float(stribeck.theta_2(*place)) if known else None
        values["theta_2_wavelength_m"] = likeness.wavelength
    values |= _friction(found, smooth) if found else _smooth_friction(smooth)
    if law is not None:
        values |= _empirical(values, smooth.get("mu_smooth"), law)
    full = nothing if point.full is None else rows.get(point.full, nothing)
    if point.settings["lubricant"]["boundary_film"]:
        values |= contact_columns(found or [smooth], full)
    if point.full is not None:
        if full["status"] == "converged":
            values["mu_ratio_ehl"] = full["mu_ratio"]
            values["mu_ratio_ehl_error"] = full["mu_ratio_error"]
        else:
            values["message"] = _joined(values, f"full simulation: {full['status']}")
    if smooth["status"] == "converged" and smooth["H_c_extrapolated"] is None:
        n = int(point.settings["grid"]["points"])
        told = f"film of {n} x {n} nodes, not extrapolated: grid.points = {2 * n - 1} may do better"
        values["message"] = _joined(values, told)
    if values["mu_smooth"] is None and smooth.get("F_error_note", "").startswith(NO_INLET):
        values["message"] = _joined(values, f"smooth contact: {smooth['F_error_note']}")
    if smooth["status"] != "converged":
        values["message"] = _joined(values, f"smooth contact: {why_none(smooth)}")
        if values["status"] in (FULL_FILM, MIXED, OUTSIDE):
            values["status"] = UNSOLVED
    values["judgement"] = conclude(point, values).judgement
    return values


def conclude(point: CurvePoint, row: Values) -> library.Conclusion:
    """Judge a point of a curve by its columns, and give its last lines."""
    status = "predicted" if row["status"] in (FULL_FILM, MIXED, OUTSIDE) else row["status"]
    if row["status"] == OUTSIDE and BEYOND in str(row["message"]):
        status = BEYOND
    message = str(row["message"]).removeprefix(f"{status}: ")
    note = "" if row["mu_ratio_model_error"] is not None else message
    law = point.settings["lubricant"]["shear_law"]
    more = {"status": status, "message": message, "mu_ratio_error_note": note, "shear_law": law}
    if NO_FRICTION in message:
        more["mu_note"] = NO_FRICTION
    # the ratio of smooth surfaces is no finding
    known = row if row["surfaces"] else {k: v for k, v in row.items() if k != "mu_ratio"}
    return library.conclude({**known, **more})


def _film(smooth: Values, operating: OperatingPoint) -> dict[str, Any]:
    """Film of the smooth contact, extrapolated where it could be, with its error."""
    if smooth["status"] != "converged":
        return {}
    values: dict[str, Any] = {}
    for name in ("c", "min"):
        best, error = film_of(smooth, f"H_{name}")
        values[f"h_{name}_m"] = best * operating.film_scale
        values[f"h_{name}_error_m"] = None if error is None else error * operating.film_scale
    return values


def _smooth_friction(smooth: Values) -> dict[str, Any]:
    """Friction of smooth surfaces: their ratio is 1 by definition."""
    if smooth["status"] != "converged":
        return {"status": UNSOLVED, "message": ""}
    coefficient, isothermal = smooth.get("mu_smooth"), smooth.get("mu_smooth_isothermal")
    unresolved = str(smooth.get("contact_load_share_error_note", "")).startswith(NO_INLET)
    return {
        "mu_smooth": coefficient,
        "mu_smooth_isothermal": isothermal,
        "mu": coefficient,
        "mu_isothermal": isothermal,
        "mu_ratio": 1.0,
        "mu_ratio_model_error": 0.0,
        "status": UNSOLVED if unresolved else MIXED if touches([smooth]) else FULL_FILM,
        "message": "",
    }


def _friction(found: Sequence[Values], smooth: Values) -> dict[str, Any]:
    """Mean and spread over the surfaces; no mean where one of them has no ratio.

    The coefficient of the smooth contact is that of its solution, which has the inlet too. Where
    bodies touch both coefficients are as predicted, so that they belong together.
    """
    lost = [row for row in found if row["status"] != "predicted"]
    if lost:
        broken = sum(row["status"] == BREAKDOWN for row in lost)
        status = BREAKDOWN if broken else UNSOLVED
        if all(row["status"] == BEYOND for row in lost):
            # of which the film is known
            status = OUTSIDE
        share = f"{broken or len(lost)} of {len(found)} surfaces: " if len(found) > 1 else ""
        row = next(row for row in lost if not broken or row["status"] == BREAKDOWN)
        message = f"{share}{why_none(row)}"
        known = {name: smooth.get(name) for name in ("mu_smooth", "mu_smooth_isothermal")}
        return {**known, "status": status, "message": message}
    outside = sorted({row["outside_range"] for row in found if row.get("outside_range")})
    if any((row["mu_ratio"] or 0.0) > KNOWN_RATIO for row in found):
        outside.append(f"mu_ratio above {KNOWN_RATIO:g}")
    told = [f"outside the range of the prediction: {'; '.join(outside)}"] if outside else []
    if touches(found) and any(row["mu_ratio"] is None for row in found):
        told.append(NO_FRICTION)
    coefficient, isothermal = smooth.get("mu_smooth"), smooth.get("mu_smooth_isothermal")
    absolute: list[Values] = [
        {
            name: row[name]
            if touches([row]) or None in (row.get("mu"), number)
            else row["mu_ratio"] * number
            for name, number in (("mu", coefficient), ("mu_isothermal", isothermal))
        }
        for row in found
    ]
    values = {**_mean(found, "mu_ratio"), **_mean(absolute, "mu")}
    values["mu_isothermal"] = _mean(absolute, "mu_isothermal")["mu_isothermal"]
    values |= {"mu_smooth": coefficient, "mu_smooth_isothermal": isothermal}
    if touches(found):
        own = all(row.get("mu_smooth") is not None for row in found)
        for name, mean in (("mu_smooth", "mu"), ("mu_smooth_isothermal", "mu_isothermal")):
            mu, ratio = values[mean], values["mu_ratio"]
            told_of = own or name != "mu_smooth"
            values[name] = mu / ratio if told_of and mu is not None and ratio is not None else None
        if values["mu"] is not None and not own:
            told.append(OF_ROUGH)
        for name in ("temperature_rise_max_K", "flash_temperature_K"):
            values[name] = _largest(found, name)
    return {
        **values,
        **deformed_surfaces(found),
        "p_max_rough_Pa": _largest(found, "p_max_rough_Pa"),
        "mu_ratio_model_error": _largest(found, "mu_ratio_model_error"),
        "status": MIXED if touches(found) else OUTSIDE if outside else FULL_FILM,
        "message": "; ".join(told),
    }


def _mean(found: Sequence[Values], name: str) -> dict[str, float | None]:
    numbers = [row.get(name) for row in found]
    if any(number is None for number in numbers):
        return {name: None, f"{name}_spread": None}
    values = np.array(numbers, dtype=float)
    spread = float(values.std(ddof=1)) if values.size > 1 else None
    return {name: float(values.mean()), f"{name}_spread": spread}


def _largest(found: Sequence[Values], name: str) -> float | None:
    numbers = [row.get(name) for row in found]
    return max(numbers) if all(number is not None for number in numbers) else None  # type: ignore[type-var]


def no_coefficient(settings: Settings) -> str:
    """Say why a friction coefficient of a resolved case would have no meaning; '' if it has one."""
    operating, lubricant = OperatingPoint.from_settings(settings), Lubricant.from_settings(settings)
    film = central_film(operating, lubricant)
    found = absolute_friction(operating, lubricant, film=film, mu_smooth=1.0, mu_ratio=1.0)
    return "" if math.isfinite(found["mu"]) else str(found["mu_note"])


def _joined(values: Values, text: str) -> str:
    return f"{values['message']}; {text}" if values.get("message") else text


def full_film_ends(
    key: str, places: Sequence[float] | Array, rows: Sequence[Values]
) -> tuple[str, tuple[int, ...]]:
    """Say where full film ends along a curve over `key`, and give the points without it.

    `places` are its values, ascending or descending, with the columns of the curve at these.
    """
    broken = tuple(k for k, row in enumerate(rows) if row["status"] in (BREAKDOWN, MIXED))
    known = [k for k, row in enumerate(rows) if row["status"] in (FULL_FILM, OUTSIDE)]
    lost = len(rows) - len(known) - len(broken)
    rest = f" with an answer; {lost} have none" if lost else ""
    far = sum(row["status"] == OUTSIDE for row in rows)
    beyond = f"; {far} of them outside the range of the prediction" if far else ""
    if not known and not broken:
        return "no point has an answer", broken
    if not broken:
        return f"full film at all points{beyond}{rest}", broken
    if not known:
        return f"no full film at any point{rest}", broken
    pairs = [
        (k, j) for k in broken for j in known if not any(min(k, j) < m < max(k, j) for m in known)
    ]
    edge = min(pairs, key=lambda pair: abs(pair[0] - pair[1]))
    low, high = sorted((places[edge[0]], places[edge[1]]))
    return f"full film ends between {key} = {low:.4g} and {high:.4g}", broken
