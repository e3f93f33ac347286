# SPDX-License-Identifier: BSD-3-Clause
"""Load shares of a boundary film: the page docs/evidence/contact agrees with its table."""

from pathlib import Path

import pytest
from document_text import plain

from pyehl.studies.plan import formula_film

LONG = ("ridges along the motion", "ridges across the motion", "tile 1", "tile 8")


@pytest.fixture(scope="module")
def evidence(script):
    return script("docs/evidence/contact/make.py")


@pytest.fixture(scope="module")
def text(root: Path) -> str:
    return plain(root / "docs/evidence/contact/README.md")


def test_this_build_makes_the_stored_shares(evidence):
    """On the coarsest grid, which does not resolve the inlet, so that all nodes touch."""
    row = evidence.read()[0]
    run = {"contact": row["contact"], "boundary_film": float(row["boundary_film"]), "points": 65}
    result = evidence.simulated(run)
    for name in ("contact_load_share", "contact_area_share", "mass_defect"):
        assert result[name] == pytest.approx(float(row[name]), rel=1e-6), name
    # friction relative to a smooth contact that touches because of the grid
    assert result["mu"] is None


@pytest.fixture(scope="module")
def dry(script):
    return script("docs/evidence/contact/dry.py")


@pytest.mark.parametrize(
    "surface",
    ["tile 6", *(pytest.param(name, marks=pytest.mark.long) for name in LONG)],
)
def test_rough_balls_at_vanishing_speed(dry, surface):
    """Area and pressure of the dry solver within 3 %; only the pressure of tile 8, with streaks."""
    result = dry.simulated(surface, 129)
    assert abs(dry.area_off(result)) < 0.03 or surface == "tile 8"
    assert result["rms"] < 0.03
    assert abs(result["P_max_off"]) < 0.03
    (row,) = (r for r in dry.read() if (r["surface"], r["points"]) == (surface, 129))
    for name in dry.NAMES[1:]:
        assert result[name] == pytest.approx(row[name], rel=1e-3), name


def test_the_boundary_film_is_thicker_than_the_film_of_the_inlet(text: str, dry):
    _, film = formula_film(dry.pyehl.Case.from_text(dry.CASE).resolve())
    assert 2e-8 > 5.0 * film
    assert "five times the film from the formula" in text
