# SPDX-License-Identifier: BSD-3-Clause
"""A case: what a namelist file says, checked and completed by the Fortran reader."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Self

from pyehl import display, library, namelist
from pyehl.given import Option, check_kind, path_of
from pyehl.types import Settings

if TYPE_CHECKING:
    from pyehl.surfaces import Surface, Topography


@dataclass(frozen=True, slots=True, repr=False, init=False)
class Case:
    """A case that can be solved: checked, with every value spelled out.

    Options are everywhere the same: a dict with values by ``group.key``, or texts
    ``group.key=value``.

    Parameters
    ----------
    text
        Namelist text; '' is the case of all defaults.
    **groups
        Values by key of the groups of a case file, in place of those of `text`.

    Attributes
    ----------
    text
        Resolved namelist text: every value spelled out, names of maps made absolute.

    Raises
    ------
    InputError
        As `read` does.

    Examples
    --------
    >>> import pyehl
    >>> case = pyehl.Case(contact={"moes_m": 200.0, "moes_l": 10.0}, grid={"points": 65})
    >>> case
    Case(M=200, L=10, smooth, 65 points)
    >>> case.with_options({"grid.points": 129}).resolve()["grid"]["points"]
    129
    >>> pyehl.Case.read("cases/quick.nml", {"grid.points": 65})
    Case(M=200, L=10, smooth, 65 points)
    """

    text: str

    def __init__(self, text: str = "", **groups: Mapping[str, Any]) -> None:
        values: dict[str, Any] = {}
        for group, keys in groups.items():
            check_kind(keys, Mapping, group, "values by key, as {'points': 65}")
            values |= {f"{group}.{key}": value for key, value in keys.items()}
        object.__setattr__(self, "text", library.resolve(text, "text of the case", values))

    @classmethod
    def resolved(cls, text: str) -> Self:
        """Take text that a case has resolved before, as it is."""
        case = object.__new__(cls)
        object.__setattr__(case, "text", text)
        return case

    @classmethod
    def read(cls, path: str | os.PathLike[str], *options: Option) -> Self:
        """Read a case file; `options` replace its values.

        Raises
        ------
        InputError
            With file, line and column, what was expected, and the nearest name.
        """
        return cls.resolved(library.resolve("", path_of(path, "case"), options, from_file=True))

    @classmethod
    def of(cls, case: Case | str | os.PathLike[str], *options: Option) -> Case:
        """Take a case, or the path of a case file, with some values replaced.

        Raises
        ------
        InputError
            As `read` does.
        """
        if isinstance(case, Case):
            return case.with_options(*options) if options else case
        return cls.read(case, *options)

    @classmethod
    def from_text(
        cls, text: str, options: Option | Iterable[Option] = (), origin: str = "text of the case"
    ) -> Self:
        """Read a case from namelist text; '' is the case of all defaults.

        Raises
        ------
        InputError
            As `read` does, with `origin` in place of the file.
        """
        return cls.resolved(library.resolve(text, origin, options))

    def with_options(self, *options: Option) -> Case:
        """Replace some values: ``case.with_options("grid.points=257")`` is another case.

        Defaults that follow from other values (the Roelands exponent, for one) follow the new ones.

        Raises
        ------
        InputError
            If an option is not acceptable.
        """
        return type(self).from_text(self.text, options, "resolved case")

    def smooth(self) -> Case:
        """Give the case of the smooth contact: everything but its rough surfaces."""
        rough = [name for name in ("second_surface", "surface") if name in self.resolve()]
        return self.with_options({f"{name}.kind": "smooth" for name in rough})

    def __repr__(self) -> str:
        """Operating point, surface and grid in one line."""
        groups = self.resolve()
        contact = groups["contact"]
        names = {"moes_m": "M", "moes_l": "L", "load": "load_N", "mean_velocity": "velocity_m_s"}
        facts = [f"{names[key]}={contact[key]:g}" for key in names if key in contact]
        kinds = (groups[name]["kind"] for name in ("surface", "second_surface") if name in groups)
        facts += [" and ".join(kinds), f"{groups['grid']['points']} points"]
        return f"Case({', '.join(facts)})"

    def _repr_html_(self) -> str:
        """Draw all groups and their values, for notebooks."""
        groups = self.resolve()
        rows = {
            f"{group}.{key}": value for group, keys in groups.items() for key, value in keys.items()
        }
        return display.table(repr(self), rows)

    def resolve(self) -> dict[str, dict[str, Any]]:
        """Give all groups and values.

        Of keys that exclude each other only the one that holds is there: moes_m, moes_l or the SI
        values; amplitude or amplitude_over_film.
        """
        return namelist.values(self.text)


def files_of(settings: Settings) -> list[str]:
    """Give the files that a resolved case reads: height maps, a table of viscosities."""
    maps = [group["file"] for group in settings.values() if group.get("kind") == "map"]
    return [str(name) for name in (*maps, settings["lubricant"].get("table")) if name]


def with_surface(case: Case, surface: Surface, group: str = "surface") -> tuple[Case, Topography]:
    """Give a case with a surface in memory in place of that of a group, and it as a tile.

    InputError if it is none of heights, or the case does not say its size.
    """
    # surfaces take long to import, and most cases have none in memory
    from pyehl.surfaces import as_map, in_memory  # noqa: PLC0415

    tile = in_memory(surface, case.resolve().get(group, {}), group)
    return case.with_options(as_map(tile, group)), tile


def exchanged(case: Case) -> Case:
    """Give a case with its surfaces, and their bodies, exchanged."""
    groups = case.resolve()
    contact = {**groups["contact"], "rough_surface": 3 - groups["contact"]["rough_surface"]}
    second = groups.get("second_surface", {"kind": "smooth"})
    groups |= {"contact": contact, "surface": second, "second_surface": groups["surface"]}
    return Case.from_text(namelist.text_of(groups), origin="case with its surfaces exchanged")
