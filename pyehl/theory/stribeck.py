# SPDX-License-Identifier: BSD-3-Clause
"""The Stribeck curve of harmonic roughness against theta_2.

Zhang, Biboulet, Venner & Lubrecht 2019, doi 10.1016/j.triboint.2019.01.028, eq. 16 and section
4.2. The curve is the ratio of rough to smooth friction of a Newtonian lubricant as the slide-to-
roll ratio vanishes; at practical sliding speeds shear thinning brings the ratio close to one.
"""

import numpy as np
from numpy.typing import ArrayLike

from pyehl.errors import InputError
from pyehl.theory.film import outside
from pyehl.types import Array

RANGE: dict[str, tuple[float, float]] = {
    "moes_m": (500.0, 2000.0),
    "moes_l": (5.0, 15.0),
    "wavelength": (0.25, 1.0),
    "film_over_amplitude": (1.0, 10.0),
}
"""Conditions over which eq. 16 was fitted: M, L, wavelength/a, H_c/A_i."""


def theta_2(
    moes_m: ArrayLike, moes_l: ArrayLike, wavelength: ArrayLike, film_over_amplitude: ArrayLike
) -> Array:
    """theta_2 = L^-1.1 M^0.33 (wavelength/a)^0.67 (H_c/A_i) [-], arguments broadcast together.

    InputError if an argument is not positive.
    """
    m, ell, lam, ratio = (
        np.asarray(v, dtype=float) for v in (moes_m, moes_l, wavelength, film_over_amplitude)
    )
    if not all(np.all(v > 0.0) for v in (m, ell, lam, ratio)):
        raise InputError("theta_2 needs positive M, L, wavelength and H_c/A_i")
    return np.asarray(ell**-1.1 * m**0.33 * lam**0.67 * ratio)


def relative_friction(theta: ArrayLike) -> Array:
    """mu_r/mu_s = 1 + 0.546 theta_2^-2 + 0.219 theta_2^-4 (eq. 16) [-].

    InputError if a theta_2 is not positive.
    """
    t = np.asarray(theta, dtype=float)
    if not np.all(t > 0.0):
        raise InputError("theta_2 must be positive")
    return np.asarray(1.0 + 0.546 * t**-2 + 0.219 * t**-4)


def in_range(
    moes_m: float, moes_l: float, wavelength: float, film_over_amplitude: float
) -> list[str]:
    """Return what lies outside the range of the fit, in words; an empty list when nothing does.

    Arguments as in `theta_2`.
    """
    values = (moes_m, moes_l, wavelength, film_over_amplitude)
    return list(outside(dict(zip(RANGE, values, strict=True)), RANGE))
