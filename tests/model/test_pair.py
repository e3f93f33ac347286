# SPDX-License-Identifier: BSD-3-Clause
"""The prediction for two rough surfaces: exact special cases, sums of waves, positions, films."""

from dataclasses import replace

import numpy as np
import pytest

import pyehl
from pyehl.contact.smooth import zone_of
from pyehl.prediction.breakdown import of_model, ways_into_range
from pyehl.prediction.friction import run
from pyehl.prediction.model import Model, ModelOptions, RoughSurface
from pyehl.prediction.relative_positions import RelativePositions, common_passages
from pyehl.prediction.response import Transfer
from pyehl.prediction.spectrum import Spectrum
from pyehl.surfaces import Topography, fractal
from pyehl.surfaces import pair as pair_of_tiles
from pyehl.surfaces.pair import merged
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint

POINT, OIL = OperatingPoint(), Lubricant()
RADIUS = POINT.hertz_radius
FRACTAL = (
    "&{} kind = 'fractal' pixels = 64 length_x = {} length_y = 2e-4 rms_height = {} seed = {} /\n"
)


def rough(seed: int, rms: float = 2e-8, length: float = 4e-4) -> Topography:
    made = fractal(64, length, length, rms_height=rms, hurst=0.8, rolloff_wavenumber=0.0, seed=seed)
    return replace(made, seed=None)


def wave(length: float, amplitude: float) -> Topography:
    """Ridges across the motion [a], [a^2/R]."""
    x = np.cos(2.0 * np.pi * np.arange(64) / 64) * amplitude * POINT.film_scale
    return Topography(np.repeat(x[:, np.newaxis], 64, axis=1), (length * RADIUS, RADIUS))


def alone(contact, tile, ratio, **options) -> Model:
    return Model.of_one(tile, contact, POINT, OIL, ModelOptions(**options), ratio)


def pair(contact, tiles, ratios, fronts=(-2.5, -2.5)) -> Model:
    of_each = zip(tiles, ratios, fronts, (("surface",), ("second_surface",)), strict=True)
    rough = (RoughSurface(tile, u, front, groups=group) for tile, u, front, group in of_each)
    return Model(tuple(rough), contact, POINT, OIL, ModelOptions())


def one_transfer(spectrum, zone, moes, ratio, **options) -> Transfer:
    return Transfer.of_all([(spectrum, ratio)], zone, moes, **options)[0]


@pytest.mark.parametrize("ratio", [pytest.param(1.05, marks=pytest.mark.long), 0.8])
def test_vanishing_second_roughness(contact, ratio):
    """A pair is evaluated at other points than one surface."""
    single, _, _ = run(alone(contact, rough(3), ratio), 0)
    both, _, _ = run(pair(contact, (rough(3), rough(4, 1e-15)), (ratio, 2.0 - ratio)), 0)
    # 1e-4 at both; at 0.8 the tiles return to their start after few passages
    assert both.mu_ratio == pytest.approx(single.mu_ratio, rel=5e-4)


def test_two_tiles_without_sliding_are_one(contact):
    one, other = rough(3), rough(4)
    added = Topography(one.heights + other.heights, one.size)
    single, over, bands = run(alone(contact, added, 1.0), 3)
    both, over_both, bands_both = run(pair(contact, (one, other), (1.0, 1.0)), 3)
    assert (both.mu_ratio, over_both, bands_both) == (single.mu_ratio, over, bands)
    # two tiles of one are as long as one of the other
    short = Topography(other.heights, (0.5 * other.length_x, other.length_y))
    doubled = Topography(np.tile(short.heights, (2, 1)), other.size)
    result, _, _ = run(pair(contact, (one, short), (1.0, 1.0)), 0)
    expected, _, _ = run(pair(contact, (one, doubled), (1.0, 1.0)), 0)
    assert result.mu_ratio == pytest.approx(expected.mu_ratio, rel=1e-6)


def test_small_waves_are_deformed_as_if_alone(contact):
    """The change of the leakage with amplitude is of second order."""
    tiles, ratios = (rough(3, 1e-11), rough(4, 1e-11)), (1.1, 0.9)
    for result, tile, ratio in zip(
        pair(contact, tiles, ratios).responses(), tiles, ratios, strict=True
    ):
        (expected,) = alone(contact, tile, ratio).deformed()
        assert result.deformed == pytest.approx(expected, abs=1e-6 * np.abs(expected).max())


@pytest.mark.long
def test_increases_of_small_waves_add(contact):
    """They meet in all positions, and products of waves of different surfaces have no mean."""
    tiles = rough(3, 2e-9), rough(4, 2e-9, 3.1e-4)
    both_rough, _, _ = run(pair(contact, tiles, (1.1, 0.9)), 0)
    each = [run(alone(contact, t, u), 0)[0] for t, u in zip(tiles, (1.1, 0.9), strict=True)]
    sum_of_increases = sum(one.mu_ratio - 1.0 for one in each)
    assert both_rough.mu_ratio - 1.0 == pytest.approx(sum_of_increases, rel=0.05)


def test_cross_terms_of_second_order(contact):
    """Two surfaces at one velocity have the gain and variance of the sum of their spectra."""
    zone = zone_of(contact, POINT, OIL)
    moes = POINT.moes_m, POINT.moes_l
    tiles = [rough(3), rough(4, 3e-8)]
    spectra = [Spectrum.of(t.heights / POINT.film_scale, 1.0, 1.0) for t in tiles]
    of = [s.power for s in spectra]
    first, _ = Transfer.of_all([(s, 1.05) for s in spectra], zone, moes)
    gain, variance = first.second.of(*of)
    single = one_transfer(spectra[0], zone, moes, 1.05)
    gain_of_sum, variance_of_sum = single.second.of(of[0] + of[1])
    assert gain == pytest.approx(gain_of_sum, rel=1e-9)
    assert variance == pytest.approx(variance_of_sum, rel=1e-9)
    # unless one wave is much larger, most of it is by pairs of one wave of each surface
    alone_gain, alone_variance = first.second.of(of[0], 0.0 * of[1])
    other_gain, other_variance = first.second.of(0.0 * of[0], of[1])
    own = alone_gain * alone_variance**2 + other_gain * other_variance**2
    cross = gain * variance**2 - own
    assert np.all(cross > 0.5 * own)
    # the same in the other order
    second = Transfer.of_all([(s, 1.05) for s in spectra[::-1]], zone, moes)[0].second
    assert second.of(*of[::-1])[0] == pytest.approx(gain, rel=1e-12)


def test_leak_of_two_surfaces_follows_their_total_amplitude(contact):
    """Two halves of the power leak as the whole does."""
    zone, moes = zone_of(contact, POINT, OIL), (POINT.moes_m, POINT.moes_l)
    heights = rough(3, 4e-8).heights / POINT.film_scale
    whole = Spectrum.of(heights, 1.0, 1.0)
    half = Spectrum.of(heights / np.sqrt(2.0), 1.0, 1.0)
    (one, _) = Transfer.of_all([(half, 1.05)] * 2, zone, moes, at_amplitude=True)
    single = one_transfer(whole, zone, moes, 1.05, at_amplitude=True)
    small = one_transfer(whole, zone, moes, 1.05)
    assert one.free[1] == pytest.approx(single.free[1], rel=1e-9)
    assert np.abs(single.free[1] - small.free[1]).max() > 5e-4


def test_positions():
    assert common_passages((1.1, 0.9), (1.1, 0.9)) == (1, 1)
    assert common_passages((0.55, 0.9), (1.1, 0.9)) == (2, 1)
    assert common_passages((1.0, 1.0), (1.2, 0.8)) == (3, 2)
    assert common_passages((1.0, 1.0), (1.01, 0.99)) is None
    assert common_passages((1.0, 1.0), (2.0, 0.0)) == (1, 0)
    # over a common period: products that recur have a mean, which depends on the start
    q = 2.0 * np.pi
    for ahead in (0.0, 0.2):
        line = RelativePositions((1.1, 0.9), (1.1, 0.9), (0.0, ahead))
        mean = line.short_mean(
            lambda all_shifts: [np.cos(q * s / 1.1) * np.cos(q * t / 0.9) for s, t in all_shifts]
        )
        assert mean == pytest.approx(0.5 * np.cos(q * ahead / 0.9), abs=1e-12)
    # over all positions: products of different tiles have none
    lattice = RelativePositions((1.0, 1.0), (1.01, 0.99), (0.0, 0.3))
    for i, j in ((1, 0), (0, 1), (1, 1), (1, -1), (2, 3), (3, -1)):
        mean = lattice.short_mean(
            lambda all_shifts, i=i, j=j: [np.cos(q * (i * s + j * t)) for s, t in all_shifts]
        )
        assert mean == pytest.approx(0.0, abs=1e-12), (i, j)
    # the same positions for the other order of the two
    points = {lattice.moved(k, 48, 7) for k in range(48)}
    assert points == {(b, a) for a, b in points}


@pytest.mark.long
def test_error_of_the_number_of_positions(contact):
    result, _, _ = run(pair(contact, (rough(3), rough(4, length=3.7e-4)), (1.05, 0.95)), 0)
    more = pair(contact, (rough(3), rough(4, length=3.7e-4)), (1.05, 0.95))
    finer, _, _ = run(replace(more, options=ModelOptions(positions=1600)), 0)
    assert finer.passage.size == 1680
    error = abs(result.mu_ratio / finer.mu_ratio - 1.0)
    assert error < result.position_error + finer.position_error < 0.01


def test_film_between_two_tiles(contact):
    """Minimum film over all positions: the highest points of a line meet, in a period few do."""

    def film(x, y):
        return np.full((x.size, y.size), 1e-7)

    rng = np.random.default_rng(1)
    heights = [np.zeros((64, 64)) for _ in range(2)]
    heights[0][10, 3], heights[1][40, 3] = 7e-8, 6e-8
    heights[0][20, 5], heights[1][5, 6] = 9e-8, 9e-8
    heights[0] += 1e-10 * rng.random((64, 64))
    flat = Topography(np.ones((64, 64)), (RADIUS, RADIUS))
    all_positions = pair(contact, (flat, flat), (1.01, 0.99))
    result = of_model(all_positions, heights, film)
    assert result.deepest == pytest.approx(-3e-8, abs=2e-10)
    assert result.pixels == ((10, 3), (40, 3))
    # tiles with lengths as their velocities: a pixel of one meets few of the other
    longer = Topography(flat.heights, (1.01 * RADIUS, RADIUS))
    shorter = Topography(flat.heights, (0.99 * RADIUS, RADIUS))
    assert common_passages((1.01, 0.99), (1.01, 0.99)) == (1, 1)
    deepest = []
    for ahead in np.arange(64) / 64:
        moved = pair(contact, (longer, shorter), (1.01, 0.99), (-2.5, -2.5 + ahead * 0.99))
        deepest.append(of_model(moved, heights, film).deepest)
    assert min(deepest) == pytest.approx(result.deepest, abs=1e-15)
    # the others do not meet
    assert sum(d > 5e-9 for d in deepest) > 50


def breaking(load: float = 120.0) -> str:
    return (
        f"&contact load = {load} slide_to_roll = 0.2 mean_velocity = 0.1 /\n"
        + FRACTAL.format("surface", 2.2e-4, 3e-9, 3)
        + FRACTAL.format("second_surface", 1.7e-4, 8e-8, 4)
    )


@pytest.mark.long
def test_suggested_cut_off_of_two_surfaces():
    """One surface breaks the film: only a cut-off of that one gives a full film."""
    result = pyehl.predict(pyehl.Case.from_text(breaking()))
    assert result.summary["status"] == "film breakdown"
    assert np.isnan(result.mu_ratio)
    about = result.summary["film_breakdown"]
    assert about["film_m"] < 0.0
    assert 0.0 < about["share_of_contact"] < 1.0
    assert about["suggested_shortest_wavelength_m"] is None
    cut = about["suggested_second_shortest_wavelength_m"]
    both = about["suggested_both_shortest_wavelength_m"]
    assert 0.0 < both <= cut
    reported = "\n".join(result.advice.report())
    assert "of surface meets x = " in reported
    assert f"second_surface.shortest_wavelength = {cut:.4g}" in reported
    mended = pyehl.predict(
        pyehl.Case.from_text(breaking(), {"second_surface.shortest_wavelength": cut})
    )
    assert mended.summary["status"] == "predicted"
    assert mended.model_error > 0.0


@pytest.mark.long
def test_beyond_the_linear_response_names_cut_offs(contact):
    tiles = rough(3, 2e-8), rough(4, 9.5e-8)
    both = pair(contact, tiles, (1.1, 0.9))
    result, over, bands = run(both)
    assert result.status == "beyond linear response", result
    assert np.isnan(over[0])
    assert not bands
    ways = ways_into_range(both)
    assert "second_surface.shortest_wavelength = " in ways
    assert "surface.shortest_wavelength and second_surface.shortest_wavelength = " in ways


def test_advice_names_the_surfaces_that_it_cuts(contact):
    """Both if they move together, the second one if only that is rough."""
    both = pair(contact, (rough(3, 9e-8), rough(4, 9e-8)), (1.0, 1.0))
    assert both.merged.surfaces[0].groups == ("surface", "second_surface")
    second = replace(both.surfaces[1], topography=rough(4, 1.2e-7), velocity_ratio=1.1)
    alone = replace(both, surfaces=(second,))
    result, _, _ = run(alone, 0)
    assert result.status == "beyond linear response", result
    ways = ways_into_range(alone)
    assert ways.startswith("; second_surface.shortest_wavelength = ")
    assert "; surface." not in ways


def test_share_of_a_breakdown_without_sliding():
    text = (
        "&contact load = 120.0 slide_to_roll = 0.0 mean_velocity = 0.1 /\n"
        + FRACTAL.format("surface", 2e-4, 3e-9, 3)
        + FRACTAL.format("second_surface", 2e-4, 2e-7, 4)
    )
    summary = pyehl.predict(pyehl.Case.from_text(text)).summary
    assert summary["status"] == "film breakdown"
    assert 0.0 < summary["film_breakdown"]["share_of_contact"] < 1.0


def test_no_tile_of_too_many_pixels(monkeypatch):
    one, other = rough(3, length=4e-4), rough(4, length=4e-4 * 12 / 11)
    both = merged(one, other, 0.0)
    assert both.length_x == pytest.approx(12 * one.length_x)
    monkeypatch.setattr(pair_of_tiles, "MAX_PIXELS", both.heights.size - 1)
    assert merged(one, other, 0.0) is None


def test_bands_contain_the_waves_of_both(contact):
    tiles = wave(1.1, 2e-3), wave(0.225, 1e-3)
    result, _, bands = run(pair(contact, tiles, (1.1, 0.9)), 0)
    assert len(bands) == 2
    assert bands[0].longest == pytest.approx(1.1 * RADIUS)
    heights = [a * POINT.film_scale / np.sqrt(2.0) for a in (2e-3, 1e-3)]
    assert [band.rms_height for band in bands] == pytest.approx(heights, rel=1e-9)
    assert sum(band.increase for band in bands) == pytest.approx(result.mu_ratio - 1.0, abs=1e-12)
