# SPDX-License-Identifier: BSD-3-Clause
"""Results for a position of the controls: the film on a grid, the prediction, a curve."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from pyehl import api
from pyehl.app.position import Position
from pyehl.app.worker import JobContext
from pyehl.errors import EhlError, InputError
from pyehl.prediction.result import Prediction
from pyehl.solver import Solver
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Array

COARSE, FINE = 129, (257, 513)
"""Nodes per side while a control moves, and when it rests."""
DELAY = 0.12
"""Time without changes after which a control is at rest [s]: a dragged slider changes more often,
and a finer film can still appear within 0.4 s."""
CURVES = {"mean velocity": "velocity", "slide-to-roll ratio": "slide_to_roll"}


@dataclass(frozen=True, slots=True)
class Film:
    """The smooth contact on a grid; arrays are empty without a solution."""

    points: int
    contact: tuple[object, ...]  # `Position.contact` of the film
    summary: Mapping[str, Any]
    point: OperatingPoint
    sheet: Mapping[str, Any]  # film formulas
    # x (nx,), y (ny,) [a]; pressure, film (nx, ny) in Hertz units
    x: Array = field(repr=False)
    y: Array = field(repr=False)
    pressure: Array = field(repr=False)
    film: Array = field(repr=False)

    @property
    def converged(self) -> bool:
        """Whether it is a solution."""
        return self.summary["status"] == "converged"


@dataclass(frozen=True, slots=True)
class Rough:
    """The rough contact: a prediction, or why there is none."""

    prediction: Prediction | None
    why: str = ""


@dataclass(frozen=True, slots=True)
class CurvePoint:
    """One point of a curve; NaN for a missing number."""

    place: float
    h_c: float = math.nan  # [m]
    h_c_error: float = math.nan  # [m]
    mu_ratio: float = math.nan
    mu_ratio_error: float = math.nan
    status: str = ""


def film(
    position: Position,
    points: int,
    wanted: Callable[[], bool],
    known: Mapping[int, Film] | None = None,
) -> Film | None:
    """Solve the smooth contact; None if the result is outdated.

    `known` are earlier films by their nodes: one of the same contact on this grid is returned at
    once, and one on another grid has the formulas. InputError if the case is not acceptable.
    """
    case = position.case(points, smooth=True)
    contact = position.contact
    same = {n: result for n, result in (known or {}).items() if result.contact == contact}
    if points in same:
        return same[points]
    settings = case.resolve()
    sheet = next((result.sheet for result in same.values()), None) or api.film(case).summary
    with Solver(case) as solver:
        while not solver.done:
            if not wanted():
                return None
            solver.advance()
        summary = solver.summary
        empty = np.zeros((0, 0))
        arrays = (np.zeros(0), np.zeros(0), empty, empty)
        if solver.converged:
            arrays = (*solver.axes(), solver.field("P"), solver.field("H"))
    point = OperatingPoint.from_settings(settings)
    return Film(points, contact, summary, point, sheet, *arrays)


def rough(position: Position) -> Rough:
    """Predict the rough contact, or give the reason for a failure."""
    try:
        made = api.predict(position.case(FINE[0]))
        len(made.bands)  # the page shows them: they are computed here, not while it is drawn
        return Rough(made)
    except (EhlError, OSError) as error:
        return Rough(None, str(error))


def follow(position: Position, known: dict[int, Film]) -> Callable[[JobContext], None]:
    """Make the job of a position: a coarse film at once, finer ones when the control rests.

    `known` are the last films of the page by their nodes per side, which the job updates.
    """

    def job(context: JobContext) -> None:
        result = film(position, COARSE, context.wanted, known)
        if result is None:
            return
        known[COARSE] = result
        context.answer_with(result)
        if position.rough and context.newest():
            context.answer_with(rough(position))
        if not context.wait(DELAY):
            return
        for points in FINE:
            result = film(position, points, context.newest, known)
            if result is None:
                return
            known[points] = result
            context.answer_with(result)

    return job


def places(position: Position, over: str, count: int) -> list[float]:
    """Values of a control for a curve: a quarter to four times the speed, or ratios of 0 to 1.8."""
    if over == "slide_to_roll":
        return [float(f"{value:.3g}") for value in np.linspace(0.0, 1.8, count)]
    middle = float(position.values[over])
    ends = math.log10(middle / 4.0), math.log10(middle * 4.0)
    return [float(f"{value:.3g}") for value in np.logspace(*ends, count)]


def curve(
    position: Position,
    over: str,
    values: Sequence[float],
    wanted: Callable[[], bool],
    points: int = COARSE,
) -> Iterator[list[CurvePoint]]:
    """Compute a curve over a control; yields all points so far, until the curve is outdated."""
    result: list[CurvePoint] = []
    for value in values:
        made = _curve_point(position.changed(over, value), value, wanted, points)
        if made is None:
            return
        result.append(made)
        yield list(result)


def _curve_point(
    here: Position, value: float, wanted: Callable[[], bool], points: int
) -> CurvePoint | None:
    try:
        solved = film(here, points, wanted)
    except InputError as error:
        return CurvePoint(value, status=str(error))
    if solved is None:
        return None
    status = str(solved.summary["status"])
    if not solved.converged:
        return CurvePoint(value, status=status)
    known = solved.summary["H_c_error"]
    h_c = float(solved.summary["h_c_m"])
    h_c_error = math.nan if known is None else float(known) * solved.point.film_scale
    if not here.rough:
        return CurvePoint(value, h_c, h_c_error, status=status)
    answer = rough(here)
    made = answer.prediction
    if made is None:
        return CurvePoint(value, h_c, h_c_error, status=answer.why)
    status = made.friction.status
    return CurvePoint(value, h_c, h_c_error, made.mu_ratio, made.model_error, status)
