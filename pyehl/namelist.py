# SPDX-License-Identifier: BSD-3-Clause
"""Namelist text to values, for text that the Fortran reader has resolved.

f90nml never sees what a user wrote: it takes ``0,84`` as two values and a unit as a string, where
the Fortran reader says what is wrong.
"""

from __future__ import annotations

from typing import Any

import f90nml

__all__ = ["values"]


def values(resolved: str) -> dict[str, dict[str, Any]]:
    """Read groups and their values of resolved namelist text."""
    return {group: dict(keys) for group, keys in f90nml.reads(resolved).items()}
