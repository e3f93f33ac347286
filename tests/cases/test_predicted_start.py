# SPDX-License-Identifier: BSD-3-Clause
"""A rough run that starts from the predicted pressure: the same mean in fewer steps."""

import json
import math
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray

import pyehl
from pyehl import errors
from pyehl.cli import main
from pyehl.simulation import initial_condition
from pyehl.simulation.initial_condition import starting_pressure

POINT = {"contact.moes_m": 1000.0, "contact.moes_l": 10.0}
WAVE = POINT | {"surface.kind": "harmonic", "surface.amplitude": 4e-3}
ALONE = {"grid.points": 129, "time.estimate_error": False}
SECOND = {"second_surface.kind": "harmonic", "second_surface.amplitude": 3e-3}
WIDE = {"contact.radius_ratio": 0.35177}


def run(settings: dict[str, Any], start: str = "prediction") -> xarray.Dataset:
    """Run a case."""
    return pyehl.solve(pyehl.Case.from_text("", ALONE | settings | {"time.start": start}))


@pytest.fixture
def tile(tmp_path: Path) -> dict[str, Any]:
    """Options of a map of white noise, 20 nm rms."""
    heights = 2e-8 * np.random.default_rng(1).standard_normal((32, 32))
    np.save(tmp_path / "map.npy", heights)
    size = {"surface.length_x": 8.29e-4, "surface.length_y": 8.29e-4}
    return {"surface.kind": "map", "surface.file": tmp_path / "map.npy"} | size


@pytest.mark.parametrize(
    "settings",
    [
        WAVE,
        pytest.param(
            WAVE | {"surface.velocity_ratio": 0.8, "surface.wavelength_y": 1.0},
            marks=pytest.mark.long,
        ),
        pytest.param(WAVE | {"time.scheme": "paper"}, marks=pytest.mark.long),
        pytest.param({"surface.kind": "fractal"}, marks=pytest.mark.long),
        WAVE | WIDE,
        WAVE | SECOND | {"contact.slide_to_roll": 0.0, "second_surface.wavelength": 0.25},
    ],
    ids=["wave", "slow", "paper", "fractal", "ellipse", "together"],
)
def test_same_mean_in_fewer_steps(settings: dict[str, Any]):
    front, other = run(settings, "front"), run(settings)
    assert (front.attrs["start"], other.attrs["start"]) == ("front", "prediction")
    assert float(other.steps) <= 0.7 * float(front.steps)
    stop = float(front.mu_ratio_error_stop) + float(other.mu_ratio_error_stop)
    assert float(other.mu_ratio) == pytest.approx(float(front.mu_ratio), abs=stop)
    # an error that is not trivial
    assert stop < 0.01 * float(front.mu_ratio)


@pytest.mark.long
def test_a_pair_on_an_ellipse():
    """Each surface has its own front and speed; the mean is over whole periods of both."""
    pair = WAVE | WIDE | SECOND | {"contact.slide_to_roll": 0.25, "second_surface.wavelength": 1.0}
    front, other = run(pair, "front"), run(pair)
    assert other.attrs["start"] == "prediction"
    assert float(other.steps) <= 0.85 * float(front.steps)
    stop = float(front.mu_ratio_error_stop) + float(other.mu_ratio_error_stop)
    assert float(other.mu_ratio) == pytest.approx(float(front.mu_ratio), abs=stop)
    assert stop < 1e-3
    # the film of the first steps is near its mean
    first, rise = float(other.history_mu_ratio[0]), float(front.mu_ratio) - 1.0
    assert first - 1.0 == pytest.approx(rise, rel=0.5)


def test_the_coarser_run_has_the_same_start():
    """Its mean, and thus the grid error, is that of the run behind a front."""
    wave = {"surface.kind": "harmonic", "surface.amplitude": 5e-3, "time.estimate_error": True}
    point = {"contact.moes_m": 200.0, "contact.moes_l": 10.0}
    front, other = run(point | wave, "front"), run(point | wave)
    assert other.attrs["start"] == "prediction"
    stop = float(front.mu_ratio_error_stop) + float(other.mu_ratio_error_stop)
    assert float(other.mu_ratio_error_grid) > 0.0
    assert float(other.mu_ratio_error_grid) == pytest.approx(
        float(front.mu_ratio_error_grid), abs=2.0 * stop
    )


@pytest.mark.long
def test_every_surface_lies_where_the_prediction_has_it(
    tile: dict[str, Any], monkeypatch: pytest.MonkeyPatch
):
    """The initial pressure, followed to the end of the run, is the simulated one: to 0.1 a."""
    given: list[Any] = []

    def keep(*arguments: Any) -> Any:
        given.append(arguments)
        return starting_pressure(*arguments)

    monkeypatch.setattr(initial_condition, "starting_pressure", keep)
    for settings in (
        WAVE,
        tile,
        tile | {"surface.edges": "mirror", "surface.track": 1.3e-4},
        tile | {"surface.edges": "periodic", "surface.track": 1.3e-4},
    ):
        result = run(settings)
        assert result.attrs["start"] == "prediction"
        case, tiles, x, y, fronts = given.pop()
        times = result.history_T.values
        run_for = times[-1] - times[0] + (times[1] - times[0])
        inside = np.hypot(*np.meshgrid(x, y, indexing="ij")) < 0.7
        simulated = (result.P - result.P_smooth).values[inside]
        place = fronts[0, 0] + case["surface"]["velocity_ratio"] * run_for
        early, there, late = (
            np.corrcoef(
                starting_pressure(case, tiles, x, y, np.array([[at]]))[inside, 0], simulated
            )
            for at in (place - 0.1, place, place + 0.1)
        )
        # 0.978 to 0.994 on this grid
        assert there[0, 1] > 0.97
        assert max(early[0, 1], late[0, 1]) < 0.5


@pytest.mark.long
def test_heights_in_memory_start_from_the_prediction(tile: dict[str, Any]):
    heights = np.load(tile["surface.file"])
    size = (tile["surface.length_x"], tile["surface.length_y"])
    case = pyehl.Case.from_text("", ALONE | {"time.start": "prediction"})
    by_name = run(tile)
    given = pyehl.solve(case, surface=pyehl.Topography(heights, size=size))
    assert float(given.mu_ratio) == pytest.approx(float(by_name.mu_ratio), rel=1e-12)
    assert given.attrs["start"] == "prediction"


@pytest.mark.parametrize(
    ("settings", "why"),
    [
        (WAVE | {"contact.moes_m": 20.0}, "moes_m outside the range of the prediction"),
        (
            POINT | {"surface.kind": "dent", "surface.amplitude": 1e-3},
            "a single feature passes once",
        ),
        (WAVE | SECOND | {"contact.slide_to_roll": 2.0}, "one of the surfaces is at rest"),
        (WAVE | WIDE | {"contact.angle": 20.0}, "contact.angle = 20"),
        (WAVE | {"grid.target_error": 0.1}, "the grid of grid.target_error is not known yet"),
        (WAVE | {"surface.amplitude": 0.1}, "the pressures are beyond a linear response"),
    ],
    ids=["M", "dent", "rest", "turned", "target", "amplitude"],
)
def test_without_a_prediction_a_front_enters(settings: dict[str, Any], why: str):
    case = pyehl.Case.from_text("", ALONE | settings | {"time.start": "prediction"})
    with pyehl.Solver(case) as solver:
        while "start" not in solver.summary and not solver.done:
            solver.advance()
        summary = solver.summary
    assert summary["start"] == "front"
    assert why in summary["start_note"]


@pytest.mark.long
def test_failed_steps_restart_behind_a_front(tile: dict[str, Any]):
    """On this grid the film of this tile, 23 nm rms, becomes negative in the first steps."""
    np.save(tile["surface.file"], 1.15 * np.load(tile["surface.file"]))
    turned = tile | {"surface.rotate": 90.0}
    other, front = run(turned), run(turned, "front")
    assert other.attrs["start"] == "front"
    assert "negative film" in other.attrs["start_note"]
    assert float(other.mu_ratio) == float(front.mu_ratio)
    assert np.array_equal(other.history_mu_ratio, front.history_mu_ratio)


@pytest.mark.parametrize("fault", [ValueError, ZeroDivisionError, errors.InternalError])
def test_a_fault_of_the_package_is_no_warning(monkeypatch, fault: type[Exception]):
    """A fault of the package ends the run; after an error by the case it starts with a front."""

    def fails(*_: object) -> None:
        raise fault("wrong")

    monkeypatch.setattr(initial_condition, "starting_pressure", fails)
    case = ALONE | WAVE | {"grid.points": 33, "time.start": "prediction"}
    with pytest.raises(fault, match="wrong"):
        pyehl.solve(pyehl.Case.from_text("", case))


def test_program_refuses_a_predicted_start(ehl: str, tmp_path: Path):
    (tmp_path / "case.nml").write_text(
        "&time start = 'prediction' /\n&surface kind = 'fractal' /\n"
    )
    words = [ehl, "case.nml", "-o", "out", "--set", "grid.points=129"]
    done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert "time.start = 'prediction'" in done.stderr
    assert "expected: time.start = 'front', or 'pyehl run'" in done.stderr
    assert not (tmp_path / "out").exists()


def test_a_run_that_is_stopped_is_resumed_to_the_same_bits(tmp_path: Path):
    case = pyehl.Case.from_text("", ALONE | WAVE | {"time.start": "prediction"})
    path = tmp_path / "case.nml"
    path.write_text(case.text)
    assert main(["run", str(path), "-o", str(tmp_path / "whole")]) == 0
    with pyehl.Solver(case) as solver:
        solver.checkpoint(tmp_path / "part")
        for step in solver:
            if step.summary.get("steps") == 20:
                break
        solver.save_state(at_once=True)
    assert main(["run", "--resume", str(tmp_path / "part")]) == 0
    whole, part = (
        json.loads((tmp_path / name / "summary.json").read_text()) for name in ("whole", "part")
    )
    assert math.isfinite(whole["mu_ratio"])
    for name in ("start", "steps", "mu_ratio", "mu_ratio_error_stop"):
        assert part[name] == whole[name]
