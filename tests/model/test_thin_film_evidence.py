# SPDX-License-Identifier: BSD-3-Clause
"""Films as thin as the roughness: docs/evidence/thin_film says what its tables say."""

import math
from pathlib import Path

import numpy as np
import pytest

from pyehl.prediction.second_order import FILM_ENDS, film_left


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


@pytest.fixture(scope="module")
def runs(evidence):
    """Simulations by surface, speed, flow and nodes."""
    return {
        (row["seed"], float(row["speed"]), row["flow"], row["points"]): row
        for row in evidence.read("simulated.csv")
    }


def test_the_page_shows_the_tables(evidence, page):
    assert "\n".join(evidence.lines()) in page
    assert "\n".join(evidence.film_lines()) in page


def test_what_the_page_says_of_fast_contacts(evidence, page, known, runs):
    """At 6 m/s both grids have the same friction, and the prediction agrees."""
    ratios, films = [], []
    for seed in ("1", "2"):
        coarse, fine = (runs[seed, 6.0, "consistent", points] for points in ("257", "513"))
        there = [evidence.number(row, "mu_ratio") for row in (coarse, fine)]
        assert there[0] == pytest.approx(there[1], abs=3.5e-4)
        assert 17e-9 < evidence.number(coarse, "h_min_rough_m")
        assert evidence.number(coarse, "h_min_rough_m") < evidence.number(fine, "h_min_rough_m")
        said = known[seed, 6.0, "consistent"]
        ratio, error = (evidence.number(said, k) for k in ("mu_ratio", "mu_ratio_model_error"))
        ratios.append(f"{ratio:.4f} ± {error:.4f} against {there[1]:.4f}")
        assert abs(ratio - there[1]) <= error
        film, error = (
            1e9 * evidence.number(said, k) for k in ("h_min_rough_m", "h_min_rough_error_m")
        )
        simulated = 1e9 * evidence.number(fine, "h_min_rough_m")
        films.append((film, error, simulated))
    assert " and ".join(ratios) in page
    (one, error, there), (two, wide, fine) = films
    assert f"{one:.0f} ± {error:.0f} nm against {there:.0f}, and {two:.0f} ± {wide:.0f}" in page
    assert f"{two:.0f} ± {wide:.0f} against {fine:.0f}: the predicted one is too thick" in page
    # the error of surface 2 covers its film, that of surface 1 does not
    assert 0.0 < two - fine <= wide
    assert one - there > error
    assert f"that of surface 1 deviates by {one - there:.0f} nm" in page


def test_what_the_page_says_of_the_end(evidence, page, known, runs):
    """The film ends between losses with which fine grids have a film and those without."""
    losses = {
        speed: sorted(evidence.number(known[k, speed, "consistent"], "loss") for k in ("1", "2"))
        for speed in (6.0, 3.0)
    }
    for seed in ("1", "2"):
        assert known[seed, 6.0, "consistent"]["status"] == "predicted"
        assert known[seed, 3.0, "consistent"]["status"] == "film breakdown"
        assert runs[seed, 6.0, "consistent", "513"]["status"] == "converged"
        assert runs[seed, 3.0, "consistent", "513"]["status"] == "diverged"
    assert losses[6.0][1] < FILM_ENDS < losses[3.0][0]
    held, lost = (" and ".join(f"{loss:.2f}" for loss in losses[speed]) for speed in (6.0, 3.0))
    assert f"films hold, {held} at 6 m/s" in page
    assert f"fine grids have none, {lost} at 3 m/s" in page
    assert f"x = {FILM_ENDS} (`FILM_ENDS`)" in page


def test_what_the_page_says_of_a_newtonian_flow(evidence, page, known, runs):
    said = known["1", 6.0, "newtonian"]
    assert math.isnan(evidence.number(said, "mu_ratio_model_error"))
    there = evidence.number(runs["1", 6.0, "newtonian", "257"], "mu_ratio")
    text = f"{evidence.number(said, 'mu_ratio'):.3f} against {there:.3f} in the simulation"
    assert text in page


def test_film_that_a_loss_leaves(evidence, page):
    """`film_left` beside the means of the simulated film."""
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
    assert "within 0.07 of the mean film for losses from −0.4 to 1" in page
    (last,) = (row for row in rows if evidence.number(row, "from") == 1.0)
    assert f"Between 1 and 1.2 there are {last['points']} points." in page


def test_the_predictions_are_those_of_this_build(evidence, known):
    row = known["1", 6.0, "consistent"]
    found = evidence.predicted(1, 6.0, "consistent")
    assert found["status"] == row["status"]
    for name in ("mu_ratio", "h_min_rough_m", "loss"):
        assert found[name] == pytest.approx(evidence.number(row, name), rel=1e-3)
