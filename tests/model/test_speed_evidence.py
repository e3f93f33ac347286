# SPDX-License-Identifier: BSD-3-Clause
"""Records of docs/evidence/speed."""

from pathlib import Path

import pytest
from document_text import plain


@pytest.fixture(scope="module")
def evidence(script):
    return script("docs/evidence/speed/make.py")


def test_skipped_work_stays_within_its_tolerance(evidence):
    for row in evidence.table("skips"):
        assert float(row["difference"]) <= float(row["allowed"]), row["skipped"]


def test_the_library_page_says_what_the_grid_takes_of_the_film(root: Path, evidence):
    (error,) = (
        float(row["error"])
        for row in evidence.table("smooth")
        if (row["points"], row["engine"], row["threads"]) == ("257", "mlmi", "1")
    )
    text = plain(root / "fortran" / "README.md")
    assert f"H_c is {100.0 * error:.0f} % too small on 257 × 257 nodes" in text
