# SPDX-License-Identifier: BSD-3-Clause
"""The verb ``pyehl bench``: time and error side by side, in one run on one machine.

The unit of time is one elastic deflection by scipy.fft at the same grid: zero-padded, real,
float64, one worker, kernel transformed beforehand. Every time stands beside its error.
"""

from __future__ import annotations

import argparse
import json
import math
import platform
import resource
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import scipy.fft
from numpy.typing import NDArray

from pyehl import core
from pyehl.case import Case
from pyehl.errors import InputError

__all__ = [
    "ScipyDeflection",
    "add_arguments",
    "deflection_rows",
    "execute",
    "hertz",
    "median_seconds",
    "smooth_rows",
]

Array = NDArray[np.float64]

X_INLET, X_OUTLET, Y_EXTENT = -2.5, 1.5, 2.0
GRIDS = (65, 129, 257, 513, 1025)
# Direct summation costs N^2; larger grids would take minutes
LARGEST_DIRECT = 129
# Share of the discretisation error that the error of a deflection may have
SHARE = 0.1
SMOOTH_CASE = "&contact moes_m = {m} moes_l = {l} /"


def kernel(nx: int, ny: int, hx: float, hy: float) -> Array:
    """(2/pi^2) times the integral of 1/r over a cell at offsets (i hx, j hy), shape (nx, ny)."""
    x = (np.arange(nx + 1) - 0.5)[:, None] * hx
    y = (np.arange(ny + 1) - 0.5)[None, :] * hy
    r = np.hypot(x, y)
    corner = x * np.arcsinh(y / np.abs(x)) + y * np.arcsinh(x / np.abs(y))
    assert np.isfinite(r).all()
    cells: Array = corner[1:, 1:] - corner[:-1, 1:] - corner[1:, :-1] + corner[:-1, :-1]
    return 2.0 / np.pi**2 * cells


class ScipyDeflection:
    """Zero-padded circular convolution by scipy.fft, the yardstick of all times."""

    def __init__(self, nx: int, ny: int, hx: float, hy: float) -> None:
        self.shape = nx, ny
        self.padded = tuple(scipy.fft.next_fast_len(2 * n - 1, real=True) for n in (nx, ny))
        quarter = kernel(nx, ny, hx, hy)
        whole = np.zeros(self.padded)
        whole[:nx, :ny] = quarter
        whole[-nx + 1 :, :ny] = quarter[:0:-1, :]
        whole[:, -ny + 1 :] = whole[:, ny - 1 : 0 : -1]
        self.transform = scipy.fft.rfft2(whole, workers=1)

    def apply(self, p: Array) -> Array:
        """Deflection of p, shape (nx, ny)."""
        transform = scipy.fft.rfft2(p, s=self.padded, workers=1)
        transform *= self.transform
        w: Array = scipy.fft.irfft2(transform, s=self.padded, workers=1)
        return w[: self.shape[0], : self.shape[1]]


def median_seconds(call: Callable[[], object], least: float = 0.3) -> float:
    """Median time of a call, repeated at least three times and for `least` seconds."""
    call()
    times: list[float] = []
    while len(times) < 3 or sum(times) < least:
        began = time.perf_counter()
        call()
        times.append(time.perf_counter() - began)
    return statistics.median(times)


def peak_megabytes() -> float:
    """Largest memory that this process has had."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0


def hertz(points: int) -> tuple[Array, float, Array, NDArray[np.bool_]]:
    """Hertz pressure on a grid, its mesh size, the exact deflection, and where that holds."""
    x = np.linspace(X_INLET, X_OUTLET, points)
    y = np.linspace(-Y_EXTENT, Y_EXTENT, points)
    r2 = x[:, None] ** 2 + y[None, :] ** 2
    return np.sqrt(np.maximum(0.0, 1.0 - r2)), float(x[1] - x[0]), 1.0 - 0.5 * r2, r2 < 1.0


def deflection_rows(grids: Sequence[int], threads: Sequence[int]) -> list[dict[str, Any]]:
    """Time and error of every engine on every grid, whole and half domain.

    The error is relative to the largest deflection, against the sum that all engines
    approximate (made by scipy.fft to rounding); the discretisation error is that of the sum
    against the analytic deflection of the Hertz pressure, 1 - r^2/2.
    """
    rows: list[dict[str, Any]] = []
    for points in grids:
        p, h, exact, inside = hertz(points)
        yardstick = ScipyDeflection(points, points, h, h)
        unit = median_seconds(lambda p=p, y=yardstick: y.apply(p))  # type: ignore[misc]
        reference = yardstick.apply(p)
        scale = reference.max()
        discretisation = float(np.abs(reference - exact)[inside].max() / scale)
        rows.append(
            {
                "points": points,
                "engine": "scipy.fft",
                "domain": "whole",
                "threads": 1,
                "seconds": unit,
                "units": 1.0,
                "error": 0.0,
                "share": 0.0,
                "discretisation": discretisation,
                "megabytes": yardstick.transform.nbytes / 1e6,
            }
        )
        for engine in ("mlmi", "fft", "direct"):
            if engine == "direct" and points > LARGEST_DIRECT:
                continue
            for half in (False, True):
                first = points // 2 if half else 0
                rows += [
                    _deflection_row(
                        engine, p[:, first:], reference[:, first:], h, half, n, unit, discretisation
                    )
                    for n in threads
                ]
    return rows


def _deflection_row(
    engine: str,
    p: Array,
    reference: Array,
    h: float,
    half: bool,
    threads: int,
    unit: float,
    discretisation: float,
) -> dict[str, Any]:
    def call(repeats: int) -> core.Deflection:
        return core.deflection(
            p,
            h,
            h,
            engine,
            mirror=half,
            accuracy=SHARE * discretisation,
            threads=threads,
            repeats=repeats,
        )

    first = call(1)
    repeats = max(1, min(20, round(0.1 / max(first.seconds, 1e-6))))
    seconds = statistics.median(call(repeats).seconds for _ in range(3))
    error = float(np.abs(first.values - reference).max() / reference.max())
    return {
        "points": p.shape[0],
        "engine": engine,
        "domain": "half" if half else "whole",
        "threads": threads,
        "seconds": seconds,
        "units": seconds / unit,
        "error": error,
        "share": error / discretisation,
        "discretisation": discretisation,
        "megabytes": first.bytes / 1e6,
    }


def solve_once(text: str) -> dict[str, Any]:
    """Solve a case in this process; seconds, summary, peak memory of the whole process."""
    case = Case.from_text(text)
    began = time.perf_counter()
    with core.Solver.open(case) as solver:
        solver.run()
        seconds = time.perf_counter() - began
        return {
            "seconds": seconds,
            "summary": solver.summary(),
            "peak_megabytes": peak_megabytes(),
        }


# A solve in a process of its own, so that its peak memory is its own
CHILD = (
    "import json, sys; from pyehl import bench; "
    "print(json.dumps(bench.solve_once(sys.stdin.read())))"
)


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
        p, h, _, _ = hertz(points)
        yardstick = ScipyDeflection(points, points, h, h)
        unit = median_seconds(lambda p=p, y=yardstick: y.apply(p))  # type: ignore[misc]
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
                        "estimated_error": _over(summary["H_c_error"], summary["H_c"]),
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


def table(rows: Sequence[dict[str, Any]], columns: Sequence[tuple[str, str]]) -> str:
    """Rows as text; columns are (name, format)."""

    def cell(value: object, form: str) -> str:
        return "-" if value is None else format(value, form)

    lines = [[name.replace("_", " ") for name, _ in columns]]
    lines += [[cell(row[name], form) for name, form in columns] for row in rows]
    widths = [max(len(line[k]) for line in lines) for k in range(len(columns))]
    return "\n".join(
        "  ".join(text.rjust(width) for text, width in zip(line, widths, strict=True))
        for line in lines
    )


DEFLECTION_COLUMNS = (
    ("points", "d"),
    ("engine", "s"),
    ("domain", "s"),
    ("threads", "d"),
    ("seconds", ".5f"),
    ("units", ".3f"),
    ("error", ".1e"),
    ("share", ".3f"),
    ("discretisation", ".1e"),
    ("megabytes", ".1f"),
)
SMOOTH_COLUMNS = (
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


def _machine() -> dict[str, str]:
    model = ""
    information = Path("/proc/cpuinfo")
    if information.is_file():
        for line in information.read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                model = line.partition(":")[2].strip()
                break
    return {"processor": model or platform.processor(), "build": core.build()}


def _numbers(text: str) -> list[int]:
    try:
        return [int(word) for word in text.split(",")]
    except ValueError as error:
        raise argparse.ArgumentTypeError(f"'{text}' is not like 129,257") from error


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of ``pyehl bench``."""
    parser.add_argument("what", choices=("deflection", "smooth", "step"), help="what to measure")
    parser.add_argument(
        "--points",
        type=_numbers,
        metavar="N,N,...",
        help="default: 65 to 1025; of 'step' 129,257,513",
    )
    parser.add_argument("--threads", type=_numbers, default=[1, 2], metavar="N,N,...")
    parser.add_argument("--engines", default="mlmi,fft", help="of 'smooth' (default: mlmi,fft)")
    parser.add_argument("--moes-m", type=float, default=1000.0, help="of 'smooth' (default 1000)")
    parser.add_argument("--moes-l", type=float, default=10.0, help="of 'smooth' (default 10)")
    parser.add_argument(
        "--cases", default="wave,fractal", help="of 'step': wave of Fig. 2, fractal of Table 1"
    )
    parser.add_argument("--scheme", choices=("narrow", "paper"), default="narrow", help="of 'step'")
    parser.add_argument("--steps", type=int, default=12, help="timed, of 'step' (default 12)")
    parser.add_argument(
        "--front",
        type=float,
        default=1.05,
        metavar="X",
        help="of 'step': X of the front of the roughness when the timed steps begin; 1.05, where "
        "the contact is full, takes many steps on fine grids",
    )
    parser.add_argument(
        "--error",
        action="store_true",
        help="of 'step': whole marches too, for the error of mu_r/mu_s against the finest grid",
    )
    parser.add_argument("-o", "--output", type=Path, metavar="FILE.json", help="write JSON too")


def _execute_step(args: argparse.Namespace, answer: dict[str, Any]) -> list[dict[str, Any]]:
    from pyehl import bench_step  # noqa: PLC0415 (it imports this module)

    names = args.cases.split(",")
    known = {scene.name for scene in bench_step.CASES}
    if not set(names) <= known or args.steps < 1:
        raise InputError(f"pyehl bench step: cases must be of {sorted(known)}, steps 1 or more")
    scenes = [scene for scene in bench_step.CASES if scene.name in names]
    rows = bench_step.step_rows(
        args.points,
        args.threads,
        scenes=scenes,
        scheme=args.scheme,
        front=args.front,
        steps=args.steps,
    )
    answer |= {"scheme": args.scheme, "front": args.front, "steps": args.steps}
    if args.error:
        whole = bench_step.error_rows(
            args.points, max(args.threads), scheme=args.scheme, scenes=scenes
        )
        answer["marches"] = whole
        errors = {(row["points"], row["case"]): row["error"] for row in whole}
        for row in rows:
            row["error"] = errors.get((row["points"], row["case"]))
        print(table(whole, bench_step.MARCH_COLUMNS))
        print()
    print(table(rows, bench_step.COLUMNS))
    print(
        f"scheme '{args.scheme}'; seconds: of a step, median of {args.steps} after the front of "
        f"the roughness has come to X = {args.front:g};\nunits: of one scipy.fft deflection at "
        "that grid; cycles: of a step, mean; error: of the mean of mu_r/mu_s against the finest "
        "grid (--error)"
    )
    return rows


def execute(args: argparse.Namespace) -> int:
    """Run ``pyehl bench``."""
    if args.points is None:
        args.points = [n for n in GRIDS if args.what != "step" or 129 <= n <= 513]
    if min(args.points) < 3 or min(args.threads) < 1:
        raise InputError("pyehl bench: points must be 3 or more, threads 1 or more")
    answer: dict[str, Any] = {"what": args.what, "machine": _machine()}
    if args.what == "deflection":
        rows = deflection_rows(args.points, args.threads)
        print(table(rows, DEFLECTION_COLUMNS))
        print(
            "seconds: one application; units: of one scipy.fft deflection at that grid; error: "
            "relative to the largest deflection;\nshare: of the discretisation error of the sum; "
            "half: Y >= 0 of a symmetric pressure"
        )
    elif args.what == "step":
        rows = _execute_step(args, answer)
    else:
        rows = smooth_rows(
            args.points, args.threads, args.engines.split(","), args.moes_m, args.moes_l
        )
        answer["exponents"] = exponents(rows)
        answer["moes_m"], answer["moes_l"] = args.moes_m, args.moes_l
        print(f"smooth contact, M = {args.moes_m}, L = {args.moes_l}")
        print(table(rows, SMOOTH_COLUMNS))
        for name, slope in answer["exponents"].items():
            print(f"time grows with the number of nodes to the power {slope:.2f} ({name})")
        print(
            "seconds: start to end, all grids of the nested iteration; units: of one scipy.fft "
            "deflection at that grid;\nerror: of H_c against the limit of the two finest grids; "
            "peak memory: the whole process with Python"
        )
    answer["rows"] = rows
    if args.output is not None:
        args.output.write_text(json.dumps(answer, indent=2) + "\n", encoding="utf-8")
    return 0
