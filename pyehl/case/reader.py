# SPDX-License-Identifier: BSD-3-Clause
"""From the text of a case and options group.key=value to values, each with its place.

Every fault ends in one message with its place.
"""

import re
from collections.abc import Iterable
from functools import lru_cache
from typing import NoReturn

from pyehl.case import names
from pyehl.case.complete import complete
from pyehl.case.draft import LONGEST_PATH, Draft, Place
from pyehl.case.key import NUMBER, TRUTHS, Key, Value
from pyehl.case.settings import GROUPS, KEYS, Settings
from pyehl.case.source import (
    ATOM,
    COMMA,
    END,
    EQUALS,
    GROUP,
    OPEN_STRING,
    SLASH,
    STRING,
    Piece,
    Source,
)
from pyehl.errors import InputError
from pyehl.given import TYPED

# A line as the writer of cases makes it
LINE = re.compile(
    r"[ \t]*(\w+) = ('(?:[^']|'')*'|\.true\.|\.false\.|-?\d[\d.]*(?:e[-+]?\d+)?) *(?:!.*)?",
    re.ASCII,
)
MARKS = ("! default", "! derived")
"""Ends of lines of a written case whose keys were not given: defaults, and what follows."""
NO_VALUE = (COMMA, SLASH, EQUALS, GROUP, END)


class _Bad(Exception):  # noqa: N818
    """What is wrong with a value, and how far behind its beginning."""

    def __init__(self, problem: str, behind: int = 0) -> None:
        super().__init__(problem)
        self.behind = behind


def read(text: str, origin: str, options: Iterable[str] = ()) -> Draft:
    """Read a case, without completing it.

    Parameters
    ----------
    text
        Namelist text.
    origin
        Name of the file it came from, for messages and for relative file names.
    options
        Options group.key=value that replace values of the text, behind '--set ' where a person
        typed them so.
    """
    sources = [
        Source(origin, text + "\n"),
        *(Source(o, o.removeprefix(TYPED) + "\n", has_lines=False) for o in options),
    ]
    draft = Draft(Settings(), sources)
    replaced = set()
    for source in sources[1:]:
        try:
            replaced.add(_option(source)[0].name)
        except InputError:
            pass  # told when it is read
    marked = _Groups(draft, replaced).read()
    if marked:
        draft = _settled(draft, marked)
    for number in range(1, len(sources)):
        _read_option(draft, number)
    return draft


class _Groups:
    """The groups of a case file, key by key."""

    def __init__(self, draft: Draft, replaced: set[str]) -> None:
        self.draft, self.replaced = draft, replaced
        self.source = draft.sources[0]
        self.position = 0
        self.group, self.opening = "", Piece(END, 0, 0, "")
        self.marked: set[str] = set()

    def read(self) -> set[str]:
        """Read all groups; the keys that the text says nobody gave."""
        self.source.check_characters()
        seen: set[str] = set()
        while (opening := self._next()).kind != END:
            self.group, self.opening = self._opened(opening, seen), opening
            key: Key | None = None
            while True:
                while (found := self._written_line()) is not None:
                    key = found
                name = self._next()
                if name.kind == COMMA and key:
                    name = self._next()
                    if name.kind != SLASH:
                        self._refuse_list(name, key)
                if name.kind == SLASH:
                    break
                key = self._key(name, key)
        return self.marked

    def _next(self) -> Piece:
        piece = self.source.scan(self.position)
        self.position = min(piece.end, len(self.source.text))
        return piece

    def _opened(self, opening: Piece, seen: set[str]) -> str:
        """Open a known group for the first time."""
        group = opening.text.lower()
        expected = f"one of the groups {names.groups('&')}"
        if opening.kind != GROUP:
            what = "text outside of a group"
        elif group not in GROUPS:
            what = f"unknown group &{opening.text}"
            expected = names.unknown_group(opening.text, "&")
        elif group in seen:
            what, expected = f"group &{group} is there twice", "all keys of a group in one place"
        else:
            seen.add(group)
            return group
        self.source.refuse(opening.first, opening.end, what, expected)

    def _written_line(self) -> Key | None:
        """Read a line as the writer makes it, which is quick; None where it is not so."""
        text, start = self.source.text, self.position
        if text[start : start + 1] == "\n":
            start += 1
        end = text.find("\n", start)
        found = _written(self.group, text[start:end])
        if found is None or found[0].name in self.draft.given:
            return None
        key, value, (first, name_end, value_first, value_end), is_marked = found
        place = Place(0, start + first, start + name_end, start + value_first, start + value_end)
        self.draft.given[key.name] = place
        self.draft.settings.set(key, value)
        if is_marked:
            self.marked.add(key.name)
        self.position = end
        return key

    def _key(self, name: Piece, before: Key | None) -> Key:
        """Read a key, whose name was read, and its value."""
        source = self.source
        if name.kind in (GROUP, END):
            line = source.line(self.opening.first)
            what = f"group &{self.group}, opened in line {line}, is not closed"
            source.refuse(min(name.first, source.length), name.end, what, "'/'")
        self._equals(name, before)
        key = _find(source, self.group, name, self.draft.given)
        value = self._next()
        self._check_value(key, value)
        self._set(key, (name.first, name.end), value)
        rest = source.text[value.end :].partition("\n")[0].partition("\r")[0].rstrip(" ")
        if rest.endswith(MARKS):
            self.marked.add(key.name)
        return key

    def _set(self, key: Key, name: tuple[int, int], value: Piece) -> None:
        try:
            _set(self.draft, key, 0, name, value)
        except InputError:
            # a value that an option replaces need not be acceptable
            if key.name not in self.replaced:
                raise

    def _refuse_list(self, name: Piece, key: Key) -> None:
        """Refuse a second value; every key takes one. `name` stands behind a comma."""
        if name.kind == COMMA:
            what = "two commas behind "
        elif name.kind in (STRING, OPEN_STRING) or (
            name.kind == ATOM and name.text[0] in "0123456789+-.*"
        ):
            what = "second value for "
        else:
            return
        expected = "one value, then the next key or '/'"
        self.source.refuse(name.first, name.end, what + key.name, expected)

    def _equals(self, name: Piece, before: Key | None) -> None:
        """Read '=' behind a key; without it, say what the text behind the last value may be."""
        behind = self.position
        if name.kind == ATOM:
            if self._next().kind == EQUALS:
                return
            full = f"{self.group}.{name.text.lower()}"
            if full in KEYS:
                self.source.refuse(behind, behind + 1, f"no '=' behind {full}", "'=' and a value")
        what, expected = f"unexpected text in &{self.group}", "a key of the group, or '/'"
        if before is not None:
            what = f"text behind the value of {before.name}"
            if name.kind == ATOM:
                what = what if before.unit == "-" else f"unit or other {what}"
                expected = f"{before.expected} and nothing else, then the next key or '/'"
        self.source.refuse(name.first, name.end, what, expected)

    def _check_value(self, key: Key, value: Piece) -> None:
        """Refuse a value that is not there, and a decimal comma as in '0,84'."""
        source = self.source
        missing = value.kind in NO_VALUE
        if value.kind == ATOM:
            # the key behind it?
            equals = source.scan(self.position).kind == EQUALS
            missing = equals and re.match("[A-Za-z_]", value.text) is not None
        if missing:
            first = min(value.first, source.length)
            source.refuse(first, value.end, f"no value for {key.name}", key.expected)
        if value.kind == ATOM and re.match("[0-9],[0-9]", source.text[value.end - 1 :][:3]):
            what = f"decimal comma in the value of {key.name}"
            expected = f"{key.expected}, with a decimal point"
            source.refuse(value.end, value.end + 1, what, expected)


# The cases of a study differ in a line or two
@lru_cache(maxsize=2048)
def _written(group: str, line: str) -> tuple[Key, Value, tuple[int, int, int, int], bool] | None:
    """Give key, value and their places of a line that the writer makes, and whether it is marked.

    None for any other line, and for a value that is not acceptable.
    """
    match = LINE.fullmatch(line)
    key = KEYS.get(f"{group}.{match[1]}") if match else None
    if match is None or key is None:
        return None
    is_string = match[2][0] == "'"
    text = match[2][1:-1].replace("''", "'") if is_string else match[2]
    try:
        value = _value(key, Piece(STRING if is_string else ATOM, 0, 0, text), is_option=False)
    except _Bad:
        return None
    return key, value, (*match.span(1), *match.span(2)), line.rstrip(" ").endswith(MARKS)


def _find(source: Source, group: str, name: Piece, given: dict[str, Place]) -> Key:
    """Give a key by its name; unknown and repeated keys are faults."""
    key = KEYS.get(f"{group}.{name.text.lower()}")
    if key is None:
        what = f"unknown key '{name.text}' in &{group}"
        source.refuse(name.first, name.end, what, names.unknown_key(name.text, group))
    if key.name in given and source.has_lines:
        what = f"key {key.name} is there twice"
        source.refuse(name.first, name.end, what, "every key once")
    return key


def _option(source: Source) -> tuple[Key, int]:
    """Give the key of an option group.key=value, and where its name begins."""
    text = source.text
    equals = text.find("=")
    dot = text.find(".", 0, max(equals, 0))
    if dot < 0:
        source.refuse(0, len(text), "option is not complete", "group.key=value")
    group = text[:dot].strip(" ").lower()
    if group not in GROUPS:
        expected = names.unknown_group(group)
        source.refuse(0, max(1, dot), f"unknown group '{group}'", expected)
    name = Piece(ATOM, dot + 1, max(dot + 2, equals), text[dot + 1 : equals].strip(" "))
    return _find(source, group, name, {}), name.first


def _read_option(draft: Draft, number: int) -> None:
    """Read one option; words need no quotes here."""
    source = draft.sources[number]
    key, name_first = _option(source)
    text = source.text
    equals = text.index("=")
    last = len(text.rstrip(" \n"))
    first = equals + 1
    while text[first : first + 1] == " ":
        first += 1
    value = source.scan(first)
    if key.name in draft.given and draft.given[key.name].source > 0:
        source.refuse(0, equals, f"key {key.name} is set twice", "every key once")
    if first >= last:
        source.refuse(equals + 1, equals + 2, f"no value for {key.name}", key.expected)
    if value.kind == STRING and value.end < last:
        what = f"text behind the value of {key.name}"
        source.refuse(value.end, last, what, "nothing more")
    if value.kind != STRING:
        # without quotes the rest of the option is the value, whatever it looks like
        value = Piece(ATOM, first, last, text[first:last])
    _set(draft, key, number, (name_first, max(name_first + 1, equals)), value)


def _set(draft: Draft, key: Key, number: int, name: tuple[int, int], value: Piece) -> None:
    """Give a key its value and remember where it came from."""
    source = draft.sources[number]
    if value.kind == OPEN_STRING:
        what = f"the quote in the value of {key.name} is not closed"
        source.refuse(value.first, value.end, what, key.expected)
    draft.given[key.name] = Place(number, *name, value.first, value.end)
    try:
        found = _value(key, value, is_option=number > 0)
    except _Bad as bad:
        _refuse_value(source, key, value, bad)
    setattr(getattr(draft.settings, key.group), key.key, found)


def _refuse_value(source: Source, key: Key, value: Piece, bad: _Bad) -> NoReturn:
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
    source.refuse(value.first + bad.behind, value.end, what, expected)


def _value(key: Key, value: Piece, *, is_option: bool) -> Value:
    """Give the value of a piece of text; _Bad with what is wrong with it."""
    if key.kind in ("real", "whole"):
        return _number(key, value, is_option=is_option)
    if key.kind == "truth":
        if value.kind == STRING:
            raise _Bad("text where a truth value is wanted")
        truth = TRUTHS.get(value.text.lower())
        if truth is None:
            raise _Bad("not a truth value")
        return truth
    if value.kind == ATOM and not is_option:
        what = {"word": "word", "path": "file name"}.get(key.kind, "text")
        raise _Bad(f"no quotes around the {what}")
    if key.kind == "word":
        word = key.by_word.get(value.text.lower().rstrip(" "))
        if word is None:
            raise _Bad("no such choice")
        return word
    if len(value.text.encode(errors="surrogateescape")) > LONGEST_PATH:
        raise _Bad(f"longer than {LONGEST_PATH} characters")
    return value.text


def _number(key: Key, piece: Piece, *, is_option: bool) -> float | int:
    text = piece.text
    if piece.kind == STRING:
        raise _Bad("text where a number is wanted")
    match = NUMBER.match(text)
    if match is None or match.end() < len(text):
        if "," in text:
            raise _Bad("decimal comma, or more than one value")
        if text.lstrip("+-").lower().startswith(("nan", "inf")):
            raise _Bad("not a finite number")
        if "*" in text:
            raise _Bad("not one plain number")
        if match is None:
            raise _Bad("not a number")
        raise _Bad("text behind the number", match.end())
    value = float(text.lower().replace("d", "e"))
    if abs(value) == float("inf"):
        raise _Bad("too large for a number")
    if key.kind == "whole" and not (text.lstrip("+-").isdigit() or (is_option and value % 1 == 0)):
        raise _Bad("not a whole number")
    if not key.allows(value):
        raise _Bad("out of range")
    return int(value) if key.kind == "whole" else value


def _settled(draft: Draft, marked: set[str]) -> Draft:
    """Take a marked value as not given if it is what follows from those that were given.

    So an option on a written case does the same as on the case that it was written from, and a
    value that somebody has changed counts as given.
    """
    trial = Draft(Settings(), draft.sources[:1])
    settled = Draft(Settings(), draft.sources)
    for name, place in draft.given.items():
        if name not in marked:
            key = KEYS[name]
            value = draft.settings.value(key)
            for other in (trial, settled):
                other.settings.set(key, value)
                other.given[name] = place
    complete(trial, strict=False)
    for name in marked:
        key = KEYS[name]
        if (value := draft.settings.value(key)) != trial.settings.value(key):
            settled.settings.set(key, value)
            settled.given[name] = draft.given[name]
    return settled
