# SPDX-License-Identifier: BSD-3-Clause
"""Load shares of a boundary film: docs/evidence/contact says what its table has."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import pytest


@pytest.fixture(scope="module")
def evidence(script):
    return script("docs/evidence/contact/make.py")


def test_the_page_shows_the_tables(root: Path, evidence):
    text = (root / "docs/evidence/contact/README.md").read_text(encoding="utf-8")
    for load, _, stress, *_ in (evidence.HEAVY, evidence.LIGHT, evidence.THIN):
        assert "\n".join(evidence.lines(load, stress)) in text


def test_how_often_stated_errors_cover_the_next_grid(root: Path, evidence):
    rows = {tuple(float(row[key]) for key in evidence.KEYS): row for row in evidence.read()}
    known = covered = 0
    for key, row in rows.items():
        finer = rows.get((*key[:-1], 2.0 * key[-1] - 1.0))
        if not row["contact_load_share_error"] or finer is None:
            continue
        if not finer["contact_load_share"] or float(finer["contact_load_share"]) == 0.0:
            continue
        change = float(finer["contact_load_share"]) - float(row["contact_load_share"])
        known += 1
        covered += abs(change) <= float(row["contact_load_share_error"])
    text = (root / "docs/evidence/contact/README.md").read_text(encoding="utf-8")
    assert f"covers the next change in {covered} of {known} rows" in text


def test_the_shares_converge_with_order_two(root: Path, evidence):
    text = (root / "docs/evidence/contact/README.md").read_text(encoding="utf-8")
    rows = {tuple(float(row[key]) for key in evidence.KEYS): row for row in evidence.read()}
    load, height, stress, *_ = evidence.LIGHT
    ratios, changes = [], []
    for layer, grids in ((4e-8, (129, 257, 513, 1025)), (8e-8, (129, 257, 513))):
        found = [
            float(rows[(load, height, stress, layer, float(points))]["contact_load_share"])
            for points in grids
        ]
        steps = [one - two for one, two in pairwise(found)]
        ratios += [f"{one / two:.1f}" for one, two in pairwise(steps)]
        changes += [
            f"{100.0 * step / one:.0f}" for step, one in zip(steps[1:], found[1:-1], strict=True)
        ]
    said = "over {} at 40 nm, that from 513 to 1025 over {}; at 80 nm that from 257 to 513 over {}"
    assert said.format(*ratios) in text
    said = (
        "by {} % of itself at 40 nm and from 513 to 1025 by {} %, at 80 nm from 257 to 513 by {} %"
    )
    assert said.format(*changes) in text


def test_this_build_makes_the_stored_shares(evidence):
    """On the coarsest grid, where the inlet is not resolved and everything touches."""
    row = evidence.read()[0]
    found = evidence.simulated(
        {key: float(row[key]) for key in evidence.KEYS[:-1]} | {"points": 65}
    )
    for name in ("contact_load_share", "contact_area_share", "layer_supply", "mu"):
        assert found[name] == pytest.approx(float(row[name]), rel=1e-6), name
