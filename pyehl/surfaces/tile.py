# SPDX-License-Identifier: BSD-3-Clause
"""Periodic tiles of heights: generated surfaces, spectra, cut-offs and the Fourier interpolant.

The fractal generator is that of the compiled library, which the program `ehl` also uses: a seed
gives the same surface in both, to the bit. It is part of the library because a seed must give the
same surface in all versions of the package, and because the modulus of each Fourier component must
be selectable, exactly on the power law or random.

Spectra follow Jacobs, Junge & Pastewka 2017 (doi 10.1088/2051-672X/aa51f8):
C2D(q) = |dx dy sum z exp(-i q x)|^2/(Lx Ly) [m^4], so that h_rms^2 = sum C2D/(Lx Ly), and C_iso is
its mean over annuli of |q|.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, cast

import numpy as np

from pyehl.errors import InputError, check
from pyehl.extension import surface_functions
from pyehl.given import positive, real_numbers
from pyehl.types import Array, Complex

if TYPE_CHECKING:
    from pyehl.surfaces.prepare import Preparation

MAX_PIXELS = 2**26
"""Maximum number of pixels of a map (512 MB of heights)."""


@dataclass(frozen=True, slots=True)
class Topography:
    """A periodic tile of heights.

    Attributes
    ----------
    heights
        (nx, ny) [m], first index along the motion, peaks positive.
    size
        Length of the tile along x and y [m].
    origin
        Origin of the heights, as text.
    seed
        Seed of a generated surface, else None.
    preparation
        Preparation of the map of this tile, else None.

    Raises
    ------
    InputError
        If the heights are not a finite matrix of at least 2 x 2 or a length is not positive.

    Examples
    --------
    >>> import numpy as np
    >>> import pyehl
    >>> x = np.arange(64) / 64
    >>> ridges = 1e-8 * np.cos(2.0 * np.pi * x)[:, None] * np.ones(32)
    >>> tile = pyehl.Topography(ridges, size=(2e-4, 1e-4))
    >>> tile.shape, float(round(tile.rms_height * 1e9, 3))
    ((64, 32), 7.071)
    """

    heights: Array
    size: tuple[float, float]
    origin: str = ""
    seed: int | None = None
    preparation: Preparation | None = None

    def __post_init__(self) -> None:
        """Check shape, numbers and size."""
        what = self.origin or "surface"
        # masked points become NaN
        z = np.asarray(real_numbers(self.heights, what), dtype=np.float64)
        object.__setattr__(self, "heights", z)
        if z.ndim != 2 or min(z.shape) < 2:
            raise InputError(
                f"{what}: heights must be a matrix (nx, ny) of at least 2 x 2, "
                f"not of shape {z.shape}"
            )
        bad = int(z.size - np.count_nonzero(np.isfinite(z)))
        if bad:
            i, j = np.argwhere(~np.isfinite(z))[0]
            raise InputError(
                f"{what}: {bad} of {z.size} heights are not finite, the first "
                f"at row {i}, column {j}; fill the holes of the map first"
            )
        try:
            length_x, length_y = map(float, self.size)
        except (TypeError, ValueError):
            raise InputError(
                f"{what}: size = {self.size!r}: expected the two lengths of the tile [m]"
            ) from None
        for name, value in (("length_x", length_x), ("length_y", length_y)):
            if not (math.isfinite(value) and value > 0.0):
                raise InputError(f"{what}: {name} must be positive [m], not {value!r}")
        object.__setattr__(self, "size", (length_x, length_y))

    @property
    def length_x(self) -> float:
        """Length of the tile along x [m]."""
        return self.size[0]

    @property
    def length_y(self) -> float:
        """Length of the tile along y [m]."""
        return self.size[1]

    @property
    def shape(self) -> tuple[int, int]:
        """Pixels along x and y."""
        return self.heights.shape[0], self.heights.shape[1]

    @property
    def pixel(self) -> tuple[float, float]:
        """Pixel size along x and y [m]."""
        return self.length_x / self.shape[0], self.length_y / self.shape[1]

    @property
    def rms_height(self) -> float:
        """Root mean square of the heights about their mean [m]."""
        return float(np.std(self.heights))


FEATURES = ("dent", "bump", "ridge", "groove")
"""Single features, which pass the contact once; only the solver generates them."""


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
    """Generate a self-affine surface with random phases.

    C2D is proportional to max(|q|, q_r)^(-2 - 2 hurst) up to the Nyquist wavenumbers of the tile,
    zero at q = 0; q_r = `rolloff_wavenumber` [rad/m], 0: no roll-off. The rms height [m] is exact
    for each surface, the mean is zero, the tile is periodic. `pixels` per side, or (nx, ny); size
    of the tile in m; 0 < hurst <= 1. The same seed with other `pixels` gives another surface; the
    seed is any integer that is not negative, and the phases come from the raw words of PCG64,
    seeded as in NumPy. Modulus ``"deterministic"``: each component is exactly on the power law,
    only phases are random (the usual generator); ``"gaussian"``: amplitudes of a Gaussian random
    field. `lay_ratio` r: correlation length along x over that along y; q is then that across the
    lay, max(1, r) q_x and q_y/min(1, r). InputError for an argument out of range.
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
    """Generate one period of z = A cos(2 pi x/wavelength_x) cos(2 pi y/wavelength_y).

    This is eq. 15 of Zhang et al. 2019 behind the front. Amplitude A and wavelengths, which are the
    size of the tile, in m; `pixels` (nx, ny).
    """
    nx, ny = pixels
    x = np.cos(2.0 * np.pi * np.arange(nx) / nx)
    y = np.cos(2.0 * np.pi * np.arange(ny) / ny)
    return Topography(amplitude * np.outer(x, y), (wavelength_x, wavelength_y), "harmonic")


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

    The annuli are centred on the multiples of 2 pi/min(Lx, Ly) and as wide. Wavenumbers beyond the
    smaller Nyquist wavenumber, where the annuli are incomplete, and empty annuli are omitted.
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

    These are the S-filter and the L-filter of ISO 25178; the wavelength of a component is 2
    pi/\|q\|, and `longest_wavelength` also removes the mean height. ``"sharp"``: components between
    the cut-offs, inclusive, pass; ``"gaussian"``: the areal Gaussian filters of ISO 16610-61, which
    transmit half of the amplitude at the cut-off: exp(-pi (alpha l_c/l)^2) for a shortest
    wavelength l_c, one minus that for a longest, alpha = sqrt(ln 2/pi). InputError for a negative
    or infinite wavelength, a longest that is not above the shortest, or another kind.
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


LINES = 64
"""Number of lines of a tile that are shifted at a time."""


def _shift_factor(q: Array, distance: float, nyquist: int | None) -> Complex:
    factor = np.exp(-1j * q * distance)
    if nyquist is not None:
        # this component is half a wave of +q and half a wave of -q
        factor[nyquist] = np.cos(q[nyquist] * distance)
    return cast("Complex", factor)


def shifted(topography: Topography, distance_x: float, distance_y: float = 0.0) -> Topography:
    """Return the tile shifted by a distance [m] towards positive x and y, by Fourier interpolation.

    Exact for the trigonometric polynomial through the heights; a shift by whole pixels is a cyclic
    permutation up to rounding. The Nyquist component is indistinguishable from a standing wave and
    is multiplied by the cosine of its phase, so that shifts by part of a pixel attenuate only it.
    """
    nx, ny = topography.shape
    qx, qy = wavenumbers(topography)
    fx = _shift_factor(qx[:, 0], distance_x, None if nx % 2 else nx // 2)
    fy = _shift_factor(qy[0, :], distance_y, None if ny % 2 else ny // 2)
    z = np.fft.rfft2(topography.heights) * fx[:, np.newaxis] * fy[np.newaxis, :]
    heights = np.fft.irfft2(z, s=(nx, ny))
    return replace(topography, heights=np.ascontiguousarray(heights))


def shift_across(heights: Array, length_y: float, distance: float) -> None:
    """Shift a tile (nx, ny) along y by a distance [m] in place, as :func:`shifted` does."""
    ny = heights.shape[1]
    q = 2.0 * np.pi * np.fft.rfftfreq(ny, length_y / ny)
    factor = _shift_factor(q, distance, None if ny % 2 else ny // 2)
    for first in range(0, heights.shape[0], LINES):
        part = slice(first, first + LINES)
        heights[part] = np.fft.irfft(np.fft.rfft(heights[part], axis=1) * factor, n=ny, axis=1)


def resampled(topography: Topography, pixels: tuple[int, int]) -> Topography:
    """Return the tile on a finer grid of `pixels` (nx, ny), by Fourier interpolation.

    InputError if the new grid has fewer pixels in a direction.
    """
    if pixels == topography.shape:
        return topography
    z = topography.heights
    for axis in (0, 1):
        old, new = topography.shape[axis], pixels[axis]
        if new < old:
            raise InputError(f"cannot resample {topography.shape} pixels to fewer, {pixels}")
        if new == old:
            continue
        values = np.fft.rfft(z, axis=axis, norm="forward")
        if old % 2 == 0:
            # on a finer grid the Nyquist component splits into two conjugate halves
            index = [slice(None), slice(None)]
            index[axis] = slice(old // 2, old // 2 + 1)
            values[tuple(index)] *= 0.5
        z = np.fft.irfft(values, n=new, axis=axis, norm="forward")
    return replace(topography, heights=np.ascontiguousarray(z))


def interpolated(values: Array, times: int) -> Array:
    """Interpolate a periodic sequence (n,) trigonometrically on `times` > 1 as many points."""
    n = values.size
    half = np.fft.rfft(values)
    if n % 2 == 0:
        half[-1] *= 0.5
    return np.asarray(np.fft.irfft(half, times * n) * times)
