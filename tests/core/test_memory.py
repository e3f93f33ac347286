# SPDX-License-Identifier: BSD-3-Clause
"""Memory and time are estimated, reported and checked before anything is allocated."""

import json
import re
import resource
from pathlib import Path

import numpy as np
import pytest
from limited import limited

import pyehl
from pyehl import library
from pyehl.errors import NoMemoryError

WAVE = (
    "&contact moes_m = 100.0 moes_l = 6.0 /\n"
    "&grid points = 33 x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0 /\n"
    "&surface kind = 'harmonic' amplitude_over_film = 0.1 wavelength = 1.0 /\n"
    "&time steps = 5 /\n"
)
GIB = 2**30


def fake(root: Path, files: dict[str, str]) -> str:
    """A folder with files of /proc and /sys."""
    for name, text in files.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return str(root)


MACHINE = {"proc/meminfo": "MemTotal:  99999999 kB\nMemAvailable:  8388608 kB\n"}


def test_memory_of_the_machine(tmp_path: Path):
    assert library.free_bytes(fake(tmp_path, MACHINE)) == 8 * GIB
    assert library.free_bytes(str(tmp_path / "nothing")) > 1e300
    assert 0.0 < library.free_bytes() < 1e15


@pytest.mark.parametrize("where", ["a/b", "a", ""])
def test_limit_of_a_control_group_or_of_one_around_it(tmp_path: Path, where: str):
    """Version 2. Pages of unused files count as free."""
    group = f"sys/fs/cgroup/{where}/"
    root = fake(
        tmp_path,
        MACHINE
        | {
            "proc/self/cgroup": "0::/a/b\n",
            "sys/fs/cgroup/a/b/memory.max": "max\n",
            group + "memory.max": f"{4 * GIB}\n",
            group + "memory.current": f"{3 * GIB}\n",
            group + "memory.stat": f"anon 5\ninactive_file {GIB}\nactive_file 7\n",
        },
    )
    assert library.free_bytes(root) == 2 * GIB


def test_limit_of_a_control_group_of_version_1(tmp_path: Path):
    group = "sys/fs/cgroup/memory/job/"
    root = fake(
        tmp_path,
        MACHINE
        | {
            "proc/self/cgroup": "9:name=systemd:/\n4:memory:/job\n0::/\n",
            group + "memory.limit_in_bytes": f"{2 * GIB}\n",
            group + "memory.usage_in_bytes": f"{3 * GIB}\n",
        },
    )
    assert library.free_bytes(root) == 0.0


def test_limit_of_the_address_space(tmp_path: Path):
    limits = "Limit  Soft Limit  Hard Limit  Units\nMax address space   {}   unlimited   bytes\n"
    status = {"proc/self/status": f"Name:\tx\nVmSize:\t {GIB // 1024} kB\n"}
    root = fake(tmp_path, MACHINE | status | {"proc/self/limits": limits.format(3 * GIB)})
    assert library.free_bytes(root) == 2 * GIB
    fake(tmp_path, {"proc/self/limits": limits.format("unlimited")})
    assert library.free_bytes(root) == 8 * GIB


@pytest.mark.parametrize("points", [257, 513])
@pytest.mark.parametrize("kind", ["smooth", "harmonic"])
def test_estimated_memory_covers_the_memory_used(points: int, kind: str):
    """The summary has the final bytes of the grids; time steps need more."""
    case = pyehl.Case.from_text(WAVE, [f"grid.points={points}", f"surface.kind={kind}"])
    with pyehl.Solver(case) as solver:
        need = re.search(r"need +about (\d+) MB of memory", solver.describe())
        assert need is not None
        solver.run()
        taken = solver.summary["bytes"] / 1e6
    assert taken <= float(need[1]) <= 2.5 * taken + 2.0


def test_memory_of_a_fine_grid_is_checked_before_the_run(cases: Path):
    """Before the finest grid is created; half the domain of a smooth contact of 4097 points."""
    with pyehl.Solver(cases / "quick.nml", "grid.points=4097") as solver:
        reported = re.search(r"need +about ([\d.]+) GB of memory and (\d+) s", solver.describe())
    assert reported is not None
    assert 1.2 < float(reported[1]) < 2.5
    assert 2 < int(reported[2]) < 60


def test_the_message_names_the_key_that_needs_memory(cases: Path, tmp_path: Path):
    large = ("surface.kind=harmonic", "output.frame_interval=1e-12", "time.steps=10000000")
    with pytest.raises(NoMemoryError, match=r"grid.points = 4097 .*frame_interval = 1e-12 needs"):
        pyehl.Solver(cases / "quick.nml", "grid.points=4097", *large)
    # 8192 pixels need more memory than the process may have
    for words in (("check",), ("run", "-o", "out"), ("predict", "-o", "out")):
        done = limited(
            tmp_path,
            resource.RLIMIT_AS,
            900 * 2**20,
            words[0],
            str(cases / "table1.nml"),
            *words[1:],
            *("--set", "surface.pixels=8192"),
        )
        assert done.returncode == 1
        assert "surface.pixels = 8192: " in done.stderr
        assert "Traceback" not in done.stderr
        assert not (tmp_path / "out").exists()


def test_wave_that_is_too_long_to_sample(cases: Path):
    options = ("surface.kind=harmonic", "surface.wavelength_y=1e6")
    with pytest.raises(NoMemoryError, match=r"a wave of 0\.5 x 1e\+06 a"):
        pyehl.predict(cases / "table1.nml", *options)


@pytest.mark.parametrize("interval", ["1e-12", "1e-308", "0.01"])
def test_interval_below_a_step_keeps_every_step(tmp_path: Path, interval: str):
    """Also where the time over the interval exceeds every integer."""
    case = pyehl.Case.from_text(WAVE, f"output.frame_interval={interval}")
    ds = pyehl.solve(case, check=False, output=tmp_path / "out")
    assert ds.frame_P.shape[2] == 5
    assert np.diff(ds["T"]) == pytest.approx(4.0 / 32, rel=1e-12)
    assert "frames     after every step" in (tmp_path / "out" / "plan.txt").read_text()


def test_frames_of_an_interval(tmp_path: Path):
    case = pyehl.Case.from_text(WAVE, ["time.steps=12", "output.frame_interval=0.5"])
    ds = pyehl.solve(case, check=False)
    assert ds["T"].values == pytest.approx(0.5 * np.round(ds["T"].values / 0.5), abs=0.125)
    assert np.diff(ds["T"]) == pytest.approx(0.5, abs=1e-12)


def test_steps_that_are_skipped_are_counted():
    """1.6e10 steps exceed an integer: the run would start at the front, far outside."""
    slow = ("time.steps=2", "surface.velocity_ratio=1e-7", "surface.x_start=-100")
    with pytest.raises(
        pyehl.InputError, match=r"needs .* time steps (.|\n)*a velocity ratio of at least"
    ):
        pyehl.Solver(pyehl.Case.from_text(WAVE, slow))
    faster = ("time.steps=2", "surface.velocity_ratio=1e-5", "surface.x_start=-100")
    with pyehl.Solver(pyehl.Case.from_text(WAVE, faster)) as solver:
        solver.run()
        summary = json.loads(json.dumps(solver.summary))
    assert summary["steps_skipped"] > 7e7


def test_time_left_of_very_many_periods():
    many = ("time.steps=0", "time.max_periods=100000", "surface.velocity_ratio=1e-3")
    with pyehl.Solver(pyehl.Case.from_text(WAVE, [*many, "time.estimate_error=.false."])) as solver:
        while solver.work.done < 2:
            solver.advance()
        assert solver.work.latest > 2.0**31 / 4
        assert " -" not in solver.progress.rpartition(",")[2]
