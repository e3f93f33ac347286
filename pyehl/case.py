# SPDX-License-Identifier: BSD-3-Clause
"""A case: what a namelist file says, checked and completed by the Fortran reader."""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Self

from pyehl import display, library, namelist

__all__ = ["Case"]


Option = str | Iterable[str]


def _flat(options: Iterable[Option]) -> list[str]:
    """Options one by one, also where they come as lists."""
    flat: list[str] = []
    for option in options:
        flat += [option] if isinstance(option, str) else list(option)
    return flat


@dataclass(frozen=True, slots=True, repr=False)
class Case:
    """A case that can be solved.

    Attributes
    ----------
    text
        Resolved namelist text: every value spelled out, names of maps made absolute.

    Examples
    --------
    >>> import pyehl
    >>> case = pyehl.Case.read("cases/quick.nml", "grid.points=65")
    >>> case
    Case(M=200, L=10, smooth, 65 points)
    >>> case.with_options("grid.points=129").resolve()["grid"]["points"]
    129
    """

    text: str

    @classmethod
    def read(cls, path: str | os.PathLike[str], *options: Option) -> Self:
        """Read a case file; `options` are texts ``group.key=value`` that replace its values.

        Raises
        ------
        InputError
            With file, line and column, what was expected, and the nearest name.
        """
        return cls(library.resolve("", os.fspath(path), _flat(options), from_file=True))

    @classmethod
    def of(cls, case: Case | str | os.PathLike[str], *options: Option) -> Case:
        """Take a case, or the path of a case file, with some values replaced.

        Raises
        ------
        InputError
            As `read` does.
        """
        if isinstance(case, Case):
            return case.with_options(*_flat(options)) if options else case
        return cls.read(case, *options)

    @classmethod
    def from_text(
        cls, text: str, options: Iterable[str] = (), origin: str = "text of the case"
    ) -> Self:
        """Read a case from namelist text; '' is the case of all defaults.

        Raises
        ------
        InputError
            As `read` does, with `origin` in place of the file.
        """
        return cls(library.resolve(text, origin, options))

    def with_options(self, *options: str) -> Case:
        """Replace some values: ``case.with_options("grid.points=257")`` is another case.

        Derived defaults stay as they were resolved (the Roelands exponent, for one).

        Raises
        ------
        InputError
            If an option is not acceptable.
        """
        return type(self).from_text(self.text, options, "resolved case")

    def __repr__(self) -> str:
        """Operating point, surface and grid in one line."""
        return f"Case({', '.join(self._facts())})"

    def _repr_html_(self) -> str:
        """Draw all groups and their values, for notebooks."""
        groups = self.resolve()
        rows = {
            f"{group}.{key}": value for group, keys in groups.items() for key, value in keys.items()
        }
        return display.table(repr(self), rows)

    def _facts(self) -> list[str]:
        groups = self.resolve()
        contact = groups["contact"]
        names = {"moes_m": "M", "moes_l": "L", "load": "load_N", "mean_velocity": "velocity_m_s"}
        facts = [f"{names[key]}={contact[key]:g}" for key in names if key in contact]
        return [*facts, str(groups["surface"]["kind"]), f"{groups['grid']['points']} points"]

    def resolve(self) -> dict[str, dict[str, Any]]:
        """Give all groups and values.

        Of keys that exclude each other only the one that holds is there: moes_m, moes_l or the SI
        values; amplitude or amplitude_over_film.
        """
        return namelist.values(self.text)
