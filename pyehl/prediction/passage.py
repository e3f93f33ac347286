# SPDX-License-Identifier: BSD-3-Clause
"""The positions of a passage: their grid, their number, and what they leave undecided."""

import math
from typing import Protocol

import numpy as np

from pyehl.errors import InputError
from pyehl.prediction.options import MAX_POSITIONS
from pyehl.prediction.spectrum import Spectrum
from pyehl.surfaces import MAX_PIXELS, Topography, interpolated, resampled, track_offsets
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Array, Indices

# Fewest positions of an automatic passage
FIRST_POSITIONS = 8
POSITION_TOLERANCE = 2e-3
"""Error that half of the positions may make (relative) for no more to be added."""
# Positions at which least film and greatest rise of the pressure are looked for: at twice as
# many they differ by 1 % at most (docs/evidence/thinning)
EXTREMES = 32
# Pixels per semi-axis below which a coarse map is interpolated
RADIUS_PIXELS = 48


def working_grid(topography: Topography, operating: OperatingPoint, positions: int) -> Topography:
    """Return the tile on a grid that resolves the contact and has room for the positions.

    InputError if that takes too many pixels.
    """
    nx, ny = topography.shape
    finest = operating.hertz_radius / RADIUS_PIXELS, operating.semi_axis_y / RADIUS_PIXELS
    want_x = max(nx, math.ceil(topography.length_x / finest[0]))
    want_y = max(ny, math.ceil(topography.length_y / finest[1]))
    multiple = positions or FIRST_POSITIONS * 4
    want_x = multiple * math.ceil(want_x / multiple)
    if want_x * want_y > MAX_PIXELS:
        raise InputError(
            f"{topography.origin}: a tile of {topography.length_x:.3g} x "
            f"{topography.length_y:.3g} m would need {want_x} x {want_y} pixels to resolve a "
            f"contact of radius {operating.hertz_radius:.3g} m; cut a part out of it"
        )
    return resampled(topography, (want_x, want_y))


def _fewer_pixels(pixels: int, length: float, limit: float, semi_axis: float) -> int:
    """Pixels for waves below a limit [1/a] in a contact, as `short_mean` takes them.

    Of a tile of a length [a] that has so many, along a semi-axis of the contact [a].
    """
    if math.isinf(limit):
        return pixels
    highest = int(limit * length / (2.0 * math.pi))
    few = max(2 * highest + 2, math.ceil(RADIUS_PIXELS * length / semi_axis))
    few = FIRST_POSITIONS * math.ceil(few / FIRST_POSITIONS)
    return few if few < pixels else pixels


def longer_waves(
    spectrum: Spectrum, limit: float, ellipticity: float
) -> tuple[Spectrum, tuple[Indices, Indices]]:
    """Waves of a tile with |q| below a limit [1/a] on as few pixels as they need.

    And the rows and columns that are left of the spectrum.
    """
    axes = 1.0, ellipticity
    nx, ny = (
        _fewer_pixels(n, pixel * n, limit, axis)
        for n, pixel, axis in zip(spectrum.shape, spectrum.pixel, axes, strict=True)
    )
    index = spectrum.longest(nx, ny)
    part = spectrum.kept(index, (nx, ny))
    part.values[part.q >= limit] = 0.0
    return part, index


def tracks_of(
    surface: Topography, grid: Topography, stride: int, tracks: int
) -> list[tuple[float, int]]:
    """Offsets of tracks of a surface [m], and in pixels of its grid, multiples of the stride."""
    offsets = track_offsets(surface, tracks) if tracks else []
    return [(d, round(d / (stride * grid.pixel[1])) * stride) for d in offsets]


class HasFriction(Protocol):
    """A contact that tells its friction when the tile has moved by pixels along and across."""

    def friction(self, step: int, track: int = 0, /) -> float:
        """Friction over that of the smooth contact."""
        ...


def short_mean(contact: HasFriction, pixels: int, track: int = 0) -> float:
    """Mean of mu_r/mu_s over a few positions: of a track other than the first, or for a band."""
    steps = np.arange(FIRST_POSITIONS) * (pixels // FIRST_POSITIONS)
    return float(np.mean([contact.friction(int(s), track) for s in steps]))


def friction_along(
    contact: HasFriction, pixels: int, positions: int, largest: float = math.inf
) -> tuple[Indices, Array, float]:
    """Positions [pixels], ratios there and what they leave undecided at most (relative).

    No positions are added to a passage with a mean above `largest`.
    """
    n = positions or FIRST_POSITIONS
    steps = np.arange(n) * (pixels // n)
    ratios = np.array([contact.friction(int(s)) for s in steps])
    while np.all(np.isfinite(ratios)):
        error = _undecided(ratios)
        enough = error <= POSITION_TOLERANCE or float(ratios.mean()) > largest
        if positions or enough or pixels % (2 * n) or 2 * n > MAX_POSITIONS:
            return steps, ratios, error
        spacing = pixels // (2 * n)
        merged = np.empty(2 * n)
        merged[::2] = ratios
        merged[1::2] = [contact.friction(int(s)) for s in steps + spacing]
        n *= 2
        steps, ratios = np.arange(n) * spacing, merged
    return steps, ratios, math.nan


def meet_more(contact: HasFriction, pixels: int, steps: Indices) -> None:
    """Visit as many positions as the extremes need between those that the friction needed."""
    spacing = pixels // steps.size
    between = max(1, EXTREMES // steps.size)
    while spacing % between:
        between -= 1
    for part in range(1, between):
        for step in steps:
            contact.friction(int(step) + part * (spacing // between))


def _undecided(values: Array) -> float:
    """Return what half of the positions would have missed at the others, relative to the mean.

    The interpolant through every second value against the values between: an upper estimate of
    what all of them leave undecided, since the interpolant converges faster than any power.
    """
    if values.size % 2:
        return math.nan
    between = interpolated(values[::2], 2)[1::2]
    return float(np.abs(between - values[1::2]).max() / values.mean())
