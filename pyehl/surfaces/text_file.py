# SPDX-License-Identifier: BSD-3-Clause
"""Text as programs on all kinds of machines write it: its encoding."""

import codecs
from collections.abc import Iterator
from pathlib import Path

SAMPLE = 2**16
"""Bytes that tell the encoding of a file."""
_MARKS = {
    codecs.BOM_UTF8: "utf-8-sig",
    codecs.BOM_UTF32_LE: "utf-32",
    codecs.BOM_UTF16_LE: "utf-16",
    codecs.BOM_UTF16_BE: "utf-16",
}
# Characters of control that text has: tabs, ends of lines and pages, and the end of a DOS file
_CONTROL = set(b"\t\n\v\f\r\x1a")


def encoding_of(path: Path) -> str | None:
    """Find the encoding of a text by its first bytes; None if it is no text."""
    with path.open("rb") as stream:
        first = stream.read(SAMPLE)
    for mark, name in _MARKS.items():
        if first.startswith(mark):
            return name
    half = len(first) // 2
    for zeros, others, name in ((1, 0, "utf-16-le"), (0, 1, "utf-16-be")):
        # text of digits has a zero in every pair of bytes
        if first[zeros::2].count(0) > 0.8 * half > 0 and not first[others::2].count(0):
            return name
    if any(byte < 32 and byte not in _CONTROL for byte in first):
        return None
    try:
        codecs.getincrementaldecoder("utf-8")().decode(first)
    except UnicodeDecodeError:
        return "latin-1"
    return "utf-8"


def lines_of(path: Path, encoding: str) -> Iterator[tuple[int, str]]:
    """Lines of a text without their ends, with their numbers from 1."""
    with path.open(encoding=encoding, errors="replace") as lines:
        for number, line in enumerate(lines, 1):
            # the mark of the order of bytes, where files were joined
            yield number, line.rstrip("\r\n\x1a\ufeff").lstrip("\ufeff")
