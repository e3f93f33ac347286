# SPDX-License-Identifier: BSD-3-Clause
"""A case on its way to be complete: values, where they came from, and refusals at their place."""

import os
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import NamedTuple, NoReturn

from pyehl.case.number import short
from pyehl.case.settings import KEYS, Settings
from pyehl.case.source import Source
from pyehl.errors import InputError

LONGEST_PATH = 1024
"""Of a file name, in bytes."""


class Place(NamedTuple):
    """Where a key was given: number of the source (0: the file), its name and its value."""

    source: int
    first: int
    name_end: int
    value_first: int
    value_end: int


@dataclass(slots=True)
class Draft:
    """Values of a case that is read.

    Attributes
    ----------
    settings
        All values.
    sources
        Where they came from: the case file, then the options.
    given
        Places of the keys that were given, by ``group.key``.
    """

    settings: Settings
    sources: list[Source]
    given: dict[str, Place] = field(default_factory=dict)

    def is_given(self, group: str, *keys: str) -> bool:
        """Whether one of some keys of a group was given."""
        return any(f"{group}.{key}" in self.given for key in keys)

    def first_given(self, names: Iterable[str]) -> str:
        """Of some keys give the one that stands first: file before options; '' for none."""
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
        """Refuse two keys that exclude each other, at the one that stands later."""
        if one not in self.given or (other in self.given and self.given[one] < self.given[other]):
            one, other = other, one
        what = f"{one} contradicts {other}" + (f": {why}" if why else "")
        place = self.given[one]
        self.sources[place.source].refuse(place.first, place.name_end, what, expected)

    def check_range(self, name: str, value: float, culprit: str, origin: str) -> None:
        """Refuse a value that nobody gave and that its range does not allow, at its culprit."""
        key = KEYS[name]
        if not key.allows(value):
            what = f"{name} = {short(value)} follows from {origin}"
            self.refuse(culprit, what, key.expected)

    def absolute(self, name: str, path: str) -> str:
        """Make the name of a file absolute.

        One in the case file starts at the folder of that file, one in an option at the working
        folder.
        """
        if path[:1] != "/":
            if name in self.given and self.given[name].source == 0:
                origin = self.sources[0].name
                path = origin[: origin.rfind("/") + 1] + path
            if path[:1] != "/":
                path = f"{os.getcwd()}/{path}"
        if path.endswith(" "):
            # a namelist cannot tell it from the name without
            self.refuse(name, f"{name}: the name ends with a blank", "a file of another name")
        if len(os.fsencode(path)) > LONGEST_PATH:
            what = f"{name}: the full name is longer than {LONGEST_PATH} characters"
            self.refuse(name, what, "a shorter path")
        return path
