# SPDX-License-Identifier: BSD-3-Clause
"""A parameter of moving waves from the response of the contact, for comparison with theta_2.

To first order a wave of amplitude A changes the logarithm of the shear stress by A S cos cos with

    S = b K (1 - T) + T/H_c,    b = d ln eta/dP at the pressure of the centre,

the effects of the pressure and of the film of the wave; K (1 - T) and T are those of
:mod:`pyehl.theory.response` at X = Y = 0 and include slip, direction and nabla_2. The time mean of
the exponential is 1 + (A|S|)^2/4 times the mean of cos^2 across the contact. The friction is
distributed as a Gaussian of variance 1/b about the centre, with that mean (1 + exp(-2 k^2/b))/2. So

    theta_r = 1/(A |S| sqrt((1 + exp(-2 k^2/b))/2))

gives mu_r/mu_s = 1 + theta_r^-2/4 for small waves, with nothing fitted to friction.
"""

import numpy as np

from pyehl.case import Case
from pyehl.contact.smooth import solve_contact, zone_of
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.response import edge_gain, inlet_transfer
from pyehl.theory.transport import transport, wave_pressure
from pyehl.types import Array

SMALL_WAVES = 0.25
"""Coefficient of theta_r^-2 for small waves."""


def response_parameter(
    moes_m: Array, moes_l: Array, wavelength: Array, amplitude: Array, velocity_ratio: float
) -> Array:
    """Compute theta_r [-] of waves cos cos with equal wavelengths along X and Y.

    M, L, wavelength [a] and A_i [a^2/R], (n,) each. EhlError if a smooth contact does not
    converge.
    """
    result = np.empty(amplitude.shape)
    for m, ell in sorted(set(zip(moes_m.tolist(), moes_l.tolist(), strict=True))):
        here = (moes_m == m) & (moes_l == ell)
        result[here] = _of_contact(m, ell, wavelength[here], velocity_ratio) / amplitude[here]
    return result


def _of_contact(moes_m: float, moes_l: float, wavelength: Array, velocity_ratio: float) -> Array:
    """Compute theta_r times the amplitude, (n,) [a^2/R]."""
    text = f"&contact moes_m = {moes_m!r} moes_l = {moes_l!r} /\n"
    settings = Case.from_text(text, origin="response").resolve()
    point, oil = OperatingPoint.from_settings(settings), Lubricant.from_settings(settings)
    contact = solve_contact(settings)
    pressure = float(contact.at(np.zeros(1), np.zeros(1))[0][0, 0]) * point.hertz_pressure
    step = 1e-3
    ends = (pressure - step * point.hertz_pressure, pressure + step * point.hertz_pressure)
    low, high = (float(oil.log_viscosity_ratio(p)) for p in ends)
    thickening = (high - low) / (2.0 * step)
    k = 2.0 * np.pi / wavelength
    zone = zone_of(contact, point, oil)
    ((driven, free),) = transport(zone, k, k, velocity_ratio, np.array([0.0]))
    slip = np.exp(1j * k * (velocity_ratio - 1.0))
    convected = free * inlet_transfer(zone, k, k, (moes_m, moes_l), velocity_ratio) * slip
    t = driven + convected
    film = contact.central_film
    pressure_wave = wave_pressure(k, k, velocity_ratio, driven, convected) * edge_gain(k, k, film)
    across = np.sqrt(0.5 * (1.0 + np.exp(-2.0 * k * k / thickening)))
    return np.asarray(1.0 / (np.abs(thickening * pressure_wave + t / film) * across))
