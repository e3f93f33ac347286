# SPDX-License-Identifier: BSD-3-Clause
"""The groups of a case with their values and keys, and a case while it is completed."""

import os
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, fields
from typing import Any, NamedTuple, NoReturn

from pyehl.case.groups import Bodies, Contact, Duty, Grid, Inlet, Output, Psd, Solver, Time
from pyehl.case.key import Key, Value, short
from pyehl.case.lubricant_group import Lubricant
from pyehl.case.machine_groups import BallBearing, RollerBearing, SpurGear
from pyehl.case.source import Source
from pyehl.case.surface_group import Surface
from pyehl.errors import InputError


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
    duty: Duty = field(default_factory=Duty)
    solver: Solver = field(default_factory=Solver)
    psd: Psd = field(default_factory=Psd)
    output: Output = field(default_factory=Output)
    ball_bearing: BallBearing = field(default_factory=BallBearing)
    roller_bearing: RollerBearing = field(default_factory=RollerBearing)
    spur_gear: SpurGear = field(default_factory=SpurGear)

    def value(self, key: Key) -> Value:
        """Give the value of a key."""
        result: Value = getattr(getattr(self, key.group), key.key)
        return result

    def set(self, key: Key, value: Value) -> None:
        """Set the value of a key."""
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

LONGEST_PATH = 1024
"""Maximum length of a file name in bytes."""


class Place(NamedTuple):
    """Where a key was given: number of the source (0: the file), its name and its value."""

    source: int
    first: int
    name_end: int
    value_first: int
    value_end: int


@dataclass(slots=True)
class Draft:
    """A case while it is read and completed.

    Attributes
    ----------
    settings
        All values.
    sources
        Where they came from: the case file, then the options.
    given
        Places of the keys that were given, by ``group.key``.
    may_be_light
        Whether a very low load is plausible, as for one of many contacts of a machine.
    """

    settings: Settings
    sources: list[Source]
    given: dict[str, Place] = field(default_factory=dict)
    may_be_light: bool = False

    def is_given(self, group: str, *keys: str) -> bool:
        """Whether one of some keys of a group was given."""
        return any(f"{group}.{key}" in self.given for key in keys)

    def first_given(self, names: Iterable[str]) -> str:
        """Give the first of some keys that was given, file before options; '' for none."""
        return min(
            (n for n in names if n in self.given), key=lambda n: self.given[n][:2], default=""
        )

    def refuse(self, name: str, what: str, expected: str) -> NoReturn:
        """Refuse the case at the value of a key."""
        place = self.given.get(name)
        if place is None:
            raise InputError(f"{self.sources[0].name}: error: {what}\nexpected: {expected}")
        source = self.sources[place.source]
        source.refuse(place.value_first, place.value_end, what, expected)

    def contradict(self, one: str, other: str, expected: str, why: str = "") -> NoReturn:
        """Refuse two keys that exclude each other, at the later one."""
        if one not in self.given or (other in self.given and self.given[one] < self.given[other]):
            one, other = other, one
        what = f"{one} contradicts {other}" + (f": {why}" if why else "")
        place = self.given[one]
        self.sources[place.source].refuse(place.first, place.name_end, what, expected)

    def check_range(self, name: str, value: float, origin_key: str, origin: str) -> None:
        """Refuse a derived value outside of its range, at the key that it follows from."""
        key = KEYS[name]
        if not key.allows(value):
            what = f"{name} = {short(value)} follows from {origin}"
            self.refuse(origin_key, what, key.expected)

    def absolute(self, name: str, path: str) -> str:
        """Make the name of a file absolute.

        A name in the case file is relative to the folder of that file, one in an option to the
        working folder.
        """
        if path[:1] != "/":
            if name in self.given and self.given[name].source == 0:
                origin = self.sources[0].name
                path = origin[: origin.rfind("/") + 1] + path
            if path[:1] != "/":
                path = f"{os.getcwd()}/{path}"
        if path.endswith(" "):
            # in a namelist it equals the name without the blank
            self.refuse(name, f"{name}: the name ends with a blank", "a file of another name")
        if len(os.fsencode(path)) > LONGEST_PATH:
            what = f"{name}: the full name is longer than {LONGEST_PATH} bytes"
            self.refuse(name, what, "a shorter path")
        return path
