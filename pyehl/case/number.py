# SPDX-License-Identifier: BSD-3-Clause
"""Values as namelist text: the shortest that reads back as the same value."""

from decimal import Decimal

# Digits behind a point or before it that are written plainly
LEAST, LARGEST = 1e-4, 1e7


def to_text(value: bool | int | float | str | tuple[float, ...]) -> str:
    """Give a value as a namelist has it: 0.4, 2.2e-8, 600.0, .true., 'harmonic'."""
    if isinstance(value, float):
        return real_text(value)
    if isinstance(value, str):
        return quoted(value)
    if isinstance(value, bool):
        return ".true." if value else ".false."
    if isinstance(value, tuple):
        return ", ".join(map(real_text, value))
    return str(value)


def real_text(value: float) -> str:
    """Give the shortest decimal text that reads back as exactly the number."""
    if LEAST <= abs(value) < LARGEST:
        return repr(value)
    if value == 0.0:
        return "0.0"
    text = repr(value)
    if "n" in text:  # nan, inf, -inf
        return text
    sign, digits, shift = Decimal(text).normalize().as_tuple()
    exponent = len(digits) - 1 + int(shift)
    mantissa = "".join(map(str, digits))
    point = f".{mantissa[1:]}" if len(mantissa) > 1 else ""
    return f"{'-' * sign}{mantissa[0]}{point}e{exponent}"


def quoted(text: str) -> str:
    """Give a text between single quotes, inner quotes doubled as a namelist wants them."""
    return "'" + text.replace("'", "''") + "'"


def short(value: float) -> str:
    """Give four digits of a number, for messages."""
    return f"{value:.3E}"
