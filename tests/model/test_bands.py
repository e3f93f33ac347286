# SPDX-License-Identifier: BSD-3-Clause
"""Bands of wavelengths of a prediction: computed when they are asked for, with the same bits."""

import copy
import math
import pickle

import numpy as np
import pytest

import pyehl
from pyehl.prediction.bands import Bands, LongerWaves
from pyehl.prediction.model import Model, ModelOptions
from pyehl.prediction.response import film_left
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint

SMALL = {"surface.pixels": 64, "surface.kind": "fractal", "surface.rms_height": 5e-8}
TWO = {"second_surface.kind": "fractal", "surface.velocity_ratio": 1.05}


def predicted(cases, *options, tracks=1):
    return pyehl.predict(cases / "table1.nml", SMALL, *options, tracks=tracks)


@pytest.fixture
def model(contact, table_1):
    options = OperatingPoint(), Lubricant(), ModelOptions()
    return Model.of_one(table_1(seed=21, pixels=96), contact, *options, 1.05)


def test_bands_are_computed_when_they_are_asked_for(cases, monkeypatch):
    asked = []
    ratio = LongerWaves.ratio
    monkeypatch.setattr(
        LongerWaves, "ratio", lambda self, limits: asked.append(limits) or ratio(self, limits)
    )
    result = predicted(cases)
    assert result.mu_ratio > 1.0
    assert repr(result.bands) == "Bands(...)"
    assert not asked
    seconds = result.summary["wall_seconds"]
    # the sum of all bands is known already
    assert len(asked) == len(result.bands) - 1 > 2
    assert seconds == result.summary["wall_seconds"] > result.seconds
    assert len(asked) == len(result.bands) - 1


@pytest.mark.parametrize("options", [{}, TWO], ids=["one surface", "two surfaces"])
def test_bands_without_held_waves_have_the_same_bits(cases, options):
    first, second = (predicted(cases, options) for _ in range(2))
    held, again = second.bands, first.bands
    assert isinstance(again, Bands)
    assert again.held is None is not held.held
    assert list(held) == list(again)
    assert held.held is None


def test_bands_are_copied_and_pickled_before_they_are_computed(cases):
    result = predicted(cases)
    others = [copy.copy(result), copy.deepcopy(result), pickle.loads(pickle.dumps(result))]
    assert repr(others[1].bands) == repr(others[2].bands) == "Bands(...)"
    for other in others:
        assert other.bands == result.bands
        assert list(other.bands[1:]) == list(result.bands)[1:]
    assert result.bands != ()
    assert result.bands != others[0].bands[1:]
    assert pickle.loads(pickle.dumps(result)).bands == result.bands


def test_successive_limits_share_without_effect(model):
    waves = model.components()
    longer = LongerWaves(model, waves, model.rough_contact(waves))
    for limit in (3.0, 20.0, 30.0, 200.0, 250.0, 20.0, math.inf):
        assert longer.ratio([limit]) == LongerWaves(model, waves).ratio([limit])


def test_positions_together_or_one_by_one(model):
    waves = model.components()
    contact = model.rough_contact(waves)
    positions = [(4.0 * k, 0.0) for k in range(20)]
    together = contact.frictions(positions)
    other = model.rough_contact(waves)
    assert together == [other.friction(position) for position in positions]
    assert together == contact.ratios(positions)
    for name in ("count", "minimum", "max_pressure", "cavitated", "squared_increase", "imbalance"):
        assert getattr(contact, name) == getattr(other, name)
    third = model.rough_contact(waves)
    third.observe(positions)
    assert third.minimum == contact.minimum
    assert third.max_increase == contact.max_increase


def test_film_and_pressure_by_formula(model):
    """To the bit, also where more than 0.6 of the film is lost."""
    contact = model.rough_contact(model.components())
    change = 8.0 * contact.change((5, 0))
    smooth = contact.smooth_film().take(contact.places)
    film, pressure, gain, ended, tensile = contact.film_and_pressure(change, smooth)
    loss, more = change.reshape(-1, 2).take(contact.places, axis=0).T
    assert (loss > 0.6 * smooth).any()
    assert np.array_equal(film, smooth * film_left(loss / smooth))
    assert np.array_equal(pressure, contact.pressure.take(contact.places) + more)
    assert np.array_equal(gain, more)
    assert ended == np.count_nonzero(loss >= contact.ends * smooth)
    assert tensile == np.count_nonzero(pressure <= 0.0)
