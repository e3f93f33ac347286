# SPDX-License-Identifier: BSD-3-Clause
"""Limits of the model, and refused input."""

import math

import numpy as np
import pytest
from paper_model import predict_friction

from pyehl import surfaces
from pyehl.prediction import ModelOptions
from pyehl.surfaces import Topography
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint

POINT = OperatingPoint()
ROELANDS = Lubricant()
BARUS = Lubricant(viscosity_law="barus")
FILM = 0.2333e-6
LENGTH = 8.29e-4


def test_film_breakdown_has_its_status(wave):
    result = predict_friction(wave(3e-7, 1e-6), POINT, ROELANDS, FILM)
    assert result.status == "film breakdown"
    assert math.isnan(result.mu_ratio)
    assert math.isnan(result.mu_ratio_max)
    assert math.isnan(result.film_min)
    assert "no full film" in result.message


def test_cavitation_is_counted(table_1):
    rough = Topography(4 * table_1().heights, (LENGTH, LENGTH))
    result = predict_friction(rough, POINT, ROELANDS, 4 * FILM)
    assert result.status == "predicted"
    assert 1e-4 < result.cavitated_share < 0.2
    assert 0.0 < result.cavitated_friction < 1e-6


def test_viscosity_overflow_is_reported(table_1):
    oil = Lubricant(viscosity_law="barus", pressure_viscosity=6e-7)
    point = OperatingPoint(pressure_viscosity=6e-7)
    result = predict_friction(table_1(pixels=64), point, oil, FILM)
    assert result.status == "overflow"
    assert math.isnan(result.mu_ratio)


def test_roughness_pressure_beyond_the_load():
    n, side = 64, 20 * POINT.hertz_radius
    x = np.arange(n) / n
    hill = np.outer(np.cos(2 * np.pi * x), np.cos(2 * np.pi * x)) * 2e-4
    rough = Topography(hill, (side, side))
    result = predict_friction(rough, POINT, ROELANDS, 1e-3, ModelOptions(load_balance=True))
    assert result.status == "load lost"
    assert math.isnan(result.mu_ratio)


def test_refuses(table_1):
    with pytest.raises(ValueError, match="goes by M/L, and L = 0"):
        predict_friction(table_1(pixels=16), OperatingPoint(pressure_viscosity=0.0), BARUS, FILM)


def test_a_tile_too_large_for_its_pixels_is_refused():
    rough = surfaces.harmonic(1e-8, 0.5, 0.5, (16, 16))
    with pytest.raises(ValueError, match="cut a part"):
        predict_friction(rough, POINT, ROELANDS, FILM)
