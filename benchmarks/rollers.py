# SPDX-License-Identifier: BSD-3-Clause
"""Convergence and time of random rollers.

Loads per length, sizes, speeds and oils as in rolling bearings; with a crown, logarithmic profile,
chamfer or no profile; some are misaligned, by up to the deflection at an end of a roller without a
profile over the length.
"""

import argparse
import math
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from common import add_number, columns, measure, parser, say, show
from machines import MODULUS, REFUSED, timed

from pyehl.errors import InputError
from pyehl.types import Row

PROFILES = ("crown", "logarithmic", "chamfer", "none")
ISO_AMPLITUDE = 3.5e-4
"""Amplitude of the logarithmic profile of ISO/TS 16281 over the diameter."""
KEPT = (
    *("status", "message", "moes_m_line", "moes_l_line", "alpha_bar", "length", "P_end"),
    *("H_c", "H_min", "P_max", "total_cycles", "restarts", "seconds"),
)
COLUMNS = columns("profile:s drawn:d converged:d median_seconds:.2f largest_seconds:.1f")


def rollers(seed: int, count: int) -> Iterator[dict[str, Any]]:
    """Draw keys of a case; the first rollers do not depend on `count`."""
    rng = np.random.default_rng(seed)

    def between(low: float, high: float) -> float:
        return float(np.exp(rng.uniform(math.log(low), math.log(high))))

    for _ in range(count):
        length, radius = between(5e-3, 3e-2), between(3e-3, 1.5e-2)
        per_length = between(5e4, 6e5)
        width = math.sqrt(8.0 * per_length * radius / (math.pi * MODULUS))
        # at an end without a profile, under a uniform load per length
        deflection = 2.0 * per_length / (math.pi * MODULUS) * (math.log(2.0 * length / width) + 1.2)
        profile = str(rng.choice(PROFILES))
        deep = deflection * between(0.3, 2.0)
        keys: dict[str, Any] = {
            "shape": "roller",
            "length": length,
            "radius": radius,
            "load": per_length * length,
            "mean_velocity": between(0.3, 10.0),
            "profile": profile,
        }
        keys |= {
            "crown": {"crown_radius": length**2 / (8.0 * deep)},
            "logarithmic": {"log_amplitude": ISO_AMPLITUDE * 2.0 * radius * between(0.5, 2.0)},
            "chamfer": {"chamfer_length": length * rng.uniform(0.05, 0.2), "chamfer_drop": deep},
            "none": {},
        }[profile]
        fraction = rng.uniform(-0.5, 1.0)
        keys["misalignment"] = max(0.0, fraction) * deflection / length
        yield {f"contact.{name}": value for name, value in keys.items()} | {
            "lubricant.viscosity": between(0.008, 0.2)
        }


def campaign(count: int, seed: int, points: int) -> list[Row]:
    """Solve `count` rollers of a seed on one thread; returns a row for each."""
    rows: list[Row] = []
    for number, keys in enumerate(rollers(seed, count)):
        try:
            result = timed(keys | {"grid.points": points, "solver.threads": 1})
        except InputError as error:
            result = {"status": REFUSED, "message": str(error)}
        row = {"number": number, "values": keys} | {name: result.get(name) for name in KEPT}
        rows.append(row)
        seconds = f", {row['seconds']:.1f} s" if row["seconds"] else ""
        say(f"{number + 1} of {count}: {keys['contact.profile']}, {row['status']}{seconds}")
    return rows


def summary(rows: Sequence[Row]) -> list[Row]:
    """Summarise counts and times by profile, and of all."""
    groups = {
        name: [row for row in rows if row["values"]["contact.profile"] == name] for name in PROFILES
    } | {"all": list(rows)}
    result = []
    for name, mine in groups.items():
        seconds = [row["seconds"] for row in mine if row["seconds"]]
        result.append(
            {
                "profile": name,
                "drawn": len(mine),
                "converged": Counter(row["status"] for row in mine)["converged"],
                "median_seconds": float(np.median(seconds)) if seconds else None,
                "largest_seconds": max(seconds, default=None),
            }
        )
    return result


def work(args: argparse.Namespace) -> Row:
    """Measure and print."""
    rows = campaign(args.count, args.seed, args.points)
    result = summary(rows)
    show(result, COLUMNS, "seconds: of the processor, one thread, all grids of a solution")
    asked = {name: getattr(args, name) for name in ("seed", "count", "points")}
    return asked | {"summary": result, "rows": rows}


def main(words: Sequence[str] | None = None) -> int:
    """Run the script."""
    made = parser(__doc__)
    add_number(made, "seed", 1)
    add_number(made, "count", 60, "how many rollers", minimum=1)
    add_number(made, "points", 257, "nodes along X", minimum=3)
    return measure(work, made, words)


if __name__ == "__main__":
    sys.exit(main())
