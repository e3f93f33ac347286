# SPDX-License-Identifier: BSD-3-Clause
"""The rough contact of a prediction: films and pressures at its points, and what they conserve."""

import numpy as np
import pytest
import scipy.interpolate
import scipy.ndimage

from pyehl.prediction import moving_tile, rough_contact
from pyehl.prediction.friction import outcome
from pyehl.prediction.model import Model, ModelOptions
from pyehl.prediction.response import film_left, loss_at
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint

POINT, OIL = OperatingPoint(), Lubricant()


def passage(contact, tile, ratio=1.01, **options):
    return Model.of_one(tile, contact, POINT, OIL, ModelOptions(**options), ratio)


def test_film_of_second_order(contact, table_1):
    """The film regains 0.4 of the square of its reduction, and breaks down at 1.6 smooth films."""
    one = passage(contact, table_1(seed=21), 1.01)
    points = one.rough_contact(one.components())
    inside = np.where(points.inside, points.film, np.inf)
    change = np.zeros((*points.film.shape, 2), dtype=np.float32)
    change[..., 0] = 0.3 * points.film
    ratio = points.sheared(change, points.smooth_film())
    lost = 1.0 - 0.3 + 0.4 * 0.3**2
    assert ratio == pytest.approx(1.0 / lost, rel=1e-4)
    missing = contact.minimum_film - contact.film.min()
    assert points.minimum == pytest.approx(lost * inside.min() + missing, abs=0.3 * missing)
    change[..., 0] = 1.5 * points.film
    assert points.sheared(change, points.smooth_film()) == pytest.approx(
        1.0 / float(film_left(np.array(1.5))), rel=1e-4
    )
    change[..., 0] = 1.7 * points.film
    assert np.isnan(points.sheared(change, points.smooth_film()))


def test_film_after_a_loss():
    """A parabola, with an exponential continuation beyond a reduction of 0.6; and its inverse."""
    loss = np.linspace(-1.0, 3.0, 401)
    left = film_left(loss)
    low, high = loss < 0.599, loss > 0.601
    assert left[low] == pytest.approx(1.0 - loss[low] + 0.4 * loss[low] ** 2, rel=1e-12)
    slope = np.gradient(np.log(left[high]), loss[high])
    assert slope == pytest.approx(-0.52 / 0.544, rel=1e-9)
    assert np.diff(left).max() < 0.0
    # no step in the slope
    assert np.abs(np.diff(left, 2)).max() < 1.1 * 0.8 * 0.01**2
    assert loss_at(left) == pytest.approx(loss, abs=1e-12)
    assert loss_at(np.array([0.0, -1.0])) == pytest.approx([np.inf, np.inf])


def test_a_ring_in_tension_has_no_load(contact, table_1):
    one = passage(contact, table_1(seed=21), 1.01)
    points = one.rough_contact(one.components())
    change = np.zeros((*points.film.shape, 2), dtype=np.float32)
    # more than the smooth pressure where that is smallest
    change[..., 1] = np.where(points.radius > 0.7, -1.0, 0.0)
    assert np.isnan(points.sheared(change, points.smooth_film()))
    assert outcome(points, np.array([np.nan]))[0] == "load lost"


def test_points_in_tension_carry_no_load(contact, table_1, monkeypatch):
    """Negative pressures carry no load, and the rest of their ring carries less."""
    one = passage(contact, table_1(seed=21), 1.01)
    points = one.rough_contact(one.components())
    result = []

    def stress(pressure, film):
        result.append(pressure.copy())
        return np.ones_like(film)

    monkeypatch.setattr(points, "stress", stress)
    change = np.zeros((*points.film.shape, 2), dtype=np.float32)
    tensile = points.inside & (points.radius < 0.1)
    change[..., 1][tensile] = -2.0
    points.sheared(change, points.smooth_film())
    whole = (points.pressure + change[..., 1])[points.inside]
    (left,) = result
    assert left.min() == 0.0
    for ring in range(3):
        here = points.rings == ring
        assert left[here].sum() == pytest.approx(whole[here].sum(), rel=1e-6)
    outside = points.rings > 0
    assert left[outside] == pytest.approx(whole[outside], rel=1e-6)


def test_the_smooth_film_moves_with_the_edge(contact, table_1):
    """Beyond OUTER a point has the film of a place nearer to the centre, or farther from it."""
    one = passage(contact, table_1(seed=21), 1.01)
    points = one.rough_contact(one.components())
    assert points.smooth_film() == pytest.approx(points.film, rel=1e-12)
    angles = np.linspace(0.0, 2.0 * np.pi, points.moved.size, endpoint=False)
    points.moved[:] = 0.02 * np.cos(angles) - 0.01 * np.sin(2.0 * angles)
    x, y = np.meshgrid(points.x, points.y, indexing="ij")
    outer = points.inside & (points.radius > rough_contact.OUTER)
    angle = np.arctan2(y, x)[outer]
    factor = 1.0 - np.interp(angle, angles, points.moved, period=2.0 * np.pi) / points.radius[outer]
    expected = points.film.copy()
    film_at = scipy.interpolate.RegularGridInterpolator((contact.x, contact.y), contact.film)
    expected[outer] = film_at((x[outer] * factor, y[outer] * factor))
    assert points.smooth_film() == pytest.approx(expected, rel=1e-9)
    assert np.abs(expected / points.film - 1.0).max() > 0.05


def test_free_waves_beside_the_centre_line(contact, table_1):
    """Each column is interpolated between those of two lines."""
    one = passage(contact, table_1(seed=21), 1.3)
    points = one.rough_contact(one.components())
    (tile,) = points.tiles
    waves = tile.waves
    columns = (tile.columns // waves.stride % waves.driven.shape[2]).astype(np.int32)
    result = waves.beside(columns, *moving_tile.two_lines(points.across))
    tiles = np.fft.irfft(waves.off_centre, n=result.shape[0])
    weights = moving_tile.line_weights(points.across)
    expected = np.einsum("jl,lpjr->rjp", weights, tiles[:, :, columns])
    assert result == pytest.approx(expected, abs=1e-6 * np.abs(expected).max())


def test_free_waves_are_thicker_where_the_pressure_is_lower(contact, table_1):
    """They conserve mass: beside the centre line they are thicker by the ratio of densities."""
    one = passage(contact, table_1(seed=21), 1.0)
    points = one.rough_contact(one.components())
    middle, off = points.x.size // 2, int(np.argmin(np.abs(points.y - 0.8)))
    density = OIL.density_ratio(points.pressure[middle] * POINT.hertz_pressure)
    thickening = points.expansion[middle, off]
    assert thickening == pytest.approx(density[points.y.size // 2] / density[off], rel=1e-3)
    assert 1.02 < thickening < 1.06
