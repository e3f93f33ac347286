# SPDX-License-Identifier: BSD-3-Clause
"""The example of the how-to page: each sentence stands in the data, and the data are made anew."""

from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import pytest

pytestmark = pytest.mark.long

SMOOTH, TABLE, SHORT = "smooth", "table 1", "short waves x 10"
FULL, BROKEN = "full film", "film breakdown"
Row = dict[str, str]


@pytest.fixture(scope="module")
def make(script: Callable[[str], ModuleType]) -> ModuleType:
    return script("docs/evidence/stribeck/make.py")


@pytest.fixture(scope="module")
def sentences(root: Path) -> dict[int, str]:
    lines = (root / "docs" / "howto" / "stribeck.md").read_text().splitlines()
    return {int(line[0]): line for line in lines if line[:1].isdigit() and line[1:3] == ". "}


@pytest.fixture(scope="module")
def data(make: ModuleType) -> dict[tuple[str, str, float], list[Row]]:
    """Curves by surface, law and slide-to-roll ratio; ten points of rising speed each."""
    found = make.stored()
    curves = {
        (surface, law, slip): list(make.rows(found, surface, law, slip))
        for surface in make.SURFACES
        for law in make.LAWS
        for slip in make.SLIPS
    }
    assert [len(rows) for rows in curves.values()] == [10] * 18
    return curves


def speed(row: Row) -> float:
    return float(row["contact.mean_velocity"])


def test_there_are_five(sentences: dict[int, str]):
    assert sorted(sentences) == [1, 2, 3, 4, 5]


def test_slip_decides(sentences: dict[int, str], data: dict):
    low, high = (float(data[SMOOTH, "eyring", slip][3]["mu"]) for slip in (0.02, 0.3))
    assert f"from {low:.4f} to {high:.4f}" in sentences[1]
    assert f"at {speed(data[SMOOTH, 'eyring', 0.02][3]):.2f} m/s" in sentences[1]
    rises = [
        float(row["mu_ratio"]) - 1.0
        for (surface, law, _), rows in data.items()
        for row in rows
        if surface != SMOOTH and law == "eyring" and row["status"] == FULL
    ]
    assert len(rises) > 40
    assert 0.0 < max(rises) <= 0.003
    assert "more than 0.3 %" in sentences[1]


def test_heat_bends_the_curve(sentences: dict[int, str], data: dict):
    rows = data[SMOOTH, "eyring", 0.3]
    friction, without = ([float(row[name]) for row in rows] for name in ("mu", "mu_isothermal"))
    assert friction == sorted(friction, reverse=True)
    told = f"from {friction[0]:.4f} at {speed(rows[0]):g} m/s to {friction[-1]:.4f}"
    assert f"{told} at {speed(rows[-1]):g} m/s" in sentences[2]
    assert f"from {without[0]:.4f} to {without[-1]:.4f}" in sentences[2]


def test_short_waves_end_full_film(sentences: dict[int, str], data: dict):
    table, short = data[TABLE, "eyring", 0.02], data[SHORT, "eyring", 0.02]
    ratio = float(table[0]["lambda_ratio"]) / float(short[0]["lambda_ratio"])
    assert f"{ratio:.2f} times" in sentences[3]
    broken = [speed(row) for row in short if row["status"] == BROKEN]
    full = [speed(row) for row in short if row["status"] == FULL]
    assert max(broken) < min(full)
    assert f"between {min(full):.2f} and {max(broken):.2f} m/s" in sentences[3]
    assert {row["status"] for row in table} == {FULL}
    assert f"down to {speed(table[0]):g} m/s" in sentences[3]


def test_lambda_does_not_tell(sentences: dict[int, str], data: dict):
    table, short = data[TABLE, "eyring", 0.02], data[SHORT, "eyring", 0.02]
    assert table[0]["status"] == FULL
    assert f"at Λ = {float(table[0]['lambda_ratio']):.2f}," in sentences[4]
    assert short[4]["status"] == BROKEN
    assert f"none at Λ = {float(short[4]['lambda_ratio']):.2f}" in sentences[4]
    last = next(row for row in short if row["status"] == FULL)
    assert f"has {float(table[0]['lambda_ratio_deformed']):.1f} there" in sentences[4]
    assert f"the other one {float(last['lambda_ratio_deformed']):.1f} at" in sentences[4]


def test_a_ratio_belongs_to_a_slip(sentences: dict[int, str], data: dict):
    found = [float(data[TABLE, "newtonian", slip][3]["mu_ratio"]) for slip in (0.02, 0.1, 0.3)]
    told = "it is {:.2f} at the ratio 0.02, {:.2f} at 0.1 and {:.2f} at 0.3".format(*found)
    assert told in sentences[5]
    ratios = [float(row["mu_ratio"]) for row in data[TABLE, "newtonian", 0.02]]
    assert ratios == sorted(ratios, reverse=True)
    assert f"from {ratios[0]:.2f} at 0.25 m/s to {ratios[-1]:.2f} at 8 m/s" in sentences[5]


@pytest.mark.parametrize(("surface", "law"), [(SMOOTH, "eyring"), (TABLE, "newtonian")])
def test_the_data_are_made_anew(
    make: ModuleType, data: dict, tmp_path: Path, surface: str, law: str
):
    """To the digits that the sentences have, with a margin for compilers."""
    row = data[surface, law, 0.1][3]
    (made,) = make.curve(surface, law, tmp_path, row["contact.mean_velocity"], (0.1,))
    assert made["status"] == row["status"]
    for name in ("h_c_m", "h_min_m", "mu", "mu_ratio"):
        if row[name]:
            assert float(made[name]) == pytest.approx(float(row[name]), rel=1e-3)


def test_short_waves_are_made_anew(make: ModuleType, data: dict, tmp_path: Path):
    rows = data[SHORT, "eyring", 0.02]
    places = ",".join(rows[k]["contact.mean_velocity"] for k in (3, 6))
    made = make.curve(SHORT, "eyring", tmp_path, places, (0.02,))
    assert [row["status"] for row in made] == [BROKEN, FULL]
    assert float(made[1]["mu_ratio"]) == pytest.approx(float(rows[6]["mu_ratio"]), rel=1e-3)
    assert float(made[1]["lambda_ratio"]) == pytest.approx(float(rows[6]["lambda_ratio"]), rel=1e-3)
