# SPDX-License-Identifier: BSD-3-Clause
"""A run locks its folder, and checks before it computes that the folder can be written."""

import os
import signal
import socket
import subprocess
import time
from pathlib import Path

import pytest

import pyehl
from pyehl.case import resolve

DRIVERS = pytest.mark.parametrize("driver", ["ehl", "pyehl"])
MARK = "! A run writes into the folder beside this file; removed with its end\n"
QUICK = ["--set", "grid.points=33"]


@pytest.fixture
def case(tmp_path: Path) -> Path:
    path = tmp_path / "case.nml"
    path.write_text("&contact moes_m = 200.0 /\n&surface kind = 'harmonic' /\n")
    return path


def dead_process() -> int:
    """Number of a process that has ended."""
    done = subprocess.Popen(["true"])
    done.wait()
    return done.pid


@DRIVERS
def test_second_run_is_refused(drive, drivers, case: Path, driver: str):
    """It would remove the states of the first."""
    words = [*drivers["ehl"], "case.nml", "-o", "out", "-q", "--set", "grid.points=257"]
    lock = case.parent / "out.lock"
    with subprocess.Popen(words, cwd=case.parent) as first:
        while not lock.exists():
            assert first.poll() is None
            time.sleep(0.01)
        done = drive(driver, "case.nml", "-o", "out", "-q", *QUICK)
        assert done.returncode == 2
        assert (
            f"out: error: process {first.pid} on {socket.gethostname()} is writing" in done.stderr
        )
        assert f"remove {lock}" in done.stderr
        assert (case.parent / "out.checkpoint").is_dir()
        assert not (case.parent / "out.checkpoint.previous").exists()
        first.send_signal(signal.SIGKILL)
    # of a process that has ended
    assert lock.exists()
    done = drive(driver, "case.nml", "-o", "out", "-q", "--set", "grid.points=65")
    assert (done.returncode, done.stderr) == (0, "")
    assert not lock.exists()


def test_solver_of_the_same_process_is_refused(case: Path):
    folder = case.parent / "out"
    with pyehl.Solver(case) as first, pyehl.Solver(case) as second:
        first.checkpoint(folder)
        with pytest.raises(pyehl.InputError, match=f"process {os.getpid()} on "):
            second.checkpoint(folder)
        first.close()
        second.checkpoint(folder)
    assert not folder.with_name("out.lock").exists()


@pytest.mark.parametrize(
    ("text", "refused"),
    [
        (MARK + "{dead} 1 {host}\n", False),
        # the number now belongs to another process
        (MARK + "{own} 1 {host}\n", False),
        (MARK + "{dead} 1 another-machine\n", True),
        (MARK, False),
        ("notes of a person\n", True),
    ],
    ids=["dead", "number of another", "another machine", "empty", "not ours"],
)
def test_locks_and_their_messages(drive, case: Path, text: str, refused: bool):
    lock = case.parent / "out.lock"
    words = {"dead": dead_process(), "own": os.getpid(), "host": socket.gethostname()}
    lock.write_text(text.format(**words))
    done = drive("ehl", "case.nml", "-o", "out", "-q", "--set", "grid.points=65")
    assert done.returncode == (2 if refused else 0), done.stderr
    assert lock.exists() == refused
    if refused:
        assert lock.read_text() == text.format(**words)


@DRIVERS
@pytest.mark.parametrize("existing", [False, True])
def test_long_name_is_refused_before_computing(drive, case: Path, driver: str, existing: bool):
    """The result temporarily needs a longer name."""
    name = "x" * 250
    if existing:
        (case.parent / name).mkdir()
    done = drive(driver, "case.nml", "-o", name, *QUICK)
    assert done.returncode == 2
    assert "too long" in done.stderr
    assert "residual" not in done.stdout
    assert {path.name for path in case.parent.iterdir()} <= {"case.nml", name}


@pytest.mark.parametrize(
    "words",
    [
        "sweep case.nml --vary contact.moes_m=100,200 -o {}",
        "stribeck si.nml --speed 0.5,1 -o {}",
        "response si.nml -o {}",
        "surface si.nml -o {}.npy",
        "stress out -o {}",
        "report out -o {}.html",
        "export out -o {}.nc",
        "lubricants -o {}",
    ],
    ids=lambda words: words.partition(" ")[0],
)
def test_every_command_refuses_a_long_name(drive, command, case: Path, words: str):
    folder = case.parent
    keys = {"contact.load": 20.0, "contact.mean_velocity": 1.0, "contact.radius": 0.01}
    surface = {"surface.kind": "fractal", "surface.rms_height": 2e-8, "surface.pixels": 32}
    (folder / "si.nml").write_text(pyehl.Case.from_text("", keys | surface).text)
    if " out " in words:
        done = drive("ehl", "case.nml", "--set", "surface.kind=smooth", "-o", "out", *QUICK)
        assert done.returncode == 0, done.stderr
    before = sorted(folder.iterdir())
    done = command(folder, *words.format("x" * 250).split())
    assert done.returncode == 2, done.stderr
    assert "the name is too long\nexpected: a shorter name" in done.stderr
    assert sorted(folder.iterdir()) == before


def test_leftovers_of_killed_runs_are_removed(drive, case: Path):
    dead, folder = dead_process(), case.parent
    names = [f"out.partial-{dead}", f"out.partial-{dead}-2", f"out.partial-{os.getpid()}"]
    names += [f"other.partial-{dead}", "out.partial-mine"]
    for name in names:
        (folder / name).mkdir()
        (folder / name / "P.npy").write_text("half")
    (folder / names[1] / "notes.txt").write_text("mine")
    done = drive("ehl", "case.nml", "-o", "out", "-q", "--set", "grid.points=65")
    assert done.returncode == 0
    left = {path.name for path in folder.iterdir()} - {"case.nml", "out"}
    assert left == set(names[1:])
    assert (folder / names[1] / "notes.txt").read_text() == "mine"
    for name in names[2:]:
        assert (folder / name / "P.npy").exists()


@pytest.mark.parametrize("name", ["run", "predict"])
def test_next_result_removes_locks_of_killed_runs(drivers, command, case: Path, name: str):
    """The state of the killed run is kept, as are locks of others and files that no run wrote."""
    folder, words = case.parent, [*drivers["ehl"], "case.nml", "-o", "out", "-q"]
    with subprocess.Popen([*words, "--set", "grid.points=257"], cwd=folder) as first:
        while not (folder / "out.checkpoint").exists():
            assert first.poll() is None
            time.sleep(0.01)
        first.kill()
    assert (folder / "out.lock").exists()
    (folder / f"out.partial-{first.pid}").mkdir()
    (folder / f"out.partial-{first.pid}" / "summary.json").write_text("half")
    start = Path("/proc/self/stat").read_text().rpartition(")")[2].split()[19]
    kept = {"alive.lock": f"{MARK}{os.getpid()} {start} {socket.gethostname()}\n"}
    kept |= {"far.lock": f"{MARK}{dead_process()} 1 another-machine\n", "mine.lock": "notes\n"}
    for lock, text in kept.items():
        (folder / lock).write_text(text)
    option = "surface.kind='fractal'" if name == "predict" else "grid.points=65"
    done = command(folder, name, "case.nml", "-o", "other", "--set", option)
    assert done.returncode == 0, done.stderr
    expected = {"case.nml", "other", "out.checkpoint", *kept}
    assert {path.name for path in folder.iterdir()} == expected
    assert {lock: (folder / lock).read_text() for lock in kept} == kept


@DRIVERS
@pytest.mark.parametrize("target", ["full", "closed"])
def test_unusable_standard_output_ends_with_a_message(
    drivers, case: Path, driver: str, target: str
):
    words = [*drivers[driver], "case.nml", "-o", "out", *QUICK]
    command = f'exec "$@" {">/dev/full" if target == "full" else ">&-"}'
    done = subprocess.run(
        ["sh", "-c", command, "sh", *words],
        cwd=case.parent,
        stderr=subprocess.PIPE,
        text=True,
        check=False,
    )
    assert done.returncode == 1
    (line,) = done.stderr.splitlines()
    assert "standard output: " in line
    assert not (case.parent / "out").exists()
    assert not (case.parent / "out.lock").exists()


def test_byte_order_mark_is_no_text(tmp_path: Path, drive):
    text = "&contact moes_m = 150.0 /\n&grid points = 33 /\n"
    (tmp_path / "case.nml").write_text(text, encoding="utf-8-sig")
    assert pyehl.Case(tmp_path / "case.nml").resolve()["contact"]["moes_m"] == 150.0
    (tmp_path / "bad.nml").write_text("&contact moes_n = 1 /\n", encoding="utf-8-sig")
    done = drive("ehl", "bad.nml", "-o", "out")
    assert "bad.nml:1: error" in done.stderr
    assert resolve(text, "a text")
