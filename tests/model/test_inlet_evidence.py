# SPDX-License-Identifier: BSD-3-Clause
"""Contacts that touch on grids that do not resolve their inlet: docs/evidence/inlet."""

from itertools import islice
from pathlib import Path

import pytest

import pyehl
from pyehl.schema import summary_of


@pytest.fixture(scope="module")
def evidence(script):
    return script("docs/evidence/inlet/make.py")


@pytest.fixture(scope="module")
def text(root: Path) -> str:
    return (root / "docs/evidence/inlet/README.md").read_text(encoding="utf-8")


def test_the_page_shows_the_table(text: str, evidence):
    rows = evidence.read()
    assert "\n".join(evidence.lines()) in text
    assert f"{len({row['contact'] for row in rows})} contacts drawn with a seed" in text
    good, told = evidence.by_two_grids(rows)
    assert f"would cover {good} of {told} central films" in text


def test_the_page_shows_when_cycles_end(text: str, script):
    shares = script("docs/evidence/inlet/share.py")
    assert "\n".join(shares.lines()) in text


def test_stated_errors_cover_the_finest_grid(evidence):
    """At least 95 % of each quantity, and some grid tells the share of every contact."""
    rows = evidence.read()
    for name in evidence.QUANTITIES:
        found = evidence.covered(rows, name).values()
        told, good = (sum(part[k] for part in found) for k in (0, 1))
        assert told > 40
        assert good >= 0.95 * told, name
    # without a number there is none but on grids that do not resolve the inlet
    for row in rows:
        if row["status"] == "converged" and not row["contact_load_share"]:
            assert float(row["missed"]) > 0.12
            assert not row["mu"]


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
    found = summary_of(pyehl.solve(case))
    for name in ("h_c_m", "h_c_error_m", "h_min_m", "contact_load_share"):
        if row[name]:
            assert found[name] == pytest.approx(float(row[name]), rel=1e-3), name
        else:
            assert name not in found
