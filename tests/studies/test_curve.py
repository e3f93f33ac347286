# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl stribeck``: columns, the basis of theta_2, the end of full film, measured data."""

import csv
import io
import math
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from matplotlib.image import imread

import pyehl
from pyehl.cli import main
from pyehl.studies.curve import pattern
from pyehl.surfaces import from_settings, harmonic
from pyehl.theory import stribeck
from pyehl.theory.line_contact import LineContact
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.transition import BREAKDOWN, FULL_FILM, OUTSIDE, full_film_ends

WANTED = (
    "h_c_m h_min_m lambda_ratio theta_2 hersey mu_smooth mu mu_ratio mu_ratio_model_error "
    "mu_ratio_ehl mu_ratio_ehl_error status"
).split()
WAVE = (
    "--set",
    "surface.kind=harmonic",
    "--set",
    "surface.amplitude=0.002",
    "--set",
    "grid.points=129",
    "--set",
    "lubricant.shear_law=eyring",
)
KEY = "contact.mean_velocity"


def run(*words: str, expect: int = 0) -> tuple[str, str]:
    reported, complaint = io.StringIO(), io.StringIO()
    with redirect_stdout(reported), redirect_stderr(complaint):
        status = main(["stribeck", "--jobs", "1", *words])
    assert status == expect, reported.getvalue() + complaint.getvalue()
    return reported.getvalue(), complaint.getvalue()


def table(folder: Path) -> list[dict[str, str]]:
    with (folder / "stribeck.csv").open(newline="") as stream:
        return list(csv.DictReader(stream))


@pytest.fixture(scope="module")
def wave(cases: Path, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, str]:
    """A curve of three points over a waviness, with the full simulation at one."""
    folder = tmp_path_factory.mktemp("curve")
    words = (str(cases / "table1.nml"), *WAVE, "--speed", "0.8:3.2:3log", "--ehl", "1")
    (folder / "m.csv").write_text(f"{KEY},mu,error\n1.0,0.043,0.001\n\n3.0,0.044,0.001\n")
    reported, _ = run(*words, "--measured", str(folder / "m.csv"), "-o", str(folder / "out"))
    return folder / "out", reported


def test_columns(wave: tuple[Path, str], cases: Path):
    rows = table(wave[0])
    assert next(iter(rows[0])) == KEY
    assert set(WANTED) <= set(rows[0])
    assert [float(row[KEY]) for row in rows] == [0.8, 1.6, 3.2]
    for row in rows:
        u = float(row[KEY])
        assert row["status"] == "full film"
        assert float(row["hersey"]) == pytest.approx(0.04 * u * 0.018 / 600.0, rel=1e-12)
        assert float(row["mu"]) == pytest.approx(
            float(row["mu_smooth"]) * float(row["mu_ratio"]), rel=1e-9
        )
        case = pyehl.Case(cases / "table1.nml", f"{KEY}={u}").resolve()
        point = OperatingPoint.from_settings(case)
        amplitude = 0.002 * point.film_scale
        ratio = float(row["h_c_m"]) / amplitude
        theta = stribeck.theta_2(point.moes_m, point.moes_l, 0.5, ratio)
        assert float(row["theta_2"]) == pytest.approx(float(theta), rel=1e-9)
        assert float(row["theta_2_wavelength_m"]) == pytest.approx(0.5 * point.hertz_radius)
        # the rms height of cos cos is half its amplitude
        assert float(row["lambda_ratio"]) == pytest.approx(
            float(row["h_min_m"]) / (0.5 * amplitude), rel=1e-9
        )
    films = [float(row["h_c_m"]) for row in rows]
    assert films == sorted(films)


def test_film_is_that_of_the_solved_contact(wave: tuple[Path, str], cases: Path):
    row = table(wave[0])[1]
    with pyehl.Solver(
        cases / "table1.nml", "surface.kind=smooth", *WAVE[5::2], f"{KEY}=1.6"
    ) as solver:
        solver.run()
        alone = solver.summary
    limit = alone["H_c_extrapolated"] or alone["H_c"]
    assert float(row["h_c_m"]) == pytest.approx(limit * alone["film_scale_m"], rel=1e-12)
    assert float(row["h_c_error_m"]) == pytest.approx(
        alone["H_c_error"] * alone["film_scale_m"], rel=1e-12
    )


def test_full_simulation_at_some_points(wave: tuple[Path, str]):
    rows = table(wave[0])
    assert [bool(row["mu_ratio_ehl"]) for row in rows] == [False, True, False]
    assert float(rows[1]["mu_ratio_ehl_error"]) > 0.0
    # a wave of a tenth of the film under Eyring's law: both are near one
    assert float(rows[1]["mu_ratio_ehl"]) == pytest.approx(float(rows[1]["mu_ratio"]), abs=0.01)


@pytest.mark.long
def test_smooth_surfaces_have_the_ratio_one(cases: Path, tmp_path: Path):
    """Smooth and rough ones give the same film and coefficient of the smooth contact."""
    case = str(cases / "table1.nml")
    words = ("--set", "lubricant.shear_law=eyring", "--set", "grid.points=129")
    words += ("--speed", "0.5,2", "--slide-to-roll", "0.02,0.2")
    reported, _ = run(case, *words, "--set", "surface.kind=smooth", "-o", str(tmp_path / "s"))
    assert "and a prediction" not in reported
    run(case, *words, "--set", "surface.pixels=64", "-o", str(tmp_path / "r"))
    # a ratio of one is not reported
    assert "\nmu_r/mu_s  " not in reported
    smooth, rough = table(tmp_path / "s"), table(tmp_path / "r")
    assert len(smooth) == len(rough) == 4
    for a, b in zip(smooth, rough, strict=True):
        assert (a["mu_ratio"], a["mu_ratio_model_error"], a["status"]) == ("1.0", "0.0", FULL_FILM)
        assert (a["lambda_ratio"], a["theta_2"]) == ("", "")
        assert a["mu"] == a["mu_smooth"] == b["mu_smooth"]
        assert (a["h_c_m"], a["h_min_m"]) == (b["h_c_m"], b["h_min_m"])
        assert float(b["mu"]) == pytest.approx(float(b["mu_ratio"]) * float(a["mu"]), rel=1e-12)
    # more slip, more shear stress
    assert [float(r["mu"]) for r in smooth[1::2]] > [float(r["mu"]) for r in smooth[::2]]
    assert imread(tmp_path / "s" / "stribeck.png").std() > 0.1


def test_temperature_and_load(cases: Path, tmp_path: Path):
    """With rising temperature the oil thins by its data sheet, and with it the film."""
    text = (cases / "table1.nml").read_text().replace("   viscosity = 0.04", "   !")
    sheet = "&lubricant\n   kinematic_viscosity_40 = 46.0\n   kinematic_viscosity_100 = 7.0"
    (tmp_path / "oil.nml").write_text(text.replace("&lubricant", sheet))
    words = ("--set", "grid.points=257", "--set", "surface.pixels=64")
    reported, _ = run(
        str(tmp_path / "oil.nml"), *words, "--temperature", "40:60:3", "-o", str(tmp_path / "t")
    )
    rows = table(tmp_path / "t")
    assert [float(r["lubricant.temperature"]) for r in rows] == [40.0, 50.0, 60.0]
    for row in rows:
        oil = pyehl.Case(
            tmp_path / "oil.nml", f"lubricant.temperature={row['lubricant.temperature']}"
        )
        viscosity = oil.resolve()["lubricant"]["viscosity"]
        assert float(row["hersey"]) == pytest.approx(viscosity * 0.84 * 0.018 / 600.0, rel=1e-9)
    # 46 mm^2/s at 870 kg/m^3 at 15 degC
    density = 870.0 * (1.0 - 0.00065 * 25.0)
    assert float(rows[0]["hersey"]) * 600.0 / 0.018 / 0.84 == pytest.approx(
        46e-6 * density, rel=1e-3
    )
    for name in ("h_c_m", "hersey", "lambda_ratio"):
        values = [float(row[name]) for row in rows]
        assert values == sorted(values, reverse=True), name
    assert "lubricant.temperature" in reported
    _, complaint = run(
        str(cases / "table1.nml"),
        *words,
        "--set",
        "surface.kind=smooth",
        "--load",
        "300,1600,5000",
        "-o",
        str(tmp_path / "l"),
        expect=1,
    )
    why = (
        "smooth contact: negative film: the smooth contact on 257 x 257 nodes has no positive "
        "film: give a finer grid (grid.points = 513)"
    )
    assert complaint == f"point 3 of 3 (contact.load=5000): not solved: {why}\n"
    light, heavy, lost = table(tmp_path / "l")
    assert (light["message"], light["status"]) == ("", FULL_FILM)
    assert "257 nodes along X, not extrapolated: grid.points = 513 may help" in heavy["message"]
    assert heavy["status"] == FULL_FILM
    assert lost["status"] == "not solved"
    assert lost["message"] == why


def test_files_and_words(wave: tuple[Path, str]):
    folder, reported = wave
    assert "3 points over contact.mean_velocity" in reported
    assert "the full simulation at 1" in reported
    assert "full film at all points" in reported
    with xr.open_dataset(folder / "stribeck.nc") as data:
        assert data.mu_ratio.dims == ("mean_velocity",)
        assert data.h_c_m.attrs["units"] == "m"
        assert data.mean_velocity.attrs["units"] == "m/s"
        assert data.mean_velocity.attrs["key"] == KEY
        assert float(data.h_c_m[0]) == float(table(folder)[0]["h_c_m"])
    assert imread(folder / "stribeck.png").std() > 0.1


def test_mean_over_surfaces_and_the_end_of_full_film(cases: Path, tmp_path: Path):
    words = ("--set", "grid.points=257", "--set", "surface.pixels=64", "--speed", "0.1,4")
    words += ("--set", "surface.rms_height=1.5e-7")
    reported, _ = run(str(cases / "table1.nml"), *words, "--surfaces", "2", "-o", str(tmp_path))
    slow, fast = table(tmp_path)
    assert slow["status"] == BREAKDOWN
    assert slow["mu_ratio"] == ""
    assert "of 2 surfaces" in slow["message"]
    each = [
        pyehl.predict(
            cases / "table1.nml",
            "surface.pixels=64",
            "surface.rms_height=1.5e-7",
            f"{KEY}=4.0",
            f"surface.seed={k}",
        )
        for k in (1, 2)
    ]
    ratios = [p.mu_ratio for p in each]
    assert float(fast["mu_ratio"]) == pytest.approx(np.mean(ratios), rel=1e-9)
    assert float(fast["mu_ratio_spread"]) == pytest.approx(np.std(ratios, ddof=1), rel=1e-6)
    errors = [p.summary["mu_ratio_model_error"] for p in each]
    # outside the measured range of the model there is no error
    assert fast["mu_ratio_model_error"] == ("" if None in errors else repr(max(errors)))
    # Newtonian at this pressure: the coefficient has no meaning and is missing
    assert fast["mu"] == ""
    assert "full film ends between contact.mean_velocity = 0.1 and 4" in reported


def test_pattern_of_a_map_of_one_wave_is_that_wave(tmp_path: Path):
    """The equivalent wave of any surface is the wave itself if the surface is one."""
    point = OperatingPoint()
    wavelength = 0.4 * point.hertz_radius
    tile = harmonic(3e-8, wavelength, wavelength, (32, 32))
    np.save(tmp_path / "map.npy", np.tile(tile.heights, (2, 3)))
    case = pyehl.Case.from_text(
        "",
        [
            "surface.kind=map",
            f"surface.file={tmp_path / 'map.npy'}",
            f"surface.length_x={2 * wavelength}",
            f"surface.length_y={3 * wavelength}",
        ],
    )
    result = pattern(case.resolve(), point, 2e-7)
    assert result.wavelength == pytest.approx(wavelength, rel=1e-9)
    assert result.rms_height == pytest.approx(1.5e-8, rel=1e-9)


def test_pattern_of_a_transverse_wave_on_a_line():
    """One cosine has the rms height A/sqrt(2), as in the solver and in the tile of a prediction."""
    case = pyehl.Case(
        contact={"shape": "line", "load_per_length": 1e5, "mean_velocity": 1.0, "radius": 0.01},
        surface={
            "kind": "harmonic",
            "amplitude": 1e-3,
            "wavelength_x": 0.5,
            "wavelength_y": 1e6,
            "velocity_ratio": 0.0,
        },
        grid={"points": 129},
    )
    settings = case.resolve()
    line = LineContact.from_settings(settings)
    result = pattern(settings, line, 2e-7)
    assert result.rms_height == pytest.approx(1e-3 * line.film_scale / math.sqrt(2.0), rel=1e-12)
    solved = pyehl.solve(case)
    assert result.rms_height == pytest.approx(float(solved["surface_rms_m"]), rel=1e-6)
    # as if the same heights were a map
    tile = from_settings(settings, line, 2e-7)
    assert result.rms_height == pytest.approx(tile.rms_height, rel=1e-12)
    assert result.wavelength == pytest.approx(math.sqrt(2.0) * 0.5 * line.hertz_radius, rel=1e-12)


@pytest.mark.parametrize(
    ("statuses", "states"),
    [
        ([FULL_FILM, FULL_FILM, FULL_FILM], "full film at all points"),
        (
            [FULL_FILM, OUTSIDE, FULL_FILM],
            "full film at all points; 1 of them outside the range of the prediction",
        ),
        ([BREAKDOWN, BREAKDOWN, FULL_FILM], "between u = 2 and 3"),
        ([BREAKDOWN, "not solved", FULL_FILM], "between u = 1 and 3"),
        ([FULL_FILM, BREAKDOWN, BREAKDOWN], "between u = 1 and 2"),
        ([BREAKDOWN, BREAKDOWN, BREAKDOWN], "no full film"),
        (["not solved", FULL_FILM, FULL_FILM], "1 have none"),
        ([BREAKDOWN, BREAKDOWN, "not solved"], "no full film at any point with"),
        (["not solved", "not solved", "not solved"], "no point has a result"),
    ],
)
def test_end_of_the_full_film(statuses: list[str], states: str):
    assert states in full_film_ends("u", [1.0, 2.0, 3.0], statuses)


@pytest.mark.parametrize(
    ("words", "states"),
    [
        ([], "expected at least one of --speed"),
        (["--speed", "0.5", "--set", "surface.kind=smooth", "--ehl", "1"], "no passage to solve"),
        (["--speed", "0.5", "--ehl", "2"], "ehl = 2: expected 0 to 1"),
        (["--speed", "0.5", "--surfaces", "0"], "surfaces = 0:"),
        (["--speed", "0.5", "--surfaces", "1000000000"], "surfaces = 1000000000: expected 1 to"),
        (["--speed", "1:2:2000", "--surfaces", "999"], "2000000 cases; a study can have"),
        (["--speed", "0.5,-1"], "case 2 of 2"),
        (["--temperature", "40:60:3"], "lubricant.temperature"),
        (["--speed", "1", "--set", "surface.kind=harmonic", "--surfaces", "2"], "has no seed"),
        (["--speed", "1", "--load", "300", "--measured", "x.csv"], "expected one curve"),
    ],
)
def test_curves_that_are_refused(cases: Path, tmp_path: Path, words: list[str], states: str):
    _, complaint = run(str(cases / "table1.nml"), *words, "-o", str(tmp_path / "out"), expect=2)
    assert states in complaint
    assert not (tmp_path / "out").exists()


@pytest.mark.long
def test_a_load_that_no_grid_solves(cases: Path, tmp_path: Path):
    """It is reported in words, and the other point has its result."""
    words = ("--set", "surface.pixels=64", "--set", "grid.points=65", "-o")
    reported, complaint = run(
        str(cases / "table1.nml"), "--speed", "0.005,4", *words, str(tmp_path / "1"), expect=1
    )
    lost, result = table(tmp_path / "1")
    assert lost["status"] == "not solved"
    assert "did not converge on 1025 nodes along X" in lost["message"]
    assert "point 1 of 2 (contact.mean_velocity=0.005): not solved: failed: " in complaint
    assert "full film at all points with a result; 1 have none" in reported
    assert result["status"] == FULL_FILM


def test_a_ratio_larger_than_any_that_was_compared(cases: Path, tmp_path: Path):
    words = ("--set", "surface.pixels=256", "--set", "grid.points=257", "--set")
    words += ("surface.rms_height=7e-8", "-o", str(tmp_path / "out"))
    reported, _ = run(str(cases / "table1.nml"), "--viscosity", "0.01,0.1", *words)
    assert "curve      outside the range at 1, full film at 1 of 2 points" in reported
    high, usual = table(tmp_path / "out")
    assert float(high["mu_ratio"]) > 5.0
    assert high["mu_ratio_model_error"] == ""
    assert high["status"] == OUTSIDE
    assert "mu_ratio above 5" in high["message"]
    assert usual["status"] == FULL_FILM


@pytest.mark.long
def test_a_point_without_a_smooth_solution_is_not_solved(cases: Path, tmp_path: Path):
    """It has a predicted ratio, but no film on the grid; the other point has a coefficient."""
    (tmp_path / "m.csv").write_text(f"{KEY},mu\n1.0,0.05\n")
    words = ("--set", "surface.pixels=64", "--set", "grid.points=65", "--set")
    words += ("lubricant.shear_law=eyring", "--speed", "0.02,4")
    words += ("--measured", str(tmp_path / "m.csv"), "-o", str(tmp_path / "out"))
    run(str(cases / "table1.nml"), *words, expect=1)
    slow, fast = table(tmp_path / "out")
    assert slow["h_c_m"] == ""
    assert slow["status"] in ("not solved", BREAKDOWN)
    assert fast["mu"] != ""
    assert (tmp_path / "out" / "stribeck.png").is_file()


def test_a_curve_without_results_states_no_full_film(cases: Path, tmp_path: Path):
    """Neither words nor pictures mention a film that no point has."""
    words = ("--set", "surface.kind=smooth", "--set", "grid.points=65", "--speed", "0.003,0.005")
    reported, complaint = run(
        str(cases / "table1.nml"), *words, "-o", str(tmp_path / "out"), expect=1
    )
    assert "no point has a result" in reported
    assert "full film" not in reported
    assert complaint.count(": not solved: ") == 2
    assert "there is no picture" in complaint
    assert not (tmp_path / "out" / "stribeck.png").exists()
    assert "stribeck.png" not in reported


def test_a_ratio_beyond_linear_response_leaves_the_film(cases: Path, tmp_path: Path):
    """Film and Lambda are known: they classify the point, and only the ratio is missing."""
    words = ("--set", "surface.pixels=128", "--set", "surface.rms_height=5e-8", "--set")
    words += ("surface.hurst=0.3", "--set", "grid.points=257", "--speed", "0.84,4")
    reported, complaint = run(str(cases / "table1.nml"), *words, "-o", str(tmp_path))
    first, second = table(tmp_path)
    assert first["status"] == OUTSIDE
    assert (first["mu_ratio"], first["mu"]) == ("", "")
    assert first["message"].startswith("beyond linear response: pressures that raise mu_r/mu_s to")
    assert "but mu_r/mu_s is not known: pressures that raise" in first["assessment"]
    assert "no result" not in first["assessment"] + reported
    assert float(first["lambda_ratio"]) > 0.5
    assert second["mu_ratio"] != ""
    assert complaint == ""


def test_a_curve_of_breakdown_alone_has_no_picture(cases: Path, tmp_path: Path):
    words = ("--set", "surface.pixels=64", "--set", "surface.rms_height=8e-7", "--set")
    words += ("grid.points=129", "--speed", "0.8,1.6", "-o", str(tmp_path))
    reported, complaint = run(str(cases / "table1.nml"), *words, expect=1)
    assert "no full film at any point" in reported
    assert "there is no picture" in complaint
    assert {row["status"] for row in table(tmp_path)} == {BREAKDOWN}
    assert not (tmp_path / "stribeck.png").exists()
