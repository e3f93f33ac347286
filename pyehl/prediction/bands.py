# SPDX-License-Identifier: BSD-3-Clause
"""Which wavelengths the friction comes from, and the cut-off with which a film is full."""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from pyehl.prediction.model import KNOWN_RATIO
from pyehl.prediction.spectrum import Spectrum
from pyehl.surfaces.map_steps import cropped, prominence
from pyehl.surfaces.prepare import Preparation
from pyehl.surfaces.tile import Topography
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


def cutoff_error(bands: Sequence[Band]) -> float:
    """Return what the last octave of wavelengths adds to mu_r/mu_s [-], by its modulus.

    This depends on the cut-off: a measure of what waves shorter than those of the map would
    add. NaN without bands.
    """
    return abs(bands[-1].increase) if bands else math.nan


def records(bands: Sequence[Band]) -> list[dict[str, float]]:
    """Give bands as results have them: names with units and values."""
    return [{name: getattr(band, key) for key, name in BAND_COLUMNS.items()} for band in bands]


Full = Callable[[Topography], bool]
"""Whether a tile is good enough: its film is full."""

FEW = 0.01
"""Largest share of a map that counts as a few spikes: more is roughness, not dirt."""

CUT_OFF_TOLERANCE, THRESHOLD_TOLERANCE = 0.05, 0.1
"""Of a cut-off and of a threshold of spikes, relative."""

MIN_THRESHOLD = 5.0
"""Below it points of a normal distribution would count as spikes: at 5 one in two million."""


def suggested_wavelength(
    shortest: float, longest: float, full: Callable[[float], bool]
) -> float | None:
    """Find the cut-off [m] at which the film is full: shorter waves are taken off.

    Bisection in the logarithm of the wavelength to 5 %, between a `shortest` one, two pixels, and
    the `longest`, the length of the tile; the film need not be full for every longer cut-off, but
    it is for the one returned. `full` tells whether it is for a cut-off. None if even the longest
    waves break the film.
    """
    low, high = math.log(shortest), math.log(longest)
    if not full(math.exp(high)):
        return None
    while high - low > CUT_OFF_TOLERANCE:
        middle = 0.5 * (low + high)
        if full(math.exp(middle)):
            high = middle
        else:
            low = middle
    rounded = _two_digits(math.exp(high))
    return rounded if full(rounded) else math.exp(high)


def suggested_outliers(
    away: Array, without_spikes: Callable[[float], Topography], full: Full
) -> tuple[float, int] | None:
    """Find the threshold of spikes at which the film is full, if a few points are what breaks it.

    `away` is (nx, ny), see :func:`pyehl.surfaces.map_steps.prominence`; `without_spikes` takes
    a threshold. Threshold and number of points beyond it; None if more than a few have to go.
    """
    allowed = float(np.quantile(away, 1.0 - FEW))
    low = max(MIN_THRESHOLD, allowed)
    high = float(away.max())
    if low >= high or not full(without_spikes(low)):
        return None
    below, above = math.log(low), math.log(high)
    while above - below > THRESHOLD_TOLERANCE:
        middle = 0.5 * (below + above)
        if full(without_spikes(math.exp(middle))):
            below = middle
        else:
            above = middle
    # a threshold that a person would write, on the safe side
    rounded = float(f"{math.exp(below):.2g}")
    if rounded > math.exp(below) or rounded < low or not full(without_spikes(rounded)):
        rounded = math.exp(below)
    return rounded, int(np.count_nonzero(away > rounded))


def within_range(below: Callable[[float], float], shortest: float, longest: float) -> float | None:
    """Wavelength [a] without whose shorter waves mu_r/mu_s is in the range of the model.

    Within a tenth, between a `shortest` one and the `longest` of the surface; None: there is none.
    `below` gives mu_r/mu_s without waves shorter than a length.
    """
    low, high = shortest, longest
    if not below(high) <= KNOWN_RATIO:
        return None
    while high > 1.1 * low:
        middle = math.sqrt(low * high)
        low, high = (low, middle) if below(middle) <= KNOWN_RATIO else (middle, high)
    return high


def confirmed(start: float, longest: float, good: Callable[[float], bool]) -> float | None:
    """First wavelength of two digits, from `start` [m] on in steps of a tenth, that is good.

    None if there is none up to `longest` [m].
    """
    value = start
    while value <= longest:
        rounded = _two_digits(value)
        if good(rounded):
            return rounded
        value = 1.1 * rounded
    return None


def _two_digits(value: float) -> float:
    """Two digits of a wavelength, rounded up."""
    scale = 10.0 ** (math.floor(math.log10(value)) - 1)
    return float(f"{math.ceil(value / scale - 1e-9) * scale:.2g}")


def known_by_cut_off(
    keys: Sequence[str],
    spectra: Sequence[Spectrum],
    order: Sequence[int],
    radius: float,
    below: Callable[[list[float]], float],
    known: Callable[[Sequence[int], float], bool],
) -> str:
    """Say which cut-offs would bring the ratio into the range of the model; '' for none.

    Of surfaces whose cut-offs are the `keys` of a case; the `spectra` are theirs in `order`, in a
    contact of a Hertz `radius` [m]. `below` gives mu_r/mu_s of the waves with |q| below a limit
    [1/a] of each, in order; `known` tells whether the ratio without the waves shorter than a length
    [m] of the surfaces so numbered is.
    """
    ways = []
    shortest = min(min(spectrum.pixel) for spectrum in spectra)
    longest = 2.0 * math.pi / min(float(s.q[s.q > 0].min()) for s in spectra)
    for numbers in choices(len(keys)):

        def ratio(length: float, numbers: Sequence[int] = numbers) -> float:
            return below([2.0 * math.pi / length if k in numbers else math.inf for k in order])

        def good(length: float, numbers: Sequence[int] = numbers) -> bool:
            return known(numbers, length)

        high = within_range(ratio, shortest, longest)
        cut = None if high is None else confirmed(high * radius, longest * radius, good)
        if cut is not None:
            ways.append(f"{' with '.join(keys[k] for k in numbers)} = {cut:g}")
    return f"; {', or '.join(ways)} would leave {KNOWN_RATIO:g} or less" if ways else ""


def choices(count: int) -> list[tuple[int, ...]]:
    """Numbers of the surfaces of which short waves are cut: each alone, then both."""
    return [(0,)] if count == 1 else [(0,), (1,), (0, 1)]


def remedies_of(tile: Topography) -> tuple[str, ...]:
    """Options that take form and line offsets off a map: cuts of waves would take them as well."""
    if tile.preparation is None:
        return ()
    found = tile.preparation.record.findings
    return tuple(f"{f.remedy} ({f.kind})" for f in found if f.kind in ("form", "line offsets"))


def spikes_of(
    made: Preparation,
    without_spikes: Callable[[float], Topography],
    full: Full,
) -> tuple[float, int] | None:
    """Threshold with a full film, and the number of points beyond it."""
    heights = made.scan.heights
    if any(made.options.crop):
        nx, ny = heights.shape
        pixel = (made.scan.length_x / nx, made.scan.length_y / ny)
        heights = cropped(heights, pixel, made.options.crop)
    try:
        away = prominence(heights)
    except ValueError:
        # no spread to tell spikes by
        return None
    return suggested_outliers(away, without_spikes, full)
