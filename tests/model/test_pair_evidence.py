# SPDX-License-Identifier: BSD-3-Clause
"""Predicted and simulated pairs of rough surfaces: docs/evidence/pairs states what it states."""

import sys
from pathlib import Path

import pytest

import pyehl


@pytest.fixture(scope="module")
def pairs(root: Path):
    """The modules of the evidence of pairs, and the rows of a table of it by name."""
    folder = root / "docs" / "evidence" / "pairs"
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(folder))
        import compare

        yield sys.modules["cases"], compare
        for name in ("compare", "cases"):
            sys.modules.pop(name)


@pytest.mark.parametrize("name", ["p05wf", "p20ff", "p30mf", "n10wf"])
def test_pair_is_still_predicted(pairs, name):
    """By the version of today as before the simulation; so little may change by the lattice."""
    cases, compare = pairs
    (row,) = (row for row in cases.rows() if row["name"] == name)
    result = pyehl.predict(cases.case(row), **cases.surfaces(row), tracks=1)
    table = compare.read("table.csv")[name]
    assert result.mu_ratio == pytest.approx(float(table["prediction_now"]), rel=1e-3)
    assert abs(result.mu_ratio - float(table["mu_ratio"])) <= result.model_error
