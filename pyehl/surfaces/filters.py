# SPDX-License-Identifier: BSD-3-Clause
"""Spectra of tiles, and their cut by the compiled library: what the solver does, too.

Spectra follow Jacobs, Junge & Pastewka 2017 (doi 10.1088/2051-672X/aa51f8):
C2D(q) = |dx dy sum z exp(-i q x)|^2/(Lx Ly) [m^4], so that h_rms^2 = sum C2D/(Lx Ly), and C_iso is
its mean over annuli of |q|.
"""

import math
from dataclasses import replace

import numpy as np

from pyehl.errors import InputError, check
from pyehl.extension import surface_functions
from pyehl.surfaces.tile import Topography
from pyehl.types import Array


def wavenumbers(topography: Topography) -> tuple[Array, Array]:
    """q_x (nx, 1) and q_y (1, ny//2 + 1) of the half spectrum of a tile [rad/m]."""
    nx, ny = topography.shape
    dx, dy = topography.pixel
    qx = np.asarray(2.0 * np.pi * np.fft.fftfreq(nx, dx), dtype=np.float64)
    qy = np.asarray(2.0 * np.pi * np.fft.rfftfreq(ny, dy), dtype=np.float64)
    return qx[:, np.newaxis], qy[np.newaxis, :]


def psd_2d(topography: Topography) -> tuple[Array, Array, Array]:
    """Power spectral density of a tile: qx (nx,), qy (ny,) [rad/m] and C2D (nx, ny) [m^4].

    Wavenumbers ascend, zero at index nx//2 and ny//2; sum(C2D)/(Lx Ly) is the mean square height
    about the mean.
    """
    nx, ny = topography.shape
    dx, dy = topography.pixel
    z = topography.heights - topography.heights.mean()
    amplitude = np.fft.fft2(z, norm="forward")
    area = topography.length_x * topography.length_y
    c2d = np.fft.fftshift(area * np.abs(amplitude) ** 2)
    qx = np.fft.fftshift(2.0 * np.pi * np.fft.fftfreq(nx, dx))
    qy = np.fft.fftshift(2.0 * np.pi * np.fft.fftfreq(ny, dy))
    return qx, qy, c2d


def psd_isotropic(topography: Topography) -> tuple[Array, Array]:
    """Mean of C2D over annuli of |q|: mean wavenumber (n,) [rad/m], ascending; C_iso (n,) [m^4].

    The annuli are centred on the multiples of 2 pi/min(Lx, Ly) and as wide. What lies beyond the
    smaller Nyquist wavenumber, where the square no longer fills the circle, is left out, and so
    are empty annuli.
    """
    qx, qy, c2d = psd_2d(topography)
    q = np.hypot(qx[:, np.newaxis], qy[np.newaxis, :])
    step = 2.0 * np.pi / min(topography.length_x, topography.length_y)
    largest = np.pi / max(topography.pixel)
    ring = np.rint(q / step).astype(int)
    keep = (ring > 0) & (q <= largest * (1.0 + 1e-12))
    count = np.bincount(ring[keep])
    filled = count > 0
    mean_q = np.bincount(ring[keep], q[keep])[filled] / count[filled]
    mean_c = np.bincount(ring[keep], c2d[keep])[filled] / count[filled]
    return mean_q, mean_c


def filtered(
    topography: Topography,
    shortest_wavelength: float = 0.0,
    longest_wavelength: float = 0.0,
    kind: str = "sharp",
) -> Topography:
    r"""Cut the spectrum of a periodic tile at a shortest and a longest wavelength [m]; 0: none.

    As ISO 25178 has them, the S-filter and the L-filter; the wavelength of a component is 2
    pi/\|q\|, the mean height goes with `longest_wavelength`. ``"sharp"``: components between the
    cut-offs pass, those at them too, others do not; ``"gaussian"``: the areal Gaussian filters of
    ISO 16610-61, of which half of the amplitude passes at the cut-off: exp(-pi (alpha l_c/l)^2)
    for a shortest wavelength l_c, one less that for a longest, alpha = sqrt(ln 2/pi). InputError
    for a negative or infinite wavelength, a longest that is not above the shortest, or another
    kind.
    """
    for name, value in (("shortest", shortest_wavelength), ("longest", longest_wavelength)):
        if not (math.isfinite(value) and value >= 0.0):
            raise InputError(f"{name}_wavelength must not be negative [m], not {value!r}")
    if longest_wavelength and longest_wavelength <= shortest_wavelength:
        raise InputError(
            f"longest_wavelength = {longest_wavelength!r} m is not longer than "
            f"shortest_wavelength = {shortest_wavelength!r} m"
        )
    if kind not in ("sharp", "gaussian"):
        raise InputError(f"filter {kind!r}: expected 'sharp' or 'gaussian'")
    if not shortest_wavelength and not longest_wavelength:
        return topography
    z = np.array(topography.heights, dtype=np.float64, order="F")
    status, message = surface_functions.filter_tile(
        z,
        topography.length_x,
        topography.length_y,
        shortest_wavelength,
        longest_wavelength,
        int(kind == "gaussian"),
    )
    check(status, message)
    return replace(topography, heights=np.ascontiguousarray(z))
