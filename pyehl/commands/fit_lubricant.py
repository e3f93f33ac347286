# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl fit-lubricant``: a lubricant fitted to a measured traction or film curve."""

import argparse
from pathlib import Path

from pyehl.commands.arguments import add_force, add_overrides
from pyehl.studies.film_fit import OF_FILM, fit_lubricant
from pyehl.studies.shear_fit import PARAMETERS, Fit


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.description = (
        "Fit the Eyring stress, the limiting coefficient, or stress and exponent of Carreau's law "
        "to friction measured at several slide-to-roll ratios, or the pressure-viscosity "
        "coefficient to films measured at several speeds."
    )
    parser.add_argument(
        "data",
        metavar="DATA",
        help="columns contact.slide_to_roll, mu and, if known, error; or the file of a rig",
    )
    parser.add_argument("--case", required=True, metavar="CASE.nml", help="the contact and its oil")
    add_overrides(parser, "of the case")
    parser.add_argument(
        "--law",
        default="",
        metavar="LAW",
        help=f"{', '.join(PARAMETERS)}, {OF_FILM}; default by the case and the data",
    )
    parser.add_argument(
        "--between",
        type=float,
        nargs=2,
        metavar=("MIN", "MAX"),
        help="slide-to-roll ratios, or velocities in m/s, of the points of a rig that are used",
    )
    parser.add_argument(
        "--points", type=int, default=129, help="nodes along X of the contacts (default 129)"
    )
    parser.add_argument("-o", "--output", type=Path, metavar="DIR", help="result folder")
    add_force(parser)


def report(fit: Fit) -> str:
    """Return the printed lines."""
    film = fit.quantity == "h_c_m"
    law = f"law        {fit.law}" if fit.law else "coefficient of the viscosity law"
    lines = [f"{law}, {fit.places.size} measured points"]
    for p in fit.parameters:
        unit = "" if p.unit == "-" else f" {p.unit}"
        lines.append(
            f"           {p.key} = {p.value:.4g}{unit}, 95 % confidence {p.low:.4g} to {p.high:.4g}"
        )
    lines.append(f"residual   {fit.residual_rms:.2e} (rms) in {'h_c [m]' if film else 'mu'}")
    lines += [f"note       {note}" for note in fit.notes]
    lines.append("")
    for place, measured, fitted in zip(fit.places, fit.measured, fit.fitted, strict=True):
        if film:
            lines.append(
                f"  mean velocity {place:8.4g} m/s   measured {measured * 1e9:.1f} nm   fitted "
                f"{fitted * 1e9:.1f} nm"
            )
        else:
            lines.append(
                f"  slide-to-roll ratio {place:8.4g}   measured {measured:.5f}   "
                f"fitted {fitted:.5f}"
            )
    return "\n".join([*lines, "", fit.group.rstrip()])


def execute(args: argparse.Namespace) -> int:
    fit = fit_lubricant(
        args.data,
        args.case,
        args.overrides,
        law=args.law,
        between=None if args.between is None else tuple(args.between),
        points=args.points,
        output=args.output,
        force=args.force,
    )
    print(report(fit))
    if args.output is not None:
        print(f"\nresults    {args.output}")
    return 0
