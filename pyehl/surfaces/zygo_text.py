# SPDX-License-Identifier: BSD-3-Clause
"""Text files of Zygo MetroPro and Mx: XYZ Data File Format 1, ASCII Data File Formats 1 and 2.

MetroPro Reference Guide OMP-0347, appendix on data formats. The module needs NumPy alone: it could
serve other packages that read surfaces, such as SurfaceTopography, as it is.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import islice

import numpy as np
from numpy.typing import NDArray

MAGIC = ("Zygo XYZ Data File", "Zygo ASCII Data File")
INVALID = 2147483640
"""Whole numbers from it on are no phases."""
RESOLUTION = {0: 4096, 1: 32768, 2: 131072}
"""Counts of phase in a wave, by PhaseRes."""
HEADER_LINES = 13


@dataclass(frozen=True)
class ZygoMap:
    """Heights of a Zygo text file."""

    # (nx, ny) [m], NaN where there are no data; x along the lines of the camera
    heights: NDArray[np.float64]
    # Side of a pixel [m]; 0: not calibrated
    pixel: float


def read_zygo(lines: Iterable[str]) -> ZygoMap:
    """Read a Zygo text file; ValueError says which line is not what it should be."""
    rest = iter(lines)
    header = [line.strip() for line in islice(rest, HEADER_LINES)]
    if len(header) < HEADER_LINES or not header[0].startswith(MAGIC):
        raise ValueError(f"the header of a Zygo text file has {HEADER_LINES} lines at least")
    is_list = header[0].startswith(MAGIC[0])
    left, top, width, height = (int(v) for v in _numbers(header, 4, 4))
    # heights are counts of phase times scale factor, wavelength and obliquity factor
    _, scale, wavelength, _, obliquity, _, pixel = _numbers(header, 8, 7)
    if min(width, height) < 1:
        raise ValueError(f"line 4: a phase map of {width} x {height} points")
    if is_list:
        heights = _listed(rest, (left, top), (width, height))
    else:
        resolution = int(_numbers(header, 11, 1)[0])
        if resolution not in RESOLUTION:
            raise ValueError(f"line 11: PhaseRes is {resolution}, not 0, 1 or 2")
        intensities = int(np.prod(_numbers(header, 3, 5)[2:5]))
        counts = _phases(rest, intensities, width * height)
        counts[counts >= INVALID] = np.nan
        factor = scale * wavelength * obliquity / RESOLUTION[resolution]
        heights = factor * counts.reshape(height, width).T
    return ZygoMap(np.ascontiguousarray(heights), pixel)


def _numbers(header: list[str], line: int, count: int) -> list[float]:
    """First numbers of a line of the header, counted from 1."""
    words = header[line - 1].split()[:count]
    try:
        values = [float(word) for word in words]
    except ValueError:
        values = []
    if len(values) < count:
        raise ValueError(f"line {line}: {count} numbers were expected, not {header[line - 1]!r}")
    return values


def _listed(
    rest: Iterable[str], corner: tuple[int, int], shape: tuple[int, int]
) -> NDArray[np.float64]:
    """Heights [m] of lines of column, row and micrometres, between two '#'."""
    heights = np.full(shape, np.nan)
    seen = 0
    begun = False
    for line in rest:
        words = line.split()
        if words == ["#"]:
            if begun:
                break
            begun = True
            continue
        if not words or not begun:
            continue
        try:
            i, j = int(words[0]) - corner[0], int(words[1]) - corner[1]
            value = np.nan if words[2].lower() == "no" else 1e-6 * float(words[2])
        except (ValueError, IndexError):
            raise ValueError(f"a point is {line.strip()[:40]!r}, not column, row, height") from None
        if not (0 <= i < shape[0] and 0 <= j < shape[1]):
            raise ValueError(
                f"the point {words[0]} {words[1]} is outside of the {shape[0]} x {shape[1]} points "
                "of line 4"
            )
        heights[i, j] = value
        seen += 1
    if seen != heights.size:
        raise ValueError(f"{seen} points, but line 4 says {shape[0]} x {shape[1]}")
    return heights


def _phases(rest: Iterable[str], intensities: int, phases: int) -> NDArray[np.float64]:
    """Read counts of phase: the block behind the intensities, each between two '#'."""
    blocks: list[list[str]] = []
    for line in rest:
        words = line.split()
        if words and words[0] == "#":
            blocks.append([])
        elif blocks:
            blocks[-1] += words
    # an end of file may follow the last '#'
    filled = [block for block in blocks if block]
    expected = [count for count in (intensities, phases) if count]
    lengths = [len(block) for block in filled]
    if lengths != expected:
        raise ValueError(f"blocks of {lengths} numbers, but lines 3 and 4 say {expected}")
    try:
        return np.array(filled[-1], dtype=float)
    except ValueError as error:
        raise ValueError(f"a phase is no number: {error}") from None
