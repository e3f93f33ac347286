# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl bench``: times beside their errors; the unit of time is that of `pyehl.bench.unit`."""

import argparse
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from pyehl.bench import deflection, faults, machines, skips, smooth, step, stress, sweep, workprec
from pyehl.bench.unit import machine
from pyehl.commands.arguments import add_force
from pyehl.commands.bench_arguments import DECLARE
from pyehl.destination import Destination, check_files, mark, write_json
from pyehl.display import Columns, text_table
from pyehl.errors import InputError
from pyehl.plots import bench as figures

Rows = list[dict[str, Any]]
Answer = dict[str, Any]


def _print(rows: Rows, columns: Columns, *notes: str) -> Rows:
    print("\n".join([text_table(rows, columns), *notes]))
    return rows


def _deflection(args: argparse.Namespace, answer: Answer) -> Rows:
    rows = deflection.deflection_rows(args.points, args.threads)
    return _print(rows, deflection.COLUMNS, deflection.MEANING)


def _smooth(args: argparse.Namespace, answer: Answer) -> Rows:
    rows = smooth.smooth_rows(
        args.points, args.threads, args.engines, args.moes_m, args.moes_l, args.cases
    )
    answer["exponents"] = smooth.exponents(rows)
    answer["moes_m"], answer["moes_l"] = args.moes_m, args.moes_l
    print(f"smooth contact, M = {args.moes_m}, L = {args.moes_l}")
    grows = "time grows with the number of nodes to the power"
    slopes = [f"{grows} {slope:.2f} ({name})" for name, slope in answer["exponents"].items()]
    return _print(rows, smooth.COLUMNS, *slopes, smooth.MEANING)


def _step(args: argparse.Namespace, answer: Answer) -> Rows:
    if args.steps < 1:
        raise InputError("pyehl bench step: steps must be 1 or more")
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
    rows = sweep.sweep_rows([s for s in sweep.SCENES if s.name in args.scenes], args.threads)
    return _print(rows, sweep.COLUMNS, sweep.MEANING)


def _skips(args: argparse.Namespace, answer: Answer) -> Rows:
    rows = skips.skip_rows(args.scenes, max(args.points))
    return _print(rows, skips.COLUMNS, skips.MEANING)


def _machines(args: argparse.Namespace, answer: Answer) -> Rows:
    if args.count < 1 or args.seed < 0:
        raise InputError("pyehl bench machines: count must be 1 or more, seed 0 or more")
    rows = machines.campaign(args.count, args.seed, fine=args.fine, tell=_tell)
    found = machines.summary(rows)
    answer |= {"seed": args.seed, "count": args.count, "fine": args.fine, "summary": found}
    _print(found, machines.COLUMNS, machines.MEANING)
    return rows


def _stress(args: argparse.Namespace, answer: Answer) -> Rows:
    if args.output is None or args.cases < 1:
        raise InputError("pyehl bench stress: -o DIR is needed, and 1 or more cases")
    if args.boundary_film and args.shear_law == "newtonian":
        raise InputError("pyehl bench stress: --boundary-film needs a --shear-law that thins")
    names = ("stress.json", "stress.png", *stress.folders())
    Destination(args.output, "bench stress", names, force=args.force).claim({})
    try:
        rows = stress.campaign(
            args.cases,
            args.seed,
            args.output,
            jobs=args.jobs,
            grids=args.points,
            law=args.shear_law,
            layer=args.boundary_film,
            tell=_tell,
        )
    except KeyboardInterrupt:
        _tell(f"interrupted; the same command resumes it in {args.output}")
        raise
    asked = ("cases", "seed", "points", "shear_law", "boundary_film")
    answer |= {name: getattr(args, name) for name in asked}
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
    answer["cheapest"] = workprec.cheapest(rows)
    for row in answer["cheapest"]:
        print(workprec.told(row))
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


# What is measured, and what does it. Those that write a folder write their JSON into it
FILES: dict[str, tuple[str, Callable[..., Rows]]] = {
    "deflection": ("time and error of the elastic deflection", _deflection),
    "smooth": ("time, error and memory of smooth contacts", _smooth),
    "step": ("time of a step of a transient run", _step),
    "sweep": ("cases per core-hour of studies", _sweep),
    "skips": ("what a scene does not need, and what that saves", _skips),
    "machines": ("smooth contacts of machines: convergence, time, stated errors", _machines),
    "workprec": ("error against processor seconds of all settings", _workprec),
}
FOLDERS: dict[str, tuple[str, Callable[..., Rows]]] = {
    "stress": ("where the solver converges: random cases", _stress),
    "faults": ("kills, damaged states, mutated input", _faults),
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    subparsers = parser.add_subparsers(dest="what", metavar="WHAT", required=True)
    for name, (text, _) in (FILES | FOLDERS).items():
        sub = subparsers.add_parser(
            name, help=text, description=f"Measure: {text}.", allow_abbrev=False
        )
        sub.set_defaults(known={})
        DECLARE[name](sub)
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
    for name, known in args.known.items():
        for word in getattr(args, name):
            if word not in known:
                expected = f"expected: some of {', '.join(known)}"
                raise InputError(f"pyehl bench {args.what}: --{name} {word}\n{expected}")
    if args.what in FILES and args.output is not None:
        pictures = [args.output.with_suffix(".png")] if args.what == "workprec" else []
        check_files([args.output, *pictures], "bench")
    answer: Answer = {"source": mark("bench"), "what": args.what, "machine": machine()}
    _, measure = (FILES | FOLDERS)[args.what]
    rows = measure(args, answer)
    if args.what in FILES and args.output is not None:
        answer["rows"] = rows
        write_json(args.output, answer, allow_nan=True)
    return 0 if all(row.get("same", True) and not row.get("wrong") for row in rows) else 1
