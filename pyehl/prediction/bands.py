# SPDX-License-Identifier: BSD-3-Clause
"""Which wavelengths the friction comes from."""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from pyehl.theory.operating import OperatingPoint
from pyehl.types import Array, Mask

# A wave at the end of an octave begins the next one, whatever its last digits
ROUNDING = 1e-9
# Share of the largest mean square that counts for none: rounding leaves its square, 1e-32
NOTHING = 1e-20

# Attributes of a band, and what they are called in results
BAND_COLUMNS = {
    "longest": "longest_m",
    "shortest": "shortest_m",
    "rms_height": "rms_height_m",
    "rms_deformed": "rms_deformed_m",
    "rms_pressure": "rms_pressure_Pa",
    "increase": "increase",
}


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
    increase: float


def octaves(q: Array, power: Array, *, only: int = 0) -> Iterator[tuple[float, Mask, bool]]:
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


def joining(
    waves: tuple[Array, Array, Array, Array],
    below: Callable[[float], float],
    total: float,
    operating: OperatingPoint,
    *,
    brief: bool,
) -> list[Band]:
    """Return what each octave, or the last one alone (`brief`), adds when it joins the longer ones.

    Of waves, arrays of the same shape: |q| [1/a], mean square height [a^4/R^2], |T| [-], pressure
    over roughness [p_h R/a^2]. `below` gives mu_r/mu_s of the waves with |q| below a limit [1/a],
    `total` is that of all.
    """
    q, power, deformed, pressure = waves
    a, film, p_h = operating.hertz_radius, operating.film_scale, operating.hertz_pressure
    found: list[Band] = []
    before = 1.0
    for longest, inside, last in octaves(q, power, only=2 if brief else 0):
        ratio = total if last else below(4.0 * np.pi / longest)
        if brief and not last:
            before = ratio
            continue
        rms = [
            math.sqrt(float((power * np.square(factor))[inside].sum()))
            for factor in (np.ones_like(pressure), deformed, pressure)
        ]
        found.append(
            Band(
                longest=longest * a,
                shortest=0.5 * longest * a,
                rms_height=rms[0] * film,
                rms_deformed=rms[1] * film,
                rms_pressure=rms[2] * p_h,
                increase=ratio - before,
            )
        )
        before = ratio
    return found


def records(bands: Sequence[Band]) -> list[dict[str, float]]:
    """Give bands as results have them: names with units and values."""
    return [{name: getattr(band, key) for key, name in BAND_COLUMNS.items()} for band in bands]
