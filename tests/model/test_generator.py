# SPDX-License-Identifier: BSD-3-Clause
"""The generator of fractal surfaces and the spectral cut-off, against numpy and closed forms."""

import math

import numpy as np
import pytest
import scipy.fft

from pyehl import surfaces
from pyehl.surfaces import Topography

LENGTH = (8.29e-4, 6.1e-4)


def by_numpy(
    pixels: tuple[int, int], hurst: float, rolloff: float, seed: int, modulus: str
) -> np.ndarray:
    """The same surface of rms height 1 by numpy's PCG64 and scipy's FFT."""
    nx, ny = pixels
    half = ny // 2 + 1
    words = np.random.PCG64(seed).random_raw(2 * nx * half)
    uniform = ((words >> np.uint64(11)).astype(float) * 2.0**-53).reshape(2, nx, half)
    component = np.exp(2j * np.pi * uniform[0])
    if modulus == "gaussian":
        component *= np.sqrt(-np.log1p(-uniform[1]))
    for j in [0] if ny % 2 else [0, ny // 2]:
        component[: nx // 2 : -1, j] = np.conj(component[1 : (nx + 1) // 2, j])
        for i in [0] if nx % 2 else [0, nx // 2]:
            value = component[i, j]
            if modulus == "gaussian":
                component[i, j] = math.sqrt(2.0) * value.real
            else:
                component[i, j] = math.copysign(abs(value), value.real)
    qx = 2.0 * np.pi * scipy.fft.fftfreq(nx, LENGTH[0] / nx)[:, None]
    qy = 2.0 * np.pi * scipy.fft.rfftfreq(ny, LENGTH[1] / ny)[None, :]
    q = np.maximum(np.hypot(qx, qy), rolloff)
    q[0, 0] = np.inf
    z = scipy.fft.irfft2(component * q ** (-1.0 - hurst), s=(nx, ny))
    z -= z.mean()
    return z / np.sqrt(np.mean(z * z))


# Seeds of one, two, four and five 32-bit words; sizes with and without Nyquist components
@pytest.mark.parametrize("seed", [0, 1, 20191, 2**31 - 1, 2**40 + 7, 2**100 + 3, 2**150 + 11])
@pytest.mark.parametrize("pixels", [(32, 32), (33, 20), (16, 27), (9, 15)])
@pytest.mark.parametrize("modulus", ["deterministic", "gaussian"])
def test_seeds_keep_their_surfaces(seed: int, pixels: tuple[int, int], modulus: str):
    made = surfaces.fractal(
        pixels,
        *LENGTH,
        rms_height=1.0,
        hurst=0.7,
        rolloff_wavenumber=2e4,
        seed=seed,
        modulus=modulus,
    )
    expected = by_numpy(pixels, 0.7, 2e4, seed, modulus)
    # sines, cosines and transforms of two libraries
    assert np.abs(made.heights - expected).max() <= 1e-12 * np.abs(expected).max()
    assert made.heights.flags.c_contiguous


def test_large_surface_keeps_its_seed():
    made = surfaces.fractal(512, *LENGTH, rms_height=1.0, hurst=0.8, seed=5)
    expected = by_numpy((512, 512), 0.8, 0.0, 5, "deterministic")
    assert np.abs(made.heights - expected).max() <= 1e-12 * np.abs(expected).max()


def tile(seed: int = 3, pixels: tuple[int, int] = (48, 35)) -> Topography:
    z = np.random.default_rng(seed).standard_normal(pixels)
    return Topography(z - z.mean(), LENGTH)


def transmitted(before: Topography, after: Topography) -> tuple[np.ndarray, np.ndarray]:
    """Wavelength of each component [m], and the ratio of its amplitudes."""
    qx, qy = surfaces.wavenumbers(before)
    a, b = (np.fft.rfft2(tile.heights) for tile in (before, after))
    q = np.hypot(qx, qy)
    q[0, 0] = a[0, 0] = 1.0
    share = b / a
    assert np.abs(share.imag).max() < 1e-12
    keep = np.ones(q.shape, bool)
    keep[0, 0] = False
    return 2.0 * np.pi / q[keep], share.real[keep]


@pytest.mark.parametrize(("shortest", "longest"), [(9e-5, 0.0), (0.0, 2.5e-4), (6e-5, 3e-4)])
def test_sharp_cut(shortest: float, longest: float):
    before = tile()
    wavelength, share = transmitted(before, surfaces.filtered(before, shortest, longest))
    inside = wavelength >= shortest
    if longest:
        inside &= wavelength <= longest
    assert 0 < inside.sum() < inside.size
    # rounding of two transforms over the amplitude of the component, which may be small
    assert np.abs(share - inside).max() < 1e-11


@pytest.mark.parametrize(("shortest", "longest"), [(9e-5, 0.0), (0.0, 2.5e-4), (6e-5, 3e-4)])
def test_gaussian_cut_is_that_of_iso_16610(shortest: float, longest: float):
    before = tile()
    wavelength, share = transmitted(
        before, surfaces.filtered(before, shortest, longest, "gaussian")
    )
    alpha = math.sqrt(math.log(2.0) / math.pi)
    expected = np.exp(-math.pi * (alpha * shortest / wavelength) ** 2)
    if longest:
        expected *= 1.0 - np.exp(-math.pi * (alpha * longest / wavelength) ** 2)
    assert share == pytest.approx(expected, abs=1e-11)


def test_half_passes_at_the_cut_off():
    x = np.arange(64) / 64
    wave = Topography(np.outer(np.cos(2.0 * np.pi * 4 * x), np.ones(16)), (1e-3, 1e-3))
    for limits in ((2.5e-4, 0.0), (0.0, 2.5e-4)):
        after = surfaces.filtered(wave, *limits, "gaussian")
        assert after.heights == pytest.approx(0.5 * wave.heights, abs=1e-14)
        # a sharp filter keeps a component at its cut-off
        assert surfaces.filtered(wave, *limits).heights == pytest.approx(wave.heights, abs=1e-14)


def test_gaussian_cut_is_a_weighted_mean():
    """In space the filter is the weighting function of ISO 16610-61, summed over the tile."""
    before = tile(pixels=(40, 40))
    cut_off = 1.5e-4
    after = surfaces.filtered(before, cut_off, kind="gaussian")
    alpha = math.sqrt(math.log(2.0) / math.pi)
    dx, dy = before.pixel
    i, j = 7, 31
    x = (np.arange(-200, 201)[:, None]) * dx
    y = (np.arange(-200, 201)[None, :]) * dy
    weight = np.exp(-math.pi * (x**2 + y**2) / (alpha * cut_off) ** 2) / (alpha * cut_off) ** 2
    rows = (i + np.arange(-200, 201)) % 40
    columns = (j + np.arange(-200, 201)) % 40
    mean = (weight * before.heights[np.ix_(rows, columns)]).sum() * dx * dy
    # the sum over pixels of 2e-5 m, against an integral with a width of 1.5e-4 m
    assert after.heights[i, j] == pytest.approx(mean, abs=2e-4)


def test_nothing_to_cut():
    before = tile()
    assert surfaces.filtered(before) is before


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((-1.0,), "shortest_wavelength"),
        ((math.inf,), "shortest_wavelength"),
        ((0.0, math.nan), "longest_wavelength"),
        ((2e-4, 1e-4), "not longer"),
        ((1e-4, 0.0, "gauss"), "'gaussian'"),
    ],
)
def test_filter_refuses(arguments: tuple, message: str):
    with pytest.raises(ValueError, match=message):
        surfaces.filtered(tile(), *arguments)
