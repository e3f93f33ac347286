# SPDX-License-Identifier: BSD-3-Clause
"""Predicted and simulated pairs of rough surfaces, as published in docs/evidence/pairs."""

import sys
from pathlib import Path

import pytest

import pyehl


@pytest.fixture(scope="module")
def pairs(root: Path):
    """The modules of the evidence of pairs, and the rows of one of its tables by name."""
    folder = root / "docs" / "evidence" / "pairs"
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(folder))
        import compare

        yield sys.modules["cases"], compare
        for name in ("compare", "cases"):
            sys.modules.pop(name)


@pytest.mark.parametrize("name", ["p05wf", "p20ff", "p30mf", "n10wf"])
def test_pair_is_still_predicted(pairs, name):
    """The prediction equals the published one within 0.1 %, the simulation within its error."""
    cases, compare = pairs
    (row,) = (row for row in cases.rows() if row["name"] == name)
    result = pyehl.predict(cases.case(row), **cases.surfaces(row), tracks=1)
    table = compare.read("table.csv")[name]
    assert result.mu_ratio == pytest.approx(float(table["prediction_now"]), rel=1e-3)
    assert abs(result.mu_ratio - float(table["mu_ratio"])) <= result.model_error
