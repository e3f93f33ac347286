# SPDX-License-Identifier: BSD-3-Clause
"""A named text: its tokens with positions, and error messages that point into it.

Positions are those of Python slices: the first character, and the one after the last.
"""

import os
import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple, NoReturn

from pyehl.case.key import NUMBER
from pyehl.errors import InputError

# Maximum number of characters of a line that a message shows
SHOWN = 100
CONTROL = re.compile(r"[\x00-\x08\x0a-\x1f\x7f]")
NO_TEXT = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f]")
BLANKS = " \t\r\n"

END, GROUP, ATOM, STRING, OPEN_STRING, EQUALS, COMMA, SLASH = (
    *("end", "group", "atom", "string", "open_string"),
    *("equals", "comma", "slash"),
)
_ATOM = r"[^ \t\r\n,/=!'\"&;]"
# Blanks and comments, then a token; a character that cannot begin a token is a token itself
TOKEN = re.compile(
    r"(?>(?:[ \t\r\n]+|![^\n]*)*)"
    rf"(?:(?P<atom>{_ATOM}+)|(?P<equals>=)|(?P<comma>,)|(?P<slash>/)|(?P<group>&{_ATOM}*)"
    r"|(?P<string>'(?:[^'\n]|'')*'(?!')|\"(?:[^\"\n]|\"\")*\"(?!\"))"
    r"|(?P<open_string>['\"][^\n]*)|(?P<other>.))"
)


class Token(NamedTuple):
    """One token of a text.

    `text` has the characters of an atom, the name of a group without '&', a string without its
    quotes.
    """

    kind: str
    first: int
    end: int
    text: str


@dataclass(slots=True)
class Source:
    """The text of a case file, or of one option.

    Attributes
    ----------
    name
        Its name in messages: a file name, or the option as it was given.
    text
        Ends with a line end.
    has_lines
        Whether messages give line and column.
    """

    name: str
    text: str
    has_lines: bool = True

    def scan(self, position: int) -> Token:
        """Give the token at or after a position; '!' starts a comment."""
        match = TOKEN.match(self.text, position)
        if match is None:
            return Token(END, len(self.text), len(self.text) + 1, "")
        kind = match.lastgroup or END
        first, end = match.span(kind)
        text = match[kind]
        if kind == STRING:
            text = text[1:-1].replace(2 * text[0], text[0])
        elif kind == GROUP:
            text = text[1:]
        elif kind == "other":
            kind = ATOM
        return Token(kind, first, end, text)

    @property
    def length(self) -> int:
        """Length of the text without blanks and line ends at its end."""
        return len(self.text.rstrip(BLANKS))

    def line(self, position: int) -> int:
        """Line of a position, from 1."""
        return self.text.count("\n", 0, position) + 1

    def check_characters(self) -> None:
        """Refuse control characters other than tabs and line ends."""
        if (match := NO_TEXT.search(self.text)) is not None:
            code = ord(match[0])
            what = f"this is not a text file (byte {code})"
            self.refuse(match.start(), match.end(), what, "namelist text")

    def rows(self) -> Iterator[tuple[int, str]]:
        """Lines of a table and where they begin, without those that are blank or begin with '#'."""
        first = 0
        for line in self.text.removesuffix("\n").split("\n"):
            if line.strip() and not line.lstrip().startswith("#"):
                yield first, line
            first += len(line) + 1

    def number(self, first: int, line: str, name: str, cell: str) -> float:
        """Read a cell of a line of a table as a number, or refuse the line."""
        text = cell.strip()
        if not NUMBER.fullmatch(text):
            self.refuse(first, first + len(line), f"{name} = '{text}'", "a number")
        return float(text.lower().replace("d", "e"))

    def refuse(self, first: int, end: int, what: str, expected: str) -> NoReturn:
        """Refuse text[first:end]: InputError with a message of four lines.

        ``name:line:column: error: what``, line and column only if it `has_lines`; the line; carets
        under the error; what was expected.
        """
        start = self.text.rfind("\n", 0, first) + 1
        finish = self.text.find("\n", start)
        # a long line is cut around the error
        begin = first - SHOWN // 2 if first - start > SHOWN - 20 else start
        place, margin = self.name, "  "
        if self.has_lines:
            number = self.line(first)
            place += f":{number}:{first - start + 1}"
            margin += f"{number} "
        shown = CONTROL.sub(" ", self.text[begin : min(finish, begin + SHOWN)])
        blanks = re.sub(r"[^\t]", " ", self.text[begin:first])
        carets = "^" * max(1, min(end, finish) - first)
        message = (
            f"{place}: error: {what}\n{margin}| {shown}\n{' ' * len(margin)}| {blanks}{carets}\n"
            f"expected: {expected}"
        )
        # bytes that are not UTF-8 cannot be printed
        raise InputError(message.encode(errors="surrogateescape").decode(errors="replace"))


MAX_BYTES = 1_000_000
"""Maximum size of a case or table in bytes."""
BYTE_ORDER_MARK = "\ufeff"


def read_text(path: str, expected: str) -> str:
    """Read the text of a file, without a byte order mark.

    InputError with what was expected if it cannot be read. Bytes that are not UTF-8 become
    surrogates.
    """
    try:
        text = _text(path)
    except OSError as error:
        text = f"cannot open: {error.strerror}"
    except _Refused as refused:
        text = str(refused)
    else:
        return text.removeprefix(BYTE_ORDER_MARK)
    raise InputError(f"{path}: error: {text}\nexpected: {expected}")


class _Refused(Exception):  # noqa: N818
    """Why a file is not read."""


def _text(path: str) -> str:
    if not os.path.exists(path):
        raise _Refused("there is no such file")
    if os.path.isdir(path):
        raise _Refused("this is a folder, not a file")
    if not os.path.isfile(path):
        raise _Refused("this is a device or a pipe, not a file")
    with open(path, "rb") as file:
        data = file.read(MAX_BYTES + 1)
    if len(data) > MAX_BYTES:
        raise _Refused(f"not a file of at most {MAX_BYTES} bytes")
    return data.decode(errors="surrogateescape")
