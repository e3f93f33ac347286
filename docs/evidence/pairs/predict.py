# SPDX-License-Identifier: BSD-3-Clause
"""Predict all rows of cases.csv and write predicted.csv, before anything is simulated.

python docs/evidence/pairs/predict.py
"""

from __future__ import annotations

import csv

import pyehl
from cases import HERE, case, rows, surfaces


def main() -> None:
    """Predict and write the table."""
    table = []
    for row in rows():
        found = pyehl.predict(case(row), **surfaces(row), tracks=1)
        numbers = [found.mu_ratio, found.model_error, found.friction.position_error]
        table.append([row["name"], found.friction.status, *(f"{v:.5f}" for v in numbers)])
        print(*table[-1], flush=True)
    with (HERE / "predicted.csv").open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(["name", "status", "mu_ratio", "model_error", "position_error"])
        writer.writerows(table)


if __name__ == "__main__":
    main()
