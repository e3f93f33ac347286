# SPDX-License-Identifier: BSD-3-Clause
"""A case: what a namelist file states, checked and completed."""

from __future__ import annotations

import os
import reprlib
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from types import EllipsisType
from typing import Any, Self

from pyehl import display, namelist
from pyehl.case.complete import complete
from pyehl.case.reader import read
from pyehl.case.roller import BODIES
from pyehl.case.source import read_text
from pyehl.case.surfaces import without_fractal
from pyehl.case.writer import case_text
from pyehl.errors import InputError
from pyehl.given import Option, options_of, path_of, text_of
from pyehl.types import Settings


def resolve(
    text: str, origin: str, options: Option | Iterable[Option] = (), *, from_file: bool = False
) -> str:
    """Resolve a case: check it, and write every value of it as namelist text.

    `text` is that of a file `origin`, for messages and for relative names of files; `from_file`
    reads that file instead. `options` replace values. InputError with file, line and column, what
    was expected, and the nearest name.
    """
    origin = path_of(origin, "the name of a case")
    if from_file:
        text = read_text(origin, "the name of a case file")
    text_of(text, "the text of a case")
    draft = read(text, os.fspath(origin), options_of(options))
    complete(draft)
    return case_text(draft.settings, draft.given)


@dataclass(frozen=True, slots=True, repr=False, init=False)
class Case:
    """A case that can be solved: checked, with every value.

    Options have the same forms everywhere: ``{"grid": {"points": 65}}``, ``{"grid.points": 65}``,
    or texts ``"grid.points=65"``; a whole number may be a float, as 65.0.

    Parameters
    ----------
    case
        Path of a case file, or another case; without it the case of all defaults. For the text of a
        case see `from_text`.
    *options
        Values that replace those of `case`.
    **groups
        Such values by key of their groups.

    Attributes
    ----------
    text
        Resolved namelist text with every value, names of files made absolute.

    Raises
    ------
    InputError
        With file, line and column, what was expected, and the nearest name.

    Examples
    --------
    >>> import pyehl
    >>> case = pyehl.Case("cases/quick.nml", {"grid.points": 65})
    >>> case
    Case(M=200, L=10, smooth, 65 points)
    >>> case["grid"]["points"]
    65
    >>> case == pyehl.Case(contact={"moes_m": 200.0, "moes_l": 10.0}, grid={"points": 65})
    True
    """

    text: str

    def __init__(
        self,
        case: Case | str | os.PathLike[str] | EllipsisType = ...,
        *options: Option,
        **groups: Mapping[str, Any],
    ) -> None:
        given = options_of([options, groups])
        if isinstance(case, Case):
            text = resolve(case.text, "resolved case", given) if given else case.text
        elif case is ...:
            text = resolve("", "case", given)
        else:
            path = path_of(case, "case")
            if "\n" in path or path.lstrip().startswith("&"):
                raise InputError(
                    f"case = {reprlib.repr(path)}: expected the path of a case file; for the "
                    "text of a case use pyehl.Case.from_text"
                )
            text = resolve("", path, given, from_file=True)
        object.__setattr__(self, "text", text)

    @classmethod
    def read(cls, path: str | os.PathLike[str], *options: Option) -> Self:
        """Read a case file, as ``Case(path, *options)``."""
        return cls(path_of(path, "case"), *options)

    @staticmethod
    def from_text(text: str, *options: Option, origin: str = "text of the case") -> Case:
        """Read a case from namelist text; '' is the case of all defaults.

        Raises
        ------
        InputError
            With `origin` in place of a file.
        """
        return resolved_case(resolve(text, origin, options))

    def __getitem__(self, group: str) -> dict[str, Any]:
        """Values of a group by key, as `resolve` gives them: ``case["grid"]["points"]``."""
        return self.resolve()[group]

    def __iter__(self) -> Iterator[str]:
        """Names of the groups."""
        return iter(self.resolve())

    def with_options(self, *options: Option) -> Case:
        """Replace some values: ``case.with_options("grid.points=257")`` is another case.

        Defaults that depend on other values, such as the Roelands exponent, are derived anew.

        Raises
        ------
        InputError
            If an option is not acceptable.
        """
        return type(self)(self, *options)

    def smooth(self) -> Case:
        """Give the case of the smooth contact: everything but its rough surfaces."""
        groups = self.resolve()
        rough = [name for name in ("second_surface", "surface") if name in groups]
        options: dict[str, Any] = {f"{name}.kind": "smooth" for name in rough}
        for name in rough:
            options |= without_fractal(name, groups[name])
        return self.with_options(options)

    def __repr__(self) -> str:
        """Operating point, surface and grid in one line."""
        groups = self.resolve()
        contact = groups["contact"]
        names = {"moes_m": "M", "moes_l": "L", "moes_m_line": "M_line", "moes_l_line": "L_line"}
        names |= {"load": "load_N", "load_per_length": "load_N_per_m"}
        names |= {"mean_velocity": "velocity_m_s"}
        facts = [f"{names[key]}={contact[key]:g}" for key in names if key in contact]
        kinds = (groups[name]["kind"] for name in ("surface", "second_surface") if name in groups)
        facts += [" and ".join(kinds), f"{groups['grid']['points']} points"]
        return f"Case({', '.join(facts)})"

    def _repr_html_(self) -> str:
        """Give all groups and their values as an HTML table, for notebooks."""
        groups = self.resolve()
        rows = {
            f"{group}.{key}": value for group, keys in groups.items() for key, value in keys.items()
        }
        return display.table(repr(self), rows)

    def resolve(self) -> dict[str, dict[str, Any]]:
        """Give all groups and values.

        Of mutually exclusive keys only the effective ones are present: moes_m, moes_l or the SI
        values; amplitude or amplitude_over_film.
        """
        return namelist.values(self.text)


def resolved_case(text: str) -> Case:
    """Make a case of text that is already resolved, without reading it again."""
    case = object.__new__(Case)
    object.__setattr__(case, "text", text)
    return case


def files_of(settings: Settings) -> list[str]:
    """Give the files of a resolved case: height maps and tables.

    Tables are those of viscosities, of a duty and, unless the file is missing, of roller profiles:
    a resolved case has their values.
    """
    maps = [group["file"] for group in settings.values() if group.get("kind") == "map"]
    tables = settings["lubricant"].get("table"), settings.get("duty", {}).get("file")
    profiles = [settings["contact"].get(f"profile_file{end}") for end in BODIES]
    profiles = [name for name in profiles if name and os.path.isfile(name)]
    return [str(name) for name in (*maps, *tables, *profiles) if name]


def exchanged(case: Case) -> Case:
    """Give the same contact with the groups of its surfaces exchanged; each stays on its body."""
    values, groups = case.resolve(), namelist.values(namelist.given(case.text))
    rough = {"rough_surface": 3 - values["contact"]["rough_surface"]}
    groups["contact"] = groups.get("contact", {}) | rough
    second = values.get("second_surface", {"kind": "smooth"})
    # all values, but not Ra and Rq: the rms height follows from them, and is among the values
    for group, keys in (("surface", second), ("second_surface", values["surface"])):
        groups[group] = {key: value for key, value in keys.items() if key not in ("ra", "rq")}
    return Case.from_text(namelist.text_of(groups), origin="case with its surfaces exchanged")
