# SPDX-License-Identifier: BSD-3-Clause
"""Fill the numbers of the documents from their records: python docs/numbers.

A marker in a page is `<!--NAME=EXPRESSION:FORMAT-->TEXT<!--/-->`. NAME is a function of a module
of this folder; EXPRESSION uses what it returns; TEXT is replaced. A marker does not begin a line,
unless a table is below it. `--check` writes nothing; its exit status is 1 if a page differs from
its records.
"""

from __future__ import annotations

import re
import sys
from functools import cache
from importlib import import_module
from pathlib import Path

import records
from records import ROOT, Values

MODULES = [path.stem for path in Path(__file__).parent.glob("[a-z]*.py") if path.stem != "records"]
MARKER = re.compile(r"<!--(\w+)=(.+?)-->(.*?)<!--/-->", re.DOTALL)


@cache
def values(name: str) -> Values:
    """Names that a function returns, and those of its module."""
    for module in map(import_module, MODULES):
        function = getattr(module, name, None)
        if callable(function) and function.__module__ == module.__name__:
            return {**vars(records), **vars(module), **function()}
    raise KeyError(f"no function {name}() in {', '.join(MODULES)}")


def filled(text: str) -> str:
    """Fill a page with the numbers of its records."""

    def made(match: re.Match[str]) -> str:
        name, expression, old = match.groups()
        new = str(eval(f'f"""{{{expression}}}"""', values(name)))
        if old.startswith("\n"):
            new = f"\n{new}\n\n"
        return f"<!--{name}={expression}-->{new}<!--/-->"

    return MARKER.sub(made, text)


def plain(text: str) -> str:
    """Remove the markers from a page."""
    return re.sub(r"<!--(?:\w+=.+?|/)-->", "", text)


def pages() -> list[Path]:
    """Find all pages with markers."""
    result = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
    return [page for page in result if MARKER.search(page.read_text(encoding="utf-8"))]


def main(words: list[str]) -> int:
    """Fill all pages, or compare them."""
    changed = False
    for page in pages():
        text = page.read_text(encoding="utf-8")
        new = filled(text)
        for (_, expression, old), (_, _, made) in zip(
            MARKER.findall(text), MARKER.findall(new), strict=True
        ):
            if old != made:
                changed = True
                print(f"{page.relative_to(ROOT)}: {expression}: {old!r} is {made!r}")
        if words != ["--check"]:
            page.write_text(new, encoding="utf-8")
    return int(changed and words == ["--check"])


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
