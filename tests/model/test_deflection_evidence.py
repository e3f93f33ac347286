# SPDX-License-Identifier: BSD-3-Clause
"""Error of the multi-integration: the pages show the tables of docs/evidence."""

from pathlib import Path
from types import ModuleType

import pytest
from document_text import plain
from workprec import share_of_deflection


@pytest.fixture(scope="module")
def evidence(script) -> ModuleType:
    return script("docs/evidence/deflection/make.py")


def test_this_build_makes_the_stored_errors(evidence):
    for (points, accuracy), stored in zip(evidence.runs(), evidence.read(), strict=True):
        result = evidence.row(points, accuracy)
        for name in evidence.NAMES[:4]:
            assert result[name] == stored[name], (points, accuracy, name)
        # rounding is a part of the interpolation error with 16 points
        for name in ("accuracy", "error", "discretisation", "inside"):
            assert result[name] == pytest.approx(stored[name], rel=1e-3, abs=1e-13), (points, name)


@pytest.mark.long
def test_share_in_the_friction_of_a_short_wave(root: Path):
    result = share_of_deflection()
    share = f"{100.0 * result['share']:.1f} % of the grid error there"
    text = plain(root / "docs/evidence/workprec/README.md")
    assert f"an error of {100.0 * result['difference']:.2f} % in μ_r/μ_s" in text
    assert share in text
