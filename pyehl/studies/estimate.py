# SPDX-License-Identifier: BSD-3-Clause
"""How long a case takes, by estimate, and what it has in common with others.

The numbers are of one thread of the machine that they were measured on, good to a factor of two or
so: what matters is that long cases begin first, and that the order of magnitude is known before a
study runs.
"""

from collections.abc import Mapping
from typing import Any

from pyehl.case import Case
from pyehl.prediction.smooth import POINTS, smooth_case
from pyehl.studies.tasks import Task
from pyehl.surfaces import FEATURES, rough_groups
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Settings

PREDICTION, PREDICTION_PIXEL = 0.1, 1.4e-6
"""Seconds of a prediction, and per pixel of its tile, without the smooth contact under it."""
FULL = 2.8
"""How many times as long one with tracks and bands takes."""
PAIR = 8.0
"""How many times as long that of two rough surfaces takes as those of both alone."""
FILM = 2e-3
SMOOTH_LINE, SMOOTH_NODE = 5e-4, 5e-7
"""Seconds of a smooth contact per line and per node of its finest grid."""
STEP_NODE, MANY_WAVES = 2.7e-7, 1.25
"""Seconds of a time step of a waviness per node; how much longer surfaces of many waves take."""


def smooth_seconds(points: int) -> float:
    """Seconds of a smooth contact on points x points nodes."""
    return SMOOTH_LINE * points + SMOOTH_NODE * points**2


def seconds_of(settings: Settings, run: str, *, shared: bool = False, full: bool = False) -> float:
    """Seconds of a resolved case on one thread of the machine that was measured on.

    `shared`: the smooth contact under a prediction is there already; `full`: with tracks and bands.
    """
    if run == "film":
        return FILM
    rough = [settings[group] for group in rough_groups(settings)]
    if run == "predict":
        sides = [int(s["pixels"]) if s["kind"] == "fractal" else 256 for s in rough]
        alone = sum(PREDICTION + PREDICTION_PIXEL * side**2 for side in sides)
        alone *= (FULL if full else 1.0) * (PAIR if len(rough) > 1 else 1.0)
        solved = settings["psd"]["smooth"] == "solved" and not shared
        return alone + (smooth_seconds(POINTS) if solved else 0.0)
    grid = settings["grid"]
    points = int(grid["points"])
    smooth = smooth_seconds(points)
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


class TaskList:
    """Tasks with the time that each may take, as they are added."""

    def __init__(self) -> None:
        self.tasks: list[Task] = []
        self._contacts: set[str] = set()  # smooth contacts under predictions

    def add(
        self, number: int, case: Case, run: str, *, folder: str = "", tracks: bool = False
    ) -> int:
        """Add a task on a checked case; gives its number. With a folder a prediction is whole."""
        settings = case.resolve()
        shares = smooth_case(settings) if run == "predict" else ""
        shared = shares in self._contacts
        seconds = seconds_of(settings, run, shared=shared, full=tracks or bool(folder))
        self._contacts.add(shares)
        self.tasks.append(Task(number, case.text, run, folder, seconds, shares, tracks))
        return number
