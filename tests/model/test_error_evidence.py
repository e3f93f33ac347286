# SPDX-License-Identifier: BSD-3-Clause
"""Pages on stated errors, time steps and fields agree with their tables."""

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
    """Import a script of an evidence folder that imports others of the folder by name."""
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
    """Text of an evidence page, one line per paragraph."""
    return plain(root / "docs" / "evidence" / name / "README.md")


def test_estimate_of_the_domain(root: Path, beside):
    """Statements of `fit.py` about the contacts to which the estimate was fitted."""
    fit, text = beside("errors", "fit"), page(root, "errors")
    flooded, zero = (fit.shares_covered(border, "H_c") for border in ("flooded", "zero"))
    covered = [f"{x.size} | {100.0 * np.mean(x <= 1.0):.1f} %" for x in (flooded, zero)]
    over, beyond = zip(*((1.0 / np.median(x), x.max()) for x in (flooded, zero)), strict=True)
    most = f"{beyond[0]:.1f} (domain of [Zhang et al. 2019](../../bibliography.md))"
    assert f"| flooded | {covered[0]} | {over[0]:.1f} | {most} |" in text
    assert f"| P = 0 | {covered[1]} | {over[1]:.1f} | {beyond[1]:.1f} |" in text


def test_cells_of_ellipses(root: Path, script):
    """Errors of H_c on 129 nodes by the shape of the cells."""
    show, text = script("docs/evidence/errors_ellipses/show.py"), page(root, "errors_ellipses")
    rows = script("docs/evidence/tables.py").numbers_of(show.HERE / "cells.csv")
    part = text.split("| κ, M | cells 1 : 0.25 |")[1].split("\n\n")[0]
    lines = re.findall(r"^\| ([\d.]+), (\d+) \| (.*) \|$", part, re.MULTILINE)
    assert len(lines) == 7
    for kappa, moes_m, cells in lines:
        result = show.cells(rows, (float(kappa), float(moes_m)))
        reported = [cell.strip() for cell in cells.split("|")]
        for ratio, cell in zip((0.25, 0.5, 1.0), reported, strict=False):
            near = [error for shape, (_, error) in result.items() if abs(shape - ratio) < 0.02]
            assert cell == (f"{100.0 * near[0]:.2f} %" if near else "")
        if reported[3]:
            ratio = float(re.findall(r"1 : ([\d.]+)", reported[3])[0])
            (near,) = (error for shape, (_, error) in result.items() if abs(shape - ratio) < 0.04)
            assert reported[3].startswith(f"{100.0 * near:.2f} %")


def test_waves_beside_the_centre_line_on_the_page(root: Path, beside):
    """T at Y = 0.5 and 0.625 against the measured one."""
    folder = root / "docs" / "evidence" / "response"
    off = beside("response", "off_centre")
    table = np.loadtxt(folder / "off_centre.csv", delimiter=",", skiprows=1)
    residuals = off.residuals(table)
    (half, more) = (
        [
            f"{np.sqrt(np.mean(residuals[(table[:, 0] == m) & (table[:, 3] == y)] ** 2)):.3f}"
            for m in (1000.0, 500.0, 200.0)
        ]
        for y in (0.5, 0.625)
    )
    text = page(root, "response")
    for y, values in (("0.5", half), ("0.625", more)):
        assert f"| {y} | {' | '.join(values)} |" in text


@pytest.mark.long
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
    result = leave_out.left_out(data, leave_out.fit(data), 500.0, 5.0)
    text = (root / "docs/evidence/response/leave_out.csv").read_text(encoding="utf-8")
    assert f"500,5,{','.join(result)}\n" in text
