# SPDX-License-Identifier: BSD-3-Clause
"""How long a case takes, by estimate, and what it has in common with others.

The numbers are of one thread of the machine that `CALIBRATION` was measured on; `speed` compares
this machine with it. They are good to a factor of two or so: what matters is that long cases begin
first, and that the time of a study is known before it runs.
"""

from __future__ import annotations

import time
from collections.abc import Mapping
from typing import Any

from pyehl.case import Case
from pyehl.prediction.smooth import POINTS, smooth_case
from pyehl.solver import Solver
from pyehl.surfaces import FEATURES, one_rough, rough_groups
from pyehl.theory.operating import OperatingPoint

__all__ = ["seconds_of", "shares_of", "smooth_seconds", "speed"]

Settings = Mapping[str, Mapping[str, Any]]

CALIBRATION = 0.030
"""Seconds of the smooth contact on 65 x 65 nodes where the others were measured."""
PREDICTION, PREDICTION_PIXEL = 0.1, 1.4e-6
"""Seconds of a prediction, and per pixel of its tile, without the smooth contact under it."""
FULL = 2.8
"""How many times as long one with tracks and bands takes."""
FILM = 2e-3
SMOOTH_LINE, SMOOTH_NODE = 5e-4, 5e-7
"""Seconds of a smooth contact per line and per node of its finest grid."""
STEP_NODE, MANY_WAVES = 2.7e-7, 1.25
"""Seconds of a time step of a waviness per node; how much longer surfaces of many waves take."""


def speed() -> float:
    """Seconds of this machine over those of the one that was measured on."""
    text = "&contact moes_m = 200.0 moes_l = 10.0 /\n&grid points = 65 /\n"
    case = Case.from_text(text)
    best = min(_once(case) for _ in range(3))
    return best / CALIBRATION


def _once(case: Case) -> float:
    began = time.perf_counter()
    with Solver(case) as solver:
        solver.run()
    return time.perf_counter() - began


def smooth_seconds(points: int) -> float:
    """Seconds of a smooth contact on points x points nodes."""
    return SMOOTH_LINE * points + SMOOTH_NODE * points**2


def seconds_of(settings: Settings, run: str, *, shared: bool = False, full: bool = False) -> float:
    """Seconds of a resolved case on one thread of the machine that was measured on.

    `shared`: the smooth contact under a prediction is there already; `full`: with tracks and bands.
    """
    if run == "film":
        return FILM
    if run == "predict":
        surface = one_rough(settings)["surface"]
        pixels = int(surface["pixels"]) if surface["kind"] == "fractal" else 256
        alone = (PREDICTION + PREDICTION_PIXEL * pixels**2) * (FULL if full else 1.0)
        solved = settings["psd"]["smooth"] == "solved" and not shared
        return alone + (smooth_seconds(POINTS) if solved else 0.0)
    grid = settings["grid"]
    points = int(grid["points"])
    smooth = smooth_seconds(points)
    rough = [settings[group] for group in rough_groups(settings)]
    moving = [surface for surface in rough if float(surface["velocity_ratio"]) > 0.0]
    if not moving:
        return smooth
    mesh = (float(grid["x_outlet"]) - float(grid["x_inlet"])) / (points - 1)
    # of two surfaces, whose common period may be longer, as of the slower one
    longest = max(_time_to_settle(surface, settings) for surface in moving)
    steps = int(settings["time"]["steps"]) or longest / mesh
    hard = 1.0 if all(surface["kind"] == "harmonic" for surface in moving) else MANY_WAVES
    coarser = 9.0 / 8.0 if settings["time"]["estimate_error"] else 1.0
    return smooth + hard * coarser * STEP_NODE * points**2 * steps


def _time_to_settle(surface: Mapping[str, Any], settings: Settings) -> float:
    """Time in a/u until the friction is known: the way into the contact and three periods.

    Of a single feature its way through it.
    """
    if surface["kind"] in FEATURES:
        # from where it matters until it has left
        return (2.3 + 1.2 * float(surface.get("width", 0.5))) / float(surface["velocity_ratio"])
    if surface["kind"] == "harmonic":
        period = float(surface["wavelength_x"])
    elif settings["contact"].get("moes_l") == 0.0:
        period = 2.0  # no length follows from M alone
    else:
        period = float(surface["length_x"]) / OperatingPoint.from_settings(settings).hertz_radius
    way = 1.05 - max(-1.5, float(surface["x_start"]))
    return (way + 3.0 * period) / float(surface["velocity_ratio"])


def shares_of(settings: Settings, run: str) -> str:
    """Name the smooth contact that cases have in common; '' where there is none to share."""
    if run != "predict":
        return ""
    return smooth_case(settings)
