# SPDX-License-Identifier: BSD-3-Clause
"""Measured films of docs/validation.md: pages, tables, profiles and this build agree."""

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
    """Definitions of make.py."""
    return runpy.run_path(str(home / "make.py"))


@pytest.fixture(scope="module")
def rows(home: Path) -> list[list[str]]:
    with (home / "table.csv").open(encoding="utf-8", newline="") as stream:
        return list(csv.reader(stream))[1:]


def test_the_table_is_of_the_stored_profiles(
    home: Path, made: dict[str, Any], rows: list[list[str]]
):
    theirs = made["read_profiles"](home / "mourier.csv")
    ours = made["read_profiles"](home / "profiles.csv")
    assert set(theirs) == set(ours)
    assert len(ours) == 20
    assert [list(row) for row in made["table"](theirs, ours)] == rows


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
