# SPDX-License-Identifier: BSD-3-Clause
"""The infinite line contact: reference values, order, scales, borders, refusals."""

import json
import math
import subprocess
from pathlib import Path

import line_newton
import numpy as np
import pytest

import pyehl
from pyehl.cli import main
from pyehl.plots.figures import solution_figures
from pyehl.reports.folder import report
from pyehl.results import settings_of
from pyehl.theory.line_contact import LineContact, moes_film

DOMAIN = {"x_inlet": -4.0, "x_outlet": 1.5, "border": "zero"}
LINE = {"shape": "line", "load_per_length": 1.8e5, "radius": 0.01, "mean_velocity": 0.46}
SLIDING = {
    "contact.slide_to_roll": 0.3,
    "lubricant.shear_law": "eyring",
    "lubricant.flow": "newtonian",
}


def moes(moes_m: float, moes_l: float, points: int, **grid: object) -> pyehl.Case:
    return pyehl.Case(
        contact={"shape": "line", "moes_m_line": moes_m, "moes_l_line": moes_l},
        lubricant={"roelands_z": 0.68},
        grid={"points": points, **grid},
    )


def si_line(points: int = 257, **options: object) -> pyehl.Case:
    return pyehl.Case(contact=LINE, grid={"points": points}).with_options(options)


@pytest.mark.parametrize(("moes_m", "moes_l", "h_c", "h_min"), line_newton.FILMS)
def test_reference_values(moes_m, moes_l, h_c, h_min):
    result = pyehl.solve(moes(moes_m, moes_l, 1025, **DOMAIN))
    assert float(result.H_c_extrapolated) == pytest.approx(h_c, rel=3e-3)
    assert float(result.H_min_extrapolated) == pytest.approx(h_min, rel=3e-3)
    # the limit is within twice the stated error of the finest grid of the table
    assert abs(float(result.H_c) - h_c) < 2.0 * float(result.H_c_error) + 1e-3 * h_c


def test_independent_solver():
    films = [line_newton.solve(100.0, 10.0, n, 0.0135, (-4.0, 1.5)) for n in (550, 1100)]
    limits = [(4.0 * fine - coarse) / 3.0 for coarse, fine in zip(*films, strict=True)]
    assert limits == pytest.approx([0.01349, 0.01214], rel=2e-3)
    result = pyehl.solve(moes(100, 10, 1025, **DOMAIN))
    assert limits == pytest.approx(
        [float(result.H_c_extrapolated), float(result.H_min_extrapolated)], rel=2e-3
    )


def test_line_contact_has_order_two():
    cases = (moes(20, 10, points, **DOMAIN) for points in (257, 513, 1025, 2049))
    films = [float(pyehl.solve(case, {"solver.accuracy": 0.01}).H_c) for case in cases]
    steps = np.diff(films)
    assert np.log2(steps[:-1] / steps[1:]) == pytest.approx([2.0, 2.0], abs=0.05)


def test_few_cycles():
    # Newton steps on one row converge fast: two cycles per level
    result = pyehl.solve(moes(20, 10, 4097))
    assert int(result.total_cycles) <= 2 * 7 + 2
    assert abs(float(result.load_error)) < 1e-6


def test_same_bits(root, drivers, tmp_path):
    case = root / "cases" / "line.nml"
    folder = tmp_path / "out"
    subprocess.run([*drivers["ehl"], str(case), "-o", str(folder), "-q"], check=True)
    run, solved = pyehl.load(folder), pyehl.solve(case, {"solver.threads": 3})
    for name in ("P", "H", "p_Pa", "h_m", "H_c", "H_min_error"):
        np.testing.assert_array_equal(run[name], solved[name])
    assert run.P.shape == (1025, 1)
    text = json.loads((folder / "summary.json").read_text())
    assert text["shape"] == "line"
    assert "moes_m" not in text
    assert text["moes_m_line"] == pytest.approx(19.738, abs=1e-3)


def test_resolved_case_is_the_same_case():
    case = si_line()
    again = pyehl.Case.from_text(case.text)
    assert again.resolve() == case.resolve()
    assert case.resolve()["contact"]["shape"] == "line"
    assert "load" not in case.resolve()["contact"]
    assert "y_extent" not in case.resolve()["grid"]
    # nor does a point contact accept a key of a line
    assert not {"shape", "load_per_length"} & set(pyehl.Case().resolve()["contact"])


def test_scales_and_integrals_are_per_length():
    result = pyehl.solve(si_line(1025), SLIDING)
    line = LineContact.from_settings(settings_of(result))
    assert float(result.hertz_radius_m) == pytest.approx(line.half_width, rel=1e-12)
    assert float(result.hertz_pressure_Pa) == pytest.approx(line.hertz_pressure, rel=1e-12)
    assert float(result.moes_m_line) == pytest.approx(line.moes_m, rel=1e-12)
    x, p, h = result.x_m.values, result.p_Pa.values[:, 0], result.h_m.values[:, 0]
    mesh = x[1] - x[0]
    # the border has the pressure of the flooded inlet beyond it
    assert mesh * p.sum() == pytest.approx(line.load_per_length, rel=1e-3)
    lubricant = settings_of(result)["lubricant"]
    z, p0 = lubricant["roelands_z"], lubricant["roelands_p0"]
    eta = 0.04 * np.exp(2.2e-8 * p0 / z * ((1.0 + p / p0) ** z - 1.0))
    tau = 5e6 * np.arcsinh(eta * line.sliding_speed / h / 5e6)
    assert float(result.mu) == pytest.approx(mesh * tau.sum() / line.load_per_length, rel=1e-9)
    moment = line.radius * 0.25 * ((h[1:] + h[:-1]) * np.diff(p)).sum()
    assert float(result.rolling_moment_N) == pytest.approx(moment, rel=1e-9)


def test_thinning_and_heat():
    isothermal = float(pyehl.solve(si_line(513), SLIDING).mu)
    warm = pyehl.solve(si_line(513), SLIDING, {"lubricant.temperature_viscosity": 0.04})
    assert 0.9 * isothermal < float(warm.mu) < 0.99 * isothermal
    assert 0.0 < float(warm.temperature_rise_wall_1_max_K) < float(warm.temperature_rise_max_K)
    thinner = pyehl.solve(si_line(513), {**SLIDING, "lubricant.flow": "consistent"})
    assert float(thinner.mu) == pytest.approx(isothermal, rel=0.01)
    # a wall at rest under an endless line has no steady temperature
    at_rest = {"contact.slide_to_roll": 2.0, "lubricant.temperature_viscosity": 0.04}
    still = pyehl.solve(si_line(513), {**SLIDING, **at_rest})
    assert "a wall at rest under an infinite line" in still.attrs["mu_note"]
    assert math.isfinite(float(still.mu))


def test_moving_heat_source():
    """The flash temperature is that of a fast band of heat with a semi-elliptical flux."""
    result = pyehl.solve(si_line(513), SLIDING, {"lubricant.temperature_viscosity": 0.04})
    line = LineContact.from_settings(settings_of(result))
    flux = float(result.mu) * line.hertz_pressure * line.sliding_speed
    x = np.linspace(-1.0, 1.0, 4001)
    s = 0.5 * (x[1:] + x[:-1])
    # int sqrt(1 - x^2)/sqrt(s - x) dx, by exact integrals over cells
    rise = 0.0
    for at in np.linspace(0.0, 1.0, 201):
        inner = s < at
        ends = np.sqrt(np.maximum(at - x[:-1], 0.0)) - np.sqrt(np.maximum(at - x[1:], 0.0))
        rise = max(rise, float((2.0 * np.sqrt(1.0 - s**2) * ends)[inner].sum()))
    speeds = line.mean_velocity * (1.0 + np.array([0.15, -0.15]))
    own = flux * rise * np.sqrt(1.25e-5 * line.half_width / (np.pi * speeds)) / 46.0
    assert float(result.flash_temperature_K) == pytest.approx(1.0 / (1.0 / own).sum(), rel=2e-3)


def test_boundary_film():
    case = si_line(513, **{"lubricant.boundary_film": 2.5e-7, "lubricant.boundary_friction": 0.12})
    result = pyehl.solve(case, SLIDING)
    assert float(result.contact_load_share) > 0.9
    assert float(result.mu) == pytest.approx(0.12, rel=0.05)
    thin = pyehl.solve(case, SLIDING, {"lubricant.boundary_film": 1e-8})
    assert float(thin.contact_load_share) == 0.0


def test_target_error():
    for target, points in ((2e-3, 1025), (1e-3, 2049)):
        result = pyehl.solve(si_line(), {"grid.target_error": target})
        assert float(result.H_c_error_grid) <= target * float(result.H_c)
        assert int(result.points) == points


def test_inlet_too_short_for_a_flooded_film():
    short = pyehl.solve(moes(5, 20, 257, x_inlet=-1.1, border="flooded"))
    assert np.isnan(float(short.H_c_error))


@pytest.mark.parametrize(("moes_m", "moes_l"), [(3, 5), (20, 10), (100, 10), (1, 5)])
def test_flooded_border(moes_m, moes_l):
    far = moes(moes_m, moes_l, 2049, x_inlet=-14.5, x_outlet=1.5 if moes_m > 2 else 5.5)
    film = float(pyehl.solve(far).H_c_extrapolated)
    near = pyehl.solve(moes(moes_m, moes_l, 1025))
    error = float(near.H_c_error_domain)
    assert float(near.H_c_extrapolated) == pytest.approx(film, rel=1e-3)
    assert error < 1e-3 * film
    # P = 0 reduces the film, by no more than the stated error
    for inlet in (-2.0, -4.0):
        zero = pyehl.solve(moes(moes_m, moes_l, 1025, border="zero", x_inlet=inlet), check=False)
        lost = film - float(zero.H_c_extrapolated)
        assert lost > -1e-3 * film
        stated = float(zero.H_c_error_domain)
        assert lost < stated + 1e-3 * film or math.isnan(stated)
        assert moes_m > 20 or lost > 1e-3 * film


def test_formulas():
    # h/R (2U)^(-1/2) = 5.10 at (20, 10)
    assert 8.0 * 20.0 * moes_film(20.0, 10.0) / math.pi == pytest.approx(5.10, abs=5e-3)
    sheet = pyehl.film(moes(20, 10, 257)).summary
    names = [formula["name"] for formula in sheet["formulas"]]
    assert names == ["Moes, line", "Dowson-Higginson"]
    solved = pyehl.solve(moes(20, 10, 1025))
    assert sheet["formulas"][0]["H_c"] == pytest.approx(float(solved.H_c), rel=0.03)
    assert sheet["formulas"][1]["H_min"] == pytest.approx(float(solved.H_min), rel=0.03)
    text = repr(pyehl.film(si_line()))
    assert "Line contact" in text
    assert "180000 N/m" in text or "1.8e+05 N/m" in text


def test_plan_shows_m_of_line_and_point():
    plan = pyehl.check(si_line()).plan
    assert "M = 19.738, L = 9.9877" in plan
    assert "the round contact with the same speed parameter has M = 198.19" in plan
    assert "one row of nodes" in plan


def test_bodies():
    case = pyehl.Case(
        contact={"shape": "line", "load_per_length": 1e5},
        bodies={"radius_x1": 0.02, "radius_x2": 0.02, "modulus_1": 2.06e11, "modulus_2": 2.06e11},
    )
    contact = case.resolve()["contact"]
    assert contact["radius"] == pytest.approx(0.01)
    assert contact["reduced_modulus"] == pytest.approx(2.06e11 / 0.91)
    with pytest.raises(pyehl.InputError, match=r"bodies\.radius_y1 with contact\.shape"):
        case.with_options({"bodies.radius_y1": 0.1})


WITH_LINE = {
    "contact.load=100": "contact.load_per_length [N/m]",
    "contact.moes_m=20": "contact.moes_m_line: M and L of a line are defined differently",
    "contact.moes_l=20": "contact.moes_l_line: M and L of a line are defined differently",
    "contact.radius_y=0.01": "contact.radius alone",
    "contact.radius_ratio=0.1": "contact.radius alone",
    "contact.angle=10": "a line is perpendicular to the motion",
    "grid.y_extent=2": "the strip is one period of the surfaces wide",
    "grid.points_y=65": "the strip is one period of the surfaces wide",
    "solver.deflection='mlmi'": "multi-integration is not available for a periodic strip",
}


@pytest.mark.parametrize(("option", "remedy"), WITH_LINE.items())
def test_keys_refused_with_a_line(root, drive, tmp_path, option, remedy):
    case, key = root / "cases" / "line.nml", option.partition("=")[0]
    for driver in ("ehl", "pyehl"):
        run = drive(driver, case, "-o", "out", "--set", option)
        assert run.returncode == 2
        assert key in run.stderr
        assert "with contact.shape = 'line'" in run.stderr
        assert remedy in run.stderr
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("key", ["load_per_length", "moes_m_line", "moes_l_line"])
def test_keys_refused_with_a_point(root, drive, key):
    case = root / "cases" / "quick.nml"
    for driver in ("ehl", "pyehl"):
        run = drive(driver, case, "-o", "out", "--set", f"contact.{key}=10.0")
        assert run.returncode == 2
        assert f"contact.{key} in a point contact" in run.stderr
        assert "contact.shape = 'line', or contact." in run.stderr


def test_no_operating_point(root):
    case = root / "cases" / "line.nml"
    with pytest.raises(pyehl.InputError, match=r"contact\.shape = 'line'"):
        pyehl.OperatingPoint.from_settings(pyehl.Case(case).resolve())


def test_inlet_that_is_too_short():
    """A run that fails there suggests a longer inlet, not a finer grid."""
    with pytest.raises(pyehl.NotConverged) as info:
        pyehl.solve(moes(0.5, 5.0, 257, x_inlet=-1.2))
    message = info.value.results.attrs["message"]
    assert "leave out grid.x_inlet" in message
    assert "grid.points" not in message
    assert pyehl.solve(moes(0.5, 5.0, 257)).attrs["status"] == "converged"


def test_picture_and_report(root, tmp_path):
    result = pyehl.solve(root / "cases" / "line.nml", output=tmp_path / "out")
    figures = solution_figures(result)
    assert set(figures) == {"pressure_and_film"}
    assert figures["pressure_and_film"].axes[0].get_xlabel() == "x [mm]"
    page = report(tmp_path / "out", tmp_path / "page.html").read_text(encoding="utf-8")
    assert "load per length w" in page
    assert "half width b of the contact" in page
    assert "infinitely long" in page


def test_curve_of_a_line(tmp_path):
    """The title of its picture has the load per length."""
    case = tmp_path / "line.nml"
    case.write_text("&contact shape = 'line' /\n&surface kind = 'fractal' pixels = 64 /\n")
    assert main(["stribeck", str(case), "--speed", "0.5,1", "-o", str(tmp_path / "out")]) == 0
    assert (tmp_path / "out" / "stribeck.png").is_file()


def test_keys_of_a_line_in_messages(ehl: str, tmp_path: Path):
    """Messages about a line suggest keys of a line, by pyehl as by ehl."""
    keys = {"contact.shape": "line", "contact.load_per_length": 1e5, "contact.moes_m_line": 10.0}
    expected = "moes_m_line and moes_l_line, or load_per_length"
    with pytest.raises(pyehl.InputError, match=expected):
        pyehl.Case.from_text("", keys)
    case = tmp_path / "case.nml"
    case.write_text("&contact shape='line' load_per_length=1e5 moes_m_line=10 /\n")
    result = subprocess.run(
        [ehl, case, "-o", tmp_path / "out"], check=False, capture_output=True, text=True
    )
    assert result.returncode == 2
    assert expected in result.stderr
