# SPDX-License-Identifier: BSD-3-Clause
"""Films as thin as the roughness: docs/evidence/thin_film says what its tables say."""

from __future__ import annotations

import math
from pathlib import Path

import pytest


@pytest.fixture(scope="module")
def evidence(script):
    return script("docs/evidence/thin_film/make.py")


def test_the_page_shows_the_tables(root: Path, evidence):
    text = (root / "docs/evidence/thin_film/README.md").read_text(encoding="utf-8")
    assert "\n".join(evidence.lines()) in text


def test_what_the_page_says_of_fast_contacts(root: Path, evidence):
    """At 6 m/s both grids have the same friction, and a film that the prediction has not."""
    known = {
        row["seed"]: row
        for row in evidence.read("predicted.csv")
        if (row["speed"], row["flow"]) == ("6", "consistent")
    }
    rows = [
        row
        for row in evidence.read("simulated.csv")
        if float(row["speed"]) == 6.0 and row["flow"] == "consistent"
    ]
    assert len(rows) == 4
    low = []
    for seed in ("1", "2"):
        coarse, fine = (row for row in rows if row["seed"] == seed)
        ratios = [evidence.number(row, "mu_ratio") for row in (coarse, fine)]
        assert ratios[0] == pytest.approx(ratios[1], abs=3.5e-4)
        assert abs(ratios[1] - 1.0) < 0.005
        assert 17e-9 < evidence.number(coarse, "h_min_rough_m")
        assert evidence.number(coarse, "h_min_rough_m") < evidence.number(fine, "h_min_rough_m")
        missing = evidence.number(fine, "h_min_rough_m")
        missing -= evidence.number(known[seed], "h_min_rough_m")
        low.append(f"{1e9 * missing:.0f}")
    text = (root / "docs/evidence/thin_film/README.md").read_text(encoding="utf-8")
    assert f"too low by {low[0]} and {low[1]} nm" in text


def test_the_predictions_are_those_of_this_build(evidence):
    (row,) = (
        r
        for r in evidence.read("predicted.csv")
        if (r["seed"], float(r["speed"]), r["flow"]) == ("1", 6.0, "consistent")
    )
    found = evidence.predicted(1, 6.0, "consistent")
    assert found["status"] == row["status"]
    assert found["h_min_rough_m"] == pytest.approx(float(row["h_min_rough_m"]), rel=1e-3)
    assert math.isnan(evidence.number(row, "mu_ratio")) == (found["mu_ratio"] is None)
