# SPDX-License-Identifier: BSD-3-Clause
"""HTML pages in one file, with embedded style and pictures.

A page is a list of blocks of plain text and numbers; the template ``page.html`` renders and escapes
them. A page loads no other resource, and its security policy forbids that.
"""

import base64
from collections.abc import Callable, Iterable, Mapping, Sequence
from importlib import resources
from itertools import repeat
from pathlib import Path
from typing import Any

from pyehl.destination import mark, new_file

Block = dict[str, Any]
"""A part of a page: its ``form``, and what the template needs for it."""
Part = Block | str
"""A block, or HTML that is not escaped."""


def heading(text: str, anchor: str = "") -> Block:
    """Begin a section; `anchor` is its name in links."""
    return {"form": "heading", "text": text, "anchor": anchor}


def paragraph(text: str, kind: str = "") -> Block:
    """Make a paragraph, optionally of the class 'pass', 'care' or 'fail'."""
    return {"form": "paragraph", "text": text, "kind": kind}


def verdict(word: str, text: str, kind: str) -> Block:
    """Make an assessment: a term, its reason, and 'pass', 'care' or 'fail'."""
    return {"form": "verdict", "word": word, "text": text, "kind": kind}


def bullets(texts: Iterable[str]) -> Block:
    """Make a list."""
    return {"form": "bullets", "texts": list(texts)}


def preformatted(text: str) -> Block:
    """Make a block of preformatted text."""
    return {"form": "preformatted", "text": text}


def folded(title: str, inner: Block) -> Block:
    """Hide a block behind a title."""
    return {"form": "folded", "title": title, "inner": inner}


def facts(rows: Mapping[str, str]) -> Block:
    """Make a table of names and values."""
    return {"form": "table", "rows": [(row, "") for row in rows.items()]}


def table(
    names: Sequence[str], rows: Iterable[Sequence[str]], kinds: Iterable[str] = repeat("")
) -> Block:
    """Make a table with a head; `kinds` is the class of the last cell of each row."""
    return {"form": "table", "names": names, "rows": list(zip(rows, kinds, strict=False))}


def picture(png: bytes, alternative: str, caption: str) -> Block:
    """Embed a PNG; `alternative` describes it in words."""
    data = base64.b64encode(png).decode()
    return {"form": "picture", "data": data, "alternative": alternative, "caption": caption}


def render(
    title: str, parts: Iterable[Part], command: str, hide: Callable[[Any], Any] | None = None
) -> str:
    """Render a page with the mark of its command; `hide` is applied to its content."""
    from jinja2 import Environment  # noqa: PLC0415 (slow to import)

    text = resources.files("pyehl").joinpath("reports", "page.html").read_text(encoding="utf-8")
    template = Environment(autoescape=True, finalize=hide).from_string(text)
    return template.render(title=title, parts=parts, generator=mark(command)) + "\n"


def write_page(path: Path, title: str, parts: Iterable[Part], command: str) -> Path:
    """Write a page, whole or not at all; returns its path. FileError if it cannot be written."""
    return write_text(path, render(title, parts, command))


def write_text(path: Path, text: str) -> Path:
    """Write a rendered page, as `write_page`."""
    with new_file(path) as partial:
        partial.write_text(text, encoding="utf-8")
    return path
