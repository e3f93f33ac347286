# SPDX-License-Identifier: BSD-3-Clause
"""Make the tables of sides, borders and cells of default grids, or print those of the documents.

python docs/evidence/machines/domains.py sides           sides.csv
python docs/evidence/machines/domains.py border          border.csv
python docs/evidence/machines/domains.py inlets          inlets.csv
python docs/evidence/machines/domains.py narrow_sides    narrow_sides.csv
python docs/evidence/machines/domains.py show
"""

from __future__ import annotations

import math
import sys
from pathlib import Path

import pyehl

sys.path.insert(0, str(Path(__file__).resolve().parent))
sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "benchmarks"))
from machine_tables import read, run, write
from machines import DISC, SETTINGS, WIDE, draw, draw_narrow, radius_ratio, timed

# kappa, and M and L by R_x
POINTS = (
    (2.2, 1000.0, 10.0),
    (4.0, 300.0, 12.0),
    (7.0, 5000.0, 15.0),
    (12.0, 100.0, 8.0),
    (18.0, 2000.0, 10.0),
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
    ("flooded", -1.5, 1.6),
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
# Inlets of wide contacts on cells of one size [a], the first one is the reference; seed, contacts
INLETS = (-4.5, -2.5, -2.0, -1.75, -1.5, -1.375)
INLET_SEED, INLET_DRAWN, INLET_MESH = 41, 25, 1.0 / 64
INLET = (
    *("number", "ellipticity", "moes_m", "moes_l", "alpha_bar", "x_inlet", "points", "points_y"),
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
    lines = [
        "| κ | P = 0 | stated | flooded border | stated | inlet of 1.5 a | stated |",
        "|---|---|---|---|---|---|---|",
    ]
    groups: dict[float, dict[tuple[str, float], list[tuple[float, float]]]] = {}
    limit = math.nan
    for row in read("border.csv"):
        first = (row["border"], row["x_inlet"]) == DOMAINS[0][:2]
        if first:
            limit = row["H_c"]
        elif row["x_inlet"] != DOMAINS[0][1]:
            key = (row["border"], row["x_inlet"])
            of = groups.setdefault(row["ellipticity"], {}).setdefault(key, [])
            of.append((row["H_c"] / limit - 1.0, row["H_c_error_domain"] / row["H_c"]))
    for kappa, of in groups.items():
        keys = ("zero", -2.5), ("flooded", -2.5), ("flooded", -1.5)
        worst = [max(of[key], key=lambda pair: abs(pair[0])) for key in keys]
        cells = [f"{100.0 * change:+.2f} % | {100.0 * stated:.2f} %" for change, stated in worst]
        lines.append(f"| {kappa:g} | {' | '.join(cells)} |")
    return lines


def measure_inlets() -> None:
    """Solve random wide contacts with a flooded border at several distances of the inlet."""
    rows = []
    for number, contact in enumerate(draw(INLET_DRAWN, INLET_SEED)):
        if contact.ellipticity is None or not contact.ellipticity > WIDE:
            continue
        keys = dict(contact.values) | SETTINGS | {"solver.accuracy": 0.01}
        grid = pyehl.Case.from_text("", keys)["grid"]
        mesh = 2.0 * grid["y_extent"] / (grid["points_y"] - 1)
        mesh *= INLET_MESH * (grid["points"] - 1) / (grid["x_outlet"] - grid["x_inlet"])
        across = 64 * math.ceil(2.0 * grid["y_extent"] / mesh / 64)
        keys |= {"grid.y_extent": grid["y_extent"], "grid.points_y": across + 1}
        for inlet in INLETS:
            outlet = 1.125 if inlet == INLETS[-1] else 1.5
            points = round((outlet - inlet) / INLET_MESH) + 1
            domain = {"grid.x_inlet": inlet, "grid.x_outlet": outlet, "grid.points": points}
            row = timed(keys | domain) | {"number": number, "x_inlet": inlet}
            rows.append(row | {"ellipticity": contact.ellipticity})
            if row["status"] != "converged" and inlet == INLETS[0]:
                break
        print(number, rows[-1]["status"])
    write("inlets.csv", INLET, rows)


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


MEASURE = {
    "sides": measure_sides,
    "border": measure_border,
    "inlets": measure_inlets,
    "narrow_sides": measure_narrow_sides,
}
TABLES = sides, by_border, narrow_sides


if __name__ == "__main__":
    run(sys.argv[1], MEASURE, TABLES)
