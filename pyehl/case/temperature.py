# SPDX-License-Identifier: BSD-3-Clause
"""Temperature of the lubricant: viscosity from a data sheet, heat of the inlet and of friction."""

import math

from pyehl.case import physics
from pyehl.case.draft import Draft
from pyehl.case.number import short, to_text
from pyehl.theory.heat import thermal_loading, thermal_reduction

# Exponent z of Roelands 1966 of a mineral oil
MINERAL_Z = 0.6
# Relative difference of viscosities that is none
ROUNDING = 1e-6


def complete_viscosity(draft: Draft) -> None:
    """Find the viscosity, and its fall with temperature, from a data sheet."""
    oil = draft.settings.lubricant
    sheet = oil.kinematic_viscosity_40, oil.kinematic_viscosity_100
    if not any(sheet):
        _check_use_of_sheet(draft)
        return
    temperature = f"{to_text(oil.temperature)} degC"
    if not all(sheet) or sheet[1] >= sheet[0]:
        given = draft.is_given("lubricant", "kinematic_viscosity_100")
        what = (
            f"lubricant.kinematic_viscosity_40 = {to_text(sheet[0])} and kinematic_viscosity_100 = "
            f"{to_text(sheet[1])}"
        )
        at = f"lubricant.kinematic_viscosity_{100 if given else 40}"
        draft.refuse(at, what, "both, that at 100 degC the smaller one")
    follows, slope = physics.sheet(oil.temperature, sheet, oil.density_15, oil.thermal_expansion)
    if not draft.is_given("lubricant", "temperature_viscosity"):
        oil.temperature_viscosity = slope
    if not draft.is_given("lubricant", "viscosity"):
        oil.viscosity = follows
        origin = f"the data sheet at {temperature}"
        draft.check_range("lubricant.viscosity", follows, "lubricant.temperature", origin)
    elif abs(oil.viscosity - follows) > ROUNDING * follows:
        given = draft.is_given("lubricant", "kinematic_viscosity_40")
        why = (
            f"lubricant.viscosity = {to_text(oil.viscosity)}, and the data sheet gives "
            f"{short(follows)} Pa s at {temperature}"
        )
        other = "lubricant.kinematic_viscosity_40" if given else "lubricant.name"
        draft.contradict("lubricant.viscosity", other, "viscosity, or what gives it", why)


def _check_use_of_sheet(draft: Draft) -> None:
    """Refuse keys that mean nothing without the viscosities of a data sheet."""
    oil = draft.settings.lubricant
    for key in ("temperature", "density_15", "thermal_expansion"):
        # temperature and expansion serve laws of viscosity and density under temperature as well
        used = oil.knows_temperature or (key != "density_15" and oil.temperature_viscosity > 0.0)
        if used or not draft.is_given("lubricant", key):
            continue
        expected = (
            "kinematic_viscosity_40 and kinematic_viscosity_100 beside it, temperature_viscosity, "
            "or viscosity at the inlet temperature alone"
        )
        what = f"lubricant.{key} without the viscosities of the data sheet"
        draft.refuse(f"lubricant.{key}", what, expected)


def complete_alpha(draft: Draft) -> None:
    """Find alpha beside a data sheet, which has none.

    That of Roelands' law with a z that does not change with temperature, the given one or that of
    a mineral oil.
    """
    oil = draft.settings.lubricant
    if draft.is_given("lubricant", "pressure_viscosity"):
        return
    oil.alpha_origin = "given"
    if oil.own_law:
        return
    if oil.kinematic_viscosity_40 <= 0.0:
        if draft.settings.contact.si and draft.is_given("lubricant", "viscosity"):
            oil.alpha_origin = "default"
        return
    z = oil.roelands_z
    if not draft.is_given("lubricant", "roelands_z"):
        z, oil.alpha_origin = MINERAL_Z, "estimated"
    oil.pressure_viscosity = z * (math.log(oil.viscosity) + 9.67) / oil.roelands_p0
    draft.check_range(
        "lubricant.pressure_viscosity",
        oil.pressure_viscosity,
        "lubricant.kinematic_viscosity_40",
        f"the data sheet at {to_text(oil.temperature)} degC",
    )


def check_heat(draft: Draft) -> None:
    """Refuse heat without what it needs, and shear heating of the inlet beyond its formula."""
    c, oil = draft.settings.contact, draft.settings.lubricant
    if oil.thermal_friction == "always":
        _need(draft, "thermal_friction", " = 'always'", "sliding speed", ("'auto'", "'auto'"))
    if not oil.thermal_reduction:
        return
    _need(draft, "thermal_reduction", "", "velocity", (".false.", "name"))
    loading = thermal_loading(
        oil.temperature_viscosity, oil.viscosity, c.mean_velocity, oil.thermal_conductivity
    )
    strain = physics.point(draft.settings).pressure / c.reduced_modulus
    reduction = thermal_reduction(loading, strain, c.slide_to_roll)
    if reduction <= 0.0:
        what = (
            f"lubricant.thermal_reduction: the formula gives a film of {short(reduction)} times "
            f"the isothermal one at a thermal loading of {short(loading)}"
        )
        draft.refuse("lubricant.thermal_reduction", what, "a slower contact, or .false.")


def _need(draft: Draft, key: str, value: str, velocity: str, others: tuple[str, str]) -> None:
    """Refuse a key without a velocity in m/s, or how the viscosity falls with temperature."""
    name = f"lubricant.{key}"
    if not draft.settings.contact.si:
        contact = "a contact given by moes_m and moes_l"
        what = f"{name}{value} with {contact}, which has no {velocity} in m/s"
        expected = f"load, mean_velocity, radius and reduced_modulus, or {others[0]}"
        draft.refuse(name, what, expected)
    if draft.settings.lubricant.temperature_viscosity <= 0.0:
        expected = (
            "temperature_viscosity, or kinematic_viscosity_40 and kinematic_viscosity_100, or "
            f"{others[1]}"
        )
        what = f"{name}{value}, and the viscosity by temperature is not known"
        draft.refuse(name, what, expected)
