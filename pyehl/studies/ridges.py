# SPDX-License-Identifier: BSD-3-Clause
"""What a contact makes of ridges along the motion, from steady solutions.

Ridges cos(k_Y Y) do not move: the rough contact is steady. On its centre line, the crest of a
ridge, film and pressure less those of the smooth contact over the amplitude are the response.
Units as in :mod:`pyehl.studies.superposition`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pyehl.case import Case
from pyehl.errors import EhlError
from pyehl.solver import Solver
from pyehl.studies.superposition import REACH, transient_case
from pyehl.theory.operating import OperatingPoint

__all__ = ["ridges"]

Array = NDArray[np.float64]

AMPLITUDE = 3e-4
"""Amplitude over wavelength [a/R]: small enough for the response to be linear."""
ACCURACY = 1e-3
"""Algebraic error of both films over the error of the grid: their difference is measured. Five
times as much changes T by 0.01, twenty times by up to 0.09."""
# Pixels per wavelength; the solver interpolates a map by its Fourier series
PIXELS = 32


def ridges(
    settings: Mapping[str, Mapping[str, Any]],
    wavelengths: Sequence[float],
    *,
    points: int,
    solver: Mapping[str, Any] | None = None,
    progress: Callable[[int, int], None] = lambda done, total: None,
) -> dict[str, Array]:
    """Solve the contact of a resolved case with ridges, one wavelength [a] after the other.

    The domain is 4 a by 4 a with so many nodes per side; `solver` are keys of that group;
    `progress` is called with the solutions done and in all. What
    :class:`pyehl.studies.superposition.Superposition` has, with along (0), across (1 over the
    wavelength) and phase (0) of the waves, (m,), on a tile of side 1 [a]. EhlError if a contact
    has no solution.
    """
    keys = {"accuracy": ACCURACY, **(solver or {})}

    def at_rest(tile: float) -> Case:
        return transient_case(settings, points=points, tile=tile, velocity_ratio=0.0, solver=keys)

    smooth = at_rest(1.0).with_options("surface.kind=smooth", "time.steps=0")
    scale = OperatingPoint.from_settings(smooth.resolve()).film_scale
    place = np.arange(PIXELS) / PIXELS
    # even to the last bit
    line = AMPLITUDE * np.cos(2.0 * np.pi * np.minimum(place, 1.0 - place))
    solved = []
    for done, wavelength in enumerate((0.0, *wavelengths)):
        if wavelength:
            heights = np.tile(wavelength * scale * line, (8, 1))
            run = Solver.open(at_rest(wavelength), heights)
        else:
            run = Solver(smooth)
        with run:
            if not run.run():
                raise EhlError(f"ridges: no solution: {run.summary()['status']}")
            x, y = run.axes()
            solved.append((run.field("H"), run.field("P")))
        progress(done + 1, 1 + len(wavelengths))
    near, middle = np.abs(x) <= REACH + 0.5 * (x[1] - x[0]), int(np.argmin(np.abs(y)))
    height = AMPLITUDE * np.asarray(wavelengths)[:, np.newaxis]
    film, pressure = (np.stack([pair[i][near, middle] for pair in solved]) for i in (0, 1))
    zero = np.zeros(len(wavelengths))
    return {
        "tile": np.float64(1.0),
        "along": zero,
        "across": 1.0 / np.asarray(wavelengths),
        "phase": zero,
        "x": x[near],
        "film": film[0],
        "pressure": pressure[0],
        "response": (film[0] - film[1:]) / height + 0j,
        "stiffness": (pressure[1:] - pressure[0]) / height + 0j,
        # nothing is fitted
        "residual": np.zeros((zero.size, int(near.sum()))),
        "spacing": np.float64(x[1] - x[0]),
        "central_film": np.float64(solved[0][0][int(np.argmin(np.abs(x))), middle]),
    }
