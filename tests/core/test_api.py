# SPDX-License-Identifier: BSD-3-Clause
"""The Python interface: cases, subcommands as functions, results."""

import doctest
import itertools
import json
import re
import shutil
import subprocess
import sys
import threading
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import pyehl
from pyehl import cli
from pyehl.measured_response import measurement
from pyehl.results import unit_of
from pyehl.schema import summary_of


def same(one: xr.Dataset, other: xr.Dataset) -> None:
    """Whether two results are equal except for the times of the runs."""
    times = ("wall_seconds", "seconds_per_step")
    one, other = (data.drop_vars(times, errors="ignore") for data in (one, other))
    for data in (one, other):
        for name in times:
            data.attrs.pop(name, None)
    xr.testing.assert_identical(one, other)


def test_solve_is_load_of_the_folder(smooth: Path, tmp_path: Path):
    inside = pyehl.solve(smooth, "grid.points=65")
    written = pyehl.solve(smooth, "grid.points=65", output=tmp_path / "out")
    xr.testing.assert_identical(written, pyehl.load(tmp_path / "out"))
    same(inside, written)
    assert inside.P.shape == (65, 65)
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert float(inside.H_c) == summary["H_c"]
    assert {p.name for p in tmp_path.iterdir()} == {"smooth.nml", "out"}


def test_solve_takes_a_case_and_options(smooth: Path):
    case = pyehl.Case(smooth, "grid.points=65")
    same(pyehl.solve(case), pyehl.solve(smooth, ["grid.points=65"]))
    assert pyehl.solve(case, "grid.points=129").P.shape == (129, 129)
    assert case.resolve()["grid"]["points"] == 65


def test_transient_results_are_the_same_in_memory(fractal: Path, tmp_path: Path):
    """A fractal surface needs no further call, and gives the same fields and frames."""
    options = ("output.frame_interval=0.01", "time.skip_start=.false.")
    inside = pyehl.solve(fractal, *options, check=False)
    written = pyehl.solve(fractal, *options, output=tmp_path / "out", check=False)
    same(inside, written)
    assert {"RR", "A_d", "frame_P", "P_smooth"} <= set(inside.variables)
    assert float(np.abs(inside.RR).max()) > 0.0


def test_a_case_by_its_values():
    """Checked at once; options are dicts, nested or not, or texts, everywhere."""
    case = pyehl.Case(contact={"moes_m": 100.0, "moes_l": 5.0}, grid={"points": np.int64(33)})
    assert case == pyehl.Case.from_text(
        "&contact moes_m = 100.0 moes_l = 5.0 /\n&grid points = 33 /\n"
    )
    assert (
        pyehl.Case.from_text("&grid points = 33 /", {"contact": {"moes_m": 100.0, "moes_l": 5.0}})
        == case
    )
    values = {"grid.points": 65, "output.fields": False, "surface.kind": "fractal"}
    texts = ["grid.points=65", "output.fields=.false.", "surface.kind=fractal"]
    assert case.with_options(values) == case.with_options(*texts) == case.with_options(texts)
    nested = {"grid": {"points": 65.0}, "output": {"fields": False}, "surface.kind": "fractal"}
    assert case.with_options(nested) == case.with_options(values)
    assert case.with_options(values, "surface.seed=3").resolve()["surface"]["seed"] == 3
    with pytest.raises(pyehl.InputError, match=r"(?s)contact\.laod.*'load'"):
        pyehl.Case(contact={"laod": 3.0})
    dates = np.array(["2020-01-01", "2020-01-02"], dtype="datetime64[D]")
    for times in (["late", 1.0], [[0.0, 1.0], [2.0]], [None, 1.0], dates):
        with pytest.raises(pyehl.InputError, match=r"duty\.time.*numbers"):
            pyehl.Case.from_text("", {"duty.time": times})
    with pytest.raises(pyehl.InputError, match=r"(?s)duty\.load.*number"):
        pyehl.Case.from_text("", {"duty.load": np.ma.array([1.0, 2.0], mask=[0, 1])})


@pytest.mark.parametrize("values", [{"grid.points": 66}, {"gird.points": 65}])
def test_python_and_command_say_the_same(smooth: Path, values: dict[str, int], capsys):
    (text,) = (f"{key}={value}" for key, value in values.items())
    for call in (pyehl.solve, pyehl.predict, pyehl.film, pyehl.check):
        with pytest.raises(pyehl.InputError) as caught:
            call(smooth, values)
        words = {"solve": ["run"]}.get(call.__name__, [call.__name__])
        output = ["-o", "out"] if call in (pyehl.solve, pyehl.predict) else []
        assert cli.main([*words, str(smooth), *output, "--set", text]) == 2
        # each message in terms of the caller
        assert capsys.readouterr().err == f"--set {caught.value}\n"
        assert str(caught.value).startswith(text)


def test_scalars_have_units(fractal: Path, tmp_path: Path):
    """Numbers of the summary are variables after solve, load, predict and sweep, not attributes."""
    solved = pyehl.solve(fractal, output=tmp_path / "out", check=False)
    for data in (solved, pyehl.load(tmp_path / "out"), pyehl.predict(fractal).data):
        numbers = [name for name, result in data.variables.items() if result.dims == ()]
        assert len(numbers) > 30
        assert not data.attrs.keys() & data.variables.keys() - {"T"}
        numbers_left = {k for k, v in data.attrs.items() if not isinstance(v, str | bool)}
        assert numbers_left <= {"schema_version", "T"}
        for name in numbers:
            assert data[name].attrs["units"]
            assert data[name].attrs["long_name"]
        assert data.h_c_m.attrs["units"] == "m"
        assert data.hertz_pressure_Pa.attrs["units"] == "Pa"
        assert data.moes_m.attrs["units"] == "1"
        names = [str(name).lower() for name in data.variables]
        assert len(names) == len(set(names))
    names = ("duty_power_max_W", "rolling_moment_N_m", "rolling_moment_N", "angle_deg", "H_c")
    assert [unit_of(name) for name in names] == ["W", "N m", "N", "deg", "1"]
    # an unknown value is NaN, and no attribute
    assert np.isnan(float(solved.mu_ratio))
    assert "mu_ratio" not in summary_of(solved)
    assert {"status", "converged", "case"} <= set(solved.attrs) - set(solved.variables)
    swept = pyehl.sweep(fractal, {"surface.seed": [1]}, run="film", jobs=1)
    assert swept.h_c_m.attrs["units"] == swept.h_c_m_hamrock_dowson.attrs["units"] == "m"
    assert (swept.moes_m.attrs["units"], swept.seconds.attrs["units"]) == ("1", "s")


def test_predict_writes_as_the_command(fractal: Path, tmp_path: Path, capsys):
    p = pyehl.predict(fractal, tracks=3, output=tmp_path / "python", plots=False)
    words = [
        "predict",
        str(fractal),
        "--tracks",
        "3",
        "--no-plots",
        "-o",
        str(tmp_path / "command"),
    ]
    assert cli.main(words) == 0
    capsys.readouterr()
    one, other = (
        {path.name: path.read_bytes() for path in (tmp_path / name).iterdir()}
        for name in ("python", "command")
    )
    assert set(one) == set(other) >= {"passage.csv", "summary.json", "case.nml"}
    assert all(one[name] == other[name] for name in one if name.endswith((".npy", ".csv", ".nml")))
    assert p.track_count == 3
    same(p.data, pyehl.load(tmp_path / "python"))
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "notes.txt").write_text("mine")
    with pytest.raises(pyehl.InputError, match=r"notes\.txt"):
        pyehl.predict(fractal, output=tmp_path / "mine")


def test_subcommands_print_what_functions_return(fractal: Path, capsys):
    assert cli.main(["check", str(fractal), "--set", "grid.points=33"]) == 0
    assert capsys.readouterr().out == f"{pyehl.check(fractal, {'grid.points': 33})}\n"
    assert cli.main(["film", str(fractal), "--json"]) == 0
    assert json.loads(capsys.readouterr().out) == json.loads(
        json.dumps(pyehl.film(fractal).summary)
    )


def test_plot(fractal: Path, tmp_path: Path):
    p = pyehl.predict(fractal)
    figures = pyehl.plot(p.data, tmp_path / "new", format="svg")
    assert {path.name for path in (tmp_path / "new").iterdir()} == {f"{n}.svg" for n in figures}
    for words in ({"dpi": 1}, {"dpi": 1e3}, {"units": "m"}, {"format": "bmp"}):
        with pytest.raises(pyehl.InputError):
            pyehl.plot(p.data, **words)
    with pytest.raises(pyehl.InputError, match="expected a result"):
        pyehl.plot(xr.Dataset())


def test_stribeck_is_that_of_the_command(fractal: Path, tmp_path: Path, capsys):
    ds = pyehl.stribeck(
        fractal, {"contact.mean_velocity": [0.5, 1.0], "contact.load": 30.0}, surfaces=2, jobs=1
    )
    words = ["--speed", "0.5,1", "--load", "30", "--surfaces", "2", "--jobs", "1", "-q"]
    assert cli.main(["stribeck", str(fractal), *words, "-o", str(tmp_path / "out")]) == 0
    capsys.readouterr()
    with xr.open_dataset(tmp_path / "out" / "stribeck.nc", engine="scipy") as written:
        assert np.array_equal(written.mu_ratio.values, ds.mu_ratio.values)
    assert ds.mu_ratio.shape == (2, 1)
    assert ds.mu_ratio.dims == ("mean_velocity", "load")
    for vary in ({}, {"contact.radius": 0.01}, {"contact.mean_velocty": 0.5}):
        with pytest.raises(pyehl.InputError, match=r"at least one of contact\.mean_velocity, lub"):
            pyehl.stribeck(fractal, vary)


def test_response_is_read_as_it_was_written(tmp_path: Path, monkeypatch):
    tiny = (measurement.Tier("long", 2.0, 65, 2.0, 0.5),)
    for module in ("measured_response.measurement", "measured_response.folder"):
        monkeypatch.setattr(f"pyehl.{module}.TIERS", tiny)
    case = pyehl.Case(contact={"moes_m": 100.0, "moes_l": 5.0})
    seen = []
    ds = pyehl.response(case, output=tmp_path / "out", progress=lambda *now: seen.append(now))
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert int(ds.waves) == summary["waves"] == ds.sizes["wave"]
    assert ds.attrs["tiers"] == summary["tiers"]
    assert seen[-1][0] == "long"
    # made again without a run
    xr.testing.assert_identical(pyehl.response(case, output=tmp_path / "out"), ds)


def test_no_solution_raises_with_the_last_fields(fractal: Path, tmp_path: Path):
    with pytest.raises(pyehl.NotConverged, match="not converged") as caught:
        pyehl.solve(fractal, output=tmp_path / "out")
    assert isinstance(caught.value, pyehl.EhlError)
    same(caught.value.results, pyehl.load(tmp_path / "out"))
    assert "H_c" in summary_of(caught.value.results)
    assert "mu_ratio" not in summary_of(caught.value.results)
    assert not pyehl.solve(fractal, check=False).attrs["converged"]


def test_a_saved_tile_gives_the_same_bits(fractal: Path, tmp_path: Path):
    heights = pyehl.predict(fractal).surface.heights
    np.save(tmp_path / "map.npy", heights)
    words = ("surface.kind=map", f"surface.file={tmp_path / 'map.npy'}")
    by_map = pyehl.solve(fractal, *words, check=False)
    same_fields = pyehl.solve(fractal, check=False)
    assert np.array_equal(by_map.H.values, same_fields.H.values)


def test_progress_is_reported(smooth: Path, capsys):
    seen = []
    pyehl.solve(smooth, progress=lambda solver: seen.append(solver.done))
    assert seen[-1]
    assert not any(seen[:-1])
    pyehl.solve(smooth)
    printed = capsys.readouterr()
    assert printed.out + printed.err == ""
    pyehl.solve(smooth, progress=True)
    assert "H_c" in capsys.readouterr().err


def test_work_and_time_left(tmp_path: Path, capsys):
    """The earliest end is known from the first step on, and the time left in every line."""
    case = tmp_path / "wave.nml"
    case.write_text(
        "&contact load = 20.0 /\n&grid points = 65 /\n"
        "&surface kind = 'harmonic' amplitude_over_film = 0.2 wavelength = 0.8 /\n"
    )
    seen = []
    with pyehl.Solver(case) as solver:
        for step in solver:
            seen.append(step.work)
            if 0 < step.work.done < step.work.earliest:
                assert re.search(r", about \d+ s left$", step.text)
            elif step.work.done and not solver.done:
                assert re.search(r", at most \d+ s left$", step.text)
        summary = solver.summary
    assert seen[0] == (0.0, 0.0, 0.0)
    running = [work for work in seen if work.done > 0]
    assert all(a.done < b.done for a, b in itertools.pairwise(running))
    assert all(work.done <= work.earliest <= work.latest for work in running)
    assert running[-1].done > summary["steps"]  # steps on the coarser grid count
    # the earliest end is known after the first step; a mean that settles at once is reached there
    assert running[0].earliest == pytest.approx(running[-1].done, rel=0.03)
    pyehl.solve(case, "time.steps=40", "time.estimate_error=.false.", check=False, progress=True)
    shown = capsys.readouterr().err
    assert re.search(r"\d+%\|.*\| (about|at most) \d+ s left \| step \d+", shown)


def test_solve_in_a_thread_writes_too(smooth: Path, tmp_path: Path):
    thread = threading.Thread(target=pyehl.solve, args=(smooth,), kwargs={"output": tmp_path / "o"})
    thread.start()
    thread.join()
    assert pyehl.load(tmp_path / "o").attrs["status"] == "converged"


def test_solver_is_an_iterator(fractal: Path):
    with pyehl.Solver(fractal, "time.steps=100") as solver:
        numbers = []
        for step in solver:
            numbers.append(step.number)
            assert str(step) == step.text == solver.progress
            if step.summary.get("steps") == 2:
                break
        assert numbers == list(range(1, len(numbers) + 1))
        assert not solver.done
        # the loop continues where it was left
        assert next(iter(solver)).summary["steps"] == 3
        assert solver.field("P").shape == (65, 65)
        data = solver.dataset()
        assert float(data.steps) == 3
        assert np.array_equal(data.P.values, solver.field("P"))
        assert len(repr(solver)) < 200
        assert "<table>" in solver._repr_html_()
    assert "closed" in repr(solver)


def test_solver_shows_what_a_user_needs():
    methods = """advance axes checkpoint clear_checkpoint close conclusion dataset describe field
    interrupt resume resumption run save_state write"""
    getters = "converged done progress shape summary work"
    assert {name for name in dir(pyehl.Solver) if name[0] != "_"} == {
        *methods.split(),
        *getters.split(),
    }


def test_predict(fractal: Path):
    options = ("grid.points=65", "surface.seed=3", "surface.rms_height=1e-9")
    p = pyehl.predict(fractal, *options)
    case = pyehl.Case(fractal, *options)
    assert p.mu_ratio == p.summary["mu_ratio"] == pyehl.predict(case).mu_ratio
    assert float(p.data.mu_ratio) == p.mu_ratio
    assert p.data.attrs["case"] == case.text
    ax = p.plot()
    assert p.plot(ax) is ax
    assert len(repr(p)) < 100
    assert "<table>" in p._repr_html_()
    with pytest.raises(pyehl.InputError, match=r"surface\.kind"):
        pyehl.predict(fractal, "surface.kind=smooth")
    with pytest.raises(pyehl.EhlError, match=r"none\.npy"):
        pyehl.predict(fractal, "surface.kind=map", "surface.file=none.npy")


def test_case_is_shown_in_short(fractal: Path):
    case = pyehl.Case(fractal)
    assert len(repr(case)) < 100
    assert "fractal" in repr(case)
    assert "surface.rms_height" in case._repr_html_()


def test_names_are_listed_and_cheap():
    assert set(pyehl.__all__) <= set(dir(pyehl))
    assert {name for name in dir(pyehl) if not name.startswith("_")} == set(pyehl.__all__)
    code = (
        "import sys, pyehl; dir(pyehl); print('numpy' in sys.modules, 'pyehl._core' in sys.modules)"
    )
    done = subprocess.run(
        [sys.executable, "-P", "-c", code], capture_output=True, text=True, check=True
    )
    assert done.stdout.split() == ["False", "False"]


@pytest.mark.parametrize("name", pyehl.__all__)
def test_examples_in_docstrings(name: str, root: Path, tmp_path: Path, monkeypatch):
    shutil.copytree(root / "cases", tmp_path / "cases")
    monkeypatch.chdir(tmp_path)
    thing = getattr(pyehl, name)
    (result,) = (t for t in doctest.DocTestFinder(recurse=False).find(thing, name, globs={}))
    assert result.examples, f"pyehl.{name} has no example"
    doctest.DebugRunner(optionflags=doctest.ELLIPSIS).run(result)


def test_a_case_that_cannot_be_planned_is_named(tmp_path: Path, capsys, drive):
    """By check and both drivers, with the keys."""
    (tmp_path / "case.nml").write_text("&contact moes_m = 100.0 /\n&surface kind = 'fractal' /\n")
    stated = [drive(driver, "case.nml", "-o", "out").stderr for driver in ("ehl", "pyehl")]
    assert cli.main(["check", str(tmp_path / "case.nml")]) == 2
    stated.append(capsys.readouterr().err.removeprefix(f"{tmp_path}/"))
    assert len(set(stated)) == 1
    assert stated[0].startswith("case.nml: surface.kind = 'fractal': ")
    assert "expected: contact.load" in stated[0]


def test_plot_takes_predictions_and_refuses_other_objects():
    case = pyehl.Case.from_text("", {"surface.kind": "harmonic", "surface.wavelength": 0.5})
    result = pyehl.predict(case, tracks=1)
    assert set(pyehl.plot(result)) == set(pyehl.plot(result.data))
    swept = pyehl.sweep(case, {"contact.moes_m": [100.0, 200.0]}, run="film", jobs=1)
    for other in (pyehl.film(case), swept, None):
        with pytest.raises(pyehl.InputError, match="expected a result of solve, predict or load"):
            pyehl.plot(other)


@pytest.mark.parametrize(
    ("command", "stopped", "message"),
    [
        ("predict", "pyehl.commands.predict.predict", "no result is written"),
        ("stribeck", "pyehl.commands.stribeck.plan_curve", "no result is written"),
        ("stribeck", "pyehl.commands.stribeck.perform", "what is finished is kept; the same com"),
    ],
)
def test_an_interrupt_reports_what_is_kept(
    cases: Path, tmp_path: Path, capsys, monkeypatch, command: str, stopped: str, message: str
):
    def interrupted(*args, **words):
        raise KeyboardInterrupt

    monkeypatch.setattr(stopped, interrupted)
    words = [command, str(cases / "table1.nml"), "-o", str(tmp_path / "out")]
    words += ["--speed", "0.3", "--quiet"] if command == "stribeck" else []
    assert cli.main(words) == 130
    assert f"interrupted; {message}" in capsys.readouterr().err
