# SPDX-License-Identifier: BSD-3-Clause
"""What a result holds of each rough surface of a prediction, and the sum of two of them."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import numpy as np

from pyehl.prediction.contact import Response
from pyehl.prediction.relative_positions import SAME
from pyehl.prediction.spectrum import Spectrum
from pyehl.surfaces import MAX_PIXELS, Topography, resampled, shifted
from pyehl.types import Array

SECOND = "second_"
"""Before the names of what belongs to the second surface."""
MOST_TILES = 12
"""Tiles beside each other, along one way, that are added to those of the other surface, as many as
passages of a common period (:data:`pyehl.prediction.relative_positions.MOST_PASSAGES`)."""


def arrays(tile: Topography, response: Response, prefix: str = "") -> dict[str, Array]:
    """Coordinates (nx,), (ny,) [m], heights [m] and response (nx, ny) of a surface."""
    nx, ny = tile.shape
    found = {
        "x": np.arange(nx, dtype=float) * tile.pixel[0],
        "y": np.arange(ny, dtype=float) * tile.pixel[1],
        "surface": np.asfortranarray(tile.heights),
        "deformed": np.asfortranarray(response.deformed),
        "delta_p": np.asfortranarray(response.pressure),
    }
    return {prefix + name: values for name, values in found.items()}


def statistics(tile: Topography, response: Response, prefix: str = "") -> dict[str, Any]:
    """Numbers of a surface that a summary holds."""
    made = tile.preparation
    found = {
        "surface": tile.origin,
        "surface_preparation": made.record.summary if made else None,
        "seed": tile.seed,
        "pixels": list(tile.shape),
        "length_x_m": tile.length_x,
        "length_y_m": tile.length_y,
        "rms_height_m": tile.rms_height,
        "rms_deformed_m": float(np.std(response.deformed)),
        "rms_pressure_Pa": float(np.std(response.pressure)),
    }
    return {prefix + name: value for name, value in found.items()}


@dataclass(frozen=True, slots=True)
class Together:
    """The sum of two surfaces that move together."""

    tile: Topography  # undeformed
    deformed_rms: float  # [m]


def second_summary(
    tiles: Sequence[Topography],
    response: Response,
    velocity_ratio: float,
    together: Topography | None,
) -> dict[str, Any]:
    """Return what a summary holds of the second of two surfaces, and of both.

    `together`: their sum where they move so.
    """
    slopes = [_slope(tile) for tile in tiles]
    return {
        "second_velocity_ratio": velocity_ratio,
        **statistics(tiles[1], response, SECOND),
        "surface_rms_m": composite_rms(tiles, together),
        "surface_slope": _slope(together) if together else math.hypot(*slopes),
        "surface_correlation": correlation(tiles[0], tiles[1], together),
    }


def findings_of(tiles: Sequence[Topography]) -> str | None:
    """Name what the maps have that is no roughness; None if there is nothing."""
    kinds = [
        finding.kind
        for tile in tiles
        if tile.preparation is not None
        for finding in tile.preparation.record.findings
    ]
    return ", ".join(dict.fromkeys(kinds)) or None


def composite_rms(tiles: Sequence[Topography], together: Topography | None = None) -> float:
    """Rms height [m] of one or two surfaces: of their sum where they move `together`.

    Else that of surfaces that have nothing in common, as in the mean over all positions.
    """
    if together is None and len(tiles) == 1:
        return tiles[0].rms_height
    return together.rms_height if together else math.hypot(*(tile.rms_height for tile in tiles))


def correlation(first: Topography, second: Topography, together: Topography | None) -> float:
    """Correlation of the heights of two surfaces that move `together`; NaN where they do not."""
    product = first.rms_height * second.rms_height
    if together is None or product == 0.0:
        return math.nan
    squares = first.rms_height**2 + second.rms_height**2
    return (together.rms_height**2 - squares) / (2.0 * product)


def _slope(tile: Topography) -> float:
    """Rms slope [-]."""
    waves = Spectrum.of(tile.heights, *tile.size)
    return math.sqrt(float((np.square(waves.q) * waves.power).sum()))


def sum_of(
    groups: Sequence[Mapping[str, Any]], tiles: Sequence[Topography], hertz_radius: float
) -> Topography | None:
    """Return the sum of the tiles of two groups of a case; None where they do not move together."""
    one, two = groups
    if float(one["velocity_ratio"]) != float(two["velocity_ratio"]):
        return None
    way = float(two["x_start"]) - float(one["x_start"])
    return merged(tiles[0], tiles[1], way * hertz_radius)


def merged(first: Topography, second: Topography, ahead: float) -> Topography | None:
    """Return a tile with the heights of two, the second one ahead by a way [m] along the motion.

    It holds whole tiles of both. None: not so few of both are as long, or they have too many
    pixels.
    """
    if ahead != 0.0:
        second = shifted(second, ahead)
    counts = [Fraction(b / a) for a, b in zip(first.size, second.size, strict=True)]
    counts = [ratio.limit_denominator(MOST_TILES) for ratio in counts]
    for ratio, a, b in zip(counts, first.size, second.size, strict=True):
        if ratio.numerator > MOST_TILES or not math.isclose(ratio * a, b, rel_tol=SAME):
            return None
    nx, ny = (
        max(ratio.numerator * m, ratio.denominator * n)
        for ratio, m, n in zip(counts, first.shape, second.shape, strict=True)
    )
    if nx * ny > MAX_PIXELS:
        return None
    first = _repeated(first, [ratio.numerator for ratio in counts])
    second = _repeated(second, [ratio.denominator for ratio in counts])
    heights = resampled(first, (nx, ny)).heights + resampled(second, (nx, ny)).heights
    return Topography(heights, first.size, f"{first.origin} and {second.origin}")


def _repeated(tile: Topography, times: Sequence[int]) -> Topography:
    """Return so many of a tile beside each other along x and y."""
    size = tile.length_x * times[0], tile.length_y * times[1]
    return replace(tile, heights=np.tile(tile.heights, times), size=size)
