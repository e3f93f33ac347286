# SPDX-License-Identifier: BSD-3-Clause
"""The scripts of `benchmarks/` on tiny campaigns."""

import importlib
import json
import math
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import duties
import faults
import faults_inputs
import machines
import mixed
import numpy as np
import pytest
import skips
import smooth
import step
import stress
import stress_cases
import stress_checks
import sweep
import workprec
from journals import rows_in
from matplotlib.image import imread

import pyehl
from pyehl.cli import main
from pyehl.studies.journal import NAME
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


@pytest.mark.slow
def test_stress_campaign(tmp_path: Path, capsys):
    """A tiny campaign: it ends without a fault, and the same seed draws the same cases."""
    words = ["--cases", "8", "--seed", "3", "--points", "65", "--jobs", "1"]
    assert stress.main([*words, "-o", str(tmp_path / "s")]) == 0
    assert "checked" in capsys.readouterr().out
    answer = json.loads((tmp_path / "s" / "stress.json").read_text())
    assert [row["family"] for row in answer["rows"]].count("wave") == 4
    assert imread(tmp_path / "s" / "stress.png").std() > 0.1
    total = answer["summary"][-1]
    assert total["cases"] == 8
    assert total["wrong"] == 0
    assert total["checked"] >= 1
    assert stress_cases.draw(8, 3, (65,)) == stress_cases.draw(8, 3, (65,))


@pytest.mark.long
def test_interrupted_stress_keeps_what_is_done(root: Path, tmp_path: Path):
    """By SIGTERM: a sentence, status 130, and the finished rows stay in the journal."""
    folder = tmp_path / "s"
    words = ["--cases", "100", "--points", "65", "--jobs", "1"]
    process = subprocess.Popen(
        [sys.executable, root / "benchmarks" / "stress.py", *words, "-o", str(folder)],
        stderr=subprocess.PIPE,
        text=True,
    )
    end = time.monotonic() + 60.0
    while sum(len(rows_in(path.parent)) for path in folder.glob(f"*/{NAME}")) < 2:
        assert process.poll() is None
        assert time.monotonic() < end
        time.sleep(0.01)
    process.terminate()
    _, complaint = process.communicate(timeout=60)
    assert process.returncode == 130, complaint
    assert f"interrupted; the same command resumes it in {folder}" in complaint
    assert "Traceback" not in complaint
    (journal,) = folder.glob(f"*/{NAME}")
    assert len(rows_in(journal.parent)) >= 2
    assert not (folder / "stress.json").exists()


def test_interrupted_sweep_has_no_throughput(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(sweep, "perform", lambda *_, **__: Outcome({}, interrupted=True))
    assert sweep.main(["--problems", "film", "--threads", "1"]) == 130


def test_wrong_results_are_detected():
    row = {"family": "wave", "outcome": "converged", "mu_ratio": 1.5, "mu_ratio_error": 0.03}
    near, far = dict(row), dict(row)
    stress_checks.judge(near, {"status": "converged", "mu_ratio": 1.51})
    stress_checks.judge(far, {"status": "converged", "mu_ratio": 1.56})
    assert not near["wrong"]
    assert far["wrong"]
    assert far["difference"] == pytest.approx(1.0 - 1.5 / 1.56)


def test_cases_of_a_campaign_cover_what_can_be_asked_for():
    cases = stress_cases.draw(500, 1)
    assert {case.family for case in cases} == set(stress_cases.FAMILIES)
    assert min(case.moes_m for case in cases) < 8.0
    assert max(case.moes_m for case in cases) > 3000.0
    assert max(case.moes_l for case in cases) > 24.0
    moving = [case for case in cases if case.values.get("surface.velocity_ratio")]
    assert {case.values["time.scheme"] for case in moving} == {"narrow", "paper"}
    # every run has a limit: a number of steps, or few enough until the mean can settle
    for case in moving:
        assert case.values["time.steps"] in (0, stress_cases.MAX_STEPS[case.points])


def test_the_record_is_of_the_cases_that_are_drawn(script):
    rows = script("docs/evidence/stress/make.py").read()
    drawn = stress_cases.draw(len(rows), 1)
    assert [row["family"] for row in rows] == [case.family for case in drawn]
    assert [float(row["moes_m"]) for row in rows] == [case.moes_m for case in drawn]


def test_a_shear_law_changes_no_other_key_of_the_campaign():
    plain = stress_cases.draw(60, 1)
    for law in ("eyring", "carreau"):
        thinning = stress_cases.draw(60, 1, law=law)
        assert thinning == stress_cases.draw(60, 1, law=law)
        assert [case.family for case in thinning] == [case.family for case in plain]
        stresses = [case.values[f"lubricant.{law}_stress"] for case in thinning]
        assert max(stresses) > 10.0 * min(stresses)
        for case in thinning:
            resolved = pyehl.Case.from_text("", case.values).resolve()
            assert resolved["lubricant"]["shear_law"] == law
            assert resolved["lubricant"]["flow"] == "consistent"


def test_a_boundary_film_changes_no_other_key_of_the_campaign():
    thinning = stress_cases.draw(60, 1, law="eyring")
    layered = stress_cases.draw(60, 1, law="eyring", layer=True)
    new = {"lubricant.boundary_film", "lubricant.boundary_friction"}
    for with_boundary_film, without in zip(layered, thinning, strict=True):
        changed = dict(with_boundary_film.values.items() ^ without.values.items())
        assert set(changed) - {"solver.coarsening"} == new
        assert pyehl.Case.from_text("", with_boundary_film.values).resolve()["lubricant"][
            "boundary_film"
        ]


@pytest.mark.parametrize(
    ("other", "error", "wrong"),
    [(0.32, 0.03, False), (0.34, 0.03, True), (0.3009, 0.0, False), (0.32, None, False)],
)
def test_wrong_load_shares_are_detected(other: float, error: float | None, *, wrong: bool):
    row = {"contact_load_share": 0.3, "contact_load_share_error": error, "wrong": False}
    stress_checks.judge_share(row, "share_finer", {"contact_load_share": other})
    assert row["wrong"] is wrong
    assert row["share_finer"] == other


def test_fields_that_violate_a_condition_are_detected(tmp_path: Path):
    values = {"contact.load": 20.0, "contact.mean_velocity": 0.1, "grid.points": 65}
    values["lubricant.boundary_film"] = 1e-7
    pyehl.solve(pyehl.Case.from_text("", values), output=tmp_path / "c")
    assert stress_checks.broken(tmp_path / "c") == ""
    film = np.load(tmp_path / "c" / "H.npy")
    np.save(tmp_path / "c" / "H.npy", 0.9 * film)
    assert stress_checks.broken(tmp_path / "c").startswith("film of the layer")


@pytest.mark.long
def test_contacts_of_machines(tmp_path: Path, capsys, monkeypatch):
    """A few on a coarse grid: the table, the rows, the ratio to the ball on disc."""
    monkeypatch.setattr(machines, "SETTINGS", {"solver.threads": 1, "grid.points": 129})
    words = ["--seed", "2", "--count", "4"]
    assert machines.main([*words, "--fine", "-o", str(tmp_path / "m.json")]) == 0
    printed = capsys.readouterr()
    assert "kappa > 4" in printed.out
    assert "4 of 4: crowned roller" in printed.err
    answer = json.loads((tmp_path / "m.json").read_text())
    rows = answer["rows"]
    assert [row["kind"] for row in rows] == list(machines.KINDS)
    assert [row["points"] for row in rows] == [129] * 4
    counts = {row["contacts"]: row for row in answer["summary"]}
    disc = counts["ball on disc"]
    assert disc["median_ratio"] == 1.0
    assert disc["converged"] == disc["checked"] == 1
    assert counts["all"]["drawn"] == 4
    assert counts["all"]["largest_seconds"] == max(row["seconds"] for row in rows)
    (ball,) = (row for row in rows if row["kind"] == "ball on disc")
    assert ball["points_y"] is None
    # twice the nodes change the film by about three times the grid error
    assert abs(ball["H_c"] - ball["H_c_fine"]) < 2.0 * ball["H_c_error_grid"]


def test_contacts_of_machines_have_the_pressure_that_was_drawn():
    assert machines.draw(4, 1) == machines.draw(8, 1)[:4]
    for contact in machines.draw(12, 1):
        case = pyehl.Case.from_text("", dict(contact.values))
        point = machines.OperatingPoint.from_settings(case.resolve())
        assert point.hertz_pressure == pytest.approx(contact.pressure, rel=1e-12)
        assert point.ellipse.ellipticity == pytest.approx(contact.ellipticity, rel=1e-12)
        assert 0.4e9 < contact.pressure < 3.0e9
        assert 1.0 <= contact.ellipticity < 31.0


@pytest.mark.long
def test_line_contacts(tmp_path: Path):
    """Both kinds in turn, with the pressure of the case; twice the nodes change the film little."""
    words = ["--shape", "line", "--seed", "3", "--count", "6", "--fine"]
    assert machines.main([*words, "-o", str(tmp_path / "l.json")]) == 0
    answer = json.loads((tmp_path / "l.json").read_text())
    rows = answer["rows"]
    assert [row["kind"] for row in rows] == ["line, SI units", "line, M and L"] * 3
    assert [row["contacts"] for row in answer["summary"]] == [
        *dict.fromkeys(r["kind"] for r in rows),
        "all",
    ]
    for row in rows:
        case = pyehl.Case.from_text("", row["values"])
        line = machines.LineContact.from_settings(case.resolve())
        assert line.hertz_pressure == pytest.approx(row["hertz_pressure_Pa"], rel=2e-3)
        assert row["status"] == row["fine_status"] == "converged"
        assert abs(row["H_c"] - row["H_c_fine"]) < 2.0 * row["H_c_error"]


def test_contacts_that_are_no_case_are_counted():
    """So slow that M is above the limit of a case."""
    contact = machines.draw(1, 3)[0]
    values = contact.values | {"contact.mean_velocity": 1e-6}
    contact = replace(contact, values=values)
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(machines.DRAWS, "ellipse", lambda count, seed: [contact] * count)
        rows = machines.campaign(1, 3, fine=True)
    assert rows[0]["status"] == machines.REFUSED
    assert "M between" in rows[0]["message"]
    whole = machines.summary(rows)[-1]
    assert (whole["drawn"], whole["converged"]) == (1, 0)
    assert whole["largest_seconds"] is None


def test_stated_errors_that_miss_are_counted():
    row = {"kind": "gear", "ellipticity": 9.0, "seconds": 2.0, "status": "converged"}
    row |= {"restarts": 1, "fine_status": "converged"}
    row |= {"H_c": 1.0, "H_c_error": 0.02, "H_min": 0.5, "H_min_error": 0.02}
    good = row | {"H_c_fine": 1.01, "H_min_fine": 0.51}
    bad = row | {"H_c_fine": 1.03, "H_min_fine": 0.51}
    unknown = row | {"H_c_fine": None, "H_min_fine": None, "fine_status": "diverged"}
    failed = row | {"H_c": None, "H_min": None, "H_c_fine": None, "H_min_fine": None}
    failed |= {"status": "diverged", "fine_status": None}
    wide = machines.summary([good, bad, unknown, failed])[-2]
    assert wide["contacts"] == "kappa > 4"
    assert (wide["drawn"], wide["converged"], wide["restarts"]) == (4, 3, 4)
    assert (wide["checked"], wide["h_c_covered"], wide["h_min_covered"]) == (2, 1, 2)
    assert wide["median_ratio"] is None


@pytest.mark.long
def test_mutated_inputs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    # the function changes to this folder; normally it runs in a separate process
    monkeypatch.chdir(tmp_path)
    result = faults_inputs.run_chunk(5, 40, tmp_path, main)
    assert result["bad"] == []
    assert sum(result["counts"].values()) == 40


@pytest.mark.slow
def test_damaged_states(tmp_path: Path, monkeypatch):
    monkeypatch.setattr(faults, "REGIONS", 2)
    (tmp_path / "case.nml").write_text(faults.CASE)
    trials, counts, bad = faults.damage(tmp_path, np.random.default_rng(1))
    assert (trials, bad) == (4, [])
    assert counts["same bits"] + counts.get("reported", 0) >= 4


@pytest.mark.slow
def test_faults_campaign(tmp_path: Path, capsys):
    words = ["--kills", "4", "--inputs", "20"]
    assert faults.main([*words, "-o", str(tmp_path / "f")]) == 0
    rows = json.loads((tmp_path / "f" / "faults.json").read_text())["rows"]
    assert [row["wrong"] for row in rows] == [0] * 5
    assert faults.main([*words, "-o", str(tmp_path / "f")]) == 2


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


@pytest.mark.long
def test_predictions_at_a_boundary_film_agree_with_solutions(tmp_path: Path, capsys):
    """One contact that touches; its numbers are consistent, and its load shares agree."""
    (touching,) = [c for c in mixed.draw(4, 1, (65,)) if 0.7 < c.over < 0.9][:1]
    rows = mixed.compare(touching, simulate=False)
    assert [row["kind"] for row in rows] == ["smooth", "vanishing"]
    assert not [row["broken"] for row in rows if row["wrong"]]
    assert rows[1]["predicted_contact_load_share"] > 0.0
    assert 0.0 < rows[1]["difference"] <= rows[1]["allowed"]
    again = mixed.draw(2, 1, (65,))
    assert again == mixed.draw(4, 1, (65,))[:2]


def test_inconsistent_results_are_reported():
    good = {"mu": 0.06, "mu_smooth": 0.05, "mu_ratio": 1.2, "mu_note": "", "contact_load_share": 0}
    assert mixed.contradictions(good) == []
    assert mixed.contradictions(good | {"mu_ratio": 1.3}) == ["mu = mu_smooth mu_ratio"]
    lost = good | {"contact_load_share": None}
    assert "friction without a load share" in mixed.contradictions(lost)
    assert "no load share and no reason" in mixed.contradictions(lost)
    assert "load share" in mixed.contradictions(good | {"contact_load_share": 1.1})
    assert "not a number" in mixed.contradictions(good | {"mu_ratio": math.nan})


@pytest.mark.long
@pytest.mark.parametrize(
    ("inlets", "record"), [(False, "duty/random"), (True, "starvation/inlets")]
)
def test_random_duties(root: Path, tmp_path: Path, inlets, record):
    """The first contact of a seed, as its record has it."""
    words = ["--count", "1", "--seed", "2", "-o", str(tmp_path / "d.json")]
    assert duties.main([*words, *(["--inlets"] if inlets else [])]) == 0
    (row,) = json.loads((tmp_path / "d.json").read_text())["rows"]
    kept = json.loads((root / f"docs/evidence/{record}_2.json").read_text())
    first = kept["rows"][0]
    for name in ("shape", "kind", "values", "status"):
        assert row[name] == first[name]
    for name in ("H_c", "H_min") if inlets else ("steps_covered",):
        assert row[name] == pytest.approx(first[name], rel=1e-3)
    assert kept["summary"][-1]["drawn"] == len(kept["rows"]) == 40
