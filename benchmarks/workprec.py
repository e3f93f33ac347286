# SPDX-License-Identifier: BSD-3-Clause
"""Work-precision: error against processor time and work units, and the cheapest settings.

Every setting is one run. The unit, one scipy.fft deflection on the same grid, is measured before
the runs on a grid. The reference of the errors is extrapolated from the two finest grids with the
narrow scheme; its error bar is its change by the finest grid.
"""

import argparse
import itertools
import math
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from common import add_list, columns, measure, parser, processor_seconds, say, show, unit_seconds
from figures import draw_work

from pyehl.case import Case
from pyehl.prediction.predict import predict
from pyehl.solver import Solver
from pyehl.types import Row

COLUMNS = columns(
    "problem:s quantity:s setting:s points:d threads:d seconds:.3f units:.1f value:.6g "
    "error:.1e bar:.0e estimate:.1e"
)
POINT = ("contact.moes_m=1000.0", "contact.moes_l=10.0")
WAVE = (
    *POINT,
    "surface.kind=harmonic",
    "surface.amplitude=9.734e-3",
    "surface.velocity_ratio=1.01",
)
RATIO = ("mu_ratio",)
# Variations of the default, one at a time; those after the first two only for rough contacts
SETTINGS: tuple[tuple[str, tuple[str, ...]], ...] = (
    ("default", ()),
    ("fft", ("solver.deflection=fft",)),
    ("paper", ("time.scheme=paper",)),
    ("alcouffe", ("solver.coarsening=alcouffe",)),
    ("classical", ("solver.coarsening=classical",)),
)
LEVELS = (0.03, 0.01, 0.003, 0.001)
"""Errors for which the cheapest setting is searched."""
ORDER = 2
"""Order of the discretisation, for Richardson extrapolation."""


@dataclass(frozen=True, slots=True)
class Problem:
    """A problem to be solved with all settings."""

    name: str
    options: tuple[str, ...]  # its case, as options ``group.key=value``
    quantities: tuple[str, ...]  # quantities whose error is measured
    # Nodes per side; the last grid only with ``--full``, for the reference (of a rough contact at
    # default settings)
    grids: tuple[int, ...]
    rough: bool = True  # whether schemes, coarsenings and the prediction apply


PROBLEMS = (
    Problem("smooth", POINT, ("H_c", "H_min", "F"), (65, 129, 257, 513, 1025, 2049), rough=False),
    Problem("wave", WAVE, RATIO, (129, 257, 513, 1025)),
    Problem(
        "resolved fractal",
        ("surface.kind=fractal", "surface.shortest_wavelength=5.2e-5"),
        RATIO,
        (129, 257, 513, 1025),
    ),
    Problem("fractal", ("surface.kind=fractal",), RATIO, (129, 257, 513, 1025)),
)


def work_rows(
    problems: Sequence[str],
    *,
    grids: Sequence[int] = (),
    threads: Sequence[int] = (1, 2),
    full: bool = False,
) -> list[Row]:
    """Run all settings of problems, by their names in `PROBLEMS`.

    `grids`: nodes per side instead of those of the problem; `full`: include the finest of these.
    Only the default setting runs with the numbers of threads after the first. Rows have `COLUMNS`
    and `unit_seconds`; `error` is relative to the reference, `bar` is the error of the reference,
    `estimate` the error that the run states.
    """
    rows: list[Row] = []
    for problem in (problem for problem in PROBLEMS if problem.name in problems):
        used = grids or (problem.grids if full else problem.grids[:-1])
        mine: list[Row] = []
        for points in used:
            unit = unit_seconds(points)
            # the finest grid serves only as the reference
            reference = problem.rough and full and points == problem.grids[-1]
            for setting, options in SETTINGS if problem.rough else SETTINGS[:2]:
                if reference and options:
                    continue
                for workers in threads[:1] if reference or options else threads:
                    say(f"{problem.name}: {points} x {points}, {setting}, threads {workers}")
                    mine += _run(problem, setting, options, points, workers, unit)
        if problem.rough:
            mine += _predicted(problem, unit_seconds(max(used)))
        mine += extrapolated(mine)
        add_errors(mine, problem.quantities)
        rows += mine
    return rows


def _run(
    problem: Problem, setting: str, options: Sequence[str], points: int, threads: int, unit: float
) -> list[Row]:
    texts = [*problem.options, *options, f"grid.points={points}", f"solver.threads={threads}"]
    if problem.rough:
        # the coarser run is a separate row
        texts.append("time.estimate_error=.false.")
    began = processor_seconds()
    with Solver(Case.from_text("", texts)) as solver:
        solver.run()
        seconds = processor_seconds() - began
        summary = solver.summary
    row: Row = {"problem": problem.name, "setting": setting, "points": points, "threads": threads}
    row |= {"seconds": seconds, "units": seconds / unit, "unit_seconds": unit}
    row["status"] = summary["status"]
    rows = []
    for quantity in problem.quantities:
        value, error = summary.get(quantity), summary.get(f"{quantity}_error")
        estimate = abs(error / value) if error and value else None
        rows.append(row | {"quantity": quantity, "value": value, "estimate": estimate})
    return rows


def _predicted(problem: Problem, unit: float) -> list[Row]:
    """Return the row of the prediction, as one more setting; its unit is of the finest grid."""
    if problem.name == "wave":
        # the prediction needs heights in metres, which this case does not have
        return []
    case = Case.from_text("", problem.options)
    began = processor_seconds()
    result = predict(case.resolve()).summary
    seconds = processor_seconds() - began
    value, model = result["mu_ratio"], result.get("mu_ratio_model_error")
    row: Row = {"problem": problem.name, "setting": "prediction", "points": 257, "threads": 1}
    row |= {"seconds": seconds, "units": seconds / unit, "unit_seconds": unit}
    row |= {"status": result["status"], "quantity": "mu_ratio", "value": value}
    return [row | {"estimate": model / value if model else None}]


def share_of_deflection(points: int = 129) -> Row:
    """Measure the contribution of multi-integration to the error of a short sliding wave.

    `difference` is the relative one of mu_r/mu_s between multi-integration and FFT, `grid_error`
    its discretisation error from the next finer grid, `share` their ratio.
    """
    options = [
        *POINT,
        "surface.kind=harmonic",
        "surface.wavelength=0.25",
        "surface.amplitude=0.003",
        "surface.velocity_ratio=1.1",
        "time.estimate_error=.false.",
    ]

    def ratio(n: int, engine: str) -> float:
        texts = [*options, f"grid.points={n}", f"solver.deflection={engine}"]
        with Solver(Case.from_text("", texts)) as solver:
            solver.run()
            return float(solver.summary["mu_ratio"])

    fast, exact, finer = ratio(points, "mlmi"), ratio(points, "fft"), ratio(2 * points - 1, "fft")
    difference = abs(fast / exact - 1.0)
    grid = abs(4.0 / 3.0 * (exact / finer - 1.0))
    return {
        "points": points,
        "difference": difference,
        "grid_error": grid,
        "share": difference / grid,
    }


def extrapolated(rows: Sequence[Row]) -> list[Row]:
    """Extrapolate from each grid and the next coarser one (Richardson), at the cost of both."""
    result = {(r["quantity"], r["setting"], r["threads"], r["points"]): r for r in rows}
    more = []
    for (quantity, setting, threads, points), fine in result.items():
        coarse = result.get((quantity, setting, threads, (points + 1) // 2))
        if coarse is None or fine["value"] is None or coarse["value"] is None:
            continue
        # for a smooth contact nested iteration solves the coarser grid anyway
        extra = 0.0 if fine["problem"] == "smooth" else coarse["seconds"]
        seconds = fine["seconds"] + extra
        value = fine["value"] + (fine["value"] - coarse["value"]) / (2**ORDER - 1)
        more.append(
            fine
            | {
                "setting": f"{setting}, extrapolated",
                "seconds": seconds,
                "units": seconds / fine["unit_seconds"],
                "value": value,
                "estimate": None,
            }
        )
    return more


def _reference(values: Mapping[int, float]) -> tuple[float, float]:
    """Extrapolate the two finest grids; returns the limit and its relative error."""
    grids = sorted(values)[-3:]
    if len(grids) < 2:
        return math.nan, math.nan
    limits = [
        values[b] + (values[b] - values[a]) / (2**ORDER - 1) for a, b in itertools.pairwise(grids)
    ]
    last = limits[-1]
    bar = abs(last - limits[0]) if len(limits) > 1 else abs(last - values[grids[-1]])
    return last, bar / abs(last)


def add_errors(rows: Sequence[Row], quantities: Sequence[str]) -> None:
    """Add to the rows of a problem `error`, relative to the reference, and `bar`, its own error."""
    for quantity in quantities:
        mine = [row for row in rows if row["quantity"] == quantity]
        values = {
            row["points"]: row["value"]
            for row in mine
            if row["setting"] == "default" and row["value"] is not None
        }
        limit, bar = _reference(values)
        for row in mine:
            known = row["value"] is not None and math.isfinite(limit)
            row["error"] = abs(row["value"] / limit - 1.0) if known else None
            row["bar"] = bar if known else None


def cheapest(rows: Sequence[Row]) -> list[Row]:
    """Return the fastest setting for each of `LEVELS`, by problem and quantity.

    An error below that of the reference counts as the latter.
    """
    result = []
    for problem, quantity in dict.fromkeys((row["problem"], row["quantity"]) for row in rows):
        mine = [
            row
            for row in rows
            if (row["problem"], row["quantity"]) == (problem, quantity) and row["error"] is not None
        ]
        for level in LEVELS:
            good = [row for row in mine if max(row["error"], row["bar"]) <= level]
            best = min(good, key=lambda row: row["seconds"], default=None)
            result.append({"problem": problem, "quantity": quantity, "level": level, "best": best})
    return result


def best_of(row: Row) -> str:
    """Format a row of `cheapest` in a line."""
    best, how = row["best"], "none of these"
    if best is not None:
        how = f"{best['setting']}, {best['points']} x {best['points']}, threads {best['threads']}: "
        how += f"{best['seconds']:.3g} s, error {best['error']:.1e}"
    return f"{row['problem']}, {row['quantity']} to {row['level']:.1%}: {how}"


def work(args: argparse.Namespace) -> Row:
    """Measure, print and draw."""
    rows = work_rows(args.problems, grids=args.points, threads=args.threads, full=args.full)
    best = cheapest(rows)
    show(rows, COLUMNS, *map(best_of, best))
    answer: Row = {"cheapest": best, "rows": rows}
    if "wave" in args.problems:
        share = answer["share_of_deflection"] = share_of_deflection()
        print(
            f"multi-integration, short wave that slides, {share['points']} x {share['points']}: "
            f"{share['difference']:.2%} of mu_r/mu_s, {share['share']:.1%} of the grid error"
        )
    if args.output is not None:
        draw_work(rows, args.output.with_suffix(".png"))
    return answer


def main(words: Sequence[str] | None = None) -> int:
    """Run the script."""
    made = parser(__doc__, threads=(1, 2))
    add_list(made, "points", (), "nodes per side (default: those of each problem)")
    names = [problem.name for problem in PROBLEMS]
    add_list(made, "problems", names, known=names)
    made.add_argument("--full", action="store_true", help="the finest grids too, for reference")
    return measure(work, made, words, picture=True)


if __name__ == "__main__":
    sys.exit(main())
