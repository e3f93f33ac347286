# SPDX-License-Identifier: BSD-3-Clause
"""What docs/robustness.md says of random cases and of faults is in their records."""

from pathlib import Path

import pytest
from document_text import plain


@pytest.fixture(scope="module")
def page(root: Path) -> str:
    return plain(root / "docs" / "robustness.md")


@pytest.fixture(scope="module")
def stress(script):
    return script("docs/evidence/stress/make.py")


def test_the_page_shows_the_campaigns(page: str, stress, script):
    assert "\n".join(stress.lines()) in page
    assert "\n".join(script("docs/evidence/faults/make.py").lines()) in page


def test_the_record_is_of_the_scenes_that_the_command_draws(stress):
    from stress_cases import draw

    rows = stress.read()
    scenes = draw(len(rows), 1)
    assert [row["family"] for row in rows] == [scene.family for scene in scenes]
    assert [float(row["moes_m"]) for row in rows] == [scene.moes_m for scene in scenes]


def test_what_the_page_says_of_how_cases_end(page: str, stress):
    rows = stress.read()
    checked = [row for row in rows if row["difference"]]
    largest = max(float(row["difference"]) / float(row["allowed"]) for row in checked)
    assert f"None of {len(checked)}: the largest difference is {largest:.2f} of" in page
    films = [row for row in rows if row["outcome"] == "negative film"]
    coarse = [
        r for r in films if 0.16 * float(r["moes_m"]) * (4.0 / (int(r["points"]) - 1)) ** 2 > 0.6
    ]
    assert f"**Negative film**, {len(films)} cases: {len(coarse)} of them on grids" in page
    for outcome in ("cycle limit", "diverged", "not settled"):
        ended = [row for row in rows if row["outcome"] == outcome]
        if ended:
            assert f"**{outcome.capitalize()}**, {len(ended)} case" in page
