# SPDX-License-Identifier: BSD-3-Clause
"""What a study varies: a key of a case file and the values it takes."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import islice
from typing import Any

import numpy as np

from pyehl.errors import InputError
from pyehl.given import Value, by_key, check_kind, plain

FORMS = (
    "start:stop:count, start:stop:countlog (geometric spacing), start:stop (whole numbers), "
    "or values with commas between"
)
MAX_VALUES = 1_000_000
LOGICAL = {".true.": True, ".false.": False}


@dataclass(frozen=True, slots=True)
class Axis:
    """One key ``group.name`` of a case file and its values."""

    key: str  # ``group.name``
    values: tuple[Value, ...]  # all of one type: float, int, bool or str


def parse_axis(text: str) -> Axis:
    """Read ``group.key=VALUES``, as behind ``--vary``.

    Raises
    ------
    InputError
        If it is not of one of the forms ``start:stop:count``, ``start:stop:countlog``,
        ``start:stop`` or a list with commas.

    Examples
    --------
    >>> from pyehl.studies.vary import parse_axis
    >>> parse_axis("contact.mean_velocity=0.01:1:3log").values
    (0.01, 0.1, 1.0)
    >>> parse_axis("surface.seed=1:3").values
    (1, 2, 3)
    """
    key, equals, values = (part.strip() for part in text.partition("="))
    if not equals or not key or not values:
        raise InputError(f"--vary {text}: expected group.key=VALUES, VALUES being {FORMS}")
    return axis(key, values)


def axes_of(vary: Mapping[str, Any]) -> list[Axis]:
    """Give the axes of values by ``group.key``, or by group and key; InputError as `axis`."""
    check_kind(vary, Mapping, "vary", "values by key, as {'contact.load': [100.0, 200.0]}")
    return [axis(key, values) for key, values in by_key(vary, "vary")]


def axis(key: str, values: str | Iterable[Any] | Value) -> Axis:
    """Give the axis of a key from a text as behind ``--vary``, a sequence or one value.

    InputError if there are no values, or they are not numbers, truth values or words.
    """
    key = key.strip().lower()
    try:
        if isinstance(values, str) and ":" in values:
            found = _spaced(values)
        elif isinstance(values, str):
            found = [_word(word.strip()) for word in values.split(",")]
        elif isinstance(values, Iterable):
            found = [plain(value) for value in islice(values, MAX_VALUES + 1)]
        else:
            found = [plain(values)]
    except ValueError as error:
        raise InputError(f"{key} = {values!r}: {error}; expected {FORMS}") from error
    if not found:
        raise InputError(f"{key}: there are no values; expected {FORMS}")
    if len(found) > MAX_VALUES:
        raise InputError(f"{key}: more than {MAX_VALUES} values, the most that a study can have")
    if len({type(value) for value in found}) > 1:
        if not all(isinstance(v, int | float) and not isinstance(v, bool) for v in found):
            raise InputError(f"{key}: numbers and words together: {found}")
        found = [float(value) for value in found]
    return Axis(key, tuple(found))


def _spaced(text: str) -> list[Value]:
    parts = [part.strip() for part in text.split(":")]
    if len(parts) == 2:
        first, last = int(parts[0]), int(parts[1])
        if last < first:
            raise ValueError("the second number is less than the first")
        _check_count(last - first + 1)
        return list(range(first, last + 1))
    if len(parts) != 3:
        raise ValueError("neither two nor three numbers with ':' between")
    geometric = parts[2].endswith("log")
    count = int(parts[2].removesuffix("log"))
    _check_count(count)
    start, stop = float(parts[0]), float(parts[1])
    if not np.isfinite([start, stop]).all():
        raise ValueError("a number is not finite")
    if geometric and not (start > 0.0 and stop > 0.0):
        raise ValueError("geometric spacing needs two positive numbers")
    # round off what the last digits of a power miss: 0.1 and not 0.10000000000000002
    spaced = [
        float(f"{v:.12g}") for v in (np.geomspace if geometric else np.linspace)(start, stop, count)
    ]
    spaced[0] = start
    if count > 1:
        spaced[-1] = stop
    whole = all(p.lstrip("+-").isdigit() for p in parts[:2]) and all(v == int(v) for v in spaced)
    return [int(v) for v in spaced] if whole else list(spaced)


def _check_count(count: int) -> None:
    if not 1 <= count <= MAX_VALUES:
        raise ValueError(f"{count} values; there can be 1 to {MAX_VALUES}")


def _word(word: str) -> Value:
    """Read a value as it stands in a case file."""
    if not word:
        raise ValueError("a value is missing")
    if word.lower() in LOGICAL:
        return LOGICAL[word.lower()]
    for kind in (int, float):
        try:
            return kind(word)
        except ValueError:
            continue
    if word[0] in "'\"" and word[-1] == word[0] and len(word) > 1:
        word = word[1:-1].replace(2 * word[0], word[0])
    return word
