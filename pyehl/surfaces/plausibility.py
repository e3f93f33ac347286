# SPDX-License-Identifier: BSD-3-Clause
"""Detect implausible heights: marks of missing points, frequent values, steep slopes."""

import numpy as np
from numpy.typing import NDArray

from pyehl.types import Array

_MARKS = (999.0, 9999.0, 99999.0, 999999.0, 32767.0, 32768.0, 65535.0, 65534.0, 1000001.0,
          2147483640.0, 2147483647.0, 2147483648.0, 4294967295.0)  # fmt: skip
"""Numbers that programs write for a missing point, with either sign."""
HUGE, FAR = 1e30, 1e3
"""Implausible heights: at least HUGE in any unit, or FAR in metres."""
APART = 0.5
"""Minimum distance of a mark of missing points from all other heights, over their range."""
OFTEN, TIMES = 5, 8
"""A height is frequent if it occurs OFTEN times, and TIMES as often as any other value."""
RANGES = 2.0
"""Minimum distance of an isolated height from all others, over their range."""
STEEP = 1.0
"""Slope of 45 degrees."""
SAMPLE = 2**17
"""Number of heights, and of slopes, of a large map that are examined."""
LINES = 256
"""Number of lines of a map that are processed at a time."""
NORMAL = 0.6744897501960817
"""Median of the absolute value of a normal distribution, over its standard deviation."""


def unmarked(heights: Array, unit: float | None = None) -> list[str]:
    """Replace marks of missing points by NaN in heights as stored in the file, in place.

    `unit` is the unit of the heights [m], None if it is not known. Returns notes with the marks and
    their number. Infinite heights and those beyond HUGE or FAR are marks, and so is a number that
    programs write for a missing point if it is the smallest or the largest of all heights and far
    from the others.
    """
    notes = []
    infinite = np.isinf(heights)
    if infinite.any():
        heights[infinite] = np.nan
        notes.append(f"{int(infinite.sum())} infinite heights are missing points")
    limit = HUGE if unit is None else min(HUGE, FAR / unit)
    huge = np.abs(heights) >= limit
    if huge.any():
        heights[huge] = np.nan
        notes.append(f"{int(huge.sum())} heights beyond {limit:g} are marks of missing points")
    # up to two marks at each end
    for _ in range(4):
        mark = _mark(heights)
        if mark is None:
            break
        marked = heights == mark
        notes.append(f"{int(marked.sum())} heights of {mark:.10g} are marks of missing points")
        heights[marked] = np.nan
    return notes


def _mark(heights: Array) -> float | None:
    """Find a mark of missing points at one end of the heights; None if there is none."""
    for end in (float(np.fmin.reduce(heights, None)), float(np.fmax.reduce(heights, None))):
        if abs(end) not in _MARKS:
            continue
        others = heights[np.isfinite(heights) & (heights != end)]
        if others.size < 2:
            continue
        low, high = float(others.min()), float(others.max())
        if max(end - high, low - end) > APART * (high - low):
            return end
    return None


def doubts(heights: Array) -> list[str]:
    """Note values that may mark missing points because they are far more frequent than others.

    Only a sample of a large map is examined.
    """
    part = heights.ravel()[:: max(1, heights.size // SAMPLE)]
    values, counts = np.unique(part[np.isfinite(part)], return_counts=True)
    if values.size < 2 * OFTEN:
        return []
    notes = [_far_end(values, counts, end) for end in (0, -1)]
    ends = {0: "the smallest one", values.size - 1: "the largest one"}
    # both ends of the range of an instrument may occur
    for place in np.argsort(counts)[:-3:-1]:
        rest = np.delete(counts, [place, *ends]).max()
        if counts[place] < max(OFTEN, TIMES * rest) or counts[place] > part.size // 2:
            continue
        value, often = float(values[place]), int(np.count_nonzero(heights == values[place]))
        end = ends.get(int(place), "far more often than any other value")
        notes.append(
            f"{often} heights are exactly {value:.10g}, {end}: if it marks missing points, or the "
            "end of the range of the instrument, replace it by nan"
        )
    return [note for note in notes if note]


def _far_end(values: Array, counts: NDArray[np.signedinteger], end: int) -> str:
    """Note an extreme height that occurs at least twice and differs much from all others."""
    others = values[1:] if end == 0 else values[:-1]
    gap = float(np.abs(others - values[end]).min())
    if counts[end] < 2 or gap <= RANGES * float(np.ptp(others)):
        return ""
    return (
        f"heights of exactly {values[end]:.10g} differ by {gap:.6g} from all others: if they mark "
        "missing points, replace them by nan"
    )


def slopes(heights: Array, pixel: tuple[float, float]) -> tuple[float, float]:
    """Typical slope of a map (standard deviation from the median), and fraction of steep steps.

    Heights (nx, ny) [m], pixel size along x and y [m]. The typical slope of a large map is from
    evenly spaced lines.
    """
    usual, steep, count = 0.0, 0, 0
    for axis, size in enumerate(pixel):
        lines = np.moveaxis(heights, axis, 1)
        some = np.abs(np.diff(lines[:: max(1, heights.size // SAMPLE)], axis=1)) / size
        if np.isfinite(some).any():
            usual = max(usual, float(np.nanmedian(some)) / NORMAL)
        for first in range(0, lines.shape[0], LINES):
            steps = np.abs(np.diff(lines[first : first + LINES], axis=1))
            steep += int(np.count_nonzero(steps > STEEP * size))
            count += steps.size
    return usual, steep / count if count else 0.0
