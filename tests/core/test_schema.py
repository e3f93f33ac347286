# SPDX-License-Identifier: BSD-3-Clause
"""The table of quantities and what writes summaries say the same."""

from __future__ import annotations

import re
from pathlib import Path

import pyehl
from pyehl import schema
from pyehl.prediction.film_sheet import sheet

UNITS = {"_Pa_s": "Pa s", "_per_Pa": "1/Pa", "_m_per_s": "m/s", "_per_s": "1/s", "_Pa": "Pa",
         "_seconds": "s", "_N": "N", "_K": "K", "_m": "m"}  # fmt: skip


def names(kind: str) -> set[str]:
    return {q.name for q in schema.QUANTITIES if kind in q.kinds}


def test_every_quantity_once():
    listed = [q.name for q in schema.QUANTITIES]
    assert len(listed) == len(set(listed))
    assert all(q.meaning and q.kinds for q in schema.QUANTITIES)


def test_names_end_in_their_unit():
    for q in schema.QUANTITIES:
        end = next((end for end in UNITS if q.name.endswith(end)), None)
        if end and q.name != "moes_m":
            assert q.unit == UNITS[end], q.name
        if q.unit in ("m", "Pa", "N", "K"):
            assert end, q.name


def test_solutions(root: Path):
    """All names that the Fortran library puts into a summary."""
    written = set()
    for path in (root / "fortran").rglob("*.f90"):
        if path.parent.name != "test":
            named = r'call (?:(?:record|summary)%set\(|error%add\(record, )"(\w+)"'
            written |= set(re.findall(named, path.read_text()))
    assert len(written) > 50
    # Python adds how it prepared a map that it read
    assert written == names("solution") - {"surface_preparation"}


def test_predictions(tmp_path: Path):
    p = pyehl.predict(pyehl.Case.from_text("&surface kind = 'fractal' pixels = 64 /"))
    # the folder lists its files
    assert {*p.summary, "files"} == names("prediction")


def test_film_sheets():
    written = set()
    for kind in ("smooth", "harmonic", "fractal"):
        written |= set(sheet(pyehl.Case.from_text(f"&surface kind = '{kind}' /").resolve()))
    assert written == names("film")


def test_markdown_has_a_line_for_each():
    assert len(schema.markdown().splitlines()) == 2 + len(schema.QUANTITIES)
