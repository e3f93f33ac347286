# SPDX-License-Identifier: BSD-3-Clause
"""The response of a lubricated contact to one wave of roughness, to first order.

Roughness A Re exp(i(k(X - U T) + k_Y Y)), U its velocity over the mean velocity, thins the film by
A Re T exp(i(...)): T is the complex ratio of deformed to undeformed amplitude, a function of the
wave and of the place. All lengths along the surface are scaled by the Hertz radius a, films by
a^2/R, pressures by p_h, times by a/u; k > 0.

In the zone of high pressure the linearised Reynolds equation is one of transport. With the half-
space that makes a pressure K (1 - T) of a wave, K = (pi/4)|q| (|q| = hypot(k, k_Y)), the mass that
the film wave holds is mu = rho ((1 + C) T - C), C = K H d ln rho/dP, and along the motion

    d mu/dX = [i k (U - 1) - D] mu + D rho,    D = eps |q|^2 K/((1 + C) rho),

with eps = rho H^3/(eta lambda). For stiff lubricants D vanishes: mu is made in the inlet and then
carried at the mean velocity, a wave of wavenumber kU (Greenwood & Morales-Espejel 1994; Hooke 1999
to 2007), beside C/(1 + C), which compressibility leaves with the roughness. D, the leak by
viscous flow (Morales-Espejel & Brizmer 2011), matters for short waves and low pressures.

What the inlet makes is the inlet transfer G = mu/rho at X = -0.9 on the centre line, turned back to
X = -1. It is a fit to the full simulation of this package; its form 1/(1 + z) has the limits G = 1
for short and G = 0 for long waves, z is a power law in the wavelength parameter
nabla_2 = (wavelength over a) sqrt(M/L) to first order (Venner & Lubrecht 1999), and real for ridges
along the motion, which do not move. Away from the centre line the inlet is oblique and z grows.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import lru_cache
from importlib import resources
from typing import Any, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["INLET", "Zone", "edge_gain", "fitted_range", "inlet_transfer", "stiffness", "transport"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

INLET = -0.9
"""Where the zone of high pressure is taken to begin, on the centre line [a]."""

# Largest change of X in the integration of the transport equation [a]
STEP = 0.025
# Smallest conductance whose logarithm is taken
LEAST = float(np.finfo(np.float64).tiny)


@dataclass(frozen=True, slots=True)
class Zone:
    """The smooth contact on its centre line, and what of the lubricant enters a wave.

    Attributes
    ----------
    x
        Ascending [a], (n,).
    film
        H [a^2/R].
    density
        rho/rho0 [-].
    compressibility
        d ln rho/dP [-].
    conductance
        eps = rho H^3/(eta lambda) [-].
    """

    x: Array
    film: Array
    density: Array
    compressibility: Array
    conductance: Array

    def at(self, x: ArrayLike) -> Zone:
        """Return the values at other places, linear in between."""
        places = np.asarray(x, dtype=float)
        return Zone(
            places,
            np.interp(places, self.x, self.film),
            np.interp(places, self.x, self.density),
            np.interp(places, self.x, self.compressibility),
            # where nothing flows any more the conductance underflows
            np.exp(np.interp(places, self.x, np.log(np.maximum(self.conductance, LEAST)))),
        )


def stiffness(q: ArrayLike) -> Array:
    """K = (pi/4)|q|: pressure [p_h] per height of flattening [a^2/R] of a wave |q| [1/a].

    E'|q|/4 in Hertz units (Johnson 1985, Contact Mechanics, section 13.2).
    """
    return 0.25 * np.pi * np.asarray(q, dtype=float)


def edge_gain(qx: ArrayLike, qy: ArrayLike, central_film: float) -> Array:
    """Pressure of a wave in the contact over that of the half-space, K (1 - T), at its centre [-].

    Measured in the full simulation: 1 for waves across the motion and for short ones, up to 1.04
    for oblique ones and ridges, more in thicker films. Its constants were set by hand on waves at
    (1000, 10), (500, 5), (2000, 15) and (200, 10). For waves below 0.45 a on 513 x 513 nodes and
    M >= 200 in docs/evidence/response the rms deviation of an operating point is 0.011 or less,
    the largest 0.05. At M = 100, where little pressure is left to measure, it is not right.

    Parameters
    ----------
    qx, qy
        Wavenumbers [1/a].
    central_film
        H_c [a^2/R].
    """
    kx, ky = np.asarray(qx, dtype=float), np.asarray(qy, dtype=float)
    q = np.hypot(kx, ky)
    across = np.square(ky / np.maximum(q, 1e-12))
    fade = 1.0 + (q / 33.0) ** 2.5
    return np.asarray(1.0 + 0.24 * central_film**0.65 * across * (1.9 - 0.9 * across) / fade)


@lru_cache(maxsize=1)
def _fit() -> dict[str, Any]:
    """Coefficients of the inlet transfer, as fitted."""
    text = resources.files("pyehl.theory").joinpath("response.json").read_text(encoding="utf-8")
    return cast("dict[str, Any]", json.loads(text))


def fitted_range() -> dict[str, list[float]]:
    """Least and largest moes_m, moes_l and velocity_ratio at which the response was measured."""
    return cast("dict[str, list[float]]", _fit()["range"])


def inlet_transfer(
    qx: ArrayLike,
    qy: ArrayLike,
    moes_m: float,
    moes_l: float,
    velocity_ratio: float,
    y: ArrayLike = 0.0,
) -> Complex:
    """G = mu/rho at X = -0.9, turned back to X = -1 [-].

    Parameters
    ----------
    qx, qy
        Wavenumbers [1/a] of the same shape, qx >= 0; at qx = 0 the value is real.
    moes_m, moes_l
        Moes numbers.
    velocity_ratio
        U.
    y
        Distance from the centre line [a]; broadcast with the wavenumbers.
    """
    fit = _fit()
    kx, ky = np.asarray(qx, dtype=float), np.abs(np.asarray(qy, dtype=float))
    q = np.maximum(np.hypot(kx, ky), 1e-12)
    parameter = 0.5 * np.log(2.0 * np.pi / q * np.sqrt(moes_m / moes_l))
    low, high = fit["parameter"]
    s = np.clip(parameter, low, high)
    c = kx / q
    variables = (s, c, np.log(moes_l / 10.0), 0.5 * np.log(moes_m / 1000.0), velocity_ratio - 1.0)
    log_z = _polynomial(fit["modulus"], variables) + 2.0 * fit["slope"] * (parameter - s)
    angle = c * _polynomial(fit["angle"], variables)
    shift = kx * (velocity_ratio - 1.0) * _polynomial(fit["origin"], variables)
    oblique = fit["oblique"] * np.square(y)
    return np.asarray(np.exp(1j * shift) / (1.0 + np.exp(log_z + oblique + 1j * angle)))


def _polynomial(terms: list[list[float]], variables: tuple[Array | float, ...]) -> Array:
    """Sum of coefficient times powers of the variables; a term is [coefficient, power, ...]."""
    first, second = (_powers(np.asarray(v, dtype=float)) for v in variables[:2])
    # the first two alone are arrays
    factors: dict[tuple[int, int], float] = {}
    for coefficient, i, j, *others in terms:
        factor = coefficient
        for value, power in zip(variables[2:], others, strict=True):
            factor *= float(value) ** power
        factors[int(i), int(j)] = factors.get((int(i), int(j)), 0.0) + factor
    total = np.zeros_like(first[0])
    for (i, j), factor in factors.items():
        total += factor * first[i] * second[j]
    return total


def _powers(variable: Array) -> list[Array]:
    """Powers 0 to 5."""
    powers = [np.ones_like(variable)]
    for _ in range(5):
        powers.append(powers[-1] * variable)
    return powers


def transport(
    zone: Zone,
    qx: Array,
    qy: Array,
    velocity_ratio: float,
    stations: Array,
    spacing: float = 0.0,
) -> list[tuple[Complex, Complex]]:
    """Integrate the transport equation from the inlet to the stations.

    Parameters
    ----------
    zone
        The smooth contact on the centre line.
    qx, qy
        Wavenumbers (m,) [1/a], qx >= 0.
    velocity_ratio
        U.
    stations
        Ascending X (n,) [a], behind INLET.
    spacing
        Of the grid of a simulation to compare with [a]: on cells of constant pressure a wave is
        stiffer by the mean of its cosine over a cell. 0: the half-space itself.

    Returns
    -------
    list of (driven, free)
        At each station T = driven + free G exp(i qx (U - 1)(X + 1)), both (m,).
    """
    q = np.hypot(qx, qy)
    cells = 0.5 * spacing / np.pi
    k = stiffness(q) / (np.sinc(cells * qx) * np.sinc(cells * qy))
    steps = np.ceil((stations - np.concatenate([[INLET], stations[:-1]])) / STEP).astype(int)
    ends = np.cumsum(steps)
    x = np.concatenate(
        [np.array([INLET])]
        + [
            np.linspace(start, end, n + 1)[1:]
            for start, end, n in zip([INLET, *stations[:-1]], stations, steps, strict=True)
        ]
    )
    nodes, middle = zone.at(x), zone.at(0.5 * (x[1:] + x[:-1]))
    slip = 1j * qx * (velocity_ratio - 1.0)
    cubed = q * q * k
    made = np.zeros(q.shape, dtype=complex)
    decay = np.zeros(q.shape)
    found = []
    lengths = np.repeat(np.diff([INLET, *stations]) / steps, steps)
    for i, h in enumerate(lengths):
        if i == 0 or h != lengths[i - 1]:
            turn = slip * h
            phase, still = np.exp(turn), np.abs(turn) < 1e-6
        stiff = 1.0 + k * (middle.film[i] * middle.compressibility[i])
        leak = cubed * (middle.conductance[i] / middle.density[i] * h) / stiff
        decay += leak
        # exact for coefficients that are constant over the step
        grown = np.exp(-leak) * phase
        rate = turn - leak
        small = still & (leak < 1e-6)
        rate[small] = 1.0
        share = (grown - 1.0) / rate
        share[small] = 1.0
        made = made * grown + (leak * middle.density[i]) * share
        if i + 1 in ends:
            rho = nodes.density[i + 1]
            c = k * nodes.film[i + 1] * nodes.compressibility[i + 1]
            free = np.exp(-decay) * nodes.density[0] / (rho * (1.0 + c))
            found.append(((c + made / rho) / (1.0 + c), free + 0j))
    return found
