# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl lubricants``: oils by name."""

import argparse
from pathlib import Path

from pyehl.studies.shear_fit import lubricants
from pyehl.theory.oils import Oil, film_forming, reciprocal_isoviscous


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.description = (
        "Oils of lubricant.name: constants, their ranges and sources, viscosity and "
        "pressure-viscosity coefficients at a temperature."
    )
    parser.add_argument("names", metavar="NAME", nargs="*", help="names of oils (default: all)")
    parser.add_argument(
        "--temperature", type=float, default=40.0, metavar="DEGC", help="default 40 degC"
    )
    parser.add_argument("-o", "--output", type=Path, metavar="DIR", help="folder for pictures")


def report(oil: Oil, temperature: float) -> str:
    """Return the printed lines of an oil at a temperature [degC]."""
    at = oil.at(temperature)
    coefficients = (
        f"alpha = {1e9 * at.pressure_viscosity:.2f}/GPa at ambient pressure, alpha* = "
        f"{1e9 * reciprocal_isoviscous(at):.2f}/GPa, alpha_film = {1e9 * film_forming(at):.2f}/GPa"
    )
    lines = [
        f"{oil.name}: {oil.title}",
        f"  source     {oil.source}",
        f"  range      {oil.range}",
        f"  {temperature:g} degC    {1e3 * at.viscosity:.4g} mPa s, decreasing by "
        f"{100.0 * at.temperature_viscosity:.2f} % per kelvin; law '{oil.viscosity_law}'",
        f"             {coefficients}",
    ]
    lines += [f"  {c.key:24} {c.value:<14.7g} {c.place}" for c in oil.constants]
    return "\n".join(lines)


def execute(args: argparse.Namespace) -> int:
    oils = lubricants(*args.names, temperature=args.temperature, output=args.output)
    print("\n\n".join(report(oil, args.temperature) for oil in oils.values()))
    if args.output is not None:
        print(f"\npictures   {', '.join(str(args.output / f'{name}.png') for name in oils)}")
    return 0
