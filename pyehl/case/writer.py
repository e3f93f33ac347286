# SPDX-License-Identifier: BSD-3-Clause
"""A resolved case as namelist text with every value, which reads back as the same case."""

from collections.abc import Collection, Iterator, Mapping
from functools import cache

from pyehl.case import roller
from pyehl.case.key import Key, Value, to_text
from pyehl.case.settings import GROUPS, MACHINES, Settings

OPTIONAL = (
    *("name", "table", "inlet_law"),
    *("table_temperature", "table_pressure", "table_viscosity"),
)
"""Keys of the lubricant that are written where they have a value."""
LINE_ALONE = ("shape", "load_per_length", "moes_m_line", "moes_l_line")
POINT_ALONE = ("load", "moes_m", "moes_l", "radius_ratio", "angle")
"""Keys of a line, and keys that a line does not have."""
LAWS = {
    "vogel": "dicke",
    "dicke": "dicke",
    "yasutomi": "yasutomi",
    "doolittle": "doolittle",
    "tait": "doolittle",
}
"""Laws of viscosity by the prefix of the keys of their constants."""


def case_text(settings: Settings, given: Collection[str]) -> str:
    """Give a case as text.

    Of mutually exclusive keys only the effective one is written. Values that are not among those
    `given` are marked as defaults, or as derived from others. A second surface that is not set is
    omitted.
    """
    blocks = []
    for group, keys in GROUPS.items():
        if group in MACHINES or (
            group == "second_surface"
            and settings.second_surface.kind == "smooth"
            and not any(name.startswith("second_surface.") for name in given)
        ):
            continue
        owner, lines = getattr(settings, group), []
        unwritten = _unwritten(settings, group)
        for key in keys:
            if key.key in unwritten:
                continue
            value = getattr(owner, key.key)
            if key.name in given:
                lines.append(_line(key, value))
            elif value == key.default_value:
                lines.append(_default_line(key))
            else:
                lines.append(f"{_line(key, value)} ! derived")
        if lines:
            blocks.append("\n".join([f"&{group}", *lines, "/\n"]))
    return "".join(blocks)


def group_text(settings: Settings, group: str, other: Mapping[str, Value] | None = None) -> str:
    """Give a group as text for the solver, with some other values."""
    owner, unwritten = getattr(settings, group), _unwritten(settings, group)
    lines = []
    for key in GROUPS[group]:
        if key.key not in unwritten:
            value = (
                getattr(owner, key.key) if other is None or key.key not in other else other[key.key]
            )
            lines.append(f"{key.key} = {to_text(value)}")
    return "\n".join([f"&{group}", *lines, "/\n"])


@cache
def _ends(key: Key) -> tuple[str, str]:
    """Give the text before and after a value."""
    unit = "" if key.unit == "-" else f"[{key.unit}] "
    return f"   {key.key} = ", f"! {unit}{key.meaning}"


def _line(key: Key, value: Value) -> str:
    before, after = _ends(key)
    return f"{before + to_text(value):<43} {after}"


@cache
def _default_line(key: Key) -> str:
    return f"{_line(key, key.default_value)} ! default"


def _unwritten(settings: Settings, group: str) -> frozenset[str]:
    """Keys of a group that have no value, or that are excluded by another key."""
    if group == "contact":
        return frozenset(_of_contact(settings))
    if group in ("bodies", "inlet"):
        holds = settings.bodies.given if group == "bodies" else settings.inlet.is_starved
        return frozenset(() if holds else (key.key for key in GROUPS[group]))
    if group == "lubricant":
        return frozenset(_of_lubricant(settings))
    if group in ("surface", "second_surface"):
        return frozenset(_of_surface(settings, group))
    if group == "duty":
        return frozenset(_of_duty(settings))
    cylinder = settings.contact.is_cylinder and group == "grid"
    rows = ("points_y",) if settings.contact.is_line else ()
    return frozenset(("y_extent", *rows) if cylinder else ())


def _of_contact(settings: Settings) -> Iterator[str]:
    c = settings.contact
    if c.is_roller:
        yield from (*LINE_ALONE[1:], "angle", *roller.unused(c))
    else:
        yield from POINT_ALONE if c.is_line else LINE_ALONE
        yield from roller.KEYS
    if c.si:
        yield from ("moes_m", "moes_l", "radius_ratio", "moes_m_line", "moes_l_line")
        yield from ("radius_x", "radius_y") if c.round else ("radius",)
    else:
        yield from ("load", "load_per_length", "mean_velocity", "reduced_modulus")
        yield from ("radius", "radius_x", "radius_y")
    for key in ("hardness", "thermal_conductivity_2", "thermal_diffusivity_2"):
        if getattr(c, key) <= 0.0:
            yield key


def _of_lubricant(settings: Settings) -> Iterator[str]:
    oil = settings.lubricant
    yield from (key for key in OPTIONAL if not getattr(oil, key))
    if oil.alpha_origin == "given":
        yield "alpha_origin"
    sheet = oil.kinematic_viscosity_40 > 0.0
    with_temperature = oil.knows_temperature or oil.temperature_viscosity > 0.0
    if not with_temperature:
        yield "temperature"
    if not (sheet if oil.density_law == "tait" else with_temperature):
        yield "thermal_expansion"
    if not sheet:
        yield "density_15"
    if oil.limiting_stress > 0.0:
        yield "limiting_coefficient"
    for key in GROUPS["lubricant"]:
        law = key.key.partition("_")[0]
        if (
            (law in LAWS and not oil.uses_law(LAWS[law]) and law != oil.density_law)
            or (law == "murnaghan" != oil.density_law)
            or (law == "range" and not oil.own_law)
        ):
            yield key.key


def _of_duty(settings: Settings) -> Iterator[str]:
    duty = settings.duty
    for key in GROUPS["duty"]:
        if not duty.time or (key.kind in ("path", "numbers") and not getattr(duty, key.key)):
            yield key.key


def _of_surface(settings: Settings, group: str) -> Iterator[str]:
    surface = getattr(settings, group)
    if (
        surface.amplitude_given
        or surface.height_m > 0.0
        or not (surface.kind == "harmonic" or surface.is_feature)
    ):
        yield "amplitude_over_film"
    if not surface.amplitude_given:
        yield "amplitude"
    if surface.width_m > 0.0:
        yield "width"
    if surface.length_m > 0.0:
        yield "length"
