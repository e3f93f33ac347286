# SPDX-License-Identifier: BSD-3-Clause
"""The surface that a resolved case asks for."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pyehl.surfaces.filters import filtered
from pyehl.surfaces.generators import fractal, harmonic
from pyehl.surfaces.maps import read_map
from pyehl.surfaces.tile import Topography
from pyehl.theory.operating import OperatingPoint

__all__ = ["from_settings", "harmonic_amplitude", "made_heights"]

# Least pixels per wavelength, and per Hertz radius, of a sampled harmonic pattern
HARMONIC_PIXELS = 32
RADIUS_PIXELS = 64


def harmonic_amplitude(
    settings: Mapping[str, Mapping[str, Any]], operating: OperatingPoint, film: float
) -> float:
    """Amplitude A_i [m] of the harmonic surface of a resolved case with a smooth film h_c [m]."""
    surface = settings["surface"]
    amplitude = surface.get("amplitude")
    if amplitude:
        return float(amplitude) * operating.film_scale
    return float(surface["amplitude_over_film"]) * film


def from_settings(
    settings: Mapping[str, Mapping[str, Any]], operating: OperatingPoint, film: float
) -> Topography:
    """Make or read the surface of a resolved case.

    Parameters
    ----------
    settings
        A resolved case; the group ``surface`` is read.
    operating
        Gives the scales of a harmonic pattern.
    film
        Central film h_c [m], of which the amplitude of a harmonic pattern may be a share.

    Raises
    ------
    ValueError
        If the surface is smooth or the map is not usable.
    OSError
        If the map cannot be opened.
    """
    surface = settings["surface"]
    kind = str(surface["kind"])
    if kind == "fractal":
        made = fractal(
            int(surface["pixels"]),
            float(surface["length_x"]),
            float(surface["length_y"]),
            rms_height=float(surface["rms_height"]),
            hurst=float(surface["hurst"]),
            rolloff_wavenumber=float(surface["rolloff_wavenumber"]),
            seed=int(surface["seed"]),
            modulus=str(surface["modulus"]),
        )
        return _cut(made, surface)
    if kind == "harmonic":
        shares = (float(surface["wavelength_x"]), float(surface["wavelength_y"]))
        # a long wave is sampled as finely as the contact needs, not only as it needs itself
        pixels = tuple(2 * math.ceil(max(HARMONIC_PIXELS, RADIUS_PIXELS * s) / 2) for s in shares)
        return harmonic(
            harmonic_amplitude(settings, operating, film),
            shares[0] * operating.hertz_radius,
            shares[1] * operating.hertz_radius,
            (pixels[0], pixels[1]),
        )
    if kind == "map":
        read = read_map(
            str(surface["file"]), float(surface["length_x"]), float(surface["length_y"])
        )
        return _cut(read, surface)
    raise ValueError(
        f"surface.kind = {kind!r} has no heights; expected 'harmonic', 'map' or 'fractal'"
    )


def _cut(topography: Topography, surface: Mapping[str, Any]) -> Topography:
    return filtered(
        topography,
        float(surface["shortest_wavelength"]),
        float(surface["longest_wavelength"]),
        str(surface["filter"]),
    )


def made_heights(settings: Mapping[str, Mapping[str, Any]]) -> NDArray[np.float64] | None:
    """Heights [m] that the solver needs from Python, shape (nx, ny); None where it needs none.

    The solver reads maps, makes harmonic patterns and fractal surfaces and cuts their spectra
    itself; only what it cannot read must come from here, before its spectrum is cut.
    """
    kinds = ("smooth", "harmonic", "fractal", "map")
    if settings["surface"]["kind"] in kinds:
        return None
    raise ValueError(f"surface.kind = {settings['surface']['kind']!r}: expected one of {kinds}")
