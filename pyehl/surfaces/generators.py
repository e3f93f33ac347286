# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces that are made: fractal and harmonic.

The fractal generator is that of the compiled library, which the program `ehl` uses too: a seed is
the same surface in both, to the bit. It is written there and not taken from a surface library
because the seed must give the same surface for as long as the package lives, and because the
modulus of each Fourier component must be selectable, exactly on the power law or random.
"""

import math

import numpy as np

from pyehl.errors import InputError, check
from pyehl.extension import surface_functions
from pyehl.given import positive
from pyehl.surfaces.tile import MAX_PIXELS, Topography

FEATURES = ("dent", "bump", "ridge", "groove")
"""Kinds of surfaces that pass the contact once; the solver alone makes them."""


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
    lay_ratio: float = 1.0,
) -> Topography:
    """Self-affine surface with random phases.

    C2D is proportional to max(|q|, q_r)^(-2 - 2 hurst) up to the Nyquist wavenumbers of the tile,
    zero at q = 0; q_r = `rolloff_wavenumber` [rad/m], 0: no roll-off. The rms height [m] is exact
    for each surface, the mean is zero, the tile is periodic. `pixels` per side, or (nx, ny); size
    of the tile in m; 0 < hurst <= 1. Two surfaces of one seed and different pixels are not the
    same surface; the seed is not negative, of any size, and the phases come from the raw words of
    PCG64, as NumPy seeds it. Modulus ``"deterministic"``: each component lies exactly on the power
    law, only phases are random (the usual generator); ``"gaussian"``: amplitudes of a Gaussian
    random field. `lay_ratio` r: length of correlation along x over that along y; q is then that
    across the lay, max(1, r) q_x and q_y/min(1, r). InputError for an argument out of range.
    """
    nx, ny = (pixels, pixels) if isinstance(pixels, int) else pixels
    if nx < 4 or ny < 4 or nx * ny > MAX_PIXELS:
        raise InputError(f"pixels must be at least 4 per side and at most {MAX_PIXELS} in all")
    if not 0.0 < hurst <= 1.0:
        raise InputError(f"hurst must be in (0, 1], not {hurst!r}")
    if not (math.isfinite(rolloff_wavenumber) and rolloff_wavenumber >= 0.0):
        raise InputError(
            f"rolloff_wavenumber must not be negative [rad/m], not {rolloff_wavenumber!r}"
        )
    lengths = {"rms_height": rms_height, "length_x": length_x, "length_y": length_y}
    for name, value in lengths.items():
        positive(name, value, "m")
    positive("lay_ratio", lay_ratio, "-")
    if seed < 0:
        raise InputError(f"seed must not be negative, not {seed!r}")
    if modulus not in ("deterministic", "gaussian"):
        raise InputError(f"modulus {modulus!r}: expected 'deterministic' or 'gaussian'")

    size = max(1, (seed.bit_length() + 31) // 32)
    words = np.frombuffer(seed.to_bytes(4 * size, "little"), dtype="<i4").astype(np.int32)
    z = np.empty((nx, ny))
    # y is the first index of the library's array
    status, message = surface_functions.fractal(
        z.T,
        length_x,
        length_y,
        rms_height,
        hurst,
        rolloff_wavenumber,
        lay_ratio,
        words,
        int(modulus == "gaussian"),
    )
    check(status, message)
    origin = f"fractal, hurst {hurst:g}, seed {seed}, {modulus} modulus"
    return Topography(z, (length_x, length_y), origin, seed)


def harmonic(
    amplitude: float, wavelength_x: float, wavelength_y: float, pixels: tuple[int, int]
) -> Topography:
    """One tile of z = A cos(2 pi x/wavelength_x) cos(2 pi y/wavelength_y), eq. 15 behind the front.

    Amplitude A and wavelengths, which are the size of the tile, in m; `pixels` (nx, ny).
    """
    nx, ny = pixels
    x = np.cos(2.0 * np.pi * np.arange(nx) / nx)
    y = np.cos(2.0 * np.pi * np.arange(ny) / ny)
    return Topography(amplitude * np.outer(x, y), (wavelength_x, wavelength_y), "harmonic")
