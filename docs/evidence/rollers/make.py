# SPDX-License-Identifier: BSD-3-Clause
"""Rollers of one load with four profiles, straight and misaligned, and random rollers.

``python docs/evidence/rollers/make.py`` writes profiles.csv, and random.csv is of
``python benchmarks/rollers.py --csv docs/evidence/rollers/random.csv``.
"""

import csv
import math
from collections.abc import Iterator
from pathlib import Path

import pyehl

HERE = Path(__file__).resolve().parent
ROLLER = {
    "shape": "roller",
    "load": 2000.0,
    "length": 0.01,
    "radius": 0.005,
    "mean_velocity": 1.0,
}
# The three profiles drop by about as much at the end, the logarithm more steeply
PROFILES: dict[str, dict[str, float]] = {
    "none": {},
    "crown": {"crown_radius": 1.0},
    "logarithmic": {"log_amplitude": 4.2e-6},
    "chamfer": {"chamfer_length": 1e-3, "chamfer_drop": 1.25e-5},
}
POINTS = 257


def runs() -> Iterator[dict[str, str | float]]:
    """Solve each profile, straight and misaligned by 1 mrad."""
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
    """Give the table of profiles.csv."""
    with (HERE / "profiles.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    lines = [
        "| profile | misalignment | h_c | h_min, at y/length | largest pressure, at y/length |",
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
        known = f" ± {error:.0f}" if math.isfinite(error) else " (error not known)"
        places = [n[name] / n["length"] for name in ("H_min_Y", "P_max_Y")]
        end = "" if math.isfinite(error) else ", rises with finer cells"
        lines.append(
            f"| {row['profile']} | {angle} | {films[0]:.0f} nm | {films[1]:.0f}{known} nm, "
            f"{places[0]:+.2f} | {n['p_max_Pa'] * 1e-9:.2f} GPa, {places[1]:+.2f}{end} |"
        )
    return [line.replace("-0.00", "0.00").replace("+0.00", "0.00") for line in lines]


def random() -> list[str]:
    """Give the table of random.csv."""
    with (HERE / "random.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    lines = ["| profile | rollers | with a solution | without |", "|---|---|---|---|"]
    for profile in ("logarithmic", "crown", "chamfer", "none"):
        found = [row["status"] for row in rows if row["profile"] == profile]
        good = found.count("converged")
        others = sorted({status for status in found if status != "converged"})
        failed = ", ".join(f"{status} {found.count(status)}" for status in others) or "–"
        lines.append(f"| {profile} | {len(found)} | {good} | {failed} |")
    return lines


def main() -> None:
    """Write profiles.csv."""
    rows = list(runs())
    with (HERE / "profiles.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)


if __name__ == "__main__":
    main()
