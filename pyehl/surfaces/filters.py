# SPDX-License-Identifier: BSD-3-Clause
"""The cut of the spectrum of a tile, by the compiled library: what the solver does, too."""

import math
from dataclasses import replace

import numpy as np

from pyehl.errors import InputError, check
from pyehl.extension import surface_functions
from pyehl.surfaces.tile import Topography


def filtered(
    topography: Topography,
    shortest_wavelength: float = 0.0,
    longest_wavelength: float = 0.0,
    kind: str = "sharp",
) -> Topography:
    r"""Cut the spectrum of a periodic tile at a shortest and a longest wavelength [m]; 0: none.

    As ISO 25178 has them, the S-filter and the L-filter; the wavelength of a component is 2
    pi/\|q\|, the mean height goes with `longest_wavelength`. ``"sharp"``: components between the
    cut-offs pass, those at them too, others do not; ``"gaussian"``: the areal Gaussian filters of
    ISO 16610-61, of which half of the amplitude passes at the cut-off: exp(-pi (alpha l_c/l)^2)
    for a shortest wavelength l_c, one less that for a longest, alpha = sqrt(ln 2/pi). InputError
    for a negative or infinite wavelength, a longest that is not above the shortest, or another
    kind.
    """
    for name, value in (("shortest", shortest_wavelength), ("longest", longest_wavelength)):
        if not (math.isfinite(value) and value >= 0.0):
            raise InputError(f"{name}_wavelength must not be negative [m], not {value!r}")
    if longest_wavelength and longest_wavelength <= shortest_wavelength:
        raise InputError(
            f"longest_wavelength = {longest_wavelength!r} m is not longer than "
            f"shortest_wavelength = {shortest_wavelength!r} m"
        )
    if kind not in ("sharp", "gaussian"):
        raise InputError(f"filter {kind!r}: expected 'sharp' or 'gaussian'")
    if not shortest_wavelength and not longest_wavelength:
        return topography
    z = np.array(topography.heights, dtype=np.float64, order="F")
    status, message = surface_functions.filter_tile(
        z,
        topography.length_x,
        topography.length_y,
        shortest_wavelength,
        longest_wavelength,
        int(kind == "gaussian"),
    )
    check(status, message)
    return replace(topography, heights=np.ascontiguousarray(z))
