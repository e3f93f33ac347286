# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl response``: what the contact of a case makes of small waves of roughness."""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

from tqdm import tqdm

from pyehl.case import Case
from pyehl.commands.arguments import add_case_arguments, add_force
from pyehl.studies.response_folder import response
from pyehl.studies.tiers import TIERS, Tier

__all__ = ["add_arguments", "execute"]

# Seconds between progress lines where the output is not a terminal
PROGRESS_INTERVAL = 10.0


class Bar:
    """One bar for all tiers, each step weighted by its nodes; lines where there is no terminal."""

    def __init__(self, tiers: tuple[Tier, ...], velocity_ratio: float) -> None:
        self._cost = {tier.name: tier.points**2 / 1e6 for tier in tiers}
        counts = {tier.name: tier.steps(velocity_ratio) for tier in tiers}
        total = sum(self._cost[name] * count for name, count in counts.items())
        self._terminal = sys.stderr.isatty()
        form = "{desc} {percentage:3.0f}% |{bar}| {elapsed}<{remaining}"
        self._bar = tqdm(total=total, bar_format=form, disable=not self._terminal)
        self._done: dict[str, float] = {}
        self._last = time.monotonic()

    def update(self, name: str, done: int, total: int) -> None:
        """Take the steps of a tier into account."""
        self._done[name] = self._cost[name] * done
        self._bar.set_description_str(f"{name} {done}/{total}", refresh=False)
        self._bar.update(sum(self._done.values()) - self._bar.n)
        now = time.monotonic()
        if not self._terminal and now - self._last > PROGRESS_INTERVAL:
            self._last = now
            print(f"{name}: step {done} of {total}", flush=True)

    def close(self) -> None:
        """Leave the line."""
        self._bar.close()


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of ``pyehl response``."""
    add_case_arguments(parser)
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        required=True,
        metavar="DIR",
        help="result folder; runs that are there already are not made again",
    )
    add_force(parser)
    parser.add_argument(
        "--jobs",
        type=int,
        default=1,
        metavar="N",
        help="runs side by side, each with its threads (1)",
    )
    parser.add_argument(
        "--quick", action="store_true", help="waves down to a/16 only, in a third of the time"
    )


def execute(args: argparse.Namespace) -> int:
    """Run ``pyehl response``."""
    case = Case.read(args.case, args.overrides)
    tiers = TIERS[:-1] if args.quick else TIERS
    ratio = float(case.resolve()["surface"]["velocity_ratio"])
    began = time.perf_counter()
    bar = Bar(tiers, max(ratio, 1e-3))
    try:
        summary = response(
            args.case,
            args.overrides,
            output=args.output,
            force=args.force,
            jobs=args.jobs,
            quick=args.quick,
            progress=bar.update,
        ).attrs
    finally:
        bar.close()
    print(
        f"response    {summary['waves']} waves at M = {summary['moes_m']:.4g}, "
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
