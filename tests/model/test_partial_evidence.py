# SPDX-License-Identifier: BSD-3-Clause
"""Predicted and simulated contact at a boundary film: docs/evidence/partial says what it says."""

import csv
from pathlib import Path

import numpy as np
import pytest
from document_text import plain


@pytest.fixture(scope="module")
def place(root: Path) -> Path:
    return root / "docs" / "evidence" / "partial"


def read(file: Path) -> dict[str, dict[str, str]]:
    with file.open(encoding="utf-8") as stream:
        return {row["name"]: row for row in csv.DictReader(stream)}


def columns(rows: list[dict[str, str]], *names: str) -> list[np.ndarray]:
    return [np.array([float(row[name]) for row in rows]) for name in names]


def test_predictions_of_before_stay(place: Path):
    before, table = read(place / "predicted.csv"), read(place / "table.csv")
    for name, row in table.items():
        was = float(before[name]["contact_load_share"])
        assert abs(float(row["contact_load_share_predicted"]) - was) <= 5e-5


def test_blind_contacts(place: Path):
    """Those that were predicted by the present version before they were simulated."""
    text = plain(place / "README.md")
    rows = [row for name, row in read(place / "table.csv").items() if name.startswith("d")]
    share, found, stated, area, area_found = columns(
        rows,
        *("contact_load_share_predicted", "contact_load_share", "stated_error"),
        *("contact_area_share_predicted", "contact_area_share"),
    )
    off = np.abs(share - found)
    assert len(rows) == 9
    assert f"{off.max():.3f}" == "0.023"
    assert "right to 0.023 of the load and the area to 0.03" in text
    assert np.abs(area - area_found).max() <= 0.0305
    assert np.all(off <= stated)
    assert found.max() > 0.4
    of_oils = [row for row in rows if 0.05 < float(row["contact_load_share"]) < 0.3]
    of_oils = [row for row in of_oils if row["name"] != "d5"]
    predicted, simulated = columns(of_oils, "mu_predicted", "mu")
    assert round(100.0 * float((predicted / simulated - 1.0).mean())) == 8
    assert "μ is 8 % too high" in text


def test_contacts_in_view(place: Path):
    text = plain(place / "README.md")
    rows = [row for name, row in read(place / "table.csv").items() if name.startswith("c")]
    now, found, stated = columns(
        rows, "contact_load_share_now", "contact_load_share", "stated_error"
    )
    off = np.abs(now - found)
    assert f"The largest deviation is {off.max():.3f} (c11)" in text
    assert f"It covers {np.sum(off <= stated)} of these {len(rows)}" in text
    high = {
        row["name"]: float(ratio)
        for row, ratio in zip(rows, now / np.maximum(found, 1e-9), strict=True)
    }
    assert [f"{high[name]:.1f}" for name in ("c5", "c14", "c11")] == ["1.3", "1.4", "2.0"]
