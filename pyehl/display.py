# SPDX-License-Identifier: BSD-3-Clause
"""Tables for notebooks and terminals."""

import math
from collections.abc import Mapping
from html import escape


def table(title: str, rows: Mapping[str, object]) -> str:
    """HTML of a table with two columns, the text of all cells escaped."""
    lines = [
        f"<tr><th style='text-align:left'>{escape(name)}</th>"
        f"<td style='text-align:left'>{escape(_text(value))}</td></tr>"
        for name, value in rows.items()
    ]
    return f"<table><caption><b>{escape(title)}</b></caption>{''.join(lines)}</table>"


def _text(value: object) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def with_error(value: float | None, error: float | None = None, unit: str = "") -> str:
    """Give a number with its error to two digits; 'not known' if there is no number.

    Examples
    --------
    >>> from pyehl.display import with_error
    >>> with_error(233.61, 3.42, "nm")
    '233.6 ± 3.4 nm'
    >>> with_error(9.156e10, 1.14e9)
    '(9.16 ± 0.11)·10^10'
    >>> with_error(0.0243689)
    '0.02437'
    """
    if value is None or not math.isfinite(value):
        return "not known"
    tail = f" {unit}" if unit else ""
    if error is None or not (math.isfinite(error) and error > 0.0):
        return f"{value:.4g}{tail}"
    power = math.floor(math.log10(max(abs(value), error)))
    if -5 < power < 6:
        return "{} ± {}{}".format(*_to_two_digits(value, error), tail)
    scale = 10.0**power
    both = "{} ± {}".format(*_to_two_digits(value / scale, error / scale))
    return f"({both})·10^{power}{tail}"


def _to_two_digits(value: float, error: float) -> tuple[str, str]:
    """Write both with the decimals that give the error two digits."""
    decimals = max(0, 1 - math.floor(math.log10(float(f"{error:.1e}"))))
    return f"{value:.{decimals}f}", f"{error:.{decimals}f}"
