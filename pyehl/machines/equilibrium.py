# SPDX-License-Identifier: BSD-3-Clause
"""Load of each rolling element, by equilibrium of a rigid ring.

Static: no centrifugal or gyroscopic loads, rings round and parallel. Balls after Jones 1960, J.
Basic Eng. 82, 309, with one stiffness for all of them; rollers as Harris & Kotzalas, *Essential
Concepts of Bearing Technology*, has them.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from pyehl.theory.ellipse import Ellipse
from pyehl.types import Array

BALL, ROLLER = 1.5, 10.0 / 9.0
"""Power of the approach in the load of an element."""
# Stiffness of a steel roller between two raceways, 35 948 N mm^(-10/9) l^(8/9) with l in mm
# (ISO/TS 16281:2008), E' = 206 GPa/(1 - 0.3^2)
ROLLER_STIFFNESS, STEEL = 35948.0 * 1e3 ** (10.0 / 9.0 + 8.0 / 9.0), 2.06e11 / 0.91


@dataclass(frozen=True, slots=True)
class Equilibrium:
    """A ring under its load; arrays have one number for each element.

    Attributes
    ----------
    radial, axial
        Displacement of the inner ring against the outer one from where both are concentric, and
        the grooves opposite to each other [m].
    loads
        Along the line of contact [N].
    angles
        Of contact [rad].
    """

    radial: float
    axial: float
    loads: Array
    angles: Array


def ball_stiffness(modulus: float, contacts: list[tuple[float, Ellipse]]) -> float:
    """K [N/m^1.5] of Q = K delta^1.5 for contacts in series, each with R_x [m] and its ellipse.

    Hertz: the approach is (a^2/R_x) k_b L_0 in the numbers of :class:`Ellipse`.
    """
    flexibility = 0.0
    for radius, shape in contacts:
        share = shape.kernel_ratio * shape.potential
        stiffness = 2.0 / 3.0 * modulus * shape.load_share * math.sqrt(radius) / share**1.5
        flexibility += stiffness ** (-2.0 / 3.0)
    return float(flexibility**-1.5)


def roller_stiffness(modulus: float, length: float) -> float:
    """K [N/m^(10/9)] of Q = K delta^(10/9) for a roller of a length [m] between two raceways.

    ISO/TS 16281:2008 for steel; as Q/(E' l^2) is a function of delta/l alone, K goes with E'.
    """
    return float(ROLLER_STIFFNESS * length ** (8.0 / 9.0) * modulus / STEEL)


def azimuths(count: int) -> Array:
    """Azimuths of elements [rad] (count,); the first one lies under the radial load."""
    return 2.0 * math.pi * np.arange(count) / count


def equilibrium(
    stiffness: float,
    power: float,
    count: int,
    clearance: float,
    load: tuple[float, float],
    centres: float = math.inf,
    angle: float = 0.0,
) -> Equilibrium:
    """Find the displacement of the ring at which its elements carry a radial and an axial load.

    Parameters
    ----------
    stiffness, power
        K [N/m^power] of Q = K delta^power.
    count
        Elements.
    clearance
        Diametral play [m].
    load
        Radial and axial load [N], neither negative.
    centres
        Distance of the centres of both grooves without load [m]; infinite for rollers.
    angle
        Contact angle of rollers [rad]. With one the axial load exceeds tan(angle) times the radial
        one, without one it is 0.
    """
    radial_load, axial_load = load
    psi = azimuths(count)
    cosines = np.cos(psi)
    unit = (sum(load) / stiffness) ** (1.0 / power) + abs(clearance)

    def state(radial: float, axial: float) -> tuple[Array, Array]:
        play = radial * cosines - 0.5 * clearance
        if math.isinf(centres):
            approach = play * math.cos(angle) + axial * math.sin(angle)
            return stiffness * np.maximum(approach, 0.0) ** power, np.full(count, angle)
        across = centres + play
        # the distance of the centres less what it is without load, without cancellation
        distance = np.hypot(axial, across)
        approach = (axial**2 + (across + centres) * play) / (distance + centres)
        return stiffness * np.maximum(approach, 0.0) ** power, np.arctan2(axial, across)

    def radial_force(radial: float, axial: float) -> float:
        loads, angles = state(radial, axial)
        return float(np.sum(loads * np.cos(angles) * cosines))

    def displaced(axial: float) -> float:
        """Radial displacement at an axial one."""
        if radial_load == 0.0:
            return 0.0
        return _root(lambda radial: radial_force(radial, axial) - radial_load, unit)

    def axial_force(axial: float) -> float:
        loads, angles = state(displaced(axial), axial)
        return float(np.sum(loads * np.sin(angles)))

    # the potential of the ring is convex: both forces only rise with their displacements
    axial = _root(lambda z: axial_force(z) - axial_load, unit) if axial_load > 0.0 else 0.0
    radial = displaced(axial)
    return Equilibrium(radial, axial, *state(radial, axial))


def _root(miss: Callable[[float], float], unit: float) -> float:
    """Root of a rising function; `unit` is a first guess of its size."""
    from scipy.optimize import brentq  # noqa: PLC0415 (takes as long to load as all the rest)

    far, sign = unit, -1.0 if miss(0.0) > 0.0 else 1.0
    while sign * miss(sign * far) < 0.0:
        far *= 2.0
    rtol = 4.0 * np.finfo(float).eps
    return float(brentq(miss, 0.0, sign * far, xtol=1e-16 * far, rtol=rtol))
