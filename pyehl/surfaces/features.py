# SPDX-License-Identifier: BSD-3-Clause
r"""Single features, by the compiled library: what the solver lets through the contact, too.

With xi across the feature and eta along it, turned by the angle from x and y,

    z = +-h 10^(-10 s^2) cos(2 pi s),

dent and bump: s^2 = (xi/width)^2 + (eta/length)^2; ridge and groove: s = xi/width, and with a
length times 10^(-10 e^2), e = max(0, \|eta\| - length/2)/width. The profile is that of Venner,
Lubrecht & ten Napel 1991 (J. Tribology 113, 777) and Venner & Lubrecht 1994 (J. Tribology 116,
751).
"""

from __future__ import annotations

import math

import numpy as np

from pyehl.errors import InputError
from pyehl.given import positive
from pyehl.library import surface_functions
from pyehl.surfaces.tile import Topography

__all__ = ["FEATURES", "feature"]

FEATURES = ("dent", "bump", "ridge", "groove")
"""Kinds of surfaces that pass the contact once."""
# Half of a feature over its width: beyond it less than 3e-4 of its height is left
REACH = 0.6
# Pixels over a width, and least and most pixels of a side
PIXELS_WIDTH, FEWEST, MOST = 32, 64, 1024


def feature(
    kind: str,
    height: float,
    width: float,
    length: float = 0.0,
    angle: float = 0.0,
    *,
    end: float = 0.0,
) -> Topography:
    """Make a window, as large as the feature, with a single feature in its middle.

    `kind` is one of :data:`FEATURES`, peaks positive, with height or depth [m] and the size across
    and along it [m]; length 0: that of a dent or bump is its width, a ridge or groove has no ends.
    Counter-clockwise angle [degrees], at 0 width is along x. `end` is half of the window along a
    ridge or groove without ends [m]; 0: twice the width. InputError for an unknown kind or a size
    that is not positive.
    """
    if kind not in FEATURES:
        raise InputError(f"kind {kind!r}: expected one of {FEATURES}")
    for name, value in (("height", height), ("width", width)):
        positive(name, value, "m")
    if not (math.isfinite(length) and length >= 0.0):
        raise InputError(f"length must not be negative [m], not {length!r}")
    is_line = kind in ("ridge", "groove")
    along = length or (2.0 * (end or 2.0 * width) if is_line else width)
    across, half = REACH * width, REACH * along
    if is_line:
        half = 0.5 * along + (across if length else 0.0)
    c, s = abs(math.cos(math.radians(angle))), abs(math.sin(math.radians(angle)))
    sides = [2.0 * (across * c + half * s), 2.0 * (across * s + half * c)]
    step = min(width, along) / PIXELS_WIDTH
    pixels = [2 * math.ceil(min(max(FEWEST, side / step), MOST) / 2) for side in sides]
    axes = [(np.arange(n) - n / 2) * side / n for n, side in zip(pixels, sides, strict=True)]
    z = np.zeros((pixels[0], pixels[1]), order="F")
    surface_functions.feature(
        z,
        axes[0],
        axes[1],
        int(kind in ("bump", "ridge")),
        int(is_line),
        height,
        width,
        length,
        angle,
    )
    return Topography(np.ascontiguousarray(z), (sides[0], sides[1]), f"single {kind}")
