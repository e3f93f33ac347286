# SPDX-License-Identifier: BSD-3-Clause
"""Numbers as text in the lines of a run."""

import math

# Maximum number of characters without an exponent
LONGEST = 16


def fixed(value: float, decimals: int) -> str:
    """Write a number with `decimals`, or to three digits if rounding would change it too much.

    Examples
    --------
    >>> from pyehl.number_text import fixed
    >>> fixed(0.024369, 5), fixed(2.64e-6, 4), fixed(0.00123, 4)
    ('0.02437', '2.64E-06', '0.00123')
    """
    text = f"{value:.{decimals}f}"
    if len(text) > LONGEST:
        return f"{value:.5E}"
    if abs(float(text) - value) > (0.005 if decimals > 2 else 0.05) * abs(value):
        return f"{value:.2E}" if abs(value) < 1e-3 else rounded(value)
    return text


def power(value: float, decimals: int) -> str:
    """Write a number with an exponent: '8.3E-04'."""
    return f"{value:.{decimals}E}"


def digits(value: float, number: int = 5) -> str:
    """Write a number of any size with `number` digits: '1000.0', '0.33300', '2.1000E+09'."""
    if value == 0.0 or 1e-4 <= abs(value) < 10.0**number:
        return f"{value:#.{number}g}"
    return power(value, number - 1)


def rounded(value: float, number: int = 3) -> str:
    """Write a number with `number` digits and no exponent: '9.99', '10.0', '123'."""
    decimals = number
    if value:
        shown = abs(value) * (1.0 + 0.5 * 10.0**-number)
        decimals = max(0, number - 1 - math.floor(math.log10(shown)))
    return f"{value:.{decimals}f}"


def percent(fraction: float) -> str:
    """Write a fraction in per cent: '1.5 %'."""
    return f"{rounded(100.0 * fraction, 2)} %"


def megapascals(pressure: float) -> str:
    """Write a pressure [Pa] in MPa: '5 MPa'."""
    return f"{pressure * 1e-6:.3g} MPa"


def memory(size: float) -> str:
    """Write a number of bytes: '13 MB', '1.2 GB'."""
    return f"{math.ceil(size / 1e6)} MB" if size < 1e9 else f"{size / 1e9:.1f} GB"


def with_error(value: float, error: float, decimals: int, unit: str, error_digits: int = 2) -> str:
    """Write a number with its error to `error_digits`: '1.185 +- 0.048', '2.6435E-06 +- 5.5E-09'.

    With an exponent the error has two digits. A number whose error is not known (not finite) has
    `decimals`.
    """
    if not math.isfinite(error):
        return f"{fixed(value, decimals)}{unit}, error not known"
    shown = max(abs(error), 1e-9 * abs(value), 2.3e-308)
    places = max(0, error_digits - 1 - math.floor(math.log10(shown)))
    if 0.0 < abs(value) < 1e-4:
        decimals = min(15, max(1, places + math.floor(math.log10(abs(value)))))
        return f"{value:.{decimals}E} +- {error:.1E}{unit}"
    places = min(9, places)
    return f"{value:.{places}f} +- {error:.{places}f}{unit}"
