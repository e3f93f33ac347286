# SPDX-License-Identifier: BSD-3-Clause
"""T and pressure over roughness of single waves at X = Y = 0, by the model of the prediction."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pyehl.prediction.response import AXIS
from pyehl.theory.ellipse import Ellipse
from pyehl.theory.ellipse_edge import EllipseEdge
from pyehl.theory.response import edge_gain, inlet_transfer
from pyehl.theory.transport import LINES, Zone, harmonics, line_pressure, transport, wave_pressure

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


def at_centre(
    zone: Zone,
    moes: tuple[float, float],
    waves: tuple[Array, Array, float],
    shape: Ellipse,
    *,
    edge: bool,
    spacing: float = 0.0,
) -> tuple[Complex, Complex]:
    """Give both for `waves`: wavenumbers (m,) [1/a] and the velocity ratio.

    `edge`: whether the contact has an edge; else waves continue beyond it.
    """
    kx, ky, ratio = waves
    slip = ratio - 1.0
    ((driven, free),) = transport(zone, kx, ky, ratio, np.zeros(1), spacing)
    inlet = inlet_transfer(zone, kx, ky, moes, ratio, LINES)
    bend = np.exp(1j * slip * np.outer(np.sqrt(1.0 - LINES**2), kx))
    beside = free * (inlet - inlet[AXIS]) * bend
    carried = free * inlet[AXIS] * bend[AXIS]
    pressure = wave_pressure(kx, ky, ratio, driven, carried)
    if shape.radius_ratio == 1.0:
        pressure = pressure * edge_gain(kx, ky, float(np.interp(0.0, zone.x, zone.film)))
    else:
        pressure = pressure - line_pressure(beside, kx, ky, ratio, shape.ellipticity)[AXIS]
    pressure = zone.stiffness * pressure
    if edge:
        pressure = pressure + _edge(shape, kx, ky) * (1.0 - driven - carried)
        if shape.radius_ratio != 1.0:
            for k, part in zip(*harmonics(beside), strict=True):
                pressure = pressure - _edge(shape, kx, ky + k / shape.ellipticity) * part
    return driven + carried, pressure


def _edge(shape: Ellipse, kx: Array, ky: Array) -> Complex:
    """Give the change by the edge of the pressure of a wave at the centre."""
    result = EllipseEdge(shape)
    origin = np.zeros(1)
    q = np.hypot(kx, ky)
    depends = (q > 1e-9) & (q < result.largest)
    changed = np.zeros(q.shape, dtype=complex)
    if depends.any():
        there = result.correction(kx[depends], ky[depends])
        changed[depends] = (result.functions(origin, origin).T @ there)[0]
    return changed
