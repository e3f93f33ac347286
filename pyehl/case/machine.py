# SPDX-License-Identifier: BSD-3-Clause
"""A file that describes a machine element: its group, and the cases of its contacts."""

import copy
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NoReturn

from pyehl.case.complete import complete
from pyehl.case.groups import Bodies
from pyehl.case.key import Value, short, to_text
from pyehl.case.line import LINE_KEYS
from pyehl.case.reader import read
from pyehl.case.settings import GROUPS, KEYS, MACHINES, Draft
from pyehl.case.source import read_text
from pyehl.case.writer import case_text
from pyehl.errors import InputError
from pyehl.given import Option, options_of, path_of

# Keys of a contact that follow from the machine and must not be in its file
FOLLOWS = (
    *(f"contact.{key}" for key in ("moes_m", "moes_l", "radius_ratio", "load", "mean_velocity")),
    *(f"contact.{key}" for key in ("shape", *LINE_KEYS)),
    *(f"contact.{key}" for key in ("radius", "radius_x", "radius_y", "reduced_modulus")),
    *(f"contact.{key}" for key in ("angle", "slide_to_roll")),
    *(f"bodies.radius_{key}" for key in ("x1", "y1", "x2", "y2")),
)
# Keys of the machine that some of them follow from
LOADS = ("radial_load", "axial_load", "torque")
CAUSES = {
    "load": LOADS,
    "load_per_length": LOADS,
    "mean_velocity": ("inner_speed", "outer_speed", "speed"),
}


@dataclass(frozen=True, slots=True)
class Machine:
    """A machine element, with the keys that its contacts have in common.

    Attributes
    ----------
    kind
        Its group, one of `MACHINES`.
    values
        The group, typed.
    draft
        The file as it was read, with the places of the given keys.
    """

    kind: str
    values: Any
    draft: Draft

    @property
    def reduced_modulus(self) -> float:
        """E' of ``&bodies`` [Pa], 2/E' = sum of (1 - nu^2)/E."""
        b = self.draft.settings.bodies
        one, other = (1.0 - b.poisson_1**2) / b.modulus_1, (1.0 - b.poisson_2**2) / b.modulus_2
        return 2.0 / (one + other)

    def refuse(self, key: str, what: str, expected: str) -> NoReturn:
        """Refuse the machine at a key of its group, or at the first given one."""
        name = f"{self.kind}.{key}"
        self.draft.refuse(name if name in self.draft.given else self._first(), what, expected)

    def is_given(self, key: str) -> bool:
        """Whether a key of its group was given."""
        return f"{self.kind}.{key}" in self.draft.given

    def _first(self) -> str:
        return self.draft.first_given(key.name for key in GROUPS[self.kind])

    def _cause(self, name: str) -> str:
        """Give the key of the machine that a key of a contact follows from, or its first one."""
        keys = CAUSES.get(name.partition(".")[2], ())
        given = [key for key in keys if self.is_given(key)]
        return f"{self.kind}.{given[0]}" if given else self._first()

    def require(self, *keys: str) -> None:
        """Refuse a machine without some keys, all of which have to be positive."""
        for key in keys:
            if getattr(self.values, key) == 0:
                known = KEYS[f"{self.kind}.{key}"]
                what = f"{known.name} is not given" if not self.is_given(key) else f"{key} is 0"
                positive = known.expected.replace("0 or ", "").replace("[0, ", "(0, ")
                self.refuse(key, what, f"{known.meaning}: {positive}")

    def text(self) -> str:
        """Write it as namelist text: its whole group, and the given keys of the others."""
        groups = {self.kind: [key.key for key in GROUPS[self.kind]]}
        for given in self.draft.given:
            group, _, name = given.partition(".")
            if group not in MACHINES:
                groups.setdefault(group, []).append(name)
        blocks = []
        for group, names in groups.items():
            lines = []
            for key in (KEYS[f"{group}.{name}"] for name in names):
                value = self.draft.settings.value(key)
                if key.kind == "path" and value:
                    value = self.draft.absolute(key.name, str(value))
                lines.append(f"   {key.key} = {to_text(value)} ! {key.meaning}")
            blocks.append("\n".join([f"&{group}", *lines, "/\n"]))
        return "".join(blocks)

    def case_text(
        self,
        contact: Mapping[str, Value],
        place: str = "",
        *,
        bodies: bool = True,
        may_be_light: bool = False,
    ) -> str:
        """Resolve the case of one contact with values by ``group.key``.

        Without `bodies` it has the reduced modulus in their place; `may_be_light` as in `Draft`. If
        the case is not acceptable, InputError points to the machine; `place` names the contact with
        a value out of range.
        """
        draft = Draft(copy.deepcopy(self.draft.settings), self.draft.sources)
        draft.may_be_light = may_be_light
        skipped = MACHINES if bodies else (*MACHINES, "bodies")
        draft.given = {
            name: where
            for name, where in self.draft.given.items()
            if KEYS[name].group not in skipped
        }
        if not bodies:
            draft.settings.bodies = Bodies()
            contact = {**contact, "contact.reduced_modulus": self.reduced_modulus}
        for name, value in contact.items():
            key, cause = KEYS[name], self._cause(name)
            if isinstance(value, float) and not key.allows(value):
                what = f"{place}: {name} = {short(value)}"
                self.draft.refuse(cause, what, key.expected)
            draft.settings.set(key, value)
            draft.given[name] = self.draft.given[cause]
        complete(draft)
        return case_text(draft.settings, draft.given)


def read_machine(
    path: Any,  # noqa: ANN401 (a path, or an ellipsis for none)
    options: Iterable[Option],
    kinds: Sequence[str],
) -> Machine:
    """Read a file with one of the groups `kinds`, or without a file only the options.

    InputError with file, line and column if it is not acceptable.
    """
    texts = options_of(options)
    if path is ...:
        draft = read("", "machine", texts)
    else:
        name = path_of(path, "case")
        draft = read(read_text(name, "the name of a case file"), name, texts)
    result = [k for k in MACHINES if any(n.partition(".")[0] == k for n in draft.given)]
    wanted = " or ".join(f"&{kind}" for kind in kinds)
    if not result:
        raise InputError(
            f"{draft.sources[0].name}: error: there is no {wanted}\nexpected: {wanted}"
        )
    first = [draft.first_given(key.name for key in GROUPS[kind]) for kind in result]
    if len(result) > 1:
        draft.contradict(first[1], first[0], "one machine element per file")
    if result[0] not in kinds:
        command = "gear" if result[0] == "spur_gear" else "bearing"
        draft.refuse(first[0], f"&{result[0]} is no {wanted}", f"'pyehl {command}' takes it")
    if derived := draft.first_given(FOLLOWS):
        draft.contradict(derived, first[0], f"one of them: {derived} follows from &{result[0]}")
    return Machine(result[0], getattr(draft.settings, result[0]), draft)
