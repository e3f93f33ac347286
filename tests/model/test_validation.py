# SPDX-License-Identifier: BSD-3-Clause
"""docs/validation.md against its stored tables; some of their rows against this build."""

import csv
import runpy
from pathlib import Path
from typing import Any

import pytest
from document_text import plain


@pytest.fixture(scope="module")
def made(root: Path) -> dict[str, Any]:
    """Definitions of make.py."""
    return runpy.run_path(str(root / "docs" / "evidence" / "validation" / "make.py"))


def rows(root: Path, name: str) -> list[dict[str, str]]:
    with (root / "docs" / "evidence" / "validation" / name).open(encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def test_rows_of_the_other_programs(root: Path, made: dict[str, Any]):
    """Deviations between two rows, and reduction of the film by Carreau's law."""
    pages = "validation.md", "evidence/validation/README.md"
    text = "".join(plain(root / "docs" / page) for page in pages)
    with (root / "pyehl/studies/references/smooth.csv").open(encoding="utf-8") as stream:
        known = {
            (r["lubricant.roelands_z"], r["grid.points"]): r
            for r in csv.DictReader(line for line in stream if line[0] != "#")
            if r["contact.moes_m"] == "1000.0"
        }
    change = {
        name: float(known["0.6684", "513"][name]) / float(known["0.68", "513"][name])
        for name in ("H_c", "H_min")
    }
    apart = 100.0 * (change["H_min"] / change["H_c"] - 1.0)
    assert f"except for H_min at M = 1000, where they differ by {apart:.2f} %" in text
    options = made["PLACE"] | made["THINNING"]["Carreau 0.1 MPa, n = 0.8, SRR 0.1"][0]
    films = [
        float(made["solved"](options | more, 65).h_c_m)
        for more in ({}, {"lubricant.flow": "newtonian"})
    ]
    assert films[0] / films[1] == pytest.approx(0.8, abs=0.01)
    assert "film is a fifth thinner than that of the Newtonian oil" in text


def test_this_build_makes_the_stored_numbers(root: Path, made: dict[str, Any]):
    """One contact in the limit of fine grids and one point of the formulas."""
    ds = made["solved"]({"contact.moes_m": 200.0, "contact.moes_l": 10.0}, 257)
    stored = {
        (r["moes_m"], r["moes_l"], r["formula"], r["quantity"]): r
        for r in rows(root, "formulas.csv")
    }
    row = stored["200", "10", "Nijenbanning-Venner-Moes", "H_c"]
    point = made["OperatingPoint"].from_moes(200.0, 10.0)
    formula = made["estimates"](point, made["Lubricant"]())[0].h_c / point.film_scale
    assert formula / float(ds.H_c_extrapolated) == pytest.approx(float(row["ratio"]), rel=1e-3)
    case = "Carreau 0.1 MPa, n = 0.8, SRR 0"
    options = made["PLACE"] | made["THINNING"][case][0]
    films = [float(made["solved"](options, points).h_c_m) for points in (65, 129)]
    (film,) = (
        float(row["ours"])
        for row in rows(root, "table.csv")
        if (row["case"], row["quantity"]) == (case, "h_c_m")
    )
    assert (4.0 * films[1] - films[0]) / 3.0 == pytest.approx(film, rel=2e-3)
