# SPDX-License-Identifier: BSD-3-Clause
"""The lubricant of a case: oils by name, temperature, laws of viscosity, density and stress."""

import math
import os

import numpy as np

from pyehl.case import physics
from pyehl.case.key import short, to_text
from pyehl.case.oils import OILS, read_table
from pyehl.case.settings import GROUPS, Draft
from pyehl.case.writer import group_text
from pyehl.errors import InputError
from pyehl.theory.heat import thermal_loading, thermal_reduction

# Relative difference below which values are equal
ROUNDING = 1e-6
# A law must have a viscosity up to this multiple of the Hertz pressure; number of steps to check it
BEYOND_HERTZ, STEPS = 1.5, 300
# Validity range of a table at a single temperature [K]
SAME_TEMPERATURE = 0.01
# Laws without constants of an oil, which increase up to any pressure
SIMPLE_VISCOSITY, SIMPLE_DENSITY = ("roelands", "barus"), ("dowson-higginson", "incompressible")
# Roelands exponents of liquids: water has 0.04, mineral oils 0.6
MIN_Z, MAX_Z = 1e-3, 2.0
CONTACT_IN_SI = "load, mean_velocity, radius and reduced_modulus"


def complete_oil(draft: Draft) -> None:
    """Set the keys that are not given to the constants of the oil, and locate a table."""
    oil = draft.settings.lubricant
    # the data sheet would override the given constants
    vogel = draft.is_given("lubricant", "vogel_viscosity", "vogel_b", "vogel_c")
    for constant in OILS[oil.name].constants if oil.name else ():
        of_sheet = constant.key.startswith("kinematic_")
        if not (vogel and of_sheet) and not draft.is_given("lubricant", constant.key):
            setattr(oil, constant.key, constant.value)
    if not draft.is_given("lubricant", "viscosity_law") and oil.own_law:
        oil.viscosity_law = oil.own_law
    # the constants of Doolittle's law were determined with Tait's volumes
    if not draft.is_given("lubricant", "density_law") and oil.own_law == "doolittle":
        oil.density_law = "tait"
    oil.inlet_law = oil.own_law if oil.own_law != oil.viscosity_law else ""
    if oil.table:
        oil.table = draft.absolute("lubricant.table", oil.table)
    elif oil.viscosity_law == "table" and not oil.table_pressure:
        what = "lubricant.viscosity_law = 'table' without lubricant.table"
        expected = "table = '...', a CSV of measured viscosities"
        draft.refuse("lubricant.viscosity_law", what, expected)


def complete_law(draft: Draft) -> None:
    """Derive viscosity, alpha and temperature coefficient of the inlet by the law of the oil."""
    oil = draft.settings.lubricant
    own = oil.own_law
    if not own:
        return
    _check_constants(draft)
    if own == "table":
        _take_table(draft)
    laws = group_text(draft.settings, "lubricant", {"viscosity_law": own})
    viscosity, alpha, slope = physics.inlet(laws)
    if not math.isfinite(viscosity):
        what = f"the law '{own}' has no viscosity at {to_text(oil.temperature)} degC"
        expected = "a temperature and constants at which the oil is liquid"
        draft.refuse(_law_key(draft), what, expected)
    _follow(draft, "viscosity", viscosity)
    _follow(draft, "pressure_viscosity", alpha)
    # a given value is the temperature coefficient of the laws of Roelands and Barus, and of a table
    # at a single temperature
    if not draft.is_given("lubricant", "temperature_viscosity"):
        oil.temperature_viscosity = slope


def _take_table(draft: Draft) -> None:
    """Read a table, and set its range unless the keys of the range are given."""
    oil = draft.settings.lubricant
    # a resolved case contains its table, whose file may be elsewhere
    if oil.table and not (oil.table_pressure and not os.path.exists(oil.table)):
        states = read_table(oil.table)
        oil.table_temperature = tuple(state.temperature for state in states)
        oil.table_pressure = tuple(state.pressure for state in states)
        oil.table_viscosity = tuple(state.viscosity for state in states)
    coldest, warmest = oil.table_temperature[0], oil.table_temperature[-1]
    if coldest == warmest and abs(coldest - oil.temperature) > SAME_TEMPERATURE:
        raise InputError(
            f"{oil.table}: error: the table has the single temperature {to_text(coldest)} degC, "
            f"and lubricant.temperature = {to_text(oil.temperature)}\n"
            "expected: that temperature, or a table of two or more"
        )
    if not draft.is_given("lubricant", "range_temperature_min"):
        oil.range_temperature_min = coldest
    if not draft.is_given("lubricant", "range_temperature_max"):
        oil.range_temperature_max = warmest
    if not draft.is_given("lubricant", "range_pressure_max"):
        # the highest at each temperature
        highest = dict(zip(oil.table_temperature, oil.table_pressure, strict=True))
        oil.range_pressure_max = min(highest.values())


def _follow(draft: Draft, key: str, derived: float) -> None:
    """Set a key that is not given to its derived value; refuse a given value that differs."""
    oil, by, name = draft.settings.lubricant, _law_key(draft), f"lubricant.{key}"
    temperature = f"{to_text(oil.temperature)} degC"
    value: float = getattr(oil, key)
    if not draft.is_given("lubricant", key):
        setattr(oil, key, derived)
        draft.check_range(name, derived, by, f"{by} at {temperature}")
    elif abs(value - derived) > ROUNDING * derived:
        why = f"{name} = {to_text(value)}, and the law gives {short(derived)} at {temperature}"
        draft.contradict(name, by, f"{key}, or the law that gives it", why)


def _law_key(draft: Draft) -> str:
    """Give the key that selects the law."""
    for key in ("table", "name"):
        if draft.is_given("lubricant", key):
            return f"lubricant.{key}"
    return "lubricant.viscosity_law"


def _check_constants(draft: Draft) -> None:
    """Refuse a law without the constants that it needs."""
    oil = draft.settings.lubricant
    yasutomi = oil.yasutomi_a1 * oil.yasutomi_a2 * oil.yasutomi_c1 * oil.yasutomi_c2
    doolittle = oil.doolittle_viscosity * oil.doolittle_b * oil.doolittle_r0
    vogel = oil.vogel_viscosity > 0.0 and oil.temperature + oil.vogel_c > 0.0
    names = {
        law: [key.key for key in GROUPS["lubricant"] if key.key.startswith(f"{law}_")]
        for law in ("yasutomi", "doolittle", "tait")
    }
    names["yasutomi"].remove("yasutomi_viscosity")
    lists = {law: f"{', '.join(keys[:-1])} and {keys[-1]}" for law, keys in names.items()}
    needs = (
        (
            "dicke",
            oil.kinematic_viscosity_40 > 0.0 or vogel,
            "the viscosity at ambient pressure",
            "vogel_viscosity, vogel_b and vogel_c, or kinematic_viscosity_40 and "
            "kinematic_viscosity_100",
        ),
        (
            "dicke",
            oil.dicke_a1 + oil.dicke_a2 * oil.temperature > 0.0,
            "a positive a1 + a2 theta",
            "dicke_a1, dicke_a2, dicke_b1 and dicke_b2 with a1 + a2 theta above 0",
        ),
        ("yasutomi", yasutomi > 0.0, "all of its constants", lists["yasutomi"]),
        ("doolittle", doolittle > 0.0, "all of its constants", lists["doolittle"]),
        (
            "doolittle",
            oil.tait_modulus * oil.tait_rate > 0.0,
            "the volume under pressure",
            lists["tait"],
        ),
    )
    for law, there, missing, expected in needs:
        if not there and oil.uses_law(law):
            what = f"lubricant.viscosity_law = '{law}' without {missing}"
            draft.refuse(_law_key(draft), what, expected)


def complete(draft: Draft) -> None:
    """Set the exponent of Roelands' law, and the law of the prediction."""
    oil, psd = draft.settings.lubricant, draft.settings.psd
    if not draft.is_given("lubricant", "roelands_z"):
        slope = oil.pressure_viscosity * oil.roelands_p0
        oil.roelands_z = slope / (math.log(oil.viscosity) + 9.67)
    psd.viscosity_law = psd.viscosity_law or oil.viscosity_law
    if psd.viscosity_law not in ("roelands", "barus", oil.viscosity_law):
        what = (
            f"psd.viscosity_law = '{psd.viscosity_law}' with lubricant.viscosity_law = "
            f"'{oil.viscosity_law}'"
        )
        expected = "'roelands', 'barus' or that of the lubricant"
        draft.refuse("psd.viscosity_law", what, expected)
    if "roelands" in (oil.viscosity_law, psd.viscosity_law):
        _check_roelands(draft)


def _check_roelands(draft: Draft) -> None:
    """Refuse an exponent that no liquid has, at the key that it follows from."""
    oil = draft.settings.lubricant
    # without alpha the viscosity is constant
    if oil.pressure_viscosity <= 0.0 or MIN_Z <= oil.roelands_z <= MAX_Z:
        return
    # a small one is mostly due to alpha, a large one to the viscosity
    alpha, viscosity = ["pressure_viscosity"], ["viscosity", "kinematic_viscosity_40"]
    by = viscosity + alpha if oil.roelands_z > MAX_Z else alpha + viscosity
    names = ("roelands_z", *by, "roelands_p0")
    at = next((name for name in names if draft.is_given("lubricant", name)), "roelands_z")
    what = f"lubricant.roelands_z = {short(oil.roelands_z)}"
    if at != "roelands_z":
        what += " follows from viscosity, pressure_viscosity and roelands_p0"
    expected = (
        "a number in [0.001, 2] under Roelands' law; or viscosity_law = 'barus', which has no "
        "roelands_z"
    )
    draft.refuse(f"lubricant.{at}", what, expected)


def check_law(draft: Draft) -> None:
    """Refuse a law whose viscosity or density does not increase up to 1.5 times p_h.

    Simple laws increase up to any pressure, and are not checked.
    """
    oil = draft.settings.lubricant
    simple = oil.viscosity_law in SIMPLE_VISCOSITY, oil.density_law in SIMPLE_DENSITY
    hertz = physics.point(draft.settings).pressure
    if all(simple) or not hertz > 0.0:
        return
    pressure = BEYOND_HERTZ * np.arange(STEPS + 1) / STEPS * hertz
    viscosity, density = physics.under_pressure(group_text(draft.settings, "lubricant"), pressure)
    checks = (
        (simple[1], "lubricant.density_law", oil.density_law, "density", density),
        (simple[0], _law_key(draft), oil.viscosity_law, "viscosity", viscosity),
    )
    for is_simple, key, law, what, values in checks:
        with np.errstate(invalid="ignore"):
            falls = np.flatnonzero(~(np.isfinite(values[1:]) & (np.diff(values) > 0.0)))
        if is_simple or falls.size == 0:
            continue
        where = (
            f"{short(pressure[falls[0] + 1])} Pa and {to_text(oil.temperature)} degC, and the "
            f"Hertz pressure is {short(hertz)} Pa"
        )
        draft.refuse(
            key,
            f"the law '{law}' gives no {what} that increases with pressure at {where}",
            f"a law that holds for the {what} up to 1.5 times the Hertz pressure, or a lower load",
        )


def check_shear_law(draft: Draft) -> None:
    """Refuse a shear law without its parameters or without SI units, and two limits of the stress.

    All but the Newtonian law need a contact in SI units.
    """
    oil = draft.settings.lubricant
    if oil.limiting_stress > 0.0 and draft.is_given("lubricant", "limiting_coefficient"):
        expected = "one of the two, or limiting_stress = 0.0"
        draft.contradict("lubricant.limiting_stress", "lubricant.limiting_coefficient", expected)
    name, law = "lubricant.shear_law", f"lubricant.shear_law = '{oil.shear_law}'"
    if oil.shear_law == "newtonian":
        return
    if not draft.settings.contact.si:
        what = f"{law} with a contact given by moes_m and moes_l, which has no sliding speed in m/s"
        draft.refuse(name, what, f"'newtonian', or {CONTACT_IN_SI}")
    if oil.shear_law == "carreau" and not (oil.carreau_stress > 0.0 and oil.carreau_exponent > 0.0):
        what = f"{law} without carreau_stress and carreau_exponent"
        draft.refuse(name, what, "both, as measured for this oil: they differ between oils")


def check_boundary_film(draft: Draft) -> None:
    """Refuse a boundary film without SI units or with Alcouffe coarsening.

    Also refuse boundary friction or a hardness without a boundary film, and a hardness that does
    not exceed the Hertz pressure.
    """
    settings = draft.settings
    film, friction = settings.lubricant.boundary_film, settings.lubricant.boundary_friction
    hardness = settings.contact.hardness
    without = "without lubricant.boundary_film: no solid contact"
    if friction > 0.0 and film <= 0.0:
        what = f"lubricant.boundary_friction = {short(friction)} {without}"
        expected = "a boundary_film in m, or boundary_friction = 0.0"
        draft.refuse("lubricant.boundary_friction", what, expected)
    if hardness > 0.0 and film <= 0.0:
        what = f"contact.hardness = {short(hardness)} {without}"
        draft.refuse("contact.hardness", what, "a boundary_film in m, or hardness = 0.0")
    if film > 0.0 and not settings.contact.si:
        what = (
            f"lubricant.boundary_film = {short(film)} with a contact given by moes_m and moes_l, "
            "which has no size in m"
        )
        draft.refuse("lubricant.boundary_film", what, f"0.0, or {CONTACT_IN_SI}")
    pressure = physics.point(settings).pressure
    if 0.0 < hardness <= pressure:
        what = (
            f"contact.hardness = {short(hardness)} Pa, and the Hertz pressure is "
            f"{short(pressure)} Pa: smooth bodies would yield"
        )
        expected = "more than the Hertz pressure, a lower load, or 0.0 for elastic solids"
        draft.refuse("contact.hardness", what, expected)
    if film > 0.0 and settings.solver.coarsening == "alcouffe":
        draft.contradict(
            "lubricant.boundary_film",
            "solver.coarsening",
            "coarsening = 'auto' or 'classical'",
            "transfers by the conductance do not converge with solid contact",
        )


# Exponent z of Roelands 1966 of a mineral oil
MINERAL_Z = 0.6


def complete_viscosity(draft: Draft) -> None:
    """Derive the viscosity and its temperature coefficient from a data sheet."""
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
    derived, slope = physics.sheet(oil.temperature, sheet, oil.density_15, oil.thermal_expansion)
    if not draft.is_given("lubricant", "temperature_viscosity"):
        oil.temperature_viscosity = slope
    if not draft.is_given("lubricant", "viscosity"):
        oil.viscosity = derived
        origin = f"the data sheet at {temperature}"
        draft.check_range("lubricant.viscosity", derived, "lubricant.temperature", origin)
    elif abs(oil.viscosity - derived) > ROUNDING * derived:
        given = draft.is_given("lubricant", "kinematic_viscosity_40")
        why = (
            f"lubricant.viscosity = {to_text(oil.viscosity)}, and the data sheet gives "
            f"{short(derived)} Pa s at {temperature}"
        )
        other = "lubricant.kinematic_viscosity_40" if given else "lubricant.name"
        draft.contradict(
            "lubricant.viscosity", other, "viscosity, or the values that it follows from", why
        )


def _check_use_of_sheet(draft: Draft) -> None:
    """Refuse keys that have no meaning without the viscosities of a data sheet."""
    oil = draft.settings.lubricant
    for key in ("temperature", "density_15", "thermal_expansion"):
        # laws of viscosity and density over temperature also use temperature and expansion
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
    """Estimate alpha for a data sheet, which has none.

    By Roelands' law with a z that does not change with temperature: the given one, or that of a
    mineral oil.
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
    """Refuse heating without the keys that it needs, or outside the range of the inlet formula."""
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
    """Refuse a key without a velocity in m/s, or without the viscosity by temperature.

    `others`: values of the key that need neither, for the two messages.
    """
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


def check_density(draft: Draft) -> None:
    """Refuse a law of density without its constants, or with a second expansion coefficient.

    Also refuse a range of temperatures whose ends are exchanged.
    """
    oil = draft.settings.lubricant
    law = f"lubricant.density_law = '{oil.density_law}'"
    missing = f"{law} without its constants"
    if oil.density_law == "murnaghan" and oil.murnaghan_modulus * oil.murnaghan_rate <= 0.0:
        expected = "murnaghan_modulus, murnaghan_rate and murnaghan_softening"
        draft.refuse("lubricant.density_law", missing, expected)
    if oil.density_law == "tait":
        if oil.tait_modulus * oil.tait_rate <= 0.0:
            expected = (
                "tait_modulus, tait_rate, tait_softening, tait_expansion and tait_temperature"
            )
            draft.refuse("lubricant.density_law", missing, expected)
        given = draft.is_given("lubricant", "thermal_expansion")
        if given and oil.kinematic_viscosity_40 <= 0.0:
            what = f"lubricant.thermal_expansion with {law}, which has its own"
            draft.refuse("lubricant.thermal_expansion", what, "tait_expansion alone")
    low, high = oil.range_temperature_min, oil.range_temperature_max
    if high < low:
        what = (
            f"lubricant.range_temperature_max = {to_text(high)} below range_temperature_min = "
            f"{to_text(low)}"
        )
        expected = "a range of temperatures, or both 0"
        draft.refuse("lubricant.range_temperature_max", what, expected)
