# SPDX-License-Identifier: BSD-3-Clause
"""Outcomes of killed runs, damaged states and mutated inputs: faults.csv.

python benchmarks/faults.py --kills 100 --inputs 1000 -o faults
python docs/evidence/faults/make.py faults/faults.json
python docs/evidence/faults/make.py show       prints the table of docs/robustness.md
"""

from __future__ import annotations

import csv
import json
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
COLUMNS = ("campaign", "trials", "outcomes", "wrong")


def lines() -> list[str]:
    """Make the table of docs/robustness.md."""
    result = ["| campaign | trials | outcomes | wrong |", "|---|---|---|---|"]
    with (HERE / "faults.csv").open(encoding="utf-8", newline="") as stream:
        result += [
            "| " + " | ".join(row[name] for name in COLUMNS) + " |"
            for row in csv.DictReader(stream)
        ]
    return result


def main(file: str) -> None:
    """Write the table, or show it."""
    if file == "show":
        print("\n".join(lines()))
        return
    rows = json.loads(Path(file).read_text(encoding="utf-8"))["rows"]
    with (HERE / "faults.csv").open("w", encoding="utf-8", newline="") as stream:
        table = csv.DictWriter(stream, COLUMNS, extrasaction="ignore", lineterminator="\n")
        table.writeheader()
        table.writerows(rows)


if __name__ == "__main__":
    main(sys.argv[1])
