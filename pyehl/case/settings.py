# SPDX-License-Identifier: BSD-3-Clause
"""All groups of a case with their values, and the table of keys that follows from them."""

from collections.abc import Iterator
from dataclasses import dataclass, field, fields
from typing import Any

from pyehl.case.groups import Bodies, Contact, Grid, Inlet, Output, Psd, Solver, Time
from pyehl.case.key import Key, Value
from pyehl.case.lubricant_group import Lubricant
from pyehl.case.machine_groups import BallBearing, RollerBearing, SpurGear
from pyehl.case.surface_group import Surface


@dataclass(slots=True)
class Settings:
    """Values of a case by group."""

    contact: Contact = field(default_factory=Contact)
    bodies: Bodies = field(default_factory=Bodies)
    lubricant: Lubricant = field(default_factory=Lubricant)
    inlet: Inlet = field(default_factory=Inlet)
    grid: Grid = field(default_factory=Grid)
    surface: Surface = field(default_factory=Surface)
    second_surface: Surface = field(default_factory=Surface)
    time: Time = field(default_factory=Time)
    solver: Solver = field(default_factory=Solver)
    psd: Psd = field(default_factory=Psd)
    output: Output = field(default_factory=Output)
    ball_bearing: BallBearing = field(default_factory=BallBearing)
    roller_bearing: RollerBearing = field(default_factory=RollerBearing)
    spur_gear: SpurGear = field(default_factory=SpurGear)

    def value(self, key: Key) -> Value:
        """Give the value of a key."""
        found: Value = getattr(getattr(self, key.group), key.key)
        return found

    def set(self, key: Key, value: Value) -> None:
        """Give a key a value."""
        setattr(getattr(self, key.group), key.key, value)


def _keys() -> Iterator[Key]:
    for group in fields(Settings):
        kind: Any = group.default_factory
        for key in fields(kind):
            if key.metadata:
                default: Any = key.default
                yield Key(group.name, key.name, **key.metadata, default_value=default)


KEYS: dict[str, Key] = {key.name: key for key in _keys()}
"""All keys by ``group.key``, in order."""
GROUPS: dict[str, list[Key]] = {
    group.name: [key for key in KEYS.values() if key.group == group.name]
    for group in fields(Settings)
}
"""Keys by group."""
MACHINES = ("ball_bearing", "roller_bearing", "spur_gear")
"""Groups of machine elements, from which the contacts follow; no case of one contact has them."""
