# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl sweep``: the table equals single runs; plans, outputs, the benchmark."""

import csv
import io
import time
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from journals import rows_in

import pyehl
from pyehl.cli import main
from pyehl.commands.sweep import report
from pyehl.errors import EhlError
from pyehl.studies import plan as plan_module
from pyehl.studies.plan import Remaining, plan, seconds_of
from pyehl.studies.study import make, parse_axis
from pyehl.studies.sweep import Outcome
from pyehl.studies.tasks import RUNNERS, Task, execute, why_none


def sweep(folder: Path, *words: str, expect: int = 0) -> tuple[str, str]:
    """Run the command in this process; returns both output streams."""
    reported, complaint = io.StringIO(), io.StringIO()
    with redirect_stdout(reported), redirect_stderr(complaint):
        status = main(["sweep", *words, "-o", str(folder)])
    assert status == expect, reported.getvalue() + complaint.getvalue()
    return reported.getvalue(), complaint.getvalue()


def table(folder: Path) -> list[dict[str, str]]:
    with (folder / "results.csv").open(newline="") as stream:
        return list(csv.DictReader(stream))


@pytest.fixture(scope="module")
def done(cases: Path, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, str]:
    """A finished study, and its output."""
    folder = tmp_path_factory.mktemp("sweep") / "new" / "study"
    words = ("--set", "grid.points=65", "--vary", "contact.moes_m=50:200:4log")
    words += ("--vary", "contact.moes_l=5,10")
    reported, _ = sweep(folder, str(cases / "quick.nml"), *words, "--jobs", "2")
    return folder, reported


def test_table_is_that_of_single_runs(done: tuple[Path, str], cases: Path):
    rows = table(done[0])
    assert [(float(r["contact.moes_m"]), float(r["contact.moes_l"])) for r in rows[:3]] == [
        (50.0, 5.0),
        (50.0, 10.0),
        (79.3700525984, 5.0),
    ]
    assert len(rows) == 8
    for row in (rows[0], rows[5]):
        options = [f"contact.{key}={row[f'contact.{key}']}" for key in ("moes_m", "moes_l")]
        with pyehl.Solver(cases / "quick.nml", "grid.points=65", *options) as solver:
            solver.run()
            alone = solver.summary
        for name in ("H_c", "H_c_error", "H_min", "F", "P_max"):
            assert float(row[name]) == alone[name]
        assert row["assessment"] == alone["assessment"] != ""
        assert row["status"] == alone["status"] == "converged"
        assert float(row["seconds"]) > 0.0


def test_netcdf_has_varied_keys_as_dimensions(done: tuple[Path, str]):
    with xr.open_dataset(done[0] / "results.nc") as data:
        assert data.H_c.dims == ("moes_m", "moes_l")
        assert data.H_c.shape == (4, 2)
        assert data.hertz_pressure_Pa.attrs["units"] == "Pa"
        rows = table(done[0])
        assert data.H_c.values.ravel() == pytest.approx([float(r["H_c"]) for r in rows], rel=0)
        chosen = data.sel(moes_m=50.0, moes_l=10.0)
        assert float(chosen.H_c) == float(rows[1]["H_c"])
        assert str(chosen.status.values) == "converged"


def test_plan_and_end_are_reported(done: tuple[Path, str]):
    reported = done[1]
    assert "8 cases (solve): 4 contact.moes_m x 2 contact.moes_l" in reported
    assert "by estimate, 2 worker processes of one thread each" in reported
    assert "8 in the table: 8 converged" in reported
    assert "8 ran now" in reported


def test_started_again_it_runs_nothing_twice(done: tuple[Path, str], cases: Path):
    before = rows_in(done[0])
    words = ("--set", "grid.points=65", "--vary", "contact.moes_m=50:200:4log")
    words += ("--vary", "contact.moes_l=5,10")
    again, _ = sweep(done[0], str(cases / "quick.nml"), *words)
    assert rows_in(done[0]) == before
    assert "8 of them are done" in again
    assert "ran now" not in again


def test_another_study_in_the_same_folder_is_refused(done: tuple[Path, str], cases: Path):
    before = rows_in(done[0])
    words = ("--set", "grid.points=129", "--vary", "contact.moes_m=50:200:4log")
    _, refused = sweep(done[0], str(cases / "quick.nml"), *words, expect=2)
    assert "set: there ['grid.points=65'], here ['grid.points=129']" in refused
    assert "vary.contact.moes_l: there [5, 10], here nothing" in refused
    assert rows_in(done[0]) == before


@pytest.mark.parametrize(
    ("words", "states"),
    [
        (["--vary", "contact.moes_m=100,200,-5"], "case 3 of 3 (contact.moes_m=-5)"),
        (["--vary", "contact.moes_n=100,200"], "did you mean"),
        (["--vary", "grid.points=65,66"], "case 2 of 2 (grid.points=66)"),
        (["--vary", "solver.max_cycles=5", "--run", "predict"], "needs a rough surface"),
        (["--vary", "contact.moes_m=1:2", "--jobs", "-1"], "--jobs -1"),
        (["--vary", "contact.moes_m=1:2", "--outputs", "H_c,h_cm"], "--outputs: unknown result"),
        (["--vary", "contact.moes_m=1:2", "--outputs", "h_cm"], "did you mean 'h_c_m'"),
        (["--vary", "contact.moes_m=1:2", "--outputs", "xyzzy"], "run = 'solve': kind, "),
        (["--vary", "contact.moes_m=1:2", "--outputs", "mu_ratio_tracks"], "run = 'solve'"),
        (["--vary", "contact.moes_m=1:9:1000000001"], "there can be 1 to 1000000"),
        (["--vary", "contact.moes_m=1:9:1001", "--vary", "contact.moes_l=1:9:1000"], "can have"),
    ],
)
def test_one_bad_case_prevents_the_study(
    cases: Path, tmp_path: Path, words: list[str], states: str
):
    _, refused = sweep(tmp_path / "out", str(cases / "quick.nml"), *words, expect=2)
    assert states in refused
    assert not (tmp_path / "out").exists()


def test_from_python(cases: Path, tmp_path: Path):
    data = pyehl.sweep(
        cases / "table1.nml",
        {"contact.mean_velocity": np.geomspace(0.1, 1.0, 3), "contact.load": [300.0, 600.0]},
        run="film",
        jobs=1,
        output=tmp_path / "out",
    )
    assert data.h_c_m.dims == ("mean_velocity", "load")
    assert (data["load"].attrs["units"], data["load"].attrs["key"]) == ("N", "contact.load")
    assert data["load"].attrs["long_name"]
    assert data.h_c_m.attrs["units"] == "m"
    assert (np.diff(data.h_c_m.values, axis=0) > 0.0).all()
    with xr.open_dataset(tmp_path / "out" / "results.nc") as kept:
        assert (kept.h_c_m.values == data.h_c_m.values).all()
    together = pyehl.sweep(
        cases / "table1.nml",
        {"contact.mean_velocity": [0.1, 1.0], "contact.load": [300.0, 600.0]},
        run="film",
        jobs=1,
        zipped=True,
        outputs=["h_c_m"],
    )
    assert together.h_c_m.dims == ("mean_velocity",)
    assert list(together["load"].values) == [300.0, 600.0]
    assert set(together.data_vars) == {"h_c_m", "status", "seconds", "message"}
    assert float(together.h_c_m[0]) == float(data.h_c_m[0, 0])


def test_study_file_and_result_folders(cases: Path, tmp_path: Path):
    (tmp_path / "study.toml").write_text(
        f'case = "{cases}/quick.nml"\noutputs = ["H_c"]\n'
        "set = {grid.points = 33}\nvary = {contact.moes_m = [50.0, 60.0]}\n"
    )
    sweep(tmp_path / "out", str(tmp_path / "study.toml"), "--keep", "--jobs", "1")
    assert list(table(tmp_path / "out")[0]) == [
        "contact.moes_m",
        "H_c",
        "status",
        "seconds",
        "message",
    ]
    wrong = (tmp_path / "study.toml").read_text().replace('["H_c"]', '["H_cc"]')
    (tmp_path / "wrong.toml").write_text(wrong)
    _, refused = sweep(tmp_path / "no", str(tmp_path / "wrong.toml"), expect=2)
    assert "wrong.toml: error: outputs: unknown result 'H_cc'" in refused
    assert "did you mean 'H_c'" in refused
    kept = pyehl.load(tmp_path / "out" / "cases" / "2")
    assert float(kept.moes_m) == 60.0
    assert float(kept.H_c) == float(table(tmp_path / "out")[1]["H_c"])


def test_estimates_grow_with_the_work():
    def estimate(*options: str) -> float:
        return seconds_of(pyehl.Case.from_text("", options).resolve(), "solve")

    smooth = estimate("grid.points=257")
    # measured: 2.4 times
    assert estimate("grid.points=513") > 2.0 * smooth
    wave = estimate("grid.points=257", "surface.kind=harmonic")
    assert wave > 10.0 * smooth
    assert estimate("grid.points=257", "surface.kind=fractal") > wave


def test_estimates_of_predictions_know_what_is_shared(cases: Path):
    """The smooth contact counts once for all cases that share it; tracks take longer."""
    axes = [parse_axis("surface.seed=1:2"), parse_axis("contact.load=500,600")]
    brief = plan(make(str(cases / "table1.nml"), axes, run="predict"))
    first, second, third, fourth = (task.seconds for task in brief.tasks)
    assert first == second > third == fourth
    full = plan(make(str(cases / "table1.nml"), axes, run="predict", outputs=["mu_ratio_tracks"]))
    assert full.tasks[3].full
    assert not brief.tasks[3].full


def test_predictions_share_smooth_contacts(cases: Path):
    axes = [parse_axis("surface.seed=1:3"), parse_axis("contact.load=500,600")]
    todo = plan(make(str(cases / "table1.nml"), axes, run="predict"))
    assert len(todo.tasks) == 6
    assert len({task.shares for task in todo.tasks}) == 2


def test_a_message_for_each_case_without_a_result(cases: Path, tmp_path: Path):
    """Also if they did not converge; in Python the dataset has their status."""
    words = ("--set", "grid.points=65", "--vary", "solver.max_cycles=1,30,2")
    reported, complaint = sweep(tmp_path / "out", str(cases / "quick.nml"), *words, expect=1)
    assert "1 converged, 2 cycle limit" in reported
    first, last = complaint.splitlines()
    assert first.startswith("case 1 of 3 (solver.max_cycles=1): cycle limit: the residual of ")
    assert last.startswith("case 3 of 3 (solver.max_cycles=2): cycle limit: the residual of ")
    assert "give a finer grid (grid.points = 129)" in first
    # nothing remains to be done, and the status is the same
    assert sweep(tmp_path / "out", str(cases / "quick.nml"), *words, expect=1)[1] == complaint
    data = pyehl.sweep(
        cases / "quick.nml", {"solver.max_cycles": [1, 30]}, "grid.points=65", jobs=1
    )
    assert data.status.values.tolist() == ["cycle limit", "converged"]


def test_message_of_a_failed_case(monkeypatch: pytest.MonkeyPatch):
    """Without the class name of its error, and without a traceback."""

    def fail(_: Task) -> None:
        raise EhlError("there is no solution")

    monkeypatch.setitem(RUNNERS, "solve", fail)
    row = execute(Task(0, "", "solve"))
    assert why_none(row) == "failed: there is no solution"
    assert "traceback" not in row


@pytest.mark.long
def test_a_failed_case_has_a_message(cases: Path, tmp_path: Path):
    """Without the class name of its error."""
    words = ("--run", "predict", "--vary", "contact.mean_velocity=0.002")
    _, complaint = sweep(tmp_path / "out", str(cases / "table1.nml"), *words, expect=1)
    assert "failed: the smooth contact under the prediction did not converge" in complaint


def test_film_breakdown_counts_as_a_result(cases: Path, tmp_path: Path):
    """As on a curve: the study is finished, and the table states which case has no ratio."""
    words = ("--run", "predict", "--set", "surface.pixels=64", "--vary")
    words += ("surface.rms_height=5e-8,8e-7", "--jobs", "1")
    reported, complaint = sweep(tmp_path / "out", str(cases / "table1.nml"), *words)
    assert "1 film breakdown, 1 predicted" in reported
    assert complaint == ""


def test_estimates_of_predictions(cases: Path):
    """Against processor seconds measured on an x86 of 2020, each within a factor of 2.5."""
    thins = {"lubricant.shear_law": "eyring"}
    boundary = thins | {"lubricant.boundary_film": 4e-8, "lubricant.boundary_friction": 0.1}
    rough = {"surface.kind": "fractal"}
    for case, options, measured in (
        ("table1.nml", {}, 0.26),
        ("table1.nml", {"contact.mean_velocity": 0.2}, 0.48),
        ("table1.nml", {"contact.mean_velocity": 0.05}, 1.34),
        ("table1.nml", {"surface.pixels": 512}, 0.48),
        ("table1.nml", thins, 0.64),
        ("table1.nml", boundary, 0.90),
        ("table1.nml", {"second_surface.kind": "fractal", "second_surface.seed": 2}, 1.27),
        ("ball_bearing.nml", rough, 7.8),
    ):
        settings = pyehl.Case(cases / case, options).resolve()
        ratio = seconds_of(settings, "predict") / measured
        assert 0.4 < ratio < 2.5, (case, options, ratio)


def test_the_time_left_follows_from_what_the_first_cases_took():
    """For each kind of task: on a machine that is ten times as slow, and for film sheets."""
    tasks = [Task(n, "", "solve" if n < 8 else "film", seconds=1.0) for n in range(10)]
    left = Remaining(tasks, 2)
    assert (left.count, left.total, left.seconds) == (10, 10.0, 5.0)
    left.remove([(0, {"seconds": 10.0}), (1, {"seconds": 10.0}), (2, {"seconds": None})])
    # five cases of 10 s, and two without any other data
    assert left.seconds == pytest.approx(70.0 / 2.0)
    left.remove([(8, {"seconds": 0.5})])
    assert left.seconds == pytest.approx((5 * 10.0 + 0.5) / 2.0)
    left.remove([(n, {"seconds": 10.0}) for n in (3, 4, 5, 6, 7)] + [(9, {"seconds": 0.5})])
    assert (left.count, left.estimate, left.seconds) == (0, 0.0, 0.0)


@pytest.mark.long
def test_a_plan_of_a_million_cases(cases: Path, tmp_path: Path):
    """It checks some, among them both ends of the varied values, and states so."""
    words = [str(cases / "table1.nml"), "--run", "film", "--plan", "--vary"]
    words += ["contact.load=100:600:1000", "--vary"]
    began = time.monotonic()
    reported, _ = sweep(tmp_path / "out", *words, "contact.mean_velocity=0.1:1:1000")
    assert time.monotonic() - began < 60.0
    assert "1000000 cases (film)" in reported
    assert "of them, spread over the values of each key; a run checks all before" in reported
    _, refused = sweep(tmp_path / "out", *words, "contact.mean_velocity=1:-1:1000", expect=2)
    assert "case 1000 of 1000000 (contact.load=100.0, contact.mean_velocity=-1.0)" in refused


def test_a_sample_has_all_values_and_the_ends(cases: Path):
    axes = [parse_axis("contact.load=1:30"), parse_axis("contact.radius=1:9:900")]
    study = make(str(cases / "quick.nml"), [*axes, parse_axis("surface.seed=1:7")])
    points = [study.point(number) for number in study.spread(500)]
    assert 500 <= len(points) <= 508
    assert len({p.number for p in points}) == len(points)
    ends = {(i, j, k) for i in (0, 29) for j in (0, 899) for k in (0, 6)}
    assert {p.index for p in points[:8]} == ends
    for axis, count in enumerate((30, 500, 7)):
        assert len({p.index[axis] for p in points}) >= count
    assert list(study.points())[123] == study.point(123)


def test_more_cases_than_fit_into_memory_are_refused(
    cases: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setattr(plan_module.library, "free_bytes", lambda: 3 * plan_module.CASE_BYTES - 1)
    words = [str(cases / "quick.nml"), "--run", "film", "--vary", "surface.seed=1:3"]
    _, refused = sweep(tmp_path / "out", *words, expect=2)
    assert "3 waiting cases take " in refused
    assert not (tmp_path / "out").exists()


def test_failed_cases_name_the_retry_option(tmp_path: Path):
    outcome = Outcome({0: {"status": "failed"}, 1: {"status": "converged"}})
    assert "failed     1: the same command with --retry runs them again" in report(
        outcome, tmp_path, 1
    )
    assert "--retry" not in report(Outcome({0: {"status": "converged"}}), tmp_path, 1)
