# SPDX-License-Identifier: BSD-3-Clause
"""Make workprec.csv and workprec.png from what the benchmark measured.

python benchmarks/workprec.py --full -o workprec.json
python docs/evidence/workprec/make.py workprec.json

Problems may have been measured one at a time (``--problems``): several files are put together.
"""

from __future__ import annotations

import csv
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "benchmarks"))
from figures import draw_work
from workprec import COLUMNS

HERE = Path(__file__).resolve().parent


def main(files: list[str]) -> None:
    """Write the table and the figure."""
    rows = [row for file in files for row in json.loads(Path(file).read_text())["rows"]]
    with (HERE / "workprec.csv").open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(name for name, _ in COLUMNS)
        for row in rows:
            writer.writerow(
                "" if row[name] is None else format(row[name], form) for name, form in COLUMNS
            )
    # the film and one panel of each rough problem
    shown = [row for row in rows if row["quantity"] in ("H_c", "mu_ratio")]
    draw_work(shown, HERE / "workprec.png")


if __name__ == "__main__":
    main(sys.argv[1:])
