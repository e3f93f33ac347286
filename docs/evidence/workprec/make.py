# SPDX-License-Identifier: BSD-3-Clause
"""Make workprec.csv and workprec.png from the results of the benchmark.

python benchmarks/workprec.py --full -o workprec.json
python docs/evidence/workprec/make.py workprec.json
python docs/evidence/workprec/make.py            # draws the stored table

Problems may have been measured one at a time (``--problems``); several files are merged.
"""

from __future__ import annotations

import csv
import json
import sys
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "benchmarks"))
from figures import draw_work
from workprec import COLUMNS

HERE = Path(__file__).resolve().parent


def main(files: list[str]) -> None:
    """Write the table of the files, and draw the figure."""
    if files:
        write([row for file in files for row in json.loads(Path(file).read_text())["rows"]])
    # the film and one panel of each rough problem
    draw_work([r for r in read() if r["quantity"] in ("H_c", "mu_ratio")], HERE / "workprec.png")


def write(rows: list[dict[str, Any]]) -> None:
    """Write the table."""
    with (HERE / "workprec.csv").open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(name for name, _ in COLUMNS)
        for row in rows:
            writer.writerow(
                "" if row[name] is None else format(row[name], form) for name, form in COLUMNS
            )


def read() -> list[dict[str, Any]]:
    """Rows of the table: numbers, words, and None for empty cells."""
    with (HERE / "workprec.csv").open(newline="", encoding="utf-8") as stream:
        return [{name: value_of(cell) for name, cell in r.items()} for r in csv.DictReader(stream)]


def value_of(cell: str) -> str | float | None:
    """Read a cell."""
    try:
        return float(cell) if cell else None
    except ValueError:
        return cell


if __name__ == "__main__":
    main(sys.argv[1:])
