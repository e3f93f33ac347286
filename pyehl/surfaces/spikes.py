# SPDX-License-Identifier: BSD-3-Clause
"""Spikes of a map: points that stand out of their neighbourhood.

Optical instruments give single pixels or small groups of them that lie micrometres off, at steep
slopes and specks of dirt. Their heights are not those of the surface, and one of them ends a film.
"""

import numpy as np
import scipy

from pyehl.errors import InputError
from pyehl.surfaces.holes import nearest
from pyehl.surfaces.levelling import level
from pyehl.types import Array

WINDOW = 5
"""Pixels per side of the median that a point is compared with."""

LINES = 64
"""Lines of a map that are looked at together."""

MAD_TO_SIGMA = 1.482602218505602
"""Standard deviation of a normal distribution over its median absolute deviation."""


def prominence(heights: Array) -> Array:
    """Distance (nx, ny) of each point from the median around it, over the spread of these.

    Not negative.

    The high-passed map is z minus the median of the 5 x 5 points around, after tilt and curvature
    are taken off (on a plane each point is the median of those around); its spread is its median
    absolute deviation times 1.4826, the standard deviation if it were normal, which spikes do not
    change. Of normal noise 6e-7 of all points lie beyond 5, 1e-15 beyond 8. Heights (nx, ny) [m],
    NaN where missing: 0 there. InputError if more than half of the map equals its median: then
    there is no spread to compare with.
    """
    missing = ~np.isfinite(heights)
    z = heights.copy()
    level(z, "curvature")
    z = nearest(z)
    largest = max(float(z.max()), -float(z.min()))
    above = np.empty(z.shape)
    for first in range(0, z.shape[0], LINES):
        # a few lines at a time, with those around that their medians need
        part = z[max(0, first - WINDOW) : first + LINES + WINDOW]
        inner = slice(first - max(0, first - WINDOW), None)
        median = scipy.ndimage.median_filter(part, WINDOW, mode="nearest")[inner][:LINES]
        np.abs(z[first : first + LINES] - median, out=above[first : first + LINES])
    del z
    spread = MAD_TO_SIGMA * float(np.median(above[~missing], overwrite_input=True))
    # what is left of a plane is rounding
    if not spread > 1e-12 * largest:
        raise InputError(
            "surface.outliers: half of the map or more is flat to the last digit, so that there "
            "is no spread to tell spikes by; remove them in the program of the instrument"
        )
    above /= spread
    above[missing] = 0.0
    return above
