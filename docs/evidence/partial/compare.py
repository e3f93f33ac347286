# SPDX-License-Identifier: BSD-3-Clause
"""Compare earlier predictions with the later simulations of the same contacts.

Writes table.csv beside this file and prints deviations and coverage:

    python docs/evidence/partial/compare.py
"""

from __future__ import annotations

import csv
from typing import Any

import numpy as np

import pyehl
from cases import HERE, case, rows


def read(name: str) -> dict[str, dict[str, str]]:
    """Read a table by the names of its rows."""
    with (HERE / name).open(encoding="utf-8") as stream:
        return {row["name"]: row for row in csv.DictReader(stream)}


def compared() -> list[dict[str, Any]]:
    """Merge the rows of all contacts whose simulation converged."""
    before, simulated = read("predicted.csv"), read("simulated.csv")
    table = []
    for row in rows():
        result = simulated.get(row["name"])
        if result is None or result["status"] != "converged":
            continue
        then, now = before[row["name"]], pyehl.predict(case(row), tracks=1).summary
        line: dict[str, Any] = {
            "name": row["name"],
            "points": int(row["points"]),
            "moes_m": round(float(result["moes_m"])),
            "moes_l": round(float(result["moes_l"]), 1),
            "slide_to_roll": row["slide_to_roll"],
        }
        for name, digits in (("contact_load_share", 4), ("contact_area_share", 4), ("mu", 4)):
            line |= {
                name: round(float(result[name]), digits),
                f"{name}_predicted": round(float(then[name]), digits),
                f"{name}_now": round(now[name], digits),
            }
        error = round(now["contact_load_share_error"], 4)
        grid = round(float(result["contact_load_share_error_grid"]), 4)
        off = abs(now["contact_load_share"] - float(result["contact_load_share"]))
        line |= {
            "simulation_error": grid,
            "stated_error": error,
            "covered": int(off <= error),
        }
        table.append(line)
        print(*line.values(), flush=True)
    return table


def report(table: list[dict[str, Any]]) -> None:
    """Print deviations and coverage of cases used in development and of blind predictions."""
    for which, letter in (("development", "c"), ("blind", "d")):
        part = [row for row in table if row["name"].startswith(letter)]
        off, area = (
            np.array([row[f"{name}_now"] - row[name] for row in part])
            for name in ("contact_load_share", "contact_area_share")
        )
        friction = np.array([row["mu_now"] / row["mu"] - 1.0 for row in part])
        print(
            f"{which}: {len(part)} contacts; load share off by {off.mean():+.3f} in the mean, "
            f"{np.sqrt(np.mean(off**2)):.3f} rms, {np.abs(off).max():.3f} at most; "
            f"area {np.sqrt(np.mean(area**2)):.3f} rms; mu "
            f"{100 * np.sqrt(np.mean(friction**2)):.0f} % rms; "
            f"{sum(row['covered'] for row in part)} covered"
        )


def main() -> None:
    """Compare and print."""
    table = compared()
    with (HERE / "table.csv").open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, table[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(table)
    report(table)


if __name__ == "__main__":
    main()
