# SPDX-License-Identifier: BSD-3-Clause
"""A transient run that is stopped, killed or damaged is resumed to the same bits."""

import contextlib
import json
import os
import random
import shutil
import signal
import subprocess
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pyehl.case import Case
from pyehl.solver import solver_on_heights

WAVE = (
    "&contact moes_m = 200.0 /\n"
    "&grid points = {points} x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0 /\n"
    "&surface kind = 'harmonic' {extra} /\n&output frame_interval = 0.5 /\n"
)
# With the heat of friction in its history
FRACTAL = (
    "&contact load = 20.0 slide_to_roll = 0.1 /\n"
    "&lubricant shear_law = 'eyring' temperature_viscosity = 0.04 /\n"
    "&grid points = 65 x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0 /\n"
    "&surface kind = 'fractal' pixels = 32 length_x = 1e-4 length_y = 1e-4 rms_height = 2e-8 /\n"
)
OFTEN = ["--set", "output.checkpoint_interval=1e-3"]


def results(folder: Path) -> tuple[dict[str, Any], dict[str, bytes]]:
    """All results that do not depend on time, threads and the interval of states."""
    files = {path.name: path.read_bytes() for path in folder.iterdir()}
    summary = json.loads(files.pop("summary.json"))
    free = {"threads", "bytes", "files"} | {name for name in summary if "seconds" in name}
    if summary.get("variance_unresolved"):
        # Python also predicts what the grid does not resolve, and counts the omitted waves
        free |= {"mu_ratio_unresolved", "mu_ratio_error_left_out"}
        free |= {"mu_ratio_error", "mu_ratio_error_note", "assessment"}
    summary = {name: value for name, value in summary.items() if name not in free}
    # the values: `ehl` and `pyehl` write different comments
    case = Case(folder / "case.nml").resolve()
    for group, key in (
        ("solver", "threads"),
        ("output", "checkpoint_interval"),
        ("time", "steps"),
    ):
        del case[group][key]
    files["case.nml"] = json.dumps(case).encode()
    # only in pyehl
    files.pop("plan.txt", None)
    return summary, files


def same(one: Path, other: Path) -> None:
    """Both folders hold the same results, bit by bit."""
    (numbers, first), (others, second) = results(one), results(other)
    assert set(first) == set(second)
    assert [name for name in first if first[name] != second[name]] == []
    # `ehl` writes no sentences
    fewer, more = sorted((numbers, others), key=len)
    assert len(fewer) > 40
    assert {name: more.get(name, "nothing") for name in fewer} == fewer


def stop_after_steps(drive, tmp_path: Path, driver: str, steps: int, *words: str) -> None:
    """End a run early; its state is kept."""
    done = drive(driver, "case.nml", "-o", "out", "--set", f"time.steps={steps}", *OFTEN, *words)
    assert done.returncode == 1, done.stderr
    assert json.loads((tmp_path / "out" / "summary.json").read_text())["status"] == "not settled"
    assert (tmp_path / "out.checkpoint" / "case.nml").is_file()


@pytest.fixture(scope="module")
def unbroken(drivers, tmp_path_factory) -> dict[str, Path]:
    """Results of undisturbed runs, by case text."""
    made = {}
    for name, text, driver in (
        ("wave", WAVE.format(points=65, extra=""), "ehl"),
        ("long", WAVE.format(points=129, extra="x_start = -3.5"), "ehl"),
        ("fractal", FRACTAL, "pyehl"),
    ):
        folder = tmp_path_factory.mktemp(name)
        (folder / "case.nml").write_text(text)
        subprocess.run([*drivers[driver], "case.nml", "-o", "out", "-q"], cwd=folder, check=True)
        # No state remains after convergence
        assert {path.name for path in folder.iterdir()} == {"case.nml", "out"}
        made[name] = folder
    return made


@pytest.mark.parametrize(
    ("first", "second"),
    [
        *(("ehl", "pyehl"), ("pyehl", "ehl")),
        *(pytest.param(one, one, marks=pytest.mark.long) for one in ("ehl", "pyehl")),
    ],
)
def test_resumed_march_gives_the_same_bits(drive, unbroken, tmp_path: Path, first, second):
    shutil.copy(unbroken["wave"] / "case.nml", tmp_path)
    # after so few steps there is no mean yet; two threads instead of one from there
    stop_after_steps(drive, tmp_path, first, 30)
    history = (tmp_path / "out" / "history.csv").read_bytes()
    words = ["--set", "time.steps=0", "--set", "solver.threads=2"]
    done = drive(second, "--resume", "out", *words)
    assert (done.returncode, done.stderr) == (0, "")
    assert "after step 30" in done.stdout
    assert (tmp_path / "out" / "history.csv").read_bytes().startswith(history[:-1])
    same(unbroken["wave"] / "out", tmp_path / "out")
    assert (tmp_path / "out" / "frame_P.npy").is_file()
    assert not (tmp_path / "out.checkpoint").exists()


def test_either_driver_resumes_a_fractal_surface(drive, unbroken, tmp_path: Path):
    shutil.copy(unbroken["fractal"] / "case.nml", tmp_path)
    for driver in ("ehl", "pyehl"):
        stop_after_steps(drive, tmp_path, "pyehl", 20)
        done = drive(driver, "--resume", "out", "--set", "time.steps=0")
        assert (done.returncode, done.stderr) == (0, "")
        same(unbroken["fractal"] / "out", tmp_path / "out")
        assert "heat_ratio" in (tmp_path / "out" / "history.csv").read_text().splitlines()[0]
        assert (tmp_path / "out" / "temperature_rise_K.npy").is_file()


def test_given_surface_is_kept_for_both_drivers(drive, tmp_path: Path):
    """Heights from Python are stored with the state."""
    text = FRACTAL.replace("'fractal' pixels = 32", "'map' file = 'other.npy'")
    heights = np.random.default_rng(1).normal(scale=2e-9, size=(16, 16))
    np.save(tmp_path / "other.npy", 0.0 * heights)
    (tmp_path / "case.nml").write_text(text)
    case = Case(tmp_path / "case.nml")
    with solver_on_heights(case, {"surface": heights}) as solver:
        solver.checkpoint(tmp_path / "out")
        while solver.summary.get("steps", 0) < 10:
            solver.advance()
        assert solver.save_state(at_once=True)
    assert np.array_equal(np.load(tmp_path / "out.checkpoint" / "surface.npy"), heights)
    shutil.copytree(tmp_path / "out.checkpoint", tmp_path / "two.checkpoint")
    histories = []
    for driver, place in (("ehl", "out"), ("pyehl", "two")):
        done = drive(driver, "--resume", place, "--set", "time.steps=14")
        assert (done.returncode, done.stderr) == (1, "")
        histories.append((tmp_path / place / "history.csv").read_bytes())
    assert histories[0] == histories[1]


def test_resume_into_another_folder_leaves_the_state(drive, unbroken, tmp_path: Path):
    shutil.copy(unbroken["wave"] / "case.nml", tmp_path)
    stop_after_steps(drive, tmp_path, "ehl", 20)
    before = {p.name: p.read_bytes() for p in (tmp_path / "out.checkpoint").iterdir()}
    for driver in ("ehl", "pyehl"):
        # with the original case, and with one that is given
        words = ["case.nml"] if driver == "pyehl" else ["--set", "time.steps=0"]
        done = drive(driver, "--resume", "out", "-o", driver, *words)
        assert (done.returncode, done.stderr) == (0, "")
        same(unbroken["wave"] / "out", tmp_path / driver)
        assert not (tmp_path / f"{driver}.checkpoint").exists()
    after = {p.name: p.read_bytes() for p in (tmp_path / "out.checkpoint").iterdir()}
    assert before == after


@pytest.mark.parametrize("damage", ["cut", "bit", "empty", "version"])
def test_the_older_state_replaces_a_damaged_one(drive, unbroken, tmp_path: Path, damage: str):
    shutil.copy(unbroken["wave"] / "case.nml", tmp_path)
    stop_after_steps(drive, tmp_path, "ehl", 30)
    folder = tmp_path / "out.checkpoint"
    newest = max(folder.glob("checkpoint.?"), key=lambda path: path.stat().st_mtime_ns)
    data = bytearray(newest.read_bytes())
    if damage == "cut":
        data = data[: len(data) // 2]
    elif damage == "bit":
        data[len(data) // 3] ^= 4
    elif damage == "version":
        data[16:17] = b"9"
    else:
        data = bytearray()
    newest.write_bytes(data)
    done = drive("ehl", "--resume", "out", "--set", "time.steps=0")
    assert (done.returncode, done.stderr) == (0, "")
    fault = "of another version" if damage == "version" else "is damaged"
    assert f"{newest.name} {fault}" in done.stdout
    assert "after step 29" in done.stdout
    same(unbroken["wave"] / "out", tmp_path / "out")


def test_frames_are_written_once(drive, unbroken, tmp_path: Path):
    """Each has its own file; a state with a damaged frame is not used."""
    shutil.copy(unbroken["wave"] / "case.nml", tmp_path)
    stop_after_steps(drive, tmp_path, "ehl", 20)
    folder = tmp_path / "out.checkpoint"
    early = {path.name: path.stat().st_mtime_ns for path in folder.glob("checkpoint.frame-*")}
    assert early
    stop_after_steps(drive, tmp_path, "ehl", 40, "--resume", "out")
    late = {path.name: path.stat().st_mtime_ns for path in folder.glob("checkpoint.frame-*")}
    assert len(late) > len(early)
    assert {name: late[name] for name in early} == early
    frame = folder / "checkpoint.frame-1"
    data = frame.read_bytes()
    frame.write_bytes(data[: len(data) // 2] + b"?" + data[len(data) // 2 + 1 :])
    done = drive("ehl", "--resume", "out", "--set", "time.steps=0")
    assert done.returncode == 2
    assert "damaged, and there is no other" in done.stderr
    frame.write_bytes(data)
    assert drive("ehl", "--resume", "out", "--set", "time.steps=0").returncode == 0
    same(unbroken["wave"] / "out", tmp_path / "out")


@pytest.mark.long
def test_yielding_solids_are_resumed(drive, tmp_path: Path):
    """Yield in a step follows from the kept state of the earlier steps."""
    (tmp_path / "case.nml").write_text(
        "&contact mean_velocity = 0.1 slide_to_roll = 1.0 hardness = 1.83e9 /\n"
        "&lubricant shear_law = 'eyring' boundary_film = 2e-8 /\n"
        "&grid points = 65 x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0 /\n"
        "&surface kind = 'harmonic' wavelength = 0.5 amplitude = 0.02 /\n"
        "&time estimate_error = .false. /\n"
    )
    assert drive("ehl", "case.nml", "-o", "whole").returncode == 0
    stop_after_steps(drive, tmp_path, "ehl", 20)
    assert drive("pyehl", "--resume", "out", "--set", "time.steps=0").returncode == 0
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["load_share_at_hardness"] > 0.05
    same(tmp_path / "whole", tmp_path / "out")


@pytest.mark.long
def test_change_of_coarsening_is_resumed(drive, tmp_path: Path):
    # On so coarse a grid classical cycles converge slowly in the contact at small residuals
    text = WAVE.format(points=65, extra="amplitude_over_film = 0.5 wavelength = 1.0")
    (tmp_path / "case.nml").write_text(text.replace("200.0", "500.0 moes_l = 5.0"))
    alone = ["--set", "time.estimate_error=.false.", "--set", "solver.accuracy=0.001"]
    assert drive("ehl", "case.nml", "-o", "whole", *alone).returncode == 0
    changed = json.loads((tmp_path / "whole" / "summary.json").read_text())["coarsening_changed_at"]
    assert changed > 3
    for steps in (changed - 2, changed + 2):
        stop_after_steps(drive, tmp_path, "ehl", steps, *alone)
        summary = json.loads((tmp_path / "out" / "summary.json").read_text())
        assert summary["coarsening_changed_at"] == (changed if steps > changed else 0)
        assert drive("pyehl", "--resume", "out", "--set", "time.steps=0").returncode == 0
        same(tmp_path / "whole", tmp_path / "out")
    kept = [*alone, "--set", "solver.coarsening=classical"]
    assert drive("ehl", "case.nml", "-o", "classical", *kept).returncode == 0
    summary = json.loads((tmp_path / "classical" / "summary.json").read_text())
    assert summary["coarsening_changed_at"] == 0


@pytest.mark.parametrize("driver", ["ehl", "pyehl"])
def test_failed_step_keeps_the_last_good_state(drive, tmp_path: Path, driver: str):
    # A wave nearly as high as the film: on this grid the film becomes negative during the run
    text = WAVE.format(points=65, extra="amplitude_over_film = 0.9")
    (tmp_path / "case.nml").write_text(text)
    failed = drive(driver, "case.nml", "-o", "out", *OFTEN)
    assert failed.returncode == 1
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["status"] == "negative film"
    steps = summary["steps"]
    assert steps > 10
    # The result is that of a run with this number of steps
    good = drive(driver, "case.nml", "-o", "good", "--set", f"time.steps={steps}")
    assert good.returncode == 1
    assert json.loads((tmp_path / "good" / "summary.json").read_text())["status"] == "not settled"
    for name in ("P.npy", "H.npy", "RR.npy"):
        kept = (tmp_path / "out" / name).read_bytes()
        assert kept == (tmp_path / "good" / name).read_bytes()
    assert np.load(tmp_path / "out" / "H.npy").min() > 0.0
    # A run resumed from it ends in the same step, and the state still exists
    again = drive(driver, "--resume", "out")
    assert again.returncode == 1
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert (summary["status"], summary["steps"]) == ("negative film", steps)
    assert list((tmp_path / "out.checkpoint").glob("checkpoint.?"))


def start(command: list[str], folder: Path) -> subprocess.Popen[str]:
    return subprocess.Popen(
        command,
        cwd=folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | {"PYTHONUNBUFFERED": "1"},
    )


@pytest.mark.parametrize(
    ("driver", "number"),
    [
        ("ehl", signal.SIGTERM),
        ("pyehl", signal.SIGINT),
        pytest.param("ehl", signal.SIGINT, marks=pytest.mark.long),
        pytest.param("pyehl", signal.SIGTERM, marks=pytest.mark.long),
    ],
)
def test_signal_leaves_results_and_a_state(
    drive, drivers, tmp_path: Path, driver: str, number: int
):
    # a run of half a minute or more; the signal causes its only state
    (tmp_path / "case.nml").write_text(WAVE.format(points=129, extra="x_start = -40.0"))
    words = ["--set", "output.checkpoint_interval=1e6", "--set", "time.skip_start=.false."]
    with start([*drivers[driver], "case.nml", "-o", "out", *words], tmp_path) as process:
        assert process.stdout is not None
        for line in process.stdout:
            if line.startswith("step"):
                break
        began = time.monotonic()
        process.send_signal(number)
        _, errors = process.communicate(timeout=60)
    assert time.monotonic() - began < 10.0
    assert (process.returncode, errors) == (130, "")
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["status"] == "interrupted"
    assert summary["mu_ratio"] is None
    rows = (tmp_path / "out" / "history.csv").read_text().splitlines()
    assert len(rows) - 1 == summary["steps"] > 0
    done = drive(
        driver, "--resume", "out", *words[2:], "--set", f"time.steps={summary['steps'] + 2}"
    )
    assert f"after step {summary['steps']}" in done.stdout


def newest(folder: Path) -> int:
    """Time at which a state was last written."""
    times = [0]
    for path in folder.glob("*checkpoint.?"):
        with contextlib.suppress(FileNotFoundError):
            times.append(path.stat().st_mtime_ns)
    return max(times)


@pytest.mark.parametrize("driver", ["ehl", pytest.param("pyehl", marks=pytest.mark.long)])
def test_killed_at_random_instants(drivers, unbroken, tmp_path: Path, driver: str):
    shutil.copy(unbroken["long"] / "case.nml", tmp_path)
    chance = random.Random(20190128)
    folder = tmp_path / "out.checkpoint"
    kills, resumed = 0, 0
    while True:
        begun = (folder / "case.nml").is_file()
        words = ["--resume", "out"] if begun else ["case.nml", "-o", "out"]
        words += ["--set", f"solver.threads={chance.choice([1, 2])}"]
        with start([*drivers[driver], *words, *OFTEN], tmp_path) as process:
            if kills < 6:
                # after this number of states, and a little later: between two of them, or while one
                # is written
                states, last = chance.randrange(20), newest(folder)
                while states > 0 and process.poll() is None:
                    time.sleep(0.0005)
                    now = newest(folder)
                    states -= now != last
                    last = now
                time.sleep(chance.uniform(0.0, 0.02))
                process.kill()
                kills += 1
            output, errors = process.communicate(timeout=120)
        resumed += "after step" in output
        if process.returncode == -signal.SIGKILL:
            continue
        assert (process.returncode, errors) == (0, "")
        break
    assert kills == 6
    assert resumed >= 3
    same(unbroken["long"] / "out", tmp_path / "out")
    assert not folder.exists()
