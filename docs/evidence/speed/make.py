# SPDX-License-Identifier: BSD-3-Clause
r"""Make the tables of this folder from benchmark results, or print those of the documents.

python benchmarks/step.py --points 129,257,513 --error -o step.json
python benchmarks/step.py --points 1025 --front 0 --steps 16 -o step_1025.json
python benchmarks/smooth.py -o smooth.json
python benchmarks/skips.py -o skips.json
python benchmarks/sweep.py -o sweep.json
python benchmarks/prediction.py -o prediction.json
python benchmarks/step.py --points 257 --threads 1 --steps 384 \
    --cases wave-law,fractal-law,two-fractals -o laws.json
python benchmarks/smooth.py --points 257,513 --threads 1 --engines mlmi --cases circle,law,ellipse \
    -o more.json
python docs/evidence/speed/make.py read FOLDER    writes the tables, from these files
python docs/evidence/speed/make.py show           prints the tables of the documents
"""

from __future__ import annotations

import csv
import json
import sys
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent

Row = dict[str, Any]

# Names of problems in the documents
PROBLEMS = {
    "wave": "wave of Fig. 2",
    "fractal": "fractal surface of Table 1",
    "wave-law": "step of a wave, Eyring",
    "fractal-law": "step of a fractal surface, Eyring",
    "two-fractals": "step of two rough surfaces",
    "law": "smooth contact, Eyring",
    "ellipse": "smooth ellipse, κ = 2",
}
PREDICTIONS = {
    "fractal": "fractal surface of Table 1",
    "fractal-law": "fractal surface of Table 1, Eyring",
    "two-fractals": "two fractal surfaces",
}

# Source files of each table, its columns and their formats
TABLES: dict[str, tuple[tuple[str, ...], dict[str, str]]] = {
    "steps": (
        ("step", "step_1025"),
        {
            **{"points": "d", "case": "s", "domain": "s", "threads": "d", "cycles": ".2f"},
            **{"units": ".1f", "speedup": ".2f", "error": ".1e"},
        },
    ),
    "runs": (
        ("step",),
        {
            **{"points": "d", "case": "s", "threads": "d", "status": "s", "steps": "d"},
            **{"units": ".0f", "unit_seconds": ".2e", "mu_ratio": ".5f", "error": ".1e"},
        },
    ),
    "smooth": (
        ("smooth",),
        {
            **{"points": "d", "engine": "s", "threads": "d", "status": "s", "cycles": "d"},
            **{"units": ".1f", "error": ".1e", "estimated_error": ".1e"},
        },
    ),
    "ratios": (
        ("laws", "more"),
        {"case": "s", "points": "d", "cycles": "g", "ratio": ".2f"},
    ),
    "skips": (
        ("skips",),
        {
            **{"problem": "s", "skipped": "s", "saved": ".2f", "quantity": "s"},
            **{"difference": ".0e", "allowed": ".0e"},
        },
    ),
    "predictions": (
        ("prediction",),
        {
            **{"problem": "s", "unit_seconds": ".4f", "seconds": ".3f"},
            **{"units": ".1f", "smooth": ".1f", "bands": ".1f"},
        },
    ),
    "sweep": (
        ("sweep",),
        {
            **{"problem": "s", "cases": "d", "processes": "d", "cases_per_core_hour": ".0f"},
            **{"busy": ".2f", "efficiency": ".2f"},
        },
    ),
}


def read_measurements(folder: Path) -> None:
    """Write the tables."""
    for name, (files, columns) in TABLES.items():
        result = [json.loads((folder / f"{file}.json").read_text()) for file in files]
        rows = runs(result[0]) if name == "runs" else [row for one in result for row in one["rows"]]
        with (HERE / f"{name}.csv").open("w", newline="", encoding="utf-8") as stream:
            writer = csv.writer(stream, lineterminator="\n")
            writer.writerow(columns)
            for row in rows:
                writer.writerow(
                    "" if row[key] is None else format(row[key], form)
                    for key, form in columns.items()
                )


def runs(measured: dict[str, Any]) -> list[Row]:
    """Express the time of whole runs in the unit of steps on their grid."""
    unit = {row["points"]: row["unit_seconds"] for row in measured["rows"]}
    return [
        row | {"unit_seconds": unit[row["points"]], "units": row["seconds"] / unit[row["points"]]}
        for row in measured["runs"]
    ]


def table(name: str) -> list[Row]:
    """Read a table."""
    with (HERE / f"{name}.csv").open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def lines(head: str, rows: list[list[str]]) -> list[str]:
    """Make a table of a document."""
    return [
        head,
        "|---" * (head.count("|") - 1) + "|",
        *("| " + " | ".join(r) + " |" for r in rows),
    ]


def two_digits(value: float) -> str:
    """Write a number to two digits, without an exponent."""
    return f"{float(f'{value:.2g}'):g}"


def percent(error: str) -> str:
    """Write an error in per cent, to two digits."""
    return f"{100.0 * float(error):.2g} %" if error else ""


def steps() -> list[str]:
    """Make the table of time steps: each problem on one thread and on two."""
    rows = table("steps")
    result = []
    for one, two in zip(rows[::2], rows[1::2], strict=True):
        half = ", half of the domain" if one["domain"] == "half" else ""
        grid = f"{one['points']} × {one['points']}"
        units = one["units"], two["units"]
        result.append(
            [grid, PROBLEMS[one["case"]] + half, one["cycles"], *units, percent(one["error"])]
        )
    return lines(
        "| grid | problem | cycles per step | units, one thread | two threads | error of μ_r/μ_s |",
        result,
    )


def whole() -> list[str]:
    """Make the table of whole transient runs."""
    result = [
        [
            f"{row['points']} × {row['points']}",
            PROBLEMS[row["case"]],
            *(row["steps"], row["units"], f"{float(row['mu_ratio']):.3f}", percent(row["error"])),
        ]
        for row in table("runs")
    ]
    return lines("| grid | problem | steps | units, two threads | μ_r/μ_s | error |", result)


def smooth() -> list[str]:
    """Make the table of smooth contacts by multi-integration and by FFT."""
    rows = {(r["points"], r["engine"], r["threads"]): r for r in table("smooth")}
    result = []
    for points in dict.fromkeys(key[0] for key in rows):
        row = rows[points, "mlmi", "1"]
        if row["status"] != "converged":
            continue
        units = [
            rows[points, *how]["units"] for how in (("mlmi", "1"), ("mlmi", "2"), ("fft", "1"))
        ]
        result.append([f"{points} × {points}", row["cycles"], *units, percent(row["error"])])
    return lines(
        "| grid | cycles on the finest grid | units, one thread | two threads | FFT, one thread "
        "| error of H_c |",
        result,
    )


def ratios() -> list[str]:
    """Make the table of the cost of a law, an ellipse or a second surface."""
    result = [
        [PROBLEMS[row["case"]], f"{row['points']} nodes", row["ratio"]]
        for row in table("ratios")
        if row["case"] in PROBLEMS
    ]
    return lines("| problem | along X | time per node |", result)


def power(text: str) -> str:
    """Format a small number as in the documents."""
    digit, _, exponent = text.partition("e")
    if float(text) == 0.0:
        return "0"
    marks = str(int(exponent)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return f"10{marks}" if digit == "1" else f"{digit}·10{marks}"


def skips() -> list[str]:
    """Make the table of skipped computations."""
    result = []
    for row in table("skips"):
        what = row["skipped"].replace("time.start = 'prediction'", "`time.start = 'prediction'`")
        quantity = (
            row["quantity"].replace("mu_ratio", "μ_r/μ_s").replace("coarser H_c", "H_c there")
        )
        numbers = power(row["difference"]), power(row["allowed"])
        result.append(
            [row["problem"], what, f"{100 * float(row['saved']):.0f} %", quantity, *numbers]
        )
    return lines("| problem | omitted | time saved | quantity | change | allowed |", result)


def predictions() -> list[str]:
    """Make the table of predictions."""
    result = [
        [PREDICTIONS[row["problem"]], row["units"], row["smooth"], row["bands"]]
        for row in table("predictions")
    ]
    return lines(
        "| prediction | units | for the smooth contact | for the bands |", result
    )


def sweep() -> list[str]:
    """Make the table of studies, in units of a smooth contact on 257 x 257 nodes."""
    rows = table("sweep")
    rate = {(row["problem"], row["processes"]): float(row["cases_per_core_hour"]) for row in rows}
    names = {
        "film": "film formulas (`pyehl film`)",
        "predict": "prediction, each with its own smooth contact",
        "predict shared": "prediction, one smooth contact for all",
        "smooth 257": "smooth contact, 257 × 257",
        "transient 257": "transient run of a wave, 257 × 257",
        "transient 513": "transient run of a wave, 513 × 513",
    }
    result = [
        [
            names[row["problem"]],
            two_digits(rate["smooth 257", "1"] / rate[row["problem"], "1"]),
            f"{2.0 * float(row['efficiency']):.1f}",
        ]
        for row in rows
        if row["processes"] == "2"
    ]
    return lines("| computation | units | throughput of two processes over one |", result)


def main() -> None:
    """Run the command of the first argument."""
    if sys.argv[1:2] == ["read"] and len(sys.argv) == 3:
        read_measurements(Path(sys.argv[2]))
    elif sys.argv[1:] == ["show"]:
        every = steps, whole, smooth, predictions, ratios, sweep, skips
        print("\n\n".join("\n".join(made()) for made in every))
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
