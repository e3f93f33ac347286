# SPDX-License-Identifier: BSD-3-Clause
"""What documents say of contacts of machines is in docs/evidence/machines."""

import re
from pathlib import Path

import pytest

from pyehl.bench.machines import KINDS, covered, draw, summary


@pytest.fixture(scope="module")
def evidence(script):
    return script("docs/evidence/machines/make.py")


def text_of(root: Path, name: str) -> str:
    return (root / "docs" / name).read_text(encoding="utf-8")


def test_pages_show_the_tables(root: Path, evidence, script):
    assert "\n".join(evidence.robustness()) in text_of(root, "robustness.md")
    assert "\n".join(evidence.speed()) in text_of(root, "speed.md")
    assert "\n".join(evidence.sides()) in text_of(root, "theory/coarse-grids.md")
    assert "\n".join(evidence.by_border()) in text_of(root, "theory/border.md")
    modes = script("docs/evidence/machines/modes.py")
    assert "\n".join(modes.lines()) in text_of(root, "theory/relaxation.md")


def test_the_record_is_of_the_contacts_that_the_command_draws(evidence):
    rows, runs = evidence.read(), evidence.read("runs.csv")
    assert len(rows) == sum(run["count"] for run in runs)
    assert len({run["seed"] for run in runs}) == len(runs) >= 3
    for run in runs:
        mine = [row for row in rows if row["seed"] == run["seed"]]
        drawn = draw(run["count"], run["seed"])
        assert [row["number"] for row in mine] == list(range(run["count"]))
        assert [row["kind"] for row in mine] == [contact.kind for contact in drawn]
        for row, contact in zip(mine, drawn, strict=True):
            assert row["law"] == contact.values["lubricant.shear_law"]
            assert row["ellipticity"] == pytest.approx(contact.ellipticity, rel=1e-5)
            assert row["hertz_pressure_Pa"] == pytest.approx(contact.pressure, rel=1e-5)
            if row["status"] != "converged":
                assert row["message"]
            # only what converged is checked, and all of it
            is_checked = run["fine"] and row["status"] == "converged"
            assert (row["fine_status"] is not None) == is_checked


def test_what_the_pages_say_of_the_campaign(root: Path, evidence):
    rows = evidence.read()
    page = text_of(root, "robustness.md")
    failed = [row for row in rows if row["status"] != "converged"]
    assert f"{len(failed)} of {len(rows)} contacts ends without a result" in page
    (one,) = failed
    assert one["status"] == "cycle limit"
    words = f"a {one['kind']} at {one['hertz_pressure_Pa'] / 1e9:.1f} GPa "
    words += f"(κ = {one['ellipticity']:.1f}, seed {one['seed']}, number {one['number']})"
    assert words in page
    grid = [covered(row, name, "error_grid") for row in rows for name in ("H_c", "H_min")]
    checked = [each for each in grid if each is not None]
    assert f"The part of the grid alone covers {sum(checked)} of {len(checked)}:" in page
    found = {"H_c": "h_c", "H_min": "h_min"}
    known = [
        (row, name) for row in rows for name in found if covered(row, name, "error") is not None
    ]
    missed = [(row, name) for row, name in known if not covered(row, name, "error")]
    assert f"cover {len(known) - len(missed)} of {len(known)} films that were checked" in page
    for row, name in missed:
        wrong = 100.0 * abs(row[f"{name}_fine"] / row[name] - 1.0)
        stated = 100.0 * row[f"{name}_error"] / row[name]
        line = f"| {row['kind']} | {row['moes_m']:.0f}, {row['moes_l']:.1f} | {row['points']} "
        assert f"{line}| {found[name]} | {wrong:.1f} % | {stated:.1f} % |" in page
    (disc,) = (row for row in summary(rows) if row["contacts"] == "ball on disc")
    speed = text_of(root, "speed.md")
    assert f"ball on disc, {disc['median_seconds']:.2g} s" in speed
    slow = [row for row in rows if (row["seconds"] or 0.0) > 10.0]
    none = sum(row["status"] != "converged" for row in slow)
    words = f"{len(slow)} of {len(rows)} contacts take more than 10 s, {none} of them without a"
    assert words in speed


def test_sides_and_cells_cost_what_the_page_says(root: Path, evidence):
    rows = evidence.read("sides.csv")
    for row in rows:
        for end in ("_further", "_square"):
            assert abs(row[f"H_c{end}"] / row["H_c"] - 1.0) < 1e-4 + 1e-9
            assert abs(row[f"H_min{end}"] / row["H_min"] - 1.0) < 1.4e-3
    page = text_of(root, "theory/coarse-grids.md")
    good = known = 0
    limit: dict[str, float] = {}
    for row in evidence.read("border.csv"):
        if row["x_inlet"] != -4.5:
            continue
        if row["border"] == "flooded":
            limit = row
            continue
        for name in ("H_c", "H_min"):
            known += 1
            # algebraic errors
            allowed = row[f"{name}_error_domain"] + 2e-5 * limit[name]
            good += abs(row[name] - limit[name]) <= allowed
    assert f"it covers {good} of {known} differences to the flooded contact" in page


def test_what_the_limits_say_of_wide_contacts(root: Path, evidence):
    page = text_of(root, "limits.md")
    wide = [row for row in evidence.read() if row["ellipticity"] > 4.0]
    ends = [sum(row["status"] == s for row in wide) for s in ("converged", "cycle limit")]
    span = [f(row["ellipticity"] for row in wide) for f in (min, max)]
    words = f"Of {len(wide)} contacts of machines with κ from {span[0]:.0f} to {span[1]:.0f}, "
    words += f"{ends[0]} converge with default settings and {ends[1]} ends with `cycle limit`"
    assert words in page
    assert sum(ends) == len(wide)


def test_what_the_limits_say_of_large_errors(root: Path, evidence):
    """A stated error of h_c above 5 %: seldom, and seldom checked."""
    page = text_of(root, "limits.md")
    good = [row for row in evidence.read() if row["status"] == "converged"]
    large = [row for row in good if row["H_c_error"] > 0.05 * row["H_c"]]
    checked = [row for row in good if covered(row, "H_c", "error") is not None]
    both = [row for row in checked if row in large]
    words = f"Of the {len(good)} contacts of machines that converged {len(large)} have one; "
    words += f"of the {len(checked)} that were solved on twice the nodes {len(both)}, and"
    assert words in page
    assert all(covered(row, "H_c", "error") for row in both)


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
    steady = "solve/cycle_guard.f90"
    assert f"more than {constant(steady, 'stalled'):g} of the residual" in cycles
    max_residual = constant("solve/smooth_contact.f90", "max_residual")
    assert f"the first residual of a grid is above {max_residual:g}" in cycles
    assert f"more than {constant(steady, 'max_growth'):g} times the one before" in cycles
    words = {3.0: "three", 4.0: "four", 5.0: "fifth", 8.0: "eight"}
    for file, name, said in (
        (steady, "undamped_after", "After {} good cycles the degree falls"),
        (steady, "patience", "the residual has not halved in {} cycles"),
        (steady, "stalls_after", "From the {} cycle of a grid on"),
        ("multigrid/anderson.f90", "depth", "over {} differences at the most"),
    ):
        assert said.format(words[constant(file, name)]) in cycles, name


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
