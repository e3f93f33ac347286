# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl fit-lubricant``: a shear law fitted to a measured traction curve."""

import argparse
from pathlib import Path

from pyehl.commands.arguments import add_force, add_overrides
from pyehl.studies.fit_folder import fit_lubricant
from pyehl.studies.shear_fit import PARAMETERS, Fit


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.description = (
        "Fit the Eyring stress, the limiting coefficient, or G and n of Carreau to friction "
        "measured over the slide-to-roll ratio."
    )
    parser.add_argument(
        "data", metavar="DATA.csv", help="columns contact.slide_to_roll, mu and, if known, error"
    )
    parser.add_argument("--case", required=True, metavar="CASE.nml", help="the contact and its oil")
    add_overrides(parser, "of the case")
    parser.add_argument(
        "--law", default="", metavar="LAW", help=f"{', '.join(PARAMETERS)}; default by the case"
    )
    parser.add_argument(
        "--points", type=int, default=129, help="nodes along X of the contacts (default 129)"
    )
    parser.add_argument("-o", "--output", type=Path, metavar="DIR", help="result folder")
    add_force(parser)


def report(fit: Fit) -> str:
    """Return what is printed."""
    lines = [f"law        {fit.law}, {fit.slide_to_roll.size} measured points"]
    for p in fit.parameters:
        unit = "" if p.unit == "-" else f" {p.unit}"
        lines.append(
            f"           {p.key} = {p.value:.4g}{unit}, 95 % confidence {p.low:.4g} to {p.high:.4g}"
        )
    lines.append(f"residual   {fit.residual_rms:.2e} (rms) in mu")
    lines.append("")
    for s, mu, fitted in zip(fit.slide_to_roll, fit.measured, fit.fitted, strict=True):
        lines.append(f"  slide-to-roll ratio {s:8.4g}   measured {mu:.5f}   fitted {fitted:.5f}")
    return "\n".join([*lines, "", fit.group.rstrip()])


def execute(args: argparse.Namespace) -> int:
    fit = fit_lubricant(
        args.data,
        args.case,
        args.overrides,
        law=args.law,
        points=args.points,
        output=args.output,
        force=args.force,
    )
    print(report(fit))
    if args.output is not None:
        print(f"\nresults    {args.output}")
    return 0
