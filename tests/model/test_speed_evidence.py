# SPDX-License-Identifier: BSD-3-Clause
"""The tables of docs/speed.md and docs/robustness.md are those of docs/evidence/speed."""

from __future__ import annotations

from pathlib import Path

import pytest


@pytest.fixture(scope="module")
def evidence(script):
    return script("docs/evidence/speed/make.py")


@pytest.mark.parametrize(
    ("page", "table"),
    [("speed", "steps"), ("speed", "smooth"), ("speed", "sweep"), ("robustness", "skips")],
)
def test_the_pages_show_the_tables(root: Path, evidence, page: str, table: str):
    text = (root / "docs" / f"{page}.md").read_text(encoding="utf-8")
    assert "\n".join(getattr(evidence, table)()) in text


def test_skipping_changes_no_result(evidence):
    """Nor do the figures that the page calls a tolerance leave it."""
    rows = evidence.rows("skips")
    assert len({row["scene"] for row in rows}) == 4
    for row in rows:
        assert float(row["difference"]) <= float(row["allowed"])
        assert float(row["seconds"]) <= 1.05 * float(row["without"])


def test_stated_errors_of_smooth_contacts(evidence):
    """From 129 nodes on the error that a run states is at least two thirds of the true one."""
    rows = [row for row in evidence.rows("smooth") if int(row["points"]) >= 129]
    assert rows
    for row in rows:
        assert row["status"] == "converged"
        assert float(row["error"]) <= 1.5 * float(row["estimated_error"])
