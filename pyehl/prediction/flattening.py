# SPDX-License-Identifier: BSD-3-Clause
"""What a loaded contact makes of each wave of a surface: eqs 9 to 12.

Readings of the paper
---------------------
* Eq. 10 as printed multiplies the modulus of the component; the phase must be kept, else every
  surface would become a symmetric peak at the origin. The phase is kept here.
* Eqs 9 and 12 both print a factor 4/(Nx Ny); a transform and its inverse carry 1/(Nx Ny) once
  between them, and Parseval holds in m^2.
* The half-space resists a wave of wavenumber |q| by E'|q|/4 per height of flattening
  (``stiffness="exact"``). Eq. 11, pi E'/(sqrt 2 wavelength), is this very number for a
  cos cos pattern of that wavelength, whose |q| is 2 sqrt 2 pi/wavelength. Read with
  wavelength = 2 pi/|q| it is E'|q|/(2 sqrt 2), 41 % too stiff (``stiffness="paper"``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from pyehl.errors import InputError
from pyehl.prediction.options import Options
from pyehl.surfaces import Topography, wavenumbers
from pyehl.theory import amplitude
from pyehl.theory.operating import OperatingPoint

__all__ = ["Response", "response", "stiffness"]

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Response:
    """What a loaded contact makes of a rough tile, before it is anywhere in the contact."""

    pressure: Array  # delta p (nx, ny) [Pa], mean zero
    deformed: Array  # deformed roughness rr_d (nx, ny) [m], mean zero, peaks thin the film


def stiffness(qx: Array, qy: Array, reduced_modulus: float, kind: str = "exact") -> Array:
    """Pressure per height of flattening of a Fourier component [Pa/m], zero at q = 0.

    Wavenumbers [rad/m], broadcast together; E' [Pa]. ``"exact"``: E'|q|/4, the elastic half-space
    (Johnson 1985, Contact Mechanics, section 13.2); ``"paper"``: eq. 11 with wavelength 2 pi/|q|,
    sqrt 2 times as stiff. InputError if the kind is unknown.
    """
    q = np.hypot(qx, qy)
    if kind == "exact":
        return np.asarray(0.25 * reduced_modulus * q)
    if kind == "paper":
        return np.asarray(reduced_modulus * q / (2.0 * math.sqrt(2.0)))
    raise InputError(f"stiffness {kind!r}: expected 'exact' or 'paper'")


def response(
    topography: Topography, operating: OperatingPoint, options: Options | None = None
) -> Response:
    """Pressure and deformed roughness of a tile (nx, ny) (eqs 9 to 12).

    InputError if the conditions have no amplitude reduction (L = 0).
    """
    options = options or Options()
    qx, qy = wavenumbers(topography)
    ratio = amplitude.component_amplitude_ratio(
        qx,
        qy,
        operating.hertz_radius,
        operating.moes_m,
        operating.moes_l,
        convention=options.wavelength_convention,
    )
    component = scipy.fft.rfft2(topography.heights)
    # the mean height is no roughness: it is taken up by the rigid approach
    component[0, 0] = 0.0
    flattening = stiffness(qx, qy, operating.reduced_modulus, options.stiffness) * (1.0 - ratio)
    shape = topography.shape
    return Response(
        np.asarray(scipy.fft.irfft2(flattening * component, s=shape)),
        np.asarray(scipy.fft.irfft2(ratio * component, s=shape)),
    )
