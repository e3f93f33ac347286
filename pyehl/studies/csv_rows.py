# SPDX-License-Identifier: BSD-3-Clause
"""Small tables that a user wrote: CSV with a line of names, and where each row stands."""

import csv
import math

from pyehl.errors import InputError


def csv_rows(name: str, text: str) -> tuple[str, list[str], list[tuple[int, dict[str, str]]]]:
    """Read CSV without empty lines and comments (``#``).

    Returns the beginning of a message about the line of names, the names, and the rows with the
    number of their line. InputError for a row with more or fewer cells than names.
    """
    lines = [
        (number, [cell.strip() for cell in next(csv.reader([line]))])
        for number, line in enumerate(text.splitlines(), 1)
        if line.strip(" ,;\t") and line[0] != "#"
    ]
    (first, head), *others = lines or [(1, [])]
    for number, cells in others:
        if len(cells) != len(head):
            raise InputError(
                f"{name}:{number}: error: {len(cells)} values for {len(head)} columns\nexpected: "
                "one value for each, with decimal points, not commas"
            )
    rows = [(number, dict(zip(head, cells, strict=True))) for number, cells in others]
    return f"{name}:{first}: error:", head, rows


def number_in(cell: str) -> float:
    """Give the number in a cell; NaN where there is none that is finite."""
    try:
        value = float(cell)
    except ValueError:
        return math.nan
    return value if math.isfinite(value) else math.nan
