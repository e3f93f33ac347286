# SPDX-License-Identifier: BSD-3-Clause
"""Films as thin as the roughness: the page docs/evidence/thin_film agrees with its tables."""

from pathlib import Path

import numpy as np
import pytest

from pyehl.prediction.response import film_left


@pytest.fixture(scope="module")
def evidence(script):
    return script("docs/evidence/thin_film/make.py")


@pytest.fixture(scope="module")
def page(root: Path):
    return (root / "docs/evidence/thin_film/README.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def known(evidence):
    """Predictions by surface, speed and flow."""
    return {
        (row["seed"], float(row["speed"]), row["flow"]): row
        for row in evidence.read("predicted.csv")
    }


def test_film_after_a_loss(evidence, page):
    """`film_left` against the means of the simulated film."""
    rows = evidence.read("film.csv")
    assert {row["place"] for row in rows} == set(evidence.RINGS)
    near, beyond = [], []
    for row in rows:
        law = float(film_left(np.array(evidence.number(row, "loss"))))
        off = law - evidence.number(row, "film")
        inside = -0.4 <= evidence.number(row, "from") and evidence.number(row, "to") <= 1.0
        if inside:
            near.append(abs(off))
        elif evidence.number(row, "to") <= -0.4:
            beyond.append(off)
    assert len(near) == 14
    assert max(near) <= 0.07
    assert 0.0 < min(beyond)
    assert max(beyond) <= 0.45
    assert "agrees with the mean film within 0.07 for losses from −0.4 to 1" in page
    (last,) = (row for row in rows if evidence.number(row, "from") == 1.0)
    assert f"Between 1 and 1.2 there are only {last['points']} points." in page


@pytest.mark.long
def test_the_predictions_are_those_of_this_build(evidence, known):
    row = known["1", 6.0, "consistent"]
    result = evidence.predicted(1, 6.0, "consistent")
    assert result["status"] == row["status"]
    for name in ("mu_ratio", "h_min_rough_m", "loss"):
        assert result[name] == pytest.approx(evidence.number(row, name), rel=1e-3)
