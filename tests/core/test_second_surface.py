# SPDX-License-Identifier: BSD-3-Clause
"""The second surface of a case: motion, drivers, heights in memory, states, messages."""

import csv
import json
import re
import shutil
from pathlib import Path

import numpy as np
import pytest

import pyehl
from pyehl import Case, Solver, cli
from pyehl.errors import InputError
from pyehl.simulation.resolution import resolution
from pyehl.solver import solver_on_heights

# One body twice as fast as the other: the fewest positions before tiles of one length meet again
FASTER, SLOWER = 4.0 / 3.0, 2.0 / 3.0
SLIP = f"slide_to_roll = {FASTER - SLOWER} "
CONTACT = (
    f"&contact load = 20.0 {SLIP}/\n"
    "&grid points = 65 x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0 /\n"
)
FRACTAL = "&{} kind = 'fractal' pixels = 32 length_x = 1e-4 length_y = 1e-4 rms_height = 5e-9 /\n"
MAP = "&{} kind = 'map' file = '{}.npy' length_x = 8e-5 length_y = 1e-4 {} /\n"
WAVE = "&{} kind = 'harmonic' amplitude = 2e-3 wavelength = 1 {} /\n"
STEPS = "&time steps = {} /\n"


@pytest.fixture
def heights(tmp_path: Path) -> dict[str, np.ndarray]:
    """Two maps [m], as files with these names."""
    rng = np.random.default_rng(5)
    made = {name: rng.normal(scale=3e-9, size=(16, 20)) for name in ("one", "two")}
    for name, values in made.items():
        np.save(tmp_path / f"{name}.npy", values)
    return made


@pytest.mark.parametrize(
    ("keys", "velocities", "slide_to_roll"),
    [
        ("", (1.01, 0.99), 0.02),
        ("contact.rough_surface=2", (0.99, 1.01), 0.02),
        ("contact.slide_to_roll=-0.5", (0.75, 1.25), -0.5),
        ("surface.velocity_ratio=1.3", (1.3, 0.7), 0.6),
        ("second_surface.velocity_ratio=1.3", (0.7, 1.3), -0.6),
        ("contact.rough_surface=2 second_surface.velocity_ratio=1.3", (0.7, 1.3), 0.6),
        ("surface.velocity_ratio=0.7 second_surface.velocity_ratio=1.3", (0.7, 1.3), -0.6),
    ],
)
def test_velocities_follow(keys: str, velocities: tuple[float, float], slide_to_roll: float):
    case = Case.from_text(WAVE.format("second_surface", ""), keys.split())
    groups = case.resolve()
    result = [groups[name]["velocity_ratio"] for name in ("surface", "second_surface")]
    assert result == pytest.approx(velocities, rel=1e-15)
    assert groups["contact"]["slide_to_roll"] == slide_to_roll
    assert Case.from_text(case.text).text == case.text
    # derived values are derived again
    if not keys:
        changed = case.with_options("contact.slide_to_roll=1").resolve()
        assert changed["second_surface"]["velocity_ratio"] == 0.5


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (
            "&surface velocity_ratio = 1.2 /\n&second_surface velocity_ratio = 0.9 /\n",
            ["2:17", "second_surface.velocity_ratio", "1.2 and 0.9 add up to 2.1", "add up to 2"],
        ),
        (
            "&contact slide_to_roll = 0.1 /\n&second_surface velocity_ratio = 0.9 /\n",
            ["2:17", "contradicts contact.slide_to_roll", "on body 2, moves at 0.95", "= 0.2"],
        ),
        (
            "&second_surface kind = 'map' file = 'missing.npy' length_x = 1e-4 length_y = 1e-4 /\n",
            ["1:37", "second_surface.file", "missing.npy"],
        ),
        ("&second_surface kind = 'map' /\n", ["second_surface.kind", "second_surface.file"]),
        ("&second_surface knid = 'map' /\n", ["1:17", "&second_surface", "'kind'"]),
        ("&seconds_surface kind = 'map' /\n", ["1:1", "'&second_surface'"]),
        (
            "&second_surface kind = 'dent' height_m = 1e-7 /\n&contact moes_m = 200 /\n",
            ["second_surface.height_m", "second_surface.amplitude"],
        ),
        (
            "&contact slide_to_roll = 0.5 /\n&surface kind = 'harmonic' /\n"
            "&second_surface kind = 'dent' x_start = -2 /\n",
            ["3:41", "second_surface.x_start", "fills the contact", "at most"],
        ),
    ],
    ids=["sum", "slip", "no file", "no name", "key", "group", "metres", "arrival"],
)
def test_messages(text: str, words: list[str], tmp_path: Path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(InputError) as caught:
        Case.from_text(text)
    for word in words:
        assert word in str(caught.value)


@pytest.mark.parametrize(
    ("height", "words"), [("= 0.1", "4.96E-08 m\n"), ("_over_film = 0.1", "relative to the film")]
)
def test_plan_has_the_heights_of_both(height: str, words: str):
    """Shares of the variance are in per cent."""
    text = CONTACT + FRACTAL.format("surface")
    text += f"&second_surface kind = 'harmonic' amplitude{height} wavelength = 0.5 /\n"
    reported = str(pyehl.check(Case.from_text(text)))
    assert "surface    &surface: rms height " in reported
    assert f"surface    &second_surface: rms height {words}" in reported
    share = reported.partition("hold ")[2]
    assert re.match(r"[\d.]+ % of the variance of the surface; (less than )?[\d.]+ % of it", share)


def test_feature_enters_after_the_roughness():
    """Its front reaches X = -1.25 two a/u after that of the roughness has passed X = 1.05."""
    text = "&contact slide_to_roll = 0.5 /\n" + WAVE.format("surface", "x_start = -3")
    groups = Case.from_text(text + "&second_surface kind = 'ridge' length = 1 /\n").resolve()
    arrival = (-1.25 - groups["second_surface"]["x_start"]) / 0.75
    assert arrival == pytest.approx((1.05 + 3.0) / 1.25 + 2.0, rel=1e-14)
    at_rest = ["contact.slide_to_roll=2", "surface.x_start=0"]
    still = Case.from_text(text + "&second_surface kind = 'dent' /\n", at_rest).resolve()
    assert still["second_surface"]["x_start"] == still["grid"]["x_inlet"]


def test_too_many_periods_for_the_slow_surface(heights, tmp_path: Path):
    """The message names the slower surface and the number of periods."""
    text = CONTACT.replace(SLIP, "slide_to_roll = 1.99998 ") + FRACTAL.format("surface")
    case = Case.from_text(text + FRACTAL.format("second_surface"))
    with pytest.raises(InputError, match=r"second_surface\.velocity_ratio = ") as caught:
        Solver(case)
    assert "expected: a velocity ratio of at least" in str(caught.value)


PAIRS = {
    "fractal and map": FRACTAL.format("surface") + MAP.format("second_surface", "two", ""),
    "two maps": MAP.format("surface", "one", "") + MAP.format("second_surface", "two", ""),
    "map at rest": WAVE.format("surface", "")
    + MAP.format("second_surface", "two", "velocity_ratio = 0"),
}


@pytest.mark.parametrize("name", ["fractal and map", "map at rest"])
def test_both_drivers_give_the_same_bits(drive, heights, tmp_path: Path, name: str):
    contact = CONTACT.replace(SLIP, "") if "rest" in name else CONTACT
    (tmp_path / "case.nml").write_text(contact + PAIRS[name] + STEPS.format(6))
    for driver in ("ehl", "pyehl"):
        done = drive(driver, "case.nml", "-o", driver)
        assert (done.returncode, done.stderr) == (1, "")
    assert json.loads((tmp_path / "ehl" / "summary.json").read_text())["steps"] == 6
    rr = np.load(tmp_path / "ehl" / "RR.npy")
    assert np.ptp(rr) > 0.0
    for field in ("RR", "P", "H", "A_d"):
        one, other = (np.load(tmp_path / driver / f"{field}.npy") for driver in ("ehl", "pyehl"))
        assert np.array_equal(one, other), field


@pytest.mark.parametrize("name", ["fractal and map", "map at rest"])
def test_resumed_to_the_same_bits(drive, heights, tmp_path: Path, name: str):
    contact = CONTACT.replace(SLIP, "") if "rest" in name else CONTACT
    (tmp_path / "case.nml").write_text(contact + PAIRS[name])
    often = ["--set", "output.checkpoint_interval=1e-3"]
    assert drive("ehl", "case.nml", "-o", "whole", "--set", "time.steps=9").returncode == 1
    assert drive("ehl", "case.nml", "-o", "out", *often, "--set", "time.steps=5").returncode == 1
    shutil.copytree(tmp_path / "out.checkpoint", tmp_path / "two.checkpoint")
    for driver, place in (("ehl", "out"), ("pyehl", "two")):
        done = drive(driver, "--resume", place, "--set", "time.steps=9")
        assert (done.returncode, done.stderr) == (1, "")
        assert "after step 5" in done.stdout
        for file in ("history.csv", "P.npy", "RR.npy"):
            unbroken = (tmp_path / "whole" / file).read_bytes()
            assert (tmp_path / place / file).read_bytes() == unbroken, file


def test_heights_in_memory(heights, tmp_path: Path, monkeypatch):
    """Arrays replace both surfaces: as from files, and the result folder can be solved again."""
    monkeypatch.chdir(tmp_path)
    text = CONTACT + PAIRS["two maps"] + STEPS.format(4)
    read = pyehl.solve(Case.from_text(text), check=False)
    size = "length_x = 8e-5 length_y = 1e-4 pixels = 8 /\n"
    empty = f"&surface kind = 'fractal' {size}&second_surface kind = 'fractal' {size}"
    given = pyehl.solve(
        Case.from_text(CONTACT + empty + STEPS.format(4)),
        surface=heights["one"],
        second_surface=pyehl.Topography(heights["two"], (8e-5, 1e-4)),
        output=tmp_path / "out",
        check=False,
    )
    # the mean is subtracted in another order
    assert given.RR.values == pytest.approx(read.RR.values, abs=1e-15)
    assert given.P.values == pytest.approx(read.P.values, abs=1e-9)
    files = json.loads((tmp_path / "out" / "summary.json").read_text())["files"]
    assert {"surface.npy", "second_surface.npy"} <= set(files)
    again = pyehl.solve(tmp_path / "out" / "case.nml", check=False)
    assert np.array_equal(again.RR.values, given.RR.values)
    # only the second surface is replaced
    alone = Case.from_text(CONTACT + PAIRS["two maps"] + STEPS.format(4))
    other = pyehl.solve(alone, second_surface=heights["one"], check=False)
    assert not np.array_equal(other.RR.values, read.RR.values)
    with pytest.raises(InputError, match=r"second_surface\.length_x"):
        Solver(Case.from_text(CONTACT), second_surface=heights["one"])
    with pytest.raises(InputError, match=r"second_surface\.kind = 'map' or 'fractal'"):
        solver_on_heights(Case.from_text(CONTACT), {"second_surface": heights["one"]})


def test_given_surfaces_are_kept_for_both_drivers(drive, heights, tmp_path: Path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "case.nml").write_text(CONTACT + PAIRS["two maps"])
    swapped = [heights["two"], heights["one"]]
    with solver_on_heights(
        Case("case.nml"), dict(zip(("surface", "second_surface"), swapped, strict=True))
    ) as solver:
        solver.checkpoint(tmp_path / "out")
        while solver.summary.get("steps", 0) < 3:
            solver.advance()
        assert solver.save_state(at_once=True)
    for name, values in zip(("surface", "second_surface"), swapped, strict=True):
        assert np.array_equal(np.load(tmp_path / "out.checkpoint" / f"{name}.npy"), values)
    shutil.copytree(tmp_path / "out.checkpoint", tmp_path / "two.checkpoint")
    fields = []
    for driver, place in (("ehl", "out"), ("pyehl", "two")):
        done = drive(driver, "--resume", place, "--set", "time.steps=5")
        assert (done.returncode, done.stderr) == (1, "")
        fields.append(np.load(tmp_path / place / "RR.npy"))
    assert np.array_equal(*fields)


def test_maps_are_prepared(heights, tmp_path: Path, monkeypatch, capsys):
    """Each map by its own keys; the plan and the summary report both."""
    monkeypatch.chdir(tmp_path)
    text = CONTACT + MAP.format("surface", "one", "detrend = 'tilt'")
    text += MAP.format("second_surface", "two", "edges = 'mirror' track = 1e-5 sign = -1")
    (tmp_path / "case.nml").write_text(text + STEPS.format(3))
    assert cli.main(["run", "case.nml", "-o", "out"]) == 1
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["surface_preparation"]["edges"] == "periodic"
    assert summary["second_surface_preparation"]["edges"] == "mirror"
    assert (tmp_path / "out" / "plan.txt").read_text().count("pixels") >= 2
    # the same heights, prepared before
    assert summary["surface_rms_m"] > 0.0
    alone = Case.from_text(text + STEPS.format(3), {"surface.kind": "smooth"})
    with Solver(alone) as solver:
        assert "second_surface_preparation" in solver.summary
        assert "surface_preparation" not in solver.summary


@pytest.mark.long
def test_prediction_of_either_body_and_of_both(heights, tmp_path: Path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    first, second = FRACTAL.format("surface"), FRACTAL.format("second_surface")
    (tmp_path / "case.nml").write_text(CONTACT + first + second)
    assert cli.main(["predict", "case.nml", "--tracks", "1", "--no-plots", "-o", "one"]) == 0
    summary = json.loads((tmp_path / "one" / "summary.json").read_text())
    slips = f"contact.slide_to_roll=0.4,{FASTER - SLOWER}"
    words = ["sweep", "case.nml", "--run", "predict", "--vary", slips]
    assert cli.main([*words, "-o", "swept"]) == 0
    with (tmp_path / "swept" / "results.csv").open(newline="") as stream:
        _, swept = csv.DictReader(stream)
    # digits that a table does not have are not compared
    assert float(swept["mu_ratio"]) == pytest.approx(summary["mu_ratio"], rel=1e-6)
    assert float(swept["second_velocity_ratio"]) == pytest.approx(SLOWER)
    # a surface on body 2 is predicted as either group
    alone = Case.from_text(CONTACT + second)
    other = Case.from_text(CONTACT + first, ["contact.rough_surface=2"])
    assert pyehl.predict(alone).mu_ratio == pyehl.predict(other).mu_ratio
    # a wave of zero height is no surface
    none = "&second_surface kind = 'harmonic' amplitude = 0 wavelength = 1 /\n"
    beside = Case.from_text(CONTACT + first + none)
    assert pyehl.predict(beside).mu_ratio == pyehl.predict(Case.from_text(CONTACT + first)).mu_ratio
    # a single feature with roughness has no mean
    dent = CONTACT + first + "&second_surface kind = 'dent' amplitude = 1e-3 width = 1 /\n"
    (tmp_path / "dent.nml").write_text(dent)
    assert cli.main(["predict", "dent.nml", "-o", "two"]) == 2
    assert "second_surface.kind = 'dent': a single feature" in capsys.readouterr().err
    assert not (tmp_path / "two").exists()


@pytest.mark.long
def test_curve_of_two_surfaces(tmp_path: Path, monkeypatch, capsys):
    """Other seeds of both; the film is over the composite roughness."""
    monkeypatch.chdir(tmp_path)
    both = CONTACT + FRACTAL.format("surface") + FRACTAL.format("second_surface")
    (tmp_path / "case.nml").write_text(both)
    words = ["stribeck", "case.nml", "--speed", "0.5", "--surfaces", "2", "--jobs", "1"]
    assert cli.main([*words, "-o", "out"]) == 0
    (path,) = tmp_path.glob("out/*.csv")
    lines = [x for x in path.read_text().splitlines() if not x.startswith("#")]
    row = dict(zip(lines[0].split(","), lines[1].split(","), strict=True))
    keys = {"contact.mean_velocity": 0.5}
    # the seed of the second surface is greater by one by default
    groups = ("surface", "second_surface")
    seeds = [{f"{group}.seed": 1 + k + n for n, group in enumerate(groups)} for k in (0, 1)]
    each = [pyehl.predict(Case.from_text(both, keys | seed), tracks=1) for seed in seeds]
    assert each[0].mu_ratio != each[1].mu_ratio
    assert float(row["mu_ratio"]) == pytest.approx(np.mean([p.mu_ratio for p in each]), rel=1e-6)
    # of the solved contact on its own grid
    assert float(row["lambda_ratio"]) * np.hypot(5e-9, 5e-9) == pytest.approx(
        float(row["h_min_m"]), rel=1e-6
    )


def test_waves_that_are_left_out_are_predicted(heights, tmp_path: Path):
    """The error also includes the waves of two surfaces that the grid omits."""
    # the tile of the slower body is half as long: both return to their start at the same time
    text = CONTACT.replace("65", "33") + FRACTAL.format("surface")
    text += FRACTAL.format("second_surface").replace("1e-4", "5e-5")
    with Solver(Case.from_text(text + "&time max_periods = 3 tolerance = 0.3 /\n")) as solver:
        plan = solver.describe(predict=True)
        solver.run()
        summary = solver.summary
    assert summary["status"] == "converged"
    assert summary["variance_left_out"] > 0.1
    assert "predicted   mu_r/mu_s" in plan
    assert summary["mu_ratio_error_left_out"] > 0.0
    alone = Case.from_text(text, {"second_surface.kind": "smooth"})
    both, one = resolution(Case.from_text(text)), resolution(alone)
    assert both.left_out != one.left_out
    assert summary["mu_ratio_error_left_out"] == pytest.approx(abs(both.left_out), rel=1e-6)


def test_second_surface_as_a_map(heights, tmp_path: Path, monkeypatch, capsys):
    """`pyehl surface --second` shows and writes the surface of the other body."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "case.nml").write_text(CONTACT + MAP.format("second_surface", "two", ""))
    assert cli.main(["surface", "case.nml"]) == 2
    assert "expected: surface.kind" in capsys.readouterr().err
    words = ["surface", "case.nml", "--second", "-o", "tile.npy", "--no-plots"]
    assert cli.main(words) == 0
    values = heights["two"] - heights["two"].mean()
    assert np.load("tile.npy") == pytest.approx(values, abs=1e-20)
    made = Case("tile.npy.nml").resolve()
    assert made["surface"]["velocity_ratio"] == pytest.approx(SLOWER, rel=1e-15)
    assert cli.main([*words[:3], "--set", "second_surface.kind=smooth"]) == 2
    assert "expected: second_surface.kind" in capsys.readouterr().err


def test_film_ratio_of_both_surfaces():
    one = Case.from_text(CONTACT + FRACTAL.format("surface"))
    second = Case.from_text(CONTACT + FRACTAL.format("second_surface").replace("5e-9", "1.2e-8"))
    both = Case.from_text(one.text, {f"second_surface.{k}": v for k, v in {
        "kind": "fractal", "pixels": 32, "length_x": 1e-4, "length_y": 1e-4, "rms_height": 1.2e-8,
    }.items()})  # fmt: skip
    sheets = [pyehl.film(case).summary for case in (one, second, both)]
    assert [s["surface"] for s in sheets] == ["fractal", "fractal", "fractal and fractal"]
    sigma = [s["rms_height_m"] for s in sheets]
    assert sigma == pytest.approx([5e-9, 1.2e-8, 1.3e-8], rel=1e-9)
    films = [s["lambda_ratio_central"] * s["rms_height_m"] for s in sheets]
    assert films == pytest.approx([films[0]] * 3, rel=1e-12)


def test_pictures(heights, tmp_path: Path, monkeypatch):
    """The deformed roughness is that of both; eq. 16, which is for one surface, is omitted."""
    monkeypatch.chdir(tmp_path)
    text = CONTACT + WAVE.format("surface", "") + WAVE.format("second_surface", "")
    data = pyehl.solve(Case.from_text(text), {"time.estimate_error": False}, output="out")
    assert data.attrs["status"] == "converged"
    x = data.X.values[:, None]
    ahead = [u * data.attrs["T"] - 2.5 for u in (FASTER, SLOWER)]
    k, y = 2.0 * np.pi, data.Y.values
    expected = sum(2e-3 * np.cos(k * (x - front)) for front in ahead) * np.cos(k * y)
    assert data.RR.values == pytest.approx(expected, abs=1e-14)
    assert {"deformed_roughness", "friction"} <= set(pyehl.plot("out"))
