# SPDX-License-Identifier: BSD-3-Clause
"""The example of the how-to page of Stribeck curves: its data are reproduced."""

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
def data(make: ModuleType) -> dict[tuple[str, str, float], list[Row]]:
    """Curves by surface, law and slide-to-roll ratio; ten points each, with increasing speed."""
    result = make.stored()
    curves = {
        (surface, law, slip): list(make.rows(result, surface, law, slip))
        for surface in make.SURFACES
        for law in make.LAWS
        for slip in make.SLIPS
    }
    assert [len(rows) for rows in curves.values()] == [10] * 18
    return curves


@pytest.mark.parametrize(("surface", "law"), [(SMOOTH, "eyring"), (TABLE, "newtonian")])
def test_the_data_are_made_anew(
    make: ModuleType, data: dict, tmp_path: Path, surface: str, law: str
):
    """To the digits in the sentences, with a margin for compilers."""
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
