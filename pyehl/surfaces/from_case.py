# SPDX-License-Identifier: BSD-3-Clause
"""Make or read the surface of a resolved case."""

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from pyehl.case.line import TRANSVERSE
from pyehl.case.surface_group import Surface as Keys
from pyehl.errors import FileError, InputError
from pyehl.surfaces.arrays import PREDICTION_COPIES, check_pixels
from pyehl.surfaces.prepare import prepare
from pyehl.surfaces.profile import scan_of_profile
from pyehl.surfaces.profile_file import Profile, is_profile, read_profile
from pyehl.surfaces.reading import Scan, read_scan
from pyehl.surfaces.tile import Topography, filtered, fractal, harmonic, shift_across
from pyehl.surfaces.working_map import NEUTRAL, Options
from pyehl.theory.line_contact import LineContact
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Settings

Contact = OperatingPoint | LineContact

GROUPS = ("surface", "second_surface")
"""Groups of a case that each describe a surface."""

FEWER = "fewer pixels: surface.pixels"
# Minimum number of pixels per wavelength, and per Hertz radius, of a sampled harmonic pattern
HARMONIC_PIXELS = 32
RADIUS_PIXELS = 64
# Largest tiles and maps that are cached [pixels]
CACHED_PIXELS = 2**20
# Keys that determine how a map is read, and those that determine a fractal tile
SCAN = "file length_x length_y channel height_unit lateral_unit profile pixels seed".split()
FRACTAL = (
    "pixels length_x length_y rms_height hurst rolloff_wavenumber lay_ratio seed modulus".split()
)


def rough_groups(settings: Settings) -> list[str]:
    """Name the groups of a resolved case that describe a rough surface.

    A wave or feature of zero height beside another surface is omitted, as in the solver.
    """
    rough = [name for name in GROUPS if settings.get(name, {}).get("kind", "smooth") != "smooth"]
    heights = ("amplitude", "amplitude_over_film", "height_m")
    high = [
        name
        for name in rough
        if settings[name]["kind"] in ("map", "fractal")
        or any(settings[name].get(height) for height in heights)
    ]
    return high or rough


def one_rough(settings: Settings) -> Settings:
    """Return the case with its surfaces exchanged if only ``second_surface`` is rough."""
    if rough_groups(settings) != ["second_surface"]:
        return settings
    return {
        **settings,
        "surface": settings["second_surface"],
        "second_surface": settings["surface"],
    }


def harmonic_amplitude(settings: Settings, operating: Contact, film: float) -> float:
    """Amplitude A_i [m] of the harmonic surface of a resolved case with a smooth film h_c [m]."""
    surface = settings["surface"]
    amplitude = surface.get("amplitude")
    if amplitude is not None:
        return float(amplitude) * operating.film_scale
    return float(surface["amplitude_over_film"]) * film


def from_settings(settings: Settings, operating: Contact, film: float) -> Topography:
    """Make or read the surface of a resolved case.

    `film` is the central film h_c [m], to which the amplitude of a harmonic pattern may be
    relative. InputError if the surface is smooth or a single feature, or the map is not usable;
    OSError if it cannot be opened.
    """
    return finished(whole(settings, operating, film), settings["surface"])


def whole(settings: Settings, operating: Contact, film: float) -> Topography:
    """Return the surface unfiltered and not shifted to its track; else as :func:`from_settings`."""
    surface = settings["surface"]
    kind = str(surface["kind"])
    if kind == "fractal":
        if int(surface["pixels"]) ** 2 > CACHED_PIXELS:
            return _fractal(surface)
        return _cached_fractal(*(surface[key] for key in FRACTAL))
    if kind == "harmonic":
        shares = (float(surface["wavelength_x"]), float(surface["wavelength_y"]))
        transverse = isinstance(operating, LineContact) and shares[1] >= TRANSVERSE
        if transverse:
            # a surface that is constant along a line may have any period along it
            shares = shares[0], shares[0]
        # a long wave is sampled as finely as the contact requires, too
        pixels = tuple(2 * math.ceil(max(HARMONIC_PIXELS, RADIUS_PIXELS * s) / 2) for s in shares)
        name = f"a wave of {shares[0]:g} x {shares[1]:g} a"
        size = (pixels[0], pixels[1])
        check_pixels(name, size, copies=PREDICTION_COPIES, remedy="shorter waves")
        tile = harmonic(
            harmonic_amplitude(settings, operating, film),
            shares[0] * operating.hertz_radius,
            shares[1] * operating.hertz_radius,
            (pixels[0], pixels[1]),
        )
        if not transverse:
            return tile
        return replace(tile, heights=np.repeat(tile.heights[:, :1], pixels[1], axis=1))
    if kind == "map":
        return _map(surface)
    raise InputError(
        f"surface.kind = {kind!r} is no tile of heights; expected 'harmonic', 'map', 'fractal'"
    )


def _map(surface: Mapping[str, Any]) -> Topography:
    """Tile of a map; unless the file is large it is cached until the file changes."""
    options = Options.from_settings(surface)
    try:
        state = Path(str(surface["file"])).stat()
    except OSError as error:
        raise FileError(f"{surface['file']}: cannot read: {error.strerror}") from error
    if state.st_size > 8 * CACHED_PIXELS:
        return tile_of(scan_of(surface), options)
    place = tuple((key, surface[key]) for key in SCAN if key in surface)
    place += (("detrend", options.detrend),)
    return _cached_map(place, state.st_mtime_ns, state.st_size, options)


@lru_cache(maxsize=4)
def _cached_map(
    place: tuple[tuple[str, Any], ...], changed: int, size: int, options: Options
) -> Topography:
    """Tile of a map, cached by the path and state of its file and its preparation."""
    return _read_only(tile_of(scan_of(dict(place)), options))


def _read_only(made: Topography) -> Topography:
    """Make the heights read-only: several cases share them."""
    made.heights.flags.writeable = False
    return made


@lru_cache(maxsize=4)
def _cached_fractal(*values: Any) -> Topography:  # noqa: ANN401
    return _fractal(dict(zip(FRACTAL, values, strict=True)))


def _fractal(surface: Mapping[str, Any]) -> Topography:
    pixels = int(surface["pixels"])
    check_pixels(
        f"surface.pixels = {pixels}", (pixels, pixels), copies=PREDICTION_COPIES, remedy=FEWER
    )
    # all keys but the pixels in front, and the seed and the modulus at the end
    numbers = {name: float(surface[name]) for name in FRACTAL[1:-2]}
    seed, modulus = int(surface["seed"]), str(surface["modulus"])
    return _read_only(fractal(pixels, **numbers, seed=seed, modulus=modulus))


def scan_of(surface: Mapping[str, Any]) -> Scan:
    """Read the map or profile of the group ``surface``; a length of 0 means that of the file.

    Exceptions as in `read_scan`, of a profile as in `scan_of_profile` and `read_profile`.
    """
    s = Keys.of(surface)
    path, lengths = s.file, (s.length_x or None, s.length_y or None)
    if s.profile != "none":
        made = profile_of(surface)
        return scan_of_profile(made, s.profile, detrend=s.detrend, pixels=s.pixels, seed=s.seed)
    try:
        return read_scan(path, *lengths, s.channel, s.height_unit, s.lateral_unit)
    except InputError as error:
        if not is_profile(path):
            raise
        raise InputError(
            f"{error}\nexpected: a map; this is a profile along a line, so "
            "surface.profile = 'isotropic' (a surface of its spectrum) or 'ridges' (it extended "
            f"across, as by a lay); 'pyehl surface {path}' shows its spectrum"
        ) from error


def profile_of(surface: Mapping[str, Any]) -> Profile:
    """Read the profile of the group ``surface``; a length of 0 means that of the file."""
    s = Keys.of(surface)
    # the default m of the key means not given: no profile has heights in m
    unit = s.height_unit if s.height_unit != "m" else None
    return read_profile(s.file, s.length_x or None, unit)


def tile_of(scan: Scan, options: Options = NEUTRAL) -> Topography:
    """Prepare a map (:func:`pyehl.surfaces.prepare.prepare`); the tile has the preparation."""
    made = prepare(scan, options)
    return Topography(made.tile, made.lengths, scan.origin, None, made)


def moved(tile: Topography, surface: Mapping[str, Any]) -> Topography:
    """Shift a tile so that its line at y = `surface.track` [m] passes the centre."""
    track = Keys.of(surface).track
    if not track:
        return tile
    heights = tile.heights.copy()
    shift_across(heights, tile.length_y, -track)
    return replace(tile, heights=heights)


def finished(tile: Topography, surface: Mapping[str, Any]) -> Topography:
    """Shift a tile to its track and filter it, as the group ``surface`` of a case specifies.

    The solver filters its surfaces itself.
    """
    s = Keys.of(surface)
    return moved(filtered(tile, s.shortest_wavelength, s.longest_wavelength, s.filter), surface)


def without_spikes(surface: Topography, threshold: float, group: Mapping[str, Any]) -> Topography:
    """Prepare the tile of a map again with a threshold of `surface.outliers`.

    InputError if it was not prepared from a map, or the preparation fails.
    """
    made = surface.preparation
    if made is None:
        raise InputError(f"{surface.origin}: not prepared from a map")
    return finished(tile_of(made.scan, replace(made.options, outliers=threshold)), group)


def track_offsets(surface: Topography, tracks: int) -> list[float]:
    """Return the distances of equally spaced tracks of a surface from the present one [m].

    They extend over the width of the tile; for a mirrored one over that of the map, whose mirror
    image repeats its tracks.
    """
    made = surface.preparation
    if made is None or made.options.edges != "mirror":
        return [k * surface.length_y / tracks for k in range(tracks)]
    return [(k + 0.5 - 0.5 * tracks) * made.measured_width / tracks for k in range(tracks)]
