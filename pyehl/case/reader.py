# SPDX-License-Identifier: BSD-3-Clause
"""Parse the text of a case and options group.key=value into values, each with its place.

Every error gives one message with its place.
"""

import re
from collections.abc import Iterable
from functools import lru_cache

from pyehl import namelist
from pyehl.case import names
from pyehl.case.complete import complete
from pyehl.case.key import Key, Value
from pyehl.case.settings import GROUPS, KEYS, Draft, Place, Settings
from pyehl.case.source import (
    ATOM,
    COMMA,
    END,
    EQUALS,
    GROUP,
    OPEN_STRING,
    SLASH,
    STRING,
    Source,
    Token,
)
from pyehl.case.value import BadValue, set_value, value_of
from pyehl.errors import InputError
from pyehl.given import TYPED

MARKS = ("! default", "! derived")
"""Ends of lines of a resolved case whose keys were not given: defaults and derived values."""
NO_VALUE = (COMMA, SLASH, EQUALS, GROUP, END)


def read(text: str, origin: str, options: Iterable[str] = ()) -> Draft:
    """Read a case, without completing it.

    Parameters
    ----------
    text
        Namelist text.
    origin
        Name of the file it came from, for messages and for relative file names.
    options
        Options group.key=value that replace values of the text, after '--set ' if they come from
        the command line.

    Returns
    -------
    Draft
        Its values and the places of the given keys; values that a resolved case marks as derived
        count as given only where they differ from those that follow from the other keys.

    Raises
    ------
    InputError
        With name, line and column, what was expected, and the nearest name.
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
            pass  # reported when it is read
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
        self.group, self.opening = "", Token(END, 0, 0, "")
        self.marked: set[str] = set()

    def read(self) -> set[str]:
        """Read all groups; returns the keys that the text marks as not given."""
        self.source.check_characters()
        seen: set[str] = set()
        while (opening := self._next()).kind != END:
            self.group, self.opening = self._opened(opening, seen), opening
            key: Key | None = None
            while True:
                while (result := self._written_line()) is not None:
                    key = result
                name = self._next()
                if name.kind == COMMA and key:
                    name = self._next()
                    if name.kind != SLASH:
                        self._refuse_list(name, key)
                if name.kind == SLASH:
                    break
                key = self._key(name, key)
        return self.marked

    def _next(self) -> Token:
        token = self.source.scan(self.position)
        self.position = min(token.end, len(self.source.text))
        return token

    def _opened(self, opening: Token, seen: set[str]) -> str:
        """Open a known group for the first time."""
        group = opening.text.lower()
        expected = f"one of the groups {names.groups('&')}"
        if opening.kind != GROUP:
            what = "text outside of a group"
        elif group not in GROUPS:
            what = f"unknown group &{opening.text}"
            expected = names.unknown_group(opening.text, "&")
        elif group in seen:
            what, expected = f"group &{group} is given twice", "all keys of a group in one place"
        else:
            seen.add(group)
            return group
        self.source.refuse(opening.first, opening.end, what, expected)

    def _written_line(self) -> Key | None:
        """Read a line in the form of the writer, the fast path; None for another form."""
        text, start = self.source.text, self.position
        if text[start : start + 1] == "\n":
            start += 1
        end = text.find("\n", start)
        result = _written(self.group, text[start:end])
        if result is None or result[0].name in self.draft.given:
            return None
        key, value, (first, name_end, value_first, value_end), is_marked = result
        place = Place(0, start + first, start + name_end, start + value_first, start + value_end)
        self.draft.given[key.name] = place
        self.draft.settings.set(key, value)
        if is_marked:
            self.marked.add(key.name)
        self.position = end
        return key

    def _key(self, name: Token, before: Key | None) -> Key:
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

    def _set(self, key: Key, name: tuple[int, int], value: Token) -> None:
        try:
            set_value(self.draft, key, 0, name, value)
        except InputError:
            # a value that an option replaces need not be acceptable
            if key.name not in self.replaced:
                raise

    def _refuse_list(self, name: Token, key: Key) -> None:
        """Refuse a second value; every key takes one. `name` follows a comma."""
        if name.kind == COMMA:
            what = "two commas after "
        elif name.kind in (STRING, OPEN_STRING) or (
            name.kind == ATOM and name.text[0] in "0123456789+-.*"
        ):
            what = "second value for "
        else:
            return
        expected = "one value, then the next key or '/'"
        self.source.refuse(name.first, name.end, what + key.name, expected)

    def _equals(self, name: Token, before: Key | None) -> None:
        """Read '=' after a key; if it is missing, refuse the text after the last value."""
        after = self.position
        if name.kind == ATOM:
            if self._next().kind == EQUALS:
                return
            full = f"{self.group}.{name.text.lower()}"
            if full in KEYS:
                self.source.refuse(after, after + 1, f"no '=' after {full}", "'=' and a value")
        what, expected = f"unexpected text in &{self.group}", "a key of the group, or '/'"
        if before is not None:
            what = f"text after the value of {before.name}"
            if name.kind == ATOM:
                what = what if before.unit == "-" else f"unit or other {what}"
                expected = f"{before.expected} and nothing else, then the next key or '/'"
        self.source.refuse(name.first, name.end, what, expected)

    def _check_value(self, key: Key, value: Token) -> None:
        """Refuse a missing value, and a decimal comma as in '0,84'."""
        source = self.source
        missing = value.kind in NO_VALUE
        if value.kind == ATOM:
            # it may be the next key
            equals = source.scan(self.position).kind == EQUALS
            missing = equals and re.match("[A-Za-z_]", value.text) is not None
        if missing:
            first = min(value.first, source.length)
            source.refuse(first, value.end, f"no value for {key.name}", key.expected)
        if value.kind == ATOM and re.match("[0-9],[0-9]", source.text[value.end - 1 :][:3]):
            what = f"decimal comma in the value of {key.name}"
            expected = f"{key.expected}, with a decimal point"
            source.refuse(value.end, value.end + 1, what, expected)


# The cases of a study differ in one or two lines
@lru_cache(maxsize=2048)
def _written(group: str, line: str) -> tuple[Key, Value, tuple[int, int, int, int], bool] | None:
    """Give key, value and places of a line in the form of the writer, and whether it is marked.

    None for any other line, and for a value that is not acceptable.
    """
    match = namelist.LINE.fullmatch(line)
    key = KEYS.get(f"{group}.{match[1]}") if match else None
    if match is None or key is None:
        return None
    marked = line.rstrip(" \r").endswith(MARKS)
    spans = (*match.span(1), *match.span(2))
    if key.kind == "numbers":
        return key, tuple(map(float, match[2].split(","))), spans, marked
    is_string = match[2][0] == "'"
    text = match[2][1:-1].replace("''", "'") if is_string else match[2]
    try:
        value = value_of(key, Token(STRING if is_string else ATOM, 0, 0, text), is_option=False)
    except BadValue:
        return None
    return key, value, spans, marked


def _find(source: Source, group: str, name: Token, given: dict[str, Place]) -> Key:
    """Find a key by its name; unknown and repeated keys are errors."""
    key = KEYS.get(f"{group}.{name.text.lower()}")
    if key is None:
        what = f"unknown key '{name.text}' in &{group}"
        source.refuse(name.first, name.end, what, names.unknown_key(name.text, group))
    if key.name in given and source.has_lines:
        what = f"key {key.name} is given twice"
        source.refuse(name.first, name.end, what, "every key once")
    return key


def _option(source: Source) -> tuple[Key, int]:
    """Find the key of an option group.key=value, and where its name begins."""
    text = source.text
    equals = text.find("=")
    dot = text.find(".", 0, max(equals, 0))
    if dot < 0:
        source.refuse(0, len(text), "option is not complete", "group.key=value")
    group = text[:dot].strip(" ").lower()
    if group not in GROUPS:
        expected = names.unknown_group(group)
        source.refuse(0, max(1, dot), f"unknown group '{group}'", expected)
    name = Token(ATOM, dot + 1, max(dot + 2, equals), text[dot + 1 : equals].strip(" "))
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
        what = f"text after the value of {key.name}"
        source.refuse(value.end, last, what, "nothing more")
    if value.kind != STRING:
        # without quotes the rest of the option is the value, whatever it looks like
        value = Token(ATOM, first, last, text[first:last])
    set_value(draft, key, number, (name_first, max(name_first + 1, equals)), value)


def _settled(draft: Draft, marked: set[str]) -> Draft:
    """Treat a marked value as not given if it follows from the given ones.

    An option then has the same effect on a resolved case as on the original one, and a value that
    was edited counts as given.
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
