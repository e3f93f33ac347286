# SPDX-License-Identifier: BSD-3-Clause
"""Slender and wide elliptical contacts: the grids that they need, and refusals."""

import json
import re
from pathlib import Path

import pytest
from scipy.special import elliprd
from test_ellipse import RATIO_OF_TEN

import pyehl
from pyehl.theory.ellipse import ellipse


@pytest.mark.parametrize(
    ("ratio", "moes_m", "border"), [(25.0, 3.0, "flooded"), (60.0, 8.0, "zero")]
)
def test_default_sides_of_a_narrow_contact(solve, ratio: float, moes_m: float, border: str):
    """The default domain against one three times as wide: changes are below the stated error."""
    keys = {"contact.radius_ratio": ratio, "grid.border": border, "solver.accuracy": 0.005}
    near = solve((moes_m, 8.0), 129, keys)
    rows = 3 * (near["points_y"] - 1) + 1
    side = 0.5 * (near["points_y"] - 1) * near["y_mesh"]
    wide = {"grid.y_extent": 3.0 * side, "grid.points_y": rows}
    far = solve((moes_m, 8.0), 129, keys | wide)
    assert side < 1.0
    for name in ("H_c", "H_min"):
        change = abs(near[name] - far[name])
        assert change < 1.5e-3 * far[name]
        assert change < near[f"{name}_error_domain"]


def test_too_coarse_a_grid_names_one_that_will_do(drive, tmp_path: Path):
    """A narrow contact with a thin film: plan and result state the necessary number of nodes."""
    narrow = {"contact.radius_ratio": 25.0, "contact.moes_m": 20.0, "contact.moes_l": 10.0}
    case = pyehl.Case.from_text("", narrow | {"grid.points": 33})
    assert "warning    the grid is too coarse for a solution" in str(pyehl.check(case))
    (tmp_path / "case.nml").write_text(case.text)
    done = drive("pyehl", "case.nml", "-o", "out")
    assert done.returncode == 1
    (points,) = re.findall(
        r"^assessment .*: the grid is too coarse .*: grid.points = (\d+) or more$",
        done.stdout,
        re.MULTILINE,
    )
    done = drive("pyehl", "case.nml", "-o", "fine", "--set", f"grid.points={points}")
    assert done.returncode == 0, done.stdout
    assert "warning" not in done.stdout
    assert json.loads((tmp_path / "fine" / "summary.json").read_text())["restarts"] == 0


@pytest.mark.long
@pytest.mark.parametrize("moes_l", [5.0, 10.0, 15.0])
def test_wide_thin_films_converge_with_damped_cycles(solve, moes_l: float):
    """Full cycles diverge, damped ones do not: no restart. H_c as on a finer grid."""
    shape = ellipse(RATIO_OF_TEN)
    scale = shape.ellipticity * shape.kernel_ratio**0.25
    point = 1000.0 * scale, moes_l / shape.kernel_ratio**0.75
    done = solve(point, 129, {"contact.radius_ratio": RATIO_OF_TEN})
    assert done.converged
    assert done["restarts"] == 0
    assert done["cycles"] < 20
    finer = solve(point, 257, {"contact.radius_ratio": RATIO_OF_TEN})
    assert finer.converged
    assert finer["H_c"] - done["H_c"] == pytest.approx(done["H_c_error_grid"], rel=0.5)


def test_a_failed_contact_names_a_finer_grid(solve):
    done = solve((200.0, 10.0), 65, {"solver.max_cycles": 2}, words=True)
    assert done["status"] == "cycle limit"
    assert "give a finer grid (grid.points = 129)" in done["assessment"]


@pytest.mark.parametrize("kappa", [0.1, 0.2, 0.5, 2.0, 5.0, 10.0])
@pytest.mark.long
def test_radius_ratios_from_0_1_to_10(solve, kappa: float):
    """Thick and thin films, with M and L of the round contact with the same equations."""
    shape = ellipse(float(elliprd(0.0, 1.0, kappa**2) / elliprd(0.0, kappa**2, 1.0)))
    for m, ell in ((20.0, 2.0), (20.0, 15.0), (120.0, 5.0)):
        point = m * kappa * shape.kernel_ratio**0.25, ell / shape.kernel_ratio**0.75
        done = solve(
            point, 129 if kappa > 0.15 else 257, {"contact.radius_ratio": shape.radius_ratio}
        )
        assert done.converged, (m, ell, done.summary["status"])


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["contact.radius_x=0.01"], "radius_x without contact.radius_y"),
        (["contact.radius_y=0.01"], "radius_y without contact.radius_x"),
        (
            ["contact.radius=0.01", "contact.radius_x=0.01", "contact.radius_y=0.01"],
            "contact.radius_x contradicts contact.radius",
        ),
        (["contact.radius_x=-0.01", "contact.radius_y=0.01"], "out of range"),
        (["contact.radius_ratio=2", "contact.load=10"], "contradicts contact.radius_ratio"),
        (["contact.radius_x=100", "contact.radius_y=0.01"], "radius_x/radius_y is"),
        (["bodies.radius_x1=0.01", "contact.radius=0.01"], "contact.radius contradicts bodies"),
        (
            ["bodies.radius_x1=0.01", "bodies.radius_y1=0.01", "bodies.radius_y2=-0.009"],
            "bodies.radius_y1 .* the gap does not open",
        ),
        (
            ["bodies.radius_x1=5e-6", "bodies.radius_y1=0.01"],
            "contact.radius_x = 5e-6 follows from the bodies",
        ),
        (
            ["bodies.radius_x1=0.01", "bodies.radius_y1=0.01", "bodies.modulus_1=1e3"],
            "contact.reduced_modulus = .* follows from the bodies",
        ),
        (
            ["contact.radius_ratio=0.2", "contact.angle=20", "grid.border=flooded"],
            "a rotated contact is not known",
        ),
        (
            ["contact.radius_ratio=0.2", "contact.angle=80", "grid.x_outlet=1.5"],
            "grid.x_outlet is .* the contact reaches to",
        ),
        (
            ["contact.radius_ratio=0.2", "grid.y_extent=1.2"],
            "y_extent is .* the contact reaches to",
        ),
        (["contact.radius_ratio=0.2", "grid.points=65", "grid.points_y=67"], "65 nodes along X"),
    ],
)
def test_refusals(options: list[str], message: str):
    with pytest.raises(pyehl.InputError, match=message):
        pyehl.check(pyehl.Case.from_text("", options))


def test_functions_for_circles_refuse_ellipses():
    case = pyehl.Case.from_text(
        "&contact radius_x = 0.01 radius_y = 0.02 / &surface kind = 'fractal' /"
        "&psd reduction = 'amplitude' smooth = 'hertz' /"
    )
    with pytest.raises(pyehl.InputError, match="for circular contacts"):
        pyehl.predict(case)


@pytest.mark.parametrize(
    ("kappa", "round_m"),
    [
        pytest.param(0.1, 400.0, marks=pytest.mark.long),
        pytest.param(1.0 / 30.0, 50.0, marks=pytest.mark.slow),
    ],
)
def test_cells_that_a_narrow_contact_needs(kappa: float, round_m: float):
    """They are the default; where longer ones give no film the message suggests shorter ones."""
    square = kappa**2
    ratio = float(elliprd(0.0, 1.0, square) / elliprd(0.0, square, 1.0))
    keys = {
        "contact.moes_m": round_m * kappa * ellipse(ratio).kernel_ratio ** 0.25,
        "contact.moes_l": 10.0,
        "contact.radius_ratio": ratio,
        "grid.points": 257,
    }
    with pyehl.Solver(pyehl.Case.from_text("", keys)) as solver:
        assert solver.run()
        default = solver.summary
    long = {"grid.y_extent": 2.0, "grid.points_y": 1025}
    with pyehl.Solver(pyehl.Case.from_text("", keys | long)) as solver:
        assert not solver.run()
        summary = solver.summary
    assert (summary["H_c"], summary["status"]) == (None, "negative film")
    named = re.findall(r"(\w+\.\w+) = ([\d.]+)", summary["assessment"])
    assert [key for key, _ in named] == ["grid.y_extent", "grid.points_y", "solver.max_cycles"]
    result = []
    for wider in (1.0, 1.5):
        remedy = {key: float(value) if "." in value else int(value) for key, value in named}
        remedy["grid.y_extent"] *= wider
        remedy["grid.points_y"] = round((remedy["grid.points_y"] - 1) * wider) + 1
        with pyehl.Solver(pyehl.Case.from_text("", keys | remedy)) as solver:
            assert solver.run()
            result.append(solver.summary)
    for name in ("H_c", "H_min"):
        assert abs(default[name] - result[0][name]) <= default[f"{name}_error"]
    # the sides of the domain are far enough
    assert result[0]["H_c"] == pytest.approx(result[1]["H_c"], rel=3e-5)
    assert result[0]["H_min"] == pytest.approx(result[1]["H_min"], rel=1e-4)
