# SPDX-License-Identifier: BSD-3-Clause
"""Numbers of the paper, with where they are from.

Read by the driver alone, and handed to the pieces when their cases have run.
"""

import csv
from collections.abc import Mapping
from dataclasses import dataclass
from importlib import resources
from typing import Any

from pyehl.errors import InternalError

FILE = "zhang2019.csv"


@dataclass(frozen=True, slots=True)
class Reference:
    """One number of the paper."""

    name: str  # of the number
    # As printed
    value: float
    unit: str
    # Where it stands, and how it was read: 'text', 'table', 'derived', 'digitised'
    page: str
    where: str
    how: str
    reading: float  # uncertainty of the reading, in its unit
    # Allowed deviation, in its unit; None: not compared, and `why` says why
    tolerance: float | None
    why: str  # what the tolerance is


References = Mapping[str, Reference]


def read_references() -> dict[str, Reference]:
    """Read the numbers of the paper."""
    file = resources.files("pyehl").joinpath("reproduce", "data", FILE)
    text = file.read_text(encoding="utf-8")
    found = {}
    for row in csv.DictReader(x for x in text.splitlines() if not x.startswith("#")):
        try:
            values: dict[str, Any] = dict(row)
            for key in ("value", "reading", "tolerance"):
                values[key] = float(row[key]) if row[key] or key != "tolerance" else None
            found[row["name"]] = Reference(**values)
        except (KeyError, TypeError, ValueError) as error:
            raise InternalError(f"{FILE}: a row is not complete: {row} ({error})") from error
    return found
