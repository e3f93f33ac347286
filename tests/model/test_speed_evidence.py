# SPDX-License-Identifier: BSD-3-Clause
"""Times in docs/speed.md and docs/robustness.md are those of docs/evidence/speed."""

from pathlib import Path

import pytest


@pytest.fixture(scope="module")
def evidence(script):
    return script("docs/evidence/speed/make.py")


@pytest.mark.parametrize("name", ["steps", "whole", "smooth", "ratios", "sweep"])
def test_the_page_of_speed_shows_the_table(root: Path, evidence, name: str):
    text = (root / "docs" / "speed.md").read_text(encoding="utf-8")
    assert "\n".join(getattr(evidence, name)()) in text


def test_the_page_of_robustness_shows_what_is_skipped(root: Path, evidence):
    text = (root / "docs" / "robustness.md").read_text(encoding="utf-8")
    assert "\n".join(evidence.skips()) in text


def test_skipped_work_changes_nothing_beyond_what_is_allowed(evidence):
    for row in evidence.table("skips"):
        assert float(row["difference"]) <= float(row["allowed"]), row["skipped"]
