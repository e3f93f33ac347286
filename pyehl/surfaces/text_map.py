# SPDX-License-Identifier: BSD-3-Clause
"""Height maps as text: one x per line, y along the line."""

import re
from pathlib import Path

import numpy as np

from pyehl.errors import InputError
from pyehl.surfaces.memory import check_pixels
from pyehl.types import Array

# What stands between separators
WORD = re.compile(r"[^\s,;]+")
DECIMAL = re.compile(r"[^\s;]+")
OWN_SIZE = re.compile(r"^#\s*(length_[xy])\s*=\s*(\S+)\s*m\s*$")
OWN_PERIODIC = re.compile(r"^#\s*periodic\s*$")


def read_text(path: Path, first: int = 1) -> tuple[Array, tuple[float | None, float | None], bool]:
    """Heights from a line on, the size if the header has it, and whether it says 'periodic'."""
    size: dict[str, float | None] = {"length_x": None, "length_y": None}
    periodic = False
    rows: list[Array] = []
    with path.open(encoding="utf-8", errors="replace") as lines:
        for number, line in enumerate(lines, 1):
            if match := OWN_SIZE.match(line):
                size[match[1]] = float(match[2])
            periodic = periodic or bool(OWN_PERIODIC.match(line))
            row = _row(path, number, line) if number >= first else None
            if row is None:
                continue
            if rows and row.size != rows[0].size:
                raise InputError(
                    f"{path}:{number}:{_column(line, rows[0].size)}: {row.size} heights, but "
                    f"{rows[0].size} in the lines above"
                )
            rows.append(row)
            if len(rows) % 1024 == 0:
                check_pixels(str(path), (len(rows), row.size))
    if not rows:
        raise InputError(f"{path}: no heights in the file")
    return np.array(rows), (size["length_x"], size["length_y"]), periodic


def _row(path: Path, number: int, line: str) -> Array | None:
    """Heights of one line; None for an empty one."""
    text = line.partition("#")[0].rstrip()
    # where something else separates the numbers a comma is a decimal comma
    if ";" in text or "\t" in text.strip():
        text = text.replace(",", ".").replace(";", " ")
    if "," in text:
        # "1,2 3,4" would otherwise be read as four heights
        commas = text.count(",")
        text = text.replace(",", " ")
        words = text.split()
        if commas not in (len(words) - 1, len(words)):
            raise InputError(
                f"{path}:{number}:{line.index(',') + 1}: commas and blanks both separate the "
                "numbers; if the comma is a decimal comma, write a point, or a semicolon between "
                "the numbers"
            )
    else:
        words = text.split()
    if not words:
        return None
    try:
        return np.array(words, dtype=float)
    except ValueError:
        bad = next(n for n, word in enumerate(words) if not _is_number(word))
        raise InputError(
            f"{path}:{number}:{_column(line, bad)}: {words[bad]!r} is no number; expected: heights"
        ) from None


def count_numbers(line: str) -> int:
    """Count the numbers of a line of heights; 0 for a line of anything else."""
    try:
        row = _row(Path(), 0, line)
    except InputError:
        return 0
    return 0 if row is None else row.size


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True


def _column(line: str, index: int) -> int:
    """Column of a word of a line, from 1; behind its last one where it has fewer."""
    text = line.partition("#")[0]
    words = list((DECIMAL if ";" in text or "\t" in text.strip() else WORD).finditer(text))
    return words[index].start() + 1 if index < len(words) else words[-1].end() + 1
