# SPDX-License-Identifier: BSD-3-Clause
"""The writer of pages: HTML in one file, with its style and its pictures in it.

Functions take plain text and escape it; what they return is HTML. A page may not load anything: it
tells the browser so, too.
"""

import base64
from collections.abc import Iterable, Mapping, Sequence
from html import escape
from pathlib import Path

from pyehl.destination import mark, new_file

STYLE = """
body{font-family:system-ui,sans-serif;max-width:62em;margin:2em auto;padding:0 1em;
line-height:1.45;color:#111;background:#fff}
h1{font-size:1.6em}h2{font-size:1.25em;border-bottom:1px solid #ccc;margin-top:1.8em}
figure{margin:1em 0}figcaption{font-size:.9em;color:#333}img{max-width:100%;height:auto}
.wide{overflow-x:auto}table{border-collapse:collapse;font-size:.9em;margin:.6em 0}
td,th{border:1px solid #ccc;padding:.2em .5em;text-align:left;vertical-align:top}
th{background:#f2f2f2}.verdict{padding:.6em .8em;border-left:.4em solid;background:#f7f7f7}
.pass{color:#006e4e}.care{color:#8a5a00}.fail{color:#b00020;font-weight:bold}
.verdict span{color:#111;font-weight:normal}
pre{background:#f5f5f5;padding:.6em;overflow-x:auto;font-size:.85em}
@media (max-width:40em){body{margin:.5em auto}h1{font-size:1.3em}table{font-size:.8em}}
@media print{body{max-width:none;margin:0;font-size:10pt}figure,tr{break-inside:avoid}
h2{break-after:avoid}pre{white-space:pre-wrap}.wide{overflow:visible}}
"""
# Nothing is loaded, whatever stands in the page
POLICY = "default-src 'none'; img-src data:; style-src 'unsafe-inline'"


def heading(text: str, anchor: str = "") -> str:
    """Begin a section; `anchor` is its name in links."""
    name = f' id="{escape(anchor)}"' if anchor else ""
    return f"<h2{name}>{escape(text)}</h2>"


def paragraph(text: str, kind: str = "") -> str:
    """Give a paragraph, of the class 'pass', 'care' or 'fail' or of none."""
    return f"<p{_kind(kind)}>{escape(text)}</p>"


def _kind(kind: str) -> str:
    return f' class="{escape(kind)}"' if kind else ""


def verdict(word: str, text: str, kind: str) -> str:
    """Give a judgement: a word, and why; 'pass', 'care' or 'fail'."""
    return (
        f'<p class="verdict {escape(kind)}"><b>{escape(word)}.</b> <span>{escape(text)}</span></p>'
    )


def bullets(texts: Iterable[str]) -> str:
    """Give a list."""
    return "<ul>" + "".join(f"<li>{escape(text)}</li>" for text in texts) + "</ul>"


def preformatted(text: str) -> str:
    """Give text as it stands, as of a file."""
    return f"<pre>{escape(text)}</pre>"


def folded(title: str, inner: str) -> str:
    """Hide HTML behind a title."""
    return f"<details><summary>{escape(title)}</summary>{inner}</details>"


def facts(rows: Mapping[str, str]) -> str:
    """Give a table of names and values."""
    cells = (f"<tr><th>{escape(k)}</th><td>{escape(v)}</td></tr>" for k, v in rows.items())
    return f'<div class="wide"><table>{"".join(cells)}</table></div>'


def table(
    names: Sequence[str], rows: Iterable[Sequence[str]], kinds: Iterable[str] | None = None
) -> str:
    """Give a table with a head; `kinds` is the class of the last cell of each row."""
    head = "".join(f"<th>{escape(name)}</th>" for name in names)
    body = []
    marks = iter(kinds or ())
    for row in rows:
        *cells, last = row
        inner = "".join(f"<td>{escape(cell)}</td>" for cell in cells)
        body.append(f"<tr>{inner}<td{_kind(next(marks, ''))}>{escape(last)}</td></tr>")
    return (
        f'<div class="wide"><table><thead><tr>{head}</tr></thead>'
        f"<tbody>{''.join(body)}</tbody></table></div>"
    )


def picture(png: bytes, alternative: str, caption: str) -> str:
    """Put a PNG into the page; `alternative` says in words what it shows."""
    data = base64.b64encode(png).decode()
    return (
        f'<figure><img alt="{escape(alternative)}" src="data:image/png;base64,{data}">'
        f"<figcaption>{escape(caption)}</figcaption></figure>"
    )


def page(title: str, parts: Iterable[str], command: str) -> str:
    """Give a whole page of HTML `parts`, which says which command made it."""
    return "\n".join(
        [
            '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">',
            f'<meta name="generator" content="{escape(mark(command))}">',
            '<meta name="viewport" content="width=device-width, initial-scale=1">',
            f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">',
            f"<title>{escape(title)}</title><style>{STYLE}</style></head><body>",
            f"<h1>{escape(title)}</h1>",
            *parts,
            "</body></html>\n",
        ]
    )


def write_page(path: Path, title: str, parts: Iterable[str], command: str) -> Path:
    """Write a page, whole or not at all; returns its path. FileError if it cannot be written."""
    with new_file(path) as partial:
        partial.write_text(page(title, parts, command), encoding="utf-8")
    return path
