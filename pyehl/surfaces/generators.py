# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces that are made: fractal and harmonic.

The fractal generator is written here and not taken from a surface library for three reasons: the
seed must give the same surface for as long as the package lives, which only raw output of a named
bit generator promises; the modulus of each Fourier component must be selectable, exactly on the
power law or random; and a surface is needed without heavy dependencies.
"""

from __future__ import annotations

import math

import numpy as np
import scipy.fft
from numpy.typing import NDArray

from pyehl.surfaces.spectra import wavenumbers
from pyehl.surfaces.tile import MAX_PIXELS, Topography

__all__ = ["fractal", "harmonic"]


def fractal(
    pixels: int | tuple[int, int],
    length_x: float,
    length_y: float,
    *,
    rms_height: float,
    hurst: float,
    rolloff_wavenumber: float = 0.0,
    seed: int = 1,
    modulus: str = "deterministic",
) -> Topography:
    """Self-affine surface with random phases.

    C2D is proportional to max(|q|, q_r)^(-2 - 2 hurst) up to the Nyquist wavenumbers of the tile,
    zero at q = 0. The rms height is exact for each surface, the mean is zero, the tile is periodic.

    Parameters
    ----------
    pixels
        Per side, or (nx, ny).
    length_x, length_y
        Size of the tile [m].
    rms_height
        [m], positive.
    hurst
        Hurst exponent, 0 < hurst <= 1.
    rolloff_wavenumber
        q_r [rad/m] below which the spectrum is flat; 0: no roll-off.
    seed
        Not negative. The phases come from the raw words of PCG64, which NumPy promises not to
        change.
    modulus
        ``"deterministic"``: each component lies exactly on the power law, only phases are random
        (the usual generator); ``"gaussian"``: amplitudes of a Gaussian random field.

    Returns
    -------
    Topography
        Two surfaces of one seed and different pixels are not the same surface.

    Raises
    ------
    ValueError
        For an argument out of range.
    """
    nx, ny = (pixels, pixels) if isinstance(pixels, int) else pixels
    if nx < 4 or ny < 4 or nx * ny > MAX_PIXELS:
        raise ValueError(f"pixels must be at least 4 per side and at most {MAX_PIXELS} in all")
    if not (math.isfinite(rms_height) and rms_height > 0.0):
        raise ValueError(f"rms_height must be positive [m], not {rms_height!r}")
    if not 0.0 < hurst <= 1.0:
        raise ValueError(f"hurst must be in (0, 1], not {hurst!r}")
    if not (math.isfinite(rolloff_wavenumber) and rolloff_wavenumber >= 0.0):
        raise ValueError(
            f"rolloff_wavenumber must not be negative [rad/m], not {rolloff_wavenumber!r}"
        )
    if seed < 0:
        raise ValueError(f"seed must not be negative, not {seed!r}")
    if modulus not in ("deterministic", "gaussian"):
        raise ValueError(f"modulus {modulus!r}: expected 'deterministic' or 'gaussian'")

    half = ny // 2 + 1
    words = np.random.PCG64(seed).random_raw(2 * nx * half)
    uniform = ((words >> np.uint64(11)).astype(float) * 2.0**-53).reshape(2, nx, half)
    component = np.exp(2j * np.pi * uniform[0])
    if modulus == "gaussian":
        component *= np.sqrt(-np.log1p(-uniform[1]))
    _make_hermitian(component, ny, gaussian=modulus == "gaussian")

    blank = Topography(np.zeros((nx, ny)), length_x, length_y)
    qx, qy = wavenumbers(blank)
    q = np.maximum(np.hypot(qx, qy), rolloff_wavenumber)
    q[0, 0] = np.inf
    component *= q ** (-1.0 - hurst)
    z = scipy.fft.irfft2(component, s=(nx, ny))
    z -= z.mean()
    z *= rms_height / np.sqrt(np.mean(z * z))
    origin = f"fractal, hurst {hurst:g}, seed {seed}, {modulus} modulus"
    return Topography(np.ascontiguousarray(z), length_x, length_y, origin, seed)


def _make_hermitian(component: NDArray[np.complex128], ny: int, *, gaussian: bool) -> None:
    """Give the columns q_y = 0 and Nyquist of a half spectrum the symmetry of a real surface.

    Component (q_x, q_y) there is the partner of (-q_x, q_y), so one half is copied from the other.
    The up to four components that are their own partner are real: a random sign at the given
    modulus, or, of a Gaussian field, a real normal number of the same mean square.
    """
    nx = component.shape[0]
    for j in [0] if ny % 2 else [0, ny // 2]:
        component[: nx // 2 : -1, j] = np.conj(component[1 : (nx + 1) // 2, j])
        for i in [0] if nx % 2 else [0, nx // 2]:
            value = component[i, j]
            if gaussian:
                component[i, j] = math.sqrt(2.0) * value.real
            else:
                component[i, j] = math.copysign(abs(value), value.real)


def harmonic(
    amplitude: float, wavelength_x: float, wavelength_y: float, pixels: tuple[int, int]
) -> Topography:
    """One tile of z = A cos(2 pi x/wavelength_x) cos(2 pi y/wavelength_y), eq. 15 behind the front.

    Parameters
    ----------
    amplitude
        A [m].
    wavelength_x, wavelength_y
        [m]; the size of the tile.
    pixels
        (nx, ny).
    """
    nx, ny = pixels
    x = np.cos(2.0 * np.pi * np.arange(nx) / nx)
    y = np.cos(2.0 * np.pi * np.arange(ny) / ny)
    return Topography(amplitude * np.outer(x, y), wavelength_x, wavelength_y, "harmonic")
