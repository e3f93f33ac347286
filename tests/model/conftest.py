# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the models share."""

import copy

import numpy as np
import pytest

from pyehl import surfaces

# A resolved case: the reference conditions with the fractal surface, the model of the paper
RESOLVED = {
    "grid": {"x_inlet": -2.5, "x_outlet": 1.5, "y_extent": 2.0},
    "contact": {
        "load": 600.0,
        "mean_velocity": 0.84,
        "radius": 0.018,
        "reduced_modulus": 2.26e11,
        "slide_to_roll": 0.02,
        "rough_surface": 1,
    },
    "lubricant": {
        "viscosity": 0.04,
        "pressure_viscosity": 2.2e-8,
        "viscosity_law": "roelands",
        "roelands_z": 0.6684106340135522,
        "roelands_p0": 1.96e8,
        "density_law": "dowson-higginson",
        "shear_law": "newtonian",
        "flow": "consistent",
        "eyring_stress": 5e6,
        "limiting_stress": 0.0,
        "limiting_coefficient": 0.06,
        "carreau_stress": 0.0,
        "carreau_exponent": 0.0,
    },
    "surface": {
        "kind": "fractal",
        "amplitude_over_film": 0.4,
        "wavelength": 0.5,
        "wavelength_x": 0.5,
        "wavelength_y": 0.5,
        "velocity_ratio": 1.01,
        "x_start": -2.5,
        "file": "",
        "length_x": 8.29e-4,
        "length_y": 8.29e-4,
        "shortest_wavelength": 0.0,
        "longest_wavelength": 0.0,
        "filter": "sharp",
        "rms_height": 5e-8,
        "hurst": 0.8,
        "rolloff_wavenumber": 0.0,
        "pixels": 256,
        "seed": 1,
        "modulus": "deterministic",
    },
    "psd": {
        "reduction": "amplitude",
        "smooth": "hertz",
        "film_thickness": 0.2333e-6,
        "film_limit": 0.0,
        "wavelength_convention": "components",
        "stiffness": "exact",
        "viscosity_law": "roelands",
        "load_balance": False,
        "positions": 0,
    },
}


@pytest.fixture
def settings():
    """A resolved case that a test may change."""
    return copy.deepcopy(RESOLVED)


@pytest.fixture
def table_1():
    """Make a fractal surface of Table 1, by seed, pixels and what else is to differ."""

    def make(seed=1, pixels=256, **changes):
        arguments = {"rms_height": 5e-8, "hurst": 0.8} | changes
        return surfaces.fractal(pixels, 8.29e-4, 8.29e-4, seed=seed, **arguments)

    return make


@pytest.fixture
def wave():
    """Make one wave with its crests across the motion, by height and wavelength."""

    def make(height, wavelength, n=32):
        x = np.arange(n) / n
        z = np.outer(height * np.cos(2 * np.pi * x), np.ones(n))
        return surfaces.Topography(z, (wavelength, wavelength))

    return make
