# SPDX-License-Identifier: BSD-3-Clause
"""Checks and defaults that depend on several keys of a case."""

from collections.abc import Callable
from contextlib import suppress

from pyehl.case import contact, duty, grid, inlet, line, lubricant, roller, surfaces
from pyehl.case.settings import GROUPS, MACHINES, Draft
from pyehl.errors import InputError

Step = Callable[[Draft], None]


def check_time(draft: Draft) -> None:
    """Refuse both a number of steps and a number of periods."""
    time = draft.settings.time
    if time.steps != 0 and time.max_periods != 0:
        what = "time.max_periods contradicts time.steps"
        draft.refuse("time.max_periods", what, "one of the two, the other 0")


def check_no_machine(draft: Draft) -> None:
    """Refuse a machine element where one contact is required."""
    for kind in MACHINES:
        if name := draft.first_given(key.name for key in GROUPS[kind]):
            command = "gear" if kind == "spur_gear" else "bearing"
            what = f"&{kind} is a machine element with many contacts"
            draft.refuse(name, what, f"'pyehl {command}', or a case without &{kind}")


COMPLETIONS: tuple[Step, ...] = (
    surfaces.complete_finish,
    roller.complete,
    contact.check_kind,
    contact.complete_radii,
    lubricant.complete_oil,
    lubricant.complete_viscosity,
    lubricant.complete_alpha,
    lubricant.complete_law,
    duty.complete,
    inlet.complete,
    grid.complete,
    contact.complete_kinematics,
    lubricant.complete,
    surfaces.complete,
    line.complete,
)
STEPS: tuple[Step, ...] = (
    check_no_machine,
    line.check_keys,
    surfaces.complete_finish,
    roller.complete,
    roller.check_keys,
    contact.check_kind,
    contact.complete_radii,
    lubricant.complete_oil,
    lubricant.complete_viscosity,
    lubricant.complete_alpha,
    lubricant.complete_law,
    roller.check_length,
    contact.check_operating_point,
    duty.complete,
    duty.check,
    inlet.complete,
    grid.complete,
    inlet.check,
    grid.check_extent,
    duty.check_domain,
    contact.complete_kinematics,
    lubricant.complete,
    lubricant.check_density,
    lubricant.check_law,
    lubricant.check_shear_law,
    lubricant.check_boundary_film,
    lubricant.check_heat,
    grid.check_points,
    surfaces.complete,
    surfaces.check,
    line.complete,
    check_time,
)


def complete(draft: Draft, *, strict: bool = True) -> None:
    """Complete a case whose keys are all valid by themselves, and check it.

    Without `strict`, derive the values that can be derived, and refuse nothing.
    """
    if strict:
        for step in STEPS:
            step(draft)
        return
    for step in COMPLETIONS:
        with suppress(InputError):
            step(draft)
