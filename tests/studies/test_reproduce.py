# SPDX-License-Identifier: BSD-3-Clause
"""`examples/zhang2019`: the paper against new runs; a wrong number of the paper fails."""

import ast
import html
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import conditions
import figure2
import numpy as np
import pytest
from curve_fit import evaluate, fit, scatter
from driver import PIECES, reproduce, write_report
from journals import rows_in
from parameter import SMALL_WAVES, response_parameter
from piece import FULL, QUICK, Check, Level, Result, read_references
from reproduce import main

from pyehl.case import Case
from pyehl.studies.journal import NAME

SMALL = Level("small", (257,), 97, 129, 129, (97, 129), 2, "most of it")


def one(name: str, folder: Path, **more: Any) -> Result:
    (result,) = reproduce([name], SMALL, folder, jobs=2, **more)
    return result


def check_of(result: Result, words: str) -> Check:
    (found,) = [check for check in result.checks if words in check.name]
    return found


def wrong(name: str, factor: float) -> dict[str, Any]:
    numbers = read_references()
    return numbers | {name: replace(numbers[name], value=factor * numbers[name].value)}


def test_table_1(tmp_path: Path):
    result = one("table 1", tmp_path)
    assert result.passed
    assert len(result.checks) == 17
    # numbers that follow from the inputs, to the digits printed or calculated by hand
    for name, tolerance in (("hertz_pressure", 2e-4), ("hertz_radius", 1e-5), ("moes_m", 2e-5)):
        check = check_of(result, name)
        assert abs(check.deviation / check.expected) < tolerance
    assert check_of(result, "moes_l").deviation == pytest.approx(0.0237, abs=1e-3)
    assert "pass: 17 of 17" in (tmp_path / "report.html").read_text()


def test_no_sentence_of_the_page_is_cut(tmp_path: Path):
    why = "a tenth of what the grid leaves open & more, " * 5
    result = Result([Check("x", 2.0, 1.0, 0.5, why, "there")], name="figure 9", folder=tmp_path)
    page = write_report(tmp_path, [result], SMALL, []).read_text()
    assert html.escape(why.strip()) in page


@pytest.mark.parametrize("name", ["hertz_pressure", "roelands_z", "rms_height", "load"])
def test_a_wrong_number_of_table_1_fails(tmp_path: Path, name: str):
    result = one("table 1", tmp_path, references=wrong(f"table1.{name}", 1.01))
    assert not result.passed
    assert [c.name.split()[0] for c in result.checks if not c.passed] == [name]
    assert "FAIL: 16 of 17" in result.line()
    assert "FAIL" in (tmp_path / "report.html").read_text()


@pytest.fixture(scope="module")
def figure_2(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Result]:
    folder = tmp_path_factory.mktemp("figure2")
    return folder, one("figure 2", folder)


@pytest.mark.long
def test_figure_2_on_a_coarser_grid(figure_2: tuple[Path, Result]):
    """257 x 257: as another program, and 0.6 % below the paper."""
    _, result = figure_2
    independent = check_of(result, "257 x 257 nodes, scheme 'paper'")
    assert independent.passed
    assert independent.deviation == pytest.approx(0.0, abs=2e-3)
    printed = check_of(result, "scheme of the paper")
    assert printed.expected == 1.461
    assert printed.deviation == pytest.approx(-0.009, abs=2e-3)
    assert not printed.passed
    film = check_of(result, "H_c")
    assert film.deviation / film.expected == pytest.approx(-0.032, abs=2e-3)


def test_the_paper_does_not_change_what_is_computed(figure_2: tuple[Path, Result]):
    """With another number of the paper the curves are the same, and the deviation differs."""
    folder, before = figure_2
    table = before.file(".csv").read_bytes()
    (journal,) = folder.glob(f"studies/*/{NAME}")
    rows = rows_in(journal.parent)
    result = one("figure 2", folder, references=wrong("fig2.mu_ratio", 0.994))
    assert result.file(".csv").read_bytes() == table
    # and no case is run again
    assert rows_in(journal.parent) == rows
    assert check_of(result, "scheme of the paper").passed
    assert not check_of(before, "scheme of the paper").passed


@pytest.mark.slow
def test_figure_2_on_the_grid_of_the_paper(tmp_path: Path):
    level = replace(SMALL, wave_grids=(513,))
    (result,) = reproduce(["figure 2"], level, tmp_path)
    assert result.passed
    assert len(result.checks) == 4
    assert not [c for c in result.checks if not c.judged]


def test_nothing_that_computes_reads_the_numbers_of_the_paper(root: Path):
    """Only `driver` reads them, and only `show` receives them."""
    folder = root / "examples" / "zhang2019"
    for path in [*(root / "pyehl").rglob("*.py"), *folder.glob("*.py")]:
        tree = ast.parse(path.read_text())
        names = {
            f"{node.module}.{alias.name}"
            for node in ast.walk(tree)
            if isinstance(node, ast.ImportFrom)
            for alias in node.names
        }
        if "piece.read_references" in names:
            assert path == folder / "driver.py"
        if "zhang2019.csv" in path.read_text():
            assert path == folder / "piece.py"
        if path.parent == folder:
            for node in ast.walk(tree):
                if isinstance(node, ast.FunctionDef) and node.name == "run":
                    assert "eferences" not in ast.unparse(node), path


def test_references_say_where_they_are_from():
    numbers = read_references()
    for r in numbers.values():
        assert int(r.page) in range(1, 9)
        assert r.where
        assert r.how.split(":")[0] in ("text", "table", "derived", "digitised")
        assert r.reading >= 0.0
        assert r.why


def test_figures_1_and_5_and_the_report(tmp_path: Path):
    results = reproduce(["figure 5", "figure 1"], SMALL, tmp_path, machine=["machine  this one"])
    assert [r.name for r in results] == ["figure 1", "figure 5"]
    assert all(r.passed for r in results)
    page = (tmp_path / "report.html").read_text()
    assert page.count('src="data:image/png;base64,') == 2
    assert "machine  this one" in page
    targets = [t for t in re.findall(r"href='([^']+)'", page) if not t.startswith("#")]
    assert len(targets) == 2
    for target in targets:
        assert (tmp_path / target).is_file()
    assert "most of it" in page


def test_fit_finds_what_is_there():
    theta = np.geomspace(0.5, 5.0, 40)
    curve = np.repeat(np.arange(8), 5)
    exact = evaluate(theta, 0.5, 0.2)
    result = fit(theta, exact, curve)
    assert (result.second, result.fourth) == pytest.approx((0.5, 0.2), rel=1e-9)
    assert scatter(exact, result.at(theta)) < 1e-12
    # each curve deviates by some per cent: the interval is wider than that of single points
    random = np.random.default_rng(0)
    off = exact * np.exp(0.05 * random.standard_normal(8))[curve]
    result = fit(theta, off, curve)
    assert result.second_interval[0] < result.second < result.second_interval[1]
    assert result.fourth_interval[0] < 0.2 < result.fourth_interval[1]
    with pytest.raises(ValueError, match="three curves"):
        fit(theta[:5], exact[:5], curve[:5])


def test_parameter_from_the_response():
    """It scales with 1/A, and small waves of a full simulation follow its theory."""
    point = (np.array([1000.0, 1000.0]), np.array([10.0, 10.0]), np.array([0.5, 0.5]))
    theta = response_parameter(*point, np.array([1e-3, 2e-3]), 1.01)
    assert theta[0] == pytest.approx(2.0 * theta[1], rel=1e-12)
    # 513 x 513 nodes, narrow scheme: wavelength 0.5, A = 0.0024, and wavelength 1, A = 0.0097
    simulated = np.array([0.0243, 0.148])
    point = (point[0], point[1], np.array([0.5, 1.0]))
    theta = response_parameter(*point, np.array([0.0024, 0.0097]), 1.01)
    assert SMALL_WAVES * theta**-2 == pytest.approx(simulated, rel=0.12)


def test_a_failed_run_fails_its_piece_alone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """The report names the run, and the other parts exist; the next call repeats it."""
    good = figure2.CASE
    monkeypatch.setattr(figure2, "CASE", good + "&solver max_cycles = 1 /\n")
    level = replace(SMALL, wave_grids=(33,))
    table_1, figure_2 = reproduce(["figure 2", "table 1"], level, tmp_path, jobs=2)
    assert table_1.passed
    assert not figure_2.passed
    assert figure_2.line().startswith("FAIL: case 1 of the study 'figure2-33': ")
    text = (tmp_path / "report.html").read_text()
    assert "1 of 2 pieces are within all their tolerances." in text
    assert "case 1 of the study" in text


@pytest.mark.slow
def test_waves_and_surfaces_on_coarse_grids(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """All other parts, small: whether they run, not how well they agree with the paper."""
    curves = ((1000.0, 10.0, 1.0), (1000.0, 10.0, 0.5), (500.0, 5.0, 1.0), (500.0, 10.0, 0.5))
    monkeypatch.setattr(conditions, "CURVES", curves)
    monkeypatch.setattr(conditions, "RATIOS", (1.6, 2.5, 5.0))
    names = [n for n in PIECES if n not in ("table 1", "figure 1", "figure 2", "figure 5")]
    result = {r.name: r for r in reproduce(names, SMALL, tmp_path)}
    assert set(result) == set(names)
    # with the narrow scheme the response collapses the waves better than theta_2
    narrow = next(n for n in result["figure 4"].notes if "'narrow', theta_r" in n)
    assert float(re.search(r"that is ([\d.]+) times less", narrow)[1]) > 1.3
    assert check_of(result["figure 6"], "correlation").value > 0.95
    assert check_of(result["figure 7"], "our prediction").value < 0.02
    assert all(r.findings for r in (result["figure 6"], result["figure 7"], result["table 2"]))
    assert all(r.seconds > 0.0 for r in result.values())
    assert result["figure 3"].line().startswith("nothing to judge: ")
    assert result["table 2"].line().startswith("nothing to judge: ")


def test_a_failure_with_a_known_finding():
    check = Check("x", 2.0, 1.0, 0.5, "why", "there", finding="Damping")
    reported = Result([check])
    assert "not reproduced: Damping" in check.verdict
    assert reported.passed
    assert reported.line().startswith("not reproduced")
    bare = replace(reported, checks=[replace(check, finding="")])
    assert not bare.passed
    assert bare.line().startswith("FAIL")


def test_a_check_without_a_number_does_not_pass():
    """Neither green in the report nor counted among the parts that are within tolerances."""
    free = Check("x", 2.0, 1.0, None, "of another surface", "there")
    for checks in ((), (free,)):
        result = Result(checks, unjudged="it is not published")
        assert result.verdict == "nothing to judge"
        assert result.line() == "nothing to judge: it is not published"


def test_command(tmp_path: Path, capsys: Any):
    folder = tmp_path / "out"
    assert main(["--table", "1", "-o", str(folder)]) == 0
    reported = capsys.readouterr().out
    assert "table 1    pass: 17 of 17" in reported
    assert "report.html" in reported
    page = (folder / "report.html").read_text()
    assert QUICK.leaves_out in page
    assert "numpy" in page
    with pytest.raises(SystemExit, match="2"):
        main(["--figure", "8", "-o", str(tmp_path / "no")])
    assert "choose from" in capsys.readouterr().err
    assert not (tmp_path / "no").exists()
    with pytest.raises(SystemExit):
        main(["--quick", "--full", "-o", str(folder)])


def test_levels_of_the_reproduction():
    assert len(conditions.CURVES) * len(conditions.RATIOS) >= 60
    assert FULL.surfaces == 20
    assert FULL.meshes == (257, 513, 1025)
    assert QUICK.collapse_grid < FULL.collapse_grid == 513


def test_predictions_have_the_waves_of_the_grid():
    (option,) = conditions.resolved_waves(257)
    shortest = Case.from_text(conditions.CASE, [option]).resolve()["surface"]
    assert shortest["shortest_wavelength"] == pytest.approx(8.0 / 256 * 4.154e-4, rel=1e-3)
