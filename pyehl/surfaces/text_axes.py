# SPDX-License-Identifier: BSD-3-Clause
"""Detect and remove the axes of a table of heights: its first line and column."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from pyehl.surfaces.text_table import BadCellError, Cells
from pyehl.types import Array

MIN_PLACES = 5
# Deviation of positions from even steps that counts as rounding, over the step
OFF = 0.02
GROWING = 0.9
"""Minimum correlation of an axis with the number of the line."""
BEYOND = 10.0
"""Minimum range of a line that is an axis, over the range of all heights."""


@dataclass(frozen=True, slots=True)
class Axes:
    """Axes that were removed from a table."""

    # Steps along a line and from line to line, in the unit of the file; None for a missing axis.
    # None as a whole if the axes count pixels
    steps: tuple[float | None, float | None] | None
    note: str

    def turned(self) -> "Axes":
        """Return the axes of a table with one x per line."""
        return replace(self, steps=self.steps and (self.steps[1], self.steps[0]))


def is_axis(values: Array) -> bool:
    """Whether numbers increase, or decrease, in equal steps."""
    if values.size < MIN_PLACES or not np.isfinite(values).all():
        return False
    step = (values[-1] - values[0]) / (values.size - 1)
    line = values[0] + step * np.arange(values.size)
    return bool(step) and bool(np.abs(values - line).max() <= OFF * abs(step))


def _is_sorted(values: Array) -> bool:
    """Whether several numbers are monotonic."""
    steps = np.diff(values)
    return values.size >= MIN_PLACES and bool((steps > 0.0).all() or (steps < 0.0).all())


def _is_numbering(values: Array) -> bool:
    """Whether an axis counts pixels from 0 or 1."""
    return values[0] in (0.0, 1.0) and bool((np.diff(values) == 1.0).all())


def _grows(lines: Array) -> bool:
    """Whether the first number of each line is monotonic far beyond the range of all others."""
    if min(lines.shape) <= MIN_PLACES:
        return False
    first = lines[1:, 0]
    if not np.isfinite(first).all() or not np.ptp(first):
        return False
    # the correlation tolerates repeated or misplaced lines
    if abs(float(np.corrcoef(first, np.arange(first.size))[0, 1])) < GROWING:
        return False
    others = lines[1:, 1:]
    spread = float(np.fmax.reduce(others, None) - np.fmin.reduce(others, None))
    return bool(float(np.ptp(first)) > BEYOND * spread)


def without_axes(rows: Array, header: Sequence[str], cells: Cells) -> tuple[Array, Axes | None]:
    """Return the heights of a table without its axes, and the axes; None if it has none.

    Heights are never evenly spaced numbers while those of the next line are not: such a first line
    has the positions x, such a first column the positions y. A line of x with a word at its corner
    is the last line of the header. ValueError if the steps of an axis are not equal.
    """
    across = along = None
    heading = _heading(header[-1], cells, rows.shape[1]) if header else None
    if min(rows.shape) > MIN_PLACES:
        # a list of x, y and z may also have an index of the lines
        if is_axis(rows[1:, 0]) and not is_axis(rows[1:, 1]):
            across = rows[:, 0]
        if is_axis(rows[0, 1:]) and not is_axis(rows[1, 1:]):
            along = rows[0]
    elif rows.shape[1] == MIN_PLACES - 1 and is_axis(rows[:, 0]) and not is_axis(rows[:, 1]):
        return rows[:, 1:], Axes(None, "the first column numbers the lines")
    if along is None and across is not None and heading is not None and is_axis(heading):
        along = heading
    elif along is not None:
        rows = rows[1:]
        across = across[1:] if across is not None else None
    if along is not None:
        along = along[-(rows.shape[1] - (across is not None)) :]
    if across is not None:
        rows = rows[:, 1:]
    rounded = heading is not None and _is_sorted(heading) and _is_sorted(rows[:, 0])
    if across is None and (_grows(rows) or (rounded and not _is_sorted(rows[:, 1]))):
        name = "column"
    elif along is None and _grows(rows.T):
        name = "line"
    elif along is None and across is None:
        return rows, None
    else:
        return _rising(rows, along, across)
    raise ValueError(
        f"the first {name} increases or decreases like an axis, but not in equal steps: a map "
        "needs equal steps (positions with more digits), or a table of heights only"
    )


def _heading(line: str, cells: Cells, columns: int) -> Array | None:
    """Numbers of a line whose first cell is a word or missing; None if others are not numbers."""
    words = cells.split(line.lstrip("#"))
    if len(words) not in (columns, columns - 1):
        return None
    words = words[len(words) - columns + 1 :]
    try:
        return Cells(cells.separator).numbers(cells.separator.join(words))
    except BadCellError:
        return None


def _rising(rows: Array, along: Array | None, across: Array | None) -> tuple[Array, Axes]:
    """Return the heights in the order of increasing positions, with the steps."""
    result = [axis for axis in (along, across) if axis is not None]
    steps: list[float | None] = []
    for number, axis in ((1, along), (0, across)):
        if axis is None:
            steps.append(None)
            continue
        # the corner may be empty
        step = float((axis[-1] - axis[1]) / (axis.size - 2))
        if step < 0.0:
            rows = np.flip(rows, number)
        steps.append(abs(step))
    names = " and ".join(
        name for name, axis in (("line", along), ("column", across)) if axis is not None
    )
    if all(_is_numbering(axis) for axis in result):
        return rows, Axes(None, f"numbers of pixels, not heights: the first {names}")
    return rows, Axes((steps[0], steps[1]), f"positions, not heights: the first {names}")
