# SPDX-License-Identifier: BSD-3-Clause
"""Rollers of one load with four profiles, aligned and misaligned, and random rollers.

``python docs/evidence/rollers/make.py`` writes profiles.csv; seed_1.json is from
``python benchmarks/rollers.py --count 40 --seed 1 -o docs/evidence/rollers/seed_1.json``; the
others have seeds 2, 31, 32, 33 and 34, and seed 35 with --count 20.
"""

import csv
import json
import math
import re
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pyehl

HERE = Path(__file__).resolve().parent
ROLLER = {
    "shape": "roller",
    "load": 2000.0,
    "length": 0.01,
    "radius": 0.005,
    "mean_velocity": 1.0,
}
# The three profiles have about the same drop at the end; the logarithmic one is steeper there
PROFILES: dict[str, dict[str, float]] = {
    "none": {},
    "crown": {"crown_radius": 1.0},
    "logarithmic": {"log_amplitude": 4.2e-6},
    "chamfer": {"chamfer_length": 1e-3, "chamfer_drop": 1.25e-5},
}
POINTS = 513
REMEDIES = {
    "`log_amplitude` twice as large": "logarithmic deeper",
    "logarithmic profile instead, twice the amplitude of ISO/TS 16281": ".* logarithmic",
    "chamfer with twice the drop": "chamfer deeper",
    "half the misalignment": ".* half",
    "cells half as long along Y": ".* 257x.*",
    "cells half as long along X": ".* 513x.*",
}
"""Patterns of profile and remedy in remedies.csv, by description."""
SEEDS = (1, 2, 31, 32, 33, 34, 35)


def runs() -> Iterator[dict[str, str | float]]:
    """Solve each profile, aligned and misaligned by 1 mrad."""
    for profile, keys in PROFILES.items():
        for angle in (0.0, 1e-3):
            contact = ROLLER | {"profile": profile, "misalignment": angle} | keys
            ds = pyehl.solve(pyehl.Case(contact=contact, grid={"points": POINTS}), check=False)
            row: dict[str, str | float] = {
                "profile": profile,
                "misalignment": angle,
                "status": ds.attrs["status"],
            }
            names = ("h_c_m", "h_c_error_m", "h_min_m", "h_min_error_m", "p_max_Pa", "P_end")
            places = ("H_min_X", "H_min_Y", "P_max_X", "P_max_Y", "length", "cell_at_end")
            row |= {name: float(ds[name]) for name in (*names, *places) if name in ds}
            yield row


def table() -> list[str]:
    """Make the table of profiles.csv."""
    with (HERE / "profiles.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    lines = [
        "| profile | misalignment | h_c | h_min, at y/length | maximum pressure, at y/length |",
        "|---|---|---|---|---|",
    ]
    for row in rows:
        angle = f"{float(row['misalignment']) * 1e3:.0f} mrad"
        if row["status"] != "converged":
            lines.append(f"| {row['profile']} | {angle} | {row['status']} | | |")
            continue
        n = {name: float(value or "nan") for name, value in row.items() if name[-1] in "maYhd"}
        films = [n["h_c_m"] * 1e9, n["h_min_m"] * 1e9]
        error = n["h_min_error_m"] * 1e9
        known = f" ± {error:.0f} nm" if math.isfinite(error) else " nm (error not known)"
        places = [n[name] / n["length"] for name in ("H_min_Y", "P_max_Y")]
        end = "" if math.isfinite(error) else ", increases with finer cells"
        lines.append(
            f"| {row['profile']} | {angle} | {films[0]:.0f} nm | {films[1]:.0f}{known}, "
            f"{places[0]:+.2f} | {n['p_max_Pa'] * 1e-9:.2f} GPa, {places[1]:+.2f}{end} |"
        )
    return [line.replace("-0.00", "0.00").replace("+0.00", "0.00") for line in lines]


def random() -> list[str]:
    """Make the table of the random rollers."""
    rows = [row for seed in SEEDS for row in _record(seed)]
    lines = ["| profile | rollers | with a solution | without |", "|---|---|---|---|"]
    for profile in PROFILES:
        mine = [row["status"] for row in rows if row["values"]["contact.profile"] == profile]
        others = Counter(status for status in mine if status != "converged")
        failed = ", ".join(f"{status} {count}" for status, count in sorted(others.items())) or "–"
        lines.append(f"| {profile} | {len(mine)} | {mine.count('converged')} | {failed} |")
    return lines


def by_seed() -> list[str]:
    """List the numbers of rollers with a solution by seed."""
    lines = []
    for seed in SEEDS:
        rows = _record(seed)
        good = sum(row["status"] == "converged" for row in rows)
        lines.append(f"- Seed {seed}: {good} of {len(rows)} have a solution.")
    return lines


def remedies() -> list[str]:
    """Make the table of rollers with a solution by remedy."""
    with (HERE / "remedies.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    lines = ["| remedy | rollers | with a solution | negative film | above 90 s |"]
    lines.append("|---|---|---|---|---|")
    for text, test in REMEDIES.items():
        mine = [r["status"] for r in rows if re.fullmatch(test, f"{r['profile']} {r['remedy']}")]
        counts = [mine.count(status) for status in ("converged", "negative film", "time limit")]
        assert sum(counts) == len(mine)
        lines.append(f"| {text} | {len(mine)} | " + " | ".join(map(str, counts)) + " |")
    return lines


def _record(seed: int) -> list[dict[str, Any]]:
    text = (HERE / f"seed_{seed}.json").read_text("utf-8")
    return [row for row in json.loads(text)["rows"] if row["status"] != "refused"]


def main() -> None:
    """Write profiles.csv."""
    rows = list(runs())
    with (HERE / "profiles.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)


if __name__ == "__main__":
    main()
