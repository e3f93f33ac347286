# SPDX-License-Identifier: BSD-3-Clause
"""What must not change a result: threads, the driver, and use of symmetry."""

import json
import subprocess
from pathlib import Path

import numpy as np
import pytest

import pyehl

# Numbers that depend on the threads and their workspace; seconds are no results either
NOT_RESULTS = {"threads", "bytes"}
SIZE = {"surface.length_x": 8.29e-4, "surface.length_y": 8.29e-4}
HARMONIC = {
    "surface.kind": "harmonic",
    # The front lies behind the contact at the start: rough from the first step, less than H_min
    "surface.amplitude": 2e-3,
    "surface.x_start": 1.5,
    "time.steps": 12,
}
SHORT = {"time.steps": 2, "time.estimate_error": False}
FULL = {"solver.symmetry": "full"}


def results(folder: Path) -> dict[str, object]:
    """Everything in a folder except times and the number of threads."""
    content: dict[str, object] = {}
    for path in folder.iterdir():
        if path.name == "summary.json":
            summary = json.loads(path.read_text())
            content |= {
                name: value
                for name, value in summary.items()
                if name not in NOT_RESULTS and "seconds" not in name
            }
        elif path.suffix in (".nml", ".txt"):
            lines = path.read_text().splitlines()
            content[path.name] = [line for line in lines if "threads" not in line]
        else:
            content[path.name] = path.read_bytes()
    return content


@pytest.mark.parametrize("engine", ["mlmi", "fft"])
@pytest.mark.parametrize(
    # whole domains of 257 x 257 nodes are worked on by all threads; a run begins with the smooth
    # contact, whose fields are among its results
    ("points", "case"),
    [(129, HARMONIC), (257, FULL | HARMONIC | SHORT)],
    ids=["harmonic", "harmonic-whole"],
)
def test_threads(solve, points: int, case: dict[str, object], engine: str):
    settings = case | {"solver.deflection": engine}
    numbers = (1, 2, 4) if points < 257 else (1, 3)
    runs = [
        solve((1000.0, 10.0), points, settings | {"solver.threads": threads}, fields=True)
        for threads in numbers
    ]
    one, *others = runs
    assert tuple(run["threads"] for run in runs) == numbers
    assert one["status"] in ("converged", "not settled")  # a few steps give no mean
    expected = results(one.folder)
    assert {"P.npy", "H.npy", "P_smooth.npy", "H_smooth.npy", "history.csv", "H_c"} <= set(expected)
    assert all(results(other.folder) == expected for other in others)


@pytest.mark.parametrize("case", [HARMONIC, {"surface.kind": "fractal", "time.steps": 3}])
def test_drivers(drivers, tmp_path: Path, case: dict[str, object]):
    """A rough contact by `ehl` and by `pyehl run`: the same bits."""
    settings = case | {"grid.points": 65}
    if case["surface.kind"] == "fractal":
        # `ehl` reads the map that `pyehl` writes
        tile = tmp_path / "tile.npy"
        rng = np.random.default_rng(1)
        np.save(tile, 2e-8 * rng.standard_normal((8, 8)))
        settings |= {"surface.kind": "map", "surface.file": f"'{tile}'"} | SIZE
    options = [part for key, value in settings.items() for part in ("--set", f"{key}={value}")]
    (tmp_path / "case.nml").write_text(
        "&contact load = 20.0 /\n&grid x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0 /\n"
    )
    for driver, words in drivers.items():
        done = subprocess.run(
            [*words, "case.nml", "-o", driver, *options],
            cwd=tmp_path,
            capture_output=True,
            text=True,
            timeout=120,
            check=False,
        )
        # a mean of 12 steps has not settled
        assert (done.returncode, done.stderr) == (1, "")
    one, two = results(tmp_path / "ehl"), results(tmp_path / "pyehl")
    # Python adds sentences, and how it prepared a map
    assert two["files"].remove("plan.txt") is None
    two = {name: two[name] for name in one}
    # the values: `ehl` and `pyehl` write different comments
    cases = [pyehl.Case(tmp_path / name / "case.nml") for name in ("ehl", "pyehl")]
    assert cases[0] == cases[1]
    assert one | {"case.nml": ""} == two | {"case.nml": ""}


@pytest.mark.parametrize("point", [(200.0, 10.0), (1000.0, 10.0)])
@pytest.mark.parametrize("points", [129, 257])
def test_half_domain(solve, point: tuple[float, float], points: int):
    """Half the domain with folded kernels equals the whole domain to rounding."""
    half, whole = (
        solve(point, points, {"solver.symmetry": symmetry}, fields=True)
        for symmetry in ("auto", "full")
    )
    assert (half["half_domain"], whole["half_domain"]) == (True, False)
    assert half.converged
    assert whole.converged
    for name in ("P", "H"):
        a, b = half.field(name), whole.field(name)
        assert np.array_equal(a, a[:, ::-1])
        assert np.abs(a - b).max() <= 1e-10, name
    for name in ("H_c", "H_min", "F"):
        assert half[name] == pytest.approx(whole[name], rel=1e-10), name


@pytest.mark.parametrize("even", [True, False])
def test_half_domain_for_an_even_map(solve, tmp_path: Path, even: bool):
    """A tile whose rows mirror each other needs half the domain; any other needs all of it."""
    i, j = np.meshgrid(np.arange(32), np.minimum(np.arange(32), 32 - np.arange(32)), indexing="ij")
    tile = 1e-8 * np.cos(2 * np.pi * i / 16) * np.cos(2 * np.pi * j / 8)
    if not even:
        tile[:, 1] += 1e-10
    np.save(tmp_path / "map.npy", tile)
    settings = {
        "surface.kind": "map",
        "surface.file": f"'{tmp_path / 'map.npy'}'",
        **SIZE,
        "surface.x_start": 1.5,
        "time.steps": 12,
        "time.estimate_error": False,
    }
    run = solve(None, 65, settings, fields=True)
    assert run["half_domain"] is even
    if even:
        whole = solve(None, 65, settings | {"solver.symmetry": "full"}, fields=True)
        assert whole["half_domain"] is False
        for name in ("P", "H"):
            assert np.abs(run.field(name) - whole.field(name)).max() <= 1e-9, name
