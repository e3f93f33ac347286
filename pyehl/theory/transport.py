# SPDX-License-Identifier: BSD-3-Clause
"""Waves of film and pressure in the zone of high pressure: the linearised Reynolds equation.

Roughness A Re exp(i(k(X - U T) + k_Y Y)), U its velocity over the mean velocity, reduces the film
by A Re T exp(i(...)) and increases the pressure by A Re Pi exp(i(...)). All lengths along the
surface are scaled by the Hertz radius a, films by a^2/R, pressures by p_h, times by a/u; k > 0.

The half-space gives Pi = K (1 - T) + i K k/|q|^2 T', K = (pi/4)|q|, |q| = hypot(k, k_Y): to first
order the stiffness of a wave whose amplitude changes along the motion (`wave_pressure`: of the
wavenumber k U that it then has). In an elliptical contact K is `Zone.stiffness` times as much.
The mass in the film wave is mu = rho (T - c H Pi), c = d ln rho/dP, and with eps = rho
H^3/(eta lambda), delta ln eps = g = (c - d ln eta/dP) Pi - 3 T/H the Reynolds equation reads

    mu' = i k (U - 1) mu + eps |q|^2 Pi - i k eps' Pi - (eps' + 2 i k eps) Pi' - eps Pi''
          - eps P' (i k g + g'),

primes are d/dX; g (rho H)', the change of the smooth film along X, is neglected. The coefficients
change slowly, so that mu' = a mu + b with a = mu'/mu where no roughness drives. At high viscosity
eps vanishes: mu arises in the inlet and is then convected at the mean velocity as a wave of
wavenumber kU (Greenwood & Morales-Espejel 1994; Hooke 1999 to 2007); a part C/(1 + C), C = K H c,
moves with the roughness by compressibility. eps |q|^2 Pi, the leakage by viscous flow
(Morales-Espejel & Brizmer 2011), matters for short waves and low pressures; the terms after it, the
effect of the flow of the smooth contact on the wave, matter where the leakage is large. In the
inlet, where eps falls by orders of magnitude, the coefficients change slowly only for short waves:
`upstream`.

In a shear-thinning lubricant the flow is phi_x times as large along the motion and phi_y times
across (:mod:`pyehl.theory.shear`). Then eps |q|^2 becomes eps_t k^2 + eps_y k_Y^2 with eps_t =
-dq_x/d(P'), the terms with eps', Pi' and Pi'' have eps_t, eps P' becomes eps_x P', and in g = delta
ln eps_x the factor of Pi is c - (d ln eta/dP) (1 - d ln phi_x/d ln B) and that of -T/H is
3 - d ln phi_x/d ln B + d ln phi_x/d ln S.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from pyehl.theory.line_contact import AnyContact
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.shear import FlowFactors, flow_factors
from pyehl.types import Array, Complex

INLET = -0.8
"""Assumed beginning of the zone of high pressure on the centre line [a]."""

# Ends of the steps from P = 0, where the wave leaks freely, to INLET; short where the leakage falls
# below the slip. Halving them changes T of the fitted waves by 0.005 at small slip, by 0.017 at
# most, for a/32 at 20 % slip; the inlet was fitted with these steps
APPROACH = np.concatenate(
    [np.arange(-1.2, -1.06, 0.025), np.arange(-1.05, -0.91, 0.0125), np.arange(-0.9, -0.79, 0.025)]
)

# Largest step in X downstream of INLET [a]. Halving it changes T by 0.001 at small slip, by 0.008
# at most
STEP = 0.05
# Downstream of this X the pressure falls too fast for slowly changing coefficients: eps' and P' are
# zero
OUTLET = 0.6


@dataclass(frozen=True, slots=True)
class Zone:
    """The smooth contact on its centre line, and the properties of the lubricant there."""

    x: Array  # ascending [a], (n,)
    pressure: Array  # P [p_h]
    film: Array  # H [a^2/R]
    density: Array  # rho/rho0 [-]
    compressibility: Array  # d ln rho/dP [-]
    curvature: Array  # (d^2 rho/dP^2)/rho [-]
    thickening: Array  # d ln eta/dP [-]
    conductance: Array  # eps = rho H^3/(eta lambda) [-]
    stiffness: float = 1.0  # of waves, over that in a circular contact [-]
    factors: FlowFactors | None = None  # of a shear-thinning lubricant; None: Newtonian
    newtonian: Zone | None = None  # the contact with a Newtonian lubricant; None: this one
    ellipticity: float = 1.0  # semi-axis across the motion over a [-]


def zone_on(
    x: Array, pressure: Array, film: Array, operating: AnyContact, lubricant: Lubricant
) -> Zone:
    """Return the zone from X [a], P [p_h] and H [a^2/R] on the centre line, (n,) each."""
    step = 1e-3
    lower, p, higher = (
        (pressure + change) * operating.hertz_pressure for change in (-step, 0.0, step)
    )
    rho, eta = lubricant.density_ratio(p), lubricant.viscosity_ratio(p)
    denser, thinner = lubricant.density_ratio(higher), lubricant.density_ratio(lower)
    factors = None
    if lubricant.shear.in_flow:
        factors = _factors(film, np.gradient(pressure, x), eta, operating, lubricant)
    return Zone(
        x,
        pressure,
        film,
        rho,
        np.log(denser / rho) / step,
        (denser - 2.0 * rho + thinner) / (step**2 * rho),
        np.log(lubricant.viscosity_ratio(higher) / eta) / step,
        rho * film**3 / (eta * operating.speed_parameter),
        1.0 / operating.ellipse.kernel_ratio,
        factors,
        ellipticity=operating.ellipse.ellipticity,
    )


def _factors(
    film: Array, slope: Array, eta: Array, operating: AnyContact, lubricant: Lubricant
) -> FlowFactors:
    """Flow factors from H [a^2/R], dP/dX [p_h/a] and eta/eta0 [-], (n,) each."""
    shear = lubricant.shear
    h = film * operating.film_scale
    newtonian = eta * lubricant.viscosity * operating.sliding_speed / h
    gradient = h * slope * (operating.hertz_pressure / operating.hertz_radius)
    parts = gradient / shear.scale, 0.0 * gradient
    return flow_factors(shear.law, shear.carreau_exponent, newtonian / shear.scale, parts)


class Flow:
    """The smooth contact interpolated to positions (n,), for the coefficients of the equation."""

    def __init__(self, zone: Zone, places: Array) -> None:
        def at(values: Array) -> Array:
            return np.interp(places, zone.x, values)

        # in waves of large amplitude the conductance may underflow to 0
        logarithm = np.log(np.maximum(zone.conductance, np.finfo(float).tiny))
        inside = np.where((places >= zone.x[0]) & (places <= OUTLET), 1.0, 0.0)
        self.film, self.density = at(zone.film), at(zone.density)
        self.compressibility = at(zone.compressibility)
        f = zone.factors or _newtonian(zone.x)
        self.softening = at(zone.compressibility - zone.thickening * (1.0 - f.by_sliding))
        self.power = at(3.0 - f.by_sliding + f.by_gradient)
        self.across = np.exp(at(logarithm + np.log(f.across)))
        along = logarithm + np.log(f.tangent)
        self.along = np.exp(at(along))
        self.slope = inside * self.along * at(np.gradient(along, zone.x))
        flow = inside * np.exp(at(logarithm + np.log(f.along)))
        self.gradient = flow * at(np.gradient(zone.pressure, zone.x))


def _newtonian(x: Array) -> FlowFactors:
    """Flow factors of a Newtonian lubricant at positions (n,)."""
    one, none = np.ones_like(x), np.zeros_like(x)
    return FlowFactors(one, one, none, none, one)


class _Waves:
    """Waves (m,): T and dmu/dX, both linear in mu, at the positions of a flow."""

    def __init__(
        self, zone: Zone, qx: Array, qy: Array, velocity_ratio: float, spacing: float
    ) -> None:
        cells = 0.5 * spacing / np.pi
        along, across = np.sinc(cells * qx), np.sinc(cells * qy)
        squared = qx * qx + qy * qy
        # symbol of the discrete Laplacian of the pressure, and its part along X
        self.squared_along = np.square(along * qx)
        self.squared = self.squared_along + np.square(across * qy)
        self.k = zone.stiffness * stiffness(np.sqrt(squared)) / (along * across)
        self.turned = 1j * qx
        self.slip = self.turned * (velocity_ratio - 1.0)
        self.changing = self.turned * self.k / np.maximum(squared, 1e-24)

    def at(self, flow: Flow, i: int) -> tuple[Complex, Complex, Complex, Complex]:
        """Return a, b, t, s of mu' = a mu + b and T = t mu + s at position i."""
        e, h, rho, k = flow.along[i], flow.film[i], flow.density[i], self.k
        bulk = flow.compressibility[i] * h
        soft, slope, gradient = flow.softening[i], flow.slope[i], flow.gradient[i]
        leak = flow.across[i] * self.squared + (e - flow.across[i]) * self.squared_along
        by_pressure = leak - self.turned * (slope + soft * gradient)
        bending = flow.power[i] / h * gradient
        by_film = bending * self.turned
        by_change = -slope - (2.0 * e) * self.turned - soft * gradient
        factor = 1.0 / (1.0 + k * bulk)
        # first with constant amplitude, then with its change along X
        t, s = factor / rho + 0j, k * bulk * factor + 0j
        p, r = -k * t, k * factor + 0j
        for change in (self.changing, None):
            linear = 1.0 - by_change * p - bending * t
            constant = self.slip + by_pressure * p + by_film * t
            # e p a^2 + linear a = constant, the root constant/linear in the limit of small leakage
            root = 2.0 / (linear + np.sqrt(linear * linear + (4.0 * e) * p * constant))
            a = constant * root
            b = (by_pressure * r + by_film * s) * root
            if change is not None:
                growth, steady = change * (t * a), change * (t * b)
                t, s = factor * (1.0 / rho + bulk * growth), factor * (bulk * (k + steady))
                p, r = growth - k * t, steady + k - k * s
        return a, b, t, s


def stiffness(q: ArrayLike) -> Array:
    """K = (pi/4)|q|: pressure [p_h] per height of flattening [a^2/R] of a wave |q| [1/a].

    E'|q|/4 in the Hertz units of a circle (Johnson 1985, Contact Mechanics, section 13.2); for an
    ellipse divide by its kernel ratio.
    """
    return 0.25 * np.pi * np.asarray(q, dtype=float)


def free_stiffness(qx: ArrayLike, qy: ArrayLike, velocity_ratio: float) -> Array:
    """K of the free wave that roughness (qx, qy) causes; its wavenumber along X is qx U."""
    return stiffness(np.hypot(velocity_ratio * np.asarray(qx, dtype=float), qy))


def wave_pressure(
    qx: Array, qy: Array, velocity_ratio: float, driven: Complex, free: Complex
) -> Complex:
    """Pressure over roughness [p_h R/a^2]: flattened amplitude times stiffness of each part.

    For a circle. Wavenumbers of the roughness [1/a], U, driven and free parts of T [-].
    """
    k, k_free = stiffness(np.hypot(qx, qy)), free_stiffness(qx, qy, velocity_ratio)
    return np.asarray(k * (1.0 - driven) - k_free * free)


def upstream(
    zone: Zone, qx: Array, qy: Array, velocity_ratio: float, spacing: float = 0.0
) -> Complex:
    """Integrate the transport equation to INLET from where the wave follows the roughness.

    Returns mu/rho at INLET (m,), referred to X = -1 as a wave that does not leak [-], for waves
    (m,) [1/a], qx >= 0, that are short compared with the inlet: for longer ones the coefficients
    change too fast. `spacing` as in `transport`.
    """
    lengths = np.diff(APPROACH)
    flow = Flow(zone, APPROACH[:-1] + 0.5 * lengths)
    waves = _Waves(zone, qx, qy, velocity_ratio, spacing)
    # without leakage and slip any mu is a solution; take that of the undeformed wave
    mu = np.full(qx.shape, flow.density[0], dtype=complex)
    for i, h in enumerate(lengths):
        a, b, _, _ = waves.at(flow, i)
        if i == 0:
            np.divide(-b, a, out=mu, where=a != 0.0)
        growth, mean_growth = _growth(a * h)
        mu = mu * growth + (b * h) * mean_growth
    back = np.exp(-waves.slip * (INLET + 1.0))
    return np.asarray(mu * back / np.interp(INLET, zone.x, zone.density))


def _growth(t: Complex) -> tuple[Complex, Complex]:
    """exp(t) and (exp(t) - 1)/t; overwrites t where it is small."""
    growth = np.exp(t)
    still = np.abs(t) < 1e-6
    t[still] = 1.0
    mean_growth = (growth - 1.0) / t
    mean_growth[still] = 1.0
    return growth, mean_growth


def transport(
    zone: Zone, qx: Array, qy: Array, velocity_ratio: float, stations: Array, spacing: float = 0.0
) -> list[tuple[Complex, Complex]]:
    """Integrate the transport equation from the inlet to the stations, ascending X (n,) [a].

    At each station (driven, free), both (m,), with T = driven + free G exp(i qx (U - 1)(X + 1)),
    for wavenumbers (m,) [1/a], qx >= 0. `spacing` is the mesh size of a simulation to compare with
    [a]: with constant pressure on cells a wave is stiffer (its cosine averaged over a cell), and
    with finite differences it leaks less. 0: the continuous equations.
    """
    starts = np.concatenate([[INLET], stations[:-1]])
    steps = np.ceil((stations - starts) / STEP - 1e-9).astype(int)
    lengths = np.repeat((stations - starts) / steps, steps)
    middles = INLET + np.cumsum(lengths) - 0.5 * lengths
    flow, there = Flow(zone, middles), Flow(zone, stations)
    waves = _Waves(zone, qx, qy, velocity_ratio, spacing)
    free = np.full(qx.shape, np.interp(INLET, zone.x, zone.density), dtype=complex)
    driven = np.zeros(qx.shape, dtype=complex)
    ends = np.cumsum(steps)
    result = []
    for i, h in enumerate(lengths):
        a, b, _, _ = waves.at(flow, i)
        # exact for coefficients that are constant over the step
        growth, mean_growth = _growth(a * h)
        free *= growth
        driven = driven * growth + (b * h) * mean_growth
        for j in np.flatnonzero(ends == i + 1):
            _, _, t, s = waves.at(there, int(j))
            back = np.exp(-waves.slip * (stations[j] - INLET))
            result.append((t * driven + s, t * free * back))
    return result


LINES = np.array([-0.95, -0.8, -0.6, -0.3, 0.0, 0.3, 0.6, 0.8, 0.95])
"""Lines along the motion on which the free wave is computed [semi-axis], symmetric about the centre
line; between them it is interpolated."""

# Waves across the motion: period, distance at which they are zero [semi-axis], and number; the
# lines do not resolve wavelengths below half a semi-axis. In a contact 1.6 times as long as wide
# twice the period, or zero at 1.5 or 1.9, changes mu_r/mu_s by 0.004 % at most, half and twice as
# many waves by 0.014 and 0.065 %, a quarter of the samples by 1e-4 %
PERIOD, END, SHORTEST = 4.0, 1.7, 8
SAMPLES = 256


def harmonics(amplitudes: Complex) -> tuple[Array, Complex]:
    """Wavenumbers (n,) [1/semi-axis] and parts (n, ...) of amplitudes (lines, ...) on LINES."""
    y = PERIOD * (np.arange(SAMPLES) / SAMPLES - 0.5)
    places = np.concatenate([[-END, -1.0], LINES, [1.0, END]])
    held = np.pad(np.pad(np.eye(LINES.size), ((1, 1), (0, 0)), mode="edge"), ((1, 1), (0, 0)))
    hats = np.stack([np.interp(y, places, one) for one in held.T], axis=1)
    k = 2.0 * np.pi / PERIOD * np.arange(-SHORTEST, SHORTEST + 1, dtype=np.float64)
    parts = np.tensordot(np.exp(-1j * np.outer(k, y)) @ hats / SAMPLES, amplitudes, 1)
    return np.asarray(k, dtype=np.float64), np.asarray(parts, dtype=np.complex128)


def line_pressure(
    amplitudes: Complex, kx: Array, ky: Array, velocity_ratio: float, ellipticity: float
) -> Complex:
    """Pressure on LINES of film waves whose amplitude varies across the motion.

    In the units of a circle, for amplitudes (lines, ...) of free waves that roughness (kx, ky)
    [1/a] causes at a velocity ratio U. The sides of a narrow contact flatten a wave as long as its
    width more than the middle does. The amplitude is expanded in waves across the motion, each with
    its own stiffness. Beyond the contact it falls to zero; the values there have no physical
    meaning and :class:`pyehl.prediction.moving_tile.Edge` removes them. No constant is fitted.
    """
    here = free_stiffness(kx, ky, velocity_ratio)
    result = here * amplitudes
    for k, part in zip(*harmonics(amplitudes), strict=True):
        there = free_stiffness(kx, ky + k / ellipticity, velocity_ratio)
        result += np.multiply.outer(np.exp(1j * k * LINES), (there - here) * part)
    return np.asarray(result)
