# SPDX-License-Identifier: BSD-3-Clause
"""Processor time saved by work that the solver skips, and a check that results do not change.

Each row is a problem solved by default and once more with the skipped work done, in turn, on one
thread.
"""

import argparse
import math
import sys
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

from common import add_list, columns, hertz, measure, parser, show
from comparison import ROUNDING, compare, mean_tolerance, solve, solve_from_prediction
from numpy import finfo, maximum

from pyehl import library
from pyehl.case import Case
from pyehl.contact import smooth as smooth_contact
from pyehl.prediction.predict import predict
from pyehl.types import Row, Values

COLUMNS = columns(
    "problem:s skipped:s seconds:.3f without:.3f saved:.0% quantity:s difference:.1e allowed:.1e"
)
MEANING = (
    "seconds: of the processor, one thread; without: the same with that work done; difference: in "
    "the quantity, relative;\nallowed: 0 where the bits are equal, "
    f"{ROUNDING:.0e} where sums are taken in another order, else the tolerance of the solver or of "
    "the mean"
)
"""Meaning of the columns."""

FRACTAL = ("surface.kind=fractal",)
WAVE = (
    "contact.moes_m=1000.0",
    "contact.moes_l=10.0",
    "surface.kind=harmonic",
    "surface.amplitude=9.734e-3",
    "surface.velocity_ratio=1.01",
)
# With one cycle per step rounding grows to the algebraic error; with this accuracy it does not
TIGHT_ACCURACY = "solver.accuracy=0.02"
# Relative algebraic error at which the nested iteration leaves its first grid
START_TOLERANCE = 1e-3
# At Table 1 the next coarser grid has no solution, so that there is no error estimate
MIN_POINTS = 257
# Periods of a run of fixed length: until the effect of the start has decayed, and one more
FIXED_PERIODS = 3
# Number of surfaces of a sweep
PREDICTIONS = 20


def smooth_problem(points: int) -> list[Row]:
    """Measure the smooth contact of Table 1 in SI units."""
    points = max(points, MIN_POINTS)
    problem, grid = "smooth contact, SI units", f"grid.points={points}"

    def usual() -> Values:
        return solve(grid) | {"mu_ratio": 1.0}

    def transient_run() -> Values:
        # one period, as for a rough surface
        return solve(
            grid, "surface.kind=harmonic", "surface.amplitude=0.0", "time.estimate_error=.false."
        )

    def estimated() -> Values:
        values = solve(grid)
        return values | {"coarser H_c": 4.0 * values["H_c"] - 3.0 * values["H_c_extrapolated"]}

    def coarser() -> Values:
        return {"coarser H_c": solve(f"grid.points={(points + 1) // 2}")["H_c"]}

    row = partial(compare, problem)
    return [
        row(
            "half of the domain: symmetric in Y",
            "H_c",
            usual,
            lambda: solve(grid, "solver.symmetry=full"),
            ROUNDING,
        ),
        row(
            "roughness, time levels and time steps",
            "mu_ratio",
            usual,
            transient_run,
            1e-4,
        ),
        row(
            "a solve on the next coarser grid for the error",
            "coarser H_c",
            estimated,
            coarser,
            START_TOLERANCE,
            besides=True,
        ),
        _deflection_row(problem, points),
    ]


def _deflection_row(problem: str, points: int) -> Row:
    """Measure the corrections of the deflection where P = 0, for a Hertz pressure."""
    pressure, h, _, _ = hertz(points)
    # the smallest pressure that does not count as zero
    everywhere = maximum(pressure, finfo(float).tiny / finfo(float).eps)
    count = 20

    def call(p: Any) -> Callable[[], Values]:  # noqa: ANN401
        def deflect() -> Values:
            done = library.deflection(p, h, h, "mlmi", accuracy=1e-5, threads=1, repeats=count)
            return {"deflection": done.values}

        return deflect

    what = f"corrections where P = 0, {count} deflections"
    return compare(problem, what, "deflection", call(pressure), call(everywhere), ROUNDING)


def _run_rows(problem: str, options: Sequence[str], *, symmetric: bool) -> list[Row]:
    """Measure the work that a transient run skips."""

    def usual() -> Values:
        return solve(*options)

    first = usual()

    def at_the_end() -> Values:
        """Run to the end of a fixed number of periods."""
        # distance of the front, half a contact radius long, from entering to filling the contact
        filled = 1.05 + 1.25 + 0.25
        step = float(first["x_mesh"])
        steps = math.ceil(filled / 1.01 / step + FIXED_PERIODS * float(first["T_period"]) / step)
        return solve(*options, f"time.steps={steps}")

    row = partial(compare, problem)
    rows = []
    if symmetric:
        rows.append(
            row(
                "half of the domain: symmetric in Y",
                "mu_ratio",
                lambda: solve(*options, TIGHT_ACCURACY),
                lambda: solve(*options, TIGHT_ACCURACY, "solver.symmetry=full"),
                ROUNDING,
            )
        )
    rows += [
        row(
            f"{first['steps_skipped']} steps before the roughness is near",
            "mu_ratio",
            usual,
            lambda: solve(*options, "time.skip_start=.false."),
            mean_tolerance,
        ),
        row(
            "steps in which the roughness fills the contact: time.start = 'prediction'",
            "mu_ratio",
            lambda: solve_from_prediction(*options),
            usual,
            mean_tolerance,
        ),
        row(
            f"steps up to the end of period {FIXED_PERIODS}: settled before",
            "mu_ratio",
            lambda: solve(*options, "time.estimate_error=.false."),
            at_the_end,
            mean_tolerance(first),
        ),
        row(
            "a solve of the smooth contact for mu_s",
            "F",
            usual,
            lambda: _smooth_of(options, symmetric=symmetric),
            0.0,
            besides=True,
        ),
    ]
    return rows


def _smooth_of(options: Sequence[str], *, symmetric: bool) -> dict[str, Any]:
    kept = [text for text in options if not text.startswith("surface.")]
    # full cycles on the same domain, as before the rough run
    return solve(*kept, "solver.cycle=F", f"solver.symmetry={'auto' if symmetric else 'full'}")


def wave_problem(points: int) -> list[Row]:
    """Measure the wave of Fig. 2 of Zhang et al. 2019, which is symmetric in Y."""
    options = [*WAVE, f"grid.points={max(points, MIN_POINTS)}"]
    return _run_rows("symmetric wave", options, symmetric=True)


def fractal_problem(points: int) -> list[Row]:
    """Measure the fractal surface of Table 1."""
    options = [*FRACTAL, f"grid.points={max(points, MIN_POINTS)}"]
    return _run_rows("fractal surface", options, symmetric=False)


def prediction_problem(points: int) -> list[Row]:
    """Measure predictions of fractal surfaces, without simulations."""
    seeds = range(1, PREDICTIONS + 1)
    cases = [Case.from_text("", [*FRACTAL, f"surface.seed={seed}"]).resolve() for seed in seeds]

    def ratios(*, keep: bool) -> Values:
        smooth_contact.forget()
        result = []
        for settings in cases:
            if not keep:
                smooth_contact.forget()
            result.append(predict(settings).mu_ratio)
        return {"mu_ratio": result}

    return [
        compare(
            f"sweep of {PREDICTIONS} predictions",
            f"{PREDICTIONS - 1} smooth contacts",
            "mu_ratio",
            lambda: ratios(keep=True),
            lambda: ratios(keep=False),
            0.0,
        )
    ]


PROBLEMS: dict[str, Callable[[int], list[Row]]] = {
    "smooth": smooth_problem,
    "wave": wave_problem,
    "fractal": fractal_problem,
    "predict": prediction_problem,
}
"""Problems by name; each takes the nodes per side."""


def skip_rows(problems: Sequence[str], points: int) -> list[Row]:
    """Measure times with and without the skipped work, and the difference of the results.

    `problems` are names in `PROBLEMS`, `points` nodes per side.
    """
    return [row for name in problems for row in PROBLEMS[name](points)]


def work(args: argparse.Namespace) -> Row:
    """Measure and print."""
    rows = skip_rows(args.problems, max(args.points))
    show(rows, COLUMNS, MEANING)
    return {"rows": rows}


def main(words: Sequence[str] | None = None) -> int:
    """Run the script; exit status 1 if skipped work would change a result."""
    made = parser(__doc__, points=(MIN_POINTS,))
    add_list(made, "problems", list(PROBLEMS), known=list(PROBLEMS))
    return measure(work, made, words)


if __name__ == "__main__":
    sys.exit(main())
