# SPDX-License-Identifier: BSD-3-Clause
"""docs/validation.md against its stored tables, and some of their rows against this build."""

import csv
import re
import runpy
from pathlib import Path
from typing import Any

import pytest

# Worst deviation from the other program, in per cent, that the page may show
LIMITS = {"circle": 0.45, "ellipse": 0.3, "thinning": 0.9, "waviness": 0.1}


@pytest.fixture(scope="module")
def made(root: Path) -> dict[str, Any]:
    """Names of make.py."""
    return runpy.run_path(str(root / "docs" / "evidence" / "validation" / "make.py"))


def rows(root: Path, name: str) -> list[dict[str, str]]:
    with (root / "docs" / "evidence" / "validation" / name).open(encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def test_page_shows_what_is_stored(root: Path):
    """Each stored row has a line with its deviation, and no line is without one."""
    text = (root / "docs" / "validation.md").read_text(encoding="utf-8")
    shown = re.findall(r"\| ([^|]+) \| ([^|]+) \| ([+−]?[\d.]+) % \|", text)
    stored = rows(root, "table.csv")
    assert len(shown) == len(stored)
    for row, (theirs, ours, share) in zip(stored, shown, strict=True):
        assert float(theirs) == pytest.approx(float(row["theirs"]), rel=1e-4)
        assert float(ours) == pytest.approx(float(row["ours"]), rel=1e-4)
        deviation = 100.0 * (float(row["ours"]) / float(row["theirs"]) - 1.0)
        assert float(share.replace("−", "-")) == pytest.approx(deviation, abs=0.006)
        assert abs(deviation) <= LIMITS[row["group"]]


def test_spans_of_the_formulas(root: Path):
    text = (root / "docs" / "validation.md").read_text(encoding="utf-8")
    lines = re.findall(r"\| ([\w .-]+) \| (\w+) \| (\d+) to (\d+) \| ([\d.]+) \| ([\d.]+) \|", text)
    assert len(lines) == 10
    stored = rows(root, "formulas.csv")
    for name, quantity, low, high, least, largest in lines:
        found = [
            float(row["ratio"])
            for row in stored
            if (row["formula"], row["quantity"]) == (name, quantity)
            and float(low) <= float(row["moes_m"]) <= float(high)
        ]
        assert (f"{min(found):.3f}", f"{max(found):.3f}") == (least, largest)


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
