# SPDX-License-Identifier: BSD-3-Clause
"""Load shares of a boundary film: docs/evidence/contact says what its table has."""

from pathlib import Path

import numpy as np
import pytest
from document_text import plain

from pyehl.studies.plan import formula_film


@pytest.fixture(scope="module")
def evidence(script):
    return script("docs/evidence/contact/make.py")


@pytest.fixture(scope="module")
def text(root: Path) -> str:
    return plain(root / "docs/evidence/contact/README.md")


@pytest.fixture(scope="module")
def shares(evidence) -> dict:
    """Load shares by contact, layer and nodes, where there is one."""
    return {
        evidence.key_of(row): float(row["contact_load_share"])
        for row in evidence.read()
        if row["contact_load_share"]
    }


def test_how_often_stated_errors_cover_the_next_grid(text: str, evidence, shares):
    known = covered = 0
    for row in evidence.read():
        name, layer, points = evidence.key_of(row)
        finer = shares.get((name, layer, 2 * points - 1), 0.0)
        if not row["contact_load_share_error_grid"] or finer == 0.0:
            continue
        known += 1
        change = abs(finer - float(row["contact_load_share"]))
        covered += change <= float(row["contact_load_share_error_grid"])
    assert f"covers the next change in {covered} of {known} rows" in text
    change = shares["fractal", 8e-8, 129] - shares["fractal", 8e-8, 257]
    assert f"80 nm changes by {change:.3f} from 129 to 257 nodes" in text


def test_the_shares_converge_with_order_two(text: str, shares):
    """From 129 to 257 and to 513 nodes changes fall to a fourth or so."""
    told = {
        "light": ("waves, Eyring 5 MPa", (4e-8, 8e-8)),
        "thin": ("waves, Eyring 1 MPa", (4e-8,)),
        "carreau": ("waves, Carreau", (4e-8, 8e-8)),
        "fractal": ("fractal tile", (4e-8, 8e-8)),
    }
    for name, (words, layers) in told.items():
        for layer in layers:
            coarse, middle, fine = (shares[name, layer, points] for points in (129, 257, 513))
            row = (
                f"| {words} | {1e9 * layer:.0f} nm | {(coarse - middle) / (middle - fine):.1f} "
                f"| {100.0 * (middle - fine) / middle:.0f} % |"
            )
            assert row in text, row


def test_the_finest_grids(text: str, evidence, shares):
    friction = {evidence.key_of(row): float(row["mu"]) for row in evidence.read()}
    for name, words in {"light": "waves, Eyring 5 MPa", "fractal": "fractal tile"}.items():
        for layer in (4e-8, 8e-8):
            coarse, middle, fine = (shares[name, layer, points] for points in (257, 513, 1025))
            cells = [f"{middle:.4f}", f"{fine:.4f}", f"{100.0 * (fine / middle - 1.0):.1f} %"]
            cells += [f"{abs((coarse - middle) / (middle - fine)):.1f}"]
            cells += [f"{friction[name, layer, points]:.4f}" for points in (513, 1025)]
            row = f"| {words} | {1e9 * layer:.0f} nm | {' | '.join(cells)} |".replace("| -", "| −")
            assert row in text, row


def test_this_build_makes_the_stored_shares(evidence):
    """On the coarsest grid, where the inlet is not resolved and everything touches."""
    row = evidence.read()[0]
    run = {"contact": row["contact"], "boundary_film": float(row["boundary_film"]), "points": 65}
    found = evidence.simulated(run)
    for name in ("contact_load_share", "contact_area_share", "layer_supply"):
        assert found[name] == pytest.approx(float(row[name]), rel=1e-6), name
    # friction over that of a smooth contact that touches because of the grid
    assert found["mu"] is None


@pytest.fixture(scope="module")
def dry(script):
    return script("docs/evidence/contact/dry.py")


@pytest.mark.parametrize(
    "surface", ["ridges along the motion", "ridges across it", "tile 1", "tile 6", "tile 8"]
)
def test_rough_balls_at_vanishing_speed(dry, surface):
    """Area and pressure of the dry solver within 3 %; of tile 8, with streaks, the pressure."""
    found = dry.simulated(surface, 129)
    assert abs(dry.area_off(found)) < 0.03 or surface == "tile 8"
    assert found["rms"] < 0.03
    assert abs(found["P_max_off"]) < 0.03
    (row,) = (r for r in dry.read() if (r["surface"], r["points"]) == (surface, 129))
    for name in dry.NAMES[1:]:
        assert found[name] == pytest.approx(row[name], rel=1e-3), name


def test_the_page_says_how_rough_balls_compare(root: Path, text: str, dry):
    solved = [row for row in dry.read() if row["status"] == "converged"]
    worst = f"{np.ceil(1e3 * max(row['rms'] for row in solved)) / 10.0:.1f} %"
    peak = np.ceil(1e3 * max(abs(row["P_max_off"]) for row in solved)) / 10.0
    assert f"within {worst} (rms), the greatest one within {peak:.1f} %" in text
    chapter = plain(root / "docs/theory/contact.md")
    assert f"within {worst[:-2]} % of $p_h$ (rms) for every surface tried" in chapter
    # those of the layer and speed of the text
    same = [row for row in solved if row["surface"] not in list(dry.SURFACES)[-3:]]
    count, missing = [], []
    for points in dry.GRIDS:
        off = {row["surface"]: dry.area_off(row) for row in same if row["points"] == points}
        count.append((sum(abs(o) < 0.03 for o in off.values()), len(off)))
        missing.append(-100.0 * min(off.values()))
    (few, all_few), (many, all_many) = count
    words = f"{few} of {all_few} on 129 × 129 and {many} of {all_many} on 257 × 257 nodes"
    assert f"within 3 % in {words}, and too small by up to {max(missing):.0f} %" in text
    tiles = sum(abs(o) < 0.03 for surface, o in off.items() if surface.startswith("tile"))
    assert f"for {tiles} of 12 fractal tiles on 257 × 257 nodes" in chapter
    assert f"up to {max(missing):.0f} % of it is missing" in chapter
    slow = [row["layer_supply"] for row in same if row["points"] == 129]
    assert f"is {min(slow):.1f} to {max(slow):.0f} on 129 × 129 nodes" in text


def test_the_layer_is_thicker_than_the_film_of_the_inlet(text: str, dry):
    _, film = formula_film(dry.pyehl.Case.from_text(dry.CASE).resolve())
    assert 2e-8 > 5.0 * film
    assert "five times the film that the formula" in text
