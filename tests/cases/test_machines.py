# SPDX-License-Identifier: BSD-3-Clause
"""Contacts of machine elements: the cases of the how-tos, and the numbers on their pages."""

import json
import math
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from document_text import plain
from machines import KINDS, SETTINGS, draw, timed
from scipy.special import elliprd

import pyehl
from pyehl.conclusion import conclude
from pyehl.contact.film_formulas import report
from pyehl.schema import summary_of
from pyehl.theory.ellipse import ellipse

NUMBER = re.compile(r"\d+\.\d+(?:E[-+]\d+)?")


def texts(page: Path) -> list[str]:
    """Lines that a page shows as printed output."""
    blocks = re.findall(r"^```text\n(.*?)^```$", page.read_text(encoding="utf-8"), re.M | re.S)
    return [line for block in blocks for line in block.splitlines()]


def same(shown: list[str], printed: str) -> None:
    """Each line is printed, number by number; residuals may differ, and '...' is for others."""
    lines = {NUMBER.sub("#", line): line for line in printed.splitlines()}
    for line in shown:
        if line == "...":
            continue
        other = lines[NUMBER.sub("#", line)]
        kept = [NUMBER.findall(text.partition("residual")[0]) for text in (line, other)]
        for a, b in zip(*kept, strict=True):
            assert float(b) == pytest.approx(float(a), rel=2e-3), line


def row_of(text: str) -> str:
    """The films of the last lines as in the table of the page."""
    films = [re.findall(rf"{name} ([\d.]+) \+- ([\d.]+) nm", text)[0] for name in ("h_c", "h_min")]
    return " | ".join(f"{film} ± {error} nm" for film, error in films)


def test_ball_bearing(root: Path, drive, tmp_path: Path):
    case, page = root / "cases" / "ball_bearing.nml", root / "docs" / "howto" / "bearing.md"
    run = drive("pyehl", case, "-o", "out")
    assert run.returncode == 0, run.stdout
    sheet = pyehl.film(case).summary
    same(texts(page), f"{report(sheet)}\n{run.stdout}")
    result = summary_of(pyehl.load(tmp_path / "out"))
    text = page.read_text(encoding="utf-8")
    assert f"| solved on 257 × 1281 nodes | {row_of(text)} |" in text
    unit = result["film_scale_m"] * 1e9
    films = [result[f"{name}_extrapolated"] * unit for name in ("H_c", "H_min")]
    assert f"| {films[0]:.1f} nm | {films[1]:.1f} nm |" in text
    # the formulas are those of its regime
    for formula in (f for f in sheet["formulas"] if f["applies"]):
        minimum = f" {formula['h_min_m'] * 1e9:.1f} nm |" if formula["h_min_m"] else ""
        assert f"| {formula['h_c_m'] * 1e9:.1f} nm |{minimum}" in text
    assert f"{result['rolling_moment_N_m'] * 1e4:.2f}·10⁻⁴ N m" in text
    assert f"is {1 - result['H_min'] / result['H_c']:.0%} below".replace("%", " %") in text
    # bearing, speed and load determine the case
    given = pyehl.Case(case).resolve()
    ball, pitch = 7.938e-3, 33.5e-3
    assert given["bodies"]["radius_x1"] == pytest.approx(0.5 * ball)
    assert given["bodies"]["radius_x2"] == pytest.approx(0.5 * (pitch - ball), rel=1e-3)
    assert given["bodies"]["radius_y2"] == pytest.approx(-0.52 * ball, rel=1e-3)
    speed = 2.0 * 3.14159265 * 3000.0 / 60.0 * pitch / 4.0 * (1.0 - (ball / pitch) ** 2)
    assert given["contact"]["mean_velocity"] == pytest.approx(speed, rel=2e-3)
    assert given["contact"]["load"] == pytest.approx(5.0 * 500.0 / 8.0)


@pytest.mark.long
def test_gear_pair(root: Path, drive, tmp_path: Path):
    """The page has the numbers of the record, and the record those of the smooth contact."""
    case, page = root / "cases" / "gear_pair.nml", root / "docs" / "howto" / "gear.md"
    text = plain(page)
    record = json.loads(page.with_suffix(".json").read_text(encoding="utf-8"))
    assert f"| solved on 97 nodes along the motion | {row_of(text)} |" in text
    unit = record["film_scale_m"] * 1e9
    films = [record[f"{name}_extrapolated"] * unit for name in ("H_c", "H_min")]
    assert f"| {films[0]:.1f} nm | {films[1]:.1f} nm |" in text
    for formula in (f for f in pyehl.film(case).formulas if f["applies"]):
        minimum = f" {formula['h_min_m'] * 1e9:.1f} nm |" if formula["h_min_m"] else ""
        assert f"| {formula['h_c_m'] * 1e9:.1f} nm |{minimum}" in text
    assert f"```text\n{conclude(record)}\n```" in text
    minimum = [round(record[name] * 1e9) for name in ("h_min_m", "h_min_rough_m")]
    assert "minimum film from {} to {} nm".format(*minimum) in text
    assert 0.0 < abs(1.0 - record["mu_ratio"]) < 0.005
    predicted = pyehl.predict(case, tracks=1).summary
    min_film = round(predicted["h_min_rough_m"] * 1e9)
    ratio = f"{predicted['mu_ratio']:.4f}"
    ratio += f" ± {predicted['mu_ratio_model_error']:.4f}"
    assert f"μ_r/μ_s = {ratio} and a minimum film of {min_film} nm" in text
    assert "This film has no stated error" in text
    assert predicted["h_min_rough_error_m"] is None
    assert predicted["outside_range"] == []
    options = ["--set", "surface.kind=smooth", "--set", "second_surface.kind=smooth"]
    assert drive("pyehl", case, "-o", "out", *options).returncode == 0
    result = json.loads((tmp_path / "out" / "summary.json").read_text())
    for name in ("H_c", "H_min", "H_c_extrapolated", "mu_smooth"):
        # converged to another tolerance before time steps
        assert result[name] == pytest.approx(record[name], rel=2e-3)
    # the printed options still give the flanks
    (block,) = re.findall(r"^```python\n(.*?)^```$", text, re.M | re.S)
    (tmp_path / "cases").mkdir()
    subprocess.run([sys.executable, "-P", "-c", block], cwd=tmp_path, check=True)
    for name in ("flank_1.npy", "flank_2.npy"):
        made, kept = (np.load(place / "cases" / name) for place in (tmp_path, root))
        assert made == pytest.approx(kept, abs=1e-13)
    # gears, speed and slip determine the case
    given = pyehl.Case(case).resolve()
    angle = math.acos(90.0 * math.cos(math.radians(20.0)) / 91.5)
    radius = 0.5 * 91.5e-3 * math.sin(angle)
    assert given["bodies"]["radius_x1"] == pytest.approx(radius, rel=1e-3)
    speeds = [2.0 * math.pi * n / 60.0 * radius for n in (1500.0, 1000.0)]
    assert given["contact"]["mean_velocity"] == pytest.approx(0.5 * sum(speeds), rel=1e-3)
    assert given["contact"]["slide_to_roll"] == pytest.approx(0.4)


@pytest.mark.slow
def test_record_of_the_gear_pair(root: Path, tmp_path: Path):
    """The rough run, which takes minutes."""
    page = root / "docs" / "howto" / "gear.md"
    record = json.loads(page.with_suffix(".json").read_text(encoding="utf-8"))
    words = ["run", root / "cases" / "gear_pair.nml", "-o", tmp_path / "out"]
    subprocess.run([sys.executable, "-P", "-m", "pyehl", *words], capture_output=True, check=True)
    result = json.loads((tmp_path / "out" / "summary.json").read_text())
    for name, value in record.items():
        number = isinstance(value, float)
        assert result[name] == (pytest.approx(value, rel=1e-4) if number else value), name


def test_border_of_an_ellipse(root: Path, solve):
    """The default is flooded, and thicker than in tables with P = 0 on a small domain."""
    text = plain(root / "docs" / "theory" / "border.md")
    keys = {"contact.radius_ratio": 0.35177, "lubricant.roelands_z": 0.6684}
    place = {"grid.x_inlet": -2.5, "grid.x_outlet": 1.5, "grid.y_extent": 4.0}
    for more, words in (({}, "along X is"), (place | {"grid.border": "zero"}, "`) it is")):
        done = solve((200.0, 10.0), 257, keys | more)
        assert f"{words} {done['H_c_extrapolated']:.4f}" in text


def test_rolling_moment_grows_with_the_domain(root: Path, solve):
    """A round contact tends to the asymptote of Biboulet & Houpert 2010, with its logarithm."""
    text = plain(root / "docs" / "theory" / "border.md")
    shares = []
    for width, points in ((4.0, 129), (8.0, 257), (16.0, 513)):
        place = {"grid.x_inlet": -0.625 * width, "grid.x_outlet": 0.375 * width}
        done = solve((100.0, 10.0), points, place | {"grid.y_extent": 0.5 * width})
        shares.append(done["rolling_moment"] * 100.0 / 7.5)
    assert "moment is {:.2f}, {:.2f} and {:.2f} times the asymptote".format(*shares) in text
    assert 0.9 < shares[2] < 1.0
    assert shares[2] - shares[1] == pytest.approx(shares[1] - shares[0], rel=0.25)


@pytest.mark.parametrize("radii", [(0.01, 0.1), (0.033, 0.01)])
def test_order_and_limit_in_si_units(solve, radii):
    """R_x/R_y of 0.1 and of 3.3: order 2, and the same limit from any two grids."""
    keys = {
        "contact.load": 50.0,
        "contact.mean_velocity": 1.0,
        "contact.radius_x": radii[0],
        "contact.radius_y": radii[1],
    }
    coarse, middle, fine = (solve(None, points, keys) for points in (65, 129, 257))
    change = (middle["H_c"] - coarse["H_c"]) / (fine["H_c"] - middle["H_c"])
    assert math.log2(change) == pytest.approx(2.0, abs=0.1)
    for name, share in (("H_c", 0.003), ("H_min", 0.01)):
        limit = fine[f"{name}_extrapolated"]
        assert middle[f"{name}_extrapolated"] == pytest.approx(limit, rel=share)


def test_a_sweep_over_ellipses(tmp_path: Path):
    """Its rows are those of single runs."""
    case = pyehl.Case.from_text("", {"contact.load": 50.0, "grid.points": 33})
    radii = {"contact.radius_x": [0.01, 0.02], "contact.radius_y": [0.04, 0.01]}
    table = pyehl.sweep(case, radii, zipped=True, output=tmp_path / "sweep")
    for k in range(2):
        one = {key: values[k] for key, values in radii.items()}
        with pyehl.Solver(case.with_options(one)) as solver:
            solver.run()
            assert float(table["H_c"].values[k]) == solver.summary["H_c"]


def test_resumed_on_an_ellipse(drive, tmp_path: Path):
    """A wave on an ellipse at an angle, stopped and resumed, has the bits of an unbroken run."""
    (tmp_path / "case.nml").write_text(
        "&contact load = 20.0 radius_x = 0.01 radius_y = 0.02 angle = 20 /\n"
        "&grid points = 33 /\n&output checkpoint_interval = 1e-3 /\n"
        "&surface kind = 'harmonic' amplitude = 2e-3 wavelength = 1 x_start = 0 /\n"
    )
    assert drive("ehl", "case.nml", "-o", "whole", "--set", "time.steps=9").returncode == 1
    assert drive("ehl", "case.nml", "-o", "out", "--set", "time.steps=5").returncode == 1
    done = drive("pyehl", "--resume", "out", "--set", "time.steps=9")
    assert "after step 5" in done.stdout
    for file in ("history.csv", "P.npy", "RR.npy"):
        assert (tmp_path / "out" / file).read_bytes() == (tmp_path / "whole" / file).read_bytes()


@pytest.mark.parametrize(
    ("text", "place", "message", "remedy"),
    [
        ("&bodies radius_x1 = -0.01 radius_y1 = 0.01 /", "1:21", "does not open", "convex body"),
        (
            "&bodies radius_x1 = 0.01 radius_x2 = -0.01 radius_y1 = 0.01 /",
            "1:38",
            "does not open in this direction",
            "larger radius than the convex one",
        ),
        ("&contact radius = 0.01 radius_x = 0.01 /", "1:35", "without contact.radius_y", "both"),
        (
            "&contact radius = 0.01 radius_x = 0.01 radius_y = 0.02 /",
            "1:24",
            "contradicts contact.radius",
            "radius of a round contact, or",
        ),
        ("&contact radius_x = -0.01 radius_y = 0.02 /", "1:21", "out of range", "[1e-5, 1000]"),
        ("&contact radius_ratio = 0.001 /", "1:25", "out of range", "[0.004, 250]"),
        (
            "&contact radius_x = 0.01 radius_y = 10.0 /",
            "1:37",
            "radius_x/radius_y is 0.001",
            "at most 30 to 1",
        ),
        (
            "&surface kind = 'fractal' /\n&second_surface kind = 'map' /",
            "2:24",
            "second_surface.kind",
            "file = '...', a height map",
        ),
    ],
)
def test_bad_input_has_place_and_remedy(text: str, place: str, message: str, remedy: str):
    with pytest.raises(pyehl.InputError) as caught:
        pyehl.Case.from_text(text)
    stated = str(caught.value)
    assert place in stated.partition("\n")[0], stated
    assert message in stated, stated
    assert remedy in stated.partition("expected")[2], stated


@pytest.mark.parametrize(
    ("keys", "points"),
    [
        ({"contact.moes_m": 5000.0}, 513),
        ({"contact.moes_m": 5300.0}, 1025),
        # M by R_x; that of the round contact is a fifth of it, and the domain is 2.5 a long
        ({"contact.moes_m": 20000.0, "contact.radius_ratio": 0.04}, 321),
        ({"contact.moes_m": 100000.0, "contact.radius_ratio": 0.04}, 641),
        ({"contact.moes_m": 9000.0, "grid.points": 257}, 257),
        ({"contact.moes_m": 9000.0, "grid.target_error": 0.05}, 513),
        ({"contact.moes_m": 9000.0, "surface.kind": "harmonic"}, 513),
    ],
)
def test_default_grid_of_a_heavy_smooth_contact(keys, points):
    """Its a-priori error of H_c, 0.16 M h^2, is 5 % at M = 5120 on 513 nodes."""
    case = pyehl.Case.from_text("", {"contact.moes_l": 5.0, "surface.kind": "smooth"} | keys)
    assert case["grid"]["points"] == points


WIDE = {"contact.radius_ratio": 0.04, "contact.moes_l": 5.0}


@pytest.mark.parametrize(
    ("keys", "points"),
    [
        ({"contact.moes_m": 300.0}, 257),
        ({"contact.moes_m": 700.0}, 193),
        ({"contact.moes_m": 2000.0}, 385),
        # what the a-priori error of a flooded, steady film does not contain
        ({"contact.moes_m": 300.0, "inlet.film_hertz": 0.05}, 513),
        ({"contact.moes_m": 300.0, "surface.kind": "harmonic"}, 513),
        ({"contact.moes_m": 300.0, "contact.radius_ratio": 1.0}, 513),
    ],
)
def test_default_grid_of_a_wide_contact(keys, points):
    """With the fewest nodes whose a-priori error of H_c is at most 0.5 %."""
    case = pyehl.Case.from_text("", WIDE | {"surface.kind": "smooth"} | keys)
    assert case["grid"]["points"] == points


@pytest.mark.parametrize(
    ("seed", "number", "long"), [(159, 35, True), (134, 55, True), (96, 48, False)]
)
def test_default_cells_of_a_very_wide_contact(seed: int, number: int, long: bool):
    """L from 7 to 9, alpha p_h above 35: the cells are long if kappa exceeds 22 (13 in 96/48)."""
    contact = draw(number + 1, seed)[number]
    grid = pyehl.Case.from_text("", contact.values)["grid"]
    x_mesh = (grid["x_outlet"] - grid["x_inlet"]) / (grid["points"] - 1)
    ratio = 2.0 * grid["y_extent"] / (grid["points_y"] - 1) / x_mesh
    assert ratio > 2.5 if long else ratio < 1.6


def test_reduced_grid_of_a_wide_contact():
    """Its films differ from those on 513 nodes by less than the stated errors."""
    keys = WIDE | SETTINGS | {"contact.moes_m": 300.0}
    reduced, usual = timed(keys), timed(keys | {"grid.points": 513})
    assert (reduced["points"], usual["points"]) == (257, 513)
    for name in ("H_c", "H_min"):
        assert abs(reduced[name] - usual[name]) <= reduced[f"{name}_error_grid"]
        assert reduced[f"{name}_error_grid"] <= 0.01 * reduced[name]


@pytest.mark.long
def test_softened_contact_restarts_with_damped_cycles_on_the_first_grid():
    """Eyring, alpha p_h = 61: cycles on the first grid fail, and from the Hertz pressure those on
    finer grids would too."""
    contact = draw(53, 1)[52]
    done = timed(dict(contact.values) | SETTINGS | {"grid.points": 129})
    assert (done["status"], done["restarts"]) == ("converged", 1)
    assert done["total_cycles"] <= 40


@pytest.mark.long
def test_diverged_coarse_grids_give_no_correction():
    """M = 124 000: with their corrections it takes 17 cycles, 8 of them on the finest grid."""
    contact = draw(37, 89)[36]
    done = timed(dict(contact.values) | SETTINGS)
    assert done["status"] == "converged"
    assert done["cycles"] <= 4
    assert done["total_cycles"] <= 10


@pytest.mark.parametrize(
    ("seed", "number", "cycles"), [(12, 15, 12), pytest.param(3, 32, 12, marks=pytest.mark.long)]
)
def test_sharp_spike_takes_few_cycles(seed: int, number: int, cycles: int):
    """With the load scaled although its error stalls (12/15: 21 cycles without), and with the
    damping of the coarser grid (3/32: a restart without)."""
    contact = draw(number + 1, seed)[number]
    done = timed(dict(contact.values) | SETTINGS)
    assert (done["status"], done["restarts"]) == ("converged", 0)
    assert done["cycles"] <= cycles


@pytest.mark.parametrize(("kappa", "border"), [(3.9, "zero"), (4.1, "flooded")])
def test_default_border_of_a_wide_contact(kappa, border):
    """At an M of the round contact of 600, where the border of a round contact is P = 0."""
    square = kappa**2
    ratio = float(elliprd(0.0, 1.0, square) / elliprd(0.0, square, 1.0))
    moes_m = 600.0 * kappa * ellipse(ratio).kernel_ratio ** 0.25
    keys = {"contact.moes_m": moes_m, "contact.moes_l": 10.0, "contact.radius_ratio": ratio}
    assert pyehl.Case.from_text("", keys)["grid"]["border"] == border
    assert pyehl.Case.from_text("", keys | {"grid.border": "zero"})["grid"]["border"] == "zero"


@pytest.mark.long
def test_growing_residual_is_damped_without_a_restart():
    """A crowned roller with L = 32, kappa = 15 on a wide domain.

    If each grid began with undamped cycles, the finest one would restart with damped ones.
    """
    keys = {
        "contact.radius_x": 0.00370017,
        "contact.radius_y": 0.261986,
        "contact.load": 1339.9,
        "contact.mean_velocity": 5.5522,
        "grid.y_extent": 19.343,
        "contact.reduced_modulus": 2.26e11,
        "lubricant.viscosity": 0.13002,
        "lubricant.pressure_viscosity": 2.2144e-8,
        "surface.kind": "smooth",
    }
    result = []
    for points in (257, 513):
        with pyehl.Solver(pyehl.Case.from_text("", keys | {"grid.points": points})) as solver:
            assert solver.run()
            result.append(solver.summary)
    assert [done["restarts"] for done in result] == [0, 0]
    coarse, fine = result
    assert abs(coarse["H_c"] - fine["H_c"]) <= coarse["H_c_error"] + fine["H_c_error"]


@pytest.mark.long
def test_sharp_pressure_spike_is_left_to_the_sweeps():
    """A ball at 2.7 GPa, kappa = 9: if coarse grids changed its spike, it would not converge."""
    keys = {
        "contact.radius_x": 0.002717,
        "contact.radius_y": 0.08576,
        "contact.load": 857.2,
        "contact.mean_velocity": 1.801,
        "contact.reduced_modulus": 2.26e11,
        "lubricant.viscosity": 0.1098,
        "lubricant.pressure_viscosity": 2.39e-8,
        "surface.kind": "smooth",
    }
    with pyehl.Solver(pyehl.Case.from_text("", keys)) as solver:
        assert solver.run()
        result = solver.summary
    assert result["restarts"] == 0
    assert result["cycles"] <= 12


@pytest.mark.long
def test_shear_thinning_begins_with_a_damped_flow():
    """With the Newtonian flow no first cycle converged on any grid."""
    contact = {
        "reduced_modulus": 2.26e11, "load": 9552.0, "radius_x": 0.01413, "radius_y": 0.8384,
        "mean_velocity": 9.433, "slide_to_roll": 0.06655,
    }  # fmt: skip
    oil = {"viscosity": 0.1657, "pressure_viscosity": 2.257e-8, "shear_law": "eyring"}
    films = {}
    for stress in (1.301e6, 5.2e6):
        case = pyehl.Case(contact=contact, lubricant={**oil, "eyring_stress": stress})
        result = pyehl.solve(case)
        assert result.attrs["status"] == "converged"
        assert result.restarts == 0
        films[stress] = float(result.H_c)
    # the final solution uses the law of the case: a smaller stress thins the film
    assert 0.75 < films[1.301e6] / films[5.2e6] < 0.9


def test_kinds_of_machine_contacts_alternate():
    assert [contact.kind for contact in draw(8, 4)] == list(KINDS) * 2
