# SPDX-License-Identifier: BSD-3-Clause
"""Random rollers: how many end with a solution, and how.

    python benchmarks/rollers.py [--seed 1] [--count 60] [--points 257] [--csv rollers.csv]

Loads per length, sizes, speeds and oils as rolling bearings have them; crown, logarithmic profile
and chamfer, and none; two of three are misaligned, up to the angle that lifts an end of a
roller without a profile.
"""

import argparse
import csv
import math
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

import pyehl

Row = dict[str, float | str]
# Amplitude of the logarithmic profile of ISO/TS 16281 over the diameter
ISO_AMPLITUDE = 3.5e-4


def rollers(seed: int, count: int) -> Iterator[tuple[str, dict[str, float | str], float]]:
    """Give profile, keys of ``&contact`` and viscosity [Pa s] of random rollers."""
    rng = np.random.default_rng(seed)

    def between(low: float, high: float) -> float:
        return float(np.exp(rng.uniform(math.log(low), math.log(high))))

    for _ in range(count):
        length, radius = between(5e-3, 3e-2), between(3e-3, 1.5e-2)
        per_length = between(5e4, 6e5)
        width = math.sqrt(8.0 * per_length * radius / (math.pi * 2.26e11))
        approach = 2.0 * per_length / (math.pi * 2.26e11) * (math.log(2.0 * length / width) + 1.2)
        profile = str(rng.choice(["crown", "logarithmic", "chamfer", "none"]))
        deep = approach * between(0.3, 2.0)
        keys: dict[str, float | str] = {
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
        share = rng.uniform(-0.5, 1.0)
        keys["misalignment"] = max(0.0, share) * approach / length
        yield profile, keys, between(0.008, 0.2)


def main(words: Sequence[str] | None = None) -> int:
    """Solve the rollers, print a line for each and the sums."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--points", type=int, default=257)
    parser.add_argument("--csv", default="")
    arguments = parser.parse_args(words)
    if arguments.csv and Path(arguments.csv).exists():
        parser.error(f"--csv {arguments.csv}: exists; expected: a new file")
    rows: list[Row] = []
    for profile, keys, viscosity in rollers(arguments.seed, arguments.count):
        try:
            ds = pyehl.solve(
                pyehl.Case(
                    contact=keys,
                    lubricant={"viscosity": viscosity},
                    grid={"points": arguments.points},
                ),
                check=False,
            )
        except pyehl.InputError as error:
            print(f"{len(rows):3d} {profile:11s} refused: {str(error).splitlines()[0]}")
            continue
        operating = ("moes_m_line", "moes_l_line", "alpha_bar", "length", "P_end")
        numbers = (*operating, "H_c", "H_min", "P_max", "total_cycles", "restarts")
        row: Row = {"profile": profile, "status": ds.attrs["status"]}
        row |= {name: float(ds[name]) if name in ds else math.nan for name in numbers}
        row |= {"seconds": float(ds["wall_seconds"]), "misalignment": keys["misalignment"]}
        rows.append(row)
        text = " ".join(
            f"{name} {value:.4g}" for name, value in row.items() if not isinstance(value, str)
        )
        print(f"{len(rows):3d} {profile:11s} {row['status']!s:14s} {text}", flush=True)
    found = Counter((str(row["profile"]), str(row["status"])) for row in rows)
    for (profile, status), count in sorted(found.items()):
        print(f"{profile:11s} {status:14s} {count}")
    if arguments.csv and rows:
        with Path(arguments.csv).open("w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, rows[0])
            writer.writeheader()
            writer.writerows(rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
