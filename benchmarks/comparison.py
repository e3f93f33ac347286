# SPDX-License-Identifier: BSD-3-Clause
"""A problem as it is solved and with skipped work done: seconds, and the difference in a result."""

from collections.abc import Callable
from typing import Any

from common import processor_seconds
from numpy import abs as absolute
from numpy import asarray

from pyehl.case import Case
from pyehl.handle import SolverHandle, results_of
from pyehl.prediction.simulation import transfer
from pyehl.types import Row, Values

# Bits cannot be equal where sums are taken in another order; the cycles may make it more
ROUNDING = 1e-10


def timed(call: Callable[[], Values]) -> tuple[float, Values]:
    """Give the processor seconds of something, and what it gave."""
    began = processor_seconds()
    values = call()
    return processor_seconds() - began, values


def solve(*options: str) -> dict[str, Any]:
    """Solve the case of all defaults with options, on one thread; returns its summary."""
    # what the solver does alone, nothing predicted
    with SolverHandle(Case.from_text("", [*options, "solver.threads=1"]).text) as solver:
        solver.run()
        return results_of(solver).values


def solve_from_prediction(*options: str) -> dict[str, Any]:
    """Solve the same from the prediction on; what that costs is in it."""
    case = Case.from_text("", [*options, "solver.threads=1", "time.start=prediction"])
    with SolverHandle(case.text) as solver:
        transfer(solver, case.resolve(), {}, whole=True)
        solver.run()
        return results_of(solver).values


def compare(
    problem: str,
    skipped: str,
    quantity: str,
    usual: Callable[[], Values],
    other: Callable[[], Values],
    allowed: float | Callable[[Values], float],
    *,
    besides: bool = False,
) -> Row:
    """Make both; differences are relative, the greatest one where `quantity` is an array.

    `allowed` may hang on what the usual one gave; `besides`: the other is work on top of it.
    """
    (seconds, values), (without, others) = timed(usual), timed(other)
    one, two = (asarray(result[quantity], dtype=float) for result in (values, others))
    difference = float(absolute(one - two).max() / absolute(one).max())
    limit = allowed(values) if callable(allowed) else allowed
    without += seconds if besides else 0.0
    return {
        "problem": problem,
        "skipped": skipped,
        "seconds": seconds,
        "without": without,
        "saved": 1.0 - seconds / without,
        "quantity": quantity,
        "difference": difference,
        "allowed": limit,
        "same": difference <= limit,
    }


def step_tolerance(values: Values) -> float:
    """Algebraic error that a time step allows itself in mu_r/mu_s, of two runs."""
    # a tenth of the error of order 2, which is a third of what is stated
    return 2.0 * 0.1 * float(values["mu_ratio_error_grid"]) / 3.0 / float(values["mu_ratio"])


def mean_tolerance(values: Values) -> float:
    """Change of the mean at which a run ends, and the algebraic error of its steps."""
    stop = float(values["mu_ratio_error_stop"]) / float(values["mu_ratio"])
    return max(1e-3, stop) + step_tolerance(values)
