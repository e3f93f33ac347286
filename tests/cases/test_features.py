# SPDX-License-Identifier: BSD-3-Clause
"""Single features that pass the contact once: closed forms, limits, symmetry, extremes, end."""

import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pyehl
from pyehl import Case, cli
from pyehl.schema import summary_of
from pyehl.surfaces import FEATURES

POINT = (200.0, 10.0)
DENT: dict[str, object] = {
    "surface.kind": "dent",
    "surface.width": 0.8,
    "surface.amplitude": 0.05,
    "surface.velocity_ratio": 1.0,
    "time.estimate_error": False,
}
# 33 nodes per side resolve M = 200 only on the smallest domain
SMALL = {"grid.x_inlet": -2.5, "grid.x_outlet": 1.5, "grid.y_extent": 2.0}
TIGHT = {"solver.accuracy": 1e-4}


def form(kind: str, x: Any, y: Any, width: float, length: float, angle: float) -> Any:
    """The closed form with height 1, implemented once more."""
    turn = np.radians(angle)
    across = (x * np.cos(turn) + y * np.sin(turn)) / width
    along = y * np.cos(turn) - x * np.sin(turn)
    sign = 1.0 if kind in ("bump", "ridge") else -1.0
    if kind in ("dent", "bump"):
        square = across**2 + (along / (length or width)) ** 2
        return sign * 10.0 ** (-10.0 * square) * np.cos(2.0 * np.pi * np.sqrt(square))
    profile = sign * 10.0 ** (-10.0 * across**2) * np.cos(2.0 * np.pi * across)
    if length:
        profile = profile * 10.0 ** (
            -10.0 * (np.maximum(0.0, abs(along) - length / 2) / width) ** 2
        )
    return profile


@pytest.mark.parametrize("kind", FEATURES)
@pytest.mark.parametrize(("length", "angle"), [(0.0, 0.0), (1.4, 30.0), (1.4, 90.0)])
def test_closed_forms(kind: str, length: float, angle: float, solve: Any):
    """Heights that the solver adds to the film, at zero velocity."""
    shape = {"kind": kind, "width": 0.6, "length": length, "angle": angle, "y_start": 0.25}
    rest = {"velocity_ratio": 0.0, "x_start": 0.1, "amplitude": 0.004}
    keys = {f"surface.{key}": value for key, value in (shape | rest).items()}
    keys["time.estimate_error"] = False
    done = solve(POINT, 33, keys | SMALL, fields=True)
    assert not done["half_domain"]
    x, y = np.meshgrid(done.field("X") - 0.1, done.field("Y") - 0.25, indexing="ij")
    expected = 0.004 * form(kind, x, y, 0.6, length, angle)
    # without the tail below the rounding of the height
    np.testing.assert_allclose(done.field("RR"), expected, rtol=0.0, atol=1e-15)


def test_sizes_in_metres():
    """width_m, length_m and height_m are the sizes in a and a^2/R times these."""
    case = Case.from_text("&contact load = 120.0 slide_to_roll = 0.0 / &grid points = 65 /")
    point = pyehl.theory.operating.OperatingPoint.from_settings(case.resolve())
    radius, scale = point.hertz_radius, point.film_scale
    stop = ("surface.kind=bump", "time.steps=3", "time.estimate_error=.false.")
    metric = case.with_options(
        *stop, f"surface.width_m={0.8 * radius}", f"surface.height_m={0.03 * scale}"
    )
    plain = case.with_options(*stop, "surface.width=0.8", "surface.amplitude=0.03")
    share = case.with_options(*stop, "surface.width=0.8", "surface.amplitude_over_film=0.4")
    with pyehl.Solver(metric) as one, pyehl.Solver(plain) as other, pyehl.Solver(share) as third:
        for solver in (one, other, third):
            solver.run()
        np.testing.assert_allclose(one.field("RR"), other.field("RR"), rtol=1e-12, atol=1e-17)
        summary = third.summary
        # a share of the film of the case, which is the same on grids of any size
        with pyehl.Solver(share, "grid.points=257") as fine:
            fine.run()
            assert summary["amplitude"] == pytest.approx(fine.summary["amplitude"], rel=2e-3)
            limit = fine.summary["H_c_extrapolated"]
        assert summary["amplitude"] == pytest.approx(0.4 * limit, rel=2e-3)
        assert summary["amplitude"] > 0.41 * summary["H_c"]
    # and a written case reads back
    again = Case.from_text(metric.text)
    assert again.resolve()["surface"]["width_m"] == pytest.approx(0.8 * radius)
    assert "width" not in again.resolve()["surface"]


def test_half_domain(solve: Any):
    """A feature symmetric in Y is solved on half the domain: the result is that of the whole."""
    half = solve(POINT, 65, DENT | TIGHT)
    whole = solve(POINT, 65, DENT | TIGHT | {"solver.symmetry": "full"})
    assert half["half_domain"]
    assert not whole["half_domain"]
    # algebraic errors
    for name in ("mu_ratio", "P_max_rough", "H_min_rough", "H_ratio_min"):
        assert half[name] == pytest.approx(whole[name], rel=1e-4), name
    assert half["P_rise_max"] == pytest.approx(whole["P_rise_max"], rel=1e-3)
    aside = solve(POINT, 33, DENT | {"surface.y_start": 0.25, "time.steps": 1})
    turned = {"surface.kind": "groove", "surface.angle": 30.0, "time.steps": 1}
    assert not aside["half_domain"]
    assert not solve(POINT, 33, DENT | turned)["half_domain"]
    assert solve(POINT, 33, DENT | {"surface.length": 0.4, "time.steps": 1})["half_domain"]


def test_small_features_are_linear(solve: Any):
    """Twice the depth gives twice the change, a bump the opposite of a dent."""
    # when the feature is half way through the contact
    stop = {"time.steps": 45, "grid.points": 65}

    def change(kind: str, amplitude: float) -> tuple[Any, Any]:
        keys = DENT | TIGHT | stop | {"surface.kind": kind, "surface.amplitude": amplitude}
        done = solve(POINT, 65, keys, fields=True)
        assert done["steps"] == 45
        return (done.field("P") - done.field("P_smooth"), done.field("H") - done.field("H_smooth"))

    small, twice, bump = change("dent", 1e-3), change("dent", 2e-3), change("bump", 1e-3)
    for one, two, other in zip(small, twice, bump, strict=True):
        maximum = np.abs(one).max()
        # the second order in 1e-3/H_c
        assert np.abs(two - 2.0 * one).max() < 0.05 * maximum
        assert np.abs(other + one).max() < 0.05 * maximum
    keys = DENT | TIGHT | {"surface.amplitude": 1e-7}
    none = solve(POINT, 65, keys)
    assert none.converged
    assert none["mu_ratio"] == pytest.approx(1.0, abs=1e-5)
    assert none["P_rise_max"] < 1e-4
    assert none["H_ratio_min"] == pytest.approx(1.0, abs=1e-4)


def test_extremes_and_the_end(solve: Any):
    """The extremes are those of all steps; the run ends when the feature has left."""
    done = solve(POINT, 65, DENT, fields=True)
    assert done.converged
    history = done.history
    at = int(np.argmax(history["P_max"]))
    assert done["P_max_rough"] == pytest.approx(history["P_max"][at], rel=1e-12)
    assert done["P_max_rough_T"] == pytest.approx(history["T"][at], rel=1e-12)
    at = int(np.argmin(history["H_min"]))
    assert done["H_min_rough"] == pytest.approx(history["H_min"][at], rel=1e-12)
    assert done["H_min_rough_T"] == pytest.approx(history["T"][at], rel=1e-12)
    for name in ("P_max_rough", "H_min_rough", "P_rise_max", "H_ratio_min"):
        assert done[f"{name}_X"] ** 2 + done[f"{name}_Y"] ** 2 < 1.1
    assert done["mu_ratio_min"] <= done["mu_ratio"] <= done["mu_ratio_max"]
    assert np.trapezoid(history["mu_ratio"], history["T"]) == pytest.approx(
        done["mu_ratio"] * (history["T"][-1] - history["T"][0]), rel=1e-3
    )
    # its end, 1.2 widths behind its front, at X = 1.05; steps are as long as the mesh
    start = done.field("X")[0]
    assert 0.0 <= done["T"] - (1.05 - start + 1.2 * 0.8) <= 2.5 * done["x_mesh"]
    # and the contact is the smooth one again
    left = np.abs(done.field("P") - done.field("P_smooth")).max()
    assert left < 0.02 * done["P_rise_max"]
    early = solve(POINT, 65, DENT | {"time.skip_start": False})
    assert early["steps_skipped"] == 0
    assert early["T"] == pytest.approx(done["T"], abs=done["x_mesh"])
    assert early["mu_ratio"] == pytest.approx(done["mu_ratio"], rel=1e-4)
    assert early["P_rise_max"] == pytest.approx(done["P_rise_max"], rel=1e-2)


@pytest.mark.parametrize("ratio", [0.6, 1.0, 1.6])
def test_film_moves_with_the_mean_velocity(ratio: float, solve: Any):
    """The contact convects the film that the inlet produces, as nothing flows by pressure there.

    So at any velocity of a small dent, the change that it makes in the film moves at the mean one.
    """
    keys = DENT | {
        "surface.velocity_ratio": ratio,
        "surface.amplitude": 5e-3,
        "output.frame_interval": 0.0625,
        "solver.accuracy": 0.01,
    }
    done = solve(POINT, 129, keys, fields=True)
    x, row = done.field("X"), 64
    times, frames = done.field("frame_T"), done.field("frame_H")
    change = frames[:, row, :] - done.field("H_smooth")[:, row, None]
    inside = np.abs(x) < 0.75
    # where the film is thickest, while that is well inside the contact
    maximum, place = change[inside].max(axis=0), x[inside][change[inside].argmax(axis=0)]
    here = (maximum > 0.8 * maximum.max()) & (np.abs(place) < 0.7)
    assert here.sum() >= 15
    speed = np.polyfit(times[here], place[here], 1)[0]
    # a mesh size over the distance of 1.4 a
    assert speed == pytest.approx(1.0, abs=0.022)


def test_bump_higher_than_the_film(solve: Any):
    """A bump higher than the film ends the run with a negative film, without results."""
    done = solve(POINT, 65, DENT | {"surface.kind": "bump", "surface.amplitude": 0.3})
    assert done.code == 1
    assert done["status"] == "negative film"
    assert done["P_max_rough"] is None
    assert done["mu_ratio"] is None


def test_resume(ehl: str, tmp_path: Path):
    """A resumed run keeps the extremes from before the stop."""
    case = tmp_path / "case.nml"
    case.write_text(
        "&contact moes_m = 200.0 moes_l = 10.0 slide_to_roll = 0.0 /\n&grid points = 65 /\n"
        "&surface kind = 'groove' width = 0.8 amplitude = 0.05 /\n"
    )

    def run(*words: str) -> int:
        return subprocess.run([ehl, *words, "--quiet"], cwd=tmp_path, check=False).returncode

    assert run("case.nml", "-o", "whole") == 0
    assert run("case.nml", "-o", "parts", "--set", "time.steps=20") == 1
    assert run("--resume", "parts", "--set", "time.steps=0") == 0
    whole, parts = (summary_of(pyehl.load(tmp_path / name)) for name in ("whole", "parts"))
    names = [name for name in whole if name.startswith(("P_", "H_", "mu_", "T"))]
    assert len(names) > 20
    assert {name: whole[name] for name in names} == {name: parts[name] for name in names}


def test_commands(tmp_path: Path, cases: Path, capsys: pytest.CaptureFixture[str]):
    """Plan, tile, prediction, picture and movie: there is neither a tile nor a prediction."""
    dent = str(cases / "dent.nml")
    assert cli.main(["check", dent]) == 0
    plan = capsys.readouterr().out
    assert "a dent passes once" in plan
    assert "in the inlet have left" in plan
    assert cli.main(["surface", dent, "-o", str(tmp_path / "dent.npy")]) == 2
    assert "surface.kind = 'dent' is no tile" in capsys.readouterr().err
    assert cli.main(["predict", dent, "-o", str(tmp_path / "psd")]) == 2
    assert "passes once" in capsys.readouterr().err
    assert not (tmp_path / "psd").exists()
    words = ["--set", "grid.points=65", "--set", "output.frame_interval=4"]
    assert cli.main(["run", dent, "-q", "-o", str(tmp_path / "out"), *words]) == 0
    assert cli.main(["plot", str(tmp_path / "out"), "--dpi", "60"]) == 0
    assert cli.main(["plot", str(tmp_path / "out"), "--movie"]) == 0
    assert {"extremes.png", "movie.gif"} <= {path.name for path in (tmp_path / "out").iterdir()}
