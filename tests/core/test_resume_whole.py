# SPDX-License-Identifier: BSD-3-Clause
"""The complete summary of a resumed run is that of an uninterrupted one."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pyehl

GRID = "&grid points = 65, x_inlet = -2.5, x_outlet = 1.5, y_extent = 2.0 /\n"
MOES = "&contact moes_m = 200.0, moes_l = 10.0 /\n"
BALL = "&contact load = 20.0 /\n"
TILE = "kind = 'fractal', pixels = 16, length_x = 2e-4, length_y = 2e-4"
WAVE = "kind = 'harmonic', wavelength = 2.0, amplitude = 0.02"
CASES = {
    "fractal": f"{BALL}{GRID}&surface {TILE}, rms_height = 1e-8 /\n",
    "negative film": f"{BALL}{GRID}&surface {TILE}, rms_height = 3e-7 /\n",
    "coarser run fails": (
        f"{MOES}{GRID}&surface kind = 'harmonic', wavelength = 0.3, amplitude_over_film = 0.4 /\n"
    ),
    "heat": (
        "&contact load = 20.0, slide_to_roll = 0.1 /\n"
        "&lubricant shear_law = 'eyring', temperature_viscosity = 0.04 /\n"
        f"{GRID}&surface {TILE}, rms_height = 1e-8 /\n"
    ),
    "one at rest": (
        f"{BALL}{GRID}&surface {TILE}, rms_height = 1e-8, velocity_ratio = 0.0 /\n"
        f"&second_surface {WAVE}, velocity_ratio = 2.0 /\n"
    ),
    "two that move": (
        f"{BALL}{GRID}&surface {WAVE}, velocity_ratio = 0.9 /\n"
        f"&second_surface {WAVE}, velocity_ratio = 1.1 /\n"
    ),
    "dent": f"{BALL}{GRID}&surface kind = 'dent', amplitude = 0.02, width = 0.5 /\n",
    "boundary film": (
        "&contact load = 20.0, mean_velocity = 0.02, slide_to_roll = 0.1 /\n"
        "&lubricant boundary_film = 2e-8, boundary_friction = 0.1, shear_law = 'eyring' /\n"
        f"{GRID}&surface kind = 'harmonic', wavelength = 2.0, amplitude = 0.005 /\n"
    ),
    "predicted start": (
        f"{MOES}{GRID}&output frame_interval = 0.5 /\n"
        "&surface kind = 'harmonic', wavelength = 0.5, amplitude_over_film = 0.3 /\n"
        "&time start = 'prediction' /\n"
    ),
}
QUICK = ("coarser run fails", "predicted start")


def ended(solver: pyehl.Solver) -> dict[str, Any]:
    """Summary at the end, without times, and the frames."""
    solver.run()
    result = {name: value for name, value in solver.summary.items() if "seconds" not in name}
    frames = solver.dataset().get("frame_P")
    return result if frames is None else result | {"frames": frames.values.tobytes()}


def killed_and_resumed(case: pyehl.Case, folder: Path, advances: int) -> dict[str, Any] | None:
    """Summary of a run that was killed after a number of advances; None if it left no state."""
    with pyehl.Solver(case) as solver:
        solver.checkpoint(folder)
        for k in range(advances):
            solver.advance()
            if k % 5 == 0 or k > advances - 5:
                solver.save_state(at_once=True)
        if not solver.save_state(at_once=True):
            return None
    with pyehl.Solver(case) as solver:
        assert "resuming after step" in solver.resume(folder)
        return ended(solver)


@pytest.mark.filterwarnings("ignore:time.start")
@pytest.mark.parametrize(
    "kind",
    [name if name in QUICK else pytest.param(name, marks=pytest.mark.long) for name in CASES],
)
def test_whole_summary(kind: str, tmp_path: Path):
    case = pyehl.Case.from_text(CASES[kind])
    with pyehl.Solver(case) as solver:
        advances = sum(1 for _ in solver)
        whole = ended(solver)
    resumed = 0
    for share in (0.3, 0.5, 0.75, 0.95):
        result = killed_and_resumed(case, tmp_path / f"{share}", int(share * advances))
        if result is not None:
            assert result == whole
            resumed += 1
    assert resumed >= 2
    if kind == "coarser run fails":
        assert "next coarser grid ended with" in whole["mu_ratio_error_note"]
    if kind == "predicted start":
        assert whole["start"] == "prediction"


@pytest.mark.long
@pytest.mark.filterwarnings("ignore:time.start")
def test_steps_from_a_prediction_that_fail_after_a_resumption(tmp_path: Path):
    """They restart behind a front, as in a run that was not stopped."""
    heights = 2.2e-8 * np.random.default_rng(1).standard_normal((32, 32))
    np.save(tmp_path / "map.npy", heights)
    case = pyehl.Case.from_text(
        "",
        {"grid.points": 129}
        | {"time.start": "prediction", "time.estimate_error": False}
        | {"surface.kind": "map", "surface.file": tmp_path / "map.npy", "surface.rotate": 90.0}
        | {"surface.length_x": 8.29e-4, "surface.length_y": 8.29e-4}
        | {"output.frame_interval": 0.1},
    )
    before = again = 0
    with pyehl.Solver(case) as solver:
        for step in solver:
            if step.summary.get("start") == "prediction":
                before = step.number
            elif before and not again:
                again = step.number
        whole = ended(solver)
    assert "negative film" in whole["start_note"]
    assert before > 0
    assert whole["frames"]
    for advances in (before, again + 1, again + 40):
        folder = tmp_path / str(advances)
        result = killed_and_resumed(case, folder, advances)
        assert result == whole


@pytest.mark.parametrize("estimate_error", [True, False])
def test_waves_that_no_grid_resolves_are_named(estimate_error: bool):
    """Also if these waves are only in the run for the error: never '32 nodes or more'."""
    case = pyehl.Case(
        pyehl.Case.from_text(CASES["negative film"]), {"time.estimate_error": estimate_error}
    )
    with pyehl.Solver(case) as solver:
        solver.run()
        message = solver.summary["message"]
    assert "the shortest waves have 3 nodes, and as high as the film they need 32" in message
