# SPDX-License-Identifier: BSD-3-Clause
"""What docs/robustness.md says of random cases with a shear law is in docs/evidence/stress."""

import csv
from collections import Counter
from pathlib import Path

import pytest
from document_text import plain

NAMES = {"eyring": "Eyring", "carreau": "Carreau", "newtonian": "Newtonian"}
GOOD = ("converged", "ended at its number of steps")
FAILED = ("negative film", "diverged", "cycle limit")


@pytest.fixture
def campaigns(root: Path) -> dict[str, list[dict[str, str]]]:
    """Rows by law."""
    with (root / "docs" / "evidence" / "stress" / "laws.csv").open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    found = {law: [row for row in rows if row["law"] == law] for law in NAMES}
    assert sum(map(len, found.values())) == len(rows)
    # the same scenes, with a law in SI units
    scenes = [
        [
            (row["family"], row["moes_m"], max(1.0, float(row["moes_l"])), row["points"])
            for row in each
        ]
        for each in found.values()
    ]
    assert scenes[0] == scenes[1] == scenes[2]
    assert sum(float(row["moes_l"]) < 1.0 for row in found["newtonian"]) == 2
    return found


def test_ends(root: Path, campaigns: dict[str, list[dict[str, str]]]):
    text = plain(root / "docs" / "robustness.md")
    for law, rows in campaigns.items():
        counts = Counter(row["outcome"] for row in rows)
        numbers = [len(rows), *(counts[name] for name in (*GOOD, *FAILED))]
        assert sum(numbers[1:]) == len(rows)
        numbers.append(sum(row["difference"] != "" for row in rows))
        numbers.append(sum(row["wrong"] == "True" for row in rows))
        assert f"| {NAMES[law]} | {' | '.join(map(str, numbers))} |" in text
    worst = max(
        float(row["difference"]) / float(row["allowed"])
        for rows in campaigns.values()
        for row in rows
        if row["difference"]
    )
    assert f"The largest difference is {worst:.2f} of what is allowed" in text


def test_failures_of_a_newtonian_oil_are_failures_of_all(
    root: Path, campaigns: dict[str, list[dict[str, str]]]
):
    failed = {
        law: {k for k, row in enumerate(rows) if row["outcome"] in FAILED}
        for law, rows in campaigns.items()
    }
    newtonian = failed.pop("newtonian")
    text = plain(root / "docs" / "robustness.md")
    assert f"The {len(newtonian)} scenes that fail with a Newtonian oil" in text
    page = plain(root / "docs" / "evidence" / "stress" / "README.md")
    assert f"; {len(newtonian)} of these scenes fail with the Newtonian oil" in page
    for law, those in failed.items():
        assert newtonian < those
        more = Counter(campaigns[law][k]["outcome"] for k in those - newtonian)
        words = f"fails in {more.total()} more, {more['diverged']} of them diverged"
        assert f"Either law {words}" in text


def test_contacts(root: Path):
    """What the page says of boundary films is in contacts.csv, and `wrong` follows from it."""
    with (root / "docs/evidence/stress/contacts.csv").open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    counts = Counter(row["outcome"] for row in rows)
    fields = [row for row in rows if row["broken"]]
    shares = {
        name: [row for row in rows if row["contact_load_share"] and row[name]]
        for name in ("share_strict", "share_finer")
    }
    wrong = {name: [row for row in found if off(row, name)] for name, found in shares.items()}
    numbers = [len(rows), *(counts[name] for name in (*GOOD, "diverged", "cycle limit"))]
    assert sum(numbers[1:]) == len(rows)
    numbers += [len(fields), sum(row["broken"] != "none" for row in fields)]
    for name, found in shares.items():
        numbers += [len(found), len(wrong[name])]
    text = plain(root / "docs" / "robustness.md")
    assert f"| {' | '.join(map(str, numbers))} |" in text
    assert not any(row["wrong"] == "True" for row in rows)


def off(row: dict[str, str], name: str) -> bool:
    """Whether a load share differs from that of another run by more than is allowed."""
    stated = row["contact_load_share_error"]
    allowed = max(float(stated), 1e-3) if stated else 0.03
    return abs(float(row["contact_load_share"]) - float(row[name])) > allowed
