# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl bench smooth``: the time of smooth solves, the error of their film, their memory."""

from __future__ import annotations

import json
import math
import resource
import statistics
import subprocess
import sys
import time
from collections.abc import Sequence
from typing import Any

import numpy as np

from pyehl.bench.unit import unit_seconds
from pyehl.case import Case
from pyehl.solver import Solver

__all__ = ["COLUMNS", "MEANING", "exponents", "smooth_rows", "solve_once"]

SMOOTH_CASE = "&contact moes_m = {m} moes_l = {l} /"
# A solve in a process of its own, so that its peak memory is its own
CHILD = (
    "import json, sys; from pyehl.bench import smooth; "
    "print(json.dumps(smooth.solve_once(sys.stdin.read())))"
)

COLUMNS = (
    ("points", "d"),
    ("engine", "s"),
    ("threads", "d"),
    ("status", "s"),
    ("cycles", "d"),
    ("seconds", ".3f"),
    ("units", ".2f"),
    ("H_c", ".6f"),
    ("error", ".1e"),
    ("estimated_error", ".1e"),
    ("algebraic_error", ".1e"),
    ("peak_megabytes", ".0f"),
)
MEANING = (
    "seconds: start to end, all grids of the nested iteration; units: of one scipy.fft deflection "
    "at that grid;\nerror: of H_c against the limit of the two finest grids; peak memory: the "
    "whole process with Python"
)
"""What the columns are."""


def peak_megabytes() -> float:
    """Largest memory that this process has had."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0


def solve_once(text: str) -> dict[str, Any]:
    """Solve a case in this process; seconds, summary, peak memory of the whole process."""
    case = Case.from_text(text)
    began = time.perf_counter()
    with Solver(case) as solver:
        solver.run()
        seconds = time.perf_counter() - began
        return {
            "seconds": seconds,
            "summary": solver.summary(),
            "peak_megabytes": peak_megabytes(),
        }


def _solve_apart(text: str) -> dict[str, Any]:
    done = subprocess.run(
        [sys.executable, "-P", "-c", CHILD], input=text, capture_output=True, text=True, check=True
    )
    answer: dict[str, Any] = json.loads(done.stdout)
    return answer


def smooth_rows(
    grids: Sequence[int],
    threads: Sequence[int],
    engines: Sequence[str],
    moes_m: float,
    moes_l: float,
    repeats: int = 3,
) -> list[dict[str, Any]]:
    """Time of the smooth solve per grid, its error of H_c, and peak memory.

    The error is relative to the value extrapolated from the two finest grids of this run, hence
    independent of the estimate that the solver gives of it.
    """
    rows: list[dict[str, Any]] = []
    for points in grids:
        unit = unit_seconds(points)
        for engine in engines:
            for workers in threads:
                text = (
                    f"{SMOOTH_CASE.format(m=moes_m, l=moes_l)}\n&grid points = {points} /\n"
                    f"&solver deflection = '{engine}' threads = {workers} /\n"
                )
                answers = [_solve_apart(text) for _ in range(repeats)]
                summary = answers[0]["summary"]
                seconds = statistics.median(answer["seconds"] for answer in answers)
                rows.append(
                    {
                        "points": points,
                        "engine": engine,
                        "threads": workers,
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
                )
    _add_true_errors(rows)
    return rows


def _over(value: float | None, scale: float | None) -> float | None:
    return None if value is None or not scale else abs(value / scale)


def _add_true_errors(rows: list[dict[str, Any]]) -> None:
    """Errors of H_c against the limit of the two finest grids, of second order."""
    for engine in {row["engine"] for row in rows}:
        films = {
            row["points"]: row["H_c"]
            for row in rows
            if row["engine"] == engine and row["H_c"] is not None
        }
        finest = sorted(films)[-2:]
        limit = math.nan
        if len(finest) == 2:
            ratio = ((finest[1] - 1) / (finest[0] - 1)) ** 2
            limit = (ratio * films[finest[1]] - films[finest[0]]) / (ratio - 1.0)
        for row in rows:
            if row["engine"] == engine:
                film = row["H_c"]
                known = film is not None and math.isfinite(limit)
                row["error"] = abs(film / limit - 1.0) if known else None


def exponents(rows: Sequence[dict[str, Any]]) -> dict[str, float]:
    """Slope of log time over log nodes from 129^2 on, per engine and number of threads."""
    slopes = {}
    for engine, threads in sorted({(row["engine"], row["threads"]) for row in rows}):
        chosen = [
            (2.0 * math.log(row["points"]), math.log(row["seconds"]))
            for row in rows
            if (row["engine"], row["threads"]) == (engine, threads) and row["points"] >= 129
        ]
        if len(chosen) >= 2:
            x, y = np.array(chosen).T
            slopes[f"{engine}, threads {threads}"] = float(np.polyfit(x, y, 1)[0])
    return slopes
