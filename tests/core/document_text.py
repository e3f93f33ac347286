# SPDX-License-Identifier: BSD-3-Clause
"""Parts of a document: its fenced blocks, their commands, and the output they show."""

import math
import re
import shlex
from pathlib import Path

ROOT = Path(__file__).parents[2]
DOCUMENTS = (
    "README.md",
    "CONTRIBUTING.md",
    "cases/README.md",
    "benchmarks/README.md",
    "tests/README.md",
    "fortran/README.md",
    *sorted(path.relative_to(ROOT).as_posix() for path in (ROOT / "docs").glob("**/*.md")),
)
NUMBER = r"\d+(?:\.\d+)?(?:[eE][-+]?\d+)?"
# Values that differ from machine to machine
_FREE = re.compile(rf"(?<=residual )\s*{NUMBER}|\d+(?= ms\b)")


def plain(path: Path) -> str:
    """Text of a page without the markers of `python docs/numbers`."""
    return re.sub(r"<!--(?:\w+=.+?|/)-->", "", path.read_text(encoding="utf-8"))


def fences(path: Path) -> list[tuple[str, str]]:
    """Languages and texts of the fenced blocks, in order."""
    return re.findall(r"^```(\S+)\n(.*?)^```$", path.read_text(), re.MULTILINE | re.DOTALL)


def blocks(path: Path, language: str) -> list[str]:
    """Fenced blocks of a language."""
    return [text for result, text in fences(path) if result == language]


def lines_of(block: str) -> list[str]:
    """Lines of a shell block without their comments."""
    return [" ".join(shlex.split(x, comments=True)) for x in block.splitlines() if x.strip()]


def commands(path: Path) -> list[str]:
    """Lines of all shell blocks without their comments."""
    return [line for block in blocks(path, "sh") for line in lines_of(block)]


def is_shown(shown: str, printed: str) -> bool:
    """Whether a line of a document is a printed one.

    Words and integers must be equal, other numbers to 0.2 %; ``...`` matches anything.
    """
    shown, printed = (_FREE.sub("#", line.rstrip()) for line in (shown, printed))
    parts = [
        f"({NUMBER})".join(map(re.escape, re.split(NUMBER, part))) for part in shown.split("...")
    ]
    match = re.fullmatch(".*".join(parts), printed)
    if match is None:
        return False
    return all(
        b == a if a.isdigit() and b.isdigit() else math.isclose(float(a), float(b), rel_tol=2e-3)
        for a, b in zip(re.findall(NUMBER, shown), match.groups(), strict=True)
    )
