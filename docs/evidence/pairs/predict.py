# SPDX-License-Identifier: BSD-3-Clause
"""Predict the rows of cases.csv that predicted.csv does not have, before their simulation.

python docs/evidence/pairs/predict.py
"""

from __future__ import annotations

import csv

import pyehl
from cases import HERE, case, rows, surfaces


def main() -> None:
    """Add missing predictions to the table; existing rows stay."""
    place = HERE / "predicted.csv"
    names = ["name", "status", "mu_ratio", "model_error", "position_error"]
    if not place.is_file():
        place.write_text(",".join(names) + "\n", encoding="utf-8")
    with place.open(encoding="utf-8") as stream:
        done = {row["name"] for row in csv.DictReader(stream)}
    for row in rows():
        if row["name"] in done:
            continue
        result = pyehl.predict(case(row), **surfaces(row), tracks=1)
        numbers = [result.mu_ratio, result.model_error, result.friction.position_error]
        words = [row["name"], result.friction.status, *(f"{v:.5f}" for v in numbers)]
        with place.open("a", newline="", encoding="utf-8") as stream:
            csv.writer(stream, lineterminator="\n").writerow(words)
        print(*words, flush=True)


if __name__ == "__main__":
    main()
