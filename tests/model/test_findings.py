# SPDX-License-Identifier: BSD-3-Clause
"""Raw scans: form, offset lines, stitching steps, dust, missing parts, many contacts."""

import logging
import re

import numpy as np
import pytest

import pyehl
from pyehl import cli
from pyehl.errors import InputError
from pyehl.prediction.breakdown import advise
from pyehl.prediction.predict import report_cost, seconds_of
from pyehl.surfaces import Options, Scan, Topography, fractal, prepare
from pyehl.surfaces.findings import find
from pyehl.surfaces.map_steps import align_lines, level
from pyehl.theory.line_contact import LineContact
from pyehl.theory.operating import OperatingPoint

PIXEL = 5e-6
N = 96


def rough(seed=1, hurst=0.8, rms=2e-8, shape=(N, N), rolloff=4e4):
    size = [n * PIXEL for n in shape]
    return fractal(
        shape, *size, rms_height=rms, hurst=hurst, seed=seed, rolloff_wavenumber=rolloff
    ).heights


def places(shape=(N, N)):
    return np.meshgrid(*(np.arange(n) * PIXEL for n in shape), indexing="ij")


def scan(z):
    return Scan(z, z.shape[0] * PIXEL, z.shape[1] * PIXEL, "a scan", is_array=False)


def found(z, options=None):
    return prepare(scan(z), options or Options()).record.findings


def ball(centre, radius=0.018):
    x, y = places()
    return -((x - centre[0] * N * PIXEL) ** 2 + (y - centre[1] * N * PIXEL) ** 2) / (2.0 * radius)


@pytest.mark.parametrize("centre", [(0.5, 0.5), (0.2, 0.9)])
def test_the_form_of_a_ball_is_reported_with_its_key(centre):
    z = rough() + ball(centre)
    (finding,) = found(z)
    assert (finding.kind, finding.remedy) == ("form", "surface.detrend=curvature")
    assert "radius 18 mm along x, 18" in finding.text.replace("18.1", "18").replace("17.9", "18")
    made = prepare(scan(z), Options(detrend="curvature"))
    assert made.record.findings == ()
    assert made.prepared.std() == pytest.approx(2e-8, rel=0.1)
    # an array is not levelled, and the tilt is reported
    kinds = [f.remedy for f in found_in_array(z)]
    assert kinds[0].startswith("surface.detrend=")


def found_in_array(z):
    return find(z, (PIXEL, PIXEL), "none", periodic=True)


def test_a_tilted_array_is_reported():
    (finding,) = found_in_array(rough() + 1e-3 * places()[0])
    assert finding.remedy == "surface.detrend=tilt"


@pytest.mark.parametrize("hurst", [0.2, 0.5, 0.8, 1.0])
@pytest.mark.parametrize("seed", range(4))
def test_roughness_of_every_kind_has_no_findings(hurst, seed):
    """Isotropic, with a lay along or across, plateaus with valleys, periodic waves."""
    z = rough(seed, hurst)
    lay = 0.9 * np.repeat(z[:, :1], N, axis=1) + 0.1 * z
    for heights in (z, lay, lay.T.copy(), np.minimum(z, 1e-8)):
        assert found_in_array(heights) == ()
        flat = heights.copy()
        level(flat, "tilt")
        assert find(flat, (PIXEL, PIXEL), "tilt", periodic=False) == ()


def test_a_single_wave_is_no_form():
    wave = 1e-8 * np.cos(2.0 * np.pi * np.arange(N) / N)
    assert found_in_array(np.outer(wave, np.ones(N))) == ()


@pytest.mark.parametrize("along", ["x", "y"])
@pytest.mark.parametrize("rms", [1e-8, 1e-7])
def test_offsets_between_lines_are_reported_and_removed(along, rms):
    offsets = rms * np.random.default_rng(4).normal(size=N)
    clean = rough()
    z = clean + (offsets[np.newaxis, :] if along == "x" else offsets[:, np.newaxis])
    (finding,) = found(z + 1e-3 * places()[1])
    assert (finding.kind, finding.remedy) == ("line offsets", f"surface.align_lines={along}")
    assert f"lines along {along}" in finding.text
    made = prepare(scan(z), Options(align_lines=along))
    assert made.record.findings == ()
    assert made.prepared.std() == pytest.approx(clean.std(), rel=0.15)
    assert made.steps[0].name == "align_lines"


def test_lines_are_aligned_around_what_is_missing():
    z = rough() + 2e-3 * places()[0]
    straight = z.copy()
    align_lines(straight, "x")
    holed = z + 1e-7 * np.random.default_rng(1).normal(size=N)
    holed[:30, 10] = np.nan
    holed[:, 40] = np.nan
    align_lines(holed, "x")
    there = np.isfinite(holed)
    assert not there[5, 10]
    assert not there[:, 40].any()
    # a line with missing points is aligned by the others; the plane of offsets is that of the map
    rest = np.delete(np.arange(N), [10, 40])
    apart = (holed - straight)[-1]
    assert np.std((holed - straight)[:, rest], axis=0) == pytest.approx(0.0, abs=1e-16)
    fit = np.polyfit(rest, apart[rest], 1)
    assert apart[rest] == pytest.approx(np.polyval(fit, rest), abs=1e-9)
    assert apart[10] == pytest.approx(np.polyval(fit, 10), abs=1e-8)


@pytest.mark.parametrize("axis", [0, 1])
def test_a_stitching_step_is_found_with_its_place(axis):
    z = rough()
    part = [slice(None), slice(None)]
    part[axis] = slice(60, None)
    z[tuple(part)] += 1.5e-7
    (finding,) = found(z)
    name = "xy"[axis]
    assert finding.kind == "stitching step"
    assert f"at {name} = 0.3 mm" in finding.text
    assert finding.remedy == f"surface.crop_{name}_max=0.0003"
    assert len(finding.places) == 4
    assert found(z, Options(crop=(0, 3e-4, 0, 0) if axis == 0 else (0, 0, 0, 3e-4))) == ()
    # positions are those of the map as read
    crop = (1e-4, 0, 0, 0) if axis == 0 else (0, 0, 1e-4, 0)
    (again,) = found(z, Options(crop=crop))
    assert f"at {name} = 0.3 mm" in again.text
    assert again.places[0][2 * axis] == pytest.approx(3e-4)


def test_a_step_of_one_field_is_found():
    z = rough()
    z[48:, :48] += 1e-7
    kinds = [f.kind for f in found(z)]
    assert kinds == ["stitching step"] * 2


def test_dust_of_several_pixels_is_found():
    z = rough()
    z[30:34, 50:54] += 8e-7
    z[70:73, 10:13] += 3e-7
    (finding,) = found(z)
    assert finding.kind == "dust"
    assert "2 specks" in finding.text
    assert "on 16 pixels at x = 0.16 mm, y = 0.26 mm" in finding.text
    assert finding.places[0] == pytest.approx((1.5e-4, 1.7e-4, 2.5e-4, 2.7e-4))
    assert finding.remedy == "surface.outliers=6"
    kept = prepare(scan(z), Options(outliers=200.0))
    assert [f.kind for f in kept.record.findings] == ["dust"]
    made = prepare(scan(z), Options(outliers=6.0))
    assert made.record.findings == ()
    steps = {step.name: step for step in made.steps}
    # with margins of one pixel
    assert steps["outliers"].changed == 6 * 6 + 5 * 5
    assert made.prepared.std() == pytest.approx(prepare(scan(rough())).prepared.std(), rel=0.02)


def test_spikes_are_found():
    z = rough()
    z[20, 33] += 1e-6
    z[64, 71:73] += 7e-7
    (finding,) = found(z)
    assert finding.kind == "spikes"
    assert finding.text.startswith("2 spikes of fewer than 5 pixels, the highest")
    assert prepare(scan(z), Options(outliers=8.0)).record.findings == ()


def test_missing_points_are_shown_and_a_part_is_proposed():
    z = rough()
    z[:9] = np.nan
    z[50:60, 40:52] = np.nan
    with pytest.raises(InputError, match=r"heights are missing \(10\.7 %\)") as info:
        prepare(scan(z))
    text = str(info.value)
    assert "|####" in text
    options = dict(
        word.rstrip(":,").split("=")
        for word in text.split()
        if word.startswith("surface.crop_") and "=" in word
    )
    crop = tuple(float(options[f"surface.crop_{k}_{e}"]) for k in "xy" for e in ("min", "max"))
    made = prepare(scan(z), Options(crop=crop))
    assert made.prepared.size > 0.4 * z.size


def thin_film(x, y):
    return np.zeros((x.size, y.size))


def test_findings_are_reported_predicted_and_drawn(tmp_path, capsys):
    """A ball without levelling: removal of the form is suggested, and no cut-off."""
    path = tmp_path / "ball.npy"
    np.save(path, rough() + ball((0.5, 0.5)))
    size = {"surface.length_x": N * PIXEL, "surface.length_y": N * PIXEL}
    case = pyehl.Case.from_text(f"&surface kind='map' file='{path}' edges='mirror' /", size)
    result = pyehl.predict(case, tracks=1)
    assert result.summary["status"] == "beyond linear response"
    assert "; first surface.detrend=curvature (form)" in result.summary["message"]
    assert "shortest_wavelength" not in result.summary["message"]
    advice = advise(result.model, result.below, thin_film)
    assert not advice.wavelengths
    assert "first      surface.detrend=curvature (form)" in advice.report()[1]
    assert result.summary["surface_findings"] == "form"
    assert result.summary["surface_preparation"]["findings"][0]["kind"] == "form"
    level_case = case.with_options({"surface.detrend": "curvature"})
    assert pyehl.predict(level_case, tracks=1).summary["status"] == "predicted"
    dusty = rough()
    dusty[30:34, 50:54] += 8e-7
    np.save(path, dusty)
    arguments = [f"{k}={v}" for k, v in size.items()]
    command = ["surface", str(path), "-o", str(tmp_path / "tile.npy")]
    for argument in arguments:
        command += ["--set", argument]
    assert cli.main(command) == 0
    assert "found    dust: 1 speck" in capsys.readouterr().out
    assert (tmp_path / "tile.npy.png").is_file()


def test_findings_are_in_the_assessment():
    z = rough(rms=5e-9) + 1e-9 * np.random.default_rng(4).normal(size=N)
    case = pyehl.Case.from_text("&surface kind='fractal' /")
    made = prepare(Scan(z, N * PIXEL, N * PIXEL, "lines"))
    result = pyehl.predict(case, surface=Topography(made.tile, made.lengths, "lines", None, made))
    assert result.summary["status"] == "predicted"
    assert "but the map is not roughness alone: line offsets" in result.summary["assessment"]


def test_a_scan_of_many_contacts_reports_its_cost_and_proposes_a_part(caplog, monkeypatch):
    n, size = 1024, 5e-3
    tile = Topography(np.zeros((n, n)), (size, size), "wide")
    point = OperatingPoint()
    assert seconds_of(tile, point) == pytest.approx(1.5e-5 * n * n, rel=0.2)
    z = rough(shape=(64, 64))
    monkeypatch.setattr("pyehl.prediction.predict.REPORTED", 0.5)
    made = prepare(Scan(z, 6e-3, 6e-3, "wide", is_array=False))
    surface = Topography(made.tile, made.lengths, "wide", None, made)
    caplog.set_level(logging.INFO, "pyehl")
    case = pyehl.Case.from_text("&surface kind='fractal' /")
    # reported before the calculation begins
    monkeypatch.setattr("pyehl.prediction.predict.Model", None)
    with pytest.raises(TypeError):
        pyehl.predict(case, surface=surface)
    assert "the map is 7 x 7 contacts long and wide" in caplog.text
    assert "A part of 3 contacts" in caplog.text
    assert "surface.crop_x_min=0.0017" in caplog.text


def test_the_cost_of_a_map_under_a_line_has_no_number_of_contacts_across(caplog, monkeypatch):
    monkeypatch.setattr("pyehl.prediction.predict.REPORTED", 0.0)
    caplog.set_level(logging.INFO, "pyehl")
    tile = Topography(np.zeros((64, 64)), (6e-3, 6e-3), "wide")
    report_cost(tile, LineContact.from_moes(20.0, 10.0))
    assert re.search(r"the map is \d+ contacts long$", caplog.text, re.MULTILINE)
