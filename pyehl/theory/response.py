# SPDX-License-Identifier: BSD-3-Clause
"""Response of the inlet of a lubricated contact to one wave of roughness, to first order.

Roughness A Re exp(i(k(X - U T) + k_Y Y)), U its velocity over the mean velocity, reduces the film
by A Re T exp(i(...)): T is the complex ratio of deformed to undeformed amplitude, a function of the
wave and of the position. Lengths along the surface are scaled by the Hertz radius a, films by
a^2/R, pressures by p_h, times by a/u; k > 0.

Downstream of the inlet the film wave follows the transport equation of
:mod:`pyehl.theory.transport`.

The inlet transfer G = mu/rho at X = -0.8 on the centre line, with its phase referred to X = -1,
describes the effect of the inlet. For waves that are short compared with the inlet the transport
equation nearly gives it, B; the rest is a fit to the full simulation of this package: G = (1 - w +
w B) F, F = 1/(1 + z) apart from a phase, with a weight w that is 1 for short and 0 for long waves.
The limits are G = B for short and 0 for long waves. z is to first order a power law in the
wavelength parameter nabla_2 = (wavelength over a) sqrt(M/L) (Venner & Lubrecht 1999), and real for
ridges along the motion, which do not move. At low M L the inlet leaks: z has terms in 1/(M L), and
|F| changes with slip.

Away from the centre line the inlet is oblique. Along the normal of its edge it acts as on the
centre line: the wavevector is rotated by the angle of the normal, the velocity component along the
normal forms the film, and the gap is that of the pressure next to the edge. Translation along a
straight edge has no effect. None of this is fitted (docs/evidence/response, docs/evidence/ellipse).

For a shear-thinning lubricant, or slip beyond the range of the fit, G is that of a Newtonian
lubricant at the nearest velocity ratio of the fit, times the ratio of the solutions of the
linearised Reynolds equation for both (:mod:`pyehl.theory.inlet`). That ratio is not fitted.
"""

import json
import math
from collections.abc import Sequence
from functools import lru_cache
from importlib import resources
from typing import Any, cast

import numpy as np
from numpy.typing import ArrayLike

from pyehl.theory.inlet import interpolated_inlet
from pyehl.theory.transport import Zone, upstream
from pyehl.types import Array, Complex

GAIN = (0.0674, 0.3085, 2.414, 28.44)
"""Constants of `edge_gain`, fitted by docs/evidence/response/gain.py."""

SHORT = 3.0
"""nabla_2 at which the transport equation has the weight 1/2 in the inlet; other values work as
well (docs/evidence/response)."""
# Waves with a smaller weight are not integrated through the inlet
MIN_WEIGHT = 1e-4


def edge_gain(
    qx: ArrayLike, qy: ArrayLike, central_film: ArrayLike, constants: Sequence[float] | Array = GAIN
) -> Array:
    """Pressure of a wave at the centre of the contact over that on a half-space, K (1 - T) [-].

    From the full simulation: 1 for waves across the motion and for short ones, up to 1.04 for
    oblique waves and ridges along the motion, more in thicker films. Fitted to waves below 0.45 a
    on 513 x 513 nodes and M >= 200 in docs/evidence/response; the rms deviation at an operating
    point is at most 0.011, the largest deviation 0.05. It fails at M = 100, where the pressure
    waves are weak; for ridges of a/8 it is 2 % too low. For ellipses the pressure is computed
    (:mod:`pyehl.theory.transport`) and this factor is not used.

    Wavenumbers [1/a], H_c [a^2/R]. The constants are factor and exponent of the film, weight of
    oblique waves, |q| at which the effect fades [1/a].
    """
    kx, ky = np.asarray(qx, dtype=float), np.asarray(qy, dtype=float)
    q = np.hypot(kx, ky)
    across = np.square(ky / np.maximum(q, 1e-12))
    factor, power, weight, fading = constants
    film = factor * np.asarray(central_film, dtype=float) ** power
    fade = 1.0 + (q / fading) ** 2.5
    return np.asarray(1.0 + film * across * (1.0 + weight * (1.0 - across)) / fade)


@lru_cache(maxsize=1)
def stored_fit() -> dict[str, Any]:
    """Return the fitted coefficients of the inlet transfer."""
    text = resources.files("pyehl.theory").joinpath("response.json").read_text(encoding="utf-8")
    return cast("dict[str, Any]", json.loads(text))


def fitted_range() -> dict[str, list[float]]:
    """Return the range of moes_m, moes_l and velocity_ratio to which the response was fitted."""
    return cast("dict[str, list[float]]", stored_fit()["range"])


def inlet_transfer(
    zone: Zone,
    qx: ArrayLike,
    qy: ArrayLike,
    moes: tuple[float, float],
    velocity_ratio: float,
    y: ArrayLike = 0.0,
    spacing: float = 0.0,
) -> Complex:
    """G = mu/rho at the end of the inlet, with its phase referred to the edge of the contact [-].

    On the centre line the inlet ends at X = -0.8 and the edge is at X = -1; on a line at y
    [semi-axis], -1 < y < 1, their distance along the normal of the edge is the same. `zone` is the
    smooth contact on the centre line, `moes` M and L of the circular contact with the same inlet,
    `velocity_ratio` U; wavenumbers [1/a] have one shape, qx >= 0 (at qx = y = 0 G is real);
    `spacing` as in :func:`pyehl.theory.transport.transport`, not used for a line. The lines are the
    first dimensions of the result.
    """
    if np.isinf(zone.ellipticity):
        # there is no side flow: the equation is solved without the fit
        lines = np.asarray(y, dtype=float)
        made = interpolated_inlet(zone, qx, qy, velocity_ratio)
        return np.broadcast_to(made, lines.shape + made.shape).copy()
    # the Newtonian contact, at the nearest velocity ratio of the fit
    known, (low, high) = zone.newtonian or zone, fitted_range()["velocity_ratio"]
    known_ratio = min(max(velocity_ratio, low), high)
    base = inlet_base(known, qx, qy, moes, known_ratio, spacing)
    lines = np.asarray(y, dtype=float)
    fits = [inlet_fit(qx, qy, moes, known_ratio, line, zone.ellipticity) for line in lines.flat]
    result = base * np.reshape(fits, lines.shape + base.shape)
    if known is not zone or known_ratio != velocity_ratio:
        result *= interpolated_inlet(zone, qx, qy, velocity_ratio) / interpolated_inlet(
            known, qx, qy, known_ratio
        )
    return result


def inlet_base(
    zone: Zone,
    qx: ArrayLike,
    qy: ArrayLike,
    moes: tuple[float, float],
    velocity_ratio: float,
    spacing: float = 0.0,
) -> Complex:
    """1 - w + w B: the factor of G on the centre line from the transport equation [-].

    Parameters as in `inlet_transfer`.
    """
    kx, ky = np.asarray(qx, dtype=float), np.asarray(qy, dtype=float)
    weight = 1.0 / (1.0 + (_nabla_2(np.hypot(kx, ky), moes) / SHORT) ** 3)
    base = np.ones(kx.shape, dtype=complex)
    short = weight > MIN_WEIGHT
    made = upstream(zone, kx[short], ky[short], velocity_ratio, spacing)
    base[short] += weight[short] * (made - 1.0)
    return base


def inlet_fit(
    qx: ArrayLike,
    qy: ArrayLike,
    moes: tuple[float, float],
    velocity_ratio: float,
    y: float = 0.0,
    ellipticity: float = 1.0,
) -> Complex:
    """F = G/(1 - w + w B): the fitted factor of G [-].

    Parameters as in `inlet_transfer`; `ellipticity` is the semi-axis across the motion over a.
    """
    cosine, sine, sharpness = _normal(y, ellipticity)
    # M and L for the gap next to the edge and the velocity along the normal
    speed = cosine * math.sqrt(sharpness)
    moes_m, moes_l = moes[0] * sharpness**1.5 * speed**-0.75, moes[1] * speed**0.25
    moes = moes_m, moes_l
    fit = stored_fit()
    kx, ky = np.asarray(qx, dtype=float), np.asarray(qy, dtype=float)
    q = np.maximum(np.hypot(kx, ky), 1e-12)
    along = kx * cosine - ky * sine
    parameter = 0.5 * np.log(_nabla_2(q, moes))
    low, high = fit["parameter"]
    s = np.clip(parameter, low, high)
    c = np.abs(along) / q
    slip = velocity_ratio - 1.0
    # beyond the range, which is reported, the leakage is clipped like s
    leak = min(1.0, fit["leak"] / (moes_m * moes_l))
    numbers = math.log(moes_l / 10.0), 0.5 * math.log(moes_m / 1000.0), slip, leak
    arrays = _powers(s), _powers(c)
    modulus, turning, origin, growth = (
        _polynomial(fit[name], arrays, numbers) for name in ("modulus", "angle", "origin", "growth")
    )
    log_z = modulus + 2.0 * fit["slope"] * (parameter - s)
    angle = c * turning
    # a wave that travels against the normal is the conjugate of one that travels along it
    turn = np.where(along < 0.0, -1.0, 1.0)
    # per unit length along the normal the roughness overtakes the lubricant by more
    shift = slip * (turn * kx * origin / cosine + 1j * c * growth)
    result = np.exp(1j * shift) / (1.0 + np.exp(log_z + 1j * angle))
    return np.asarray(np.where(turn < 0.0, np.conj(result), result))


def _normal(y: float, ellipticity: float) -> tuple[float, float, float]:
    """Cosine and sine of the normal of the edge at a line y [semi-axis], and its sharpness.

    The sharpness is the factor by which P^2 falls faster along the normal than on the centre line.
    """
    sharpness = math.hypot(math.sqrt(1.0 - y * y), y / ellipticity)
    return math.sqrt(1.0 - y * y) / sharpness, y / (ellipticity * sharpness), sharpness


def _nabla_2(q: Array, moes: tuple[float, float]) -> Array:
    """Return nabla_2, the wavelength over a times sqrt(M/L)."""
    return 2.0 * np.pi / np.maximum(q, 1e-12) * math.sqrt(moes[0] / moes[1])


def _polynomial(
    terms: list[list[float]], arrays: tuple[Array, Array], numbers: tuple[float, ...]
) -> Array:
    """Sum of coefficient times powers of the variables; a term is [coefficient, power, ...].

    `arrays`: the :func:`_powers` of the first two variables; the others are `numbers`.
    """
    table = np.array(terms)
    coefficients, powers = table[:, 0], table[:, 1:].astype(int)
    first, second = arrays
    factors = np.zeros((len(second), len(first)))
    products = coefficients * np.prod(np.asarray(numbers) ** powers[:, 2:], axis=1)
    np.add.at(factors, (powers[:, 1], powers[:, 0]), products)
    used = np.flatnonzero(factors.any(axis=1))
    parts = np.tensordot(factors[used], first, axes=1)
    return np.asarray((parts * second[used]).sum(axis=0))


def _powers(variable: Array) -> Array:
    """Return the powers 0 to 5 along the first dimension."""
    powers = np.empty((6, *variable.shape))
    powers[0] = 1.0
    for k in range(5):
        powers[k + 1] = powers[k] * variable
    return powers
