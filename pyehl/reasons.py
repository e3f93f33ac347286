# SPDX-License-Identifier: BSD-3-Clause
"""Texts for the codes of the compiled library: why a number is not known, and how mu is computed.

The codes are those of ``fortran/base/reason.f90``.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from pyehl.assessment import NO_INLET
from pyehl.number_text import fixed, megapascals, power
from pyehl.types import Settings, Values

ALONE = "there is no run on the next coarser grid"
NO_SIZE = "moes_m and moes_l give no sliding speed in m/s"
VANISHING = "there is no sliding: the ratio is that of vanishing sliding"
WITH_HEAT = "with the temperature of film and walls; pressure and film thickness are isothermal"
OF_ROUGH = (
    "mu includes the heating of the rough contact; mu_smooth with its own heating is omitted: "
    "mu_isothermal = mu_ratio mu_smooth_isothermal"
)
"""Why there is no mu_smooth with the mu of a rough contact with frictional heating."""
NOT_CONVERGED = "the temperature is not converged"
REASONS = {
    1: "there is no solution",
    2: "two coarser grids with a solution are needed",
    3: "the change from grid to grid does not decrease: no extrapolation is possible",
    4: "the domain is too small to determine the film of a flooded contact: leave out "
    "grid.x_inlet, or give one farther away",
    5: NO_INLET + ", which may be why the bodies touch: grid.points = {points_for_inlet} or more",
    6: "the grid is too coarse for a solution at this load: grid.points = {points_for_solution} or "
    "more",
    7: "the ends of a narrow contact need shorter cells across the motion: grid.y_extent = "
    "{narrow_y_extent}, grid.points_y = {narrow_points_y} and solver.max_cycles = 100 may suffice",
    8: "there is no solution on the next coarser grid",
    9: "the next coarser grid does not resolve the inlet, which may be why the bodies touch on it",
    10: "most of the load is on a boundary film that would have to supply much of the flow: the "
    "share may change with the grid",
    11: "the bodies touch, and the friction there is not known: lubricant.boundary_friction and "
    "sliding are needed",
    12: ALONE + ": time.estimate_error is false",
    13: ALONE + ", because of time.steps",
    14: ALONE + " yet",
    15: ALONE + ": it resolves nothing of the surface",
    16: ALONE + ": grid.points is too small for one",
    17: "the run on the next coarser grid ended with the status '{coarser_status}'{coarser_why}",
    18: "pressures change too much from grid to grid to be extrapolated",
    19: "there is no mu_ratio",
    20: "{few_positions}",
    21: "the contribution of the omitted waves is not predicted (pyehl run does)",
    22: "the contribution of the omitted waves is not predicted (only for moving surfaces)",
    23: "{no_prediction}",
    24: "the bodies end under load: the pressure there is infinite in theory, and on a grid "
    "depends on its last cell (cell_at_end); a profile with a larger drop unloads the ends",
    31: WITH_HEAT,
    32: "isothermal: lubricant.thermal_friction is 'never'",
    33: "isothermal: the viscosity by temperature is not known "
    "(lubricant.temperature_viscosity, or the viscosities of a data sheet)",
    34: "isothermal: there is no frictional heat without sliding",
    35: "isothermal: the Newtonian stress is above lubricant.eyring_stress, its heat is not "
    "computed",
    36: "isothermal: by estimate a rise of {rise} K changes the friction by less than 0.1 %",
    37: "isothermal: the temperature of a wall at rest under an infinite line has no limit",
    38: f"{WITH_HEAT}; {OF_ROUGH}",
    41: NO_SIZE,
    42: VANISHING + ", and rolling_moment_N_m resists the rolling",
    43: "the smooth contact is not converged",
    44: "{above_limit}",
    45: NOT_CONVERGED,
    46: VANISHING + ", and rolling_moment_N resists the rolling",
}
HOTTER = "; the film is hotter than the temperatures at which the viscosity was measured"
ISO_AMPLITUDE = 3.5e-4
"""Amplitude of the logarithmic profile over the diameter of a roller (ISO/TS 16281)."""
PARTS = ("grid", "stop", "window", "left_out", "domain")
"""Parts of the error of the friction ratio."""
SMOOTH, AT_REST, STEPS = 1, 2, 3
"""Phases of a run (fortran/solve/contact_run.f90)."""


@dataclass(frozen=True, slots=True)
class Results:
    """Results of the library.

    Attributes
    ----------
    values
        Numbers and words by name; None for a number that does not exist.
    codes
        Codes of reasons by the name of their text in the summary.
    details
        Numbers in these texts.
    """

    values: dict[str, Any]
    codes: dict[str, int]
    details: dict[str, Any]


def heat_words(code: int, rise: float) -> str:
    """Say whether a coefficient of friction includes the heat of sliding, and why.

    `rise`: the temperature rise by estimate [K].
    """
    return REASONS[code].format(rise=power(rise, 1))


def above_limit(stress: float, limit: float) -> str:
    """Say why there is no coefficient of friction: the Newtonian stress [Pa] is unphysical."""
    return (
        f"give a lubricant.shear_law: the Newtonian shear stress of {power(stress, 1)} Pa is "
        f"unphysical, oils shear thin above about {megapascals(limit)} (lubricant.eyring_stress)"
    )


def few_positions(repeats: float, whole: float) -> str:
    """Say why the error of a mean is unknown if its time is not a common period of the surfaces."""
    text = (
        f"the mean is over {repeats:.0f} periods of the slowest surface, with few relative "
        "positions of both"
    )
    return f"{text}: time.max_periods = {whole:.0f} for all" if whole > 0 else text


def alpha_note(settings: Settings) -> str:
    """State the source of a pressure-viscosity coefficient that was not given; '' if it was."""
    s = settings["lubricant"]
    origin, alpha = s.get("alpha_origin", "given"), power(s["pressure_viscosity"], 3)
    if origin == "estimated":
        # minimum and maximum z of the oils with a name, at 40 and 100 degC, see
        # tests/model/test_lubricants.py
        return (
            f"alpha = {alpha} 1/Pa at {s['temperature']} degC is an estimate by the Z of a mineral "
            "oil (Roelands): for Z = 0.42 to 0.74 the film is 17 % thinner to 12 % thicker; give "
            "lubricant.pressure_viscosity"
        )
    if origin == "default":
        return (
            f"alpha = {alpha} 1/Pa is the default, that of another oil; give "
            "lubricant.pressure_viscosity"
        )
    return ""


def law_note(settings: Settings, hertz_pressure: float) -> str:
    """State viscosity, alpha and measured range of a law with constants of an oil; '' for others.

    The text warns if `hertz_pressure` [Pa] is above the range of the measurements.
    """
    s = settings["lubricant"]
    law, inlet = s["viscosity_law"], s.get("inlet_law", "")
    own = inlet or (law if law not in ("roelands", "barus") else "")
    if not own:
        return ""
    name = f"{s['name']}, " if s.get("name") else ""
    text = (
        f"{name}{law} viscosity at {s['temperature']} degC: {power(s['viscosity'], 3)} Pa s, "
        f"alpha = {power(s['pressure_viscosity'], 3)} 1/Pa; "
    )
    low, high = s["range_temperature_min"], s["range_temperature_max"]
    pressure, temperatures = s["range_pressure_max"], bool(low or high)
    if not temperatures and not pressure > 0.0:
        return f"{text}the range of its measurements is not known"
    ranges = [f"from {low} to {high} degC"] if temperatures else []
    ranges += [f"up to {power(pressure, 3)} Pa"] if pressure > 0.0 else []
    text += f"measured {' and '.join(ranges)}"
    if temperatures and not low <= s["temperature"] <= high:
        text += "; the temperature is outside this range"
    if law == own and 0.0 < pressure < hertz_pressure:
        text += f"; the pressure is above it: p_h = {power(hertz_pressure, 3)} Pa"
    return text


def summary_of(results: Results, settings: Settings, no_prediction: str = "") -> dict[str, Any]:
    """Make the summary of a run without its assessment.

    Parameters
    ----------
    results
        Results of the library.
    settings
        The resolved case.
    no_prediction
        Why the prediction for the waves that the grid omits failed; '' if it did not.
    """
    values, d = dict(results.values), results.details
    words = words_of(results, settings, no_prediction)
    why = dict.fromkeys(words[int(d[f"why_{part}"])] for part in PARTS if f"why_{part}" in d)
    if "mu_ratio_error" in values:
        values["mu_ratio_error_note"] = "; ".join(why)
    for name, code in results.codes.items():
        if code and name != "end_help":
            values[name] = words[code]
        elif name == "contact_load_share_error_note":
            values[name] = ""
    if d["beyond_measured"]:
        values["mu_note"] += HOTTER
    if "start_note" in d:
        values["start_note"] = f"no prediction: {d['start_note']}"
    notes = {
        "message": _why_no_result(results, settings, words),
        "pressure_viscosity_note": alpha_note(settings),
        "lubricant_note": law_note(settings, values["hertz_pressure_Pa"]),
    }
    return values | {name: text for name, text in notes.items() if text}


def words_of(results: Results, settings: Settings, no_prediction: str = "") -> dict[int, str]:
    """Give the texts of all codes, with their numbers."""
    v, d = results.values, results.details
    points = int(d.get("finest_points", 0))
    message = d.get("coarser_message", "")
    stress = v.get("shear_stress_max_Pa")
    numbers = {
        "points_for_inlet": int(d.get("points_for_inlet", 0)),
        "points_for_solution": int(d.get("points_for_solution", 0)),
        "narrow_y_extent": 0.125 * d.get("finest_width", 0.0),
        "narrow_points_y": 2 * points - 1,
        "coarser_status": d.get("coarser_status", ""),
        "coarser_why": f" ({message})" if message else "",
        "few_positions": few_positions(d.get("repeats", 0), d.get("whole_periods", 0)),
        "no_prediction": no_prediction,
        "rise": power(d["heat_estimate_K"], 1),
        "above_limit": above_limit(stress or math.nan, settings["lubricant"]["eyring_stress"]),
    }
    return {code: text.format_map(numbers) for code, text in REASONS.items()}


def _why_no_result(results: Results, settings: Settings, words: Mapping[int, str]) -> str:
    """Say why a run has no result, where it ended, and what to do about it, in one line."""
    d, status = results.details, results.values["status"]
    if "end_phase" not in d:
        return ""
    place = _place(d, "end_")
    remedy = _remedy(results, settings, words)
    if status == "negative film":
        return _of_negative_film(results, settings, place, remedy)
    if status == "cycle limit":
        return (
            f"the residual of {place} is {power(d['end_residual'], 1)} after cycle "
            f"{d['end_cycles']:.0f}; {remedy}, or a larger solver.max_cycles where the residual "
            "still falls"
        )
    if status == "diverged":
        return f"{place} has a value that is not a number; {remedy} or solver.cycle = 'W'"
    if status == "interrupted":
        if "coarser_end_phase" in d:
            place = f"the run for the grid error: {_place(d, 'coarser_end_')}"
        resumes = "; --resume continues from there" if d["end_phase"] == STEPS else ""
        return f"interrupted in {place}{resumes}"
    return _of_mean(d, settings["time"]) if status == "not settled" else ""


def _remedy(results: Results, settings: Settings, words: Mapping[int, str]) -> str:
    """Say what may give a solution: as the library says, else a finer grid.

    Of a roller also shorter cells along it, and a profile that drops more: first of all where its
    smooth contact has no positive film and the library knows no remedy.
    """
    d, smooth = results.details, results.details["end_phase"] == SMOOTH
    known = words.get(results.codes["end_help"], "") if smooth else ""
    finer = known or f"give a finer grid (grid.points = {2 * int(d['finest_points']) - 1})"
    of_inlet = smooth and settings.get("inlet", {}).get("film_hertz", 0.0) > 0.0
    inlet = ", or inlet.position in place of inlet.film" if of_inlet else ""
    if settings["contact"].get("shape") != "roller":
        return finer + inlet
    cells = f"shorter cells along the roller (grid.points_y = {2 * int(d['finest_rows']) - 1})"
    if smooth and not known and results.values["status"] == "negative film":
        steeper = _steeper(settings["contact"])
        return f"give a profile that drops more ({steeper}), or {cells}{inlet}"
    return f"{finer}{inlet}, {cells} or a profile that drops more"


def _steeper(contact: Values) -> str:
    """Give the keys of a logarithmic profile of twice its own amplitude, or twice that of ISO."""
    for end in ("", "_2"):
        if contact[f"profile{end}"] == "logarithmic":
            key = f"log_amplitude{end}"
            return f"contact.{key} = {power(2.0 * contact[key], 1)}"
    amplitude = power(2.0 * ISO_AMPLITUDE * 2.0 * contact["radius"], 1)
    text = f"contact.profile = 'logarithmic', contact.log_amplitude = {amplitude}"
    own = contact["profile"]
    return text if own == "none" else f"{text} in place of '{own}' and its keys"


def _of_mean(d: Values, time: Values) -> str:
    """Say that the mean of the friction ratio has not settled."""
    change = ""
    if "end_change" in d:
        change = (
            f": its last change is {power(d['end_change'], 1)}, time.tolerance allows "
            f"{power(time['tolerance'], 1)} of it"
        )
    key = "time.steps" if time["steps"] else "time.max_periods"
    return (
        f"the mean of mu_r/mu_s has not settled at T = {fixed(d['end_time'], 4)}{change}; give a "
        f"larger {key} with --resume"
    )


def _of_negative_film(results: Results, settings: Settings, place: str, remedy: str) -> str:
    """Say that there is no positive film: by the grid, or by the roughness."""
    v, d = results.values, results.details
    if d["end_phase"] == SMOOTH:
        return f"{place} has no positive film: {remedy}"
    si = bool(v.get("film_scale_m"))
    text = f"no solution with a positive film for {place}"
    if "end_film_before" in d:
        film = d["end_film_before"]
        shown = f"{fixed(film * v['film_scale_m'] * 1e9, 1)} nm" if si else ""
        text += f", minimum film before {shown or 'H_min = ' + power(film, 3)}"
    kinds = [settings.get(name, {}).get("kind", "smooth") for name in ("surface", "second_surface")]
    if kinds == ["smooth", "smooth"]:
        return f"{text}: {remedy}"
    nodes, enough = d["end_wave_nodes"], d["enough_wave_nodes"]
    text += f"; the shortest waves have {nodes:.0f} nodes"
    if nodes < enough:
        text += f", and as high as the film they need {enough:.0f}: {remedy}, a smoother surface"
    else:
        text += " or more: give a smoother surface"
    if si and not d["boundary_film_given"]:
        text += " or lubricant.boundary_film"
    return text + ("; pyehl predict reports where the film ends" if d["surfaces_repeat"] else "")


def _place(d: Values, prefix: str) -> str:
    """Name the phase of a run: smooth contact, a fraction of the roughness at rest, a time step."""
    at = d[f"{prefix}at"]
    text = {
        SMOOTH: "the smooth contact",
        AT_REST: f"the roughness at rest times {fixed(at, 3)}",
        STEPS: f"the time step to T = {fixed(at, 4)}",
    }[int(d[f"{prefix}phase"])]
    return f"{text} on {d[f'{prefix}points']:.0f} x {d[f'{prefix}points_y']:.0f} nodes"
