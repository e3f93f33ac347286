# SPDX-License-Identifier: BSD-3-Clause
"""The stored record of ``pyehl reproduce`` and the pages that show its numbers."""

import re
import runpy
from pathlib import Path
from typing import Any

import pytest
from document_text import plain
from driver import PIECES, reproduce
from piece import QUICK, read_references


@pytest.fixture(scope="module")
def made(root: Path) -> dict[str, Any]:
    """Names of make.py."""
    return runpy.run_path(str(root / "docs" / "evidence" / "paper" / "make.py"))


@pytest.fixture(scope="module")
def rows(made: dict[str, Any]) -> list[dict[str, str]]:
    return made["read"]("table.csv")


def test_pages_show_the_record(root: Path, made: dict[str, Any], rows: list[dict[str, str]]):
    page = plain(root / "docs" / "validation.md")
    shown = [made["line"](row) for row in rows if row["piece"] != "table 1"]
    head = made["HEAD"]
    assert "\n".join([*head, *shown]) in page
    # and nothing else in that table
    assert page.split(head[1])[1].split("\n\n")[0].strip().splitlines() == shown
    readme = plain(root / "docs/evidence/paper/README.md")
    for row in made["read"]("findings.csv"):
        assert made["finding"](row) in readme


def test_verdicts_of_the_record(rows: list[dict[str, str]]):
    """Each follows from its numbers, none is a failure, and no number of the paper is changed."""
    printed = {f"{r.value:.6g}" for r in read_references().values()}
    for row in rows:
        deviation = float(row["pyehl"]) - float(row["paper"])
        assert float(row["deviation"]) == pytest.approx(
            deviation, rel=0.01, abs=1e-5 * abs(float(row["pyehl"]))
        )
        if " p. " in f" {row['source']}" and row["piece"] != "figure 5":
            assert row["paper"] in printed, row
        if not row["tolerance"]:
            assert row["verdict"] == "not judged"
        else:
            assert row["verdict"] in ("pass", "not reproduced")
            within = abs(float(row["deviation"])) <= float(row["tolerance"]) * 1.05 + 1e-15
            assert (row["verdict"] == "pass") is within, row
    assert sum(row["piece"] == "table 1" for row in rows) == 17
    assert {row["piece"] for row in rows} == set(PIECES) - {"figure 3"}


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
        assert f"{low} to {high}) for {row['paper']}" in item
    (found,) = (f["text"] for f in made["read"]("findings.csv") if f["title"].startswith("Below"))
    above, below = re.findall(r"scatter by ([\d.]+) %", found)
    assert f"{above} % of scatter" in item
    assert f"scatter by {below} %" in item


def test_this_build_makes_the_record(tmp_path: Path, made: dict[str, Any], rows: Any):
    """Those pieces that need no simulation."""
    found = [
        dict(zip(made["COLUMNS"], row, strict=True))
        for result in reproduce(["table 1", "figure 1", "figure 5"], QUICK, tmp_path)
        for row in made["rows_of"](QUICK, result)
    ]
    names = ("piece", "quantity", "paper", "pyehl", "tolerance", "verdict", "reason")
    stored = [row for row in rows if row["piece"] in ("table 1", "figure 1", "figure 5")]
    assert [[row[n] for n in names] for row in found] == [[row[n] for n in names] for row in stored]
