# SPDX-License-Identifier: BSD-3-Clause
"""What people type in Python: solve, predict, Case, Solver, load."""

from __future__ import annotations

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

SMOOTH = (
    "&contact moes_m = 100.0 moes_l = 5.0 /\n"
    "&grid points = 33 x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0 /\n"
)
FRACTAL = (
    "&contact load = 20.0 /\n&grid points = 65 /\n&surface kind = 'fractal' pixels = 32 "
    "length_x = 1e-4 length_y = 1e-4 rms_height = 2e-8 /\n"
    "&time steps = 3 estimate_error = .false. /\n"
)


@pytest.fixture
def smooth(tmp_path: Path) -> Path:
    path = tmp_path / "smooth.nml"
    path.write_text(SMOOTH)
    return path


@pytest.fixture
def fractal(tmp_path: Path) -> Path:
    path = tmp_path / "fractal.nml"
    path.write_text(FRACTAL)
    return path


def same(one: xr.Dataset, other: xr.Dataset) -> None:
    """The same but for the times that the runs took."""
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
    assert inside.attrs["H_c"] == summary["H_c"]
    assert {p.name for p in tmp_path.iterdir()} == {"smooth.nml", "out"}


def test_solve_takes_a_case_and_options(smooth: Path):
    case = pyehl.Case.read(smooth, "grid.points=65")
    same(pyehl.solve(case), pyehl.solve(smooth, ["grid.points=65"]))
    assert pyehl.solve(case, "grid.points=129").P.shape == (129, 129)
    assert case.resolve()["grid"]["points"] == 65


def test_transient_results_are_the_same_in_memory(fractal: Path, tmp_path: Path):
    """A fractal surface needs no further call, and has the same fields and frames."""
    options = ("output.frame_interval=0.01", "time.skip_start=.false.")
    inside = pyehl.solve(fractal, *options, check=False)
    written = pyehl.solve(fractal, *options, output=tmp_path / "out", check=False)
    same(inside, written)
    assert {"RR", "A_d", "frame_P", "P_smooth"} <= set(inside.variables)
    assert float(np.abs(inside.RR).max()) > 0.0


def test_no_solution_raises_with_what_there_is(fractal: Path, tmp_path: Path):
    with pytest.raises(pyehl.NotConverged, match="no solution") as caught:
        pyehl.solve(fractal, output=tmp_path / "out")
    assert isinstance(caught.value, pyehl.EhlError)
    same(caught.value.results, pyehl.load(tmp_path / "out"))
    assert "H_c" in caught.value.results.attrs
    assert "mu_ratio" not in caught.value.results.attrs
    assert not pyehl.solve(fractal, check=False).attrs["converged"]


def test_map_needs_no_further_call(fractal: Path, tmp_path: Path):
    heights = pyehl.predict(fractal).surface.heights
    np.save(tmp_path / "map.npy", heights)
    words = ("surface.kind=map", f"surface.file={tmp_path / 'map.npy'}")
    by_map = pyehl.solve(fractal, *words, check=False)
    same_fields = pyehl.solve(fractal, check=False)
    assert np.array_equal(by_map.H.values, same_fields.H.values)


def test_progress_is_told(smooth: Path, capsys):
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
        summary = solver.summary()
    assert seen[0] == (0.0, 0.0, 0.0)
    running = [work for work in seen if work.done > 0]
    assert all(a.done < b.done for a, b in itertools.pairwise(running))
    assert all(work.done <= work.earliest <= work.latest for work in running)
    assert running[-1].done > summary["steps"]  # those on the coarser grid count
    # the first step knows the earliest end; a mean that settles at once ends there
    assert running[0].earliest == pytest.approx(running[-1].done, rel=0.03)
    pyehl.solve(case, "time.steps=40", "time.estimate_error=.false.", check=False, progress=True)
    shown = capsys.readouterr().err
    assert re.search(r"\d+%\|.*\| \d\d:\d\d left \| step \d+", shown)


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
            assert str(step) == step.text == solver.progress()
            if step.summary.get("steps") == 2:
                break
        assert numbers == list(range(1, len(numbers) + 1))
        assert not solver.done
        # the loop goes on where it was left
        assert next(iter(solver)).summary["steps"] == 3
        assert solver.field("P").shape == (65, 65)
        data = solver.dataset()
        assert data.attrs["steps"] == 3
        assert np.array_equal(data.P.values, solver.field("P"))
        assert len(repr(solver)) < 200
        assert "<table>" in solver._repr_html_()
    assert "closed" in repr(solver)


def test_predict(fractal: Path):
    options = ("grid.points=65", "surface.seed=3", "surface.rms_height=1e-9")
    p = pyehl.predict(fractal, *options)
    case = pyehl.Case.read(fractal, *options)
    assert p.mu_ratio == p.summary["mu_ratio"] == pyehl.predict(case).mu_ratio
    assert p.data.attrs["mu_ratio"] == p.mu_ratio
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
    case = pyehl.Case.read(fractal)
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
    (found,) = (t for t in doctest.DocTestFinder(recurse=False).find(thing, name, globs={}))
    assert found.examples, f"pyehl.{name} has no example"
    doctest.DebugRunner(optionflags=doctest.ELLIPSIS).run(found)
