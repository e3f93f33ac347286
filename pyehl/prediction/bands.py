# SPDX-License-Identifier: BSD-3-Clause
"""Which wavelengths the friction comes from."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import scipy.fft
from numpy.typing import NDArray

from pyehl.prediction.flattening import response
from pyehl.prediction.friction import predict_friction
from pyehl.prediction.options import Options
from pyehl.surfaces import Topography, wavenumbers
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint

__all__ = ["Band", "contributions"]


@dataclass(frozen=True, slots=True)
class Band:
    """What a band of wavelengths adds.

    Attributes
    ----------
    longest, shortest
        The band of wavelengths 2 pi/|q| [m].
    rms_height
        Of the undeformed roughness in the band [m].
    rms_deformed
        Of the deformed roughness in the band [m].
    rms_pressure
        Of delta p in the band [Pa].
    rise
        How much mu_r/mu_s grows when this band joins all the longer ones [-]; NaN where the model
        does not hold.
    """

    longest: float
    shortest: float
    rms_height: float
    rms_deformed: float
    rms_pressure: float
    rise: float


def contributions(
    topography: Topography,
    operating: OperatingPoint,
    lubricant: Lubricant,
    film: float,
    options: Options | None = None,
) -> list[Band]:
    """Which wavelengths the friction comes from, octave by octave from the longest.

    Parameters as :func:`predict_friction`.

    Returns
    -------
    list of Band
        Longest waves first; octaves without any roughness are left out. The rises add up to the
        whole mu_r/mu_s - 1.

    Raises
    ------
    ValueError
        As :func:`predict_friction`.
    """
    options = options or Options()
    qx, qy = wavenumbers(topography)
    q = np.hypot(qx, qy)
    heights = scipy.fft.rfft2(topography.heights - topography.heights.mean())
    # a harmonic pattern has rounding errors in all bands but its own
    present = np.abs(heights) > 1e-10 * np.abs(heights).max()
    lowest = float(q[q > 0.0].min())
    octave = np.full(q.shape, -1)
    octave[q > 0.0] = np.floor(np.log2(q[q > 0.0] / lowest) + 1e-9).astype(int)
    bands: list[Band] = []
    before = 1.0
    for k in range(int(octave.max()) + 1):
        in_band, so_far = octave == k, octave <= k
        if not (in_band & present).any():
            continue
        part = _filtered(topography, heights, in_band)
        field = response(part, operating, options)
        total = predict_friction(
            _filtered(topography, heights, so_far), operating, lubricant, film, options
        )
        bands.append(
            Band(
                longest=2.0 * math.pi / (lowest * 2.0**k),
                shortest=2.0 * math.pi / (lowest * 2.0 ** (k + 1)),
                rms_height=part.rms_height,
                rms_deformed=float(np.std(field.deformed)),
                rms_pressure=float(np.std(field.pressure)),
                rise=total.mu_ratio - before,
            )
        )
        before = total.mu_ratio
    return bands


def _filtered(
    topography: Topography, heights: NDArray[np.complex128], keep: NDArray[np.bool_]
) -> Topography:
    z = scipy.fft.irfft2(heights * keep, s=topography.shape)
    return Topography(np.asarray(z), topography.length_x, topography.length_y, topography.origin)
