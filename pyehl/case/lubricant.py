# SPDX-License-Identifier: BSD-3-Clause
"""The lubricant of a case: oils by name, laws of viscosity and of the shear stress."""

import math
import os

import numpy as np

from pyehl.case import physics
from pyehl.case.draft import Draft
from pyehl.case.number import short, to_text
from pyehl.case.oils import OILS
from pyehl.case.settings import GROUPS
from pyehl.case.viscosity_table import read_table
from pyehl.case.writer import group_text
from pyehl.errors import InputError

# Relative difference of values that is none
ROUNDING = 1e-6
# Maximum pressure at which a law must tell a viscosity, over the Hertz pressure; in so many steps
BEYOND_HERTZ, STEPS = 1.5, 300
# A table of a single temperature holds within that [K]
SAME_TEMPERATURE = 0.01
# Laws without constants of an oil, which rise up to any pressure
SIMPLE_VISCOSITY, SIMPLE_DENSITY = ("roelands", "barus"), ("dowson-higginson", "incompressible")
# Roelands exponents of liquids: water has 0.04, mineral oils 0.6
LEAST_Z, LARGEST_Z = 1e-3, 2.0
CONTACT_IN_SI = "load, mean_velocity, radius and reduced_modulus"


def complete_oil(draft: Draft) -> None:
    """Take the constants of an oil where their keys are not given, and find a table."""
    oil = draft.settings.lubricant
    # the data sheet would rule over what was given
    vogel = draft.is_given("lubricant", "vogel_viscosity", "vogel_b", "vogel_c")
    for constant in OILS[oil.name].constants if oil.name else ():
        of_sheet = constant.key.startswith("kinematic_")
        if not (vogel and of_sheet) and not draft.is_given("lubricant", constant.key):
            setattr(oil, constant.key, constant.value)
    if not draft.is_given("lubricant", "viscosity_law") and oil.own_law:
        oil.viscosity_law = oil.own_law
    # its constants hold with that volume
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
    """Find viscosity, alpha and fall with temperature at the inlet by the law that gives them."""
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
    # an own value is another slope of the temperature in the laws of Roelands and Barus, and that
    # of a table of a single temperature
    if not draft.is_given("lubricant", "temperature_viscosity"):
        oil.temperature_viscosity = slope


def _take_table(draft: Draft) -> None:
    """Read a table, and take its range where the keys of that are not given."""
    oil = draft.settings.lubricant
    # a resolved case holds its table, whose file may be elsewhere
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


def _follow(draft: Draft, key: str, follows: float) -> None:
    """Take a value that follows where its key is not given, else it must be the given one."""
    oil, by, name = draft.settings.lubricant, _law_key(draft), f"lubricant.{key}"
    temperature = f"{to_text(oil.temperature)} degC"
    value: float = getattr(oil, key)
    if not draft.is_given("lubricant", key):
        setattr(oil, key, follows)
        draft.check_range(name, follows, by, f"{by} at {temperature}")
    elif abs(value - follows) > ROUNDING * follows:
        why = f"{name} = {to_text(value)}, and the law gives {short(follows)} at {temperature}"
        draft.contradict(name, by, f"{key}, or the law that gives it", why)


def _law_key(draft: Draft) -> str:
    """Give the key that asks for the law."""
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
    """Find the exponent of Roelands' law, and the law of the prediction."""
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
    """Refuse an exponent that no liquid has, at the key that it is from."""
    oil = draft.settings.lubricant
    # without alpha the law has nothing to say
    if oil.pressure_viscosity <= 0.0 or LEAST_Z <= oil.roelands_z <= LARGEST_Z:
        return
    # a small one mostly has its reason in alpha, a large one in the viscosity
    alpha, viscosity = ["pressure_viscosity"], ["viscosity", "kinematic_viscosity_40"]
    by = viscosity + alpha if oil.roelands_z > LARGEST_Z else alpha + viscosity
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
    """Refuse laws that do not tell viscosity and density over all pressures of the contact."""
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
            f"the law '{law}' has no {what} that rises with pressure at {where}",
            f"a law that holds for the {what} up to 1.5 times the Hertz pressure, or a lower load",
        )


def check_shear_law(draft: Draft) -> None:
    """Refuse a shear law without its parameters; one with a stress needs a contact in SI units."""
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
        draft.refuse(name, what, "both, as measured for the oil: no two oils share them")


def check_boundary_film(draft: Draft) -> None:
    """Refuse a boundary film without a size, what needs one, and a hardness that is too low."""
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
