# SPDX-License-Identifier: BSD-3-Clause
"""The stored record of `examples/zhang2019`, and the how-to page that shows its numbers."""

import re
import runpy
from pathlib import Path
from typing import Any

import pytest
from document_text import plain
from driver import reproduce
from piece import QUICK


@pytest.fixture(scope="module")
def made(root: Path) -> dict[str, Any]:
    """Definitions of make.py."""
    return runpy.run_path(str(root / "docs" / "evidence" / "paper" / "make.py"))


@pytest.fixture(scope="module")
def rows(made: dict[str, Any]) -> list[dict[str, str]]:
    return made["read"]("table.csv")


def test_numbers_of_the_howto_are_of_the_record(
    root: Path, made: dict[str, Any], rows: list[dict[str, str]]
):
    text = plain(root / "docs" / "howto" / "reproduce.md")
    (item,) = re.findall(r"^- \*\*Eq\. 16.*$", text, re.M)
    for power in ("2", "4"):
        name = f"coefficient of theta_2^-{power}, theta_2 > 1, scheme 'paper'"
        (row,) = (row for row in rows if row["quantity"] == name)
        low, high = re.findall(r"\d\.\d+", row["reason"].split("fit")[1])
        assert f"{float(row['pyehl']):.3f} (" in item
        assert f"{low} to {high}) compared with {row['paper']}" in item
    (result,) = (f["text"] for f in made["read"]("findings.csv") if f["title"].startswith("Below"))
    above, below = re.findall(r"scatter by ([\d.]+) %", result)
    assert f"scatter of {above} %" in item
    assert f"scatter by {below} %" in item


@pytest.mark.long
def test_this_build_makes_the_record(tmp_path: Path, made: dict[str, Any], rows: Any):
    """The parts that need no simulation."""
    results = [
        dict(zip(made["COLUMNS"], row, strict=True))
        for result in reproduce(["table 1", "figure 1", "figure 5"], QUICK, tmp_path)
        for row in made["rows_of"](QUICK, result)
    ]
    names = ("piece", "quantity", "paper", "pyehl", "tolerance", "verdict", "reason")
    stored = [row for row in rows if row["piece"] in ("table 1", "figure 1", "figure 5")]
    assert [[row[n] for n in names] for row in results] == [
        [row[n] for n in names] for row in stored
    ]
