# SPDX-License-Identifier: BSD-3-Clause
"""Tiles and periodic sequences moved, or on a finer grid, by their Fourier interpolant."""

from dataclasses import replace
from typing import cast

import numpy as np

from pyehl.errors import InputError
from pyehl.surfaces.filters import wavenumbers
from pyehl.surfaces.tile import Topography
from pyehl.types import Array, Complex

LINES = 64
"""Lines of a tile that are moved together."""


def _shift_factor(q: Array, distance: float, nyquist: int | None) -> Complex:
    factor = np.exp(-1j * q * distance)
    if nyquist is not None:
        # half of this component travels with +q and half with -q
        factor[nyquist] = np.cos(q[nyquist] * distance)
    return cast("Complex", factor)


def shifted(topography: Topography, distance_x: float, distance_y: float = 0.0) -> Topography:
    """Return the tile moved by a distance [m] towards positive x and y, by its Fourier interpolant.

    Exact for the trigonometric polynomial through the heights; a shift by whole pixels is the
    cyclic copy to rounding. The Nyquist component is indistinguishable from a standing wave and is
    multiplied by the cosine of its phase, so it is the one part that a fraction of a pixel dims.
    """
    nx, ny = topography.shape
    qx, qy = wavenumbers(topography)
    fx = _shift_factor(qx[:, 0], distance_x, None if nx % 2 else nx // 2)
    fy = _shift_factor(qy[0, :], distance_y, None if ny % 2 else ny // 2)
    z = np.fft.rfft2(topography.heights) * fx[:, np.newaxis] * fy[np.newaxis, :]
    heights = np.fft.irfft2(z, s=(nx, ny))
    return replace(topography, heights=np.ascontiguousarray(heights))


def shift_across(heights: Array, length_y: float, distance: float) -> None:
    """Move a tile (nx, ny) along y by a distance [m] in place, as :func:`shifted` does."""
    ny = heights.shape[1]
    q = 2.0 * np.pi * np.fft.rfftfreq(ny, length_y / ny)
    factor = _shift_factor(q, distance, None if ny % 2 else ny // 2)
    for first in range(0, heights.shape[0], LINES):
        part = slice(first, first + LINES)
        heights[part] = np.fft.irfft(np.fft.rfft(heights[part], axis=1) * factor, n=ny, axis=1)


def resampled(topography: Topography, pixels: tuple[int, int]) -> Topography:
    """Return the tile on a finer grid by its Fourier interpolant, (nx, ny) = `pixels`.

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
            # the Nyquist component is one of two conjugate halves on a finer grid
            index = [slice(None), slice(None)]
            index[axis] = slice(old // 2, old // 2 + 1)
            values[tuple(index)] *= 0.5
        z = np.fft.irfft(values, n=new, axis=axis, norm="forward")
    return replace(topography, heights=np.ascontiguousarray(z))


def interpolated(values: Array, times: int) -> Array:
    """Trigonometric interpolant of a periodic sequence on so many times as many points."""
    n = values.size
    half = np.fft.rfft(values)
    if n % 2 == 0:
        half[-1] *= 0.5
    return np.asarray(np.fft.irfft(half, times * n) * times)
