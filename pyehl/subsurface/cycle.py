# SPDX-License-Identifier: BSD-3-Clause
"""Mean and amplitude of the stress that material points meet on their way through the contact.

The deviator s of a point describes a path. Its amplitude is the radius, its mean the centre, of the
smallest hypersphere around the path, with the norm sqrt(s:s/2) (Dang Van 1993, ASTM STP 1191, 120).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from pyehl.subsurface.half_space import COMPONENTS
from pyehl.subsurface.loads import Loads
from pyehl.subsurface.measures import deviator, hydrostatic, second_invariant
from pyehl.types import Array

# Lines across the motion whose material points have a history
LINES = 33
# Way of a point through the contact that a history has at least [semi-axes]: the diameter
WAY = 2.0
# Steps of the way to the centre of the sphere; the radius is then right to about 1/STEPS of itself
STEPS = 200
# Points for which the sphere is found, those of the largest bounds
CANDIDATES = 64


@dataclass(frozen=True, slots=True)
class Cycle:
    """Material points that may have the largest amplitude at one depth, and what they meet.

    Stresses in the unit of the history.
    """

    history: Array  # (6, times, points)
    mean: Array  # centre of the path of the deviator (6, points)
    amplitude: Array  # radius of the sphere around it (points,)
    hydrostatic_mean: Array  # middle of the range of the hydrostatic stress (points,)
    hydrostatic_amplitude: Array  # half that range (points,)

    @classmethod
    def of(cls, history: Array, weight: float = 0.0) -> Cycle:
        """Find the `CANDIDATES` of a history (6, times, points).

        They have the largest bounds of amplitude plus `weight` times the hydrostatic stress.
        """
        s, pressure = deviator(history), hydrostatic(history)
        bound = _norm(0.5 * (s.max(axis=1) - s.min(axis=1))) + weight * pressure.max(axis=0)
        found = np.argsort(bound)[-CANDIDATES:]
        centre, radius = smallest_sphere(s[:, :, found])
        top, bottom = pressure[:, found].max(axis=0), pressure[:, found].min(axis=0)
        half = 0.5 * (top - bottom)
        return cls(history[:, :, found], centre, radius, 0.5 * (top + bottom), half)

    @property
    def worst(self) -> int:
        """The point of the largest amplitude."""
        return int(self.amplitude.argmax())


class History:
    """Stress of material points over time; they move with the surface of the body.

    Under a smooth contact all points of a line along the motion have one history. Under a passage a
    point is followed through the instants; between nodes it is interpolated, and outside of the
    domain it has the stress at its border. Where the passage repeats itself (`Loads.period`), it is
    followed over the whole domain, from each of the instants on; else up to the end of the run.
    """

    def __init__(self, loads: Loads) -> None:
        inside = np.flatnonzero(np.abs(loads.y) <= loads.semi_axis_y)
        self.lines = inside[:: max(1, inside.size // LINES)]
        self.loads = loads
        self.instants: list[Array] = []

    def add(self, stress: Array) -> None:
        """Add an instant, stress (6, nx, ny)."""
        lines = stress[:, :, self.lines]
        self.instants.append(lines.astype(np.float32) if self.loads.times.size else lines)

    def of_points(self) -> Array:
        """Give the history (6, times, points)."""
        loads = self.loads
        if not loads.times.size:
            return self.instants[0]
        if loads.period > 0.0:
            parts = [np.stack(part, axis=1) for part in self._repeated()]
        else:
            ends = loads.velocity * (loads.times - loads.times[-1])
            parts = [np.stack([self._at(k, loads.x + w) for k, w in enumerate(ends)], axis=1)]
        return np.concatenate([p.reshape(6, p.shape[1], -1) for p in parts], 2).astype(np.float64)

    def _repeated(self) -> list[list[Array]]:
        loads, count = self.loads, len(self.instants)
        step = loads.velocity * loads.period / count
        places = np.arange(loads.x[0], loads.x[-1] + 0.5 * step, step)
        return [
            [self._at((first + k) % count, np.array([x])) for k, x in enumerate(places)]
            for first in range(count)
        ]

    def _at(self, instant: int, places: Array) -> Array:
        """Stress (6, places, lines) of an instant at places along x [a]."""
        x = self.loads.x
        place = (places - x[0]) / (x[1] - x[0])
        left = np.clip(np.floor(place), 0, x.size - 2).astype(int)
        share = np.clip(place - left, 0.0, 1.0)[np.newaxis, :, np.newaxis]
        lines = self.instants[instant]
        return np.asarray(lines[:, left] * (1.0 - share) + lines[:, left + 1] * share)


def incomplete(loads: Loads) -> str:
    """Say why the loads give no history of a whole passage; '' if they do."""
    if not loads.times.size or loads.period > 0.0:
        return ""
    way = abs(loads.velocity) * float(loads.times[-1] - loads.times[0])
    if way >= WAY:
        return ""
    return (
        f"the {loads.times.size} instants of the run cover {way:.2g} a of the way of the surface; "
        f"mean and amplitude need {WAY:g} a (output.frame_interval)"
    )


def _norm(s: Array) -> Array:
    """sqrt(s:s/2) of deviators (6, ...)."""
    return np.asarray(np.sqrt(second_invariant(s)))


def smallest_sphere(path: Array) -> tuple[Array, Array]:
    """Centre (6, points) and radius (points,) of the smallest spheres around paths.

    Paths are (6, times, points). By steps of falling length towards the farthest point (Badoiu &
    Clarkson 2003); the radius is the distance of the farthest point from the centre found, so that
    it is an upper bound.
    """
    centre = 0.5 * (path.max(axis=1) + path.min(axis=1))
    best, radius = centre.copy(), np.full(centre.shape[1], math.inf)
    points = np.arange(centre.shape[1])
    for step in range(1, STEPS + 1):
        distance = _norm(path - centre[:, np.newaxis])
        farthest = distance.argmax(axis=0)
        longest = distance[farthest, points]
        nearer = longest < radius
        radius = np.where(nearer, longest, radius)
        best[:, nearer] = centre[:, nearer]
        centre = centre + (path[:, farthest, points] - centre) / (step + 1)
    return best, radius


def over_depth(cycles: list[Cycle]) -> list[tuple[str, Array, str]]:
    """Mean and amplitude over depth, each at the point of the largest shear amplitude there."""

    def of_worst(values: Callable[[Cycle], Array]) -> Array:
        return np.array([values(cycle)[cycle.worst] for cycle in cycles])

    histories = [cycle.history[:, :, cycle.worst] for cycle in cycles]
    at = "of the material point with the largest shear amplitude"
    found = [
        ("shear_amplitude", of_worst(lambda c: c.amplitude), "largest amplitude of the deviator"),
        ("hydrostatic_mean", of_worst(lambda c: c.hydrostatic_mean), f"mean hydrostatic, {at}"),
        (
            "hydrostatic_amplitude",
            of_worst(lambda c: c.hydrostatic_amplitude),
            f"amplitude of the hydrostatic stress {at}",
        ),
    ]
    for k, name in enumerate(COMPONENTS):
        top, bottom = (np.array([f(h[k]) for h in histories]) for f in (np.max, np.min))
        found.append((f"sigma_{name}_mean", 0.5 * (top + bottom), f"mean of {name}, {at}"))
        found.append(
            (f"sigma_{name}_amplitude", 0.5 * (top - bottom), f"amplitude of {name}, {at}")
        )
    return found
