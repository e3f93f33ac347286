# SPDX-License-Identifier: BSD-3-Clause
"""Film breakdown, the suggested cut-off wavelength, and many tracks."""

from dataclasses import replace

import numpy as np
import pytest

from pyehl import surfaces
from pyehl.prediction.breakdown import (
    BelowZero,
    advise,
    below_zero,
    suggested_outliers,
    suggested_wavelength,
)
from pyehl.prediction.model import Model
from pyehl.prediction.predict import predict
from pyehl.surfaces import Topography, filtered

LENGTH = 8.29e-4


def flat(film):
    return lambda x, y: np.full((x.size, y.size), film)


def ends(deformed, a, film):
    """Film breakdown over one tile with pixels of a micrometre."""
    tile = Topography(deformed, (1e-6 * deformed.shape[0], 1e-6 * deformed.shape[1]))
    return below_zero([tile], [deformed], (a, a), film)


def test_share_of_one_pixel_follows_from_its_chord():
    """A pixel on the centre line is inside over 2 a of every tile length, one at y over less."""
    deformed = np.zeros((200, 300))
    deformed[40, 0] = 1.2e-7
    a = 1e-4
    result = ends(deformed, a, flat(1e-7))
    # mean over the passage of the area below zero inside the circle, over that of the circle
    assert result.share == pytest.approx(2 * a * 1e-6 / 200e-6 * 1e-6 / (np.pi * a * a), rel=0.01)
    assert result.deepest == pytest.approx(-2e-8)
    assert (result.pixels, result.count) == (((40, 0),), 1)
    deformed[41, 80] = 1.1e-7
    both = ends(deformed, a, flat(1e-7))
    assert both.share / result.share == pytest.approx(1 + np.sqrt(1 - 0.8**2), rel=0.03)
    # a row that never enters the contact
    deformed[0, 150] = 1.0
    assert ends(deformed, a, flat(1e-7)) == both


def test_film_that_is_thin_at_the_edge():
    """A pixel meets the minimum film of its row."""
    deformed = np.zeros((100, 200))
    deformed[7, 30] = 0.5

    def film(x, y):
        return np.where((np.abs(x)[:, None] > 6e-5) & (np.abs(y)[None, :] > 2e-5), 0.3, 1.0)

    result = ends(deformed, 1e-4, film)
    assert (result.pixels, result.deepest) == (((7, 30),), pytest.approx(-0.2))
    deformed[7, 30], deformed[7, 0] = 0.0, 0.5
    assert ends(deformed, 1e-4, film).share == 0.0


def test_share_of_a_tile_smaller_than_the_contact():
    deformed = np.where(np.random.default_rng(1).random((40, 32)) < 0.25, 2.0, 0.0)
    share = ends(deformed, 1e-3, flat(1.0)).share
    assert share == pytest.approx((deformed > 1.0).mean(), rel=1e-2)
    assert ends(np.zeros((8, 8)), 1e-5, flat(1.0)).share == 0.0


def wave(length, amplitude):
    x = np.arange(256) * LENGTH / 256
    return amplitude * np.repeat(np.cos(2 * np.pi * x / length)[:, None], 256, axis=1)


def test_cut_off_with_a_full_film_is_found():
    """Two waves: the long one fits into the film, the short one does not."""
    short = LENGTH / 32
    tile = Topography(wave(LENGTH / 4, 0.5) + wave(short, 1.0), (LENGTH, LENGTH))

    def is_full(shortest):
        return np.abs(filtered(tile, shortest).heights).max() < 0.8

    limits = 2.0 * LENGTH / 256, LENGTH
    result = suggested_wavelength(*limits, is_full)
    assert is_full(result)
    assert not is_full(0.9 * result)
    assert short < result < 1.15 * short
    assert suggested_wavelength(*limits, lambda shortest: False) is None


def test_threshold_with_a_full_film_is_found():
    away = np.random.default_rng(2).random((50, 50))
    away[3, 4], away[5, 6], away[7, 8] = 1000.0, 300.0, 40.0

    def without(threshold):
        return Topography(np.where(away > threshold, 0.0, away), (1e-4, 1e-4))

    result = suggested_outliers(away, without, lambda tile: tile.heights.max() < 100.0)
    assert result is not None
    threshold, points = result
    assert points == 2
    assert 40.0 < threshold < 300.0
    assert suggested_outliers(away, without, lambda tile: False) is None
    # no pixel is a spike
    assert suggested_outliers(np.ones((9, 9)), without, lambda tile: True) is None


@pytest.fixture
def scan(tmp_path, settings):
    """A case with a measured surface: tilt, roughness, two spikes."""
    from SurfaceTopography import Topography as Measured

    made = surfaces.fractal(128, LENGTH, LENGTH, rms_height=2e-8, hurst=0.8, seed=4)
    z = made.heights + 1e-6 * np.linspace(0, 1, 128)[:, None]
    z[30, 40] += 2e-6
    z[100, 90] += 1e-6
    Measured(z, (LENGTH, LENGTH), unit="m").to_x3p(str(tmp_path / "scan.x3p"))
    settings["surface"] |= {
        "kind": "map", "file": str(tmp_path / "scan.x3p"), "length_x": 0.0, "length_y": 0.0,
    }  # fmt: skip
    return settings


def test_film_breakdown_names_place_and_cut_off(scan):
    pytest.importorskip("SurfaceTopography")
    ended = predict(scan)
    assert ended.friction.status == "film breakdown"
    assert np.isnan(ended.mu_ratio)
    advice = ended.advice
    pixel = LENGTH / 128
    assert advice.places[0] == pytest.approx((30 * pixel, 40 * pixel), rel=1e-6)
    summary = ended.summary
    assert 0.0 < summary["film_below_zero_share"] < 1e-3
    assert summary["film_breakdown"]["film_m"] < 0.0
    assert summary["film_breakdown"]["share_of_contact"] == summary["film_below_zero_share"]
    assert advice.outlier_points == 2
    text = "\n".join(advice.report())
    assert "2 points count as spikes and are removed" in text
    # the suggestion gives a full film
    scan["surface"]["outliers"] = advice.outliers
    good = predict(scan)
    assert good.friction.status == "predicted"
    assert good.mu_ratio == pytest.approx(1.0, abs=0.2)
    assert good.summary["film_below_zero_share"] == 0.0
    assert good.summary["film_breakdown"] is None
    steps = good.summary["surface_preparation"]["steps"]
    assert steps[0]["points_changed"] == 2
    assert good.mu_ratio < 2.5
    scan["surface"] |= {"outliers": 0.0, "shortest_wavelength": advice.wavelengths[0]}
    cut = predict(scan)
    assert cut.friction.status == "predicted"
    assert cut.mu_ratio < 2.5


def test_suggested_cut_off_has_a_known_error(settings, monkeypatch):
    """A full film is not sufficient if the friction is beyond the model."""
    model, limit = predict(settings).model, 0.0
    ended = BelowZero(0.1, -1e-9, ((0, 0),), 1)

    def without_shorter(_, numbers, shortest):
        tile = Topography(np.zeros((8, 8)), (shortest, LENGTH))
        return replace(model, surfaces=(replace(model.surfaces[0], topography=tile),))

    def known(other):
        return other.surfaces[0].topography.length_x > limit

    monkeypatch.setattr(Model, "without_shorter", without_shorter)
    monkeypatch.setattr("pyehl.prediction.breakdown.known", known)
    # full at every cut-off, predicted from a limit on
    assert advise(model, ended, flat(1e-7)).wavelengths[0] < 3e-4
    limit = 5e-4
    assert advise(model, ended, flat(1e-7)).wavelengths[0] == pytest.approx(5e-4, rel=0.1)
    limit = 1.0
    assert advise(model, ended, flat(1e-7)).wavelengths == (None,)


def test_rough_surfaces_get_no_threshold_of_spikes(settings):
    """Where the roughness itself is too high no height is a spike."""
    settings["surface"]["rms_height"] = 1e-6
    ended = predict(settings)
    assert ended.friction.status == "film breakdown"
    assert ended.advice.outliers is None
    assert ended.summary["film_below_zero_share"] > 1e-3
    assert ended.advice.wavelengths[0] > 1e-5


def test_tracks(scan):
    """Over the map but not over its mirror image; the track shifts the surface across."""
    scan["surface"]["outliers"] = 50.0
    # as many positions on the first track as on the others
    scan["psd"]["positions"] = 8
    one = predict(scan, tracks=1)
    assert one.tracks[0] == pytest.approx(one.mu_ratio, rel=1e-12)
    assert one.tracks[1] == 0.0
    four = predict(scan, tracks=4)
    assert four.summary["tracks"] == 4
    width = LENGTH / 4
    by_hand = []
    for k in range(4):
        scan["surface"]["track"] = (k - 1.5) * width
        by_hand.append(predict(scan, tracks=1).mu_ratio)
    assert four.tracks == pytest.approx((np.mean(by_hand), np.std(by_hand)), rel=1e-9)
    assert np.std(by_hand) > 1e-4


def test_track_is_the_line_that_passes_the_centre(settings):
    from pyehl.theory.operating import OperatingPoint

    whole = surfaces.from_settings(settings, OperatingPoint(), 2e-7)
    settings["surface"]["track"] = 10 * whole.pixel[1]
    moved = surfaces.from_settings(settings, OperatingPoint(), 2e-7)
    assert moved.heights[:, 0] == pytest.approx(whole.heights[:, 10], abs=1e-18)
    for_solver = surfaces.for_solver(settings).heights
    assert for_solver == pytest.approx(moved.heights, abs=1e-18)


@pytest.mark.parametrize("kind", ["sharp", "gaussian"])
def test_gaussian_filter_halves_and_sharp_filter_cuts(kind):
    tile = Topography(wave(LENGTH / 8, 1.0) + wave(LENGTH / 64, 1.0), (LENGTH, LENGTH))
    at = LENGTH / 16
    left, right = (
        2 * np.abs(np.fft.rfft2(cut.heights, norm="forward"))[[8, 64], 0]
        for cut in (filtered(tile, at, 0.0, kind), filtered(tile, 0.0, at, kind))
    )
    if kind == "sharp":
        assert left == pytest.approx([1.0, 0.0], abs=1e-12)
        assert right == pytest.approx([0.0, 1.0], abs=1e-12)
    else:
        # ISO 16610-61: 2^-(cut-off/wavelength)^2
        assert left == pytest.approx([2**-0.25, 2**-16], rel=1e-9)
        assert right == pytest.approx([1 - 2**-0.25, 1 - 2**-16], rel=1e-9)
