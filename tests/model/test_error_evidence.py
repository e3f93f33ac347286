# SPDX-License-Identifier: BSD-3-Clause
"""Pages on stated errors, time steps and fields say what their tables hold."""

import csv
import re
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from document_text import plain

Row = dict[str, Any]


@pytest.fixture
def beside(root: Path, script, monkeypatch) -> Iterator[Callable[[str, str], ModuleType]]:
    """Import a script of an evidence folder that imports others of the folder, by their names."""
    before = set(sys.modules)

    def load(folder: str, name: str) -> ModuleType:
        monkeypatch.syspath_prepend(str(root / "docs" / "evidence" / folder))
        return script(f"docs/evidence/{folder}/{name}.py")

    for name in ("fit", "make", "ridges"):
        monkeypatch.delitem(sys.modules, name, raising=False)
    yield load
    for name in {"fit", "make", "ridges", "tables"} - before:
        sys.modules.pop(name, None)


def page(root: Path, name: str) -> str:
    """Text of an evidence page on one line a paragraph."""
    return plain(root / "docs" / "evidence" / name / "README.md")


def rows_of(root: Path, name: str) -> list[dict[str, str]]:
    """Rows of a table of the evidence, as texts."""
    with (root / "docs" / "evidence" / name).open(newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def test_algebraic_errors_of_steps(root: Path):
    """Every row of the table, and which of them are above a tenth."""
    text, rows = page(root, "steps"), rows_of(root, "steps/table.csv")
    for row in rows:
        cells = [row["case"], row["points"], f"{float(row['cycles_per_step']):.2f}"]
        cells += [f"{float(row['mu_ratio']):.5f}"]
        cells += [row[name] for name in ("algebraic_error", "grid_error", "share")]
        assert f"| {' | '.join(cells)} |" in text
    assert len(re.findall(r"^\| .*\d \|$", text, re.MULTILINE)) == len(rows)
    (beyond,) = (row for row in rows if float(row["share"]) >= 0.1)
    assert "waves below a/8 cut" in beyond["case"]
    assert float(beyond["grid_error"]) == pytest.approx(7e-5, abs=0.5e-5)
    assert float(beyond["algebraic_error"]) == 1.6e-5
    laws = [float(row["share"]) for row in rows if "Eyring" in row["case"] or "Carr" in row["case"]]
    assert len(laws) == 4
    assert "In the four rows with a law" in text
    assert f"up to {max(laws):.3f}." in text


def test_stated_errors_of_smooth_contacts(root: Path, script):
    """What the doubled domain changes, and how many true errors are as stated."""
    make, text = script("docs/evidence/errors/make.py"), page(root, "errors")
    rows = make.numbers("smooth")
    changed = [row for row in rows if row["H_c_doubled"] and row["H_c"]]
    assert f"All {len(rows)} runs converge; for {len(changed)} of them" in text
    assert {row["status"] for row in rows} == {"converged"}
    bounds = {"0.1 to 1": (0, 1), "1 to 5": (1, 5), "5 to 10": (5, 10), "10 to 500": (10, 500)}
    bounds["from 500 on, P = 0 at the border"] = (500, 1e9)
    for name, (low, high) in bounds.items():
        part = [row for row in changed if low <= row["moes_m"] < high]
        points = {(row["moes_m"], row["moes_l"]) for row in part}
        change = [100.0 * abs(1.0 - row["H_c"] / row["H_c_doubled"]) for row in part]
        said = [100.0 * row["H_c_error_domain"] / row["H_c"] for row in part]
        values = max(change), np.median(change), np.median(said)
        cells = " | ".join(f"{value:.2f} %" for value in values)
        assert f"| {name} | {len(points)} | {cells} |" in text
    found = {}
    for name in ("H_c", "H_min"):
        for stated in (f"{name}_error_domain", f"{name}_error"):
            found[stated] = make.shares(rows, name, f"{name}_doubled", stated, 1.0)
    counts = [good for good, _ in found.values()]
    assert {known for _, known in found.values()} == {len(changed)}
    assert counts == [len(changed), len(changed), 232, len(changed)]
    assert "covers the change in all of them, `H_min_error_domain` in 232, `H_c_error`" in text
    twice = [
        "{} {} of {}".format(name, *make.shares(rows, name, f"{name}_limit", f"{name}_error", 2.0))
        for name in ("H_c", "H_min", "P_max", "F")
    ]
    assert f"True errors of at most twice the stated one: {', '.join(twice)};" in text


def test_stated_errors_of_rough_contacts(root: Path, script):
    """How many ratios are as stated, by grid, and how far the worst is off."""
    make, text = script("docs/evidence/errors/make.py"), page(root, "errors")
    every = make.numbers("rough")
    rows = [row for row in every if row["mu_ratio_error"] is not None]

    def told(part: list[Row]) -> str:
        good, known = make.shares(part, "mu_ratio", "mu_ratio_limit", "mu_ratio_error", 2.0)
        return f"{good} of {known}"

    cases = {tuple(row[key] for key in make.ROUGH_NAMES) for row in rows if row["mu_ratio_limit"]}
    grids = [told([row for row in rows if row["points"] == n]) for n in (129, 193, 257)]
    assert f"{told(rows)}, in {len(cases)} cases" in text
    assert f"{grids[0]} on 129² nodes, {grids[1]} on 193², {grids[2]} on 257²" in text
    whole = {tuple(row[key] for key in make.ROUGH_NAMES) for row in every}
    without = whole - {tuple(row[key] for key in make.ROUGH_NAMES) for row in rows}
    assert f"The other {len(whole) - len(cases)} cases" in text
    assert all(case[0] < 50.0 or case[1] > 16.0 for case in without)


def test_estimate_of_the_domain(root: Path, beside):
    """What `fit.py` says of the contacts that the estimate was fitted to."""
    fit, text = beside("errors", "fit"), page(root, "errors")
    flooded, zero = (fit.shares_covered(border, "H_c") for border in ("flooded", "zero"))
    assert (
        f"covers {100.0 * np.mean(flooded <= 1.0):.1f} % of {flooded.size} changes of H_c" in text
    )
    assert f"the worst, {flooded.max():.1f} times the estimate" in text
    assert f"With P = 0 it covers {100.0 * np.mean(zero <= 1.0):.1f} % of {zero.size}," in text
    # twice what they are, and half again as large
    assert np.median(flooded) == pytest.approx(0.5, abs=0.08)
    assert np.median(zero) == pytest.approx(1 / 1.5, abs=0.08)


def test_stated_errors_of_ellipses(root: Path, script):
    """How many hold, with and without a flooded border, and what narrow contacts miss."""
    show, text = script("docs/evidence/errors_ellipses/show.py"), page(root, "errors_ellipses")
    rows = show.numbers_of(show.HERE / "errors.csv")
    assert f"All {len(rows)} runs converge." in text
    assert {row["status"] for row in rows} == {"converged"}
    points = {(row["kappa"], row["moes_m"]) for row in rows}
    assert f"(`errors.csv`): {len(points)} contacts drawn at random" in text

    def line(head: str, part: list[Row], limit: str, stated: str, factor: float) -> str:
        cells = [
            "{} of {}".format(*show.shares(part, n, f"{n}_{limit}", f"{n}_{stated}", factor))
            for n in ("H_c", "H_min")
        ]
        return f"| {head} | {' | '.join(cells)} |"

    assert line("true error at most the stated one", rows, "limit", "error", 1.0) in text
    assert line("true error at most twice the stated one", rows, "limit", "error", 2.0) in text
    for border, head in (
        ("flooded", "changed by the doubled domain as stated at most, flooded border"),
        ("zero", "the same with P = 0"),
    ):
        here = [row for row in rows if row["border"] == border]
        assert line(head, here, "doubled", "error_domain", 1.0) in text
    rows = show.numbers_of(show.HERE / "cells.csv")
    quarter, half = (show.over_estimate(rows, ratio) for ratio in (0.25, 0.5))
    span = "{:.2f} to {:.2f} times the error of H_c"
    assert span.format(min(quarter[0]), max(quarter[0])) in text
    spans = [f"{min(found):.1f} to {max(found):.1f}" for found in half]
    assert f"have {spans[0]} times that of H_c and {spans[1]} times that of H_min" in text


def test_cells_of_ellipses(root: Path, script):
    """Errors of H_c on 129 nodes by the shape of the cells."""
    show, text = script("docs/evidence/errors_ellipses/show.py"), page(root, "errors_ellipses")
    rows = show.numbers_of(show.HERE / "cells.csv")
    part = text.split("| κ, M | cells 1 : 0.25 |")[1].split("\n\n")[0]
    lines = re.findall(r"^\| ([\d.]+), (\d+) \| (.*) \|$", part, re.MULTILINE)
    assert len(lines) == 7
    for kappa, moes_m, cells in lines:
        found = show.cells(rows, (float(kappa), float(moes_m)))
        told = [cell.strip() for cell in cells.split("|")]
        for ratio, cell in zip((0.25, 0.5, 1.0), told, strict=False):
            near = [error for shape, (_, error) in found.items() if abs(shape - ratio) < 0.02]
            assert cell == (f"{100.0 * near[0]:.2f} %" if near else "")
        if told[3]:
            ratio = float(re.findall(r"1 : ([\d.]+)", told[3])[0])
            (near,) = (error for shape, (_, error) in found.items() if abs(shape - ratio) < 0.04)
            assert told[3].startswith(f"{100.0 * near:.2f} %")


def test_fields_on_the_page(root: Path):
    """Correlations and slopes of c8s12c, and the part of second order in film and pressure."""
    text, rows = page(root, "fields"), rows_of(root, "fields/table.csv")
    best = [r for r in rows if r["name"] == "c8s12c" and r["place"][0] != "X"]
    slopes = [[float(r[n]) for r in best] for n in ("p_slope", "film_slope")]
    pressure, film = (
        ", ".join(f"{v:.3f}" for v in part[:2]) + f" and {part[2]:.3f}" for part in slopes
    )
    assert f"Today's slopes are {pressure} in pressure and {film} in film." in text
    for name, digits in (("p_correlation", 4), ("film_correlation", 3)):
        cells = " | ".join(f"{float(r[name]):.{digits}f}" for r in best)
        assert f"| {'pressure' if name[0] == 'p' else 'film'} | {cells} |" in text
    inner = [
        float(r["film_square"]) for r in rows if r["points"] == "513" and r["place"] == "r < 0.4"
    ]
    assert f"−{-np.mean(inner):.2f} t₁²/H on 513 × 513 nodes" in text
    assert f"(−{-max(inner):.2f} to −{-min(inner):.2f} at r < 0.4 a for six surfaces" in text


def test_residuals_of_the_response_on_the_page(root: Path):
    """Largest residuals of T, of waves that are fitted and of those that are not."""
    text, rows = page(root, "response"), rows_of(root, "response/residuals.csv")
    moving = [row for row in rows if row["moes_m"]]
    centre, every = (max(float(r[n]) for r in moving) for n in ("largest_at_centre", "largest"))
    assert f"- **{centre:.4f}** at most at X = 0" in text
    assert f"- **{every:.4f}** at most over the three X. The largest ones are at (100, 3)" in text
    waves = rows_of(root, "response/waves.csv")
    points = {(r["moes_m"], r["moes_l"]) for r in waves}
    with_ratios = {(r["moes_m"], r["moes_l"], r["velocity_ratio"]) for r in waves}
    assert f"{len(waves) // 3} measured waves at" in text
    assert f"{len(points)} operating points, {len(with_ratios)} with the velocity ratios" in text


def test_waves_beside_the_centre_line_on_the_page(root: Path, beside):
    """T at Y = 0.5 and 0.625 beside what is measured there."""
    folder = root / "docs" / "evidence" / "response"
    off = beside("response", "off_centre")
    table = np.loadtxt(folder / "off_centre.csv", delimiter=",", skiprows=1)
    left = off.left(table)
    (half, more) = (
        [
            f"{np.sqrt(np.mean(left[(table[:, 0] == m) & (table[:, 3] == y)] ** 2)):.3f}"
            for m in (1000.0, 500.0, 200.0)
        ]
        for y in (0.5, 0.625)
    )
    said = f"{half[0]} at (1000, 10), {half[1]} at (500, 5) and {half[2]} at (200, 10) (rms)"
    text = page(root, "response")
    assert said in text
    assert f"at Y = 0.625 to {more[0]}, {more[1]} and {more[2]}." in text


def test_waves_that_are_not_fitted_on_the_page(root: Path, script, capsys):
    """How well the last six runs are met, with slip and without."""
    script("docs/evidence/response/unfitted.py").main()
    lines = [line.split() for line in capsys.readouterr().out.splitlines()[1:]]
    text = page(root, "response")
    worst = max(float(line[-1]) for line in lines)
    slow = max(float(line[-1]) for line in lines if abs(float(line[2]) - 1.0) < 0.02)
    assert f"They are met within {worst:.2g}, at U = 1 and 1.01 within {slow:.3f}." in text


def test_this_build_makes_a_narrow_contact(root: Path, script):
    """A row of ends.csv."""
    made = script("docs/evidence/errors_ellipses/make.py").ends((0.1, 200.0, 10.0, 257))
    (row,) = ({name: str(value) for name, value in one.items()} for one in made)
    with (root / "docs/evidence/errors_ellipses/ends.csv").open(encoding="utf-8") as stream:
        assert row == next(csv.DictReader(stream))


@pytest.mark.long
def test_this_build_makes_a_point_left_out(root: Path, evidence):
    leave_out = evidence("response", "leave_out")
    everything = leave_out.read()
    data = everything.chosen(leave_out.select(everything))
    found = leave_out.left_out(data, leave_out.fit(data), 500.0, 5.0)
    text = (root / "docs/evidence/response/leave_out.csv").read_text(encoding="utf-8")
    assert f"500,5,{','.join(found)}\n" in text
