# SPDX-License-Identifier: BSD-3-Clause
"""A case: what a namelist file says, checked and completed by the Fortran reader."""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Self

from pyehl import library, namelist

__all__ = ["Case"]


@dataclass(frozen=True, slots=True)
class Case:
    """A case that can be solved.

    Attributes
    ----------
    text
        Resolved namelist text: every value spelled out, names of maps made absolute.
    """

    text: str

    @classmethod
    def read(cls, path: str | os.PathLike[str], options: Iterable[str] = ()) -> Self:
        """Read a case file; `options` are texts ``group.key=value`` that replace its values.

        Raises
        ------
        InputError
            With file, line and column, what was expected, and the nearest name.
        """
        return cls(library.resolve("", os.fspath(path), options, from_file=True))

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

    def resolve(self) -> dict[str, dict[str, Any]]:
        """Give all groups and values.

        Of keys that exclude each other only the one that holds is there: moes_m, moes_l or the SI
        values; amplitude or amplitude_over_film.
        """
        return namelist.values(self.text)
