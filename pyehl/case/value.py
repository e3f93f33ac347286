# SPDX-License-Identifier: BSD-3-Clause
"""Convert a token to the value of a key, or refuse it with the reason."""

from typing import NoReturn

from pyehl.case import names
from pyehl.case.key import NUMBER, TRUTHS, Key, Value
from pyehl.case.settings import LONGEST_PATH, Draft, Place
from pyehl.case.source import ATOM, OPEN_STRING, STRING, Source, Token


class BadValue(Exception):  # noqa: N818
    """Problem of a value, and its offset in the text."""

    def __init__(self, problem: str, offset: int = 0) -> None:
        super().__init__(problem)
        self.offset = offset


def set_value(draft: Draft, key: Key, number: int, name: tuple[int, int], value: Token) -> None:
    """Set the value of a key, and record its place."""
    source = draft.sources[number]
    if value.kind == OPEN_STRING:
        what = f"the quote in the value of {key.name} is not closed"
        source.refuse(value.first, value.end, what, key.expected)
    draft.given[key.name] = Place(number, *name, value.first, value.end)
    try:
        result = value_of(key, value, is_option=number > 0)
    except BadValue as bad:
        _refuse_value(source, key, value, bad)
    setattr(getattr(draft.settings, key.group), key.key, result)


def _refuse_value(source: Source, key: Key, value: Token, bad: BadValue) -> NoReturn:
    problem, expected = str(bad), key.expected
    if problem == "out of range":
        expected += key.in_millimetres(value.text)
    # units are too short to be near each other
    if key.kind == "word" and any(len(choice) > 2 for choice in key.choices):
        near = names.nearest(value.text, key.choices)
        expected += f"; did you mean '{near}'?" if near else ""
    shown = source.text[value.first : value.end]
    if len(shown) > 60:
        shown = f"{shown[:57]}..."
    what = f"{key.name} = {shown}: {problem}"
    source.refuse(value.first + bad.offset, value.end, what, expected)


def value_of(key: Key, value: Token, *, is_option: bool) -> Value:
    """Convert a token to a value; BadValue with the problem."""
    if key.kind in ("real", "whole"):
        return _number(key, value, is_option=is_option)
    if key.kind == "truth":
        if value.kind == STRING:
            raise BadValue("text where a truth value is expected")
        truth = TRUTHS.get(value.text.lower())
        if truth is None:
            raise BadValue("not a truth value")
        return truth
    if key.kind == "numbers":
        return _numbers(key, value)
    if value.kind == ATOM and not is_option:
        what = {"word": "word", "path": "file name"}.get(key.kind, "text")
        raise BadValue(f"no quotes around the {what}")
    if key.kind == "word":
        word = key.by_word.get(value.text.lower().rstrip(" "))
        if word is None:
            raise BadValue("no such choice")
        return word
    if len(value.text.encode(errors="surrogateescape")) > LONGEST_PATH:
        raise BadValue(f"longer than {LONGEST_PATH} bytes")
    return value.text


def _numbers(key: Key, token: Token) -> tuple[float, ...]:
    if not key.for_input:
        raise BadValue("not for input")
    cells = [cell.strip() for cell in token.text.split(",")]
    if not all(NUMBER.fullmatch(cell) for cell in cells):
        raise BadValue("not numbers separated by commas")
    return tuple(float(cell.lower().replace("d", "e")) for cell in cells)


def _number(key: Key, token: Token, *, is_option: bool) -> float | int:
    text = token.text
    if token.kind == STRING:
        raise BadValue("text where a number is expected")
    match = NUMBER.match(text)
    if match is None or match.end() < len(text):
        if "," in text:
            raise BadValue("decimal comma, or more than one value")
        if text.lstrip("+-").lower().startswith(("nan", "inf")):
            raise BadValue("not a finite number")
        if "*" in text:
            raise BadValue("not a single number")
        if match is None:
            raise BadValue("not a number")
        raise BadValue("text after the number", match.end())
    value = float(text.lower().replace("d", "e"))
    if abs(value) == float("inf"):
        raise BadValue("too large for a number")
    if key.kind == "whole" and not (text.lstrip("+-").isdigit() or (is_option and value % 1 == 0)):
        raise BadValue("not a whole number")
    if not key.allows(value):
        raise BadValue("out of range")
    return int(value) if key.kind == "whole" else value
