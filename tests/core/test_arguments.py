# SPDX-License-Identifier: BSD-3-Clause
"""Arguments of the wrong type or value: InputError with the expected ones, never a bare error."""

import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pyehl
from pyehl import cli
from pyehl.case import resolved_case
from pyehl.solver import solver_on_heights

SMALL = "grid.points=65"


class Nothing:
    """Neither a number nor a text."""


@pytest.fixture(scope="module")
def quick(cases: Path) -> str:
    return str(cases / "quick.nml")


# Calls with the path of a case, and the necessary words of their messages
CALLS: dict[str, tuple[Callable[[str], Any], str]] = {
    "text None": (lambda q: pyehl.Case.from_text(None), "expected a text, not NoneType"),
    "text bytes": (lambda q: pyehl.Case.from_text(b"&grid /"), "expected a text, not bytes"),
    "text surrogate": (lambda q: pyehl.Case.from_text("\ud800"), "not a text"),
    "text nonsense": (lambda q: pyehl.Case.from_text("nonsense"), "text outside of a group"),
    "text for a path": (lambda q: pyehl.Case("&grid points = 65 /"), "pyehl.Case.from_text"),
    "case None": (lambda q: pyehl.Case(None), "expected a path, not NoneType"),
    "option of text": (lambda q: pyehl.Case.from_text("", [3]), "expected texts group.key=value"),
    "origin": (lambda q: pyehl.Case.from_text("", origin=3), "expected a path"),
    "read None": (lambda q: pyehl.Case.read(None), "expected a path, not NoneType"),
    "read zero byte": (lambda q: pyehl.Case.read("a\0b"), "zero byte"),
    "read number": (lambda q: pyehl.Case(q, 65), "or by group and key, not int"),
    "read dict": (lambda q: pyehl.Case(q, {"grid.pionts": 65}), "'points'"),
    "read nested": (lambda q: pyehl.Case(q, {"grid": {"pionts": 65}}), "'points'"),
    "read nested key": (lambda q: pyehl.Case(q, {"grid": {3: 65}}), "grid = 3"),
    "read flat": (lambda q: pyehl.Case(q, {"points": 65}), "points = 65: expected values by key"),
    "read fraction": (lambda q: pyehl.Case(q, {"grid.points": 65.5}), "not a whole number"),
    "read key": (lambda q: pyehl.Case(q, {3: 65}), "options = 3"),
    "read array": (lambda q: pyehl.Case(q, {"grid.points": np.ones(2)}), "not ndarray"),
    "case group": (lambda q: pyehl.Case(gird={"points": 65}), "did you mean 'grid'"),
    "case key": (lambda q: pyehl.Case(contact={"laod": 65.0}), "did you mean 'load'"),
    "case value": (lambda q: pyehl.Case(grid={"points": None}), "grid.points = None"),
    "case number": (lambda q: pyehl.Case(grid=65), "grid = 65: expected values by key"),
    "read list": (lambda q: pyehl.Case(q, [SMALL, 3]), "options = 3"),
    "read bytes": (lambda q: pyehl.Case(q, b"grid.points=65"), "not bytes"),
    "read lines": (lambda q: pyehl.Case(q, f"{SMALL}\n"), "more than one line"),
    "options number": (lambda q: pyehl.Case(q).with_options(3), "not int"),
    "solve None": (lambda q: pyehl.solve(None), "expected a path"),
    "solve dict": (lambda q: pyehl.solve({}), "not dict"),
    "solve output": (lambda q: pyehl.solve(q, SMALL, output=3), "output = 3"),
    "solve progress": (lambda q: pyehl.solve(q, SMALL, progress="x"), "a function"),
    "solve check": (lambda q: pyehl.solve(q, SMALL, check="no"), "True or False"),
    "predict None": (lambda q: pyehl.predict(None), "expected a path"),
    "predict smooth": (lambda q: pyehl.predict(q, smooth=3), "smooth = 3"),
    "predict of a smooth contact": (pyehl.predict, "surface"),
    "solver None": (lambda q: pyehl.Solver(None), "expected a path"),
    "field number": (lambda q: pyehl.Solver(q, SMALL).field(3), "field = 3"),
    "field unknown": (lambda q: pyehl.Solver(q, SMALL).field("Q"), "'P' or 'H'"),
    "write": (lambda q: pyehl.Solver(q, SMALL).write(3), "folder = 3"),
    "resume": (lambda q: pyehl.Solver(q, SMALL).resume(None), "expected a path"),
    "checkpoint": (lambda q: pyehl.Solver(q, SMALL).checkpoint(None), "expected a path"),
    "heights of a smooth contact": (
        lambda q: solver_on_heights(pyehl.Case(q), {"surface": np.ones((8, 8))}),
        "'fractal'",
    ),
    "heights text": (
        lambda q: solver_on_heights(pyehl.Case(q), {"surface": "abc"}),
        "a matrix of numbers",
    ),
    "heights line": (
        lambda q: solver_on_heights(pyehl.Case(q), {"surface": [1.0, 2.0]}),
        "shape (2,)",
    ),
    "heights nan": (
        lambda q: solver_on_heights(pyehl.Case(q), {"surface": np.full((8, 8), np.nan)}),
        "finite",
    ),
    "load None": (lambda q: pyehl.load(None), "expected a path"),
    "load file": (pyehl.load, "not a result folder"),
    "report nothing": (lambda q: pyehl.report("nowhere"), "nowhere: there is no such folder"),
    "load nothing": (lambda q: pyehl.load("nowhere"), "nowhere: not a result folder"),
    "sweep list": (lambda q: pyehl.sweep(q, ["contact.load=3"]), "values by key"),
    "sweep key": (lambda q: pyehl.sweep(q, {3: [1.0]}), "group.key"),
    "sweep value": (lambda q: pyehl.sweep(q, {"contact.moes_m": [Nothing()]}), "neither a number"),
    "sweep run": (lambda q: pyehl.sweep(q, {"contact.moes_m": [9.0]}, run=3), "'predict'"),
    "sweep jobs": (lambda q: pyehl.sweep(q, {"contact.moes_m": [9.0]}, jobs="x"), "jobs = 'x'"),
    "sweep output": (lambda q: pyehl.sweep(q, {"contact.moes_m": [9.0]}, output=3), "output = 3"),
    "sweep outputs": (lambda q: pyehl.sweep(q, {"contact.moes_m": [9.0]}, outputs=3), "names"),
}


@pytest.mark.parametrize("name", CALLS)
def test_bad_argument(quick: str, name: str):
    call, part = CALLS[name]
    with pytest.raises(pyehl.InputError) as caught:
        call(quick)
    assert part in str(caught.value)


def test_one_text_is_one_option(quick: str):
    """A single text in place of a list of texts is not split into characters."""
    for case in (
        pyehl.Case.from_text("", SMALL),
        pyehl.Case.from_text("", [SMALL]),
        pyehl.Case.from_text("").with_options([SMALL]),
        pyehl.Case(quick, (SMALL,)),
        pyehl.Case.from_text(f"&grid points = {65} /"),
    ):
        assert case.resolve()["grid"]["points"] == 65
    ds = pyehl.sweep(quick, {"contact.moes_m": 100.0}, SMALL, outputs="H_c", jobs=1)
    assert "H_c" in ds
    assert "H_min" not in ds


def test_a_case_is_checked_at_once_and_resolved_once(monkeypatch):
    case = pyehl.Case()
    assert pyehl.Case.from_text(case.text) == case
    calls = []
    monkeypatch.setattr("pyehl.case.case.resolve", lambda *a, **k: calls.append(a))
    assert resolved_case(case.text) == pyehl.Case(case) == case
    assert calls == []


def test_derived_values_follow_new_ones():
    case = pyehl.Case()
    other = case.with_options("lubricant.pressure_viscosity=1.1e-8")
    before, after = (c.resolve()["lubricant"]["roelands_z"] for c in (case, other))
    assert after == pytest.approx(0.5 * before, rel=1e-12)


def test_arguments_that_are_not_utf_8(quick: str):
    """Bytes of a file name that are not UTF-8 become lone surrogates."""
    name = os.fsdecode(b"m\xff.npy")
    with pytest.raises(pyehl.InputError, match=r"surface\.file"):
        pyehl.Case(quick, "surface.kind=map", f"surface.file={name}")


def test_faults_of_the_package_stay_what_they_are(cases: Path, tmp_path: Path, monkeypatch):
    """An error that no argument has caused is not reported as bad input."""
    # in a folder without 'out' of another program
    monkeypatch.chdir(tmp_path)

    def broken(*_: object, **__: object) -> None:
        raise ValueError("a fault")

    monkeypatch.setattr("pyehl.api.predict_resolved", broken)
    with pytest.raises(ValueError, match="a fault") as caught:
        pyehl.predict(cases / "table1.nml")
    assert not isinstance(caught.value, pyehl.EhlError)
    # neither a function nor a command reports it as bad input
    for name, words in (
        ("api.predict_resolved", ["predict", "-o", "out"]),
        ("api.sheet", ["film"]),
        ("commands.stribeck.plan_curve", ["stribeck", "--speed", "1", "-o", "out"]),
        ("commands.surface.from_settings", ["surface"]),
    ):
        monkeypatch.setattr(f"pyehl.{name}", broken)
        with pytest.raises(ValueError, match="a fault") as caught:
            cli.main([words[0], str(cases / "table1.nml"), *words[1:]])
        assert not isinstance(caught.value, pyehl.EhlError)
    monkeypatch.setattr("pyehl.solver.gather", broken)
    with pytest.raises(ValueError, match="a fault") as caught:
        pyehl.Solver(cases / "quick.nml")
    assert not isinstance(caught.value, pyehl.EhlError)


@pytest.mark.parametrize(
    "damage",
    ["short array", "array", "large array", "summary", "no object", "encoding", "cell", "no rows"],
)
def test_damaged_result_folder(quick: str, tmp_path: Path, damage: str):
    pyehl.solve(quick, SMALL, output=tmp_path / "out")
    array, summary = tmp_path / "out" / "P.npy", tmp_path / "out" / "summary.json"
    if damage == "short array":
        array.write_bytes(array.read_bytes()[:-8])
    elif damage == "array":
        array.write_bytes(b"\x93NUMPY\x01\0\x10\0{'descr': ((((((")
    elif damage == "large array":
        with array.open("r+b") as stream:
            stream.truncate(2**41)
    elif damage == "summary":
        summary.write_text(summary.read_text()[:50])
    elif damage == "no object":
        summary.write_text("[]")
    elif damage in ("cell", "no rows"):
        (tmp_path / "out" / "history.csv").write_text("T,mu\n0.0,x\n" if damage == "cell" else "")
    else:
        summary.write_bytes(b"\xff" + json.dumps({}).encode())
    kind = pyehl.errors.NoMemoryError if damage == "large array" else pyehl.FileError
    with pytest.raises(kind, match=r"P\.npy|summary\.json|history\.csv"):
        pyehl.load(tmp_path / "out")


def test_a_damaged_file_prints_nothing_on_standard_output(tmp_path: Path, capsys):
    (tmp_path / "case.nml").write_text(SMALL)
    (tmp_path / "summary.json").write_text('{"kind"')
    assert cli.main(["export", str(tmp_path)]) == 1
    printed = capsys.readouterr()
    assert printed.out == ""
    assert "summary.json or case.nml is damaged" in printed.err


@pytest.mark.parametrize("command", ["plot", "export"])
def test_result_of_another_kind(tmp_path: Path, capsys: pytest.CaptureFixture[str], command: str):
    """The folder of a response contains a case and a summary, too."""
    (tmp_path / "case.nml").write_text(SMALL)
    (tmp_path / "summary.json").write_text('{"kind": "response", "moes_m": 200.0}')
    assert cli.main([command, str(tmp_path)]) == 2
    assert "not a result folder of one case (of 'response')" in capsys.readouterr().err
