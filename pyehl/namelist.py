# SPDX-License-Identifier: BSD-3-Clause
"""Namelist text to values, for text that the Fortran reader has resolved.

f90nml never sees what a user wrote: it takes ``0,84`` as two values and a unit as a string, where
the Fortran reader says what is wrong.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import lru_cache
from typing import Any

import f90nml

__all__ = ["text_of", "values"]

END = "\n/\n"
WORD = r"'(?:[^']|'')*'|\.true\.|\.false\.|-?\d+[\d.]*(?:e-?\d+)?"
LINE = re.compile(rf"\s*(\w+) = ({WORD})\s*(?:!.*)?")
LOGICAL = {".true.": True, ".false.": False}


def values(resolved: str) -> dict[str, dict[str, Any]]:
    """Read groups and their values of resolved namelist text."""
    groups: dict[str, dict[str, Any]] = {}
    for block in resolved.split(END):
        if block.strip():
            groups |= {group: dict(keys) for group, keys in _group(block + END).items()}
    return groups


def text_of(groups: Mapping[str, Mapping[str, Any]]) -> str:
    """Give groups and their values as namelist text."""
    blocks = []
    for group, keys in groups.items():
        lines = [f"   {key} = {_word(value)}" for key, value in keys.items()]
        blocks.append("\n".join([f"&{group}", *lines]) + END)
    return "".join(blocks)


def _word(value: bool | int | float | str) -> str:
    if isinstance(value, bool):
        return ".true." if value else ".false."
    return "'" + value.replace("'", "''") + "'" if isinstance(value, str) else repr(value)


# The cases of a study differ in one key or two, and f90nml reads a group in some milliseconds
@lru_cache(maxsize=128)
def _group(text: str) -> dict[str, dict[str, Any]]:
    name, *lines = text.removesuffix(END).strip().splitlines()
    keys = [_line(line) for line in lines]
    if name[:1] == "&" and None not in keys:
        return {name[1:].strip(): dict(key for key in keys if key is not None)}
    # a Namelist looks every key up by a slow way
    return {group: dict(found) for group, found in f90nml.reads(text).items()}


@lru_cache(maxsize=2048)
def _line(line: str) -> tuple[str, Any] | None:
    """Key and value of a line as the Fortran writer makes it; None for another."""
    match = LINE.fullmatch(line)
    if match is None:
        return None
    key, value = match.groups()
    if value[0] == "'":
        return key, value[1:-1].replace("''", "'")
    if value in LOGICAL:
        return key, LOGICAL[value]
    return key, int(value) if value.lstrip("-").isdigit() else float(value)
