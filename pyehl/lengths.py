# SPDX-License-Identifier: BSD-3-Clause
"""Lengths as text, in a readable unit: 600 nm, not 0.0006 mm."""

UNITS = {"nm": 1e9, "um": 1e6, "mm": 1e3}


def unit_of(largest: float, *, max_unit: str = "mm") -> str:
    """Name of the unit for lengths up to `largest` [m]: nm below 1 um, um below 0.1 mm, else mm.

    `max_unit`: the largest unit, such as 'um' for wavelengths.
    """
    if largest < 1e-6:
        return "nm"
    return "um" if max_unit == "um" or largest < 1e-4 else "mm"


def length(value: float, digits: int = 3, *, max_unit: str = "mm") -> str:
    """Format a length [m] with its unit."""
    unit = unit_of(abs(value), max_unit=max_unit)
    return f"{value * UNITS[unit]:.{digits}g} {unit}"


def size(x: float, y: float, digits: int = 5) -> str:
    """Format the two sides of a map [m] with their unit."""
    unit = unit_of(max(x, y))
    return " x ".join(f"{side * UNITS[unit]:.{digits}g}" for side in (x, y)) + f" {unit}"


def waves(longest: float, shortest: float) -> str:
    """Format a range of wavelengths [m]: 'from 829 to 414 um'."""
    units = [unit_of(side, max_unit="um") for side in (longest, shortest)]
    parts = [_short(s * UNITS[u]) for s, u in zip((longest, shortest), units, strict=True)]
    first = "" if units[0] == units[1] else f" {units[0]}"
    return f"from {parts[0]}{first} to {parts[1]} {units[1]}"


def _short(value: float) -> str:
    """Round to a whole number, and small ones to two digits."""
    return f"{value:.0f}" if value >= 10.0 else f"{value:.2g}"
