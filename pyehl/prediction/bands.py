# SPDX-License-Identifier: BSD-3-Clause
"""Which wavelengths the friction comes from."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from pyehl.prediction.flattening import response
from pyehl.prediction.friction import predict_friction
from pyehl.prediction.options import Options
from pyehl.surfaces import Topography, wavenumbers
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint

__all__ = ["Band", "contributions", "octaves"]

Array = NDArray[np.float64]

# A wave at the end of an octave begins the next one, whatever its last digits
ROUNDING = 1e-9
# Share of the largest mean square that counts for none
NOTHING = 1e-20


@dataclass(frozen=True, slots=True)
class Band:
    """What a band of wavelengths adds."""

    # The band of wavelengths 2 pi/|q| [m]
    longest: float
    shortest: float
    rms_height: float  # of the undeformed roughness in the band [m]
    rms_deformed: float  # of the deformed roughness in the band [m]
    rms_pressure: float  # of delta p in the band [Pa]
    # How much mu_r/mu_s grows when this band joins all the longer ones [-]; NaN where the model
    # does not hold
    rise: float


def octaves(
    q: Array, power: Array, *, only: int = 0
) -> Iterator[tuple[float, NDArray[np.bool_], bool]]:
    """Octaves of wavelengths that hold roughness, longest first; `only` the last so many, 0: all.

    `q` is |q| of the components, of any shape and unit, `power` what each adds to the mean square
    height; at most `NOTHING` of the largest counts for none (a harmonic pattern has rounding errors
    in all octaves but its own). Yields the longest wavelength 2 pi/|q| of the octave, which
    components are in it, and whether it is the last one.
    """
    lowest = float(q[q > 0.0].min())
    octave = np.full(q.shape, -1)
    octave[q > 0.0] = np.floor(np.log2(q[q > 0.0] / lowest) + ROUNDING).astype(int)
    present = power > NOTHING * power.max()
    filled = [k for k in range(int(octave.max()) + 1) if (present & (octave == k)).any()]
    for k in filled[-only:]:
        yield 2.0 * math.pi / (lowest * 2.0**k), octave == k, k == filled[-1]


def contributions(
    topography: Topography,
    operating: OperatingPoint,
    lubricant: Lubricant,
    film: float,
    options: Options | None = None,
    *,
    brief: bool = False,
) -> list[Band]:
    """Which wavelengths the friction comes from, octave by octave from the longest.

    Parameters as :func:`predict_friction`; `brief`: the shortest octave alone. Octaves without any
    roughness are left out; the rises add up to the whole mu_r/mu_s - 1. InputError as
    :func:`predict_friction`.
    """
    options = options or Options()
    qx, qy = wavenumbers(topography)
    q = np.hypot(qx, qy)
    heights = scipy.fft.rfft2(topography.heights - topography.heights.mean())
    bands: list[Band] = []
    before = 1.0
    for longest, in_band, _ in octaves(q, np.square(np.abs(heights)), only=2 if brief else 0):
        # octaves without roughness may be in or not
        so_far = q < 4.0 * math.pi / longest * (1.0 - ROUNDING)
        part = _filtered(topography, heights, in_band)
        field = response(part, operating, options)
        total = predict_friction(
            _filtered(topography, heights, so_far), operating, lubricant, film, options
        )
        bands.append(
            Band(
                longest=longest,
                shortest=0.5 * longest,
                rms_height=part.rms_height,
                rms_deformed=float(np.std(field.deformed)),
                rms_pressure=float(np.std(field.pressure)),
                rise=total.mu_ratio - before,
            )
        )
        before = total.mu_ratio
    return bands[-1:] if brief else bands


def _filtered(
    topography: Topography, heights: NDArray[np.complex128], keep: NDArray[np.bool_]
) -> Topography:
    z = scipy.fft.irfft2(heights * keep, s=topography.shape)
    return Topography(np.asarray(z), topography.size, topography.origin)
