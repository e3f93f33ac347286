# SPDX-License-Identifier: BSD-3-Clause
"""Spectra of tiles.

They follow Jacobs, Junge & Pastewka 2017 (doi 10.1088/2051-672X/aa51f8):
C2D(q) = |dx dy sum z exp(-i q x)|^2/(Lx Ly) [m^4], so that h_rms^2 = sum C2D/(Lx Ly), and C_iso is
its mean over annuli of |q|.
"""

import numpy as np

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
