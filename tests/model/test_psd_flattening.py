# SPDX-License-Identifier: BSD-3-Clause
"""Stiffness of a loaded contact against a wave, and amplitude reduction."""

import math

import numpy as np
import pytest
from paper_model import response

from pyehl import surfaces
from pyehl.prediction import ModelOptions
from pyehl.prediction.model import PAPER_STIFFNESS
from pyehl.surfaces import Topography
from pyehl.theory import amplitude
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.transport import stiffness

POINT = OperatingPoint()
LENGTH = 8.29e-4


def half_space(q):
    """Pressure per height of flattening [Pa/m] of a wave |q| [rad/m]."""
    unit = POINT.hertz_pressure / POINT.film_scale
    return stiffness(q * POINT.hertz_radius) * unit


def deflection_at_crest(wavelength, modulus):
    """Deflection at the crest of a pressure cos cos of amplitude one, by the point load integral.

    (2/(pi E')) int int p/r over the plane, as the limit of a wide Gaussian window: its width in
    wavenumber makes a relative error of order (wavelength/window)^2/8.
    """
    cells, window = 24, 10 * wavelength
    h = wavelength / cells
    n = int(4.2 * window / h)
    x = np.arange(-n, n + 1) * h
    r2 = x[:, None] ** 2 + x[None, :] ** 2
    k = 2 * np.pi / wavelength
    p = np.outer(np.cos(k * x), np.cos(k * x)) * np.exp(-r2 / (2 * window**2))
    inverse = np.zeros_like(r2)
    np.divide(1.0, np.sqrt(r2), out=inverse, where=r2 > 0.0)
    # midpoint rule with the exact integral of 1/r over the singular cell, 4 h ln(1 + sqrt 2), and
    # the lattice constant that the remaining midpoint sum omits: the Epstein zeta function of the
    # square lattice at 1/2, 4 zeta(1/2) beta(1/2) = -3.90026492
    return 2 / (math.pi * modulus) * (np.sum(p * inverse) * h * h + 3.90026492 * h)


def test_stiffness_of_a_cos_cos_pattern_by_point_loads():
    wavelength, modulus = 2e-4, 2.26e11
    measured = 1.0 / deflection_at_crest(wavelength, modulus)
    k = 2 * np.pi / wavelength
    exact = half_space(math.hypot(k, k))
    equation_11 = math.pi * modulus / (math.sqrt(2) * wavelength)
    assert exact == pytest.approx(equation_11, rel=1e-12)
    assert measured == pytest.approx(exact, rel=3e-3)


def test_stiffness_by_convolution():
    """The same by a periodic sum: deflection = FFT of the pressure times that of the kernel."""
    n, wavelength, modulus = 96, 2e-4, 2.26e11
    h = wavelength / n
    images = 40
    # kernel of one period: all images of the point load, minus its mean
    i = np.arange(n)
    i = np.where(i > n // 2, i - n, i) * h
    kernel = np.zeros((n, n))
    for a in range(-images, images + 1):
        for b in range(-images, images + 1):
            r = np.hypot(i[:, None] + a * wavelength, i[None, :] + b * wavelength)
            kernel += np.where(r > 0.0, h * h / np.where(r > 0.0, r, 1.0), 0.0)
    kernel[0, 0] += 3.90026492 * h
    k = 2 * np.pi / wavelength
    x = np.arange(n) * h
    p = np.outer(np.cos(k * x), np.cos(k * x))
    w = np.fft.irfft2(np.fft.rfft2(p) * np.fft.rfft2(kernel), s=(n, n))
    w *= 2 / (math.pi * modulus)
    w -= w.mean()
    fitted = np.sum(p * p) / np.sum(p * w)
    exact = half_space(math.hypot(k, k))
    # the images beyond the sum add a smooth kernel that hardly affects a wave
    assert fitted == pytest.approx(exact, rel=5e-3)
    assert w == pytest.approx(p / exact, abs=5e-3 / exact)


def test_paper_stiffness_is_too_stiff():
    q = np.array([1e4, 1e5])
    # eq. 11 as printed, with 2 pi/|q|
    literal = math.pi * POINT.reduced_modulus / (math.sqrt(2) * 2 * math.pi / q)
    assert PAPER_STIFFNESS * half_space(q) == pytest.approx(literal)


# --- response


@pytest.mark.parametrize("convention", amplitude.CONVENTIONS)
@pytest.mark.parametrize("stiffness", ["exact", "paper"])
def test_single_component(wave, convention, stiffness):
    wavelength, height = 2e-4, 3e-8
    rough = wave(height, wavelength)
    options = ModelOptions(wavelength_convention=convention, stiffness=stiffness)
    field = response(rough, POINT, options)
    factor = math.sqrt(2) if convention == "pattern" else 1.0
    x = factor * wavelength / POINT.hertz_radius * math.sqrt(POINT.moes_m / POINT.moes_l)
    ratio = 1 / (1 + 0.15 * x + 0.015 * x * x)
    k = POINT.reduced_modulus * (2 * math.pi / wavelength) / 4
    k *= math.sqrt(2) if stiffness == "paper" else 1.0
    unit = rough.heights / height
    assert field.deformed == pytest.approx(ratio * height * unit, rel=1e-9, abs=1e-20)
    assert field.pressure == pytest.approx(k * (1 - ratio) * height * unit, rel=1e-9, abs=1e-4)


def test_pattern_is_the_closed_form_of_cos_cos():
    rough = surfaces.harmonic(1e-8, 2e-4, 2e-4, (32, 32))
    x = 2e-4 / POINT.hertz_radius * math.sqrt(POINT.moes_m / POINT.moes_l)
    ratio = 1 / (1 + 0.15 * x + 0.015 * x * x)
    for convention in ("pattern", "components"):
        field = response(rough, POINT, ModelOptions(wavelength_convention=convention))
        assert field.deformed == pytest.approx(ratio * rough.heights, rel=1e-9, abs=1e-20)
        expected = math.pi * POINT.reduced_modulus / (math.sqrt(2) * 2e-4) * (1 - ratio)
        assert field.pressure == pytest.approx(expected * rough.heights, rel=1e-9, abs=1e-4)


def test_response_keeps_phases(table_1):
    """Moving the surface moves its response: with moduli alone it would not."""
    rough = table_1(pixels=64)
    px, py = rough.pixel
    moved = response(surfaces.shifted(rough, 5 * px, -7 * py), POINT)
    fixed = response(rough, POINT)
    assert moved.deformed == pytest.approx(np.roll(fixed.deformed, (5, -7), (0, 1)), abs=1e-18)
    assert moved.pressure == pytest.approx(np.roll(fixed.pressure, (5, -7), (0, 1)), abs=1e-2)


def test_response_is_linear_and_without_mean(table_1):
    a, b = table_1(1, 64), table_1(2, 64)
    both = Topography(a.heights - 2 * b.heights + 3e-7, (LENGTH, LENGTH))
    expected = response(a, POINT).pressure - 2 * response(b, POINT).pressure
    assert response(both, POINT).pressure == pytest.approx(expected, abs=1e-2)
    assert abs(response(both, POINT).deformed.mean()) < 1e-20


def test_parseval_of_the_response(table_1):
    rough = table_1(pixels=64)
    field = response(rough, POINT)
    qx, qy, c2d = surfaces.psd_2d(rough)
    qx, qy = qx[:, None], qy[None, :]
    ratio = amplitude.component_amplitude_ratio(
        qx, qy, POINT.hertz_radius, POINT.moes_m, POINT.moes_l
    )
    k = POINT.reduced_modulus * np.hypot(qx, qy) / 4
    area = LENGTH**2
    assert np.mean(field.deformed**2) == pytest.approx(np.sum(ratio**2 * c2d) / area, rel=1e-12)
    expected = np.sum((k * (1 - ratio)) ** 2 * c2d) / area
    assert np.mean(field.pressure**2) == pytest.approx(expected, rel=1e-12)
