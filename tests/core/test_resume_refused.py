# SPDX-License-Identifier: BSD-3-Clause
"""Where a run cannot be resumed or this is not proposed, and runs without states."""

from pathlib import Path

import numpy as np
import pytest
from test_resume import FRACTAL, WAVE, stop_after_steps


@pytest.mark.parametrize("driver", ["ehl", "pyehl"])
@pytest.mark.parametrize(
    ("extra", "options", "assessment", "proposal"),
    [
        (
            "amplitude_over_film = 0.2",
            "time.steps=5",
            "no result: the status is 'not settled': the mean of mu_r/mu_s has not settled at T = ",
            "a larger time.max_periods",
        ),
        (
            "amplitude_over_film = 3.0",
            "solver.threads=1",
            "film breakdown: no solution with a positive film for the time step to T = ",
            "",
        ),
    ],
)
def test_resumption_is_proposed_only_if_it_may_end_otherwise(
    drive, tmp_path: Path, driver: str, extra: str, options: str, assessment: str, proposal: str
):
    (tmp_path / "case.nml").write_text(WAVE.format(points=65, extra=f"wavelength = 1.0 {extra}"))
    done = drive(driver, "case.nml", "-o", "out", "--set", options)
    assert done.returncode == 1
    *_, last = done.stdout.splitlines()
    assert last.endswith("--resume out") == bool(proposal)
    assert proposal in last
    if driver == "pyehl":
        assert f"assessment {assessment}" in done.stdout


@pytest.mark.parametrize("driver", ["ehl", "pyehl"])
def test_refused_resumptions(drive, tmp_path: Path, driver: str):
    def refused(*words: str) -> str:
        before = sorted(tmp_path.rglob("*"))
        done = drive(driver, "--resume", *words)
        assert (done.returncode, done.stdout) == (2, "") or "level" in done.stdout, done
        assert done.returncode == 2
        assert sorted(tmp_path.rglob("*")) == before
        return done.stderr

    assert "out.checkpoint/case.nml" in refused("out")
    assert "no name" in refused("")
    (tmp_path / "case.nml").write_text(WAVE.format(points=33, extra="amplitude = 0.001"))
    stop_after_steps(drive, tmp_path, driver, 3)
    assert "without '.checkpoint'" in refused("out.checkpoint")
    # keys that change the steps
    message = refused("out", "--set", "surface.wavelength_x=0.7")
    assert "another case" in message
    assert "wavelength_x = 0.5" in message
    assert "wavelength_x = 0.7" in message
    assert "points = 65" in refused("out", "--set", "grid.points=65")
    # there is no complete file, or one of another version
    states = sorted((tmp_path / "out.checkpoint").glob("checkpoint.?"))
    assert states
    kept = [path.read_bytes() for path in states]
    for path, data in zip(states, kept, strict=True):
        path.write_bytes(data[:-1])
    assert "damaged" in refused("out")
    for path, data in zip(states, kept, strict=True):
        path.write_bytes(data[:16] + b"9" + data[17:])
    assert "another version" in refused("out")


def test_changed_surface_is_noticed(drive, tmp_path: Path):
    text = FRACTAL.replace("'fractal' pixels = 32", "'map' file = 'map.npy'")
    (tmp_path / "case.nml").write_text(text)
    heights = np.random.default_rng(1).normal(scale=2e-8, size=(16, 16))
    np.save(tmp_path / "map.npy", heights)
    stop_after_steps(drive, tmp_path, "ehl", 10)
    heights[3, 4] += 1e-9
    np.save(tmp_path / "map.npy", heights)
    done = drive("ehl", "--resume", "out")
    assert done.returncode == 2
    assert "does not follow" in done.stderr


def test_new_run_backs_up_an_earlier_state(drive, tmp_path: Path):
    (tmp_path / "case.nml").write_text(WAVE.format(points=33, extra="amplitude = 0.001"))
    stop_after_steps(drive, tmp_path, "ehl", 3)
    state = max((tmp_path / "out.checkpoint").glob("checkpoint.?")).read_bytes()
    done = drive("pyehl", "case.nml", "-o", "out", "--set", "time.steps=2")
    assert "out.checkpoint.previous" in done.stdout
    previous = tmp_path / "out.checkpoint.previous"
    assert state in [path.read_bytes() for path in previous.iterdir()]


def test_no_states_without_checkpoints(drive, tmp_path: Path):
    (tmp_path / "case.nml").write_text(WAVE.format(points=33, extra="amplitude = 0.001"))
    for driver in ("ehl", "pyehl"):
        words = ["--set", "output.checkpoint_interval=0", "--set", "time.steps=3"]
        assert drive(driver, "case.nml", "-o", "out", *words).returncode == 1
        assert {path.name for path in tmp_path.iterdir()} == {"case.nml", "out"}
