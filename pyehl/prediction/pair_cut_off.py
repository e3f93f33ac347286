# SPDX-License-Identifier: BSD-3-Clause
"""Which cut-off of two surfaces brings their ratio into the range of the model."""

import math
from collections.abc import Callable, Sequence

from pyehl.prediction.carrying import confirmed, within_range
from pyehl.prediction.errors import KNOWN_RATIO
from pyehl.prediction.friction import RoughFriction
from pyehl.prediction.spectrum import Spectrum
from pyehl.surfaces import GROUPS

Below = Callable[[tuple[float, float]], float]
Predicted = Callable[[Sequence[int], float], RoughFriction]


def known_by_cut_off(
    spectra: Sequence[Spectrum],
    order: tuple[int, int],
    radius: float,
    below: Below,
    without: Predicted,
) -> str:
    """Say which cut-offs would bring the ratio into the range of the model; '' for none.

    Of surfaces with these `spectra`, whose numbers are `order`, in a contact of a Hertz `radius`
    [m]. `below` gives mu_r/mu_s of the waves with |q| below a limit [1/a] of each, `without` the
    friction without the waves shorter than a length [m] of the surfaces so numbered.
    """
    ways = []
    shortest = min(min(spectrum.pixel) for spectrum in spectra)
    longest = 2.0 * math.pi / min(float(s.q[s.q > 0].min()) for s in spectra)
    for numbers in ((0,), (1,), (0, 1)):
        cut = _cut_off(numbers, order, (shortest, longest), radius, below, without)
        if cut is not None:
            names = " with ".join(f"{GROUPS[k]}.shortest_wavelength" for k in numbers)
            ways.append(f"{names} = {cut:g}")
    return f"; {', or '.join(ways)} would leave {KNOWN_RATIO:g} or less" if ways else ""


def _cut_off(
    numbers: Sequence[int],
    order: tuple[int, int],
    lengths: tuple[float, float],
    radius: float,
    below: Below,
    without: Predicted,
) -> float | None:
    """Wavelength [m] below which waves of some surfaces must go for a ratio that is known.

    Between two lengths [a].
    """
    cut = [k in numbers for k in order]

    def ratio(length: float) -> float:
        first, second = (2.0 * math.pi / length if c else math.inf for c in cut)
        return below((first, second))

    def known(length: float) -> bool:
        found = without(numbers, length)
        return found.status == "predicted" and found.mu_ratio <= KNOWN_RATIO

    high = within_range(ratio, *lengths)
    return None if high is None else confirmed(high * radius, lengths[1] * radius, known)
