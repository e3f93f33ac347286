# SPDX-License-Identifier: BSD-3-Clause
"""The conditions of a case in SI units and as dimensionless numbers."""

from collections.abc import Mapping
from typing import Any

from pyehl.surfaces import rough_groups
from pyehl.theory.line_contact import LineContact, scaling_contact
from pyehl.theory.oils import oil
from pyehl.types import Settings


def conditions(settings: Settings) -> dict[str, str]:
    """Give names and values in SI units of a resolved case."""
    point = scaling_contact(settings)
    contact, lubricant = settings["contact"], settings["lubricant"]
    result = {}
    if not point.si:
        result["given as"] = "M and L; below with the radius and modulus of a steel ball"
    if contact.get("shape") == "roller":
        result["roller, load w"] = f"{contact['load']:.6g} N"
        result["length"] = f"{contact['length'] * 1e3:.6g} mm"
    if isinstance(point, LineContact):
        of = "mean" if contact.get("shape") == "roller" else "line contact,"
        result[f"{of} load per length w"] = f"{point.load_per_length:.6g} N/m"
    else:
        result["load w"] = f"{point.load:.6g} N"
    result["mean velocity u"] = f"{point.mean_velocity:.6g} m/s"
    result["slide-to-roll ratio"] = f"{point.slide_to_roll:.4g}"
    if isinstance(point, LineContact) or point.radius_ratio == 1.0:
        result["reduced radius R"] = f"{point.radius * 1e3:.6g} mm"
    else:
        across = point.radius / point.radius_ratio
        result["reduced radii R_x, R_y"] = f"{point.radius * 1e3:.6g}, {across * 1e3:.6g} mm"
        if contact.get("angle"):
            result["rotated by"] = f"{contact['angle']:g} deg against the motion"
    result["reduced modulus E'"] = f"{point.reduced_modulus * 1e-9:.6g} GPa, 2/E' = Σ(1−ν²)/E"
    result["viscosity η₀"] = f"{float(lubricant['viscosity']):.5g} Pa s at ambient pressure"
    if lubricant.get("name"):
        result["oil"] = f"{lubricant['name']}: {oil(str(lubricant['name'])).title}"
        result["inlet temperature"] = f"{lubricant['temperature']:g} °C"
    if lubricant.get("kinematic_viscosity_40"):
        result["viscosity η₀"] += (
            f", from {lubricant['kinematic_viscosity_40']:g} and "
            f"{lubricant['kinematic_viscosity_100']:g} mm²/s at 40 and 100 °C"
        )
        result["inlet temperature"] = f"{lubricant['temperature']:g} °C"
    result["pressure-viscosity α"] = f"{point.pressure_viscosity * 1e9:.5g} 1/GPa"
    if point.thermal_reduction != 1.0:
        result["shear heating of the inlet"] = (
            f"film {point.thermal_reduction:.4f} of the isothermal one"
        )
    law, density = lubricant["viscosity_law"], lubricant["density_law"]
    result["laws"] = f"viscosity {law}, density {density}, shear stress {lubricant['shear_law']}"
    if lubricant["shear_law"] in ("eyring", "carreau"):
        result["laws"] += f", flow {lubricant.get('flow', 'newtonian')}"
    for group in rough_groups(settings):
        result[group.replace("_", " ")] = surface_words(settings[group])
    return result


def surface_words(group: Mapping[str, Any]) -> str:
    """Describe the surface of a group in a few words."""
    kind = str(group["kind"])
    if kind == "fractal":
        words = (
            f"fractal, rms {float(group['rms_height']) * 1e9:.4g} nm, Hurst {group['hurst']:g}, "
            f"seed {group['seed']}, {group['pixels']} pixels per side"
        )
    elif kind == "harmonic":
        along, across = group["wavelength_x"], group["wavelength_y"]
        words = f"harmonic wave, {along:g} a along and {across:g} a across the motion"
    elif kind == "map":
        words = f"map {group['file']}"
    else:
        si = bool(group.get("width_m"))
        words = (
            f"{kind}, {group['width_m'] * 1e3:g} mm wide"
            if si
            else f"{kind}, {group['width']:g} a wide"
        )
    return f"{words}; it moves at {group['velocity_ratio']:g} of the mean velocity"


def numbers(settings: Settings) -> dict[str, str]:
    """Give names and values of the dimensionless numbers, and of the dry contact."""
    point = scaling_contact(settings)
    line = isinstance(point, LineContact)
    result = {
        "Moes load M of a line" if line else "Moes load M": f"{point.moes_m:.5g}",
        "Moes material L of a line" if line else "Moes material L": f"{point.moes_l:.5g}",
        "U, G, W": f"{point.speed:.4g}, {point.material:.4g}, {point.load_number:.4g}",
        "Hertz pressure p_h": f"{point.hertz_pressure * 1e-9:.5g} GPa",
        "α p_h": f"{point.alpha_bar:.4g}",
    }
    if isinstance(point, LineContact):
        result["half width b of the contact"] = f"{point.half_width * 1e3:.5g} mm"
    elif point.radius_ratio == 1.0:
        result["contact radius a"] = f"{point.hertz_radius * 1e3:.5g} mm"
    else:
        a, b = point.hertz_radius * 1e3, point.semi_axis_y * 1e3
        result["semi-axes of the contact"] = (
            f"{a:.5g} mm and {b:.5g} mm"
            if settings["contact"].get("angle")
            else f"{a:.5g} mm along, {b:.5g} mm across the motion"
        )
    result["unit of films b²/R" if line else "unit of films a²/R"] = (
        f"{point.film_scale * 1e6:.5g} µm"
    )
    return result
