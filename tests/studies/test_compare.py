# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl compare``: results against tables of references; a wrong value fails."""

import json
import math
from pathlib import Path
from typing import Any

import pytest

import pyehl
from pyehl.cli import main
from pyehl.errors import InputError
from pyehl.studies.compare import SHIPPED, Results, compare, read_reference, read_results

HEAD = "contact.moes_m,contact.moes_l,H_c,H_c_rtol"


def write(path: Path, *lines: str) -> Path:
    path.write_text("\n".join(lines) + "\n")
    return path


@pytest.fixture(scope="module")
def study(cases: Path, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, list[float]]:
    """Folder of a small study over M, and its H_c."""
    folder = tmp_path_factory.mktemp("compare") / "study"
    data = pyehl.sweep(
        cases / "quick.nml",
        {"contact.moes_m": [50.0, 100.0]},
        "grid.points=65",
        output=folder,
        jobs=1,
    )
    return folder, [float(v) for v in data.H_c]


def test_a_group_that_the_case_lacks_has_no_key():
    results = Results(
        "one", ({"H_c": 0.1},), many=False, case=pyehl.Case(contact={"moes_m": 100.0}).text
    )
    assert results.key({}, "second_surface.kind") is None


def rows_of(name: str, points: int) -> dict[str, list[Any]]:
    """Keys of the rows of a shipped table on one grid, to be varied together."""
    table = read_reference(name)
    rows = [row for row in table.rows if row.keys["grid.points"] == points]
    vary = {key: [row.keys[key] for row in rows] for key in table.keys}
    return vary | {"grid.points": [points] * len(rows)}


@pytest.mark.parametrize(("name", "points", "values"), [("smooth", 129, 8), ("waviness", 129, 6)])
def test_own_references(
    cases: Path, tmp_path: Path, name: str, points: int, values: int, capsys: Any
):
    """The tables of smooth and wavy contacts, on a grid that takes seconds."""
    folder = tmp_path / name
    pyehl.sweep(
        cases / "quick.nml",
        rows_of(name, points),
        "time.estimate_error=.false.",
        zipped=True,
        output=folder,
    )
    assert main(["compare", str(folder), name]) == 1
    reported = capsys.readouterr().out
    assert f"{values} of {values} values pass" in reported
    assert "rows of the table have no result" in reported
    assert main(["compare", str(folder), name, "--partial"]) == 0


def test_shipped_tables_say_where_they_are_from():
    for name in SHIPPED:
        notes = " ".join(read_reference(name).notes)
        assert "Source:" in notes
        assert "Tolerance:" in notes


def test_a_wrong_value_fails(study: tuple[Path, list[float]], tmp_path: Path, capsys: Any):
    folder, (first, second) = study
    good = write(tmp_path / "good.csv", HEAD, f"50,10,{first},1e-6", f"100,10,{second},1e-6")
    assert main(["compare", str(folder), str(good)]) == 0
    assert "2 of 2 values pass" in capsys.readouterr().out
    wrong = write(
        tmp_path / "wrong.csv", HEAD, f"50,10,{first},1e-6", f"100,10,{1.01 * second},1e-3"
    )
    assert main(["compare", str(folder), str(wrong)]) == 1
    reported = capsys.readouterr().out
    assert "-0.99 %" in reported
    assert "1 of 2 values pass" in reported
    assert main(["compare", str(folder), str(wrong), "-q"]) == 1
    assert "pass" not in capsys.readouterr().out


def test_rows_without_results(study: tuple[Path, list[float]], tmp_path: Path, capsys: Any):
    folder, (first, _) = study
    table = write(tmp_path / "t.csv", HEAD, f"50,10,{first},1e-6", "77,10,0.1,1")
    assert main(["compare", str(folder), str(table)]) == 1
    assert "moes_m=77" in capsys.readouterr().out
    assert main(["compare", str(folder), str(table), "--partial"]) == 0
    none = write(tmp_path / "none.csv", HEAD, "77,10,0.1,1")
    assert main(["compare", str(folder), str(none)]) == 2


def test_a_single_result(cases: Path, tmp_path: Path):
    """Keys are those of the case, varied or not; a row of another case is not compared."""
    data = pyehl.solve(cases / "quick.nml", "grid.points=65", output=tmp_path / "one")
    value = float(data.H_c)
    table = write(
        tmp_path / "t.csv",
        "# a comment",
        "contact.moes_m,grid.points,surface.kind,H_c,H_c_atol,note",
        f"200,65,smooth,{value + 1e-4},2e-4,here",
        "200,129,smooth,0.1,1,elsewhere",
    )
    result = compare(read_results(tmp_path / "one"), read_reference(table))
    (deviation,) = result.deviations
    assert deviation.passed
    assert deviation.difference == pytest.approx(-1e-4)
    assert [row.keys["grid.points"] for row in result.missing] == [129.0]
    assert main(["compare", str(tmp_path / "one"), str(table)]) == 0


def test_a_result_without_the_number_fails(tmp_path: Path, study: tuple[Path, list[float]]):
    folder = tmp_path / "failed"
    folder.mkdir()
    (folder / "summary.json").write_text(json.dumps({"status": "cycle limit", "H_c": None}))
    (folder / "case.nml").write_text(pyehl.Case.from_text("").text)
    table = write(tmp_path / "t.csv", "H_c,H_c_rtol", "0.1,10")
    result = compare(read_results(folder), read_reference(table))
    assert not result.passed
    assert "cycle limit" in str(result.deviations[0])
    assert math.isnan(result.deviations[0].difference)


def test_any_csv(tmp_path: Path):
    rows = write(tmp_path / "rows.csv", "# mine", "contact.load,mu", "100,0.04", "200,0.05")
    table = write(tmp_path / "t.csv", "contact.load,mu,mu_atol", "200,0.051,0.002")
    assert main(["compare", str(rows), str(table)]) == 0
    strict = write(tmp_path / "strict.csv", "contact.load,mu,mu_atol", "200,0.051,0.0002")
    assert main(["compare", str(rows), str(strict)]) == 1
    # nothing states the temperature
    other = write(tmp_path / "other.csv", "lubricant.temperature,mu,mu_atol", "40,0.051,0.002")
    assert main(["compare", str(rows), str(other)]) == 2
    for text in ("mu\n", "mu\n1,2\n3,4,5\n"):
        rows.write_text(text)
        assert main(["compare", str(rows), str(table)]) == 2


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        (["contact.moes_n,H_c,H_c_rtol", "1,2,3"], "did you mean 'contact.moes_m'"),
        (["H_c,H_d_rtol", "1,2"], "tolerance of no column; did you mean 'H_c'"),
        (["H_c,H_c", "1,2"], "is repeated"),
        (["H_c,H_c_rtol"], "there are no rows"),
        (["H_c,H_c_rtol", "1"], "t.csv:2: error: 1 values for 2 columns"),
        (["H_c,H_c_rtol", "x,1"], "t.csv:2: error: H_c = 'x'"),
        (["H_c,H_c_rtol", "1,-1"], "not negative"),
        (["H_c", "1"], "H_c has no tolerance"),
        (["contact.moes_m,H_c,H_c_rtol", ",1,1"], "contact.moes_m is empty"),
        (["contact.moes_m", "1"], "no column of values"),
        (["H_cc,H_cc_rtol", "1,1"], "did you mean 'H_c'"),
    ],
)
def test_bad_tables(
    study: tuple[Path, list[float]], tmp_path: Path, lines: list[str], message: str
):
    table = write(tmp_path / "t.csv", *lines)
    with pytest.raises(InputError) as refusal:
        compare(read_results(study[0]), read_reference(table))
    assert message in str(refusal.value)
    assert "t.csv" in str(refusal.value)


def test_no_results_and_no_table(tmp_path: Path, study: tuple[Path, list[float]]):
    with pytest.raises(InputError, match="no results"):
        read_results(tmp_path)
    with pytest.raises(InputError, match="smooth, waviness"):
        read_reference(tmp_path / "nothing.csv")
    assert main(["compare", str(study[0]), "smoth"]) == 2
