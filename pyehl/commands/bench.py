# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl bench``: time and error side by side, in one run on one machine.

Every time stands beside its error. The unit of time is that of `pyehl.bench.unit`.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from pyehl.bench import (
    deflection,
    faults,
    precision,
    skips,
    smooth,
    step,
    stress,
    stress_cases,
    sweep,
    workprec,
)
from pyehl.bench.text import table
from pyehl.bench.unit import machine
from pyehl.commands.arguments import add_force
from pyehl.destination import Destination, check_files, mark, new_file
from pyehl.errors import InputError
from pyehl.plots import bench as figures

__all__ = ["add_arguments", "execute"]

Rows = list[dict[str, Any]]
Answer = dict[str, Any]

GRIDS = (65, 129, 257, 513, 1025)
STEP_GRIDS = GRIDS[1:4]


def _numbers(text: str) -> list[int]:
    try:
        return [int(word) for word in text.split(",")]
    except ValueError as error:
        raise argparse.ArgumentTypeError(f"'{text}' is not like 129,257") from error


def _add_points(parser: argparse.ArgumentParser, default: Sequence[int], told: str = "") -> None:
    parser.add_argument(
        "--points",
        type=_numbers,
        default=list(default),
        metavar="N,N,...",
        help=f"nodes per side (default: {told or ','.join(map(str, default))})",
    )


def _add_threads(parser: argparse.ArgumentParser, what: str = "threads") -> None:
    parser.add_argument(
        "--threads",
        type=_numbers,
        default=[1, 2],
        metavar="N,N,...",
        help=f"numbers of {what} (default: 1,2)",
    )


def _add_scenes(parser: argparse.ArgumentParser, names: Sequence[str]) -> None:
    parser.add_argument(
        "--scenes",
        type=lambda text: text.split(","),
        default=list(names),
        metavar="NAME,NAME,...",
        help=f"of {', '.join(names)} (default: all)",
    )


def _add_deflection(parser: argparse.ArgumentParser) -> None:
    _add_points(parser, GRIDS)
    _add_threads(parser)


def _add_smooth(parser: argparse.ArgumentParser) -> None:
    _add_points(parser, GRIDS)
    _add_threads(parser)
    parser.add_argument("--engines", default="mlmi,fft", help="default: mlmi,fft")
    parser.add_argument("--moes-m", type=float, default=1000.0, help="default: 1000")
    parser.add_argument("--moes-l", type=float, default=10.0, help="default: 10")


def _add_step(parser: argparse.ArgumentParser) -> None:
    _add_points(parser, STEP_GRIDS)
    _add_threads(parser)
    names = list(dict.fromkeys(scene.name for scene in step.CASES))
    parser.add_argument(
        "--cases",
        type=lambda text: text.split(","),
        default=names,
        metavar="NAME,NAME",
        help="wave: of Fig. 2, fractal: of Table 1 (default: both)",
    )
    parser.add_argument("--scheme", choices=("narrow", "paper"), default="narrow")
    parser.add_argument(
        "--steps", type=int, default=step.STEPS, help="timed steps (default: %(default)s)"
    )
    parser.add_argument(
        "--front",
        type=float,
        default=step.FILLED,
        metavar="X",
        help="X of the front of the roughness when the timed steps begin (default: %(default)s, "
        "where the contact is full; that takes many steps on fine grids)",
    )
    parser.add_argument(
        "--error",
        action="store_true",
        help="whole runs too, for the error of mu_r/mu_s against the finest grid",
    )


def _add_sweep(parser: argparse.ArgumentParser) -> None:
    _add_threads(parser, "worker processes")
    _add_scenes(parser, [scene.name for scene in sweep.SCENES])


def _add_skips(parser: argparse.ArgumentParser) -> None:
    _add_points(parser, (skips.LEAST,))
    _add_scenes(parser, list(skips.SCENES))


def _add_stress(parser: argparse.ArgumentParser) -> None:
    _add_points(parser, stress_cases.GRIDS)
    parser.add_argument("--cases", type=int, default=500, help="how many (default: 500)")
    parser.add_argument("--seed", type=int, default=1, help="default: 1")
    parser.add_argument("--jobs", type=int, default=2, help="worker processes (default: 2)")


def _add_faults(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--seed", type=int, default=1, help="default: 1")
    parser.add_argument("--kills", type=int, default=200, help="default: 200")
    parser.add_argument("--inputs", type=int, default=2000, help="mutated ones (default: 2000)")


def _add_workprec(parser: argparse.ArgumentParser) -> None:
    _add_points(parser, (), "those of each scene")
    _add_threads(parser)
    _add_scenes(parser, [scene.name for scene in workprec.SCENES])
    parser.add_argument(
        "--full", action="store_true", help="the finest grids too, for the reference"
    )


def _deflection(args: argparse.Namespace, answer: Answer) -> Rows:
    rows = deflection.deflection_rows(args.points, args.threads)
    print(table(rows, deflection.COLUMNS))
    print(deflection.MEANING)
    return rows


def _smooth(args: argparse.Namespace, answer: Answer) -> Rows:
    rows = smooth.smooth_rows(
        args.points, args.threads, args.engines.split(","), args.moes_m, args.moes_l
    )
    answer["exponents"] = smooth.exponents(rows)
    answer["moes_m"], answer["moes_l"] = args.moes_m, args.moes_l
    print(f"smooth contact, M = {args.moes_m}, L = {args.moes_l}")
    print(table(rows, smooth.COLUMNS))
    for name, slope in answer["exponents"].items():
        print(f"time grows with the number of nodes to the power {slope:.2f} ({name})")
    print(smooth.MEANING)
    return rows


def _step(args: argparse.Namespace, answer: Answer) -> Rows:
    known = {scene.name for scene in step.CASES}
    if not set(args.cases) <= known or args.steps < 1:
        raise InputError(f"pyehl bench step: cases must be of {sorted(known)}, steps 1 or more")
    scenes = [scene for scene in step.CASES if scene.name in args.cases]
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
    print(step.meaning(args.scheme, args.front, args.steps))
    return rows


def _sweep(args: argparse.Namespace, answer: Answer) -> Rows:
    known = [scene.name for scene in sweep.SCENES]
    if not set(args.scenes) <= set(known):
        raise InputError(f"pyehl bench sweep: scenes must be of {', '.join(known)}")
    rows = sweep.sweep_rows([s for s in sweep.SCENES if s.name in args.scenes], args.threads)
    print(table(rows, sweep.COLUMNS))
    print(sweep.MEANING)
    return rows


def _skips(args: argparse.Namespace, answer: Answer) -> Rows:
    rows = skips.skip_rows(args.scenes, max(args.points))
    print(table(rows, skips.COLUMNS))
    print(skips.MEANING)
    return rows


def _stress(args: argparse.Namespace, answer: Answer) -> Rows:
    if args.output is None or args.cases < 1:
        raise InputError("pyehl bench stress: -o DIR is needed, and 1 or more cases")
    names = ("stress.json", "stress.png", *stress.folders())
    Destination(args.output, "bench stress", names, force=args.force).claim({})
    rows = stress.campaign(
        args.cases, args.seed, args.output, jobs=args.jobs, grids=args.points, tell=_tell
    )
    answer |= {"cases": args.cases, "seed": args.seed, "points": args.points}
    stress.write(rows, args.output, answer)
    figures.stress(rows, args.output / "stress.png")
    print(table(stress.summary(rows), stress.COLUMNS))
    print(stress.MEANING)
    return rows


def _faults(args: argparse.Namespace, answer: Answer) -> Rows:
    if args.output is None:
        raise InputError("pyehl bench faults: -o DIR is needed, a folder that is empty")
    Destination(args.output, "bench faults").check()
    args.output.mkdir(parents=True, exist_ok=True)
    rows = faults.campaign(
        args.output.resolve(), seed=args.seed, kills=args.kills, inputs=args.inputs, tell=_tell
    )
    print(table(rows, faults.COLUMNS))
    text = json.dumps({**answer, "seed": args.seed, "rows": rows}, indent=1) + "\n"
    with new_file(args.output / "faults.json") as path:
        path.write_text(text, encoding="utf-8")
    for row in rows:
        for what in row["bad"]:
            print(f"{row['campaign']}: {what}", file=sys.stderr)
    return rows


def _workprec(args: argparse.Namespace, answer: Answer) -> Rows:
    rows = workprec.work_rows(
        args.scenes, grids=args.points, threads=args.threads, full=args.full, tell=_tell
    )
    print(table(rows, workprec.COLUMNS))
    answer["cheapest"] = precision.cheapest(rows)
    for row in answer["cheapest"]:
        found = row["best"]
        how = "none of these"
        if found is not None:
            how = f"{found['setting']}, {found['points']} x {found['points']}, threads "
            how += f"{found['threads']}: {found['seconds']:.3g} s, error {found['error']:.1e}"
        print(f"{row['scene']}, {row['quantity']} to {row['level']:.1%}: {how}")
    if "wave" in args.scenes:
        share = answer["share_of_deflection"] = workprec.share_of_deflection()
        print(
            f"multi-integration, short wave that slides, {share['points']} x {share['points']}: "
            f"{share['difference']:.2%} of mu_r/mu_s, {share['share']:.1%} of the grid error"
        )
    if args.output is not None:
        figures.work(rows, args.output.with_suffix(".png"))
    return rows


def _tell(text: str) -> None:
    print(text, file=sys.stderr)


# What is measured, the arguments, what does it. Those that write a folder write their JSON into it
FILES: dict[str, tuple[str, Callable[..., None], Callable[..., Rows]]] = {
    "deflection": ("time and error of the elastic deflection", _add_deflection, _deflection),
    "smooth": ("time, error and memory of smooth contacts", _add_smooth, _smooth),
    "step": ("time of a step of a transient run", _add_step, _step),
    "sweep": ("cases per core-hour of studies", _add_sweep, _sweep),
    "skips": ("what a scene does not need, and what that saves", _add_skips, _skips),
    "workprec": ("error against processor seconds of all settings", _add_workprec, _workprec),
}
FOLDERS: dict[str, tuple[str, Callable[..., None], Callable[..., Rows]]] = {
    "stress": ("where the solver converges: random cases", _add_stress, _stress),
    "faults": ("kills, full disks, damaged states, mutated input", _add_faults, _faults),
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of ``pyehl bench``."""
    subparsers = parser.add_subparsers(dest="what", metavar="WHAT", required=True)
    for name, (text, add, _) in (FILES | FOLDERS).items():
        sub = subparsers.add_parser(
            name, help=text, description=f"Measure: {text}.", allow_abbrev=False
        )
        add(sub)
        place = ("DIR", "folder of results; an interrupted campaign is resumed in it")
        if name == "faults":
            place = ("DIR", "an empty folder to work in")
        elif name in FILES:
            place = ("FILE.json", "write JSON too")
        else:
            add_force(sub)
        sub.add_argument("-o", "--output", type=Path, metavar=place[0], help=place[1])


def execute(args: argparse.Namespace) -> int:
    """Run ``pyehl bench``; 1 if something is wrong, or skipped work would change a result."""
    if min(getattr(args, "points", []), default=3) < 3 or min(getattr(args, "threads", [1])) < 1:
        raise InputError("pyehl bench: points must be 3 or more, threads 1 or more")
    if args.what in FILES and args.output is not None:
        pictures = [args.output.with_suffix(".png")] if args.what == "workprec" else []
        check_files([args.output, *pictures], "bench")
    answer: Answer = {"source": mark("bench"), "what": args.what, "machine": machine()}
    _, _, measure = (FILES | FOLDERS)[args.what]
    rows = measure(args, answer)
    if args.what in FILES and args.output is not None:
        answer["rows"] = rows
        with new_file(args.output) as path:
            path.write_text(json.dumps(answer, indent=2) + "\n", encoding="utf-8")
    return 0 if all(row.get("same", True) and not row.get("wrong") for row in rows) else 1
