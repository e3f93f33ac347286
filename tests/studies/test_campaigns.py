# SPDX-License-Identifier: BSD-3-Clause
"""The campaigns of `benchmarks/` with a few random cases: what they draw, detect and count."""

import json
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import catalogue
import duties
import faults
import faults_inputs
import machines
import mixed
import numpy as np
import pytest
import stress
import stress_cases
import stress_checks
from journals import rows_in
from matplotlib.image import imread

import pyehl
from pyehl.cli import main
from pyehl.studies.journal import NAME


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
    assert stress_checks.broken(tmp_path / "c").startswith("boundary film")


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
    covered = row | {"H_c_fine": 1.01, "H_min_fine": 0.51}
    missed = row | {"H_c_fine": 1.03, "H_min_fine": 0.51}
    unknown = row | {"H_c_fine": None, "H_min_fine": None, "fine_status": "diverged"}
    failed = row | {"H_c": None, "H_min": None, "H_c_fine": None, "H_min_fine": None}
    failed |= {"status": "diverged", "fine_status": None}
    wide = machines.summary([covered, missed, unknown, failed])[-2]
    assert wide["contacts"] == "kappa > 4"
    assert (wide["drawn"], wide["converged"], wide["restarts"]) == (4, 3, 4)
    assert (wide["checked"], wide["h_c_covered"], wide["h_min_covered"]) == (2, 1, 2)
    assert wide["median_ratio"] is None


def test_impossible_values_of_a_machine_are_counted(monkeypatch: pytest.MonkeyPatch):
    """A wrong machine gives exit status 1; one without faults gives 0."""
    assert catalogue.main(["--count", "1"]) == 0
    monkeypatch.setattr(catalogue, "faults", lambda keys, result: ["torque"])
    assert catalogue.main(["--count", "1"]) == 1


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
