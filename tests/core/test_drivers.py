# SPDX-License-Identifier: BSD-3-Clause
"""Both drivers: the same bits, the same files, complete folders, clean interrupts."""

import json
import os
import signal
import subprocess
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

import pyehl
from pyehl import cli, results
from pyehl.netcdf import export

SMALL = "&contact moes_m = 100.0 moes_l = 5.0 /\n&grid points = 65 /\n"
SMALL_SI = "&contact load = 20.0 /\n&grid points = 65 /\n"
FILES = {"case.nml", "summary.json", "history.csv", "X.npy", "Y.npy", "P.npy", "H.npy"}
SUMMARY = {
    "status",
    "H_c",
    "H_min",
    "P_max",
    "F",
    "H_c_extrapolated",
    "H_c_error",
    "H_min_extrapolated",
    "H_min_error",
    "load_error",
    "cycles",
    "residual",
    "wall_seconds",
}


def without_time(folder: Path) -> dict[str, Any]:
    """All files of a folder, without times and meanings of keys."""
    files: dict[str, Any] = {path.name: path.read_bytes() for path in folder.iterdir()}
    files["summary.json"] = json.loads(files["summary.json"])
    assert files["summary.json"].pop("wall_seconds") > 0.0
    files["case.nml"] = pyehl.Case(folder / "case.nml").text.encode()
    return files


@pytest.mark.parametrize("text", [SMALL, SMALL_SI], ids=["moes", "si"])
@pytest.mark.parametrize("options", [[], ["--set", "solver.deflection=fft"]], ids=["mlmi", "fft"])
def test_both_drivers_give_the_same_bits(drive, tmp_path: Path, text: str, options: list[str]):
    (tmp_path / "case.nml").write_text(text)
    for driver in ("ehl", "pyehl"):
        done = drive(driver, "case.nml", "-o", f"deep/{driver}", *options)
        assert (done.returncode, done.stderr) == (0, "")
    fortran = without_time(tmp_path / "deep" / "ehl")
    python = without_time(tmp_path / "deep" / "pyehl")
    assert set(fortran) == FILES
    assert set(python) == {*FILES, "plan.txt"}
    summary, full = fortran.pop("summary.json"), python["summary.json"]
    for name in fortran:
        assert fortran[name] == python[name], name
    # `ehl` writes no sentences
    assert sorted(full.pop("files")) == sorted([*summary.pop("files"), "plan.txt"])
    assert {name: full.get(name, "nothing") for name in summary} == summary
    words = {name for name, value in full.items() if isinstance(value, str) and " " in value}
    assert set(full) - set(summary) == words - {"error_estimate"} >= {"assessment", "mu_note"}
    assert sorted(p.name for p in (tmp_path / "deep").iterdir()) == ["ehl", "pyehl"]


def test_summary_and_fields(drive, tmp_path: Path):
    (tmp_path / "case.nml").write_text(SMALL)
    assert drive("ehl", "case.nml", "-o", "out", "--quiet").stdout == ""
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert set(summary) >= SUMMARY
    assert summary["status"] == "converged"
    x, y = np.load(tmp_path / "out" / "X.npy"), np.load(tmp_path / "out" / "Y.npy")
    grid = pyehl.Case(tmp_path / "out" / "case.nml").resolve()["grid"]
    assert x == pytest.approx(np.linspace(grid["x_inlet"], grid["x_outlet"], 65), abs=1e-14)
    assert y == pytest.approx(np.linspace(-grid["y_extent"], grid["y_extent"], 65), abs=1e-14)
    pressure, film = np.load(tmp_path / "out" / "P.npy"), np.load(tmp_path / "out" / "H.npy")
    assert pressure.shape == film.shape == (65, 65)
    assert pressure.flags.f_contiguous
    assert np.array_equal(pressure, pressure[:, ::-1])
    assert pressure.min() >= 0.0
    assert pressure.max() == summary["P_max"]
    # The load of the whole plane is 2 pi/3 (eq. 4)
    load = pressure.sum() * (x[1] - x[0]) * (y[1] - y[0])
    assert 0.001 < summary["load_beyond"] < 0.1
    assert load == pytest.approx(2.0 * np.pi / 3.0 * (1.0 - summary["load_beyond"]), rel=1e-6)
    centre = int(np.argmin(abs(x))), 32
    assert film[centre] == pytest.approx(summary["H_c"], rel=0.02)


def test_result_folder_solves_itself_again(drive, tmp_path: Path):
    (tmp_path / "case.nml").write_text(SMALL_SI)
    assert drive("ehl", "case.nml", "-o", "first").returncode == 0
    assert drive("ehl", "first/case.nml", "-o", "second").returncode == 0
    assert without_time(tmp_path / "first") == without_time(tmp_path / "second")


def test_fractal_surface_is_the_same_for_both_drivers(drive, tmp_path: Path):
    text = SMALL_SI + "&surface pixels = 32 {} /\n&time steps = 2 /\n"
    (tmp_path / "fractal.nml").write_text(text.format("kind = 'fractal'"))
    (tmp_path / "map.nml").write_text(
        text.format("kind = 'map' file = 'map.npy' length_x = 8.29e-4 length_y = 8.29e-4")
    )
    assert (
        cli.main(["surface", str(tmp_path / "fractal.nml"), "-o", str(tmp_path / "map.npy")]) == 0
    )
    heights = np.load(tmp_path / "map.npy")
    assert heights.shape == (32, 32)
    assert heights.std() == pytest.approx(0.05e-6, rel=1e-12)
    for driver in ("ehl", "pyehl"):
        for case in ("fractal", "map"):
            assert drive(driver, f"{case}.nml", "-o", f"{driver}-{case}").stderr == ""
    first = without_time(tmp_path / "ehl-fractal")
    assert first["case.nml"] == without_time(tmp_path / "pyehl-fractal")["case.nml"]
    for other in ("pyehl-fractal", "ehl-map", "pyehl-map"):
        second = without_time(tmp_path / other)
        for name in ("P.npy", "H.npy", "history.csv"):
            assert first[name] == second[name], (other, name)


@pytest.mark.parametrize("driver", ["ehl", "pyehl"])
def test_not_converged_is_reported(drive, tmp_path: Path, driver: str):
    (tmp_path / "case.nml").write_text(SMALL)
    options = ["--set", "solver.max_cycles=1", "--set", "solver.accuracy=1e-6"]
    done = drive(driver, "case.nml", "-o", "out", *options)
    assert done.returncode == 1
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["status"] not in ("converged", "interrupted")


@pytest.mark.parametrize("driver", ["ehl", "pyehl"])
def test_earlier_fields_are_removed(drive, tmp_path: Path, driver: str):
    (tmp_path / "case.nml").write_text(SMALL)
    assert drive(driver, "case.nml", "-o", "out").returncode == 0
    assert drive(driver, "case.nml", "-o", "out", "--set", "output.fields=.false.").returncode == 0
    left = {path.name for path in (tmp_path / "out").iterdir()}
    assert left - {"plan.txt"} == {"case.nml", "summary.json", "history.csv"}
    assert ("plan.txt" in left) == (driver == "pyehl")
    assert sorted(json.loads((tmp_path / "out" / "summary.json").read_text())["files"]) == [
        *sorted(left)
    ]
    assert {path.name for path in tmp_path.iterdir()} == {"case.nml", "out"}


@pytest.mark.parametrize(
    ("driver", "number"),
    [
        ("ehl", signal.SIGINT),
        ("pyehl", signal.SIGTERM),
        pytest.param("ehl", signal.SIGTERM, marks=pytest.mark.long),
        pytest.param("pyehl", signal.SIGINT, marks=pytest.mark.long),
    ],
)
def test_interrupt_keeps_the_present_state(drivers, tmp_path: Path, driver: str, number: int):
    (tmp_path / "case.nml").write_text("&contact moes_m = 200.0 /\n&grid points = 1025 /\n")
    options = ["--set", "solver.accuracy=1e-6", "--set", "solver.max_cycles=1000"]
    with subprocess.Popen(
        [*drivers[driver], "case.nml", "-o", "out", *options],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | {"PYTHONUNBUFFERED": "1"},
    ) as process:
        assert process.stdout is not None
        # The plan is printed when the solver has started
        assert process.stdout.readline()
        time.sleep(0.5)
        began = time.monotonic()
        process.send_signal(number)
        _, errors = process.communicate(timeout=60)
    assert time.monotonic() - began < 10.0
    assert (process.returncode, errors) == (130, "")
    assert {p.name for p in tmp_path.iterdir()} == {"case.nml", "out"}
    assert {p.name for p in (tmp_path / "out").iterdir()} - {"plan.txt"} == FILES
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["status"] == "interrupted"
    assert np.isfinite(np.load(tmp_path / "out" / "P.npy")).all()


def test_ends_with_nothing_when_the_folder_cannot_be_written(drive, tmp_path: Path):
    (tmp_path / "case.nml").write_text(SMALL)
    done = drive("ehl", "case.nml", "-o", "case.nml/out")
    assert done.returncode == 2
    assert [p.name for p in tmp_path.iterdir()] == ["case.nml"]


def test_load_and_export(drive, tmp_path: Path):
    (tmp_path / "case.nml").write_text(SMALL_SI)
    assert drive("ehl", "case.nml", "-o", "out").returncode == 0
    data = pyehl.load(tmp_path / "out")
    assert isinstance(data, xr.Dataset)
    assert data["P"].dims == data["h_m"].dims == ("X", "Y")
    assert {name: data[name].units for name in ("X", "x_m", "y_m", "P", "H", "p_Pa", "h_m")} == {
        "X": "1",
        "x_m": "m",
        "y_m": "m",
        "P": "1",
        "H": "1",
        "p_Pa": "Pa",
        "h_m": "m",
    }
    # a^3 = 3wR/(2E'), p_h = 3w/(2 pi a^2)
    a = (1.5 * 20.0 * 0.018 / 2.26e11) ** (1.0 / 3.0)
    p_h = 30.0 / (np.pi * a**2)
    assert data["x_m"].values == pytest.approx(data["X"].values * a, rel=1e-14)
    assert data["p_Pa"].values == pytest.approx(data["P"].values * p_h, rel=1e-12)
    assert data["h_m"].values == pytest.approx(data["H"].values * a**2 / 0.018, rel=1e-12)
    assert data.attrs["status"] == "converged"
    assert data["history_residual"].sizes["history"] >= 1

    path = export(tmp_path / "out")
    with xr.open_dataset(path, engine="scipy") as again:
        assert again["p_Pa"].dims == ("Y", "X")
        assert {"X", "Y", "x_m", "y_m"} <= set(again.coords)
        for name in data.variables:
            # an undefined number is NaN in both
            np.testing.assert_array_equal(again[name].values.T, data[name].values)
            assert again[name].attrs == data[name].attrs
        lower = [str(name).lower() for name in again.variables]
        assert len(lower) == len(set(lower))
        missing = {name for name in data.attrs if name not in again.attrs}
        assert not {name for name in missing if data.attrs[name] != ""}
        assert float(again.H_c) == float(data.H_c)
        assert again.attrs["Conventions"] == "CF-1.8"


def test_load_without_si_input(drive, tmp_path: Path):
    (tmp_path / "case.nml").write_text(SMALL)
    assert drive("ehl", "case.nml", "-o", "out").returncode == 0
    data = pyehl.load(tmp_path / "out")
    assert data.P.shape == (65, 65)
    assert "p_Pa" not in data
    assert results.settings_of(data)["grid"]["points"] == 65


def test_load_refuses_other_folders(tmp_path: Path):
    with pytest.raises(pyehl.InputError, match=r"summary\.json"):
        pyehl.load(tmp_path)


def test_closed_pipe_ends_without_a_traceback(drivers: dict[str, list[str]], cases: Path):
    """As before `| head`: no traceback."""
    with subprocess.Popen(
        [*drivers["pyehl"][:-1], "check", str(cases / "quick.nml")],
        stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    ) as process:  # fmt: skip
        process.stdout.close()
        assert process.stderr.read() == ""
        assert process.wait(60) == 1
