# SPDX-License-Identifier: BSD-3-Clause
"""Keys of a roller of finite length: its profile, and keys that it does not have."""

import math
from collections.abc import Iterator
from itertools import chain, pairwise

from pyehl.case.groups import Contact, Profile
from pyehl.case.key import short
from pyehl.case.settings import Draft
from pyehl.case.source import Source, read_text

SHAPE = "contact.shape = 'roller'"
NO_FLOODED_BORDER = (
    "'zero': the flow around the ends beyond the border is not known; the default domain is so "
    "long that P = 0 there has a small error"
)
COLUMNS = "y", "drop"
TABLE = "profile_file: lines 'y, drop' in m, y increasing from -length/2 to length/2"
KEYS_OF = {
    "none": (),
    "crown": ("crown_radius",),
    "logarithmic": ("log_amplitude",),
    "chamfer": ("chamfer_length", "chamfer_drop"),
    "file": ("profile_file", "profile_y", "profile_drop"),
}
"""Keys of each profile."""
BODIES = ("", "_2")
"""Suffixes of the keys of each body."""
KEYS = (
    *("length", "misalignment"),
    *(f"{k}{end}" for end in BODIES for k in ("profile", *chain(*KEYS_OF.values()))),
)
"""Keys of a roller."""
# Keys of other shapes
OTHERS = (
    *("moes_m", "moes_l", "radius_ratio", "radius_x", "radius_y", "angle"),
    *("load_per_length", "moes_m_line", "moes_l_line"),
)
# Maximum drop over the radius; minimum and maximum length over half the width of the line contact
DEEPEST = 0.1
LENGTHS = 4.0, 400.0
# Fraction of the length by which a table may end before the roller
ROUNDING = 1e-6


def unused(contact: Contact) -> Iterator[str]:
    """Keys of the profiles that the roller does not use."""
    for end in BODIES:
        own = getattr(contact, f"profile{end}")
        yield from (f"{k}{end}" for kind, keys in KEYS_OF.items() if kind != own for k in keys)


def complete(draft: Draft) -> None:
    """Read the table of a profile, unless its values are given.

    In a resolved case they count as given if the file is missing or has changed.
    """
    c = draft.settings.contact
    for end in BODIES:
        key = f"profile_file{end}"
        if not (c.is_roller and getattr(c, key)):
            continue
        name = draft.absolute(f"contact.{key}", getattr(c, key))
        setattr(c, key, name)
        if not draft.is_given("contact", f"profile_y{end}"):
            places, drops = _read_table(name)
            setattr(c, f"profile_y{end}", places)
            setattr(c, f"profile_drop{end}", drops)


def _read_table(name: str) -> tuple[tuple[float, ...], ...]:
    """Places and drops of a file [m]."""
    text = read_text(name, TABLE)
    source = Source(name, text.replace("\r", " ") + "\n")
    rows = []
    for first, line in source.rows():
        cells = line.split(",")
        if len(cells) != len(COLUMNS):
            source.refuse(first, first + len(line), f"{len(cells)} cells", TABLE)
        rows.append(
            [source.number(first, line, *pair) for pair in zip(COLUMNS, cells, strict=True)]
        )
    return tuple(tuple(row[k] for row in rows) for k in range(len(COLUMNS)))


def check_keys(draft: Draft) -> None:
    """Refuse a roller with missing keys, keys of other shapes, or unsupported options."""
    s, c = draft.settings, draft.settings.contact
    if not c.is_roller:
        name = draft.first_given(f"contact.{key}" for key in KEYS)
        if name:
            draft.refuse(name, f"{name} without {SHAPE}", SHAPE)
        return
    name = draft.first_given(f"contact.{key}" for key in OTHERS)
    if name:
        expected = "load, radius, length and the keys of a profile"
        draft.refuse(name, f"{name} with {SHAPE}", expected)
    if c.length <= 0.0:
        expected = "the length of the roller [m]"
        draft.refuse("contact.shape", f"{SHAPE} without contact.length", expected)
    for name in ("radius_y1", "radius_y2"):
        if getattr(s.bodies, name) != 0.0:
            what = f"bodies.{name} with {SHAPE}"
            draft.refuse(f"bodies.{name}", what, "contact.profile = 'crown' with crown_radius")
    _check_profile(draft)
    for name, allowed, expected in (
        ("surface.kind", s.surface.kind == "smooth", "'smooth' surfaces"),
        ("second_surface.kind", s.second_surface.kind == "smooth", "'smooth' surfaces"),
        ("inlet.position", max(s.inlet.position, s.inlet.position_hertz) <= 0.0, "a flooded inlet"),
        ("inlet.film", max(s.inlet.film, s.inlet.film_hertz) <= 0.0, "a flooded inlet"),
        ("lubricant.boundary_film", s.lubricant.boundary_film <= 0.0, "a full film"),
        ("grid.border", s.grid.border != "flooded", NO_FLOODED_BORDER),
        ("grid.y_extent", not draft.is_given("grid", "y_extent"), "none: half the length"),
        ("solver.coarsening", s.solver.coarsening != "alcouffe", "'auto' or 'classical'"),
    ):
        if not allowed:
            draft.refuse(name, f"{name} with {SHAPE}", expected)


def check_length(draft: Draft) -> None:
    """Refuse a roller that is too short for a line contact, or too long for a grid."""
    c = draft.settings.contact
    if not c.is_roller:
        return
    width = math.sqrt(8.0 * c.load / c.length * c.radius / (math.pi * c.reduced_modulus))
    if not LENGTHS[0] <= c.length / width <= LENGTHS[1]:
        what = f"contact.length is {short(c.length / width)} b, b = {short(width)} m"
        expected = (
            "4 to 400 b: longer ones are lines, contact.shape = 'line', except at their ends; "
            "shorter ones are points"
        )
        draft.refuse("contact.length", what, expected)


def _check_profile(draft: Draft) -> None:
    """Refuse profiles with a missing key, a key of another profile, or too large a total drop."""
    c = draft.settings.contact
    for number, end in enumerate(BODIES):
        _check_body(draft, c.of_body(number + 1), end)
    drop = _end_drop(c) + 0.5 * abs(c.misalignment) * c.length
    if drop > DEEPEST * c.radius:
        what = (
            f"the profile drops by {short(drop)} m at the end of the roller, misalignment included"
        )
        draft.refuse("contact.profile", what, "a tenth of the radius at most")


def _check_body(draft: Draft, own: Profile, end: str) -> None:
    """Refuse inconsistent keys of the profile of one body."""
    c, profile = draft.settings.contact, f"contact.profile{end}"
    for kind, keys in KEYS_OF.items():
        for key in keys:
            name = f"contact.{key}{end}"
            if kind != own.kind and name in draft.given:
                draft.refuse(name, f"{name} with {profile} = '{own.kind}'", f"{profile} = '{kind}'")
            if kind == own.kind and not getattr(c, f"{key}{end}") and key != "profile_file":
                missing = f"contact.profile_file{end}" if kind == "file" else name
                draft.refuse(profile, f"{profile} = '{kind}' without {missing}", missing)
    if own.chamfer_length > 0.5 * c.length:
        name = f"contact.chamfer_length{end}"
        expected = f"at most {short(0.5 * c.length)} m"
        draft.refuse(name, f"{name} is more than half of contact.length", expected)
    half = (0.5 - ROUNDING) * c.length
    if own.kind == "file" and (
        len(own.places) != len(own.drops)
        or any(b <= a for a, b in pairwise(own.places))
        or not own.places[0] <= -half < half <= own.places[-1]
    ):
        name = f"contact.profile_file{end}"
        draft.refuse(name, "the table does not cover the roller", TABLE)


def _end_drop(c: Contact) -> float:
    """Drop of both profiles together at the end of the roller [m].

    Of a table its largest value, of a logarithmic profile that at 99.8 % of half the length.
    """
    drops = 0.0
    for own in (c.of_body(1), c.of_body(2)):
        if own.kind == "crown":
            drops += c.length * c.length / (8.0 * own.crown_radius)
        elif own.kind == "chamfer":
            drops += own.chamfer_drop
        elif own.kind == "logarithmic":
            drops -= own.log_amplitude * math.log(1.0 - 0.998**2)
        else:
            drops += max((abs(drop) for drop in own.drops), default=0.0)
    return drops
