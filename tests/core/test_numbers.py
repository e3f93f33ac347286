# SPDX-License-Identifier: BSD-3-Clause
"""One number has one value: by every driver, in every command, whenever it is read."""

import json
import subprocess
import sys
import threading
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pyehl
from pyehl import Case, Solver, cli, errors
from pyehl.assessment import assess
from pyehl.schema import summary_of as scalars_of
from pyehl.studies.tasks import Task, execute

ROUGH = (
    "&contact load = 119.0 mean_velocity = 0.832 /\n"
    "&grid points = 65 x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0 /\n"
    "&surface kind = 'fractal' pixels = 128 rms_height = 5e-9 length_x = 4e-4 length_y = 4e-4\n"
    "{} /\n"
)
LEFT_OUT = ROUGH.format("")
"""The grid omits waves: a pixel is 3 um, a mesh size 15 um."""
ON_GRID = ROUGH.format("shortest_wavelength = 4e-5")
WAVE = (
    "&contact moes_m = 100.0 moes_l = 5.0 /\n"
    "&grid points = {} x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0 /\n"
    "&surface kind = 'harmonic' amplitude_over_film = {} wavelength = 0.5 /\n"
)
COARSE_FAILS = WAVE.format(129, 0.8)
"""On 65 x 65 nodes the film becomes negative."""
PARTS = tuple(f"mu_ratio_error_{part}" for part in ("grid", "stop", "left_out", "domain"))


def summary_of(folder: Path) -> dict[str, Any]:
    return json.loads((folder / "summary.json").read_text())


def last_lines(text: str) -> list[str]:
    """The lines of results at the end of the output of a driver."""
    lines = text.splitlines()
    first = next(k for k, line in enumerate(lines) if line.startswith("H_c   "))
    return lines[first : next(k for k, line in enumerate(lines) if line.startswith("results:"))]


@pytest.fixture(scope="module", params=["left out", "on the grid"])
def everywhere(request, tmp_path_factory, drivers) -> tuple[dict[str, dict[str, Any]], bool]:
    """The numbers of one case by all ways to get them."""
    text = {"left out": LEFT_OUT, "on the grid": ON_GRID}[request.param]
    folder = tmp_path_factory.mktemp("numbers")
    case = Case.from_text(text)
    result = {}
    with Solver(case) as solver:
        solver.run()
        result["Solver"] = solver.summary
        solver.write(folder / "written")
    result["Solver.write"] = summary_of(folder / "written")
    result["solve"] = scalars_of(pyehl.solve(case))
    result["sweep"] = execute(Task(0, case.text, "solve"))
    result["sweep with folders"] = execute(Task(0, case.text, "solve", str(folder / "of a sweep")))
    (folder / "case.nml").write_text(text)
    assert cli.main(["run", str(folder / "case.nml"), "-o", str(folder / "run"), "-q"]) == 0
    result["run"] = summary_of(folder / "run")
    return result, request.param == "left out"


def test_the_error_is_one_number(everywhere):
    result, left_out = everywhere
    first = result["run"]
    assert (first["variance_left_out"] > 0.0) == left_out
    assert (first["mu_ratio_error_left_out"] > 0.0) == left_out
    assert first["mu_ratio_error"] == sum(first[part] for part in PARTS)
    if left_out:
        # the omitted waves count here
        assert first["mu_ratio_error_left_out"] > 0.1 * first["mu_ratio_error"]
    for way, values in result.items():
        for name in ("mu_ratio", "mu_ratio_error", "mu_ratio_unresolved", *PARTS):
            assert values[name] == first[name], (way, name)
        assert values["mu_ratio_error_note"] == "", way


def test_last_lines(drive, tmp_path: Path):
    """Where pyehl predicts a part of the error, ehl states that it is not known."""
    for name, text in (("left out", LEFT_OUT), ("on the grid", ON_GRID)):
        (tmp_path / "case.nml").write_text(text)
        values = {}
        for driver in ("ehl", "pyehl"):
            done = drive(driver, "case.nml", "-o", f"{driver} {name}")
            assert (done.returncode, done.stderr) == (0, "")
            values[driver] = summary_of(tmp_path / f"{driver} {name}")
        v, lines = values["pyehl"], last_lines(done.stdout)
        assert 3 <= len(lines) <= 8
        assert lines[-1] == f"assessment {v['assessment']}"
        nm = 1e9 * v["film_scale_m"]
        assert f"h_c {v['h_c_m'] * 1e9:.0f} +- {v['H_c_error'] * nm:.0f} nm" in lines[0]
        assert f"rough {v['h_min_rough_m'] * 1e9:.2f} nm" in lines[1]
        assert f"rough {v['p_max_rough_Pa'] * 1e-9:.4f} GPa" in lines[2]
        decimals = 1 - int(np.floor(np.log10(v["mu_ratio_error"])))
        ratio = f"mu_r/mu_s  {v['mu_ratio']:.{decimals}f} +- {v['mu_ratio_error']:.{decimals}f}"
        assert lines[4] == f"{ratio} (grid)"
        if name == "on the grid":
            # these waves add next to nothing, but only a prediction can state that
            assert assess(values["ehl"]).text.startswith(
                "unresolved waves: they hold 5.2 % of the "
            )
            assert lines[-1].startswith("assessment full film: the minimum film over ")
            assert values["ehl"]["mu_ratio_error"] == v["mu_ratio_error"]
        else:
            assert values["ehl"]["mu_ratio_error"] is None
            assert values["ehl"]["mu_ratio_error_left_out"] is None


@pytest.mark.parametrize(
    ("text", "options", "why"),
    [
        (ON_GRID, ["time.estimate_error=.false."], "time.estimate_error is false"),
        (WAVE.format(65, 0.2), ["time.steps=160"], "because of time.steps"),
        (COARSE_FAILS, [], "coarser grid ended with the status 'negative film'"),
        (LEFT_OUT, ["surface.velocity_ratio=0"], "not predicted (only for moving surfaces)"),
    ],
    ids=["no coarser run", "time.steps", "coarser run fails", "at rest"],
)
def test_an_unknown_error_is_null_with_a_reason(
    drive, tmp_path: Path, text: str, options: list[str], why: str
):
    (tmp_path / "case.nml").write_text(text)
    words = [word for option in options for word in ("--set", option)]
    for driver in ("ehl", "pyehl"):
        done = drive(driver, "case.nml", "-o", driver, *words)
        assert (done.returncode, done.stderr) == (0, "")
        values = summary_of(tmp_path / driver)
        assert values["mu_ratio"] > 1.0
        assert values["mu_ratio_error"] is None
    assert why in values["mu_ratio_error_note"]
    assert any(line.startswith("mu_r/mu_s") and why in line for line in last_lines(done.stdout))


def test_a_prediction_that_fails_makes_no_error_smaller(monkeypatch, tmp_path: Path):
    def fails(*_: object) -> None:
        raise errors.EhlError("film breakdown: no full film")

    monkeypatch.setattr("pyehl.simulation.resolution.resolution", fails)
    with Solver(Case.from_text(LEFT_OUT)) as solver:
        assert "predicted   no mu_r/mu_s: film breakdown: no full film" in solver.describe(
            predict=True
        )
        solver.run()
        solver.write(tmp_path / "out")
        for values in (solver.summary, summary_of(tmp_path / "out")):
            assert values["mu_ratio_error_grid"] > 0.0
            assert values["mu_ratio_error"] is values["mu_ratio_error_left_out"] is None
            note = "the contribution of the omitted waves is not predicted (film breakdown)"
            assert note in values["mu_ratio_error_note"]
        assert "error not known" in solver.conclusion()
    # where nothing is omitted nothing is missing
    with Solver(Case.from_text(ON_GRID)) as solver:
        solver.run()
        assert solver.summary["mu_ratio_error"] > 0.0


def test_getters_of_a_solver_compute_nothing(monkeypatch):
    """The contribution of omitted waves is predicted at the end of a run, not when it is read."""
    with Solver(Case.from_text(LEFT_OUT)) as solver:
        solver.run()
        for name in ("simulation.resolution.resolution", "handle.SolverHandle.advance"):
            monkeypatch.setattr(f"pyehl.{name}", lambda *_: pytest.fail("computed"))
        assert solver.summary["mu_ratio_error_left_out"] > 0.0
        assert solver.summary == solver.summary
        assert solver.progress
        assert solver.work.done > 0.0
        assert solver.shape == solver.field("H").shape
        assert "grid" in solver.describe()
        assert solver._repr_html_().startswith("<table>")


def test_a_solver_loads_no_prediction():
    """It is loaded when a run needs it; the plan of a rough contact does not."""
    code = (
        "import sys, pyehl\n"
        "rough = '&surface kind = \\'fractal\\' /'\n"
        "with pyehl.Solver(pyehl.Case.from_text(rough, 'grid.points=33')) as solver:\n"
        "    assert 'grid' in solver.describe()\n"
        "smooth = pyehl.Case.from_text('&contact moes_m = 100.0 moes_l = 5.0 /')\n"
        "with pyehl.Solver(smooth, 'grid.points=65') as solver:\n"
        "    solver.run()\n"
        "    assert solver.converged\n"
        "print([name for name in sys.modules if name.startswith('pyehl.prediction.')])"
    )
    done = subprocess.run(
        [sys.executable, "-P", "-c", code], capture_output=True, text=True, check=False
    )
    assert (done.stdout.strip(), done.returncode) == ("[]", 0), done.stderr


def test_no_prediction_without_omitted_waves(monkeypatch):
    """Nor before there is a ratio with an error; a prediction takes a second solution."""

    def never(*_: object) -> None:
        raise AssertionError

    monkeypatch.setattr("pyehl.simulation.resolution.solve_contact", never)
    with Solver(Case.from_text(LEFT_OUT)) as solver:
        while not solver.advance() and "steps" not in solver.summary:
            pass
        assert solver.summary["mu_ratio"] is None
        assert "Solver(" in repr(solver)
        assert "predicted" not in solver.describe()
    for text in (WAVE.format(33, 0.1), ROUGH.format("shortest_wavelength = 1.3e-4")):
        with Solver(Case.from_text(text)) as solver:
            assert "predicted" not in solver.describe(predict=True)
            solver.run()
            assert solver.summary["mu_ratio"] > 1.0


def test_error_in_the_coarser_run_does_not_end_the_run(tmp_path: Path):
    """Its state exists when the run is resumed, and is removed when the coarser run begins."""
    case = Case.from_text(ON_GRID, ["output.checkpoint_interval=1000.0"])
    with Solver(case) as solver:
        solver.checkpoint(tmp_path / "out")
        while not solver.work.done > 1.0:
            solver.advance()
        assert "next coarser grid" in solver.progress
        assert solver.save_state(at_once=True)
    with Solver(case) as solver:
        assert "resuming after step" in solver.resume(tmp_path / "out")
        for path in (tmp_path / "out.checkpoint").glob("*coarse*"):
            path.unlink()
        assert solver.run()
        values = solver.summary
    assert values["mu_ratio"] > 1.0
    assert values["mu_ratio_error"] is values["mu_ratio_error_grid"] is None
    assert "coarser grid ended with the status 'failed' (" in values["mu_ratio_error_note"]


def test_a_given_number_of_steps_does_not_imply_convergence():
    """With exactly the steps that it takes to settle the run is converged, with fewer it is not."""
    case = Case.from_text(WAVE.format(65, 0.2), ["time.estimate_error=.false."])
    settled = scalars_of(pyehl.solve(case))
    steps = settled["steps"]
    again = scalars_of(pyehl.solve(case, f"time.steps={steps}"))
    assert (again["status"], again["mu_ratio"]) == ("converged", settled["mu_ratio"])
    with pytest.raises(pyehl.NotConverged, match="not settled") as caught:
        pyehl.solve(case, f"time.steps={steps - 1}")
    before = scalars_of(caught.value.results)
    assert before["steps"] == steps - 1
    # it has a mean over a period, which is not yet a result
    assert before["last_mu_ratio_mean"] == pytest.approx(settled["mu_ratio"], rel=0.05)
    assert "mu_ratio" not in before


@pytest.mark.parametrize(
    "text", [LEFT_OUT, ON_GRID.replace("shortest", "velocity_ratio = 0 shortest")]
)
def test_no_ratio_is_none(text: str):
    """Before it is known, and after a failure: of the smooth contact, or of a step."""
    with Solver(Case.from_text(text)) as solver:
        assert solver.summary["mu_ratio"] is None
        solver.advance()
        assert solver.summary["mu_ratio_error"] is None
    with Solver(Case.from_text(text, ["solver.max_cycles=1", "solver.accuracy=1e-6"])) as solver:
        assert not solver.run()
        values = solver.summary
        assert values["mu_ratio"] is values["mu_ratio_error"] is values["H_c"] is None
        assert values["mu_ratio_error_note"] == "there is no mu_ratio"
        assert values["message"] in values["assessment"]
        assert "cycle 1; give a finer grid (grid.points = " in values["message"]
        assert solver.conclusion().endswith(values["assessment"])


def test_minimum_rough_film_is_that_of_the_time_of_the_mean():
    data = pyehl.solve(Case.from_text(ON_GRID))
    mean = data.history_T > float(data.history_T[-1]) - float(data.T_mean) - 1e-9
    minimum = float(data.history_H_min[mean].min())
    assert float(data.H_min_rough) == pytest.approx(minimum, rel=1e-12)
    assert float(data.H_min_rough) < float(data.H_min)
    scale = float(data.film_scale_m)
    assert float(data.h_min_rough_m) == pytest.approx(minimum * scale, rel=1e-12)
    assert float(data.h_min_m) == pytest.approx(float(data.H_min) * scale, rel=1e-12)


def test_film_and_lambda_mean_the_same_everywhere(tmp_path: Path):
    """Of the smooth contact, over the rms height of the undeformed surface: run, predict, curve."""
    case = Case.from_text(ON_GRID.replace("65", "257"), ["surface.rms_height=2e-8"])
    predicted = pyehl.predict(case, tracks=1).summary
    (tmp_path / "case.nml").write_text(case.text)
    words = ["--speed", "0.832", "-o", str(tmp_path / "curve"), "-q"]
    assert cli.main(["stribeck", str(tmp_path / "case.nml"), *words]) == 0
    curve = np.genfromtxt(
        tmp_path / "curve" / "stribeck.csv", delimiter=",", names=True, dtype=None, encoding="utf-8"
    )
    rest = case.with_options("surface.velocity_ratio=0", "time.estimate_error=.false.")
    solved = scalars_of(pyehl.solve(rest))
    sigma = predicted["rms_height_m"]
    assert solved["surface_rms_m"] == pytest.approx(sigma, rel=1e-9)
    for way, values in (("run", solved), ("predict", predicted)):
        assert values["lambda_ratio"] == pytest.approx(values["h_min_m"] / sigma, rel=1e-9), way
        central = values["lambda_ratio_central"]
        assert central == pytest.approx(values["h_c_m"] / sigma, rel=1e-9), way
        assert values["h_min_rough_m"] < values["h_min_m"], way
    for name in ("h_c_m", "h_min_m", "lambda_ratio", "lambda_ratio_central"):
        assert predicted[name] == pytest.approx(float(curve[name]), rel=1e-9)
    # the run gives the film of its grid, the others the extrapolated one
    assert abs(solved["h_min_m"] - predicted["h_min_m"]) <= 1.1 * (
        solved["H_min_error"] * solved["film_scale_m"]
    )


def test_no_error_where_grids_do_not_converge():
    """A pressure spike that grows with each grid: 1.164, 1.199 and 1.410 on finer ones."""
    ridge = {
        **{"contact.moes_m": 59.92, "contact.moes_l": 17.2, "grid.points": 129},
        **{"surface.kind": "ridge", "surface.width": 0.96, "surface.velocity_ratio": 0.9},
        "surface.amplitude_over_film": 0.123,
    }
    for values, known in (({}, False), ({"contact.moes_l": 2.0}, True)):
        with Solver(Case.from_text("", ridge | values)) as solver:
            assert solver.run()
            result = solver.summary
        assert (result["mu_ratio_error"] is not None) == known
        assert ("to be extrapolated" in result["mu_ratio_error_note"]) != known
        if known:
            # effect of the error of the film on the increase
            film = result["H_c_error_grid"] / result["H_c"]
            assert result["mu_ratio_error_grid"] >= 1.99 * film * abs(result["mu_ratio"] - 1.0)


@pytest.mark.long
def test_reads_during_steps_are_consistent():
    """No field, summary or line mixes two states; without locks one in four does."""
    text = WAVE.format(65, 0.2)
    options = ("time.steps=60", "time.estimate_error=.false.")
    states, times = set(), set()
    with Solver(Case.from_text(text, options)) as solver:
        while not solver.done:
            states.add(solver.field("P").tobytes())
            times.add(solver.summary.get("T"))
            solver.advance()
        states.add(solver.field("P").tobytes())
        times.add(solver.summary.get("T"))
    reads = 0
    while reads < 300:
        with Solver(Case.from_text(text, options)) as solver:
            thread = threading.Thread(target=solver.run)
            thread.start()
            while thread.is_alive():
                assert solver.field("P").tobytes() in states, f"field {reads} is no state"
                assert solver.summary.get("T") in times
                assert solver.progress
                assert solver.work.done >= 0.0
                reads += 1
            thread.join()
