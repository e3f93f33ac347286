# SPDX-License-Identifier: BSD-3-Clause
"""Areal surface texture parameters of a height map (ISO 25178-2)."""

import math
from dataclasses import dataclass

import numpy as np
import scipy

from pyehl.types import Array

AREAL_NAMES = {
    "Sq": ("m", "root mean square height"),
    "Sa": ("m", "arithmetical mean height"),
    "Sz": ("m", "maximum height, peak to valley"),
    "Ssk": ("-", "skewness; negative: valleys deeper than peaks are high"),
    "Sku": ("-", "kurtosis; 3: normal distribution"),
    "Sdq": ("-", "root mean square gradient"),
    "Str": ("-", "texture aspect ratio; 1: no lay"),
}
"""Unit and meaning of each parameter of :func:`areal_numbers`."""

DECAY = 0.2
"""Autocorrelation at which ISO 25178-2 measures the correlation lengths."""

ANGLES = 180

BLOCK = 2**16
"""Number of points of a map that are processed at a time."""


@dataclass(frozen=True, slots=True)
class Extent:
    """Rms height, peak and slope of a map."""

    rms: float  # rms height about the mean [m]
    peak: float  # largest distance of a height from the mean [m]
    slope: float  # rms gradient, from differences of neighbours [-]


def extent(heights: Array, pixel: tuple[float, float]) -> Extent:
    """Rms, peak and slope of the valid points of a map; NaN if all points are missing.

    Heights (nx, ny) [m], NaN where missing; pixel size along x and y [m].
    """
    # a block of lines at a time: a map may be large
    lines = max(1, BLOCK // heights.shape[1])
    mean = float(heights.mean())
    if math.isnan(mean):
        parts = [heights[k : k + lines] for k in range(0, heights.shape[0], lines)]
        present = sum(int(np.count_nonzero(~np.isnan(part))) for part in parts)
        if present == 0:
            return Extent(math.nan, math.nan, math.nan)
        mean = math.fsum(float(np.nansum(part)) for part in parts) / present
    count, square, slopes, slope = 0, 0.0, 0, 0.0
    minimum, maximum = math.inf, -math.inf
    for first in range(0, heights.shape[0], lines):
        z = heights[first : first + lines + 1] - mean
        inner = z[:lines]
        valid = inner[~np.isnan(inner)] if np.isnan(inner.sum()) else inner.ravel()
        if valid.size:
            count += valid.size
            square += float(np.einsum("i,i->", valid, valid))
            minimum, maximum = min(minimum, float(valid.min())), max(maximum, float(valid.max()))
        # at the points that have a neighbour along x and along y
        dx = np.diff(z, axis=0)[:, :-1]
        dy = np.diff(z, axis=1)[:-1]
        dx *= dx
        dx *= (pixel[1] / pixel[0]) ** 2
        dy *= dy
        dx += dy
        part = float(dx.sum())
        slopes += dx.size
        if math.isnan(part):
            slopes -= int(np.isnan(dx).sum())
            part = float(np.nansum(dx))
        slope += part
    gradient = math.sqrt(slope / slopes) / pixel[1] if slopes else math.nan
    return Extent(math.sqrt(square / count), max(maximum, -minimum), gradient)


def areal_numbers(heights: Array, pixel: tuple[float, float]) -> dict[str, float]:
    """Sq, Sa, Sz, Ssk, Sku, Sdq and Str of a map about its mean, in the units of `AREAL_NAMES`.

    Heights (nx, ny) [m], none missing, levelled; pixel size along x and y [m].
    """
    z = heights - heights.mean()
    spread = extent(heights, pixel)
    sq, sdq = spread.rms, spread.slope
    cube, fourth = float(np.mean(z**3)), float(np.mean(z**4))
    return {
        "Sq": sq,
        "Sa": float(np.mean(np.abs(z))),
        "Sz": float(z.max() - z.min()),
        "Ssk": cube / sq**3 if sq > 0.0 else math.nan,
        "Sku": fourth / sq**4 if sq > 0.0 else math.nan,
        "Sdq": sdq,
        "Str": texture_aspect_ratio(z, pixel),
    }


def texture_aspect_ratio(heights: Array, pixel: tuple[float, float]) -> float:
    """Str of ISO 25178-2: shortest over longest distance at which the autocorrelation is 0.2.

    The autocorrelation is that of the map about its mean, each lag averaged over the overlap, for
    lags up to half of the shorter side. A direction in which it never falls to 0.2 counts with the
    largest lag, so that the Str of a perfect lay is an upper bound and not zero. Heights (nx, ny)
    [m], none missing; pixel size along x and y [m].
    """
    nx, ny = heights.shape
    z = heights - heights.mean()
    shape = (scipy.fft.next_fast_len(2 * nx, real=True), scipy.fft.next_fast_len(2 * ny, real=True))
    power = np.abs(scipy.fft.rfft2(z, s=shape)) ** 2
    correlation = scipy.fft.irfft2(power, s=shape)
    hx, hy = nx // 2, ny // 2
    lag_x, lag_y = np.arange(-hx, hx + 1), np.arange(-hy, hy + 1)
    overlap = (nx - np.abs(lag_x))[:, None] * (ny - np.abs(lag_y))[None, :]
    correlation = correlation[np.ix_(lag_x % shape[0], lag_y % shape[1])] / overlap
    if correlation[hx, hy] <= 0.0:
        return math.nan
    correlation /= correlation[hx, hy]
    reach = min(hx * pixel[0], hy * pixel[1])
    radius = np.arange(0.0, reach, 0.5 * min(pixel))
    angle = np.arange(ANGLES) * math.pi / ANGLES
    along = scipy.ndimage.map_coordinates(
        correlation,
        [
            hx + radius[None, :] * np.cos(angle)[:, None] / pixel[0],
            hy + radius[None, :] * np.sin(angle)[:, None] / pixel[1],
        ],
        order=1,
    )
    below = along <= DECAY
    first = np.where(below.any(axis=1), below.argmax(axis=1), radius.size - 1)
    length = radius[first]
    return float(length.min() / length.max()) if length.max() > 0.0 else math.nan
