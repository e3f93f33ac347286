# SPDX-License-Identifier: BSD-3-Clause
"""Profiles along a line from the files of stylus instruments.

ISO 5436-2 (Mahr .prf and others: records that end in EOR), and text with one column of heights, or
columns of positions and heights, under header lines that may name units, spacing or the number of
points: Mountains, Dektak, Mitutoyo, spreadsheets.
"""

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from pyehl.errors import EhlError, FileError, InputError
from pyehl.surfaces.arrays import encoding_of, lines_of, mapped
from pyehl.types import Array

METRES = {
    "m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "μm": 1e-6, "micron": 1e-6,
    "microns": 1e-6, "nm": 1e-9, "å": 1e-10, "ang": 1e-10, "angstrom": 1e-10, "angstroms": 1e-10,
    "kå": 1e-7, "in": 0.0254, "inch": 0.0254, "uin": 2.54e-8, "µin": 2.54e-8,
}  # fmt: skip
UNIT = re.compile(
    r"(?<![A-Za-z])("
    + "|".join(sorted(map(re.escape, METRES), key=len, reverse=True))
    + r")(?![a-z])",
    re.IGNORECASE,
)
SPACING = re.compile(
    r"(pitch|spacing|increment|interval|step|sampling|auflösung|abstand|pas\b|dx\b|delta ?x)"
    r"\D*?(\d+(?:[.,]\d+)?(?:[eE][-+]?\d+)?)\s*[,;\t ]?\s*\(?\[?([A-Za-zµμÅå]*)",
    re.IGNORECASE,
)
MIN_POINTS = 32
MAX_COLUMNS = 3
"""An index, a position and a height."""

Read = tuple[Array, Array | float | None, tuple[float | None, float | None]]
"""Heights (n,), positions (n,) or spacing [m], and the units of positions and of heights [m]."""


def read_columns(path: Path, lines: Sequence[str]) -> Read:
    """Read columns of numbers under header lines; InputError if they are no profile."""
    comma = _decimal_comma(lines)
    rows = [row_of(line, comma=comma) for line in lines]
    sizes = [len(row) if row else 0 for row in rows]
    # the longest run of lines with equally many numbers
    best, start = (0, 0), 0
    for k in range(1, len(rows) + 1):
        if k == len(rows) or sizes[k] != sizes[start]:
            if sizes[start] and k - start > best[1] - best[0]:
                best = start, k
            start = k
    first, last = best
    if last - first < MIN_POINTS:
        raise InputError(f"{path}: no profile: no column of {MIN_POINTS} heights or more")
    after = [k for k in range(last, len(lines)) if lines[k].strip()]
    if any(sizes[k] for k in after):
        raise InputError(
            f"{path}: line {after[0] + 1} has {sizes[after[0]]} numbers, those above have "
            f"{sizes[first]}: a profile has as many on each line, and a height on each"
        )
    if sizes[first] > MAX_COLUMNS:
        raise InputError(f"{path}: no profile: {sizes[first]} columns of numbers")
    table = np.array(rows[first:last], dtype=float)
    if sizes[first] == MAX_COLUMNS and not np.all(np.diff(table[:, 0]) > 0.0):
        raise InputError(f"{path}: no profile: of three columns the first does not ascend")
    head = [line for line in lines[:first] if line.strip()]
    return _places(table, head, comma=comma)


def _decimal_comma(lines: Sequence[str]) -> bool:
    """Whether commas are decimal commas: more lines have them than have decimal points.

    Each of those lines has another separator, or a single comma.
    """
    number = re.compile(r"[-+]?\d+,\d+(?:[eE][-+]?\d+)?")
    with_comma = [line for line in lines if number.search(line)]
    others = sum(
        1 for line in with_comma if re.search(r"[;\t ]", line.strip()) or line.count(",") == 1
    )
    points = sum(1 for line in lines if re.search(r"\d\.\d", line))
    return len(with_comma) > points and others == len(with_comma)


def row_of(line: str, *, comma: bool) -> list[float] | None:
    """Return the numbers of a line; None if it has anything else, or is blank."""
    parts = re.split(r"[;\t ]+" if comma else r"[;,\t ]+", line.strip().strip(";,").strip())
    try:
        return [float((p.replace(",", ".") if comma else p).strip('"')) for p in parts]
    except ValueError:
        return None


def _places(table: Array, head: Sequence[str], *, comma: bool) -> Read:
    """Distinguish positions from heights, with the units that the header names."""
    columns, units = table.shape[1], _units(head, table.shape[1])
    if columns == 1:
        spacing, unit = _spacing(head, comma=comma)
        z_unit = next((u for u in reversed(units) if u), None)
        return (
            table[:, 0],
            None if spacing is None or unit is None else spacing * unit,
            (1.0, z_unit),
        )
    even = [_is_even(table[:, k]) for k in range(columns - 1)]
    # an index may precede the positions
    at = 1 if columns > 2 and even[0] and even[1] else 0
    if not even[at] and not np.all(np.diff(table[:, at]) > 0.0):
        at = -1
    z = table[:, at + 1]
    if at < 0:
        # the first column does not ascend: it has the heights
        return z, None, (None, units[0])
    return z, table[:, at], (units[at], units[at + 1])


def _is_even(x: Array) -> bool:
    steps = np.diff(x)
    mean = float(steps.mean())
    return mean > 0.0 and bool(np.all(steps > 0.0)) and float(np.ptp(steps)) < 0.5 * mean


def _units(head: Sequence[str], columns: int) -> list[float | None]:
    """Find the unit of each column in the header lines, the nearest line first."""
    for line in reversed(head):
        for between in (r"[;\t]|,(?!\d)|\s{2,}", r"\s+"):
            parts = [p for p in re.split(between, line.strip()) if p.strip()]
            result = [_unit(part) for part in parts]
            if len(parts) == columns and any(result):
                last = next(u for u in reversed(result) if u)
                return [u or last for u in result]
        words = [u for u in (_unit(word) for word in line.split()) if u]
        if len(words) == columns:
            return list(words)
        if len(words) == 1 and not SPACING.search(line):
            return [words[0]] * columns
    return [None] * columns


def _unit(text: str) -> float | None:
    """Find the unit in a text, preferably in brackets."""
    inside = re.search(r"[\[(]\s*([^\])]+?)\s*[\])]", text)
    match = (inside and UNIT.fullmatch(inside[1])) or UNIT.search(text)
    return METRES[match[1].lower()] if match else None


def _spacing(head: Sequence[str], *, comma: bool) -> tuple[float | None, float | None]:
    """Find the spacing of the points in the header, and its unit [m]."""
    for line in head:
        if match := SPACING.search(line):
            number = match[2].replace(",", ".") if comma or "." not in match[2] else match[2]
            return float(number), METRES.get(match[3].lower()) or _unit(line)
    return None, None


MAX_CHARACTERS = 256
"""Longest line of a profile [characters]; it has few numbers per line."""
MAX_SLOPE = 1.0
"""Rms slope above which the unit of positions or heights must be wrong."""
ROUNDING = 0.5
"""Largest distance of positions from even ones, over the spacing, that counts as rounding."""


@dataclass(frozen=True, slots=True)
class Profile:
    """A profile along a line."""

    heights: Array  # (n,) [m], equally spaced
    spacing: float  # [m]
    origin: str  # name of the file
    note: str = ""  # a remark on the units

    @property
    def length(self) -> float:
        """Length of the line [m]."""
        return self.spacing * self.heights.size


def read_profile(
    path: str | Path, length: float | None = None, height_unit: str | None = None
) -> Profile:
    """Read a profile.

    `length` [m] is needed if the file has none, and replaces that of the file; `height_unit`, a key
    of `METRES`, is needed, and used, only if the file names none.

    FileError if it cannot be opened; InputError if it is no profile, or a unit is missing or
    implausible.
    """
    path = Path(path)
    try:
        if path.suffix.lower() == ".npy":
            z = mapped(path)
            if z.ndim != 1:
                raise InputError(f"{path}: no profile: an array of shape {z.shape}")
            result: Read = np.asarray(z, dtype=float), None, (None, None)
        else:
            lines = [line for _, line in lines_of(path, encoding_of(path) or "latin-1")]
            result = (_iso if sum(map(_ends, lines)) >= 2 else read_columns)(path, lines)
    except EhlError:
        raise
    except OSError as error:
        raise FileError(f"{path}: cannot read: {error.strerror or error}") from error
    return _finished(path, *result, length, height_unit)


def is_profile(path: str | Path) -> bool:
    """Whether a file that is no map can be read as a profile, whatever its units."""
    path = Path(path)
    try:
        if path.suffix.lower() != ".npy" and not _may_be(path):
            return False
        # with any unit and length
        read_profile(path, 1.0, "nm")
    except (InputError, OSError, ValueError):
        return False
    return True


def _may_be(path: Path) -> bool:
    """Whether a text has a line of a profile: a quick test, because maps are large."""
    encoding = encoding_of(path)
    if encoding is None:
        return False
    short = (line for _, line in lines_of(path, encoding) if len(line) <= MAX_CHARACTERS)
    return any(_ends(line) or _has_few_numbers(line) for line in short)


def _ends(line: str) -> bool:
    """Whether a line ends a record of ISO 5436-2."""
    return line.strip().upper() == "EOR"


def _has_few_numbers(line: str) -> bool:
    rows = (row_of(line, comma=comma) for comma in (False, True))
    return any(row is not None and len(row) <= MAX_COLUMNS for row in rows)


def _iso(path: Path, lines: Sequence[str]) -> Read:
    """Read records of ISO 5436-2: axes, spacing, data."""
    ends = [k for k, line in enumerate(lines) if _ends(line)]
    axes: dict[str, tuple[str, int, float]] = {}
    spacing = None
    for line in lines[: ends[-1]]:
        words = line.split()
        if len(words) >= 5 and words[0].upper() in ("CX", "CZ"):
            unit = METRES.get(words[3].lower())
            if unit is None:
                raise InputError(f"{path}: unit '{words[3]}' of {words[0]}: expected MM, UM or NM")
            axes[words[0].upper()] = (
                words[1].upper(),
                int(_given(path, words[2], words[0])),
                unit * _given(path, words[4], words[0]),
            )
        if len(words) >= 3 and words[0].upper() == "SPACING":
            spacing = _given(path, words[2], words[0])
    if "CZ" not in axes:
        raise InputError(f"{path}: a file of ISO 5436-2 without an axis CZ: no profile")
    # the second EOR ends the header; the data follow, and a third EOR ends the file
    data = [word for line in lines[ends[1] + 1 :] for word in line.split()]
    numbers = np.array([_number_or_nan(word) for word in data if word.upper() != "EOR"])
    count = axes["CZ"][1]
    kind, _, x_factor = axes.get("CX", ("I", 0, 1e-3))
    places: Array | float | None = None
    if kind == "A" and numbers.size >= 2 * count:
        places, numbers = numbers[:count] * x_factor, numbers[count:]
    elif spacing is not None:
        places = spacing * x_factor
    if numbers.size < count:
        raise InputError(f"{path}: {numbers.size} heights where the head has {count}")
    return numbers[:count] * axes["CZ"][2], places, (1.0, 1.0)


def _given(path: Path, word: str, record: str) -> float:
    """Return the number of a record of the header."""
    number = _number_or_nan(word)
    if not math.isfinite(number):
        raise InputError(f"{path}: '{word}' in the record {record}: expected a number")
    return number


def _float(word: str) -> float:
    return float(word.replace("D", "E").replace("d", "e"))


def _number_or_nan(word: str) -> float:
    try:
        return _float(word)
    except ValueError:
        return float("nan")


def _finished(
    path: Path,
    z: Array,
    places: Array | float | None,
    units: tuple[float | None, float | None],
    length: float | None,
    height_unit: str | None,
) -> Profile:
    """Convert to equally spaced heights in metres; refuse implausible units."""
    if z.size < MIN_POINTS:
        raise InputError(f"{path}: {z.size} points: a profile has {MIN_POINTS} or more")
    if not np.isfinite(z).all():
        k = int(np.argmin(np.isfinite(z)))
        raise InputError(f"{path}: height {k + 1} of the profile is missing")
    note = []
    z_unit = units[1]
    if z_unit is None:
        if height_unit is None:
            raise InputError(
                f"{path}: the unit of the heights of the profile is not known\n"
                "expected: surface.height_unit = 'um', or another unit"
            )
        z_unit = METRES[height_unit]
        note.append(f"heights in {height_unit} by surface.height_unit")
    z = z * z_unit
    if length is not None:
        spacing = length / z.size
        note.append("its length by surface.length_x")
    elif places is None:
        raise InputError(
            f"{path}: the length of the profile is not known: it has one column\n"
            "expected: surface.length_x [m]"
        )
    elif isinstance(places, float):
        spacing = places
    else:
        x_unit = units[0] or z_unit
        z, spacing, moved = _spaced(path, places * x_unit, z)
        note += [moved] if moved else []
    if not spacing > 0.0:
        raise InputError(f"{path}: the spacing of the profile is {spacing:g} m")
    slope = float(np.sqrt(np.mean(np.square(np.diff(z))))) / spacing
    if slope > MAX_SLOPE:
        raise InputError(
            f"{path}: an rms slope of {slope:.3g} is implausible: are positions and heights in one "
            f"unit? Points are {spacing:.3g} m apart\nexpected: surface.length_x [m], and "
            "surface.height_unit where the file names no unit"
        )
    return Profile(z, float(spacing), str(path), ", ".join(note))


def _spaced(path: Path, x: Array, z: Array) -> tuple[Array, float, str]:
    """Return equally spaced heights, the spacing, and a note if they were interpolated."""
    steps = np.diff(x)
    if not np.all(steps > 0.0):
        k = int(np.argmin(steps > 0.0))
        raise InputError(f"{path}: the positions of the profile do not ascend after point {k + 1}")
    spacing = float((x[-1] - x[0]) / (x.size - 1))
    even = x[0] + spacing * np.arange(x.size)
    # positions are often rounded to few digits
    if float(np.abs(x - even).max()) <= ROUNDING * spacing and np.ptp(steps) < spacing:
        return z, spacing, ""
    return np.interp(even, x, z), spacing, "interpolated at equal distances"
