# SPDX-License-Identifier: BSD-3-Clause
"""The radii of a contact in SI units: one of a round contact, two, or those of both bodies."""

from pyehl.case.draft import Draft
from pyehl.case.number import short
from pyehl.case.settings import KEYS

# Relative difference of values that is none
ROUNDING = 1e-6
RIVALS = ("radius_x", "radius_y", "reduced_modulus", "radius", "moes_m", "moes_l", "radius_ratio")
RIVALS_OF_LINE = ("radius", "reduced_modulus", "moes_m_line", "moes_l_line")


def complete(draft: Draft) -> None:
    """Find both radii, and their ratio, from what was given."""
    _complete_bodies(draft)
    c = draft.settings.contact
    if not c.si:
        return
    c.round = c.is_line or not (c.radius_x > 0.0 or c.radius_y > 0.0)
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
    """Find reduced radii and reduced modulus of the bodies, if one of their keys was given."""
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
    if c.is_line:
        _complete_line(draft, first, follows[0], follows[2])
        return
    # a resolved case has these with the bodies
    values = (c.radius_x, c.radius_y, c.reduced_modulus)
    agrees = [abs(v - f) <= ROUNDING * f for v, f in zip(values, follows, strict=True)]
    for name, agree in zip(RIVALS, [*agrees, *4 * [False]], strict=True):
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
        abs(value - follows) <= ROUNDING * follows
        for value, follows in ((c.radius, radius), (c.reduced_modulus, modulus))
    ]
    for name, agree in zip(RIVALS_OF_LINE, [*agrees, False, False], strict=True):
        if not agree and draft.is_given("contact", name):
            expected = "the bodies, or reduced radius and modulus, or Moes numbers"
            draft.contradict(first, f"contact.{name}", expected)
    _check_open(draft, "radius_x", b.radius_x1, b.radius_x2, radius)
    c.radius, c.reduced_modulus = radius, modulus


def _reduced(one: float, other: float) -> float:
    """R with 1/R = 1/R_1 + 1/R_2, a flat body being 0; 0 where the gap does not open."""
    curvature = 0.0
    for radius in (one, other):
        if radius != 0.0:
            curvature += 1.0 / radius
    return 1.0 / curvature if curvature > 0.0 else 0.0


def _check_open(draft: Draft, name: str, one: float, other: float, reduced: float) -> None:
    """Refuse bodies whose gap does not open in one direction, or hardly does."""
    key = f"bodies.{name}{1 if one < 0.0 or other == 0.0 else 2}"
    if reduced > 0.0:
        draft.check_range(f"contact.{name}", reduced, key, "the bodies")
        return
    if key not in draft.given:
        # a flat body that nobody gave
        key = draft.first_given(known for known in KEYS if known.startswith("bodies."))
    what = (
        f"bodies.{name}1 = {short(one)} and {name}2 = {short(other)}: the gap does not open in "
        "this direction"
    )
    expected = (
        "a convex body, and a concave one (negative) only with a larger radius than the convex one"
    )
    draft.refuse(key, what, expected)
