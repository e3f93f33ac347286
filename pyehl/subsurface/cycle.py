# SPDX-License-Identifier: BSD-3-Clause
"""Stress cycles of material points that pass through the contact, fatigue and life.

Arrays of stress have the six components first, in the order of `pyehl.subsurface.half_space`.

Criteria of multiaxial fatigue
------------------------------
Both combine the amplitude of the deviator with the hydrostatic stress, by the fatigue limits of
the material in fully reversed torsion, t, and bending, f. The amplitude is the radius of the
smallest hypersphere around the path of the deviator s, with the norm sqrt(s:s/2); its centre is the
mean (:class:`Cycle`).

- Dang Van 1993 (ASTM STP 1191, 120): max over time of tau(t) + a p(t), where tau is the largest
  shear of s(t) minus the centre of the sphere, p the hydrostatic stress, a = 3 (t/f - 1/2).
- Crossland 1956 (Int. Conf. Fatigue of Metals, London, 138): the radius plus a times the largest
  p, a = 3 t/f - sqrt(3).

The material endures where the criterion is below t.

The life modification factor of rolling bearings by the film ratio is for comparison.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from pyehl.errors import InputError
from pyehl.subsurface.half_space import COMPONENTS
from pyehl.subsurface.loads import Loads
from pyehl.types import Array


def hydrostatic(stress: Array) -> Array:
    """Mean normal stress, tension positive, (6, ...) to (...) [Pa]."""
    return np.asarray((stress[0] + stress[1] + stress[2]) / 3.0)


def deviator(stress: Array) -> Array:
    """Stress minus its mean normal stress, (6, ...) [Pa]."""
    result = stress.copy()
    result[:3] -= hydrostatic(stress)
    return result


def second_invariant(s: Array) -> Array:
    """J2 = s:s/2 of a deviator (6, ...) [Pa^2]."""
    squares = np.square(s)
    return np.asarray(0.5 * squares[:3].sum(axis=0) + squares[3:].sum(axis=0))


def von_mises(stress: Array) -> Array:
    """Von Mises stress, sqrt(3 J2) [Pa]."""
    return np.asarray(np.sqrt(3.0 * second_invariant(deviator(stress))))


def octahedral_shear(stress: Array) -> Array:
    """Shear stress on the octahedral plane, sqrt(2 J2/3) [Pa]."""
    return np.asarray(np.sqrt(2.0 / 3.0 * second_invariant(deviator(stress))))


def principal_shear(stress: Array) -> Array:
    """Half the difference between the largest and the smallest principal stress [Pa]."""
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
    # only rounding moves the cosine outside [-1, 1]; J2 = 0 has no shear
    angle = np.arccos(np.clip(np.nan_to_num(cosine), -1.0, 1.0)) / 3.0
    # the largest and the smallest differ by 2 sqrt(J2) sin(angle + pi/3)
    return root * np.sin(angle + np.pi / 3.0), np.sqrt(3.0) * root


# Minimum number of lines along the motion whose material points are followed, if the contact has as
# many; fewer than twice as many are
LINES = 33
# Minimum distance that a point moves in a complete history [semi-axes]: the diameter
MIN_DISTANCE = 2.0
# Iterations for the centre of the sphere; the relative error of the radius is about 1/STEPS
STEPS = 200
# Number of points for which the sphere is computed, those with the largest bounds
CANDIDATES = 64


@dataclass(frozen=True, slots=True)
class Cycle:
    """Material points that may have the largest amplitude at one depth, and their stress cycles.

    Stresses have the unit of the history.
    """

    history: Array  # (6, times, points)
    mean: Array  # centre of the path of the deviator (6, points)
    amplitude: Array  # radius of the sphere around the path (points,)
    hydrostatic_mean: Array  # middle of the range of the hydrostatic stress (points,)
    hydrostatic_amplitude: Array  # half that range (points,)

    @classmethod
    def of(cls, history: Array, weight: float = 0.0) -> Cycle:
        """Find the `CANDIDATES` of a history (6, times, points).

        They have the largest bounds on amplitude plus `weight` times the hydrostatic stress.
        """
        s, pressure = deviator(history), hydrostatic(history)
        bound = _norm(0.5 * (s.max(axis=1) - s.min(axis=1))) + weight * pressure.max(axis=0)
        result = np.argsort(bound)[-CANDIDATES:]
        centre, radius = smallest_sphere(s[:, :, result])
        top, bottom = pressure[:, result].max(axis=0), pressure[:, result].min(axis=0)
        half = 0.5 * (top - bottom)
        return cls(history[:, :, result], centre, radius, 0.5 * (top + bottom), half)

    @property
    def worst(self) -> int:
        """Index of the point with the largest amplitude."""
        return int(self.amplitude.argmax())


class History:
    """Stress of material points over time; they move with the surface of the body.

    Under a smooth contact all points of a line along the motion have the same history. Under a
    rough one a point is followed through the instants; stress is interpolated between nodes, and
    outside the domain it is that at the border. If the load is periodic in time (`Loads.period`),
    a point is followed over the whole domain from each instant on; else up to the end of the run.
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
        """Return the history (6, times, points)."""
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
        """Stress (6, places, lines) at an instant and places along x [a]."""
        x = self.loads.x
        place = (places - x[0]) / (x[1] - x[0])
        left = np.clip(np.floor(place), 0, x.size - 2).astype(int)
        weight = np.clip(place - left, 0.0, 1.0)[np.newaxis, :, np.newaxis]
        lines = self.instants[instant]
        return np.asarray(lines[:, left] * (1.0 - weight) + lines[:, left + 1] * weight)


def incomplete(loads: Loads) -> str:
    """Return why the loads do not cover a complete passage; '' if they do."""
    if not loads.times.size:
        return ""
    if loads.velocity == 0.0:
        return "the surface of the body is at rest: its points do not pass through the contact"
    if loads.period > 0.0:
        return ""
    distance = abs(loads.velocity) * float(loads.times[-1] - loads.times[0])
    if distance >= MIN_DISTANCE:
        return ""
    return (
        f"during the {loads.times.size} instants of the run the surface moves {distance:.2g} a; "
        f"mean and amplitude need {MIN_DISTANCE:g} a (output.frame_interval)"
    )


def _norm(s: Array) -> Array:
    """sqrt(s:s/2) of deviators (6, ...)."""
    return np.asarray(np.sqrt(second_invariant(s)))


def smallest_sphere(path: Array) -> tuple[Array, Array]:
    """Centre (6, points) and radius (points,) of the smallest spheres around paths.

    Paths are (6, times, points). Steps of decreasing length go towards the farthest point (Badoiu &
    Clarkson 2003); the radius is the distance of the farthest point from the centre, so that it is
    an upper bound.
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
    result = [
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
        result.append((f"sigma_{name}_mean", 0.5 * (top + bottom), f"mean of {name}, {at}"))
        result.append(
            (f"sigma_{name}_amplitude", 0.5 * (top - bottom), f"amplitude of {name}, {at}")
        )
    return result


CRITERIA = ("dang-van", "crossland")


@dataclass(frozen=True, slots=True)
class Fatigue:
    """A criterion with the limits in torsion and bending [Pa]; InputError if they are invalid."""

    criterion: str
    torsion_limit: float
    bending_limit: float

    def __post_init__(self) -> None:
        """Check the criterion and the limits."""
        if self.criterion not in CRITERIA:
            raise InputError(f"fatigue = {self.criterion!r}: expected one of {', '.join(CRITERIA)}")
        for name in ("torsion_limit", "bending_limit"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0.0):
                raise InputError(f"{name} = {value!r}: expected a fatigue limit > 0 [Pa]")
        if not self.weight >= 0.0:
            minimum = 0.5 if self.criterion == "dang-van" else 1.0 / math.sqrt(3.0)
            raise InputError(
                f"torsion_limit/bending_limit = {self.torsion_limit / self.bending_limit:.3g}: "
                f"{self.criterion} is for a ratio of {minimum:.3g} or more (ductile metals)"
            )

    @property
    def weight(self) -> float:
        """Weight a of the hydrostatic stress [-]."""
        ratio = 3.0 * self.torsion_limit / self.bending_limit
        return ratio - (1.5 if self.criterion == "dang-van" else math.sqrt(3.0))

    def largest(self, cycle: Cycle) -> float:
        """Largest equivalent stress [Pa] of the material points of a cycle."""
        if self.criterion == "crossland":
            top = cycle.hydrostatic_mean + cycle.hydrostatic_amplitude
            return float(np.max(cycle.amplitude + self.weight * top))
        shear = principal_shear(deviator(cycle.history) - cycle.mean[:, np.newaxis])
        return float(np.max(shear + self.weight * hydrostatic(cycle.history)))


BEARINGS = ("ball", "roller")
# Range of the viscosity ratio in which the standard defines the factor, and the largest factor
KAPPA_MIN, KAPPA_MAX, MAX_A_ISO = 0.1, 4.0, 50.0
# Radial bearings, ISO 281:2007, 9.3.3.3: upper limit of kappa, and A, B and n of A - B/kappa^n;
# below, the exponents of that term, of the contamination term and of the bracket
_BALL = (
    (0.4, 2.5671, 2.2649, 0.054381),
    (1.0, 2.5671, 1.9987, 0.19087),
    (4.0, 2.5671, 1.9987, 0.071739),
)
_ROLLER = (
    (0.4, 1.5859, 1.3993, 0.054381),
    (1.0, 1.5859, 1.2348, 0.19087),
    (4.0, 1.5859, 1.2348, 0.071739),
)
_EXPONENTS = {"ball": (0.83, 1.0 / 3.0, -9.3), "roller": (1.0, 0.4, -9.185)}


def kappa_of(lambda_ratio: float) -> float:
    """Viscosity ratio kappa [-] for a film ratio Lambda: Lambda^1.3 (ISO/TR 1281-2)."""
    return lambda_ratio**1.3


def a_iso(kappa: float, contamination: float, bearing: str) -> float:
    """Life modification factor a_ISO [-] of a radial bearing.

    Parameters
    ----------
    kappa
        Viscosity ratio [-], at least `KAPPA_MIN`; values above `KAPPA_MAX` count as `KAPPA_MAX`.
    contamination
        e_C C_u/P: contamination factor times fatigue load limit over equivalent load [-].
    bearing
        One of `BEARINGS`.

    Returns
    -------
    float
        At most 50, as the standard requires; NaN below `KAPPA_MIN`, where it is not defined.

    Raises
    ------
    InputError
        For another bearing, or a contamination term that is not positive or above 5.
    """
    if bearing not in BEARINGS:
        raise InputError(f"bearing = {bearing!r}: expected one of {', '.join(BEARINGS)}")
    if not (math.isfinite(contamination) and 0.0 < contamination <= 5.0):
        raise InputError(f"contamination = {contamination!r}: expected e_C C_u/P, 0 ... 5 [-]")
    if not kappa >= KAPPA_MIN:
        return math.nan
    within = min(kappa, KAPPA_MAX)
    table = _BALL if bearing == "ball" else _ROLLER
    first, second, last = _EXPONENTS[bearing]
    _, a, b, n = next(row for row in table if within <= row[0])
    bracket = 1.0 - (a - b / within**n) ** first * contamination**second
    return min(MAX_A_ISO, 0.1 * bracket**last) if bracket > 0.0 else MAX_A_ISO
