# SPDX-License-Identifier: BSD-3-Clause
"""Outcomes of random bearings and gear pairs.

``python benchmarks/catalogue.py --seed 7 --solve 15 -o seed7.json``, then
``python docs/evidence/catalogue/make.py seed7.json ...`` writes machines.csv.
"""

import csv
import json
import sys
from pathlib import Path

TABLE = Path(__file__).with_name("machines.csv")
NAMES = (
    *("seed", "number", "machine", "status", "faults", "contacts", "hertz_pressure_max_Pa"),
    *("h_c_min_m", "h_min_m", "torque_N_m", "efficiency", "converged", "film_ratio_min"),
    *("film_ratio_max", "h_c_error_max"),
)


def read() -> list[dict[str, str]]:
    """Give the rows of machines.csv."""
    with TABLE.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def lines() -> list[str]:
    """Make the table of outcomes by kind."""
    rows = read()
    result = [
        "| machines | drawn | refused | passed | contacts solved | converged "
        "| solved film over formula |",
        "|" + "---|" * 7,
    ]
    for kind in dict.fromkeys(row["machine"] for row in rows):
        mine = [row for row in rows if row["machine"] == kind]
        states = [row["status"] for row in mine]
        solved = [row for row in mine if row["converged"]]
        ratios = [float(row[f"film_ratio_{end}"]) for row in solved for end in ("min", "max")]
        result.append(
            f"| {kind} | {len(mine)} | {states.count('refused')} | {states.count('right')} | "
            f"{sum(int(row['contacts']) for row in solved)} | "
            f"{sum(int(row['converged']) for row in solved)} | "
            f"{min(ratios):.2f} to {max(ratios):.2f} |"
        )
    return result


def main(names: list[str]) -> None:
    """Write machines.csv."""
    with TABLE.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, NAMES, extrasaction="ignore", lineterminator="\n")
        writer.writeheader()
        for name in names:
            record = json.loads(Path(name).read_text("utf-8"))
            for row in record["rows"]:
                given = {k: f"{v:.5g}" if isinstance(v, float) else v for k, v in row.items()}
                faults = "; ".join(row["faults"]).split("\n")[0].partition("error: ")[2]
                writer.writerow({**given, "seed": record["seed"], "faults": faults})


if __name__ == "__main__":
    main(sys.argv[1:])
