# SPDX-License-Identifier: BSD-3-Clause
"""Interpret the lines above a table of heights: units, size, pixels."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, field

from pyehl.surfaces.arrays import UNIT, unit_of

_NUMBER = r"[-+]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:e[-+]?\d+)?"
_PER = r"(?:\s*(?:/|per)\s*(?:px|pix|pixels?|pts?|points?|samples?|digits?|画素))?"
_BRACKETS = re.compile(rf"[(\[{{]\s*({UNIT}){_PER}\s*[)\]}}]", re.IGNORECASE)
_ENTRY = re.compile(r"([^:：=,;\t]+?)\s*[:：=,;\t][:：=,;\t\s]*(.*)")
# 'Pixel size 1.5 um', separated only by blanks
_BLANKS = re.compile(
    rf"([^\W\d][^:=,;\t]*?)\s+({_NUMBER}\s*{UNIT}{_PER}|(?:(?<=unit )|(?<=units ))\s*{UNIT})",
    re.IGNORECASE,
)
_VALUE = re.compile(rf"({_NUMBER})[\s,;:\t]*({UNIT})?{_PER}[\s,;:\t]*", re.IGNORECASE)
# Latin letters, or others: XYキャリブレーション are two words
_WORDS = re.compile(r"[a-zÀ-ɏ]+|[^\W\d_a-zÀ-ɏ]+")
# 'heights in nm', 'z in um'
_IN = re.compile(rf"\b(?:heights?|z|values?|data)\b\W.*?\bin\s+({UNIT})(?![^\W_])", re.IGNORECASE)

# 'Height [um]' above a table, and a line with only its numbers of points
_HEADING = re.compile(
    rf"(?:heights?|z|values?|data|höhe)\s*[(\[]\s*({UNIT})\s*[)\]]", re.IGNORECASE
)
_CAMEL = re.compile(r"(?<=[a-z])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])")
_POINTS_ALONE = re.compile(r"\s*(\d+)\s+(\d+)\s*")

# Lines that pyehl itself writes above heights
OWN_SIZE = re.compile(r"^#\s*(length_[xy])\s*=\s*(\S+)\s*m\s*$")
OWN_PERIODIC = re.compile(r"^#\s*periodic\s*$")

# Words of the names of entries, in lower case; those of Gwyddion in all of its languages
_X = frozenset(
    "x dx nx width columns cols column horizontal samples spalten breite šířka anchura largeur "
    "larghezza largura ширина 幅 폭 横".split()
)
_Y = frozenset(
    "y dy ny height rows row lines line profiles vertical zeilen höhe výška altura hauteur altezza "
    "высота 高さ 높이 縦".split()
)
_SIZE = frozenset(
    "size length range extent field span dimension länge lange größe area width height breite höhe "
    "šířka výška anchura altura largeur hauteur larghezza altezza largura ширина высота 幅 高さ 폭 "
    "높이".split()
)
_PITCH = frozenset(
    "pitch step spacing increment calibration kalibrierung calibrage calibración sampling interval "
    "inc dx dy resolution auflösung schrittweite pixelabstand pixelsize pas paso "
    "キャリブレーション".split()
)
_POINTS = frozenset(
    "pixels pixel points point columns cols rows lines profiles samples number num count nx ny "
    "horizontal vertical zeilen spalten punkte 横 縦".split()
)
_UNITS = frozenset(
    "unit units einheit einheiten unité unités unità unidad unidades jednotky единицы unitxy unitz "
    "zunit xyunit xunit yunit".split()
)
_UNIT_PHRASES = ("値の単位", "값 단위", "単位", "단위")
_HEIGHTS = frozenset(
    "z height heights value values data valore valor hodnot höhe höhen zunit unitz wert werte "
    "hauteur измерения".split()
)
_LATERAL = frozenset("x y xy lateral laterals xunit yunit xyunit unitxy horizontal".split())
_CHANNEL = frozenset("channel kanál kanal canal canale канал チャネル 채널".split())
# Words of entries that do not describe the map
_OTHER = frozenset(
    "tip stylus radius filter cutoff wavelength offset origin position start min max minimum "
    "maximum aperture magnification speed average time date laser lens zoom roughness rms".split()
)
_MISSING = frozenset("nodata missing invalid undefined void bad ungültig".split())
_FACTOR = frozenset("factor scale faktor scaling gain multiplier skalierung".split())
# With these words a number without a unit may be a number of points
_NO_PITCH = frozenset(("resolution", "auflösung"))


@dataclass(slots=True)
class Header:
    """Contents of a header; None for what it does not state, or states in two ways."""

    size: list[float | None] = field(default_factory=lambda: [None, None])  # [m]
    pitch: list[float | None] = field(default_factory=lambda: [None, None])  # [m]
    # Lengths without a unit: sizes, or numbers of points
    bare: list[float | None] = field(default_factory=lambda: [None, None])
    points: list[int | None] = field(default_factory=lambda: [None, None])
    # Units of the heights, and of lengths and positions [m]
    height_unit: float | None = None
    lateral_unit: float | None = None
    # Units of the columns x, y and z of a list [m]
    columns: tuple[float, ...] = ()
    channel: str = ""
    # Numbers that mark missing heights
    marks: list[float] = field(default_factory=list)
    # Whether the unit of the heights is not one of length: volts, degrees
    is_other: bool = False
    # Whether only a comment names the unit: the file then still counts as an array
    by_comment: bool = False
    notes: list[str] = field(default_factory=list)

    @property
    def is_informative(self) -> bool:
        """Whether it contains more than a comment on the heights."""
        return bool(
            any(v is not None for v in (*self.size, *self.bare, *self.pitch, *self.points))
            or self.lateral_unit is not None
            or (self.height_unit is not None and not self.by_comment)
            or self.channel
            or self.columns
            or self.is_other
        )


@dataclass(slots=True)
class _Entry:
    """One line of a header: the words of its name, a number and a unit, if any."""

    words: set[str]
    number: float | None
    unit: float | None
    rest: str


def header_of(lines: Sequence[str]) -> Header:
    """Interpret the lines above a table."""
    header = Header()
    result: dict[tuple[str, int], set[float]] = {}
    if lines and (match := _POINTS_ALONE.fullmatch(lines[0])):
        header.points = [int(match[1]), int(match[2])]
    for line in lines:
        if OWN_SIZE.match(line):
            continue
        text = line.strip().lstrip("#;%/ ").replace('"', "").strip().rstrip(";,\t ")
        units = [unit_of(unit) for unit in _BRACKETS.findall(text)]
        if len(units) == 3:
            header.columns = tuple(unit for unit in units if unit is not None)
            continue
        if match := _HEADING.fullmatch(text):
            result.setdefault(("height", 0), set()).add(unit_of(match[1]) or 1.0)
            continue
        if match := _IN.search(text):
            header.height_unit = header.height_unit or unit_of(match[1])
            header.by_comment = True
            continue
        entry = _entry(text)
        if entry is not None:
            _sort(entry, header, result)
    _settle(header, result)
    return header


def _entry(text: str) -> _Entry | None:
    """Parse a line; None if it is no entry of a header."""
    match = _ENTRY.fullmatch(text) or _BLANKS.fullmatch(text)
    if match is None:
        return None
    name, rest = match[1], match[2].strip()
    units = _BRACKETS.findall(name)
    name = _BRACKETS.sub(" ", _CAMEL.sub(" ", name)).lower()
    words = set(_WORDS.findall(name))
    if any(phrase in name for phrase in _UNIT_PHRASES):
        words |= {"unit"}
    value = _VALUE.fullmatch(rest)
    if value is None:
        return _Entry(words, None, unit_of(rest), rest)
    # 'pixel_size_um: 1.5'
    bare = [word for word in words if len(word) > 1 and unit_of(word)]
    unit = value[2] or next(iter(units + bare), "")
    return _Entry(words, float(value[1].replace(",", ".")), unit_of(unit) if unit else None, rest)


def _sort(entry: _Entry, header: Header, result: dict[tuple[str, int], set[float]]) -> None:
    """Store the value of an entry according to the words of its name."""
    words = entry.words
    if words & _CHANNEL and entry.number is None:
        header.channel = entry.rest
        return
    if words & _MISSING and entry.number is not None:
        header.marks.append(entry.number)
        return
    if words & _OTHER:
        return
    if entry.number is None:
        if words & _UNITS or (entry.unit and (words <= _HEIGHTS or words <= _LATERAL)):
            _put_unit(entry, header, result)
        return
    if "z" in words or (words & _HEIGHTS and words & _FACTOR):
        factor = words & _FACTOR or (words & _PITCH and entry.unit is None)
        if factor and entry.number != 1.0:
            header.notes.append(
                f"the header has a line '{' '.join(sorted(words))}' of {entry.rest} that was not "
                "applied to the heights"
            )
        return
    sides = [side for side, names in enumerate((_X, _Y)) if words & names]
    if not sides or "xy" in words:
        sides = [0, 1]
    kind = _kind(entry)
    if kind and not (kind == "points" and len(sides) == 2):
        for side in sides:
            result.setdefault((kind, side), set()).add(entry.number * (entry.unit or 1.0))


def _kind(entry: _Entry) -> str:
    """Return what the number of an entry is, by its name; '' if it is unknown."""
    words, sides = entry.words, _X | _Y
    if words & _UNITS:
        return ""
    if entry.unit is not None and (words & _PITCH or ("pixel" in words and words & _SIZE)):
        return "pitch"
    if words & _SIZE and words & (sides | {"scan", "field", "lateral"}):
        return "size" if entry.unit is not None else "bare"
    if entry.unit is not None:
        return ""
    if (words & _PITCH) - _NO_PITCH and words & (sides | {"xy", "lateral", "pixel"}):
        return "bare pitch"
    return "points" if words & _POINTS and entry.number == int(entry.number or 0) else ""


def _put_unit(entry: _Entry, header: Header, result: dict[tuple[str, int], set[float]]) -> None:
    """Store the unit of heights, of lengths, or of both."""
    words = entry.words
    lateral = bool(words & _LATERAL)
    if entry.unit is None:
        is_height = bool(entry.rest) and words <= _UNITS | _HEIGHTS
        header.is_other = header.is_other or is_height
        return
    if not lateral:
        result.setdefault(("height", 0), set()).add(entry.unit)
    if lateral or not words & _HEIGHTS:
        result.setdefault(("lateral", 0), set()).add(entry.unit)


def _settle(header: Header, result: dict[tuple[str, int], set[float]]) -> None:
    """Accept the values that are stated unambiguously."""
    for (kind, side), values in list(result.items()):
        if len(values) > 1:
            header.notes.append(f"the header states two values of its {kind}: neither was used")
            del result[(kind, side)]

    def once(kind: str, side: int = 0) -> float | None:
        return next(iter(result.get((kind, side), ())), None)

    if header.height_unit is None or once("height"):
        header.height_unit, header.by_comment = once("height"), False
    header.lateral_unit = once("lateral")
    for side in (0, 1):
        header.size[side], header.pitch[side] = once("size", side), once("pitch", side)
        header.bare[side] = once("bare", side)
        number = once("bare pitch", side)
        if number is not None and header.pitch[side] is None and header.lateral_unit is not None:
            header.pitch[side] = number * header.lateral_unit
        points = once("points", side)
        if points is not None and header.points[side] is None:
            header.points[side] = int(points)
    # without a width, the height of an entry may be that of the surface
    if header.size[0] is None:
        header.size[1] = None
