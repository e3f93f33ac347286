# SPDX-License-Identifier: BSD-3-Clause
r"""Make campaign.csv from a campaign of `benchmarks/mixed.py`.

python benchmarks/mixed.py --contacts 100 --simulate 100 --seed 1 -o mixed.json
python docs/evidence/partial/campaign.py mixed.json
"""

from __future__ import annotations

import csv
import json
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
SHARES = ("contact_load_share", "contact_load_share_error")
COLUMNS = (
    *("contact", "kind", "points", "over", "moes_m", "moes_l", "slide_to_roll", "law"),
    *(f"{of}_{name}" for name in ("status", *SHARES) for of in ("predicted", "solved")),
    *("difference", "allowed", "predicted_mu", "predicted_mu_smooth", "predicted_mu_ratio"),
    *("solved_mu", "mu_difference", "mu_allowed", "broken"),
)


def main(file: str) -> None:
    """Write the table."""
    with (HERE / "campaign.csv").open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, COLUMNS, extrasaction="ignore", lineterminator="\n")
        writer.writeheader()
        for row in json.loads(Path(file).read_text(encoding="utf-8"))["rows"]:
            row |= {name: row[f"predicted_{name}"] for name in ("moes_m", "moes_l")}
            row["slide_to_roll"] = row["values"]["contact.slide_to_roll"]
            row["law"] = row["values"]["lubricant.shear_law"]
            row["broken"] = "; ".join(row["broken"])
            writer.writerow({n: _rounded(row.get(n)) for n in COLUMNS})


def _rounded(value: object) -> object:
    return f"{value:.4g}" if isinstance(value, float) else value


if __name__ == "__main__":
    main(sys.argv[1])
