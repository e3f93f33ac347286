# SPDX-License-Identifier: BSD-3-Clause
"""Measured films of docs/validation.md: pages, tables and profiles agree, and this build."""

import csv
import runpy
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pyehl

MEASURED, SIMULATED = "measured", "simulated"


@pytest.fixture(scope="module")
def home(root: Path) -> Path:
    return root / "docs" / "evidence" / "films"


@pytest.fixture(scope="module")
def made(home: Path) -> dict[str, Any]:
    """Names of make.py."""
    return runpy.run_path(str(home / "make.py"))


@pytest.fixture(scope="module")
def rows(home: Path) -> list[list[str]]:
    with (home / "table.csv").open(encoding="utf-8", newline="") as stream:
        return list(csv.reader(stream))[1:]


def changes(rows: list[list[str]], source: str, ssr: str, *names: str) -> dict[str, float]:
    """Ours less theirs [nm] by quantity and instant."""
    return {
        f"{row[4]} {row[2]}": float(row[6]) - float(row[5])
        for row in rows
        if (row[0], row[1]) == (source, ssr) and row[4] in names
    }


def test_the_table_is_of_the_stored_profiles(
    home: Path, made: dict[str, Any], rows: list[list[str]]
):
    theirs = made["read_profiles"](home / "mourier.csv")
    ours = made["read_profiles"](home / "profiles.csv")
    assert set(theirs) == set(ours)
    assert len(ours) == 20
    assert [list(row) for row in made["table"](theirs, ours)] == rows


def test_what_the_page_says_of_them(rows: list[list[str]]):
    smooth = {r[4]: float(r[6]) / float(r[5]) for r in rows if r[:3] == [MEASURED, "0", "1"]}
    assert smooth["plateau"] == pytest.approx(1.0, abs=0.02)
    assert smooth["outlet"] == pytest.approx(1.0, abs=0.05)
    behind = changes(rows, MEASURED, "0", "behind")
    assert len(behind) == 3
    assert max(map(abs, behind.values())) < 0.02 * 212.0
    ahead = changes(rows, MEASURED, "0", "ahead")
    assert sorted(ahead.values()) == [-21.0, -20.0, -19.0]
    least = changes(rows, MEASURED, "0", "least")
    assert sorted(least.values())[:3] == [-34.0, -30.0, -28.0]
    assert max(changes(rows, MEASURED, "-0.5", "ahead").values()) == 57.0
    assert min(changes(rows, MEASURED, "-0.5", "outlet").values()) == -20.0
    for ssr in ("0", "-0.5"):
        outside = changes(rows, SIMULATED, ssr, "least", "outlet", "plateau", "behind", "ahead")
        assert max(map(abs, outside.values())) <= 7.0
    inside = changes(rows, SIMULATED, "0", "dimple").values()
    assert (min(inside), max(inside)) == (23.0, 30.0)
    inlet, *inside = changes(rows, SIMULATED, "-0.5", "dimple").values()
    assert (inlet, min(inside), max(inside)) == (50.0, 3.0, 11.0)


@pytest.mark.parametrize("name", ["fine", "depth"])
def test_changes_of_grid_and_depth(home: Path, rows: list[list[str]], name: str):
    with (home / f"{name}.csv").open(encoding="utf-8", newline="") as stream:
        changed = list(csv.reader(stream))[1:]
    stored = {(*r[1:3], r[4]): r[6] for r in rows if r[0] == MEASURED}
    assert {tuple(r[:3]): r[3] for r in changed} == stored
    if name == "depth":
        _, *least = (float(r[4]) for r in changed if (r[0], r[2]) == ("0", "least"))
        assert (min(least), max(least)) == (169.0, 175.0)
        theirs = {(*r[1:3], r[4]): float(r[5]) for r in rows if r[0] == MEASURED}
        ahead = {
            tuple(r[:3]): float(r[4]) - theirs[r[0], r[1], r[2]] for r in changed if r[2] == "ahead"
        }
        assert max(ahead.values()) == 62.0
        assert sorted(v for key, v in ahead.items() if key[0] == "0") == [-11.0, -11.0, -9.0]
        return
    change = {tuple(r[:3]): float(r[4]) - float(r[3]) for r in changed}
    thick = {key: change.pop(key) for key in list(change) if key[0] != "0" and key[2] == "ahead"}
    assert max(thick.values()) == 8.0
    assert max(map(abs, change.values())) <= 3.0


def test_newtonian_stress_at_this_slip(home: Path, made: dict[str, Any]):
    ds = pyehl.solve(made["CASE"], "contact.slide_to_roll=-1")
    stress = float(ds.shear_stress_max_Pa)
    assert stress == pytest.approx(57e6, rel=0.01)
    assert stress / float(ds.p_max_Pa) == pytest.approx(0.15, abs=0.005)


@pytest.mark.long
def test_this_build_makes_the_stored_profiles(home: Path, made: dict[str, Any]):
    """The shallow dimple with sliding: most of the numbers, in half a minute."""
    ours = made["read_profiles"](home / "profiles.csv")
    theirs = made["read_profiles"](home / "mourier.csv")
    keys = [key for key in theirs if key[:2] == (SIMULATED, "-0.5")]
    places = [made["centre"](key, theirs[key]) for key in keys]
    for key, (x, film) in zip(keys, made["films"](SIMULATED, "-0.5", places), strict=True):
        np.testing.assert_allclose(np.interp(ours[key][0], x, film), ours[key][1], rtol=2e-3)
