# SPDX-License-Identifier: BSD-3-Clause
"""Namelist text to values, for text that the Fortran reader has resolved.

f90nml never sees what a user wrote: it takes ``0,84`` as two values and a unit as a string, where
the Fortran reader says what is wrong.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import f90nml

__all__ = ["values"]

END = "\n/\n"


def values(resolved: str) -> dict[str, dict[str, Any]]:
    """Read groups and their values of resolved namelist text."""
    groups: dict[str, dict[str, Any]] = {}
    for block in resolved.split(END):
        if block.strip():
            groups |= {group: dict(keys) for group, keys in _group(block + END).items()}
    return groups


# The cases of a study differ in one group or two, and reading one takes half a millisecond
@lru_cache(maxsize=128)
def _group(text: str) -> dict[str, dict[str, Any]]:
    # a Namelist looks every key up by a slow way
    return {group: dict(keys) for group, keys in f90nml.reads(text).items()}
