# SPDX-License-Identifier: BSD-3-Clause
"""Friction along a passage: shear stress over the contact, positions, load balance."""

import math
from dataclasses import replace

import numpy as np
import pytest
from paper_model import predict_friction, response
from scipy.integrate import quad
from scipy.special import j0

from pyehl import surfaces
from pyehl.prediction import ModelOptions
from pyehl.surfaces import Topography
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.shear import ShearLaw

POINT = OperatingPoint()
ROELANDS = Lubricant()
BARUS = Lubricant(viscosity_law="barus")
FILM = 0.2333e-6
LENGTH = 8.29e-4


def test_smooth_surface_changes_nothing():
    flat = Topography(np.zeros((32, 32)), (LENGTH, LENGTH))
    result = predict_friction(flat, POINT, ROELANDS, FILM)
    assert result.status == "predicted"
    assert (result.mu_ratio, result.mu_ratio_min, result.mu_ratio_max) == pytest.approx((1, 1, 1))
    assert result.cavitated_share == 0.0
    assert result.film_min == FILM


def test_waves_across_the_motion_against_quadrature(wave):
    """With Barus the smooth pressure cancels, so the passage mean is a mean over one wave."""
    wavelength, height = 1e-4, 3e-8
    field = response(wave(height, wavelength), POINT)
    z = BARUS.pressure_viscosity * field.pressure.max()
    d = field.deformed.max() / FILM
    expected, _ = quad(
        lambda t: math.exp(z * math.cos(t)) / (1 - d * math.cos(t)) / math.pi, 0, math.pi
    )
    result = predict_friction(wave(height, wavelength), POINT, BARUS, FILM)
    # except at the edge of the contact, where p_s + delta p < 0 counts as cavitated
    assert result.mu_ratio == pytest.approx(expected, rel=1e-9)
    assert expected > 1.1


def test_waves_along_the_motion_against_quadrature(wave):
    """They do not change as they pass; Roelands, integrated by an independent routine."""
    wavelength, height = 1e-4, 2e-8
    z = wave(height, wavelength, 64).heights.T.copy()
    rough = Topography(z, (wavelength, wavelength))
    field = response(rough, POINT)
    dp, ad = field.pressure.max(), field.deformed.max()
    a, k = POINT.hertz_radius, 2 * math.pi / wavelength

    def stress(x, y, rough):
        inside = np.maximum(0.0, 1 - (x / a) ** 2 - (y / a) ** 2)
        p = POINT.hertz_pressure * np.sqrt(inside) + rough * dp * np.cos(k * y)
        film = FILM - rough * ad * np.cos(k * y)
        eta = ROELANDS.viscosity_ratio(np.maximum(p, 0.0))
        return np.where(inside > 0.0, eta / film, 0.0)

    x = np.linspace(-a, a, 801)
    y = np.linspace(-a, a, 1601)
    grid = np.meshgrid(x, y, indexing="ij")
    expected = stress(*grid, 1.0).sum() / stress(*grid, 0.0).sum()
    result = predict_friction(rough, POINT, ROELANDS, FILM)
    assert result.mu_ratio == pytest.approx(expected, rel=1e-5)
    assert result.mu_ratio_max - result.mu_ratio_min < 1e-9


@pytest.mark.parametrize(
    ("law", "options"),
    [
        ("newtonian", ModelOptions()),
        ("eyring", ModelOptions()),
        ("limiting", ModelOptions()),
        ("newtonian", ModelOptions(load_balance=True)),
    ],
    ids=["newtonian", "eyring", "limiting", "balanced"],
)
def test_each_position_is_the_moved_surface(table_1, law, options):
    rough = table_1(pixels=64)
    oil = replace(ROELANDS, shear=ShearLaw(law))
    passage = predict_friction(rough, POINT, oil, FILM, options)
    for k in (1, 3):
        moved = surfaces.shifted(rough, float(passage.shift[k]))
        first = predict_friction(moved, POINT, oil, FILM, options)
        assert first.passage[0] == pytest.approx(passage.passage[k], rel=1e-9)


def test_one_position_by_an_explicit_sum(table_1):
    rough = table_1(pixels=128)
    field = response(rough, POINT)
    px, py = rough.pixel
    a, total, smooth = POINT.hertz_radius, 0.0, 0.0
    for i in range(-70, 71):
        for j in range(-70, 71):
            r2 = ((i * px) ** 2 + (j * py) ** 2) / a**2
            if r2 < 1.0:
                p = POINT.hertz_pressure * math.sqrt(1 - r2)
                at = (i % 128, j % 128)
                film = FILM - field.deformed[at]
                eta = ROELANDS.viscosity_ratio(max(0.0, p + field.pressure[at]))
                total += float(eta) / film
                smooth += float(ROELANDS.viscosity_ratio(p)) / FILM
    result = predict_friction(rough, POINT, ROELANDS, FILM)
    assert result.passage[0] == pytest.approx(total / smooth, rel=1e-10)


def test_automatic_positions_are_enough(table_1):
    for seed in (1, 2):
        rough = table_1(seed)
        few = predict_friction(rough, POINT, ROELANDS, FILM)
        all_of_them = predict_friction(rough, POINT, ROELANDS, FILM, ModelOptions(positions=256))
        assert few.passage.size < 64
        assert few.mu_ratio == pytest.approx(all_of_them.mu_ratio, rel=1e-7)
        assert few.mu_ratio_min == pytest.approx(all_of_them.passage.min(), rel=1e-3)
        assert few.mu_ratio_max == pytest.approx(all_of_them.passage.max(), rel=1e-3)
        missed = abs(few.mu_ratio_max / all_of_them.passage.max() - 1)
        assert missed < max(few.position_error, 1e-4)


def test_pixel_size_of_the_map_does_not_matter():
    """A coarse map of a long wave is interpolated until it resolves the contact."""
    coarse = surfaces.resampled(surfaces.harmonic(5e-8, LENGTH, LENGTH, (6, 6)), (12, 10))
    fine = surfaces.harmonic(5e-8, LENGTH, LENGTH, (256, 256))
    a = predict_friction(coarse, POINT, ROELANDS, FILM)
    b = predict_friction(fine, POINT, ROELANDS, FILM)
    assert a.mu_ratio == pytest.approx(b.mu_ratio, rel=1e-4)
    assert a.response.pressure.shape == (12, 10)
    odd = predict_friction(fine, POINT, ROELANDS, FILM, ModelOptions(positions=11))
    assert odd.passage.size == 11
    assert odd.mu_ratio == pytest.approx(b.mu_ratio, rel=1e-4)


def test_fine_and_short_tiles_are_visited_at_a_stride(wave):
    """Each pixel of a tile is met, whatever the ratio of its size to the contact."""
    short = wave(2e-9, 2e-6, 33)
    long = wave(2e-9, 2e-6, 16)
    a = predict_friction(short, POINT, BARUS, FILM)
    b = predict_friction(long, POINT, BARUS, FILM)
    z = BARUS.pressure_viscosity * response(short, POINT).pressure.max()
    d = response(short, POINT).deformed.max() / FILM
    expected, _ = quad(
        lambda t: math.exp(z * math.cos(t)) / (1 - d * math.cos(t)) / math.pi, 0, math.pi
    )
    assert a.mu_ratio == pytest.approx(expected, rel=1e-9)
    assert b.mu_ratio == pytest.approx(expected, rel=1e-9)
    assert a.mu_ratio_max - a.mu_ratio_min < 1e-4


def test_load_balance(table_1):
    rough = table_1()
    free = predict_friction(rough, POINT, ROELANDS, FILM)
    held = predict_friction(rough, POINT, ROELANDS, FILM, ModelOptions(load_balance=True))
    assert free.load_error == pytest.approx(held.load_error, rel=0.05)
    assert 1e-4 < free.load_error < 0.02
    assert 1e-4 < abs(held.mu_ratio / free.mu_ratio - 1) < 0.03


def test_load_balance_follows_hertz():
    """Roughness that is one bump under the whole contact acts like a lower smooth load."""
    n, side = 128, 24 * POINT.hertz_radius
    x = np.arange(n) / n
    hill = np.outer(np.cos(2 * np.pi * x), np.cos(2 * np.pi * x)) * 4e-6
    rough = Topography(hill, (side, side))
    options = ModelOptions(load_balance=True, positions=8)
    held = predict_friction(rough, POINT, ROELANDS, FILM, options)
    field = response(rough, POINT, options)
    dp, ad = float(field.pressure[0, 0]), float(field.deformed[0, 0])
    # cos(k x) cos(k y), averaged over a circle about its crest
    r = np.linspace(0.0, 1.0, 4001) * POINT.hertz_radius
    bump = j0(math.sqrt(2) * 2 * math.pi / side * r)
    load_share = 2 * math.pi * np.trapezoid(dp * bump * r, r) / POINT.load
    lighter = OperatingPoint(load=POINT.load * (1 - load_share))

    def friction(point, extra, film):
        inner = np.maximum(0.0, 1 - (r / point.hertz_radius) ** 2)
        p = point.hertz_pressure * np.sqrt(inner) + extra
        return np.trapezoid(ROELANDS.viscosity_ratio(p) / film * r, r)

    expected = friction(lighter, dp * bump, FILM - ad * bump) / friction(POINT, 0.0, FILM)
    assert load_share > 0.02
    assert held.passage[0] == pytest.approx(expected, rel=5e-4)


def test_eyring_and_limiting_friction(table_1):
    rough = table_1()
    point = replace(POINT, slide_to_roll=0.01)
    eyring, limiting = (
        predict_friction(rough, point, replace(ROELANDS, shear=ShearLaw(law)), FILM)
        for law in ("eyring", "limiting")
    )
    assert eyring.mu_smooth == pytest.approx(0.040, abs=0.002)
    # the limit is 0.06 p, reached nearly everywhere
    assert 0.05 < limiting.mu_smooth < 0.06
    assert eyring.mu_ratio == pytest.approx(1.0, abs=0.01)
    assert limiting.mu_ratio == pytest.approx(1.0, abs=0.01)


@pytest.mark.parametrize(
    "law", [ShearLaw("eyring"), ShearLaw("limiting"), ShearLaw("limiting", limiting_stress=1e8)]
)
def test_stress_laws_are_newtonian_when_slow(table_1, law):
    rough = table_1(pixels=64)
    point = replace(POINT, slide_to_roll=-1e-12)
    newtonian = predict_friction(rough, point, ROELANDS, FILM)
    slow = predict_friction(rough, point, replace(ROELANDS, shear=law), FILM)
    assert slow.mu_ratio == pytest.approx(newtonian.mu_ratio, rel=1e-4)
    assert slow.mu_smooth == pytest.approx(newtonian.mu_smooth, rel=1e-4)
