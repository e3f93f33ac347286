# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl stress``: stress below the surface under a result."""

import argparse

from pyehl.commands.arguments import add_force
from pyehl.subsurface.cycle import BEARINGS, CRITERIA
from pyehl.subsurface.result import stress, text


def _friction(value: str) -> str | float:
    """Read 'run', 'none' or a number; `stress` refuses other words."""
    try:
        return float(value)
    except ValueError:
        return value


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("folder", metavar="DIR", help="result folder of run or predict")
    parser.add_argument("-o", "--output", metavar="OUT", help="result folder")
    add_force(parser)
    parser.add_argument(
        "--body", type=int, help="1 or 2 (default: the one with the surface of the case)"
    )
    parser.add_argument(
        "--friction",
        type=_friction,
        default="run",
        metavar="run|none|MU",
        help="traction: of the result, none, or MU times the pressure (default: run)",
    )
    parser.add_argument(
        "--above",
        type=float,
        metavar="PA",
        help="report the share of the near-surface volume above this shear",
    )
    parser.add_argument(
        "--near",
        type=float,
        metavar="M",
        help="depth of that volume (default: a quarter of that of the maximum smooth shear)",
    )
    parser.add_argument("--fatigue", choices=CRITERIA, help="criterion of fatigue")
    parser.add_argument(
        "--torsion-limit", type=float, metavar="PA", help="fatigue limit in torsion"
    )
    parser.add_argument("--bending-limit", type=float, metavar="PA", help="in bending")
    parser.add_argument(
        "--contamination", type=float, metavar="EC_CU_P", help="e_C C_u/P for a_ISO of ISO 281"
    )
    parser.add_argument("--bearing", choices=BEARINGS, default="ball", help="type for a_ISO")


def execute(args: argparse.Namespace) -> int:
    """Run ``pyehl stress``; 0 done, 1 a file cannot be read or written, 2 bad input."""
    data = stress(
        args.folder,
        body=args.body,
        friction=args.friction,
        above=args.above,
        near=args.near,
        fatigue=args.fatigue,
        torsion_limit=args.torsion_limit,
        bending_limit=args.bending_limit,
        contamination=args.contamination,
        bearing=args.bearing,
        output=args.output,
        force=args.force,
        progress=True,
    )
    print(text(data))
    if args.output is not None:
        print(f"results    {args.output}")
    return 0
