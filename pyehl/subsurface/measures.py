# SPDX-License-Identifier: BSD-3-Clause
"""Scalar measures of a state of stress, and criteria of fatigue over a history of stress.

Arrays of stress have the six components first, in the order of `pyehl.subsurface.half_space`.
"""

from __future__ import annotations

import numpy as np

from pyehl.types import Array


def hydrostatic(stress: Array) -> Array:
    """Mean normal stress, tension positive, (6, ...) to (...) [Pa]."""
    return np.asarray((stress[0] + stress[1] + stress[2]) / 3.0)


def deviator(stress: Array) -> Array:
    """Stress less its mean normal stress, (6, ...) [Pa]."""
    found = stress.copy()
    found[:3] -= hydrostatic(stress)
    return found


def second_invariant(s: Array) -> Array:
    """J2 = s:s/2 of a deviator (6, ...) [Pa^2]."""
    squares = np.square(s)
    return np.asarray(0.5 * squares[:3].sum(axis=0) + squares[3:].sum(axis=0))


def von_mises(stress: Array) -> Array:
    """Equivalent stress of von Mises, sqrt(3 J2) [Pa]."""
    return np.asarray(np.sqrt(3.0 * second_invariant(deviator(stress))))


def octahedral_shear(stress: Array) -> Array:
    """Shear stress on the octahedral plane, sqrt(2 J2/3) [Pa]."""
    return np.asarray(np.sqrt(2.0 / 3.0 * second_invariant(deviator(stress))))


def principal_shear(stress: Array) -> Array:
    """Largest shear stress, half the difference of the outer principal stresses [Pa]."""
    return shear_and_mises(stress)[0]


def shear_and_mises(stress: Array) -> tuple[Array, Array]:
    """`principal_shear` and `von_mises`, both at once [Pa].

    The principal deviators are 2 sqrt(J2/3) cos(angle + 2 pi m/3), with cos(3 angle) =
    (3 sqrt(3)/2) J3/J2^1.5.
    """
    s = deviator(stress)
    xx, yy, zz, xy, xz, yz = s
    j2 = second_invariant(s)
    j3 = xx * (yy * zz - yz**2) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz)
    root = np.sqrt(j2)
    with np.errstate(invalid="ignore", divide="ignore"):
        cosine = 1.5 * np.sqrt(3.0) * j3 / (j2 * root)
    # rounding alone takes the cosine out of [-1, 1]; J2 = 0 has no shear
    angle = np.arccos(np.clip(np.nan_to_num(cosine), -1.0, 1.0)) / 3.0
    # the outer two differ by 2 sqrt(J2) sin(angle + pi/3)
    return root * np.sin(angle + np.pi / 3.0), np.sqrt(3.0) * root
