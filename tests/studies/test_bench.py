# SPDX-License-Identifier: BSD-3-Clause
"""The scripts of `benchmarks/` on tiny campaigns."""

import importlib
import json
import math
from pathlib import Path

import mixed
import pytest
import skips
import smooth
import step
import sweep
import workprec
from matplotlib.image import imread

import pyehl
from pyehl.studies.sweep import Outcome


@pytest.mark.long
def test_skips_change_nothing(tmp_path: Path, capsys, monkeypatch):
    """Rows on small grids; the exit status states that nothing differs."""
    monkeypatch.setattr(skips, "MIN_POINTS", 65)
    monkeypatch.setattr(skips, "PREDICTIONS", 2)
    point = ("contact.moes_m=100.0", "contact.moes_l=6.0", "surface.velocity_ratio=1.01")
    domain = ("grid.x_inlet=-2.5", "grid.x_outlet=1.5", "grid.y_extent=2.0")
    wave = (*point, *domain, "surface.kind=harmonic", "surface.amplitude_over_film=0.2")
    monkeypatch.setattr(skips, "WAVE", wave)
    words = ["--problems", "wave,predict", "--points", "65"]
    assert skips.main([*words, "-o", str(tmp_path / "skips.json")]) == 0
    assert "symmetric in Y" in capsys.readouterr().out
    rows = json.loads((tmp_path / "skips.json").read_text())["rows"]
    assert [row["quantity"] for row in rows] == ["mu_ratio"] * 4 + ["F", "mu_ratio"]
    for row in rows:
        assert row["difference"] <= row["allowed"] < 0.05
        assert row["seconds"] > 0.0
    # the kept contact and the solved one give the same bits
    assert [row["difference"] for row in rows[4:]] == [0.0, 0.0]


def test_skips_that_change_results_are_reported(monkeypatch, capsys):
    row = dict.fromkeys((name for name, _ in skips.COLUMNS), 0.0)
    row |= {"problem": "s", "skipped": "w", "quantity": "q", "same": False}
    monkeypatch.setattr(skips, "PROBLEMS", {"predict": lambda points: [row]})
    assert skips.main(["--problems", "predict"]) == 1
    with pytest.raises(SystemExit, match="2"):
        skips.main(["--problems", "perdict"])
    assert "perdict" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "stated"),
    [
        ("deflection --seed 3", "unrecognized arguments: --seed 3"),
        ("deflection --points 2", "2; expected: 3 or more"),
        ("deflection --threads 0", "0; expected: 1 or more"),
        ("deflection --points many", "'many' is not like 129,257"),
        ("smooth --cases square", "'square'; expected: some of circle, law, ellipse"),
        ("sweep --problems flim", "'flim'; expected: some of film, predict"),
        ("step --cases nothing", "'nothing'; expected: some of wave, fractal"),
        ("machines --count 0", "0; expected: 1 or more"),
        ("stress --seed 3", "arguments are required: -o"),
        ("stress --cases 0 -o t", "0; expected: 1 or more"),
        ("stress --cases many -o t", "invalid int value: 'many'"),
        ("stress --boundary-film -o t", "--boundary-film needs a --shear-law that thins"),
        ("faults", "arguments are required: -o"),
    ],
)
def test_scripts_refuse_unknown_arguments(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys, words: str, stated: str
):
    monkeypatch.chdir(tmp_path)
    name, *rest = words.split()
    try:
        status = importlib.import_module(name).main(rest)
    except SystemExit as end:
        status = end.code
    assert status == 2
    assert stated in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


@pytest.mark.long
def test_skips_of_smooth_contacts():
    rows = skips.skip_rows(["smooth"], 257)
    assert len(rows) >= 2
    assert all(row["same"] for row in rows)


@pytest.mark.long
def test_smooth_cases_relative_to_the_circle(monkeypatch):
    """Rows of a law and of an ellipse with the same equations; time per node over the circle's."""
    # the line of the benchmark has as many nodes as the circle
    monkeypatch.setattr(smooth, "RADIUS_RATIO", 0.1)
    rows = smooth.smooth_rows([129], [1], ["mlmi"], 1000.0, 10.0, smooth.CASES, repeats=1)
    assert [row["case"] for row in rows] == ["circle", "law", "ellipse"]
    assert [row["status"] for row in rows] == ["converged"] * 3
    films = [row["H_c"] for row in rows]
    # the law hardly thins in nearly pure rolling; an ellipse has another film
    assert films[1] == pytest.approx(films[0], rel=5e-3)
    assert films[2] > 1.05 * films[0]
    assert rows[0]["ratio"] == 1.0
    assert rows[1]["ratio"] == pytest.approx(rows[1]["seconds"] / rows[0]["seconds"], rel=1e-12)
    grid = "&grid points = 129 /\n"
    text = smooth.case_text("ellipse", 1000.0, 10.0) + grid
    across = pyehl.Case.from_text(text).resolve()["grid"]["points_y"]
    assert across > 129
    per_node = rows[2]["seconds"] / rows[0]["seconds"] * 129 / across
    assert rows[2]["ratio"] == pytest.approx(per_node, rel=1e-12)


def test_steps_of_two_benchmark_problems(monkeypatch):
    wave = "&surface kind = 'harmonic' amplitude_over_film = 0.2 velocity_ratio = 1.01 /\n"
    ball = "&contact moes_m = 50.0 moes_l = 5.0 /\n"
    plain = step.Problem("wave", "half", ball + wave)
    ellipse = ball.replace(" /", " radius_ratio = 0.5 /")
    beside = step.Problem("wave-ellipse", "half", ellipse + wave, "wave")
    monkeypatch.setattr(step, "CASES", (plain, beside))
    rows = step.step_rows([33], [1], problems=[plain, beside], front=-1.0, steps=3)
    assert rows[0]["ratio"] is None
    # seconds per node over those of the circle
    assert rows[1]["ratio"] > 0.0
    assert len(rows[1]["seconds_of_steps"]) == 3


def test_problems_of_the_step_benchmark_are_cases():
    places = {(problem.name, problem.domain) for problem in step.CASES}
    for problem in step.CASES:
        assert pyehl.Case.from_text(problem.text).resolve()["surface"]["kind"] != "smooth"
        assert not problem.beside or (problem.beside, problem.domain) in places
    assert set(step.USUAL) <= {name for name, _ in places}


def test_interrupted_sweep_has_no_throughput(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(sweep, "perform", lambda *_, **__: Outcome({}, interrupted=True))
    assert sweep.main(["--problems", "film", "--threads", "1"]) == 130


@pytest.mark.long
def test_work_and_precision(tmp_path: Path, capsys):
    words = ["--problems", "smooth", "--points", "65,129,257", "--threads", "1"]
    assert workprec.main([*words, "-o", str(tmp_path / "w.json")]) == 0
    assert "smooth, H_c to 1.0%" in capsys.readouterr().out
    rows = json.loads((tmp_path / "w.json").read_text())["rows"]
    assert imread(tmp_path / "w.png").std() > 0.1
    film = {
        row["points"]: row["error"]
        for row in rows
        if (row["quantity"], row["setting"]) == ("H_c", "default") and row["error"] is not None
    }
    assert film[129] > film[257] > 0.0
    # second order
    assert film[129] / film[257] == pytest.approx(4.0, rel=0.3)


@pytest.mark.long
def test_seconds_of_a_step(tmp_path: Path, capsys, monkeypatch):
    contact = "&contact load = 20.0 /\n&grid x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0 /\n"
    tile = "pixels = 32 length_x = 1e-4 length_y = 1e-4 rms_height = 2e-8"
    problem = step.Problem("fractal", "whole", f"{contact}&surface kind = 'fractal' {tile} /\n")
    monkeypatch.setattr(step, "CASES", (problem,))
    words = ["--points", "33,65", "--threads", "1,2", "--cases", "fractal", "--steps", "3"]
    target = tmp_path / "step.json"
    assert step.main([*words, "--error", "-o", str(target)]) == 0
    printed = capsys.readouterr().out
    assert "units: of one scipy.fft deflection" in printed
    answer = json.loads(target.read_text())
    rows = answer["rows"]
    assert [(row["points"], row["threads"]) for row in rows] == [(33, 1), (33, 2), (65, 1), (65, 2)]
    for row in rows:
        assert len(row["seconds_of_steps"]) == 3
        assert row["seconds"] == pytest.approx(sum(row["seconds_of_steps"]) / 3, rel=1e-12)
        assert row["units"] == row["seconds"] / row["unit_seconds"]
        assert 1.0 <= row["cycles"] <= 30.0
    first = [row["seconds_of_steps"] for row in rows[:2]]
    assert rows[1]["speedup"] == sorted(one / two for one, two in zip(*first, strict=True))[1]
    # the same steps whatever the number of threads
    assert rows[0]["cycles"] == rows[1]["cycles"]
    runs = {row["points"]: row for row in answer["runs"]}
    assert runs[65]["error"] is None
    expected = abs(runs[33]["mu_ratio"] / runs[65]["mu_ratio"] - 1.0)
    assert rows[0]["error"] == runs[33]["error"] == pytest.approx(expected, rel=1e-12)


@pytest.mark.long
def test_cases_per_core_hour(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    words = ["--problems", "film", "--threads", "1,2"]
    assert sweep.main([*words, "-o", str(tmp_path / "b.json")]) == 0
    reported = capsys.readouterr().out
    assert "cases per core hour" in reported
    one, two = json.loads((tmp_path / "b.json").read_text())["rows"]
    assert (one["cases"], one["processes"], two["processes"]) == (400, 1, 2)
    assert one["efficiency"] == 1.0
    assert two["efficiency"] == pytest.approx(one["wall_seconds"] / two["wall_seconds"] / 2.0)
    assert 0.0 < one["busy"] <= 1.0
    assert one["overhead_ms"] > 0.0
    assert two["overhead_ms"] is None
    assert list(one["statuses"].values()) == [400]


def test_cheapest_setting():
    def row(setting: str, seconds: float, error: float) -> dict[str, object]:
        names = {"problem": "s", "quantity": "q", "bar": 1e-4}
        return {"setting": setting, "seconds": seconds, "error": error} | names

    rows = [row("dear", 9.0, 1e-5), row("cheap", 1.0, 0.02), row("mean", 2.0, 0.008)]
    result = {r["level"]: r["best"] for r in workprec.cheapest(rows)}
    assert result[0.03]["setting"] == "cheap"
    assert result[0.01]["setting"] == "mean"
    assert result[0.001]["setting"] == "dear"
    assert math.isclose(sum(result), sum(workprec.LEVELS))


def test_inconsistent_results_are_reported():
    consistent = {"mu": 0.06, "mu_smooth": 0.05, "mu_ratio": 1.2, "mu_note": ""}
    consistent |= {"contact_load_share": 0}
    assert mixed.contradictions(consistent) == []
    assert mixed.contradictions(consistent | {"mu_ratio": 1.3}) == ["mu = mu_smooth mu_ratio"]
    lost = consistent | {"contact_load_share": None}
    assert "friction without a load share" in mixed.contradictions(lost)
    assert "no load share and no reason" in mixed.contradictions(lost)
    assert "load share" in mixed.contradictions(consistent | {"contact_load_share": 1.1})
    assert "not a number" in mixed.contradictions(consistent | {"mu_ratio": math.nan})
