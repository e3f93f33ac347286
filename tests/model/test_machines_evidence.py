# SPDX-License-Identifier: BSD-3-Clause
"""What documents say of contacts of machines is in docs/evidence/machines."""

import re
from pathlib import Path

import pytest

from pyehl.bench.machines import KINDS, draw


@pytest.fixture(scope="module")
def evidence(script):
    return script("docs/evidence/machines/make.py")


def text_of(root: Path, name: str) -> str:
    return (root / "docs" / name).read_text(encoding="utf-8")


def test_pages_show_the_tables(root: Path, evidence, script):
    assert "\n".join(evidence.sides()) in text_of(root, "theory/coarse-grids.md")
    modes = script("docs/evidence/machines/modes.py")
    assert "\n".join(modes.lines()) in text_of(root, "theory/relaxation.md")


def test_sides_and_cells_cost_what_the_page_says(root: Path, evidence):
    rows = evidence.read("sides.csv")
    for row in rows:
        for end in ("_further", "_square"):
            assert abs(row[f"H_c{end}"] / row["H_c"] - 1.0) < 1e-4 + 1e-9
            assert abs(row[f"H_min{end}"] / row["H_min"] - 1.0) < 1.4e-3
    page = text_of(root, "theory/coarse-grids.md")
    (zero,) = (row for row in rows if row["border"] == "zero")
    changed = abs(zero["H_c_further"] / zero["H_c"] - 1.0)
    stated = zero["H_c_error_domain"] / zero["H_c"]
    words = f"it is {100.0 * stated:.1f} % of h_c, while the sides change it by"
    assert f"{words} {100.0 * changed:.3f} %" in page


def test_pages_have_the_constants_of_the_sources(root: Path):
    def constant(file: str, name: str) -> float:
        source = (root / "fortran" / file).read_text(encoding="utf-8")
        found = re.search(rf"\b{name} = ([\d.]+)", source)
        assert found, name
        return float(found[1])

    grids = text_of(root, "theory/coarse-grids.md")
    assert f"more than {constant('multigrid/ladder.f90', 'long'):g} times as long" in grids
    assert f"more than {constant('multigrid/ladder.f90', 'most_unknowns'):g} unknowns" in grids
    assert f"until {constant('case/case_contact.f90', 'few_rows'):g} intervals or fewer" in grids
    largest = constant("case/case_contact.f90", "largest_ratio")
    assert f"from 1/4 to {largest:g}:" in text_of(root, "theory/discretisation.md")
    assert f"up to {largest:g} times as long" in text_of(root, "theory/relaxation.md")
    cycles = text_of(root, "theory/full-multigrid.md")
    steady = "steady/steady.f90"
    assert f"more than {constant(steady, 'stalled'):g} of the residual" in cycles
    assert f"a residual above {constant(steady, 'most_residual'):g} that has doubled" in cycles
    assert constant(steady, "undamped_after") == 3.0
    assert constant(steady, "patience") == 8.0
    assert constant(steady, "stalls_after") == 5.0
    assert constant("multigrid/anderson.f90", "depth") == 4.0


def test_damping_is_that_of_the_sources(root: Path):
    source = (root / "fortran/multigrid/cycle.f90").read_text(encoding="utf-8")
    page = text_of(root, "theory/full-multigrid.md")
    columns = []
    for name in ("trust", "sweep", "correction"):
        found = re.search(rf"damped_{name}\(most_damping\) = (?:full_trust/)?\[([^]]*)\]", source)
        assert found, name
        columns.append([float(word.removesuffix("_dp")) for word in found[1].split(", ")])
    for degree, (trust, sweep, correction) in enumerate(zip(*columns, strict=True), 1):
        change = "1" if trust == 1.0 else f"1/{trust:g}"
        assert f"| {degree} | {change} | {sweep:g} | {correction:g} |" in page


def test_kinds_come_in_turn():
    assert [contact.kind for contact in draw(8, 4)] == list(KINDS) * 2
