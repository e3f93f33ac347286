# SPDX-License-Identifier: BSD-3-Clause
"""A starved inlet: position of the meniscus, or thickness of the oil layer."""

from collections.abc import Mapping
from typing import Any

from pyehl.case import physics
from pyehl.case.grid import BEYOND_CONTACT
from pyehl.case.key import short
from pyehl.case.settings import Draft
from pyehl.errors import InputError

KEYS = ("position", "position_hertz", "film", "film_hertz")
NAMES = tuple(f"inlet.{key}" for key in KEYS)
ROUNDING = 1e-6
"""Relative difference below which values are equal."""


def complete(draft: Draft) -> None:
    """Convert the inlet to Hertz units."""
    s, inlet = draft.settings, draft.settings.inlet
    if not s.contact.si or not max(inlet.position, inlet.film) > 0.0:
        return
    length = physics.point(s).length
    if not draft.is_given("inlet", "position_hertz"):
        inlet.position_hertz = inlet.position / length
    if not draft.is_given("inlet", "film_hertz"):
        inlet.film_hertz = inlet.film / (length**2 / s.contact.radius_x)


def check(draft: Draft) -> None:
    """Refuse an inlet that contradicts itself or other keys, or is inside the contact."""
    s, inlet = draft.settings, draft.settings.inlet
    key = draft.first_given(NAMES)
    if not s.contact.si and max(inlet.position, inlet.film) > 0.0:
        name = "inlet.position" if inlet.position > 0.0 else "inlet.film"
        draft.refuse(name, f"{name} in metres with Moes numbers", f"{name}_hertz, in a or a^2/R")
    position, film = inlet.position_hertz, inlet.film_hertz
    if position > 0.0 and film > 0.0:
        what = "inlet.position with inlet.film"
        draft.refuse(key, what, "one of them: the oil begins where the layer fills the gap")
    if inlet.passages > 1 and not film > 0.0:
        what = "inlet.passages without inlet.film"
        draft.refuse("inlet.passages", what, "the layer of the first passage")
    if not inlet.is_starved:
        return
    point = physics.point(s)
    scale = point.length**2 / s.contact.radius_x if s.contact.si else 0.0
    _agree(draft, "inlet.position", "inlet.position_hertz", inlet.position, position * point.length)
    _agree(draft, "inlet.film", "inlet.film_hertz", inlet.film, film * scale)
    if s.grid.border == "flooded":
        draft.contradict("grid.border", key, "grid.border = 'zero' or none")
    if position > 0.0:
        _agree(draft, "inlet.position", "grid.x_inlet", position, -s.grid.x_inlet)
        minimum = BEYOND_CONTACT * point.reach_x
        if position < minimum:
            what = (
                f"{key} is {short(position)} a ahead of the centre, and the contact reaches to "
                f"{short(point.reach_x)} a"
            )
            draft.refuse(key, what, f"at least {short(minimum)} a")
        draft.check_range("inlet.position_hertz", position, key, f"{key} and the contact")
        return
    draft.check_range("inlet.film_hertz", film, key, f"{key} and the contact")
    boundary = s.lubricant.boundary_film
    if s.contact.si and film * scale < boundary * (1.0 - ROUNDING):
        what = f"{key} = {short(film * scale)} m is below the boundary film of {short(boundary)} m"
        draft.refuse(key, what, "a layer above lubricant.boundary_film")
    if s.duty.time and inlet.passages > 1:
        expected = "one of the two: the layer of a duty is duty.inlet_film"
        draft.refuse("inlet.passages", "inlet.passages with a duty", expected)
    for group in ("surface", "second_surface"):
        kind = getattr(s, group).kind
        if kind != "smooth":
            what = f"{group}.kind = '{kind}' with {key}"
            expected = "smooth surfaces, or inlet.position for a rough contact that is starved"
            draft.refuse(f"{group}.kind", what, expected)


def _agree(draft: Draft, one: str, other: str, value: float, follows: float) -> None:
    """Refuse two keys if the value of `one`, unless 0, differs from that which follows."""
    if value > 0.0 and abs(value - follows) > ROUNDING * value:
        draft.contradict(one, other, "one of the two")


def refuse_inlet(settings: Mapping[str, Any], what: str, expected: str) -> None:
    """Refuse a resolved case with a starved inlet where a flooded one is required."""
    if settings.get("inlet"):
        raise InputError(f"&inlet: {what}\nexpected: {expected}")
