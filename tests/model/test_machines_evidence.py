# SPDX-License-Identifier: BSD-3-Clause
"""What documents say of contacts of machines is in docs/evidence/machines."""

import re
from pathlib import Path

from machines import KINDS, draw


def text_of(root: Path, name: str) -> str:
    return (root / "docs" / name).read_text(encoding="utf-8")


def test_pages_have_the_constants_of_the_sources(root: Path):
    def constant(file: str, name: str) -> float:
        source = (root / "fortran" / file).read_text(encoding="utf-8")
        found = re.search(rf"\b{name} = ([\d.]+)", source)
        assert found, name
        return float(found[1])

    grids = text_of(root, "theory/coarse-grids.md")
    for axis in "xy":
        long = constant("multigrid/hierarchy.f90", f"long_{axis}")
        assert f"more than {long:g} times as long along {axis.upper()}" in grids
    assert f"more than {constant('multigrid/hierarchy.f90', 'max_unknowns'):g} unknowns" in grids
    assert f"until {constant('case/case_grid.f90', 'few_rows'):g} intervals or fewer" in grids
    largest = constant("case/case_grid.f90", "largest_ratio")
    assert f"from 1/4 to {largest:g}:" in text_of(root, "theory/discretisation.md")
    sweeps = text_of(root, "theory/relaxation.md")
    assert f"up to {largest:g} times as long" in sweeps
    smooth = constant("case/case_grid.f90", "largest_smooth")
    assert f"sharp pressure spike up to {smooth:g} times" in sweeps
    assert f"beyond 1 : {constant('multigrid/workspace.f90', 'long'):g}" in sweeps
    assert "blunt_spike = merge(19.0_dp, 21.0_dp, moes_l > 10.0_dp)" in (
        root / "fortran" / "case" / "case_grid.f90"
    ).read_text(encoding="utf-8")
    assert "p_h$ of 21, of 19 with L > 10, and" in sweeps
    cycles = text_of(root, "theory/coarse-grids.md")
    steady = "solve/cycle_guard.f90"
    assert f"more than {constant(steady, 'stalled'):g} of the residual" in cycles
    max_residual = constant("solve/smooth_contact.f90", "max_residual")
    assert f"the first residual of a grid is above {max_residual:g}" in cycles
    assert f"more than {constant(steady, 'max_growth'):g} times the one before" in cycles
    words = {3.0: "three", 4.0: "four", 5.0: "fifth", 8.0: "eight"}
    for file, name, stated in (
        (steady, "undamped_after", "After {} good cycles the degree falls"),
        (steady, "patience", "the residual has not halved in {} cycles"),
        (steady, "stalls_after", "From the {} cycle of a grid on"),
        ("multigrid/anderson.f90", "depth", "over {} differences at the most"),
    ):
        assert stated.format(words[constant(file, name)]) in cycles, name


def test_damping_is_that_of_the_sources(root: Path):
    source = (root / "fortran/multigrid/cycle.f90").read_text(encoding="utf-8")
    page = text_of(root, "theory/coarse-grids.md")
    columns = []
    for name in ("log_change", "sweep", "correction"):
        stated = rf"damped_{name}\(max_damping\) = (?:usual_log_change/)?\[([^]]*)\]"
        found = re.search(stated, source)
        assert found, name
        columns.append([float(word.removesuffix("_dp")) for word in found[1].split(", ")])
    for degree, (limit, sweep, correction) in enumerate(zip(*columns, strict=True), 1):
        change = "1" if limit == 1.0 else f"1/{limit:g}"
        assert f"| {degree} | {change} | {sweep:g} | {correction:g} |" in page


def test_kinds_come_in_turn():
    assert [contact.kind for contact in draw(8, 4)] == list(KINDS) * 2
