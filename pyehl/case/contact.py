# SPDX-License-Identifier: BSD-3-Clause
"""The contact of a case: radii, Moes numbers or SI values, operating point, motion."""

import math
from typing import Any

from pyehl.case import physics
from pyehl.case.groups import Contact
from pyehl.case.key import short, to_text
from pyehl.case.settings import KEYS, Draft

MOES = ("moes_m", "moes_l", "radius_ratio", "moes_m_line", "moes_l_line")
SI = (
    "load",
    "load_per_length",
    "mean_velocity",
    "radius",
    "reduced_modulus",
    "radius_x",
    "radius_y",
)
# Minimum M of a plausible contact; maximum M of a round contact with the same equations
MIN_M, MAX_M = 0.1, 1e5
# Minimum p_h/E' of a plausible contact: 0.1 MPa between steel bodies
MIN_STRAIN = 4e-7
# Difference below which velocity ratios are equal
ROUNDING = 1e-9
# Keys of the operating point, and their usual ranges in powers of ten around the default; for all
# radii around the default of contact.radius
COMMON = {
    "contact.load": 3.0,
    "contact.load_per_length": 3.0,
    "contact.mean_velocity": 2.0,
    "contact.radius": 1.0,
    "contact.reduced_modulus": 0.5,
    "contact.radius_x": 1.0,
    "contact.radius_y": 1.0,
    "lubricant.viscosity": 2.0,
    "lubricant.pressure_viscosity": 0.5,
    "bodies.radius_x1": 1.0,
    "bodies.radius_y1": 1.0,
    "bodies.radius_x2": 1.0,
    "bodies.radius_y2": 1.0,
}


def check_kind(draft: Draft) -> None:
    """Determine whether Moes numbers or SI values define the contact; refuse both."""
    moes = draft.first_given(f"contact.{key}" for key in MOES)
    si = draft.first_given(f"contact.{key}" for key in SI)
    draft.settings.contact.si = not moes
    if moes and si:
        expected = (
            "moes_m, moes_l and radius_ratio, or load, mean_velocity, reduced_modulus and radius "
            "or radius_x and radius_y"
        )
        if draft.settings.contact.is_line:
            expected = (
                "moes_m_line and moes_l_line, or load_per_length, mean_velocity, reduced_modulus "
                "and radius"
            )
        draft.contradict(moes, si, expected)


def is_light(moes_m: float, pressure: float, modulus: float) -> bool:
    """Whether the load is too small for the solver; p_h and reduced modulus in Pa."""
    return moes_m < MIN_M or pressure < MIN_STRAIN * modulus


def check_operating_point(draft: Draft) -> None:
    """Refuse Moes numbers beyond the solver, and implausible SI values: often mistakes in units."""
    c, oil = draft.settings.contact, draft.settings.lubricant
    point = physics.point(draft.settings)
    too_large = (
        "the Moes parameter M of the round contact with the same equations is "
        f"{short(point.round_m)}"
    )
    if not c.si:
        moes_m, moes_l = ("moes_m_line", "moes_l_line") if c.is_line else ("moes_m", "moes_l")
        if point.round_m > MAX_M:
            draft.refuse(f"contact.{moes_m}", too_large, f"a {moes_m} that makes it 1e5 at most")
        if oil.pressure_viscosity <= 0.0 < point.moes_l:
            expected = f"{moes_l} = 0.0, or a pressure_viscosity above 0"
            draft.contradict("lubricant.pressure_viscosity", f"contact.{moes_l}", expected)
        return
    minimum = MIN_STRAIN * c.reduced_modulus
    if draft.may_be_light and is_light(point.moes_m, point.pressure, c.reduced_modulus):
        return
    if not minimum <= point.pressure <= 2e10:
        what = f"the Hertz pressure is {short(point.pressure)} Pa"
        expected = (
            f"a Hertz pressure between {short(minimum)} Pa (4e-7 of reduced_modulus) and 2e10 Pa"
        )
    elif point.length > c.radius_x:
        what = f"the Hertz radius {short(point.length)} m exceeds the reduced radius"
        expected = "a contact much smaller than the reduced radius"
    elif point.moes_m < MIN_M:
        what = f"the Moes parameter M is {short(point.moes_m)}"
        expected = f"M of {MIN_M:g} at least"
    elif point.round_m > MAX_M:
        what, expected = too_large, "an M between 0.1 and 1e5"
    elif point.moes_l > 100.0:
        what = f"the Moes parameter L is {short(point.moes_l)}"
        expected = "L of 100 at most"
    else:
        return
    name = _most_unusual(draft)
    value = to_text(draft.settings.value(KEYS[name]))
    expected = f"values in SI units with {expected}{KEYS[name].in_millimetres(value)}"
    draft.refuse(name, f"{what} with {name} = {value}", expected)


def _most_unusual(draft: Draft) -> str:
    """Find the given key of the operating point with the most unusual value."""
    result, maximum = "lubricant.viscosity", -1.0
    for name, common in COMMON.items():
        key = KEYS[name]
        value: Any = draft.settings.value(key)
        # a radius of 0 is that of a flat body
        if name not in draft.given or (key.group == "bodies" and value == 0.0):
            continue
        usual: Any = Contact().radius if key.key.startswith("radius") else key.default_value
        unusual = abs(math.log10(abs(value) / usual)) / common if value else math.inf
        if unusual > maximum:
            result, maximum = name, unusual
    return result


def complete_kinematics(draft: Draft) -> None:
    """Complete slide-to-roll ratio and velocities of the surfaces from the one that is given.

    Body 1 moves at 1 + SRR/2, body 2 at 1 - SRR/2 times the mean velocity.
    """
    c, first, second = (
        draft.settings.contact,
        draft.settings.surface,
        draft.settings.second_surface,
    )
    given = [draft.is_given(name, "velocity_ratio") for name in ("surface", "second_surface")]
    both = first.velocity_ratio + second.velocity_ratio
    if all(given) and abs(both - 2.0) > ROUNDING:
        expected = (
            "one of the two, or velocity ratios that add up to 2: contact.mean_velocity is the "
            "mean of both bodies"
        )
        why = (
            f"{to_text(first.velocity_ratio)} and {to_text(second.velocity_ratio)} add up to "
            f"{to_text(both)}"
        )
        draft.contradict("surface.velocity_ratio", "second_surface.velocity_ratio", expected, why)
    side = 1.0 if c.rough_surface == 1 else -1.0
    if not draft.is_given("contact", "slide_to_roll"):
        if given[0]:
            c.slide_to_roll = _sliding(side, first.velocity_ratio)
        elif given[1]:
            c.slide_to_roll = _sliding(-side, second.velocity_ratio)
    _settle_velocity(draft, "surface", c.rough_surface)
    _settle_velocity(draft, "second_surface", 3 - c.rough_surface)


def _settle_velocity(draft: Draft, group: str, body: int) -> None:
    """Derive the velocity of the surface of a body; a given one must agree."""
    surface = getattr(draft.settings, group)
    slide_to_roll = draft.settings.contact.slide_to_roll
    side = 1.0 if body == 1 else -1.0
    follows, ratio = 1.0 + 0.5 * side * slide_to_roll, surface.velocity_ratio
    if not draft.is_given(group, "velocity_ratio"):
        surface.velocity_ratio = follows
    elif draft.is_given("contact", "slide_to_roll") and abs(ratio - follows) > ROUNDING:
        expected = (
            f"one of the two, or slide_to_roll = {to_text(_sliding(side, ratio))} with this "
            "velocity_ratio"
        )
        why = (
            f"with contact.slide_to_roll = {to_text(slide_to_roll)}, &{group}, on body {body}, "
            f"moves at {to_text(follows)} times the mean velocity, not at {to_text(ratio)}"
        )
        draft.contradict(f"{group}.velocity_ratio", "contact.slide_to_roll", expected, why)


def _sliding(side: float, ratio: float) -> float:
    """Slide-to-roll ratio of a velocity ratio, without rounding errors: 0.02 for 1.01."""
    return round(side * (ratio - 1.0) * 2e12) / 1e12


# Relative difference below which values are equal
ROUNDING_OF_RADII = 1e-6
# Keys that &bodies exclude; reduced radii and modulus only if they differ from those of the bodies
EXCLUDED = ("radius_x", "radius_y", "reduced_modulus", "radius", "moes_m", "moes_l", "radius_ratio")
EXCLUDED_OF_LINE = ("radius", "reduced_modulus", "moes_m_line", "moes_l_line")


def complete_radii(draft: Draft) -> None:
    """Derive both radii and their ratio from the given keys."""
    _complete_bodies(draft)
    c = draft.settings.contact
    if not c.si:
        return
    c.round = c.is_cylinder or not (c.radius_x > 0.0 or c.radius_y > 0.0)
    if c.round:
        c.radius_x = c.radius_y = c.radius
    elif not (c.radius_x > 0.0 and c.radius_y > 0.0):
        one, other = ("radius_x", "radius_y")[:: 1 if c.radius_x > 0.0 else -1]
        what = f"contact.{one} without contact.{other}"
        draft.refuse(f"contact.{one}", what, "both, or contact.radius of a round contact")
    elif draft.is_given("contact", "radius"):
        one = "radius_x" if draft.is_given("contact", "radius_x") else "radius_y"
        expected = "radius of a round contact, or radius_x and radius_y"
        draft.contradict("contact.radius", f"contact.{one}", expected)
    c.radius_ratio = c.radius_x / c.radius_y
    key = KEYS["contact.radius_ratio"]
    if key.allows(c.radius_ratio):
        return
    bodies = [f"bodies.radius_{end}" for end in ("y1", "y2", "x1", "x2")]
    default = bodies[0] if draft.settings.bodies.given else "contact.radius_y"
    name = next((body for body in bodies if body in draft.given), default)
    remedy = (
        f"radius_x of at most {short(250.0 * c.radius_y)} m"
        if c.radius_ratio > 1.0
        else f"radius_y of at most {short(250.0 * c.radius_x)} m, as of a crowned roller; beyond "
        "that contact.shape = 'line'"
    )
    expected = f"a ratio in {key.allowed}, an ellipse of at most 30 to 1: {remedy}"
    draft.refuse(name, f"radius_x/radius_y is {short(c.radius_ratio)}", expected)


def _complete_bodies(draft: Draft) -> None:
    """Derive reduced radii and reduced modulus of the bodies, if one of their keys was given."""
    b, c = draft.settings.bodies, draft.settings.contact
    first = next((name for name in KEYS if name in draft.given and name[:7] == "bodies."), "")
    b.given = first != ""
    if not first:
        return
    follows = (
        _reduced(b.radius_x1, b.radius_x2),
        _reduced(b.radius_y1, b.radius_y2),
        2.0
        / (
            (1.0 - b.poisson_1 * b.poisson_1) / b.modulus_1
            + (1.0 - b.poisson_2 * b.poisson_2) / b.modulus_2
        ),
    )
    if c.is_cylinder:
        _complete_line(draft, first, follows[0], follows[2])
        return
    # a resolved case has these with the bodies
    values = (c.radius_x, c.radius_y, c.reduced_modulus)
    agrees = [abs(v - f) <= ROUNDING_OF_RADII * f for v, f in zip(values, follows, strict=True)]
    for name, agree in zip(EXCLUDED, [*agrees, *4 * [False]], strict=True):
        if not agree and draft.is_given("contact", name):
            expected = "the bodies, or reduced radii and modulus, or Moes numbers"
            draft.contradict(first, f"contact.{name}", expected)
    c.radius_x, c.radius_y, c.reduced_modulus = follows
    _check_open(draft, "radius_x", b.radius_x1, b.radius_x2, c.radius_x)
    _check_open(draft, "radius_y", b.radius_y1, b.radius_y2, c.radius_y)
    softer = "bodies.modulus_1" if b.modulus_1 < b.modulus_2 else "bodies.modulus_2"
    draft.check_range("contact.reduced_modulus", c.reduced_modulus, softer, "the bodies")


def _complete_line(draft: Draft, first: str, radius: float, modulus: float) -> None:
    """Take reduced radius and modulus of bodies that touch along a line."""
    b, c = draft.settings.bodies, draft.settings.contact
    agrees = [
        abs(value - follows) <= ROUNDING_OF_RADII * follows
        for value, follows in ((c.radius, radius), (c.reduced_modulus, modulus))
    ]
    for name, agree in zip(EXCLUDED_OF_LINE, [*agrees, False, False], strict=True):
        if not agree and draft.is_given("contact", name):
            expected = "the bodies, or reduced radius and modulus, or Moes numbers"
            draft.contradict(first, f"contact.{name}", expected)
    _check_open(draft, "radius_x", b.radius_x1, b.radius_x2, radius)
    draft.check_range("contact.radius", radius, first, "the bodies")
    c.radius, c.reduced_modulus = radius, modulus


def _reduced(one: float, other: float) -> float:
    """R with 1/R = 1/R_1 + 1/R_2, 0 for a flat body; 0 if the gap does not open."""
    curvature = 0.0
    for radius in (one, other):
        if radius != 0.0:
            curvature += 1.0 / radius
    return 1.0 / curvature if curvature > 0.0 else 0.0


def _check_open(draft: Draft, name: str, one: float, other: float, reduced: float) -> None:
    """Refuse bodies whose gap does not open in one direction, or barely does."""
    key = f"bodies.{name}{1 if one < 0.0 or other == 0.0 else 2}"
    if reduced > 0.0:
        draft.check_range(f"contact.{name}", reduced, key, "the bodies")
        return
    if key not in draft.given:
        # a flat body that was not set
        key = draft.first_given(known for known in KEYS if known.startswith("bodies."))
    what = (
        f"bodies.{name}1 = {short(one)} and {name}2 = {short(other)}: the gap does not open in "
        "this direction"
    )
    expected = (
        "a convex body, and a concave one (negative) only with a larger radius than the convex one"
    )
    draft.refuse(key, what, expected)
