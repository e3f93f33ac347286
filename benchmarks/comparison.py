# SPDX-License-Identifier: BSD-3-Clause
"""Time and difference of results between the default and a run that does the skipped work."""

from collections.abc import Callable
from typing import Any

from common import processor_seconds
from numpy import abs as absolute
from numpy import asarray

from pyehl.case import Case
from pyehl.handle import SolverHandle, results_of
from pyehl.simulation.initial_condition import transfer
from pyehl.types import Row, Values

# Sums in another order differ by rounding, which the cycles may amplify
ROUNDING = 1e-10


def timed(call: Callable[[], Values]) -> tuple[float, Values]:
    """Return the processor time of a call, and its result."""
    began = processor_seconds()
    values = call()
    return processor_seconds() - began, values


def solve(*options: str) -> dict[str, Any]:
    """Solve the case of all defaults with options, on one thread; returns its summary."""
    # the solver alone, without a prediction
    with SolverHandle(Case.from_text("", [*options, "solver.threads=1"]).text) as solver:
        solver.run()
        return results_of(solver).values


def solve_from_prediction(*options: str) -> dict[str, Any]:
    """Solve the same case, starting from the prediction, whose cost is included."""
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
    """Run both; the difference is relative, the largest one if `quantity` is an array.

    `allowed` may depend on the result of `usual`; `besides`: the time of `other` adds to that of
    `usual`.
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
    """Tolerance of the algebraic error of a time step in mu_r/mu_s, for two runs."""
    # a tenth of the second-order discretisation error, which is a third of the stated error
    return 2.0 * 0.1 * float(values["mu_ratio_error_grid"]) / 3.0 / float(values["mu_ratio"])


def mean_tolerance(values: Values) -> float:
    """Return the change of the mean at which a run ends plus the algebraic error of its steps."""
    stop = float(values["mu_ratio_error_stop"]) / float(values["mu_ratio"])
    return max(1e-3, stop) + step_tolerance(values)
