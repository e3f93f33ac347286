# SPDX-License-Identifier: BSD-3-Clause
"""Amplitude reduction: how much of a waviness remains in a loaded EHL contact.

Venner & Lubrecht 1999 (Tribology Series 36, 151-162), eq. 6 there, as used by Zhang et al. 2019
(doi 10.1016/j.triboint.2019.01.028, eq. 10): with the wavelength parameter
x = f(r) (wavelength/a) sqrt(M/L) the deformed amplitude is A_d/A_i = 1/(1 + 0.15 x + 0.015 x^2),
where r = wavelength_x/wavelength_y and f = exp(1 - 1/r) for r > 1, else 1. Pure rolling.

The formula was fitted to cos(2 pi x/wavelength_x) cos(2 pi y/wavelength_y) patterns. A Fourier
component of a rough surface is a plane wave; its wavelength is defined in one of three ways:

``components`` (default)
    wavelength_x = 2 pi/|q_x| and wavelength_y = 2 pi/|q_y|: the shorter one, with f(r). A cos cos
    pattern is the sum of the plane waves (+-q_x, +-q_y), which deform alike because the contact is
    symmetric in y, so in the linear theory the formula holds for every component. It depends on
    the direction of the wave, as the rolling contact does. For ten rough surfaces it is slightly
    nearer to the full simulation than the other two, see :mod:`pyehl.prediction`.
``wavevector``
    2 pi/|q|, the distance between crests, f = 1. Agrees with the formula for waves with crests
    across the rolling direction.
``pattern``
    2 sqrt(2) pi/|q|, the wavelength of the isotropic cos cos pattern that has this |q|, f = 1.
    Agrees with the formula for such patterns.
"""

from typing import cast

import numpy as np
from numpy.typing import ArrayLike

from pyehl.errors import InputError
from pyehl.types import Array

CONVENTIONS = ("components", "wavevector", "pattern")
"""Definitions of the wavelength of a Fourier component, the default first."""


def anisotropy_factor(ratio: ArrayLike) -> Array:
    """f(r) for r = wavelength_x/wavelength_y >= 0, infinity allowed [-], any shape."""
    r = np.asarray(ratio, dtype=float)
    with np.errstate(divide="ignore"):
        return cast(Array, np.where(r > 1.0, np.exp(1.0 - 1.0 / np.maximum(r, 1.0)), 1.0))


def wavelength_parameter(
    wavelength: ArrayLike, moes_m: float, moes_l: float, ratio: ArrayLike = 1.0
) -> Array:
    """Wavelength parameter x = f(r) (wavelength/a) sqrt(M/L) [-], nabla_2 in the literature.

    `wavelength` is the shorter of the two over the Hertz radius a, `ratio` r = wavelength_x over
    wavelength_y. InputError if M or L is not positive: the theory is for piezoviscous contacts.
    """
    if not (moes_m > 0.0 and moes_l > 0.0):
        raise InputError(
            f"amplitude reduction needs positive Moes numbers, not M = {moes_m:g}, L = {moes_l:g}"
        )
    lam = np.asarray(wavelength, dtype=float)
    return cast(Array, anisotropy_factor(ratio) * lam * np.sqrt(moes_m / moes_l))


def amplitude_ratio(parameter: ArrayLike) -> Array:
    """A_d/A_i [-] for a wavelength parameter x >= 0 of any shape; 1 at 0, 0 at infinity."""
    x = np.asarray(parameter, dtype=float)
    return np.asarray(1.0 / (1.0 + 0.15 * x + 0.015 * x * x))


def component_wavelength(
    qx: ArrayLike, qy: ArrayLike, convention: str = "components"
) -> tuple[Array, Array]:
    """Wavelength [m] and ratio r [-] of the Fourier components with wavenumbers qx, qy [rad/m].

    The arguments are broadcast together; q = 0 has an infinite wavelength. InputError if the
    convention is unknown.
    """
    x, y = np.broadcast_arrays(np.abs(qx), np.abs(qy))
    x, y = x.astype(float), y.astype(float)
    with np.errstate(divide="ignore", invalid="ignore"):
        if convention == "wavevector":
            return cast(Array, 2.0 * np.pi / np.hypot(x, y)), np.ones_like(x)
        if convention == "pattern":
            return cast(Array, 2.0 * np.sqrt(2.0) * np.pi / np.hypot(x, y)), np.ones_like(x)
        if convention == "components":
            ratio = np.where((x == 0.0) & (y == 0.0), 1.0, y / x)
            return cast(Array, 2.0 * np.pi / np.maximum(x, y)), cast(Array, ratio)
    raise InputError(f"wavelength convention {convention!r}: expected one of {CONVENTIONS}")


def component_amplitude_ratio(
    qx: ArrayLike,
    qy: ArrayLike,
    hertz_radius: float,
    moes_m: float,
    moes_l: float,
    *,
    convention: str = "components",
) -> Array:
    """A_d/A_i in [0, 1] of the Fourier components of a point contact, 0 at q = 0.

    Wavenumbers qx, qy [rad/m] are broadcast together; `hertz_radius` in m; `convention` is one of
    :data:`CONVENTIONS`. InputError for another one, or if M or L is not positive.
    """
    wavelength, ratio = component_wavelength(qx, qy, convention)
    return amplitude_ratio(wavelength_parameter(wavelength / hertz_radius, moes_m, moes_l, ratio))
