# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl bench``: times beside their errors; the unit of time is that of `pyehl.bench.unit`."""

from __future__ import annotations

import argparse
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
from pyehl.bench.unit import machine
from pyehl.commands.arguments import add_force
from pyehl.destination import Destination, check_files, mark, write_json
from pyehl.display import Columns, text_table
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


def _add_list(
    parser: argparse.ArgumentParser, name: str, default: Sequence[Any], what: str, told: str = ""
) -> None:
    """Numbers or names with commas between."""
    numbers = not any(isinstance(word, str) for word in default)
    parser.add_argument(
        f"--{name}",
        type=_numbers if numbers else lambda text: text.split(","),
        default=list(default),
        metavar="N,N,..." if numbers else "NAME,NAME,...",
        help=f"{what} (default: {told or ','.join(map(str, default))})",
    )


def _add_points(parser: argparse.ArgumentParser, default: Sequence[int], told: str = "") -> None:
    _add_list(parser, "points", default, "nodes per side", told)


def _add_threads(parser: argparse.ArgumentParser, what: str = "threads") -> None:
    _add_list(parser, "threads", (1, 2), f"numbers of {what}")


def _add_scenes(parser: argparse.ArgumentParser, names: Sequence[str]) -> None:
    _add_list(parser, "scenes", names, f"of {', '.join(names)}", "all")


def _add_number(parser: argparse.ArgumentParser, name: str, default: float, what: str = "") -> None:
    told = f"{what} (default: {default:g})" if what else f"default: {default:g}"
    parser.add_argument(f"--{name}", type=type(default), default=default, help=told)


def _add_deflection(parser: argparse.ArgumentParser) -> None:
    _add_points(parser, GRIDS)
    _add_threads(parser)


def _add_smooth(parser: argparse.ArgumentParser) -> None:
    _add_points(parser, GRIDS)
    _add_threads(parser)
    _add_list(parser, "engines", ("mlmi", "fft"), "of the deflection")
    _add_number(parser, "moes-m", 1000.0)
    _add_number(parser, "moes-l", 10.0)


def _add_step(parser: argparse.ArgumentParser) -> None:
    _add_points(parser, STEP_GRIDS)
    _add_threads(parser)
    names = list(dict.fromkeys(scene.name for scene in step.CASES))
    _add_list(parser, "cases", names, "wave: of Fig. 2, fractal: of Table 1", "both")
    parser.add_argument("--scheme", choices=("narrow", "paper"), default="narrow")
    _add_number(parser, "steps", step.STEPS, "timed steps")
    front = "X of the front of the roughness when the timed steps begin; that takes many steps on "
    _add_number(parser, "front", step.FILLED, f"{front}fine grids where the contact is to be full")
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
    _add_number(parser, "cases", 500, "how many")
    _add_number(parser, "seed", 1)
    parser.add_argument(
        "--shear-law",
        choices=stress_cases.LAWS,
        default="newtonian",
        help="of all cases, each with a stress of its own (default: newtonian)",
    )
    _add_number(parser, "jobs", 2, "worker processes")


def _add_faults(parser: argparse.ArgumentParser) -> None:
    _add_number(parser, "seed", 1)
    _add_number(parser, "kills", 200)
    _add_number(parser, "inputs", 2000, "mutated ones")


def _add_workprec(parser: argparse.ArgumentParser) -> None:
    _add_points(parser, (), "those of each scene")
    _add_threads(parser)
    _add_scenes(parser, [scene.name for scene in workprec.SCENES])
    parser.add_argument("--full", action="store_true", help="the finest grids too, for reference")


def _print(rows: Rows, columns: Columns, *notes: str) -> Rows:
    print("\n".join([text_table(rows, columns), *notes]))
    return rows


def _deflection(args: argparse.Namespace, answer: Answer) -> Rows:
    rows = deflection.deflection_rows(args.points, args.threads)
    return _print(rows, deflection.COLUMNS, deflection.MEANING)


def _smooth(args: argparse.Namespace, answer: Answer) -> Rows:
    rows = smooth.smooth_rows(args.points, args.threads, args.engines, args.moes_m, args.moes_l)
    answer["exponents"] = smooth.exponents(rows)
    answer["moes_m"], answer["moes_l"] = args.moes_m, args.moes_l
    print(f"smooth contact, M = {args.moes_m}, L = {args.moes_l}")
    grows = "time grows with the number of nodes to the power"
    slopes = [f"{grows} {slope:.2f} ({name})" for name, slope in answer["exponents"].items()]
    return _print(rows, smooth.COLUMNS, *slopes, smooth.MEANING)


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
        tell=_tell,
    )
    answer |= {"scheme": args.scheme, "front": args.front, "steps": args.steps}
    if args.error:
        whole = step.error_rows(
            args.points, max(args.threads), scheme=args.scheme, scenes=scenes, tell=_tell
        )
        answer["runs"] = whole
        errors = {(row["points"], row["case"]): row["error"] for row in whole}
        for row in rows:
            row["error"] = errors.get((row["points"], row["case"]))
        _print(whole, step.RUN_COLUMNS, "")
    return _print(rows, step.COLUMNS, step.meaning(args.scheme, args.front, args.steps))


def _sweep(args: argparse.Namespace, answer: Answer) -> Rows:
    known = [scene.name for scene in sweep.SCENES]
    if not set(args.scenes) <= set(known):
        raise InputError(f"pyehl bench sweep: scenes must be of {', '.join(known)}")
    rows = sweep.sweep_rows([s for s in sweep.SCENES if s.name in args.scenes], args.threads)
    return _print(rows, sweep.COLUMNS, sweep.MEANING)


def _skips(args: argparse.Namespace, answer: Answer) -> Rows:
    rows = skips.skip_rows(args.scenes, max(args.points))
    return _print(rows, skips.COLUMNS, skips.MEANING)


def _stress(args: argparse.Namespace, answer: Answer) -> Rows:
    if args.output is None or args.cases < 1:
        raise InputError("pyehl bench stress: -o DIR is needed, and 1 or more cases")
    names = ("stress.json", "stress.png", *stress.folders())
    Destination(args.output, "bench stress", names, force=args.force).claim({})
    rows = stress.campaign(
        args.cases,
        args.seed,
        args.output,
        jobs=args.jobs,
        grids=args.points,
        law=args.shear_law,
        tell=_tell,
    )
    answer |= {name: getattr(args, name) for name in ("cases", "seed", "points", "shear_law")}
    stress.write(rows, args.output, answer)
    figures.stress(rows, args.output / "stress.png")
    _print(stress.summary(rows), stress.COLUMNS, stress.MEANING)
    return rows


def _faults(args: argparse.Namespace, answer: Answer) -> Rows:
    if args.output is None:
        raise InputError("pyehl bench faults: -o DIR is needed, a folder that is empty")
    Destination(args.output, "bench faults").check()
    args.output.mkdir(parents=True, exist_ok=True)
    rows = faults.campaign(
        args.output.resolve(), seed=args.seed, kills=args.kills, inputs=args.inputs, tell=_tell
    )
    _print(rows, faults.COLUMNS)
    write_json(
        args.output / "faults.json", {**answer, "seed": args.seed, "rows": rows}, allow_nan=True
    )
    for row in rows:
        for what in row["bad"]:
            print(f"{row['campaign']}: {what}", file=sys.stderr)
    return rows


def _workprec(args: argparse.Namespace, answer: Answer) -> Rows:
    rows = workprec.work_rows(
        args.scenes, grids=args.points, threads=args.threads, full=args.full, tell=_tell
    )
    _print(rows, workprec.COLUMNS)
    answer["cheapest"] = precision.cheapest(rows)
    for row in answer["cheapest"]:
        print(precision.told(row))
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
    "faults": ("kills, damaged states, mutated input", _add_faults, _faults),
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
        write_json(args.output, answer, allow_nan=True)
    return 0 if all(row.get("same", True) and not row.get("wrong") for row in rows) else 1
