# SPDX-License-Identifier: BSD-3-Clause
"""Amplitude reduction."""

import math

import numpy as np
import pytest

from pyehl.theory import amplitude


def test_limits():
    assert float(amplitude.amplitude_ratio(0.0)) == 1.0
    assert float(amplitude.amplitude_ratio(math.inf)) == 0.0
    short, long = 1e-6, 1e6
    for convention in amplitude.CONVENTIONS:
        q = 2 * np.pi / np.array([short, long])
        ratio = amplitude.component_amplitude_ratio(
            q, 0.0, 1.0, 1000.0, 10.0, convention=convention
        )
        assert ratio[0] == pytest.approx(1.0, abs=1e-5)
        assert ratio[1] == pytest.approx(0.0, abs=1e-10)


def test_by_hand():
    # M = 1000, L = 10, wavelength 0.5 a: x = 5, 1/(1 + 0.75 + 0.375)
    x = amplitude.wavelength_parameter(0.5, 1000.0, 10.0)
    assert float(x) == pytest.approx(5.0)
    assert float(amplitude.amplitude_ratio(x)) == pytest.approx(1 / 2.125)


def test_decreases_with_the_wavelength():
    ratio = amplitude.amplitude_ratio(np.linspace(0.0, 100.0, 500))
    assert np.all(np.diff(ratio) < 0.0)


def test_anisotropy_factor():
    assert np.all(amplitude.anisotropy_factor([0.0, 0.5, 1.0]) == 1.0)
    assert float(amplitude.anisotropy_factor(2.0)) == pytest.approx(math.exp(0.5))
    assert float(amplitude.anisotropy_factor(math.inf)) == pytest.approx(math.e)


def test_conventions_agree_for_a_transverse_wave():
    k = 2 * np.pi / 1e-4
    wave = {c: amplitude.component_wavelength(k, 0.0, c) for c in amplitude.CONVENTIONS}
    # a transverse wave
    assert float(wave["wavevector"][0]) == pytest.approx(1e-4)
    assert float(wave["components"][0]) == pytest.approx(1e-4)
    assert float(wave["components"][1]) == 0.0
    # a component of the isotropic cos cos pattern of wavelength 1e-4
    wave = {c: amplitude.component_wavelength(k, -k, c) for c in amplitude.CONVENTIONS}
    assert float(wave["pattern"][0]) == pytest.approx(1e-4)
    assert float(wave["components"][0]) == pytest.approx(1e-4)
    assert float(wave["components"][1]) == pytest.approx(1.0)
    assert float(wave["wavevector"][0]) == pytest.approx(1e-4 / math.sqrt(2))


def test_longitudinal_waves_deform_more():
    k = 2 * np.pi / 1e-4
    across, along = (
        float(amplitude.component_amplitude_ratio(*q, 4e-4, 1e3, 10.0, convention="components"))
        for q in ((k, 0.0), (0.0, k))
    )
    assert along < across


@pytest.mark.parametrize("convention", amplitude.CONVENTIONS)
def test_mean_height_is_flattened(convention):
    ratio = amplitude.component_amplitude_ratio(0.0, 0.0, 1.0, 1e3, 10.0, convention=convention)
    assert float(ratio) == 0.0


def test_refuses():
    with pytest.raises(ValueError, match="positive Moes"):
        amplitude.wavelength_parameter(0.5, 1000.0, 0.0)
    with pytest.raises(ValueError, match="pattern"):
        amplitude.component_wavelength(1.0, 1.0, "crest")
