# SPDX-License-Identifier: BSD-3-Clause
"""Limits of the model that apply to a result, and its warnings."""

from pyehl.surfaces import FEATURES, rough_groups
from pyehl.theory.line_contact import LineContact, scaling_contact
from pyehl.types import Settings, Values

# Temperature increase [K] above which a warning is given: at the usual temperature coefficient of
# 0.04 1/K the viscosity is lower by a third
HOT = 10.0
# Hertz pressure [Pa] above which smooth contacts were tested on few grids
HIGH_PRESSURE = 4e9
NOTES = {
    "H_c_error_note": "The error of H_c is not known",
    "H_min_error_note": "The error of H_min is not known",
    "mu_ratio_error_note": "The error of μ_r/μ_s is not known",
    "contact_load_share_error_note": "Contact at the boundary film",
    "start_note": "The time steps began behind the front",
    "mu_note": "Friction",
    "note": "μ_r/μ_s",
    "message": "Status",
}


def limits(settings: Settings, summary: Values) -> list[str]:
    """List the limits of the model that apply to a result, in one or two sentences each."""
    point = scaling_contact(settings)
    supply = (
        "The inlet is starved: &inlet gives the oil that arrives, or where it begins."
        if settings.get("inlet")
        else "The inlet is fully flooded: there is no starvation."
    )
    law, flow = settings["lubricant"]["shear_law"], settings["lubricant"]["flow"]
    rough = rough_groups(settings)
    predicted = summary.get("kind") == "prediction"
    result = [
        f"{supply} {_contact(settings, summary)}",
        "Film and pressure are isothermal."
        if point.thermal_reduction == 1.0
        else "Shear heating of the inlet is a factor on the film (Gupta et al. 1992); film and "
        "pressure in the contact are isothermal.",
    ]
    if summary.get("temperature_rise_max_K") is not None:
        result.append("The friction includes the temperature of film and walls.")
    elif summary.get("flash_temperature_K") is not None:
        result.append("The flash temperature is estimated, and not fed back into the friction.")
    if summary.get("kind") == "response":
        return result
    if law == "newtonian" and point.sliding_speed > 0.0:
        result.append(
            "The oil is Newtonian: a coefficient of friction would have no meaning at these "
            "pressures. Shear thinning brings μ_r/μ_s close to 1."
        )
    elif law in ("eyring", "carreau") and flow == "newtonian":
        result.append("The shear law applies to the friction only: film and waves are Newtonian.")
    elif law == "limiting":
        result.append("The limiting stress limits the friction, not the flow.")
    if (isinstance(point, LineContact) or point.moes_m >= 500.0) and settings["grid"][
        "border"
    ] != "flooded":
        result.append(
            "At the border of the domain P = 0, which makes the film slightly thinner; this is "
            "part of the stated error."
        )
    if point.hertz_pressure > HIGH_PRESSURE:
        result.append(
            "Above a Hertz pressure of 4 GPa few grids were tested; the status reports the outcome."
        )
    if settings["contact"].get("shape") == "line":
        result.append(
            "The line is infinitely long: ends of a roller, its profile and misalignment are not "
            "included."
        )
    if rough:
        result.append(
            "μ_r/μ_s of the case is that of one track of this surface at this slip. "
            "Between tracks of one surface it scatters by about 10 %."
        )
    if len(rough) == 1 and str(settings[rough[0]]["kind"]) in FEATURES:
        result[-1] = "μ_r/μ_s is the mean over one passage of the feature."
    if predicted:
        result.append(
            "The prediction from the spectrum is of second order in the height of the waves, and "
            "valid for waves that the film sustains."
        )
    return result


def _contact(settings: Settings, summary: Values) -> str:
    """Describe solid contact; the load share of a study is the maximum over its cases."""
    share = summary.get("contact_load_share")
    boundary = float(settings["lubricant"]["boundary_film"])
    broken = summary.get("status") in ("film breakdown", "negative film")
    if share:
        return (
            f"Mixed lubrication: {100.0 * share:.2g} % of the load is on the boundary film "
            f"of {boundary * 1e9:.3g} nm, whose thickness and friction are given, not computed."
        )
    if boundary > 0.0 and share is None:
        return "Whether there is solid contact at the boundary film is not known."
    if boundary > 0.0:
        return "There is no solid contact at the boundary film: the film is full."
    if broken:
        return "The film ends, and without lubricant.boundary_film solid contact is not computed."
    return "The film is full: there is no mixed lubrication."


def neglected_flash(summary: Values) -> float | None:
    """Give a high flash temperature [K] that the friction does not include, else None."""
    heat = summary.get("flash_temperature_K")
    known = summary.get("temperature_rise_max_K") is not None
    return None if heat is None or heat <= HOT or known else float(heat)


def warnings(summary: Values) -> list[str]:
    """List the statements of a summary on missing and uncertain results."""
    result = [
        f"{words}: {summary[name]}."
        for name, words in NOTES.items()
        if summary.get(name) and not (name == "message" and summary["status"] == "predicted")
    ]
    outside = summary.get("outside_range")
    if outside:
        result.append(
            f"Outside of the range in which the response was measured: {', '.join(outside)}."
        )
    heat = neglected_flash(summary)
    if heat is not None:
        result.append(
            f"The flash temperature is {heat:.3g} K: the oil in the contact is less viscous "
            "than computed, and the friction lower."
        )
    left_out = summary.get("variance_left_out") or 0.0
    if left_out > 0.0:
        result.append(f"The grid omits {100.0 * left_out:.2g} % of the variance of the heights.")
    share = summary.get("film_below_zero_share") or 0.0
    if share > 0.0:
        result.append(f"The film would have ended on {100.0 * share:.2g} % of the contact.")
    cavitated = summary.get("cavitated_share") or 0.0
    if cavitated > 0.0:
        result.append(
            f"The pressure would be negative on {100.0 * cavitated:.2g} % of the contact."
        )
    return result
