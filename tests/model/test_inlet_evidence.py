# SPDX-License-Identifier: BSD-3-Clause
"""Contact on grids that do not resolve the inlet: docs/evidence/inlet."""

from itertools import islice
from pathlib import Path

import pytest

import pyehl
from pyehl.schema import summary_of


@pytest.fixture(scope="module")
def evidence(script):
    return script("docs/evidence/inlet/make.py")


def test_the_page_shows_when_cycles_end(root: Path, script):
    text = (root / "docs/evidence/inlet/README.md").read_text(encoding="utf-8")
    shares = script("docs/evidence/inlet/share.py")
    assert "\n".join(shares.lines()) in text


@pytest.mark.parametrize(("number", "points"), [(0, 129), (2, 257)])
def test_this_build_makes_rows_of_the_table(evidence, number, points):
    """A grid that does not resolve the inlet, and one that does."""
    (row,) = (
        row
        for row in evidence.read()
        if (int(row["contact"]), int(row["points"])) == (number, points)
    )
    keys, _ = next(islice(evidence.contacts(), number, None))
    case = pyehl.Case.from_text("", keys | {"grid.points": points, "solver.max_cycles": 100})
    result = summary_of(pyehl.solve(case))
    for name in ("h_c_m", "h_c_error_m", "h_min_m", "contact_load_share"):
        if row[name]:
            assert result[name] == pytest.approx(float(row[name]), rel=1e-3), name
        else:
            assert name not in result
