# SPDX-License-Identifier: BSD-3-Clause
"""A case: what a namelist file says, checked and completed by the Fortran reader."""

from __future__ import annotations

import argparse
import os
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Self

from pyehl import core, namelist, surface

__all__ = ["Case", "add_arguments", "execute"]


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
        return cls(core.resolve("", os.fspath(path), options, from_file=True))

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
        return cls(core.resolve(text, origin, options))

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


def add_case_arguments(parser: argparse.ArgumentParser, *, optional: bool = False) -> None:
    """Case file and --set options, the same for every verb that takes a case."""
    parser.add_argument(
        "case", metavar="CASE.nml", nargs="?" if optional else None, help="case file"
    )
    parser.add_argument(
        "--set",
        dest="overrides",
        action="append",
        default=[],
        metavar="GROUP.KEY=VALUE",
        help="replace a value of the case; may be repeated",
    )


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of ``pyehl check``."""
    parser.description = "Read and check a case; print it resolved, and the plan. Solve nothing."
    add_case_arguments(parser)


def execute(args: argparse.Namespace) -> int:
    """Run ``pyehl check``."""
    case = Case.read(args.case, args.overrides)
    print(case.text)
    with core.Solver.open(case, surface.made_heights(case)) as solver:
        print(solver.describe())
    return 0
