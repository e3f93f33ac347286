# SPDX-License-Identifier: BSD-3-Clause
r"""Make the tables of random contacts, or print those of the documents.

python benchmarks/machines.py --seed 1 -o seed1.json
python benchmarks/machines.py --seed 2 -o seed2.json
python benchmarks/machines.py --seed 3 -o seed3.json
python benchmarks/machines.py --seed 4 --count 16 --fine -o seed4.json
python benchmarks/machines.py --seed 10 --count 44 -o seed10.json
python benchmarks/machines.py --seed 12 --count 44 -o seed12.json
python benchmarks/machines.py --seed 21 --count 40 --fine -o seed21.json
python benchmarks/machines.py --seed 777 --count 40 --fine -o seed777.json
python docs/evidence/machines/make.py read seed1.json seed2.json seed3.json \
    seed4.json seed10.json seed12.json seed21.json seed777.json
python benchmarks/machines.py --shape line --seed 1 --count 200 --fine -o lines1.json
python benchmarks/machines.py --shape line --seed 7 --count 200 --fine -o lines7.json
python benchmarks/machines.py --shape line --seed 12 --count 200 --fine -o lines12.json
python docs/evidence/machines/make.py lines lines1.json lines7.json lines12.json
python benchmarks/machines.py --shape narrow --seed 1 --count 30 --fine -o narrow1.json
python benchmarks/machines.py --shape narrow --seed 2 --count 60 -o narrow2.json
python docs/evidence/machines/make.py narrow narrow1.json narrow2.json
python docs/evidence/machines/make.py show
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "benchmarks"))
from machine_tables import Row, read, write
from machines import summary

LINES, NARROW = "lines.csv", "narrow.csv"
COLUMNS = (
    *("seed", "number", "kind", "law", "ellipticity", "hertz_pressure_Pa", "moes_m", "moes_l"),
    *("points", "points_y", "status", "restarts", "cycles", "total_cycles", "seconds"),
    *("H_c", "H_c_error", "H_c_error_grid", "H_min", "H_min_error", "H_min_error_grid"),
    *("film_scale_m", "fine_status", "H_c_fine", "H_min_fine", "message"),
)
RUNS = ("seed", "count", "fine", "processor", "build")


def collect(files: list[str], name: str = "contacts.csv") -> None:
    """Write the contacts, and for ellipses also the runs."""
    results = [json.loads(Path(file).read_text(encoding="utf-8")) for file in files]
    rows = [row for result in results for row in result["rows"]]
    for row in rows:
        row["law"] = row["values"].get("lubricant.shear_law", "newtonian")
        row["message"] = (row["message"] or "").partition("\n")[0]
    write(name, COLUMNS, rows)
    if name in {LINES, NARROW}:
        return
    runs = [result | result["machine"] | {"fine": int(result["fine"])} for result in results]
    write("runs.csv", RUNS, runs)


def robustness(name: str = "contacts.csv") -> list[str]:
    """Table of docs/robustness.md."""
    lines = [
        "| contacts | drawn | converged | restarted | checked | h_c covered | h_min covered |",
        "|---|---|---|---|---|---|---|",
    ]
    names = ("drawn", "converged", "restarts", "checked", "h_c_covered", "h_min_covered")
    return lines + [
        _line(row, [f"{row[column]}" for column in names]) for row in summary(read(name))
    ]


def speed(name: str = "contacts.csv") -> list[str]:
    """Table of docs/speed.md."""
    lines = [
        "| contacts | median time | longest time | median, relative | longest, relative |",
        "|---|---|---|---|---|",
    ]
    for row in summary(read(name)):
        seconds = [row[name] for name in ("median_seconds", "largest_seconds")]
        times = [f"{each:.0f} s" if each > 10.0 else f"{each:.2g} s" for each in seconds]
        ratios = [f"{row[name]:.1f}" for name in ("median_ratio", "largest_ratio")]
        lines.append(_line(row, times + ratios))
    return lines


def _line(row: Row, cells: list[str]) -> str:
    name = row["contacts"].replace("kappa", "κ")
    return f"| {name} | {' | '.join(cells)} |"


def main(words: list[str]) -> None:
    """Run a command."""
    if words[0] == "read":
        collect(words[1:])
    elif words[0] == "lines":
        collect(words[1:], LINES)
    elif words[0] == "narrow":
        collect(words[1:], NARROW)
    else:
        print("\n\n".join("\n".join(f()) for f in (robustness, speed)))


if __name__ == "__main__":
    main(sys.argv[1:])
