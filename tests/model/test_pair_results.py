# SPDX-License-Identifier: BSD-3-Clause
"""Predictions of two rough surfaces: results of cases, statistics, arrays and folders."""

import json
import math

import numpy as np
import pytest

import pyehl
from pyehl import cli
from pyehl.surfaces import Topography, fractal

SI = "&contact load = 120.0 slide_to_roll = 0.2 /\n"
FRACTAL = (
    "&{} kind = 'fractal' pixels = 64 length_x = {} length_y = 2e-4 rms_height = {} seed = {} /\n"
)
# lengths of 2e-4 m at 1.1 and 0.9 times the mean velocity: common period
FIRST = FRACTAL.format("{}", 2.2e-4, 1e-8, 3)
SECOND = FRACTAL.format("{}", 1.8e-4, 2e-8, 4)


@pytest.mark.parametrize(
    "length",
    ["1.8e-4", pytest.param("1.9e-4", marks=pytest.mark.long)],
    ids=["common period", "none"],
)
def test_exchange_of_the_two_bodies(length):
    """The roughness of body 1 and of body 2, as either group: the same bits."""
    second = SECOND.replace("0.00018", length)
    texts = [SI, SI.replace("load", "rough_surface = 2 load")]
    texts[0] += FIRST.format("surface") + second.format("second_surface")
    texts[1] += second.format("surface") + FIRST.format("second_surface")
    one, other = (pyehl.predict(pyehl.Case.from_text(text), tracks=3) for text in texts)
    assert one.mu_ratio == other.mu_ratio > 1.05
    assert one.bands == other.bands
    for name in ("mu_ratio_min", "mu_ratio_max", "mu_ratio_tracks", "mu_ratio_tracks_spread",
                 "h_min_rough_m", "lambda_ratio", "surface_rms_m", "surface_slope"):  # fmt: skip
        assert one.summary[name] == other.summary[name], name
    for name in ("velocity_ratio", "rms_height_m", "rms_deformed_m", "rms_pressure_Pa"):
        assert one.summary[name] == other.summary[f"second_{name}"], name
        assert other.summary[name] == one.summary[f"second_{name}"], name
    assert np.array_equal(one.data.deformed_m.values, other.data.second_deformed_m.values)


def test_smooth_second_surface_changes_nothing():
    text = SI + FIRST.format("surface")
    one = pyehl.predict(pyehl.Case.from_text(text))
    other = pyehl.predict(pyehl.Case.from_text(text + "&second_surface kind = 'smooth' /\n"))
    assert one.mu_ratio == other.mu_ratio
    assert one.bands == other.bands


@pytest.mark.parametrize("ahead", [0.1125, 0.3375])
def test_waves_against_the_full_simulation(ahead):
    """Waves with one common period: the mean depends on where they meet, as predicted."""
    keys = {
        "contact.moes_m": 200.0, "contact.moes_l": 10.0, "contact.slide_to_roll": 0.2,
        "grid.points": 129, "grid.x_inlet": -2.5, "grid.x_outlet": 1.5, "grid.y_extent": 2.0,
        "surface.kind": "harmonic", "surface.amplitude": 5e-3, "surface.wavelength": 0.55,
        "second_surface.kind": "harmonic", "second_surface.amplitude": 5e-3,
        "second_surface.wavelength": 0.45, "second_surface.x_start": -2.5 - ahead,
        "time.estimate_error": False,
    }  # fmt: skip
    case = pyehl.Case.from_text("", keys)
    predicted, simulated = pyehl.predict(case, tracks=1), pyehl.solve(case)
    assert float(simulated.T_period) == pytest.approx(0.5, rel=1e-9)
    assert predicted.mu_ratio == pytest.approx(float(simulated.mu_ratio), rel=0.02)
    assert float(simulated.mu_ratio) == pytest.approx({0.1125: 1.06, 0.3375: 1.34}[ahead], abs=0.02)


def test_composite_statistics():
    """Rms height and slope of the sum of both, and the film over them."""
    keys = {
        "contact.load": 120.0, "contact.slide_to_roll": 1.1,
        "surface.kind": "harmonic", "surface.amplitude": 5e-3, "surface.wavelength": 1.0,
        "second_surface.kind": "harmonic", "second_surface.amplitude": 3e-3,
        "second_surface.wavelength": 0.5,
    }  # fmt: skip
    about = pyehl.predict(pyehl.Case.from_text("", keys), tracks=1).summary
    scale, a = about["film_scale_m"], about["hertz_radius_m"]
    rms = [0.5 * amplitude * scale for amplitude in (5e-3, 3e-3)]
    assert (about["rms_height_m"], about["second_rms_height_m"]) == pytest.approx(rms, rel=1e-9)
    assert about["surface_rms_m"] == pytest.approx(np.hypot(*rms), rel=1e-9)
    slopes = [
        r * np.sqrt(2.0) * 2.0 * np.pi / (length * a)
        for r, length in zip(rms, (1.0, 0.5), strict=True)
    ]
    assert about["surface_slope"] == pytest.approx(np.hypot(*slopes), rel=1e-9)
    assert about["lambda_ratio"] == pytest.approx(about["h_min_m"] / np.hypot(*rms), rel=1e-9)
    assert about["outside_range"] == ["velocity_ratio"]


def test_surfaces_in_memory():
    """Arrays that replace both surfaces are predicted as those from the case."""
    text = SI + FIRST.format("surface") + SECOND.format("second_surface")
    made = pyehl.predict(pyehl.Case.from_text(text), tracks=1)
    given = pyehl.predict(
        pyehl.Case.from_text(text),
        surface=made.surface.heights,
        second_surface=Topography(
            made.surfaces[1].topography.heights, made.surfaces[1].topography.size
        ),
        tracks=1,
    )
    assert given.mu_ratio == pytest.approx(made.mu_ratio, rel=1e-12)


def test_folder(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    text = SI + FIRST.format("surface") + SECOND.format("second_surface")
    (tmp_path / "case.nml").write_text(text)
    assert cli.main(["predict", "case.nml", "--tracks", "2", "-o", "out"]) == 0
    reported = capsys.readouterr().out
    assert "second     fractal" in reported
    assert "complex response at velocity ratio 1.1 and 0.9" in reported
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    pictures = {"second_surface_spectrum.png", "second_roughness.png", "roughness.png"}
    assert pictures <= set(summary["files"])
    data = pyehl.load("out")
    assert data.second_deformed_m.dims == ("second_x_m", "second_y_m")
    assert float(data.second_deformed_m.std()) == pytest.approx(summary["second_rms_deformed_m"])
    moved = data.passage_second_shift_m.values / data.passage_shift_m.values.clip(1e-12)
    assert moved[1:] == pytest.approx(1.8 / 2.2)
    # into the same folder, without the second: its files are removed
    words = ["predict", "case.nml", "--tracks", "1", "-o", "out"]
    assert cli.main([*words, "--set", "second_surface.kind=smooth"]) == 0
    assert not list((tmp_path / "out").glob("second_*"))


def test_model_of_the_paper_takes_one_surface():
    text = SI + FIRST.format("surface") + SECOND.format("second_surface")
    keys = {"psd.reduction": "amplitude", "psd.smooth": "hertz"}
    with pytest.raises(pyehl.InputError, match="two rough surfaces: the model of the paper"):
        pyehl.predict(pyehl.Case.from_text(text, keys))


@pytest.mark.parametrize(
    ("slide_to_roll", "seed", "alike"), [(0.0, 1, 1.0), (0.0, None, 0.0), (0.1, 1, math.nan)]
)
def test_waves_of_equal_surfaces_that_move_together_add_up(slide_to_roll, seed, alike):
    """Two of 20 nm add up to 40 nm in pure rolling; by default the second one has another seed."""
    keys = "kind = 'fractal' rms_height = 2e-8 pixels = 64"
    second = "" if seed is None else f"seed = {seed}"
    case = pyehl.Case.from_text(
        f"&contact mean_velocity = 2.0 slide_to_roll = {slide_to_roll} /\n&grid points = 33 /\n"
        f"&surface {keys} /\n&second_surface {keys} {second} /\n"
    )
    tiles = [fractal(64, 8.29e-4, 8.29e-4, rms_height=2e-8, hurst=0.8, seed=s)
             for s in (1, seed or 2)]  # fmt: skip
    product = float(np.mean(tiles[0].heights * tiles[1].heights)) / 4e-16
    expected = math.hypot(2e-8, 2e-8)
    if slide_to_roll == 0.0:
        assert product == pytest.approx(alike, abs=0.2)
        expected = float(np.std(tiles[0].heights + tiles[1].heights))
    about = pyehl.predict(case, tracks=1).summary
    assert about["surface_rms_m"] == pytest.approx(expected, rel=1e-9)
    assert about["lambda_ratio"] == pytest.approx(about["h_min_m"] / expected, rel=1e-9)
    assert pyehl.film(case).summary["rms_height_m"] == pytest.approx(expected, rel=1e-9)
    plan = str(pyehl.check(case))
    assert f"composite rms height  {expected:.2E} m".replace("  ", " ") in plan.replace("  ", " ")
    if slide_to_roll:
        assert about["surface_correlation"] is None
        assert "both move together" not in plan
    else:
        assert about["surface_correlation"] == pytest.approx(product, abs=1e-9)
        assert f"correlation {product:.2f}" in plan
    assert ("are alike (correlation 1.00)" in about["assessment"]) == (alike == 1.0)
