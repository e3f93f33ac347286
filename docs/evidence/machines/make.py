# SPDX-License-Identifier: BSD-3-Clause
r"""Make the tables of this folder, or print those of the documents.

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
python docs/evidence/machines/make.py narrow_sides    narrow_sides.csv
python docs/evidence/machines/make.py sides    sides.csv
python docs/evidence/machines/make.py cells    cells.csv
python docs/evidence/machines/make.py straight straight.csv
python docs/evidence/machines/make.py border   border.csv
python docs/evidence/machines/make.py show     prints the tables of the documents
"""

from __future__ import annotations

import csv
import json
import math
import sys
from collections.abc import Iterable
from pathlib import Path
from statistics import median
from typing import Any

import pyehl

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "benchmarks"))
from machines import DISC, SETTINGS, draw, draw_narrow, radius_ratio, summary, timed

HERE = Path(__file__).resolve().parent
LINES, NARROW = "lines.csv", "narrow.csv"
COLUMNS = (
    *("seed", "number", "kind", "law", "ellipticity", "hertz_pressure_Pa", "moes_m", "moes_l"),
    *("points", "points_y", "status", "restarts", "cycles", "total_cycles", "seconds"),
    *("H_c", "H_c_error", "H_c_error_grid", "H_min", "H_min_error", "H_min_error_grid"),
    *("film_scale_m", "fine_status", "H_c_fine", "H_min_fine", "message"),
)
WORDS = frozenset(
    {
        *("kind", "law", "border", "processor", "build", "message"),
        *("status", "fine_status", "long_status"),
    }
)
RUNS = ("seed", "count", "fine", "processor", "build")
# kappa, and M and L by R_x
POINTS = (
    (2.2, 1000.0, 10.0),
    (4.0, 300.0, 12.0),
    (7.0, 5000.0, 15.0),
    (12.0, 100.0, 8.0),
    (18.0, 2000.0, 10.0),
)
# As `blunt_spike` in fortran/case/case_grid.f90: alpha p_h up to L = 10 and above; alpha p_h and L
# up to which the default cells are long, and L below which they are long at any alpha p_h
SHARP, MEDIUM_SHARP, MEDIUM, LOW = (21.0, 19.0), 35.0, 9.0, 7.0
# As `straight_edge` there; contacts of `straight.csv`: seeds, count, and smallest M by R_x
STRAIGHT, SEEDS, COUNT, LARGE = 22.0, range(30, 266), 60, 8e4
USUAL = 513
CELLS = (
    *("seed", "number", "law", "ellipticity", "moes_l", "alpha_p_h", "points", "points_y"),
    *("total_cycles", "seconds", "long_status", "long_total_cycles", "long_seconds"),
)
STRAIGHT_CELLS = (
    *("seed", "number", "law", "ellipticity", "moes_m", "moes_l", "alpha_p_h", "points"),
    *("points_y", "status", "total_cycles", "seconds", "H_c", "H_min"),
    *("long_points_y", "long_status", "long_total_cycles", "long_seconds"),
    *("long_H_c", "long_H_min", "long_H_c_error", "long_H_min_error"),
)
# Algebraic over discretisation error, small so that grids do not differ by algebraic errors
ACCURACY = 0.005
SIDES = (
    *("ellipticity", "moes_m", "moes_l", "points", "points_y", "x_mesh", "y_mesh", "y_extent"),
    "border",
    *("H_c", "H_min", "H_c_further", "H_min_further", "H_c_square", "H_min_square"),
    *("H_c_error_domain", "H_min_error_domain", "seconds", "seconds_further", "seconds_square"),
)

# Domains with one mesh size, 257 nodes on 4 a: border, inlet [a], sides over the half width; the
# first one is the reference
DOMAINS = (
    ("flooded", -4.5, 2.0),
    ("flooded", -2.5, 1.6),
    ("zero", -2.5, 1.6),
    ("zero", -4.5, 1.15),
    ("zero", -4.5, 1.3),
    ("zero", -4.5, 1.6),
    ("zero", -4.5, 2.0),
)
BORDER_KAPPA = (1.5, 2.2, 4.0, 8.0, 16.0)
BORDER_POINTS = ((700.0, 2.0), (2000.0, 1.0), (2000.0, 12.0), (10000.0, 8.0))
BORDER = (
    *("ellipticity", "moes_m", "moes_l", "border", "x_inlet", "y_extent", "points", "points_y"),
    *("status", "H_c", "H_min", "H_c_error_domain", "H_min_error_domain"),
)
# Sides of narrow contacts over `side_scale` of fortran/contact/domain.f90, the first one is the
# reference; number of contacts drawn, and nodes per scale between the middle and the sides
FURTHER = (10, 6, 4, 3, 2)
NARROW_DRAWN, NARROW_NODES = 60, 32
NARROW_SIDES = (
    *("number", "law", "ellipticity", "moes_m", "moes_l", "border", "over_scale", "status"),
    *("H_c", "H_min"),
)

Row = dict[str, Any]


def write(name: str, columns: tuple[str, ...], rows: Iterable[Row]) -> None:
    """Write a table."""
    with (HERE / name).open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, columns, extrasaction="ignore", lineterminator="\n")
        writer.writeheader()
        for row in rows:
            writer.writerow({name: _rounded(row.get(name)) for name in columns})


def _rounded(value: object) -> object:
    return f"{value:.6g}" if isinstance(value, float) else value


def read(name: str = "contacts.csv") -> list[Row]:
    """Read a table; None for an empty cell."""
    with (HERE / name).open(encoding="utf-8", newline="") as stream:
        return [{k: _value(k, v) for k, v in row.items()} for row in csv.DictReader(stream)]


def _value(name: str, text: str) -> float | int | str | None:
    if name in WORDS or not text:
        return text or None
    number = float(text)
    return int(number) if number.is_integer() and "." not in text else number


def collect(files: list[str], name: str = "contacts.csv") -> None:
    """Write the contacts, and for ellipses also the runs."""
    answers = [json.loads(Path(file).read_text(encoding="utf-8")) for file in files]
    rows = [row for answer in answers for row in answer["rows"]]
    for row in rows:
        row["law"] = row["values"].get("lubricant.shear_law", "newtonian")
        row["message"] = (row["message"] or "").partition("\n")[0]
    write(name, COLUMNS, rows)
    if name in {LINES, NARROW}:
        return
    runs = [answer | answer["machine"] | {"fine": int(answer["fine"])} for answer in answers]
    write("runs.csv", RUNS, runs)


def measure_sides() -> None:
    """Solve contacts on default grids, with sides 1.5 times as far, with cells half as long."""
    rows = []
    for kappa, moes_m, moes_l in POINTS:
        keys = {"contact.radius_ratio": radius_ratio(kappa), "contact.moes_m": moes_m}
        keys["contact.moes_l"] = moes_l
        keys |= SETTINGS | {"solver.accuracy": ACCURACY}
        grid = pyehl.Case.from_text("", keys).resolve()["grid"]
        extent = grid["y_extent"]
        row = timed(keys)
        across = row["points_y"] - 1
        # the same cells, and rows that can be coarsened
        rows_further = 64 * math.ceil(1.5 * across / 64)
        wider = {"grid.y_extent": extent * rows_further / across, "grid.points_y": rows_further + 1}
        further = timed(keys | wider)
        square = timed(keys | {"grid.points_y": 2 * across + 1})
        row |= {"y_extent": extent, "border": grid["border"]}
        for name in ("H_c", "H_min", "seconds"):
            row |= {f"{name}_further": further[name], f"{name}_square": square[name]}
        rows.append(row)
        print(kappa, row["H_c"], further["H_c"], square["H_c"])
    write("sides.csv", SIDES, rows)


def measure_cells() -> None:
    """Solve wide contacts of contacts.csv with a sharp spike on short cells and on long ones."""
    rows = []
    for row in read():
        contact = draw(row["number"] + 1, row["seed"])[row["number"]]
        alpha_p_h = contact.values["lubricant.pressure_viscosity"] * contact.pressure
        sharp = alpha_p_h > SHARP[row["moes_l"] > 10.0]
        if row["ellipticity"] < 5.0 or row["moes_l"] > 15.0 or not sharp or row["points"] < USUAL:
            continue
        medium = alpha_p_h < MEDIUM_SHARP or row["ellipticity"] > STRAIGHT
        is_long = row["moes_l"] < LOW or (row["moes_l"] < MEDIUM and medium)
        # so that half the rows can be coarsened as often
        unit = (row["points"] - 1) // 4
        across = unit * round((row["points_y"] - 1) * (2 if is_long else 1) / unit)
        keys = dict(contact.values) | SETTINGS | {"grid.points": row["points"]}
        short = timed(keys | {"grid.points_y": across + 1})
        long = timed(keys | {"grid.points_y": across // 2 + 1})
        result = row | {name: short[name] for name in ("points_y", "total_cycles", "seconds")}
        result |= {f"long_{name}": long[name] for name in ("status", "total_cycles", "seconds")}
        rows.append(result | {"alpha_p_h": alpha_p_h})
    write("cells.csv", CELLS, rows)


def cells() -> list[str]:
    """Make the table of times on long cells over those on short ones, by L."""
    lines = [
        "| L | α p_h | contacts | no solution on long cells | faster on long cells | median ratio "
        "of times, long over short cells |",
        "|---|---|---|---|---|---|",
    ]
    groups = [
        *((0.0, LOW, 0.0, math.inf), (LOW, MEDIUM, 0.0, MEDIUM_SHARP)),
        *((LOW, MEDIUM, MEDIUM_SHARP, math.inf), (MEDIUM, 15.0, 0.0, math.inf)),
    ]
    for low, high, least, most in groups:
        mine = [
            row
            for row in read("cells.csv")
            if low <= row["moes_l"] < high and least <= row["alpha_p_h"] < most
        ]
        good = [row for row in mine if row["long_status"] == "converged"]
        ratios = [row["long_seconds"] / row["seconds"] for row in good]
        faster = sum(ratio < 1.0 for ratio in ratios)
        lines.append(
            f"| {low:g} to {high:g} | {_between(least, most)} | {len(mine)} "
            f"| {len(mine) - len(good)} | {faster} | {median(ratios):.2f} |"
        )
    return lines


def measure_straight() -> None:
    """Solve very wide contacts of large M with L from 7 to 9 on long (default) and short cells."""
    rows = []
    for seed in SEEDS:
        for number, contact in enumerate(draw(COUNT, seed)):
            alpha_p_h = contact.values["lubricant.pressure_viscosity"] * contact.pressure
            if not (contact.ellipticity or 0.0) > STRAIGHT or not alpha_p_h > MEDIUM_SHARP:
                continue
            keys = dict(contact.values) | SETTINGS
            with pyehl.Solver(pyehl.Case.from_text("", keys)) as solver:
                point = solver.summary
            if not LOW < point["moes_l"] < MEDIUM or not point["moes_m"] > LARGE:
                continue
            long = timed(keys)
            short = timed(keys | {"grid.points_y": 2 * long["points_y"] - 1})
            row = {
                "seed": seed,
                "number": number,
                "law": contact.values.get("lubricant.shear_law", "newtonian"),
            }
            row |= {"ellipticity": contact.ellipticity, "alpha_p_h": alpha_p_h}
            rows.append(short | row | {f"long_{name}": long[name] for name in long})
            print(seed, number, rows[-1]["seconds"], rows[-1]["long_seconds"], flush=True)
    write("straight.csv", STRAIGHT_CELLS, rows)


def straight() -> list[str]:
    """Make the table of times on long cells over those on short ones, in very wide contacts."""
    lines = [
        "| contacts | without solution: short, long cells | faster on long cells | ratio of times: "
        "median, largest | largest change of h_c, h_min |",
        "|---|---|---|---|---|",
    ]
    mine = read("straight.csv")
    good = [row for row in mine if row["long_status"] == "converged" == row["status"]]
    ratios = [row["long_seconds"] / row["seconds"] for row in good]
    changes = [
        max(abs(row[f"long_{name}"] / row[name] - 1.0) for row in good) for name in ("H_c", "H_min")
    ]
    missing = [sum(row[name] != "converged" for row in mine) for name in ("status", "long_status")]
    lines.append(
        f"| {len(mine)} | {missing[0]}, {missing[1]} | {sum(ratio < 1.0 for ratio in ratios)} "
        f"| {median(ratios):.2f}, {max(ratios):.1f} "
        f"| {', '.join(f'{100.0 * change:.2f} %' for change in changes)} |"
    )
    return lines


def _between(least: float, most: float) -> str:
    """Name an interval of alpha p_h above the limits of SHARP."""
    if most < math.inf:
        return f"up to {most:g}"
    return f"above {least:g}" if least > 0.0 else "any"


def measure_border() -> None:
    """Solve wide contacts of M above 500 with either border on domains of several sizes."""
    rows = []
    mesh = 4.0 / 256
    for kappa in BORDER_KAPPA:
        for moes_m, moes_l in BORDER_POINTS:
            for border, inlet, sides in DOMAINS:
                across = 32 * max(1, round(2.0 * sides * kappa / (1.35 * mesh) / 32))
                keys = {"contact.radius_ratio": radius_ratio(kappa), "contact.moes_m": moes_m}
                keys |= {"contact.moes_l": moes_l, "grid.border": border, "grid.x_inlet": inlet}
                keys |= {"grid.x_outlet": 1.5, "grid.y_extent": 0.5 * across * 1.35 * mesh}
                points = round((1.5 - inlet) / mesh) + 1
                keys |= {"grid.points": points, "grid.points_y": across + 1}
                result = timed(keys | SETTINGS | {"solver.accuracy": ACCURACY})
                rows.append(result | {key.partition(".")[2]: keys[key] for key in keys})
                rows[-1]["ellipticity"] = kappa
    write("border.csv", BORDER, rows)


def by_border() -> list[str]:
    """Table of docs/theory/border.md: changes of H_c against the reference, and stated errors."""
    lines = ["| κ | P = 0 | stated | flooded border | stated |", "|---|---|---|---|---|"]
    groups: dict[float, dict[str, list[tuple[float, float]]]] = {}
    limit = math.nan
    for row in read("border.csv"):
        first = (row["border"], row["x_inlet"]) == DOMAINS[0][:2]
        if first:
            limit = row["H_c"]
        elif row["x_inlet"] == -2.5:
            of = groups.setdefault(row["ellipticity"], {}).setdefault(row["border"], [])
            of.append((row["H_c"] / limit - 1.0, row["H_c_error_domain"] / row["H_c"]))
    for kappa, of in groups.items():
        worst = [max(of[name], key=lambda pair: abs(pair[0])) for name in ("zero", "flooded")]
        cells = [f"{100.0 * change:+.2f} % | {100.0 * stated:.2f} %" for change, stated in worst]
        lines.append(f"| {kappa:g} | {' | '.join(cells)} |")
    return lines


def measure_narrow_sides() -> None:
    """Solve narrow contacts on 257 nodes along the motion with either border and sides."""
    rows = []
    for number, contact in enumerate(draw_narrow(NARROW_DRAWN, 3)):
        keys = dict(contact.values) | SETTINGS
        kappa, ratio = contact.ellipticity, keys["contact.radius_y"] / keys["contact.radius_x"]
        if contact.kind == DISC or kappa is None:
            continue
        film = timed(keys)["H_c"]
        scale = math.sqrt(kappa**2 + 2.0 * (film or 0.0) * ratio)
        keys |= {"grid.points": 257, "solver.accuracy": ACCURACY}
        for border in ("flooded", "zero"):
            for over in FURTHER:
                sides = {"grid.border": border, "grid.y_extent": over * scale}
                row = timed(keys | sides | {"grid.points_y": 2 * over * NARROW_NODES + 1})
                row |= {"number": number, "ellipticity": kappa, "over_scale": over}
                row |= {"border": border, "law": keys["lubricant.shear_law"]}
                rows.append(row)
                if row["status"] != "converged":
                    break
    write("narrow_sides.csv", NARROW_SIDES, rows)


def narrow_sides() -> list[str]:
    """Maximum changes by nearer sides, by border and distance."""
    rows = read("narrow_sides.csv")
    limits = {
        (row["number"], row["border"]): row
        for row in rows
        if row["over_scale"] == FURTHER[0] and row["status"] == "converged"
    }
    lines = [
        "| sides at, in $\\ell_y$ | flooded border: h_c, h_min | P = 0: h_c, h_min |",
        "|---|---|---|",
    ]
    for over in FURTHER[1:]:
        cells = []
        for border in ("flooded", "zero"):
            mine = [
                (row, limits[row["number"], border])
                for row in rows
                if (row["border"], row["over_scale"], row["status"]) == (border, over, "converged")
            ]
            changes = (
                max(abs(row[name] / limit[name] - 1.0) for row, limit in mine)
                for name in ("H_c", "H_min")
            )
            cells.append(", ".join(f"{100.0 * change:.3f} %" for change in changes))
        lines.append(f"| {over} | {' | '.join(cells)} |")
    return lines


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


def sides() -> list[str]:
    """Table of docs/theory/coarse-grids.md."""
    lines = [
        "| κ | M, L | sides \\|Y\\| ≤ | cells | sides 1.5 times as far: h_c, h_min "
        "| cells half as long across: h_c, h_min |",
        "|---|---|---|---|---|---|",
    ]
    for row in read("sides.csv"):
        changes = [
            ", ".join(f"{_percent(row[name], row[name + end])}" for name in ("H_c", "H_min"))
            for end in ("_further", "_square")
        ]
        kappa = row["ellipticity"]
        lines.append(
            f"| {kappa:.3g} | {row['moes_m']:g}, {row['moes_l']:g} "
            f"| {row['y_extent'] / kappa:.2f} κ | 1 : {row['y_mesh'] / row['x_mesh']:.2f} "
            f"| {changes[0]} | {changes[1]} |"
        )
    return lines


def _percent(value: float, other: float) -> str:
    return f"{100.0 * (other / value - 1.0):+.3f} %"


MEASURE = {
    "sides": measure_sides,
    "cells": measure_cells,
    "straight": measure_straight,
    "border": measure_border,
    "narrow_sides": measure_narrow_sides,
}


def main(words: list[str]) -> None:
    """Run a command."""
    if words[0] == "read":
        collect(words[1:])
    elif words[0] == "lines":
        collect(words[1:], LINES)
    elif words[0] == "narrow":
        collect(words[1:], NARROW)
    elif words[0] in MEASURE:
        MEASURE[words[0]]()
    else:
        print("\n\n".join("\n".join(f()) for f in (robustness, speed, sides, by_border)))


if __name__ == "__main__":
    main(sys.argv[1:])
