# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the models share."""

import copy

import numpy as np
import pytest
from matplotlib import pyplot

import pyehl
from pyehl import surfaces
from pyehl.contact.smooth import solve_contact

# A resolved case: the reference conditions with the fractal surface, the model of the paper
RESOLVED = pyehl.Case(
    surface={"kind": "fractal"},
    psd={"reduction": "amplitude", "smooth": "hertz", "film_thickness": 0.2333e-6},
).resolve()
# for tests that replace the surface by a wave
RESOLVED["surface"]["amplitude_over_film"] = 0.4


@pytest.fixture
def settings():
    """A resolved case that a test may change."""
    return copy.deepcopy(RESOLVED)


@pytest.fixture(scope="module")
def contact():
    """The smooth contact of Table 1."""
    return solve_contact(pyehl.Case.from_text("").resolve())


@pytest.fixture
def table_1():
    """Make a fractal surface of Table 1, by seed, pixels and options that differ."""

    def make(seed=1, pixels=256, **changes):
        arguments = {"rms_height": 5e-8, "hurst": 0.8} | changes
        return surfaces.fractal(pixels, 8.29e-4, 8.29e-4, seed=seed, **arguments)

    return make


@pytest.fixture
def wave():
    """Make one transverse wave, by height and wavelength."""

    def make(height, wavelength, n=32):
        x = np.arange(n) / n
        z = np.outer(height * np.cos(2 * np.pi * x), np.ones(n))
        return surfaces.Topography(z, (wavelength, wavelength))

    return make


@pytest.fixture
def no_open_figures():
    """Close all figures after a test."""
    yield
    pyplot.close("all")
