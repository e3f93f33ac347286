# SPDX-License-Identifier: BSD-3-Clause
"""Checks of arguments."""

from __future__ import annotations

import math

from pyehl.errors import InputError

__all__ = ["positive"]


def positive(name: str, value: float, unit: str) -> float:
    """Return the value as a float.

    Raises
    ------
    InputError
        If it is not positive or not finite; the message names it and its unit.
    """
    value = float(value)
    if not (math.isfinite(value) and value > 0.0):
        raise InputError(f"{name} must be a positive number [{unit}], not {value!r}")
    return value
