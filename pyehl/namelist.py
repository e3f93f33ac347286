# SPDX-License-Identifier: BSD-3-Clause
"""Values as namelist text and back, for text that `pyehl.case.writer` or this module wrote.

`pyehl.case.reader` reads what a user wrote, and reports its errors.
"""

import re
from collections.abc import Mapping
from functools import lru_cache
from typing import Any

from pyehl.errors import InputError

END = "\n/\n"
NUMBER = r"-?\d+[\d.]*(?:e[+-]?\d+)?"
WORD = rf"'(?:[^']|'')*'|\.true\.|\.false\.|{NUMBER}"
LINE = re.compile(rf"\s*(\w+) = ({WORD}|{NUMBER}(?:, {NUMBER})+)\s*(?:!.*)?")
LOGICAL = {".true.": True, ".false.": False}


def values(resolved: str) -> dict[str, dict[str, Any]]:
    """Read the groups and values of resolved namelist text.

    InputError for a line in another form.
    """
    groups: dict[str, dict[str, Any]] = {}
    for block in resolved.split(END):
        if block.strip():
            groups |= {group: dict(keys) for group, keys in _group(block + END).items()}
    return groups


def given(resolved: str, *, comments: bool = True) -> str:
    """Give the text of a resolved case without defaults and derived values.

    Reading it gives the same case. `comments`: with the meaning of each key.
    """
    blocks = []
    for block in resolved.split(END):
        name, *lines = block.strip().splitlines() or [""]
        kept = [line for line in lines if not line.endswith(("! default", "! derived"))]
        if not comments:
            result = (match for line in kept if (match := LINE.fullmatch(line)))
            kept = [f"   {match[1]} = {match[2]}" for match in result]
        if kept:
            blocks.append("\n".join([name, *kept]) + END)
    return "".join(blocks)


def text_of(groups: Mapping[str, Mapping[str, Any]]) -> str:
    """Give groups and their values as namelist text."""
    blocks = []
    for group, keys in groups.items():
        lines = [f"   {key} = {word(value)}" for key, value in keys.items()]
        blocks.append("\n".join([f"&{group}", *lines]) + END)
    return "".join(blocks)


def word(value: bool | int | float | str | tuple[float, ...]) -> str:
    """Give a value as namelist text."""
    if isinstance(value, bool):
        return ".true." if value else ".false."
    if isinstance(value, tuple):
        return ", ".join(map(repr, value))
    return "'" + value.replace("'", "''") + "'" if isinstance(value, str) else repr(value)


# The cases of a study differ in one or two keys
@lru_cache(maxsize=128)
def _group(text: str) -> dict[str, dict[str, Any]]:
    name, *lines = text.removesuffix(END).strip().splitlines()
    if name[:1] != "&":
        raise InputError(f"{name!r}: expected a group of a resolved case, as '&contact'")
    return {name[1:].strip(): dict(map(_line, lines))}


@lru_cache(maxsize=2048)
def _line(line: str) -> tuple[str, Any]:
    match = LINE.fullmatch(line)
    if match is None:
        raise InputError(f"{line.strip()!r}: expected a line of a resolved case, 'key = value'")
    key, value = match.groups()
    if value[0] == "'":
        return key, value[1:-1].replace("''", "'")
    if value in LOGICAL:
        return key, LOGICAL[value]
    if "," in value:
        return key, tuple(map(float, value.split(",")))
    return key, int(value) if value.lstrip("-").isdigit() else float(value)
