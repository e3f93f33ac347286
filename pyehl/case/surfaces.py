# SPDX-License-Identifier: BSD-3-Clause
"""The two surfaces of a case: defaults that follow from other keys, and what each kind needs."""

import math
import os
from collections.abc import Mapping
from typing import Any, NamedTuple

from pyehl.case.key import short
from pyehl.case.settings import Draft
from pyehl.case.surface_group import Surface

GROUPS = ("surface", "second_surface")
MAX_SEED = 2147483647
# Size of the tile of Table 1 of Zhang et al. 2019 [m]
FRACTAL_LENGTH = 8.29e-4
# Rq over Ra of normally distributed heights
RQ_OVER_RA = math.sqrt(0.5 * math.pi)
# Position X of the front of roughness that reaches the contact, and of one that has filled it [a],
# as in fortran/surface
X_MATTERS, X_FILLED = -1.25, 1.05
# Time in which the film made in the inlet passes the contact [a/u]
THROUGH = 2.0
# Keys of a fractal surface that other kinds refuse, and their values without an effect
FRACTAL_ALONE = {"finish": "none", "ra": 0.0, "rq": 0.0}
HEIGHT_MAP = "a height map: .npy, text or a file of an instrument"


class Finish(NamedTuple):
    """Typical Ra [m], Hurst exponent, wavelength of the roll-off [m], ratio of the lay."""

    ra: float
    hurst: float
    rolloff: float
    lay_ratio: float


# Ra within the ranges of ASME B46.1; profile spectra of ground surfaces decrease with the second
# power of the wavenumber (Whitehouse & Archard 1970, Proc. R. Soc. A 316, 97), of superfinished and
# polished ones faster (Persson et al. 2005, J. Phys. Condens. Matter 17, R1). The exponent of honed
# ones, lengths and lay are assumptions.
FINISHES = {
    "ground": Finish(0.4e-6, 0.5, 100.0e-6, 0.1),
    "honed": Finish(0.2e-6, 0.7, 60.0e-6, 5.0),
    "superfinished": Finish(0.05e-6, 0.8, 40.0e-6, 3.0),
    "polished": Finish(0.01e-6, 0.8, 50.0e-6, 1.0),
}


def without_fractal(group: str, values: Mapping[str, Any]) -> dict[str, Any]:
    """Give the options of a case that unset the keys of a fractal surface, for another kind.

    `values` are those of the group in a resolved case.
    """
    return {
        f"{group}.{key}": value
        for key, value in FRACTAL_ALONE.items()
        if values.get(key, value) != value
    }


def complete(draft: Draft) -> None:
    """Complete values that follow from other keys."""
    first, second = draft.settings.surface, draft.settings.second_surface
    for group, surface in zip(GROUPS, (first, second), strict=True):
        _complete_pattern(draft, group, surface)
    # two fractal surfaces of one seed are the same surface, whose waves add up
    if first.kind == second.kind == "fractal" and not draft.is_given("second_surface", "seed"):
        second.seed = first.seed + (1 if first.seed < MAX_SEED else -1)
    for group, one, other in ((GROUPS[0], first, second), (GROUPS[1], second, first)):
        # a feature arrives after the roughness of the other surface, with the film from its inlet,
        # has filled the contact
        if not draft.is_given(group, "x_start") and _waits(one, other):
            late = _latest_start(one, other) - one.velocity_ratio * THROUGH
            one.x_start = min(one.x_start, late)


def complete_finish(draft: Draft) -> None:
    """Complete finishes first: cells and domain depend on whether surfaces are smooth."""
    for group in GROUPS:
        _complete_finish(draft, group, getattr(draft.settings, group))


def _complete_finish(draft: Draft, group: str, surface: Surface) -> None:
    if surface.finish != "none":
        finish = FINISHES[surface.finish]
        if not draft.is_given(group, "kind"):
            surface.kind = "fractal"
        if surface.kind != "fractal":
            return
        typical = {
            "hurst": finish.hurst,
            "rolloff_wavenumber": 2.0 * math.pi / finish.rolloff,
            "lay_ratio": finish.lay_ratio,
            "rms_height": RQ_OVER_RA * finish.ra,
        }
        for key, value in typical.items():
            if not draft.is_given(group, key):
                setattr(surface, key, value)
    if draft.is_given(group, "rms_height"):
        return
    if surface.ra > 0.0:
        surface.rms_height = RQ_OVER_RA * surface.ra
    if surface.rq > 0.0:
        surface.rms_height = surface.rq


def _complete_pattern(draft: Draft, group: str, surface: Surface) -> None:
    if surface.kind == "fractal":
        surface.length_x = surface.length_x or FRACTAL_LENGTH
        surface.length_y = surface.length_y or FRACTAL_LENGTH
    if not draft.is_given(group, "wavelength_x"):
        surface.wavelength_x = surface.wavelength
    if not draft.is_given(group, "wavelength_y"):
        surface.wavelength_y = surface.wavelength
    if not draft.is_given(group, "x_start"):
        surface.x_start = draft.settings.grid.x_inlet
    surface.amplitude_given = draft.is_given(group, "amplitude")


def _waits(one: Surface, other: Surface) -> bool:
    """Whether one is a moving feature and the other moving roughness."""
    moves = one.velocity_ratio > 0.0 and other.velocity_ratio > 0.0
    return moves and one.is_feature and not other.is_feature and other.has_height


def _latest_start(one: Surface, other: Surface) -> float:
    """Start of a feature that reaches the contact when the other surface has filled it."""
    return X_MATTERS - one.velocity_ratio * (X_FILLED - other.x_start) / other.velocity_ratio


def check(draft: Draft) -> None:
    """Refuse surfaces that lack what their kinds need."""
    first, second = draft.settings.surface, draft.settings.second_surface
    for group, surface in zip(GROUPS, (first, second), strict=True):
        amplitudes = f"{group}.amplitude", f"{group}.amplitude_over_film"
        if surface.amplitude_given and amplitudes[1] in draft.given:
            draft.contradict(*amplitudes, "one of the two")
        _check_height(draft, group, surface)
        _check_feature(draft, group, surface)
        _check_filter(draft, group, surface)
        _check_map(draft, group, surface)
    for group, one, other in ((GROUPS[0], first, second), (GROUPS[1], second, first)):
        if _waits(one, other) and one.x_start > (latest := _latest_start(one, other)):
            what = (
                f"{group}.x_start = {short(one.x_start)}: the {one.kind} would enter before the "
                "roughness of the other surface fills the contact"
            )
            draft.refuse(f"{group}.x_start", what, f"at most {short(latest)}")


def _check_height(draft: Draft, group: str, surface: Surface) -> None:
    """Refuse two heights, and Ra, Rq or a finish of a surface that is not fractal."""
    rms = draft.is_given(group, "rms_height")
    has = {"rms_height": rms, "ra": surface.ra > 0.0, "rq": surface.rq > 0.0}
    names = [f"{group}.{key}" for key, there in has.items() if there]
    if len(names) > 1:
        draft.contradict(names[0], names[-1], "one of the two")
    beside = f"beside {group}.kind = '{surface.kind}'"
    fractal = f"{group}.kind = 'fractal'"
    if names and not rms and surface.kind != "fractal":
        draft.refuse(names[0], f"{names[0]} {beside}", f"{fractal}, or {group}.finish")
    if surface.finish != "none" and surface.kind != "fractal":
        draft.refuse(f"{group}.finish", f"{group}.finish {beside}", f"{fractal}, or no kind")


def _check_feature(draft: Draft, group: str, surface: Surface) -> None:
    """Refuse a spacing that does not apply, a size given twice or in metres without SI units.

    A moving feature must not start in the contact.
    """
    if surface.spacing_y > 0.0 and not (surface.is_feature and draft.settings.contact.is_line):
        key = f"{group}.spacing_y"
        what = f"{key} = {short(surface.spacing_y)}: no single feature repeats along Y"
        draft.refuse(key, what, "0, or a single feature on a line contact")
    if not surface.is_feature:
        return
    alternatives = (
        ("height_m", "amplitude"),
        ("height_m", "amplitude_over_film"),
        ("width_m", "width"),
        ("length_m", "length"),
    )
    for metric, other in alternatives:
        if getattr(surface, metric) <= 0.0:
            continue
        one, scaled = f"{group}.{metric}", f"{group}.{other}"
        if not draft.settings.contact.si:
            what = f"{one} is in metres, and the contact is given by its Moes numbers"
            draft.refuse(one, what, f"{scaled}, or a contact in SI units")
        if scaled in draft.given:
            draft.contradict(one, scaled, "one of the two")
    if surface.velocity_ratio > 0.0 and surface.x_start > X_MATTERS:
        what = (
            f"{group}.x_start = {short(surface.x_start)}: a {surface.kind} would begin inside the "
            "contact"
        )
        expected = f"at most {short(X_MATTERS)}, where its front end is at time 0"
        draft.refuse(f"{group}.x_start", what, expected)


def _check_filter(draft: Draft, group: str, surface: Surface) -> None:
    """Refuse a cut-off for a wave or a feature, or one that removes the whole spectrum."""
    shortest, longest = surface.shortest_wavelength, surface.longest_wavelength
    for key, limit in (("shortest_wavelength", shortest), ("longest_wavelength", longest)):
        if surface.is_feature:
            why = f"a {surface.kind} has a closed form"
        else:
            why = "a harmonic surface is a single wave"
        if limit > 0.0 and (surface.is_feature or surface.kind == "harmonic"):
            what = f"{group}.{key}: {why}, there is no spectrum to cut"
            draft.refuse(f"{group}.{key}", what, f"0, or {group}.kind = 'map' or 'fractal'")
    if 0.0 < longest <= shortest:
        what = (
            f"{group}.longest_wavelength = {short(longest)} m is not longer than "
            f"{group}.shortest_wavelength = {short(shortest)} m"
        )
        expected = "a longest wavelength above the shortest one, or 0"
        draft.refuse(f"{group}.longest_wavelength", what, expected)


def _check_map(draft: Draft, group: str, surface: Surface) -> None:
    """Refuse inconsistent keys of a map; make the name of its file absolute."""
    if surface.kind == "map" and not surface.file:
        what = f"{group}.kind = 'map' without {group}.file"
        draft.refuse(f"{group}.kind", what, f"file = '...', {HEIGHT_MAP}")
    if surface.sign == 0:
        draft.refuse(f"{group}.sign", f"{group}.sign = 0", "1 or -1")
    for axis in ("x", "y"):
        low, high = (getattr(surface, f"crop_{axis}_{end}") for end in ("min", "max"))
        if 0.0 < high <= low:
            key = f"{group}.crop_{axis}_max"
            what = f"{key} is not beyond crop_{axis}_min"
            draft.refuse(key, what, "a larger value [m], or 0 for the end of the map")
    if not surface.file:
        return
    name = f"{group}.file"
    surface.file = path = draft.absolute(name, surface.file)
    if surface.kind != "map":
        return
    if not os.path.exists(path):
        # the heights of a prepared tile are in memory, or in a file beside the results
        if surface.tile_x <= 0.0:
            draft.refuse(name, f"{name}: there is no file {path}", HEIGHT_MAP)
    elif not os.path.isfile(path):
        draft.refuse(name, f"{name}: {path} is a folder, a device or a pipe", HEIGHT_MAP)
