# SPDX-License-Identifier: BSD-3-Clause
"""Predict the rows of cases.csv that predicted.csv does not have, before their simulation.

python docs/evidence/partial/predict.py
"""

from __future__ import annotations

import csv

import pyehl
from cases import HERE, case, rows

COLUMNS = (
    "contact_load_share",
    "contact_load_share_error",
    "contact_area_share",
    "contact_area_share_error",
    "mu",
    "mu_smooth",
    "mu_ratio_model_error",
    "h_min_rough_m",
    "h_min_rough_error_m",
    "wall_seconds",
)


def main() -> None:
    """Add missing predictions to the table; existing rows stay."""
    place = HERE / "predicted.csv"
    if not place.is_file():
        place.write_text(",".join(("name", "status", *COLUMNS)) + "\n", encoding="utf-8")
    with place.open(encoding="utf-8") as stream:
        done = {row["name"] for row in csv.DictReader(stream)}
    for row in rows():
        if row["name"] in done:
            continue
        result = pyehl.predict(case(row), tracks=1).summary
        numbers = [result[name] for name in COLUMNS]
        words = ["" if v is None else f"{v:.5g}" for v in numbers]
        with place.open("a", newline="", encoding="utf-8") as stream:
            writer = csv.writer(stream, lineterminator="\n")
            writer.writerow([row["name"], result["status"], *words])
        print(row["name"], result["status"], *words, flush=True)


if __name__ == "__main__":
    main()
