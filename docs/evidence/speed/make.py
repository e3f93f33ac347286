# SPDX-License-Identifier: BSD-3-Clause
"""What docs/speed.md and docs/robustness.md say of time: python docs/evidence/speed/make.py FOLDER.

FOLDER holds what the benchmarks have written, on an idle machine:

    pyehl bench step --points 129,257,513 --error -o FOLDER/step.json
    pyehl bench step --points 1025 --front 0 --steps 16 -o FOLDER/step_1025.json
    pyehl bench smooth --engines mlmi -o FOLDER/smooth.json
    pyehl bench sweep -o FOLDER/sweep.json
    pyehl bench skips -o FOLDER/skips.json

Writes step.csv, smooth.csv, sweep.csv and skips.csv beside this file. Without FOLDER the tables of
the two pages are printed from these.
"""

from __future__ import annotations

import csv
import json
import math
import sys
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
COLUMNS = {
    "step": "points case domain threads units speedup cycles error".split(),
    "smooth": "points threads status cycles units H_c error estimated_error".split(),
    "sweep": "scene cases processes cases_per_core_hour overhead_ms efficiency".split(),
    "skips": "scene skipped seconds without quantity difference allowed".split(),
}
SCENES = {"wave": "wave of Fig. 2", "fractal": "fractal surface of Table 1"}

Row = dict[str, str]


def rows(name: str) -> list[Row]:
    """Read a table."""
    with (HERE / f"{name}.csv").open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def write(folder: Path) -> None:
    """Make the tables from what the benchmarks have written."""
    for name, columns in COLUMNS.items():
        found: list[dict[str, Any]] = []
        for path in sorted(folder.glob(f"{name}*.json")):
            found += json.loads(path.read_text(encoding="utf-8"))["rows"]
        with (HERE / f"{name}.csv").open("w", encoding="utf-8", newline="") as stream:
            writer = csv.DictWriter(stream, columns, extrasaction="ignore", lineterminator="\n")
            writer.writeheader()
            for row in found:
                rounded = {
                    k: f"{v:.4g}" if isinstance(v, float) and k != "H_c" else v
                    for k, v in row.items()
                }
                writer.writerow(rounded)


def table(head: list[str], lines: list[list[str]]) -> list[str]:
    """Lay out a table of a page."""
    return ["| " + " | ".join(cells) + " |" for cells in [head, ["---"] * len(head), *lines]]


def short(text: str, digits: int = 2) -> str:
    """Round a number to some digits, without an exponent; nothing stays nothing."""
    if not text:
        return ""
    value = float(text)
    if value == 0.0:
        return "0"
    places = max(0, digits - 1 - math.floor(math.log10(abs(value))))
    return f"{value:.{places}f}"


def share(text: str) -> str:
    """Write a relative error in per cent."""
    return f"{short(str(100.0 * float(text)))} %" if text and float(text) else ""


def power(text: str) -> str:
    """Write a difference as a power of ten with one digit."""
    if float(text) == 0.0:
        return "0"
    digit, exponent = f"{float(text):.0e}".split("e")
    raised = str(int(exponent)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return f"10{raised}" if digit == "1" else f"{digit}·10{raised}"


def steps() -> list[str]:
    """Make the table of time steps: a line for each scene, the numbers of threads side by side."""
    found: dict[tuple[str, str, str], list[Row]] = {}
    for row in rows("step"):
        if int(row["points"]) >= 257:
            found.setdefault((row["points"], row["case"], row["domain"]), []).append(row)
    lines = []
    for (points, scene, domain), group in found.items():
        one, two = group
        name = SCENES[scene] + (", half the domain" if domain == "half" else "")
        units = [short(row["units"]) for row in (one, two)]
        # errors are those to the finest grid of a run of the benchmark
        lines.append(
            [f"{points} × {points}", name, short(one["cycles"]), *units, share(one["error"])]
        )
    head = [
        "grid",
        "scene",
        "cycles a step",
        "units, one thread",
        "two threads",
        "error of μ_r/μ_s",
    ]
    return table(head, lines)


def smooth() -> list[str]:
    """Make the table of smooth contacts on one thread."""
    head = ["grid", "units", "cycles on the finest grid", "error of H_c", "stated"]
    lines = [
        [
            f"{row['points']} × {row['points']}",
            short(row["units"]),
            row["cycles"],
            share(row["error"]),
            share(row["estimated_error"]),
        ]
        for row in rows("smooth")
        if row["threads"] == "1" and int(row["points"]) >= 129
    ]
    return table(head, lines)


def sweep() -> list[str]:
    """Make the table of studies: cases a core-hour with one process, and what two gain."""
    head = ["cases", "a core-hour", "overhead a case [ms]", "two processes over one"]
    found: dict[str, list[Row]] = {}
    for row in rows("sweep"):
        found.setdefault(row["scene"], []).append(row)
    lines = []
    for scene, (one, two) in found.items():
        rounded = float(f"{float(one['cases_per_core_hour']):.2g}")
        rate = f"{rounded:,.0f}".replace(",", " ")
        gain = f"{2.0 * float(two['efficiency']):.1f}"
        lines.append([scene, rate, short(one["overhead_ms"]), gain])
    return table(head, lines)


def skips() -> list[str]:
    """Make the table of what a scene does not need."""
    head = ["scene", "not done", "seconds", "with it", "quantity", "difference", "allowed"]
    lines, last = [], ""
    for row in rows("skips"):
        scene = "" if row["scene"] == last else row["scene"]
        last = row["scene"]
        times = [short(row["seconds"]), short(row["without"])]
        errors = [power(row["difference"]), power(row["allowed"])]
        lines.append([scene, row["skipped"], *times, row["quantity"], *errors])
    return table(head, lines)


if __name__ == "__main__":
    if sys.argv[1:]:
        write(Path(sys.argv[1]))
    for made in (steps(), smooth(), sweep(), skips()):
        print(*made, "", sep="\n")
