# SPDX-License-Identifier: BSD-3-Clause
"""The keys of a case, and numbers as namelists and messages write them."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from decimal import Decimal
from functools import cached_property
from typing import Any, TypeVar

# Range of numbers that are written without an exponent
MIN_DECIMAL, MAX_DECIMAL = 1e-4, 1e7


def to_text(value: bool | int | float | str | tuple[float, ...]) -> str:
    """Write a value as in a namelist: 0.4, 2.2e-8, 600.0, .true., 'harmonic'."""
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
    if MIN_DECIMAL <= abs(value) < MAX_DECIMAL:
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
    """Put a text between single quotes, inner quotes doubled as in a namelist."""
    return "'" + text.replace("'", "''") + "'"


def short(value: float) -> str:
    """Write four digits of a number, for messages: 0.04, 2.26e11."""
    mantissa, _, exponent = f"{value:.4g}".partition("e")
    return f"{mantissa}e{int(exponent)}" if exponent else mantissa


Value = bool | int | float | str | tuple[float, ...]

NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][-+]?\d+)?", re.ASCII)
TRUTHS = {
    **dict.fromkeys((".true.", "true", "t", ".t."), True),
    **dict.fromkeys((".false.", "false", "f", ".f."), False),
}


@dataclass(frozen=True)
class Key:
    """One key of a case.

    Attributes
    ----------
    group, key
        Its names in a namelist.
    kind
        'real', 'whole', 'truth', 'word', 'path', 'text', or 'numbers'.
    unit
        Of a number; '-' for none.
    allowed
        Numbers: an interval as '(0, 10]' or '0 or [1, 5]'; words: 'this|that'.
    meaning
        In a sentence.
    default_value
        Value if it is neither given nor derived from other keys.
    """

    group: str
    key: str
    kind: str
    unit: str
    allowed: str
    meaning: str
    default_value: Value

    @cached_property
    def name(self) -> str:
        """``group.key``."""
        return f"{self.group}.{self.key}"

    @cached_property
    def default(self) -> str:
        """The default as in a namelist."""
        return to_text(self.default_value)

    @cached_property
    def for_input(self) -> bool:
        """Whether users may give it, not only pyehl."""
        return not self.meaning.endswith("not for input")

    @cached_property
    def choices(self) -> list[str]:
        """Allowed words."""
        return self.allowed.split("|")

    @cached_property
    def by_word(self) -> dict[str, str]:
        """Allowed words by their lower-case form."""
        return {word.lower(): word for word in self.choices}

    @cached_property
    def interval(self) -> tuple[float, float, bool, bool]:
        """Ends of the allowed interval, whether the lower is excluded, whether 0 is added."""
        inner = self.allowed.removeprefix("0 or ")
        low, high = inner[1:-1].split(",")
        return float(low), float(high), inner[0] == "(", inner != self.allowed

    def allows(self, value: float) -> bool:
        """Whether a number lies in the allowed interval."""
        low, high, is_open, or_zero = self.interval
        return (low <= value <= high and not (is_open and value == low)) or (
            or_zero and value == 0.0
        )

    @cached_property
    def expected(self) -> str:
        """Description of the values that the key takes, with its range."""
        if self.kind in ("real", "whole"):
            kind = "a number" if self.kind == "real" else "a whole number"
            unit = f" (unit {self.unit}, not written)" if self.unit != "-" else ""
            return f"{kind}{unit} in {self.allowed}"
        if self.kind == "word":
            *words, last = map(quoted, self.choices)
            return "".join(f"{word}, " for word in words) + f"or {last}"
        return {
            "truth": ".true. or .false.",
            "path": "a file name between quotes",
            "text": "a text between quotes",
            "numbers": "numbers separated by commas"
            if self.for_input
            else "what pyehl writes; lubricant.table names measured values",
        }[self.kind]

    def in_millimetres(self, number: str) -> str:
        """Give '; 9.525 mm is 9.525e-3' for the number of a radius probably in mm, or ''."""
        if not self.key.startswith("radius") or self.unit != "m" or re.search("[eEdD]", number):
            return ""
        if not NUMBER.fullmatch(number) or abs(float(number)) < 1.0:
            return ""
        return f"; {number} mm is {number}e-3"


T = TypeVar("T")


def typed(kind: type[T], group: Mapping[str, Any]) -> T:
    """Give a group of a resolved case as attributes; missing keys have their defaults."""
    names = kind.__dataclass_fields__  # type: ignore[attr-defined]
    return kind(**{key: value for key, value in group.items() if key in names})


def real(default: float, unit: str, allowed: str, meaning: str) -> Any:  # noqa: ANN401
    """Describe a key that takes a number."""
    return _field("real", default, unit, allowed, meaning)


def whole(default: int, allowed: str, meaning: str) -> Any:  # noqa: ANN401
    """Describe a key that takes a whole number."""
    return _field("whole", default, "-", allowed, meaning)


def truth(default: bool, meaning: str) -> Any:  # noqa: ANN401
    """Describe a key that takes a truth value."""
    return _field("truth", default, "-", ".true.|.false.", meaning)


def word(default: str, allowed: str, meaning: str) -> Any:  # noqa: ANN401
    """Describe a key that takes one of some words."""
    return _field("word", default, "-", allowed, meaning)


def path(meaning: str) -> Any:  # noqa: ANN401
    """Describe a key that takes the name of a file."""
    return _field("path", "", "-", "", meaning)


def text(meaning: str) -> Any:  # noqa: ANN401
    """Describe a key that takes any text."""
    return _field("text", "", "-", "", meaning)


def numbers(unit: str, meaning: str) -> Any:  # noqa: ANN401
    """Describe a key that takes any number of numbers."""
    return _field("numbers", (), unit, "", meaning)


def _field(kind: str, default: Value, unit: str, allowed: str, meaning: str) -> Any:  # noqa: ANN401
    metadata = {"kind": kind, "unit": unit, "allowed": allowed, "meaning": meaning}
    return field(default=default, metadata=metadata)
