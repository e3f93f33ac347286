# SPDX-License-Identifier: BSD-3-Clause
"""Make laws.csv from campaigns with and without a shear law, and print the outcomes.

python benchmarks/stress.py --shear-law eyring --cases 60 --seed 1 --points 65,129 -o eyring
python benchmarks/stress.py --shear-law carreau --cases 60 --seed 1 --points 65,129 -o carreau
python benchmarks/stress.py --cases 60 --seed 1 --points 65,129 -o newtonian
python docs/evidence/stress/laws.py {eyring,carreau,newtonian}/stress.json
"""

from __future__ import annotations

import csv
import json
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
COLUMNS = (
    *("law", "stress", "exponent", "family", "moes_m", "moes_l", "points", "outcome"),
    *("steps", "difference", "allowed", "wrong"),
)


def main(files: list[str]) -> None:
    """Write the table; print counts and the maximum difference over the allowed one."""
    with (HERE / "laws.csv").open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, COLUMNS, extrasaction="ignore", lineterminator="\n")
        writer.writeheader()
        for file in files:
            rows = json.loads(Path(file).read_text())["rows"]
            for row in rows:
                values = row["values"]
                row["law"] = values.get("lubricant.shear_law", "newtonian")
                row["stress"] = values.get(f"lubricant.{row['law']}_stress")
                row["exponent"] = values.get("lubricant.carreau_exponent")
                row["points"] = values["grid.points"]
                writer.writerow({n: _rounded(row.get(n)) for n in COLUMNS})
            checked = [row for row in rows if row["difference"] is not None]
            worst = max(row["difference"] / row["allowed"] for row in checked)
            wrong = sum(row["wrong"] for row in rows)
            print(f"{file}: {len(rows)} cases, {len(checked)} checked, {wrong} wrong, {worst:.2f}")


def _rounded(value: object) -> object:
    return f"{value:.3g}" if isinstance(value, float) and value < 1.0 else value


if __name__ == "__main__":
    main(sys.argv[1:])
