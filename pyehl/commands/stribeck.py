# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl stribeck``: friction against speed, film ratio and theta_2."""

import argparse
import sys
from contextlib import closing
from pathlib import Path

import numpy as np
import pandas as pd

from pyehl.commands.arguments import add_case_arguments
from pyehl.commands.watching import Terminal, add_worker_arguments, jobs_of, report_missing
from pyehl.errors import EXIT_FAILED, EXIT_INTERRUPTED, EXIT_OK, InputError
from pyehl.rigs.quantities import FRICTION
from pyehl.rigs.reading import is_rig, read_rig
from pyehl.studies.compare import read_results
from pyehl.studies.curve import curves_of, no_coefficient
from pyehl.studies.curve_plan import KEYS, CurvePlan, plan_curve
from pyehl.studies.curve_run import (
    CSV,
    NETCDF,
    PICTURE,
    absolute_friction,
    curve_axes,
    deviation,
    last_lines,
    perform,
    report,
)
from pyehl.studies.measured_friction import Measured, read_measured
from pyehl.studies.rig_comparison import compared, lines, rig_curves
from pyehl.surfaces import rough_groups
from pyehl.theory.load_share import AIHARA, LoadShare
from pyehl.theory.transition import UNSOLVED

SLIP = KEYS["slide-to-roll"]
DRAWN = ("mu_ratio", "contact_load_share", "contact_load_share_ehl")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.description = (
        "Friction of a contact as a function of speed, viscosity, load, temperature or "
        "slide-to-roll ratio: the smooth contact is solved, the effect of the roughness is "
        "predicted, and some points can be simulated in full. VALUES are given as for pyehl "
        "sweep: start:stop:count, start:stop:countlog or a,b,c."
    )
    add_case_arguments(parser)
    for name, key in KEYS.items():
        parser.add_argument(f"--{name}", metavar="VALUES", help=f"values of {key}")
    parser.add_argument(
        "--ehl", type=int, default=0, metavar="N", help="full simulation at N points"
    )
    parser.add_argument(
        "--surfaces",
        type=int,
        default=1,
        metavar="K",
        help="mean and spread over K surfaces, with the seed of the case and the following ones",
    )
    parser.add_argument(
        "--measured",
        metavar="FILE",
        help="measured friction, drawn over the curve: columns as in the curve, or the file of a "
        "rig, whose films and friction are compared",
    )
    parser.add_argument(
        "--boundary-friction",
        type=float,
        metavar="MU",
        help="add friction by an empirical law for thin films, with this friction of asperities",
    )
    parser.add_argument(
        "--load-share",
        type=float,
        nargs=2,
        default=AIHARA,
        metavar=("B", "C"),
        help="constants of that law: exp(-B (h_c/sigma)^C) of the load is on asperities "
        f"(default {AIHARA[0]:g} {AIHARA[1]:g})",
    )
    parser.add_argument(
        "--dpi", type=int, default=150, help="dots per inch of the picture (default 150)"
    )
    add_worker_arguments(parser)


def _plan(args: argparse.Namespace) -> CurvePlan:
    given = {key: getattr(args, name.replace("-", "_")) for name, key in KEYS.items()}
    if not any(given.values()):
        raise InputError(f"expected at least one of --{', --'.join(KEYS)}")
    axes = curve_axes({key: values for key, values in given.items() if values is not None})
    mu = args.boundary_friction
    return plan_curve(
        args.case,
        axes,
        options=args.overrides,
        ehl=args.ehl,
        seeds=args.surfaces,
        load_share=None if mu is None else LoadShare(mu, *args.load_share),
    )


def _measured(path: str, plan: CurvePlan) -> Measured | None:
    """Read measured friction, None if a rig has none; InputError if it does not match the curve."""
    keys = plan.study.keys
    if len(keys) > 1:
        raise InputError("--measured: expected one curve, over one of the options")
    if is_rig(path):
        settings = plan.points[0].settings
        rig = rig_curves(path, settings, keys)
        return _matching(path, rig[FRICTION], plan) if FRICTION in rig else None
    measured = _matching(path, read_measured(path, keys[0]), plan)
    places = np.array([float(p.point.values[keys[0]]) for p in plan.points])
    if measured.abscissa == keys[0] and (beyond := measured.outside(places)):
        raise InputError(
            f"{path}: --measured: {beyond} of {len(measured.places)} values of {keys[0]} are "
            f"beyond the curve, which goes from {places.min():g} to {places.max():g}\nexpected: a "
            "wider curve, or a file without them"
        )
    return measured


def _matching(path: str, measured: Measured, plan: CurvePlan) -> Measured:
    """Return measured friction; InputError if the curve has the other of mu and mu_ratio."""
    moving = [p.settings for p in plan.points if p.settings["contact"]["slide_to_roll"] != 0.0]
    why = next((note for settings in moving if (note := no_coefficient(settings))), "")
    wanted = "mu_ratio" if why else "mu"
    if measured.ordinate != wanted:
        raise InputError(
            f"{path}: --measured: it has {measured.ordinate}, the curve {wanted} "
            f"({why or 'with lubricant.shear_law = newtonian it has mu_ratio'})"
        )
    return measured


def draw(
    plan: CurvePlan, table: pd.DataFrame, measured: Measured | None, path: Path, dpi: int
) -> None:
    """Draw the curves of a table."""
    from pyehl.plots.stribeck import (  # noqa: PLC0415 (importing matplotlib is slow)
        Points,
        draw_stribeck,
        draw_traction,
    )
    from pyehl.plots.style import save  # noqa: PLC0415

    key = plan.study.keys[0]
    absolute = absolute_friction(plan, table)
    if measured is not None and measured.ordinate != ("mu" if absolute else "mu_ratio"):
        print(
            f"note: --measured: the curve has no {measured.ordinate} to compare it with",
            file=sys.stderr,
        )
        measured = None
    curves = curves_of(plan, table, absolute=absolute)
    overlay = None
    if measured is not None:
        (curve,) = curves
        if beyond := measured.outside(curve.column(measured.abscissa)):
            words = f"{beyond} of {len(measured.places)} measured points are beyond the curve"
            print(f"note: {words}", file=sys.stderr)
        overlay = Points({key: measured.over(key, curve)}, measured.friction, measured.error)
    settings = plan.points[0].settings
    kinds = [f"'{settings[group]['kind']}'" for group in rough_groups(settings)] or ["'smooth'"]
    count = f", {plan.surfaces} surfaces" if plan.surfaces > 1 else ""
    words = f"surface {' and '.join(kinds)}{count}; {_conditions(plan)}"
    law = "" if plan.load_share is None else plan.load_share.words
    drawn = draw_traction if absolute and key == SLIP else draw_stribeck
    save(drawn(curves, words, overlay, law), path, dpi)


def _conditions(plan: CurvePlan) -> str:
    """Format those of load, speed, slip and viscosity that are not varied."""
    settings = plan.points[0].settings
    result = [
        f"{sign} = {settings[group][key]:.4g}{unit}"
        for sign, group, key, unit in (
            ("w", "contact", "load", " N"),
            ("w", "contact", "load_per_length", " N/m"),
            ("u", "contact", "mean_velocity", " m/s"),
            ("SRR", "contact", "slide_to_roll", ""),
            ("η₀", "lubricant", "viscosity", " Pa s"),
        )
        if key in settings[group] and f"{group}.{key}" not in plan.study.keys
    ]
    return ", ".join(result)


def execute(args: argparse.Namespace) -> int:
    plan = _plan(args)
    jobs = jobs_of(args)
    measured = None if args.measured is None else _measured(args.measured, plan)
    folder = Path(args.output)
    try:
        return _curve(args, plan, jobs, measured)
    except KeyboardInterrupt as stop:
        note = f"what is finished is kept; the same command resumes it in {folder}"
        raise KeyboardInterrupt(note) from stop


def _curve(args: argparse.Namespace, plan: CurvePlan, jobs: int, measured: Measured | None) -> int:
    """Run a planned curve, draw and report it."""
    folder = Path(args.output)
    inputs = tuple(word for word in (args.case, args.measured) if word is not None)
    with closing(Terminal(lambda done: plan.text(jobs, done), quiet=args.quiet)) as watcher:
        outcome, table = perform(
            plan,
            folder,
            inputs=inputs,
            jobs=jobs,
            scheduler=args.scheduler,
            force=args.force,
            watcher=watcher,
        )
    if outcome.interrupted:
        watcher.interrupted(folder)
        return EXIT_INTERRUPTED
    written = [CSV, NETCDF]
    drawn = [name for name in DRAWN if name in table and table[name].notna().any()]
    if drawn:
        draw(plan, table, measured, folder / PICTURE, args.dpi)
        written.append(PICTURE)
    else:
        print("note: no point has a friction or a load share; there is no picture", file=sys.stderr)
    if not args.quiet:
        print(report(plan, table))
        if args.measured is not None and is_rig(args.measured):
            result = compared(read_results(str(folder)), read_rig(args.measured))
            print("\n".join(lines(result)))
        elif measured is not None:
            print("\n".join(deviation(curves_of(plan, table)[0], measured)))
        print(last_lines(plan, table))
        print(f"results    {', '.join(str(folder / name) for name in written)}")
    full = np.array([p.full is not None for p in plan.points])
    unsolved = (
        (table["status"] == UNSOLVED)
        | table["h_c_m"].isna()
        | (full & table["mu_ratio_ehl"].isna())
    )
    missing = [
        f"point {k + 1} of {len(table)} ({plan.points[k].point}): "
        f"{table['status'][k]}: {table['message'][k]}"
        for k in np.flatnonzero(unsolved)
    ]
    report_missing(missing, folder / CSV)
    return EXIT_OK if drawn and not missing else EXIT_FAILED
