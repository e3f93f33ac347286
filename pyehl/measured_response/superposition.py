# SPDX-License-Identifier: BSD-3-Clause
"""Response of a contact to many small waves of roughness, from one transient run.

Waves of small amplitude do not interact, so that one surface can hold many of them. Each has its
own number of wavelengths along the tile, hence its own frequency U k at a fixed position. When the
front and the free waves have passed, film and pressure on the line Y = 0 are fitted by the cosines
and sines of all frequencies over one period of the tile. The waves are even in Y, cos(k_Y Y), so
that half the domain is solved.

Film and roughness: H = H_0 - sum A Re T exp(i(k(X - U t) + phase)); pressure: P = P_0 + sum A Re Pi
exp(...). Lengths along the surface are scaled by the Hertz radius a, films by a^2/R, pressures by
p_h, times by a/u.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pyehl.case import Case
from pyehl.errors import EhlError
from pyehl.solver import Solver, solver_on_heights
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Array, Complex, Settings

SLOPE = 1.2e-3
"""Amplitude of a wave times its wavenumber [a/R]: small enough for a linear response."""
REACH = 1.0
"""Maximum |X| at which the response is measured [a]."""
# solver.accuracy of a run
ACCURACY = 0.02
# Pixels per shortest wave; the solver interpolates a map by its Fourier series
PIXELS = 4
# Distance [a] that the slowest wave moves until the start of the run has no effect
FILLING = 2.3
# Front of the tile at the start of the run [a]
FRONT = -2.5


@dataclass(frozen=True, slots=True)
class WaveSet:
    """Waves on a square tile."""

    tile: float  # its side [a]
    # Wavelengths per tile along and across the motion, (m,); those along are distinct and positive
    along: NDArray[np.int64]
    across: NDArray[np.int64]
    phase: Array  # (m,) [rad]

    def __post_init__(self) -> None:
        """Check that the frequencies can be distinguished."""
        if np.unique(self.along).size != self.along.size or self.along.min() < 1:
            raise ValueError(
                "the waves of a tile need different numbers along the motion, 1 or more"
            )

    @property
    def kx(self) -> Array:
        """Wavenumbers along the motion (m,) [1/a]."""
        return np.asarray(2.0 * np.pi / self.tile * self.along)

    @property
    def ky(self) -> Array:
        """Wavenumbers across the motion (m,) [1/a]."""
        return np.asarray(2.0 * np.pi / self.tile * self.across)

    @property
    def q(self) -> Array:
        """|q| (m,) [1/a]."""
        return np.asarray(np.hypot(self.kx, self.ky))


@dataclass(frozen=True, slots=True)
class Superposition:
    """Response of a contact to the waves of a tile, on Y = 0."""

    x: Array  # nodes within REACH (n,) [a]
    # Means over a period, H [a^2/R] and P [p_h], (n,)
    film: Array
    pressure: Array
    response: Complex  # T, (m, n)
    stiffness: Complex  # Pi: pressure [p_h] per roughness [a^2/R], (m, n)
    # rms residual of the film in the fit, over the amplitude of each wave, (m, n)
    residual: Array
    spacing: float  # grid spacing [a]
    central_film: float  # H_c of the smooth contact on this grid [a^2/R]


def linear_surface(waves: WaveSet, slope: float = SLOPE) -> tuple[Array, Array]:
    """Return heights [a^2/R] of a tile, even in Y, and the amplitudes (m,) of its waves."""
    pixels = PIXELS * int(max(waves.along.max(), waves.across.max(), 2))
    x = np.arange(pixels) / pixels * waves.tile
    # distance from the nearest edge, which makes the cosines even to the last bit
    y = np.minimum(x, waves.tile - x)
    amplitude = slope / waves.q
    along = amplitude * np.cos(np.outer(x, waves.kx) + waves.phase)
    return np.asarray(along @ np.cos(np.outer(y, waves.ky)).T), np.asarray(amplitude)


def step_counts(
    points: int, tile: float, velocity_ratio: float, filling: float = FILLING
) -> tuple[int, int]:
    """Count the steps of one period of a tile [a], and of a run after its smooth solution."""
    per_radius = (points - 1) / 4.0
    period = math.ceil(tile / velocity_ratio * per_radius)
    return period, math.ceil(filling / min(1.0, velocity_ratio) * per_radius) + period


def transient_case(
    settings: Settings,
    *,
    points: int,
    tile: float,
    velocity_ratio: float,
    solver: Mapping[str, Any],
) -> Case:
    """Return the case of a run with a tile [a] at the operating point of resolved settings."""
    o = OperatingPoint.from_settings(settings)
    round_one = o.radius_ratio == 1.0
    radii = {"radius_x": o.radius, "radius_y": o.radius / o.radius_ratio}
    # the margin beside an ellipse is that beside a circle, rounded up to a quarter of the radius
    side = math.ceil(4.0 * (1.0 + o.ellipse.ellipticity)) / 4.0
    rows = {} if round_one else {"points_y": round(0.5 * side * (points - 1)) + 1}
    return Case(
        contact={
            "load": o.load,
            "mean_velocity": o.mean_velocity,
            **({"radius": o.radius} if round_one else radii),
            "reduced_modulus": o.reduced_modulus,
        },
        lubricant=settings["lubricant"],
        surface={
            "kind": "fractal",
            "length_x": tile * o.hertz_radius,
            "length_y": tile * o.hertz_radius,
            "velocity_ratio": velocity_ratio,
            "x_start": FRONT,
        },
        # the nodes of a tier refer to a domain of 4 a by 4 a for all M and L
        grid={"points": points, "x_inlet": -2.5, "x_outlet": 1.5, "y_extent": side, **rows},
        solver={"accuracy": ACCURACY, **solver},
        time={"steps": 100000, "estimate_error": False},
    )


def superpose(
    settings: Settings,
    waves: WaveSet,
    *,
    points: int,
    velocity_ratio: float,
    solver: Mapping[str, Any] | None = None,
    slope: float = SLOPE,
    filling: float = FILLING,
    progress: Callable[[int, int], object] = lambda done, total: None,
) -> Superposition:
    """Run a tile of waves through the contact of a resolved case.

    The domain has `points` nodes over 4 a along the motion, square cells, and ends at a distance a
    from the sides of the contact. `velocity_ratio` is positive; `solver` are keys of that group;
    `slope` is amplitude times wavenumber [a/R]; `filling` is the distance that the slowest wave
    moves before the fitted period begins [a]; `progress` is called with the steps done and their
    total. EhlError if the run ends too early.
    """
    case = transient_case(
        settings, points=points, tile=waves.tile, velocity_ratio=velocity_ratio, solver=solver or {}
    )
    operating = OperatingPoint.from_settings(case.resolve())
    heights, amplitude = linear_surface(waves, slope)
    with solver_on_heights(case, {"surface": heights * operating.film_scale}) as run:
        while not run.done and float(run.summary.get("steps") or 0) < 1:
            run.advance()
        _refuse_end(run)
        central_film = float(run.summary.get("H_c_smooth") or run.summary["H_c"])
        x, y = run.axes()
        spacing = float(x[1] - x[0])
        near = np.abs(x) <= REACH + 0.5 * spacing
        middle = int(np.argmin(np.abs(y)))
        period, total = step_counts(points, waves.tile, velocity_ratio, filling)
        times, films, pressures = [], [], []
        for step in range(1, total + 1):
            run.advance()
            _refuse_end(run)
            if step > total - period:
                times.append(float(run.summary["T"]))
                films.append(run.field("H")[near, middle])
                pressures.append(run.field("P")[near, middle])
            progress(step, total)
    record = (x[near], np.array(times), np.array(films), np.array(pressures))
    return _fit(waves, amplitude, velocity_ratio, record, (spacing, central_film))


def _refuse_end(run: Solver) -> None:
    if run.done:
        raise EhlError(f"the run ended too early: {run.summary['status']}")


def _fit(
    waves: WaveSet,
    amplitude: Array,
    velocity_ratio: float,
    record: tuple[Array, Array, Array, Array],
    grid: tuple[float, float],
) -> Superposition:
    """Fit film and pressure (times, n) by all frequencies at every X, by least squares."""
    x, times, films, pressures = record
    angle = np.outer(times, waves.kx * velocity_ratio)
    basis = np.hstack([np.ones((times.size, 1)), np.cos(angle), np.sin(angle)])
    inverse = np.linalg.pinv(basis)
    film, pressure = inverse @ films, inverse @ pressures
    m = waves.kx.size
    # a cos + b sin = Re (a + i b) exp(-i U k t)
    film_wave = film[1 : m + 1] + 1j * film[m + 1 :]
    pressure_wave = pressure[1 : m + 1] + 1j * pressure[m + 1 :]
    phase = np.outer(waves.kx, x - FRONT) + waves.phase[:, np.newaxis]
    roughness = amplitude[:, np.newaxis] * np.exp(1j * phase)
    residual = np.sqrt(np.mean((films - basis @ film) ** 2, axis=0))
    return Superposition(
        x,
        film[0],
        pressure[0],
        np.asarray(-film_wave / roughness),
        np.asarray(pressure_wave / roughness),
        residual[np.newaxis, :] / amplitude[:, np.newaxis],
        *grid,
    )
