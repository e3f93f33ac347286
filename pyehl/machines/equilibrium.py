# SPDX-License-Identifier: BSD-3-Clause
"""Load of each rolling element from the equilibrium of a rigid ring.

Static: no centrifugal or gyroscopic loads, rings round and parallel. Balls after Jones 1960, J.
Basic Eng. 82, 309, with the same stiffness for all; rollers after Harris & Kotzalas, *Essential
Concepts of Bearing Technology*.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from pyehl.theory.ellipse import Ellipse
from pyehl.types import Array

BALL, ROLLER = 1.5, 10.0 / 9.0
"""Exponent of the approach in the load of an element."""
# Stiffness of a steel roller between two raceways, 35 948 N mm^(-10/9) l^(8/9) with l in mm
# (ISO/TS 16281:2008), E' = 206 GPa/(1 - 0.3^2)
ROLLER_STIFFNESS, STEEL = 35948.0 * 1e3 ** (10.0 / 9.0 + 8.0 / 9.0), 2.06e11 / 0.91


@dataclass(frozen=True, slots=True)
class Equilibrium:
    """A ring under its load; arrays have one value for each element.

    Attributes
    ----------
    radial, axial
        Displacement of the inner ring relative to the outer one [m]; zero where the rings are
        concentric and their grooves opposite each other.
    loads
        Loads along the lines of contact [N].
    angles
        Contact angles [rad].
    """

    radial: float
    axial: float
    loads: Array
    angles: Array


def ball_stiffness(modulus: float, contacts: list[tuple[float, Ellipse]]) -> float:
    """K [N/m^1.5] of Q = K delta^1.5 for contacts in series, each with R_x [m] and its ellipse.

    Hertz: the approach is (a^2/R_x) times `kernel_ratio` and `potential` of :class:`Ellipse`.
    """
    flexibility = 0.0
    for radius, shape in contacts:
        approach = shape.kernel_ratio * shape.potential
        stiffness = 2.0 / 3.0 * modulus * shape.load_factor * math.sqrt(radius) / approach**1.5
        flexibility += stiffness ** (-2.0 / 3.0)
    return float(flexibility**-1.5)


def roller_stiffness(modulus: float, length: float) -> float:
    """K [N/m^(10/9)] of Q = K delta^(10/9) for a roller of a length [m] between two raceways.

    ISO/TS 16281:2008 for steel; Q/(E' l^2) depends only on delta/l, so K is proportional to E'.
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
        Number of elements.
    clearance
        Diametral clearance [m].
    load
        Radial and axial load [N], neither negative.
    centres
        Distance of the centres of both grooves without load [m]; infinite for rollers.
    angle
        Contact angle of rollers [rad]. If it is 0, so is the axial load; else the axial load
        exceeds tan(angle) times the radial load.
    """
    radial_load, axial_load = load
    psi = azimuths(count)
    cosines = np.cos(psi)
    unit = (sum(load) / stiffness) ** (1.0 / power) + abs(clearance)

    def state(radial: float, axial: float) -> tuple[Array, Array]:
        # radial approach of each element
        inward = radial * cosines - 0.5 * clearance
        if math.isinf(centres):
            approach = inward * math.cos(angle) + axial * math.sin(angle)
            return stiffness * np.maximum(approach, 0.0) ** power, np.full(count, angle)
        across = centres + inward
        # distance of the centres minus that without load, written without cancellation
        distance = np.hypot(axial, across)
        approach = (axial**2 + (across + centres) * inward) / (distance + centres)
        return stiffness * np.maximum(approach, 0.0) ** power, np.arctan2(axial, across)

    def radial_force(radial: float, axial: float) -> float:
        loads, angles = state(radial, axial)
        return float(np.sum(loads * np.cos(angles) * cosines))

    def displaced(axial: float) -> float:
        """Radial displacement for an axial one."""
        if radial_load == 0.0:
            return 0.0
        return _root(lambda radial: radial_force(radial, axial) - radial_load, unit)

    def axial_force(axial: float) -> float:
        loads, angles = state(displaced(axial), axial)
        return float(np.sum(loads * np.sin(angles)))

    # the potential of the ring is convex: both forces increase with their displacements
    axial = _root(lambda z: axial_force(z) - axial_load, unit) if axial_load > 0.0 else 0.0
    radial = displaced(axial)
    return Equilibrium(radial, axial, *state(radial, axial))


def _root(miss: Callable[[float], float], unit: float) -> float:
    """Root of an increasing function; `unit` is a first guess of its magnitude."""
    from scipy.optimize import brentq  # noqa: PLC0415 (takes as long to load as all the rest)

    far, sign = unit, -1.0 if miss(0.0) > 0.0 else 1.0
    while sign * miss(sign * far) < 0.0:
        far *= 2.0
    rtol = 4.0 * np.finfo(float).eps
    return float(brentq(miss, 0.0, sign * far, xtol=1e-16 * far, rtol=rtol))
