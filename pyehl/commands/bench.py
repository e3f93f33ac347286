# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl bench``: time and error side by side, in one run on one machine.

Every time stands beside its error. The unit of time is that of `pyehl.bench.unit`.
"""

from __future__ import annotations

import argparse
import json
import platform
import sys
from pathlib import Path
from typing import Any

from pyehl import library
from pyehl.bench import (
    comparison,
    deflection,
    faults,
    skips,
    smooth,
    step,
    stress,
    stress_cases,
    sweep,
    workprec,
)
from pyehl.bench.text import table
from pyehl.errors import InputError
from pyehl.plots import bench as figures

__all__ = ["add_arguments", "execute"]

GRIDS = (65, 129, 257, 513, 1025)
DEFAULT_GRIDS = {
    "step": (129, 257, 513),
    "skips": (skips.LEAST,),
    "stress": stress_cases.GRIDS,
    "workprec": (),
}


def _machine() -> dict[str, str]:
    model = ""
    information = Path("/proc/cpuinfo")
    if information.is_file():
        for line in information.read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                model = line.partition(":")[2].strip()
                break
    return {"processor": model or platform.processor(), "build": library.build()}


def _numbers(text: str) -> list[int]:
    try:
        return [int(word) for word in text.split(",")]
    except ValueError as error:
        raise argparse.ArgumentTypeError(f"'{text}' is not like 129,257") from error


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of ``pyehl bench``."""
    parser.add_argument(
        "what",
        choices=("deflection", "smooth", "step", "sweep", "skips", "stress", "faults", "workprec"),
        help="what to measure",
    )
    parser.add_argument(
        "--points",
        type=_numbers,
        metavar="N,N,...",
        help="default: 65 to 1025; of 'step' 129,257,513; of 'skips' 257; of 'stress' 65,129,257",
    )
    parser.add_argument(
        "--threads",
        type=_numbers,
        default=[1, 2],
        metavar="N,N,...",
        help="of 'sweep': worker processes",
    )
    parser.add_argument(
        "--scenes",
        metavar="NAME,NAME,...",
        help="of 'sweep': "
        + ", ".join(scene.name for scene in sweep.SCENES)
        + "; of 'skips': "
        + ", ".join(skips.SCENES)
        + " (default: all)",
    )
    parser.add_argument("--engines", default="mlmi,fft", help="of 'smooth' (default: mlmi,fft)")
    parser.add_argument("--moes-m", type=float, default=1000.0, help="of 'smooth' (default 1000)")
    parser.add_argument("--moes-l", type=float, default=10.0, help="of 'smooth' (default 10)")
    parser.add_argument(
        "--cases",
        help="of 'step': wave of Fig. 2, fractal of Table 1 (default: wave,fractal); of 'stress': "
        "how many (default 500)",
    )
    parser.add_argument("--scheme", choices=("narrow", "paper"), default="narrow", help="of 'step'")
    parser.add_argument(
        "--steps",
        type=int,
        default=step.STEPS,
        help="timed, of 'step' (default %(default)s)",
    )
    parser.add_argument(
        "--front",
        type=float,
        default=step.FILLED,
        metavar="X",
        help="of 'step': X of the front of the roughness when the timed steps begin; 1.05, where "
        "the contact is full, takes many steps on fine grids",
    )
    parser.add_argument(
        "--error",
        action="store_true",
        help="of 'step': whole runs too, for the error of mu_r/mu_s against the finest grid",
    )
    parser.add_argument("--seed", type=int, default=1, help="of 'stress', 'faults' (default 1)")
    parser.add_argument("--full", action="store_true", help="of 'workprec': the finest grids too")
    parser.add_argument("--kills", type=int, default=200, help="of 'faults' (default 200)")
    parser.add_argument(
        "--inputs", type=int, default=2000, help="mutated ones, of 'faults' (default 2000)"
    )
    parser.add_argument("--jobs", type=int, default=2, help="of 'stress': processes (default 2)")
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="FILE.json",
        help="write JSON too; of 'stress' a folder, in which an interrupted campaign is resumed",
    )


def _execute_step(args: argparse.Namespace, answer: dict[str, Any]) -> list[dict[str, Any]]:
    names = (args.cases or "wave,fractal").split(",")
    known = {scene.name for scene in step.CASES}
    if not set(names) <= known or args.steps < 1:
        raise InputError(f"pyehl bench step: cases must be of {sorted(known)}, steps 1 or more")
    scenes = [scene for scene in step.CASES if scene.name in names]
    rows = step.step_rows(
        args.points,
        args.threads,
        scenes=scenes,
        scheme=args.scheme,
        front=args.front,
        steps=args.steps,
    )
    answer |= {"scheme": args.scheme, "front": args.front, "steps": args.steps}
    if args.error:
        whole = step.error_rows(args.points, max(args.threads), scheme=args.scheme, scenes=scenes)
        answer["runs"] = whole
        errors = {(row["points"], row["case"]): row["error"] for row in whole}
        for row in rows:
            row["error"] = errors.get((row["points"], row["case"]))
        print(table(whole, step.RUN_COLUMNS))
        print()
    print(table(rows, step.COLUMNS))
    print(
        f"scheme '{args.scheme}'; seconds, cycles: of a step, mean of {args.steps} after the front "
        f"of the roughness has come to X = {args.front:g};\nunits: of one scipy.fft deflection at "
        "that grid; speedup: of a step, median; error: of the mean of mu_r/mu_s against the "
        "finest grid (--error)"
    )
    return rows


def _execute_sweep(args: argparse.Namespace) -> list[dict[str, Any]]:
    known = [scene.name for scene in sweep.SCENES]
    names = args.scenes.split(",") if args.scenes else known
    if not set(names) <= set(known):
        raise InputError(f"pyehl bench sweep: scenes must be of {', '.join(known)}")
    scenes = [scene for scene in sweep.SCENES if scene.name in names]
    rows = sweep.sweep_rows(scenes, args.threads)
    print(table(rows, sweep.COLUMNS))
    print(
        "wall seconds: from the start of the workers to the last row; estimate: of the plan; busy: "
        "share of the workers' time that cases took;\noverhead: of a case, in the plan and in one "
        "worker; efficiency: throughput over that of the first number of processes"
    )
    return rows


def _execute_stress(args: argparse.Namespace, answer: dict[str, Any]) -> int:
    count = args.cases or "500"
    if args.output is None or not count.isdigit() or int(count) < 1:
        raise InputError("pyehl bench stress: -o DIR is needed, and 1 or more cases")
    args.output.mkdir(parents=True, exist_ok=True)
    rows = stress.campaign(
        int(count),
        args.seed,
        args.output,
        jobs=args.jobs,
        grids=args.points,
        tell=lambda text: print(text, file=sys.stderr),
    )
    answer |= {"cases": int(count), "seed": args.seed, "points": args.points}
    stress.write(rows, args.output, answer)
    figures.stress(rows, args.output / "stress.png")
    print(table(stress.summary(rows), stress.COLUMNS))
    print(
        "ended: all steps asked for converged; no solution: of the equations, by the second "
        "solver; checked: solved once more to a twentieth\nof the algebraic error; wrong: differs "
        "by more than the error it states; cycles: of a step, or in all"
    )
    return 1 if any(row["wrong"] for row in rows) else 0


def _execute_faults(args: argparse.Namespace, answer: dict[str, Any]) -> int:
    if args.output is None or (args.output.exists() and any(args.output.iterdir())):
        raise InputError("pyehl bench faults: -o DIR is needed, a folder that is empty")
    args.output.mkdir(parents=True, exist_ok=True)
    rows = faults.campaign(
        args.output.resolve(),
        seed=args.seed,
        kills=args.kills,
        inputs=args.inputs,
        tell=lambda text: print(text, file=sys.stderr),
    )
    print(table(rows, faults.COLUMNS))
    answer |= {"seed": args.seed, "rows": rows}
    text = json.dumps(answer, indent=1) + "\n"
    (args.output / "faults.json").write_text(text, encoding="utf-8")
    for row in rows:
        for what in row["bad"]:
            print(f"{row['campaign']}: {what}", file=sys.stderr)
    return 1 if any(row["wrong"] for row in rows) else 0


def _execute_workprec(args: argparse.Namespace, answer: dict[str, Any]) -> int:
    names = [scene.name for scene in workprec.SCENES]
    rows = workprec.work_rows(
        args.scenes.split(",") if args.scenes else names,
        grids=args.points,
        threads=args.threads,
        full=args.full,
        tell=lambda text: print(text, file=sys.stderr),
    )
    print(table(rows, workprec.COLUMNS))
    best = workprec.cheapest(rows)
    for row in best:
        found = row["best"]
        how = "none of these"
        if found is not None:
            how = f"{found['setting']}, {found['points']} x {found['points']}, threads "
            how += f"{found['threads']}: {found['seconds']:.3g} s, error {found['error']:.1e}"
        print(f"{row['scene']}, {row['quantity']} to {row['level']:.1%}: {how}")
    answer |= {"rows": rows, "cheapest": best}
    if args.scenes is None or "wave" in args.scenes:
        share = workprec.share_of_deflection()
        answer["share_of_deflection"] = share
        print(
            f"multi-integration, short wave that slides, {share['points']} x {share['points']}: "
            f"{share['difference']:.2%} of mu_r/mu_s, {share['share']:.1%} of the grid error"
        )
    if args.output is not None:
        args.output.write_text(json.dumps(answer, indent=1) + "\n", encoding="utf-8")
        figures.work(rows, args.output.with_suffix(".png"))
    return 0


def _execute_skips(args: argparse.Namespace) -> list[dict[str, Any]]:
    names = args.scenes.split(",") if args.scenes else list(skips.SCENES)
    rows = skips.skip_rows(names, max(args.points))
    print(table(rows, skips.COLUMNS))
    print(
        "seconds: of the processor, one thread; without: the same with that work "
        "done; difference: in the quantity, relative;\nallowed: 0 where the bits are equal, "
        f"{comparison.ROUNDING:.0e} where sums are taken in another order, else the tolerance of "
        "the solver or of the mean"
    )
    return rows


def execute(args: argparse.Namespace) -> int:
    """Run ``pyehl bench``; 1 if skipped work would have changed a result."""
    if args.points is None:
        args.points = list(DEFAULT_GRIDS.get(args.what, GRIDS))
    if min(args.points, default=3) < 3 or min(args.threads) < 1:
        raise InputError("pyehl bench: points must be 3 or more, threads 1 or more")
    answer: dict[str, Any] = {"what": args.what, "machine": _machine()}
    if args.what == "stress":
        return _execute_stress(args, answer)
    if args.what == "faults":
        return _execute_faults(args, answer)
    if args.what == "workprec":
        return _execute_workprec(args, answer)
    if args.what == "deflection":
        rows = deflection.deflection_rows(args.points, args.threads)
        print(table(rows, deflection.COLUMNS))
        print(
            "seconds: one application; units: of one scipy.fft deflection at that grid; error: "
            "relative to the largest deflection;\nshare: of the discretisation error of the sum; "
            "half: Y >= 0 of a symmetric pressure"
        )
    elif args.what == "sweep":
        rows = _execute_sweep(args)
    elif args.what == "skips":
        rows = _execute_skips(args)
    elif args.what == "step":
        rows = _execute_step(args, answer)
    else:
        rows = smooth.smooth_rows(
            args.points, args.threads, args.engines.split(","), args.moes_m, args.moes_l
        )
        answer["exponents"] = smooth.exponents(rows)
        answer["moes_m"], answer["moes_l"] = args.moes_m, args.moes_l
        print(f"smooth contact, M = {args.moes_m}, L = {args.moes_l}")
        print(table(rows, smooth.COLUMNS))
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
    return 0 if all(row.get("same", True) for row in rows) else 1
