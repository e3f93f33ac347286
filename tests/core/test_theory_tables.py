# SPDX-License-Identifier: BSD-3-Clause
"""Theory tables from equation or step to module: each name exists in the file given."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
# Chapters that only refer to others
INDICES = {"numerics", "physics", "predicting"}
CHAPTERS = sorted(set((ROOT / "docs" / "theory").glob("*.md")), key=lambda path: path.stem)
SOURCES = [
    path
    for folder, kind in (("fortran", "*.f90"), ("pyehl", "*.py"))
    for path in (ROOT / folder).rglob(kind)
]


def rows(text: str) -> list[str]:
    """Lines of tables that name code."""
    return [
        line
        for line in text.split("\n")
        if line.startswith("|") and re.search(r"`[\w/]+\.(?:f90|py)`", line)
    ]


@pytest.mark.parametrize("chapter", CHAPTERS, ids=lambda path: path.stem)
def test_chapter_names_the_code(chapter):
    text = chapter.read_text(encoding="utf-8")
    if chapter.stem in INDICES:
        return
    result = rows(text)
    assert result, "no table from equation or step to module"
    for row in result:
        names = re.findall(r"`([^`]+)`", row)
        files = [name for name in names if re.fullmatch(r"[\w/]+\.(?:f90|py)", name)]
        places = {
            name: [path for path in SOURCES if f"/{path.relative_to(ROOT)}".endswith(f"/{name}")]
            for name in files
        }
        assert all(places.values()), (row, places)
        code = " ".join(path.read_text(encoding="utf-8") for at in places.values() for path in at)
        known = [name for name in names if re.fullmatch(r"[A-Za-z_]\w*(?:\.\w+)?", name)]
        for name in set(known) - set(files):
            assert all(part in code for part in name.split(".")), (name, files)
