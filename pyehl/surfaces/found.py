# SPDX-License-Identifier: BSD-3-Clause
"""What a reader finds in a file of a height map, before the case has its say."""

import re
from dataclasses import dataclass, field

from pyehl.types import Array

Sizes = tuple[float | None, float | None]

UNITS = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "nm": 1e-9}
"""Metres in the units of `surface.height_unit` and `surface.lateral_unit`."""

# Metres in the units that headers name; a micro sign is two characters of Unicode, and in a file of
# another encoding it is none
_SPELT = {
    r"nm|nanomet(?:er|re)s?|ナノメートル": 1e-9,
    r"[uµμ\ufffd]m|microns?|micromet(?:er|re)s?|mikrometer|マイクロメートル": 1e-6,
    r"mm|millimet(?:er|re)s?": 1e-3,
    r"cm|centimet(?:er|re)s?": 1e-2,
    r"pm|picomet(?:er|re)s?": 1e-12,
    r"å|angstr[oö]ms?": 1e-10,
    r"m|met(?:er|re)s?": 1.0,
}
UNIT = f"(?:{'|'.join(_SPELT)})"
"""Regular expression of a unit of length, without regard to case."""
_WHOLE = {re.compile(spelt, re.IGNORECASE): metres for spelt, metres in _SPELT.items()}


def unit_of(text: str) -> float | None:
    """Metres in a unit of length as headers spell it; None for another word."""
    word = text.strip().strip("()[]")
    # Mm and MM are no megametres in the header of an instrument
    found = (metres for spelt, metres in _WHOLE.items() if spelt.fullmatch(word))
    return next(found, None)


@dataclass(slots=True)
class Found:
    """A height map as its file has it, with what the file says of units and size."""

    # (nx, ny) in the numbers of the file, NaN where missing
    heights: Array
    # Metres in the unit of these numbers; None where the file names none
    height_unit: float | None = None
    # Along x and y: [m], or in the numbers of the file; None where the file has no size
    size: Sizes = (None, None)
    size_in_metres: bool = True
    # Whether the unit of the size must be given, and is not that of the heights by default
    ask_lateral_unit: bool = False
    # Whether it is an array, with no word about how it came about
    is_array: bool = False
    is_periodic: bool = False
    channel: str = ""
    notes: list[str] = field(default_factory=list)
    # Why there is no size, where it is not that the file has none
    no_size: str = ""
