# SPDX-License-Identifier: BSD-3-Clause
"""Time, film error and memory of smooth solutions."""

import argparse
import json
import math
import resource
import statistics
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from common import GRIDS, add_list, add_number, columns, measure, parser, show, unit_seconds

from pyehl.case import Case
from pyehl.solver import Solver
from pyehl.theory.ellipse import ellipse
from pyehl.types import Row

# The circle with the given Moes numbers; Table 1 with a shear law, whose M and L are nearly the
# defaults; an ellipse of kappa = 2 with the same equations as the circle
CASES = ("circle", "law", "ellipse")
ENGINES = ("mlmi", "fft")
RADIUS_RATIO = 0.35177
# Each solution has its own process, so that its peak memory is known
CHILD = (
    f"import json, sys; sys.path.insert(0, {str(Path(__file__).parent)!r}); import smooth; "
    "print(json.dumps(smooth.solve_once(sys.stdin.read())))"
)

COLUMNS = columns(
    "points:d case:s engine:s threads:d status:s cycles:d seconds:.3f units:.2f ratio:.2f "
    "H_c:.6f error:.1e estimated_error:.1e algebraic_error:.1e peak_megabytes:.0f"
)
MEANING = (
    "seconds: start to end, all grids of the nested iteration; units: of one scipy.fft deflection "
    "at that grid;\nratio: of the seconds per node to those of the first case, solved in turn; "
    "error: of H_c relative to the limit of the two finest grids; peak memory: the "
    "whole process with Python"
)
"""Meaning of the columns."""


def peak_megabytes() -> float:
    """Peak memory of this process."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0


def solve_once(text: str) -> Row:
    """Solve a case in this process; returns time, summary and peak memory of the process."""
    case = Case.from_text(text)
    began = time.perf_counter()
    with Solver(case) as solver:
        solver.run()
        seconds = time.perf_counter() - began
        return {"seconds": seconds, "summary": solver.summary, "peak_megabytes": peak_megabytes()}


def _solve_apart(text: str) -> Row:
    done = subprocess.run(
        [sys.executable, "-P", "-c", CHILD], input=text, capture_output=True, text=True, check=True
    )
    answer: Row = json.loads(done.stdout)
    return answer


def case_text(name: str, moes_m: float, moes_l: float) -> str:
    """Return the text of a case of `CASES`."""
    if name == "law":
        return "&lubricant shear_law = 'eyring' /\n"
    text = f"&contact moes_m = {moes_m} moes_l = {moes_l}"
    if name == "ellipse":
        shape = ellipse(RADIUS_RATIO)
        moes_m *= shape.ellipticity * shape.kernel_ratio**0.25
        moes_l /= shape.kernel_ratio**0.75
        text = f"&contact moes_m = {moes_m} moes_l = {moes_l} radius_ratio = {RADIUS_RATIO}"
    return f"{text} /\n"


def smooth_rows(
    grids: Sequence[int],
    threads: Sequence[int],
    engines: Sequence[str],
    moes_m: float,
    moes_l: float,
    cases: Sequence[str] = CASES[:1],
    repeats: int = 3,
) -> list[Row]:
    """Measure time, error of H_c and peak memory of smooth solutions on each grid.

    The error is relative to the value extrapolated from the two finest grids of this run, hence
    independent of the estimate of the solver. The cases are solved in turn, so that other
    load on the machine affects them equally.
    """
    rows: list[Row] = []
    for points in grids:
        unit = unit_seconds(points)
        for engine in engines:
            for workers in threads:
                how = (
                    f"&grid points = {points} /\n"
                    f"&solver deflection = '{engine}' threads = {workers} /\n"
                )
                texts = [case_text(name, moes_m, moes_l) + how for name in cases]
                turns = [[_solve_apart(text) for text in texts] for _ in range(repeats)]
                first = math.nan
                for name, answers in zip(cases, zip(*turns, strict=True), strict=True):
                    row = _row(points, unit, answers)
                    per_node = row["seconds"] / row.pop("nodes")
                    first = per_node if name == cases[0] else first
                    ratio = per_node / first
                    rows.append(
                        {"case": name, "engine": engine, "threads": workers, "ratio": ratio} | row
                    )
    _add_true_errors(rows)
    return rows


def _row(points: int, unit: float, answers: Sequence[Row]) -> Row:
    summary = answers[0]["summary"]
    seconds = statistics.median(answer["seconds"] for answer in answers)
    return {
        "points": points,
        "nodes": points * summary.get("points_y", points),
        "status": summary["status"],
        "cycles": summary["cycles"],
        "seconds": seconds,
        "units": seconds / unit,
        "unit_seconds": unit,
        "H_c": summary["H_c"],
        "estimated_error": _over(summary["H_c_error_grid"], summary["H_c"]),
        "algebraic_error": _over(summary["H_c_algebraic_error"], summary["H_c"]),
        "peak_megabytes": max(answer["peak_megabytes"] for answer in answers),
    }


def _over(value: float | None, scale: float | None) -> float | None:
    return None if value is None or not scale else abs(value / scale)


def _add_true_errors(rows: list[Row]) -> None:
    """Add errors of H_c against the second-order extrapolation of the two finest grids."""
    for which in {(row["case"], row["engine"]) for row in rows}:
        chosen = [row for row in rows if (row["case"], row["engine"]) == which]
        films = {row["points"]: row["H_c"] for row in chosen if row["H_c"] is not None}
        finest = sorted(films)[-2:]
        limit = math.nan
        if len(finest) == 2:
            ratio = ((finest[1] - 1) / (finest[0] - 1)) ** 2
            limit = (ratio * films[finest[1]] - films[finest[0]]) / (ratio - 1.0)
        for row in chosen:
            film = row["H_c"]
            known = film is not None and math.isfinite(limit)
            row["error"] = abs(film / limit - 1.0) if known else None


def exponents(rows: Sequence[Row]) -> dict[str, float]:
    """Slope of log time over log nodes from 129^2 nodes on, by case, engine and threads."""
    slopes = {}
    names = "case", "engine", "threads"
    for which in sorted({tuple(row[name] for name in names) for row in rows}):
        chosen = [
            (2.0 * math.log(row["points"]), math.log(row["seconds"]))
            for row in rows
            if tuple(row[name] for name in names) == which and row["points"] >= 129
        ]
        if len(chosen) >= 2:
            x, y = np.array(chosen).T
            slopes["{}, {}, threads {}".format(*which)] = float(np.polyfit(x, y, 1)[0])
    return slopes


def work(args: argparse.Namespace) -> Row:
    """Measure and print."""
    rows = smooth_rows(
        args.points, args.threads, args.engines, args.moes_m, args.moes_l, args.cases
    )
    slopes = exponents(rows)
    print(f"smooth contact, M = {args.moes_m}, L = {args.moes_l}")
    notes = [f"time ~ (number of nodes)^{slope:.2f} ({name})" for name, slope in slopes.items()]
    show(rows, COLUMNS, *notes, MEANING)
    return {"exponents": slopes, "moes_m": args.moes_m, "moes_l": args.moes_l, "rows": rows}


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the script."""
    made = parser(__doc__, points=GRIDS, threads=(1, 2))
    add_list(made, "engines", ENGINES, known=ENGINES)
    add_number(made, "moes-m", 1000.0)
    add_number(made, "moes-l", 10.0)
    add_list(made, "cases", CASES[:1], ", each in turn with the first", CASES)
    return measure(work, made, arguments)


if __name__ == "__main__":
    sys.exit(main())
