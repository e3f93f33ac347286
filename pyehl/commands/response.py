# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl response``: response of the contact of a case to small waves of roughness."""

import argparse
import time
from pathlib import Path

from pyehl.case import Case, exchanged
from pyehl.commands.arguments import add_case_arguments, add_force
from pyehl.commands.watching import Bar
from pyehl.measured_response.folder import response
from pyehl.measured_response.measurement import TIERS
from pyehl.schema import summary_of


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_case_arguments(parser)
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        required=True,
        metavar="DIR",
        help="result folder; existing runs are not repeated",
    )
    add_force(parser)
    parser.add_argument(
        "--second",
        action="store_true",
        help="at the velocity of the second surface of the case, not of the first",
    )
    parser.add_argument(
        "--quick", action="store_true", help="waves down to a/16 only, with a sixth of the work"
    )


def execute(args: argparse.Namespace) -> int:
    case = Case(args.case, args.overrides)
    case = exchanged(case) if args.second else case
    ratio = float(case.resolve()["surface"]["velocity_ratio"])
    # the cost of a step is proportional to its nodes
    cost = {tier.name: float(tier.points**2) for tier in (TIERS[:-1] if args.quick else TIERS)}
    done: dict[str, float] = {}
    began = time.perf_counter()
    bar = Bar(sum(cost[t.name] * t.steps(max(ratio, 1e-3)) for t in TIERS if t.name in cost))

    def show(name: str, step: int, total: int) -> None:
        done[name] = cost[name] * step
        bar.show(sum(done.values()), f"{name}: step {step} of {total}")

    try:
        data = response(
            args.case,
            args.overrides,
            output=args.output,
            force=args.force,
            quick=args.quick,
            second=args.second,
            progress=show,
        )
    finally:
        bar.close()
    summary = summary_of(data)
    print(
        f"response    {data.sizes['wave']} waves at M = {summary['moes_m']:.4g}, "
        f"L = {summary['moes_l']:.4g}, velocity ratio {ratio:g}   "
        f"[{time.perf_counter() - began:.0f} s]"
    )
    for tier in summary["tiers"]:
        print(
            f"            {tier['name']}: {tier['points']} x {tier['points']} nodes, "
            f"H_c {tier['H_c']:.6f}, {tier['waves']} waves, fit within {tier['fit_residual']:.1e}"
        )
    print(
        f"shipped     differs by {summary['shipped_difference_rms']:.3f} (rms) and at most "
        f"{summary['shipped_difference_max']:.3f} in T at X = 0"
        + ("" if summary["within_fitted_range"] else "; outside the range it was fitted in")
    )
    print(f"results     {args.output}")
    return 0
