# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl response``: what the contact of a case makes of small waves of roughness."""

from __future__ import annotations

import argparse
import json
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
from tqdm import tqdm

from pyehl.case import Case
from pyehl.commands.arguments import add_case_arguments
from pyehl.errors import FileError
from pyehl.studies.response import measure
from pyehl.studies.tiers import TIERS, Tier

__all__ = ["add_arguments", "execute"]

FILES = ("response.csv", "response.nc", "response.png", "summary.json", "case.nml")
# Directions of the lines of the shipped response [deg]
LINES = (0.0, 45.0, 80.0, 90.0)
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
        found = measure(
            case,
            args.output,
            tiers=tiers,
            jobs=args.jobs,
            files=set(FILES),
            progress=bar.update,
        )
    finally:
        bar.close()
    try:
        summary = _write(case, found, args.output)
    except OSError as error:
        raise FileError(f"{args.output}: cannot write: {error.strerror or error}") from error
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


def _write(case: Case, found: dict[str, dict[str, Any]], folder: Path) -> dict[str, Any]:
    """Write table, Dataset, summary and picture; returns the summary."""
    # xarray and matplotlib take long to import
    from pyehl.plots.response import response_figure  # noqa: PLC0415
    from pyehl.plots.style import save  # noqa: PLC0415
    from pyehl.prediction.smooth import solve_contact, zone_of  # noqa: PLC0415
    from pyehl.studies.response_table import (  # noqa: PLC0415
        dataset,
        shipped_response,
        write_table,
    )
    from pyehl.theory.lubricant import Lubricant  # noqa: PLC0415
    from pyehl.theory.operating import OperatingPoint  # noqa: PLC0415
    from pyehl.theory.response import fitted_range  # noqa: PLC0415

    settings = case.resolve()
    ratio = float(settings["surface"]["velocity_ratio"])
    operating = OperatingPoint.from_settings(settings)
    zone = zone_of(solve_contact(settings), operating, Lubricant.from_settings(settings))
    data = dataset(found, zone, operating, ratio)
    write_table(data, folder / "response.csv")
    data.to_netcdf(folder / "response.nc", format="NETCDF3_64BIT", engine="scipy")
    values = {"moes_m": operating.moes_m, "moes_l": operating.moes_l, "velocity_ratio": ratio}
    difference = data["shipped_difference"].values[:, 1]
    summary = {
        "kind": "response",
        **values,
        "waves": int(data.sizes["wave"]),
        "tiers": [_tier_summary(name, tier) for name, tier in found.items()],
        "shipped_difference_rms": float(np.sqrt(np.mean(difference**2))),
        "shipped_difference_max": float(difference.max()),
        "within_fitted_range": all(
            low <= values[name] <= high for name, (low, high) in fitted_range().items()
        ),
    }
    (folder / "summary.json").write_text(json.dumps(summary, indent=2) + "\n", encoding="utf-8")
    (folder / "case.nml").write_text(case.text, encoding="utf-8")
    nabla = np.geomspace(float(data["nabla_2"].min()), float(data["nabla_2"].max()), 80)
    q = 2.0 * np.pi / nabla * np.sqrt(operating.moes_m / operating.moes_l)
    lines = {}
    for direction in LINES:
        kx, ky = q * np.cos(np.radians(direction)), q * np.sin(np.radians(direction))
        lines[direction] = (nabla, shipped_response(kx, ky, zone, operating, ratio)[:, 1])
    waves = {
        "nabla_2": data["nabla_2"].values,
        "direction": data["direction"].values,
        "amplitude": data["amplitude"].values[:, 1],
        "lag": data["lag"].values[:, 1],
    }
    label = f"M = {operating.moes_m:.4g}, L = {operating.moes_l:.4g}, velocity ratio {ratio:g}"
    save(response_figure(waves, lines, label), folder / "response.png")
    return summary


def _tier_summary(name: str, tier: dict[str, Any]) -> dict[str, Any]:
    middle = int(np.argmin(np.abs(tier["x"])))
    return {
        "name": name,
        "points": round(4.0 / float(tier["spacing"])) + 1,
        "tile": float(tier["tile"]),
        "waves": int(tier["along"].size),
        "H_c": float(tier["central_film"]),
        "fit_residual": float(tier["residual"][:, middle].max()),
        "seconds": float(tier["seconds"]),
    }
