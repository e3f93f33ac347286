# SPDX-License-Identifier: BSD-3-Clause
"""Make hardest.csv from runs with either coarsening, five minutes each.

pyehl run docs/evidence/steps/hardest.nml -o auto
pyehl run docs/evidence/steps/hardest.nml --set solver.coarsening=classical -o classical
python docs/evidence/steps/hardest.py auto classical

mean, least, greatest: mean, minimum and maximum of the running means of mu_r/mu_s over 602 steps
(19 periods, to a fiftieth of a step) in the last 1600 steps; cycles: mean per step after the 400th.
"""

from __future__ import annotations

import csv
import json
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
WINDOW, LAST, FILLED = 602, 1600, 400


def main(folders: list[str]) -> None:
    """Write the table."""
    with (HERE / "hardest.csv").open("w", newline="", encoding="utf-8") as stream:
        table = csv.writer(stream, lineterminator="\n")
        table.writerow(["coarsening", "status", "steps", "cycles", "mean", "least", "greatest"])
        for folder in map(Path, folders):
            summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
            with (folder / "history.csv").open(encoding="utf-8") as history:
                rows = list(csv.DictReader(history))
            cycles = np.mean([float(row["cycles"]) for row in rows[FILLED:]])
            ratio = np.array([float(row["mu_ratio"]) for row in rows[-LAST:]])
            means = np.convolve(ratio, np.full(WINDOW, 1.0 / WINDOW), "valid")
            numbers = (cycles, means.mean(), means.min(), means.max())
            words = [folder.name, summary["status"], summary["steps"]]
            table.writerow([*words, *(f"{value:.5g}" for value in numbers)])


if __name__ == "__main__":
    main(sys.argv[1:])
