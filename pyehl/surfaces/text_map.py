# SPDX-License-Identifier: BSD-3-Clause
"""Height maps as text: one x per line, tables under lines of words, lists of points."""

import re
from pathlib import Path

import numpy as np

from pyehl.errors import InputError
from pyehl.surfaces.arrays import Found, check_pixels, unit_of
from pyehl.surfaces.text_axes import OFF, Axes, without_axes
from pyehl.surfaces.text_header import OWN_PERIODIC, OWN_SIZE, Header, header_of
from pyehl.surfaces.text_table import BLANKS, Cells, Table, tables_of
from pyehl.types import Array

MAX_COLUMNS = 8
"""Maximum number of columns of a list of points."""


def is_list(rows: Array) -> bool:
    """Whether rows of three numbers (n, 3) are a list of points and not a map."""
    return rows.ndim == 2 and rows.shape[1] == 3 and rows.shape[0] > 3


def is_longer_list(path: Path, rows: Array) -> bool:
    """Whether rows of a few numbers are the x, y and z of points with further columns."""
    lines, columns = rows.shape
    if not (3 < columns <= MAX_COLUMNS and lines >= 4 * columns):
        return False
    try:
        heights, _ = grid_of(path, rows[:, :3])
    except InputError:
        return False
    return min(heights.shape) > 1 and heights.size <= 2 * lines


def are_pixel_numbers(points: Array) -> bool:
    """Whether x and y count pixels: whole numbers from 0 or 1 in steps of one."""
    for axis in (0, 1):
        places = np.unique(points[:, axis])
        if places[0] not in (0.0, 1.0) or not (np.diff(places) == 1.0).all():
            return False
    return True


def grid_of(path: Path, points: Array) -> tuple[Array, tuple[float, float]]:
    """Return heights (nx, ny) on the grid of points x, y, z (n, 3) in any order, and its steps.

    Lengths are in the unit of the points. Missing points are NaN. InputError if the points do not
    form a grid of equal steps, or a point occurs twice.
    """
    indices, shape, steps = [], [], []
    for axis, name in enumerate("xy"):
        places = points[:, axis]
        if not np.isfinite(places).all():
            row = int(np.argmin(np.isfinite(places)))
            raise InputError(f"{path}: point {row + 1} of the list has no {name}")
        gaps = np.diff(np.unique(places))
        # positions on one line differ by rounding
        gaps = gaps[gaps > OFF * gaps.max(initial=0.0)]
        if not gaps.size:
            raise InputError(f"{path}: all points of the list of x, y and z have the same {name}")
        # the span gives the step more accurately than the rounded positions
        span = float(np.ptp(places))
        step = span / round(span / float(np.median(gaps)))
        at = (places - places.min()) / step
        index = np.rint(at).astype(np.int64)
        worst = int(np.argmax(np.abs(at - index)))
        if abs(at[worst] - index[worst]) > OFF:
            raise InputError(
                f"{path}: point {worst + 1} of the list of x, y and z, {name} = {places[worst]:.6g}"
                f", is off the grid of steps of {step:.6g}; a map needs equal steps"
            )
        indices.append(index)
        shape.append(int(index.max()) + 1)
        steps.append(step)
    check_pixels(str(path), (shape[0], shape[1]))
    heights = np.full(shape, np.nan)
    flat = np.ravel_multi_index(indices, shape)
    first, count = np.unique(flat, return_counts=True)
    if first.size < flat.size:
        i, j = np.unravel_index(first[np.argmax(count)], shape)
        raise InputError(
            f"{path}: the place number {i + 1} along x, {j + 1} along y is in the list of x, y and "
            f"z {count.max()} times"
        )
    heights.ravel()[flat] = points[:, 2]
    return heights, (steps[0], steps[1])


MIN_PIXELS = 4
"""Minimum number of pixels of a map along x and along y."""
SQUARE = 0.01
"""Relative difference of the sides of a pixel above which it is reported."""


def read_text_map(path: Path, encoding: str, channel: str = "") -> Found:
    """Read the heights of a text, with the unit and the size that its header states.

    Without a header (except comments) a line has one x, as in arrays; under a header lines run
    along x, as in images. A first line and a first column of positions are the axes of the table,
    whose lines also run along x.

    InputError names the line and column of what cannot be read, and a header whose numbers of lines
    or points are wrong.
    """
    tables = tables_of(path, encoding)
    headers = [header_of(table.header) for table in tables]
    table, header = tables[0], headers[0]
    if channel or len(tables) > 1:
        table, header = _picked(path, tables, headers, channel)
    result = _found(path, table, header)
    for mark in header.marks:
        there = result.heights == mark
        if there.any():
            result.notes.append(
                f"{int(there.sum())} heights of {mark:.10g} are missing by the header"
            )
            result.heights[there] = np.nan
    result.channel = header.channel
    result.notes += header.notes
    if table.cells.words and np.isnan(result.heights).any():
        words = ", ".join(f"{word!r} {times} x" if word else f"{times} empty cells"
                          for word, times in table.cells.words.most_common(3))  # fmt: skip
        result.notes.append(f"missing points in the file: {words}")
    if table.footer:
        result.notes.append(
            f"{len(table.footer)} lines after the heights are no numbers and were not read: "
            f"{table.footer[0].strip()[:40]!r}"
        )
    return result


def _picked(
    path: Path, tables: list[Table], headers: list[Header], wanted: str
) -> tuple[Table, Header]:
    """Table of a channel by name or number; without a channel, the first one of heights.

    InputError if no header describes a table, or there is no such channel.
    """
    names = [header.channel or f"table {n}" for n, header in enumerate(headers, 1)]
    if not any(header.is_informative for header in headers):
        raise InputError(
            f"{path}: surface.channel = '{wanted}', but .npy and text hold one map alone"
        )
    if wanted:
        at = next((n for n, name in enumerate(names) if name == wanted), None)
        if at is None and wanted.isdigit() and 1 <= int(wanted) <= len(tables):
            at = int(wanted) - 1
        if at is None:
            listing = ", ".join(f"{n} '{name}'" for n, name in enumerate(names, 1))
            raise InputError(
                f"{path}: surface.channel = '{wanted}': there is no such channel\n"
                f"expected: one of the channels {listing}, by name or number"
            )
    else:
        at = next((n for n, header in enumerate(headers) if not header.is_other), 0)
    return tables[at], headers[at]


def _found(path: Path, table: Table, header: Header) -> Found:
    """Interpret the numbers of a table as heights."""
    if header.is_other:
        raise InputError(
            f"{path}: the values are not in a unit of length by the header; a map of heights was "
            "expected"
        )
    words = any(line.strip() and not line.strip().startswith("#") for line in table.header)
    rows, axes = _without_axes(path, table)
    more = ""
    if is_longer_list(path, rows):
        more = (
            f"the first three of {rows.shape[1]} columns are x, y and z, the others were not read"
        )
        rows = rows[:, :3]
    image = words or header.is_informative or axes is not None
    if is_list(rows):
        result = _points(path, rows, table, header)
        result.notes += [note for note in (axes.note if axes else "", more) if note]
        return result
    if not image:
        return _array(rows, table, header)
    turned = _check_points(path, table, rows, header)
    result = Found(np.ascontiguousarray(rows if turned else rows.T), header.height_unit)
    if turned:
        result.notes.append("by the points that its header states, the file has one x per line")
        axes = axes and axes.turned()
    _size(result, header, axes)
    return result


def _without_axes(path: Path, table: Table) -> tuple[Array, Axes | None]:
    try:
        return without_axes(table.rows, table.header, table.cells)
    except ValueError as error:
        raise InputError(f"{path}: {error}") from None


def matrix_map(path: Path, rows: Array) -> Found:
    """Interpret an array (nx, ny) without header: a map, perhaps with axes, or a list of points."""
    table = Table([], rows, 1, Cells(BLANKS))
    heights, axes = _without_axes(path, table)
    if is_list(heights) or is_longer_list(path, heights):
        return _points(path, heights[:, :3], table, Header())
    result = Found(heights, is_array=True)
    if axes is not None:
        _size(result, Header(), axes.turned())
    return result


def _array(rows: Array, table: Table, header: Header) -> Found:
    """Interpret a table with one x per line and without axes."""
    size: dict[str, float | None] = {"length_x": None, "length_y": None}
    result = Found(rows, header.height_unit, is_array=True)
    for line in table.header:
        if match := OWN_SIZE.match(line):
            size[match[1]] = float(match[2])
        result.is_periodic = result.is_periodic or bool(OWN_PERIODIC.match(line))
    result.size = size["length_x"], size["length_y"]
    return result


def _points(path: Path, rows: Array, table: Table, header: Header) -> Found:
    """Interpret a list of the x, y and z of points."""
    columns = header.columns or _units_of_columns(table)
    x, y, z = columns or (header.lateral_unit, header.lateral_unit, header.height_unit)
    known = x is not None and y is not None
    heights, steps = grid_of(path, rows)
    result = Found(heights, z, size_in_metres=known)
    whole = "" if len(rows) == heights.size else f" of the {heights.size} of its grid"
    result.notes.append(f"a list of {len(rows)} points{whole}")
    if x is not None and y is not None:
        result.size = heights.shape[0] * steps[0] * x, heights.shape[1] * steps[1] * y
    elif all(header.pitch):
        result.size = _pitched(heights.shape, header)
        result.size_in_metres = True
    elif are_pixel_numbers(rows):
        result.size_in_metres, result.ask_lateral_unit = False, True
        result.size = heights.shape[0] * steps[0], heights.shape[1] * steps[1]
        result.no_size = "x and y of its list are whole numbers, as those of pixels"
    else:
        result.size = heights.shape[0] * steps[0], heights.shape[1] * steps[1]
    return result


def _units_of_columns(table: Table) -> tuple[float, ...]:
    """Return the units of three columns [m] from a line above them; empty if it has none."""
    for line in reversed(table.header[-3:]):
        cells = [cell.strip() for cell in table.cells.split(line.lstrip("#"))]
        units = [_unit_at_end(cell) for cell in cells[:3]]
        if len(cells) == 3 and all(units):
            return tuple(unit for unit in units if unit)
    return ()


def _unit_at_end(cell: str) -> float | None:
    """Return the unit of a column heading [m]: 'X [mm]', 'x/mm', 'Z_um', 'mm'."""
    word = re.split(r"[\s/_(\[{,]+", cell.strip().rstrip(")]}"))[-1]
    return unit_of(word)


def _check_points(path: Path, table: Table, rows: Array, header: Header) -> bool:
    """Refuse a table whose numbers of lines and points differ from those of its header.

    Returns True if it has one x per line; in files of images x runs along the lines. Sorts lengths
    without a unit (`header.bare`) into numbers of points and sizes.
    """
    lines, columns = rows.shape
    for side, count in enumerate((columns, lines)):
        bare = header.bare[side]
        if bare is None or header.size[side] is not None:
            continue
        # a width without a unit may be a number of pixels
        if bare == count:
            header.points[side] = count
        elif header.lateral_unit is not None:
            header.size[side] = bare * header.lateral_unit
    # without a width, the height may be that of the surface
    if header.size[0] is None:
        header.size[1] = None
    x, y = header.points
    if (x is None or x == columns) and (y is None or y == lines):
        return False
    if (x, y) == (lines, columns):
        return True
    raise InputError(
        f"{path}:{table.line}: the table has {columns} heights in a line and {lines} lines, but "
        f"the header states {columns if x is None else x} x {lines if y is None else y}"
    )


def _pitched(shape: tuple[int, ...], header: Header) -> tuple[float | None, float | None]:
    x, y = (n * p if p else None for n, p in zip(shape, header.pitch, strict=True))
    return x, y


def _size(result: Found, header: Header, axes: Axes | None) -> None:
    """Set the size from the lengths or pixels of the header, else from the axes of the table."""
    shape = result.heights.shape
    pitched = _pitched(shape, header)
    x, y = (a or b for a, b in zip(header.size, pitched, strict=True))
    for side, (whole, part) in enumerate(zip(header.size, pitched, strict=True)):
        # a length may be measured from the first to the last point
        if whole and part and abs(whole - part) > 1.5 * part / shape[side]:
            result.notes.append(
                f"the header states a length of {whole:.6g} m along {'xy'[side]} and pixels of "
                f"{part / shape[side]:.6g} m, {part:.6g} m in all: the length was taken"
            )
    if x is None and y is None and axes is not None:
        result.notes.append(axes.note)
        if axes.steps is None:
            result.no_size = axes.note
            return
        x, y = (n * s if s else None for n, s in zip(shape, axes.steps, strict=True))
        if header.lateral_unit is None:
            result.size_in_metres = False
        else:
            x, y = (v and v * header.lateral_unit for v in (x, y))
    elif axes is not None:
        result.notes.append(axes.note)
    result.size = x, y
    if x and y and header.size[0] and not any(header.points) and not any(header.pitch):
        pixel = x / shape[0], y / shape[1]
        if abs(pixel[0] - pixel[1]) > SQUARE * min(pixel):
            result.notes.append(
                f"pixels of {pixel[0]:.6g} x {pixel[1]:.6g} m by the lengths of the header: if "
                "they should be square, lines or columns are missing in the file"
            )
