# SPDX-License-Identifier: BSD-3-Clause
r"""Make contacts.csv from a campaign with boundary films.

python benchmarks/stress.py --shear-law eyring --boundary-film --cases 60 --seed 1 \
    --points 65,129 -o layers
python docs/evidence/stress/contacts.py layers/stress.json
"""

from __future__ import annotations

import csv
import json
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
COLUMNS = (
    *("family", "moes_m", "moes_l", "points", "boundary_film", "outcome", "steps", "difference"),
    *("allowed", "contact_load_share", "contact_load_share_error", "share_strict", "share_finer"),
    *("broken", "wrong"),
)


def main(file: str) -> None:
    """Write the table."""
    with (HERE / "contacts.csv").open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, COLUMNS, extrasaction="ignore", lineterminator="\n")
        writer.writeheader()
        for row in json.loads(Path(file).read_text())["rows"]:
            row["points"] = row["values"]["grid.points"]
            row["boundary_film"] = row["values"]["lubricant.boundary_film"]
            if row.get("broken") == "":
                row["broken"] = "none"
            writer.writerow({n: _rounded(row.get(n)) for n in COLUMNS})


def _rounded(value: object) -> object:
    return f"{value:.4g}" if isinstance(value, float) and value < 1.0 else value


if __name__ == "__main__":
    main(sys.argv[1])
