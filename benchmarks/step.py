# SPDX-License-Identifier: BSD-3-Clause
"""Time of a step of a transient run, and the error of its friction ratio.

Every case runs once with the largest number of threads until the front of the roughness has reached
``--front``, by default until it fills the contact; its checkpoint is then resumed with each number
of threads for the same few steps, one step of each in turn. The unit of time is one scipy.fft
deflection on the same grid, measured after each turn.
"""

import argparse
import contextlib
import statistics
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

from common import (
    GRIDS,
    ScipyDeflection,
    add_list,
    add_number,
    columns,
    hertz,
    measure,
    parser,
    say,
    show,
)

from pyehl.case import Case
from pyehl.errors import EhlError
from pyehl.solver import Solver
from pyehl.types import Row

# X of the front when the roughness fills the contact
FILLED = 1.05
# Number of steps measured; their cycles vary over a period of the wave, which has points/8 steps
STEPS = 64
# Relative change of the mean at which the runs for the error end
TOLERANCE = 5e-4


@dataclass(frozen=True, slots=True)
class Problem:
    """A run to be measured: its name, whole or half domain, and its case.

    `beside` names a problem that is measured together with it, a step of each in turn.
    """

    name: str
    domain: str
    text: str
    beside: str = ""


WAVE = "&surface kind = 'harmonic' amplitude = 9.734e-3 wavelength = 0.5 velocity_ratio = 1.01 /\n"
FRACTAL = "&surface kind = 'fractal' /\n"
SECOND = "&second_surface kind = 'fractal' seed = 2 /\n"
LAW = "&lubricant shear_law = 'eyring' /\n"
CIRCLE = "&contact moes_m = 1000.0 moes_l = 10.0 /\n"
# An ellipse of kappa = 2 with the same equations as the circle
ELLIPSE = "&contact moes_m = 2357.0 moes_l = 10.3 radius_ratio = 0.35177 /\n"
# A strip of width 2 b, measured beside the circle with the same wave
LINE = "&contact shape = 'line' moes_m_line = 100.0 moes_l_line = 10.0 /\n"
LONG_WAVE = (
    "&surface kind = 'harmonic' amplitude = 9.734e-3 wavelength_x = 0.5 wavelength_y = 2.0\n"
    "velocity_ratio = 1.01 /\n"
)
WHOLE = "&solver symmetry = 'full' /\n"
# Wave of Fig. 2 of Zhang et al. 2019, fractal surface of Table 1. The contact with a shear law is
# that of Table 1, which has nearly the same Moes numbers.
CASES = (
    Problem("wave", "whole", CIRCLE + WAVE + WHOLE),
    Problem("wave", "half", CIRCLE + WAVE),
    Problem("fractal", "whole", FRACTAL),
    Problem("wave-law", "half", WAVE + LAW, "wave"),
    Problem("wave-ellipse", "half", ELLIPSE + WAVE, "wave"),
    Problem("fractal-law", "whole", FRACTAL + LAW, "fractal"),
    Problem("two-fractals", "whole", FRACTAL + SECOND, "fractal"),
    Problem("long-wave", "whole", CIRCLE + LONG_WAVE + WHOLE),
    Problem("long-wave", "half", CIRCLE + LONG_WAVE),
    Problem("strip", "whole", LINE + LONG_WAVE + WHOLE, "long-wave"),
    Problem("strip", "half", LINE + LONG_WAVE, "long-wave"),
)
# Cases that are measured by default
USUAL = ("wave", "fractal")

COLUMNS = columns(
    "points:d case:s domain:s threads:d seconds:.4f units:.2f ratio:.2f speedup:.2f "
    "cycles:.2f error:.1e"
)

RUN_COLUMNS = columns(
    "points:d case:s threads:d status:s steps:d seconds:.1f mu_ratio:.5f error:.1e"
)


def meaning(scheme: str, front: float, steps: int) -> str:
    """Describe the columns for the arguments of :func:`step_rows`."""
    return (
        f"scheme '{scheme}'; seconds, cycles: of a step, mean of {steps} after the front of the "
        f"roughness has come to X = {front:g};\nunits: of one scipy.fft deflection at that grid; "
        "ratio: of the seconds per node to those of the plain problem, steps in turn; "
        "speedup: of a step, median; error: of the mean of mu_r/mu_s against the finest grid "
        "(--error)"
    )


def _case(problem: Problem, points: int, scheme: str, *options: str) -> Case:
    return Case.from_text(
        problem.text,
        [
            f"grid.points={points}",
            f"time.scheme={scheme}",
            "time.estimate_error=.false.",
            "output.checkpoint_interval=1e6",
            *options,
        ],
    )


def _fill(solver: Solver, case: Case, front: float) -> None:
    """Advance until the front of the roughness is at X = front."""
    settings = case.resolve()["surface"]
    end = (front - float(settings["x_start"])) / float(settings["velocity_ratio"])
    while not solver.done:
        solver.advance()
        if float(solver.summary.get("T", -1.0)) >= end:
            return
    raise EhlError(f"the run ended before it could be timed: {solver.progress}")


def step_rows(
    grids: Sequence[int],
    threads: Sequence[int],
    *,
    problems: Sequence[Problem] = CASES,
    scheme: str = "narrow",
    front: float = FILLED,
    steps: int = STEPS,
) -> list[Row]:
    """Measure mean time and cycles of a step by grid, case and number of threads.

    The speed-up is the median over the steps of the ratio to the first number of threads. The
    measured steps begin when the front of the roughness has reached X = `front`.
    """
    rows: list[Row] = []
    for points in grids:
        pressure, h, _, _ = hertz(points)
        deflect = partial(ScipyDeflection(points, points, h, h).apply, pressure)
        of_grid: list[Row] = []
        units: list[float] = []
        for problem in problems:
            say(f"{points} {problem.name} {problem.domain}")
            of_grid += _rows_of(problem, points, threads, (scheme, front, steps), deflect, units)
        unit = statistics.median(units)
        rows += [row | {"unit_seconds": unit, "units": row["seconds"] / unit} for row in of_grid]
    return rows


def _rows_of(
    problem: Problem,
    points: int,
    threads: Sequence[int],
    options: tuple[str, float, int],
    deflect: Callable[[], object],
    units: list[float],
) -> list[Row]:
    scheme, front, steps = options
    rows: list[Row] = []
    plain = [s for s in CASES if (s.name, s.domain) == (problem.beside, problem.domain)]
    with contextlib.ExitStack() as stack:
        solvers = []
        for one in (problem, *plain):
            case = _case(
                one, points, scheme, f"solver.threads={max(threads)}", "time.steps=10000000"
            )
            solvers += _filled(case, threads, front, stack)
        before = [solver.summary for solver in solvers]
        times: list[list[float]] = [[] for _ in solvers]
        # in turn, so that other load on the machine affects them equally
        for _ in range(steps):
            for solver, taken in zip(solvers, times, strict=True):
                began = time.perf_counter()
                solver.advance()
                taken.append(time.perf_counter() - began)
            began = time.perf_counter()
            deflect()
            units.append(time.perf_counter() - began)
        after = [solver.summary for solver in solvers]
    per_node = [
        statistics.fmean(taken) / end.get("points_y", points)
        for taken, end in zip(times, after, strict=True)
    ]
    for k, workers in enumerate(threads):
        if after[k]["steps"] - before[k]["steps"] != steps:
            raise EhlError(
                f"{points} {problem.name}: a step did not converge: {after[k]['status']}"
            )
        cycles = after[k]["steps"] * after[k]["cycles_per_step"]
        cycles -= before[k]["steps"] * before[k]["cycles_per_step"]
        ratios = [one / now for one, now in zip(times[0], times[k], strict=True)]
        rows.append(
            {
                "points": points,
                "case": problem.name,
                "domain": problem.domain,
                "threads": workers,
                "seconds": statistics.fmean(times[k]),
                "seconds_of_steps": times[k],
                "ratio": per_node[k] / per_node[len(threads) + k] if plain else None,
                "speedup": statistics.median(ratios),
                "cycles": cycles / steps,
                "error": None,
            }
        )
    return rows


def _filled(
    case: Case, threads: Sequence[int], front: float, stack: contextlib.ExitStack
) -> list[Solver]:
    """Make a solver for each number of threads, all resumed with the front at X = front."""
    solvers = []
    with tempfile.TemporaryDirectory() as folder:
        place = f"{folder}/state"
        with Solver(case) as solver:
            solver.checkpoint(place)
            _fill(solver, case, front)
            solver.save_state(at_once=True)
        for workers in threads:
            solver = stack.enter_context(Solver(case.with_options(f"solver.threads={workers}")))
            solver.resume(place)
            while "steps" not in solver.summary and not solver.done:
                solver.advance()
            solvers.append(solver)
    return solvers


def error_rows(
    grids: Sequence[int],
    threads: int,
    *,
    scheme: str = "narrow",
    problems: Sequence[Problem] = CASES,
) -> list[Row]:
    """Mean of mu_r/mu_s from complete runs, and its relative difference from the finest grid.

    A symmetric problem runs on the half domain only.
    """
    rows: list[Row] = []
    chosen = {problem.name: problem for problem in problems}
    chosen |= {problem.name: problem for problem in problems if problem.domain == "half"}
    for problem in chosen.values():
        means: dict[int, float] = {}
        for points in sorted(grids):
            say(f"{points} {problem.name}, whole run")
            options = f"solver.threads={threads}", f"time.tolerance={TOLERANCE}"
            case = _case(problem, points, scheme, *options)
            began = time.perf_counter()
            with Solver(case) as solver:
                solver.run()
                summary = solver.summary
            row: Row = {"points": points, "case": problem.name, "threads": threads, "error": None}
            row["seconds"] = time.perf_counter() - began
            row |= {name: summary[name] for name in ("status", "steps", "mu_ratio")}
            if row["mu_ratio"] is not None:
                means[points] = row["mu_ratio"]
            rows.append(row)
        finest = max(means, default=0)
        for row in rows:
            if row["case"] == problem.name and row["points"] in means and row["points"] < finest:
                row["error"] = abs(means[row["points"]] / means[finest] - 1.0)
    return rows


def work(args: argparse.Namespace) -> Row:
    """Measure and print."""
    problems = [problem for problem in CASES if problem.name in args.cases]
    rows = step_rows(
        args.points,
        args.threads,
        problems=problems,
        scheme=args.scheme,
        front=args.front,
        steps=args.steps,
    )
    answer: Row = {"scheme": args.scheme, "front": args.front, "steps": args.steps, "rows": rows}
    if args.error:
        runs = error_rows(args.points, max(args.threads), scheme=args.scheme, problems=problems)
        errors = {(row["points"], row["case"]): row["error"] for row in runs}
        for row in rows:
            row["error"] = errors.get((row["points"], row["case"]))
        show(runs, RUN_COLUMNS, "")
        answer["runs"] = runs
    show(rows, COLUMNS, meaning(args.scheme, args.front, args.steps))
    return answer


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the script."""
    made = parser(__doc__, points=GRIDS[1:4], threads=(1, 2))
    names = list(dict.fromkeys(problem.name for problem in CASES))
    add_list(made, "cases", USUAL, "; wave: of Fig. 2, fractal: of Table 1", names)
    made.add_argument("--scheme", choices=("narrow", "paper"), default="narrow")
    add_number(made, "steps", STEPS, "timed steps", minimum=1)
    front = "X of the front of the roughness when the timed steps begin; filling the contact takes "
    add_number(made, "front", FILLED, f"{front}many steps on fine grids")
    made.add_argument(
        "--error",
        action="store_true",
        help="whole runs too, for the error of mu_r/mu_s against the finest grid",
    )
    return measure(work, made, arguments)


if __name__ == "__main__":
    sys.exit(main())
