# SPDX-License-Identifier: BSD-3-Clause
"""Which cut-off of two surfaces brings their ratio into the range of the model."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from pyehl.prediction.carrying import confirmed, within_range
from pyehl.prediction.errors import KNOWN_RATIO
from pyehl.surfaces import GROUPS

if TYPE_CHECKING:
    from pyehl.prediction.pair import PairParts, RoughPair

__all__ = ["known_by_cut_off"]


def known_by_cut_off(pair: RoughPair, parts: PairParts) -> str:
    """Say which cut-offs would bring the ratio into the range of the model; '' for none."""
    ways = []
    shortest = min(min(spectrum.pixel) for spectrum, _, _ in parts)
    longest = 2.0 * math.pi / min(float(s.q[s.q > 0].min()) for s, _, _ in parts)
    for groups in ((0,), (1,), (0, 1)):
        cut = _cut_off(pair, parts, groups, (shortest, longest))
        if cut is not None:
            names = " with ".join(f"{GROUPS[k]}.shortest_wavelength" for k in groups)
            ways.append(f"{names} = {cut:g}")
    return f"; {', or '.join(ways)} would leave {KNOWN_RATIO:g} or less" if ways else ""


def _cut_off(
    pair: RoughPair, parts: PairParts, groups: Sequence[int], lengths: tuple[float, float]
) -> float | None:
    """Wavelength [m] below which waves of some surfaces must go for a ratio that is known.

    Between two lengths [a].
    """
    cut, a = [k in groups for k in pair.order], pair.of[0].operating.hertz_radius

    def below(length: float) -> float:
        first, second = (2.0 * math.pi / length if c else math.inf for c in cut)
        return pair.below_limits(parts, (first, second))

    def known(length: float) -> bool:
        found, _, _ = pair.without_shorter(groups, length).run(0, brief=True)
        return found.status == "predicted" and found.mu_ratio <= KNOWN_RATIO

    high = within_range(below, *lengths)
    if high is None:
        return None
    return confirmed(high * a, lengths[1] * a, known)
