# SPDX-License-Identifier: BSD-3-Clause
"""Results compared with other programs and film formulas: python make.py.

Runs all cases (several minutes on one processor), writes table.csv, formulas.csv and validation.png
beside this file, and prints the tables of docs/validation.md. `python make.py show` prints and
draws from the stored files.
"""

from __future__ import annotations

import csv
import math
import sys
from collections.abc import Iterator, Mapping
from importlib import resources
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any

import xarray as xr
from matplotlib.lines import Line2D

import pyehl
from pyehl.plots.style import (
    BLUE,
    GREEN,
    GREY,
    PAGE,
    POWERS,
    VERMILLION,
    letter,
    new_figure,
    save,
    styled,
)
from pyehl.theory.film import estimates
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint

HERE = Path(__file__).resolve().parent
ELLIPSES = HERE.parents[2] / "tests" / "cases" / "smooth_ellipses.csv"
COLUMNS = ("group", "case", "quantity", "theirs", "ours", "error")
FORMULA_COLUMNS = ("moes_m", "moes_l", "formula", "quantity", "ratio", "outside")

PLACE = {"grid.x_inlet": -2.5, "grid.x_outlet": 1.5, "grid.border": "zero"}
TABLE_1 = {
    "contact.load": 600.0,
    "contact.mean_velocity": 0.84,
    "contact.radius": 0.018,
    "contact.reduced_modulus": 2.26e11,
    "lubricant.viscosity": 0.04,
    "lubricant.pressure_viscosity": 2.2e-8,
    "grid.y_extent": 2.0,
}
CARREAU = {
    "contact.load": 30.0,
    "contact.mean_velocity": 0.5,
    "contact.radius": 0.0127,
    "contact.reduced_modulus": 1.24e11,
    "lubricant.viscosity": 0.5,
    "lubricant.pressure_viscosity": 1.8e-8,
    "lubricant.shear_law": "carreau",
    "lubricant.carreau_stress": 1e5,
    "lubricant.carreau_exponent": 0.8,
    "grid.y_extent": 2.0,
}
# Films [m] and friction by program B of docs/validation.md
EYRING = {"lubricant.shear_law": "eyring", "lubricant.eyring_stress": 5e6}
THINNING: dict[str, tuple[Mapping[str, Any], Mapping[str, float]]] = {
    "Eyring 5 MPa, SRR 0.5": (
        TABLE_1 | EYRING | {"contact.slide_to_roll": 0.5},
        {"h_c_m": 2.3628e-7, "h_min_m": 8.337e-8, "mu_smooth": 0.05700},
    ),
    "Carreau 0.1 MPa, n = 0.8, SRR 0.1": (
        CARREAU | {"contact.slide_to_roll": 0.1},
        {"h_c_m": 6.6841e-7, "h_min_m": 4.5041e-7, "mu_smooth": 0.005821},
    ),
    "Carreau 0.1 MPa, n = 0.8, SRR 0": (
        CARREAU | {"contact.slide_to_roll": 0.0},
        {"h_c_m": 6.6982e-7, "h_min_m": 4.5062e-7},
    ),
}
POINTS = [
    (m, ell) for m in (20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0) for ell in (5, 10, 15)
]


def solved(options: Mapping[str, Any], points: int) -> xr.Dataset:
    """Solve a smooth contact; it must converge."""
    ds = pyehl.solve(pyehl.Case.from_text("", dict(options) | {"grid.points": points}))
    assert ds.attrs["status"] == "converged", (options, ds.attrs["status"])
    return ds


def table_of(path: Traversable) -> list[dict[str, str]]:
    """Rows of a table with comments."""
    lines = path.read_text(encoding="utf-8").splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def smooth() -> Iterator[tuple[Any, ...]]:
    """Circles, limits of fine grids."""
    for row in table_of(resources.files("pyehl") / "studies" / "references" / "smooth.csv"):
        if not row["H_c_extrapolated"]:
            continue
        keys = [key for key in row if "." in key and key not in ("grid.points", "grid.border")]
        options = {key: float(row[key]) for key in keys} | {"grid.border": "zero"}
        ds = solved(options, 513)
        case = f"M = {row['contact.moes_m']}, L = {row['contact.moes_l']}"
        case += f", z = {row['lubricant.roelands_z']}"
        for name in ("H_c", "H_min"):
            ours, error = float(ds[f"{name}_extrapolated"]), float(ds[f"{name}_error"])
            yield "circle", case, name, float(row[f"{name}_extrapolated"]), ours, error


def ellipses() -> Iterator[tuple[Any, ...]]:
    """Ellipses, limits of fine grids."""
    for row in table_of(ELLIPSES):
        if row["cells"] != "limit":
            continue
        keys = {name: float(row[name]) for name in ("moes_m", "moes_l", "radius_ratio")}
        options = {f"contact.{name}": value for name, value in keys.items()}
        options |= PLACE | {"grid.y_extent": float(row["y_extent"]), "lubricant.roelands_z": 0.6684}
        ds = solved(options, 513)
        case = f"M = {row['moes_m']}, L = {row['moes_l']}, κ = {row['kappa']}"
        for name in ("H_c", "H_min"):
            ours, error = float(ds[f"{name}_extrapolated"]), float(ds[f"{name}_error"])
            yield "ellipse", case, name, float(row[name]), ours, error


def waviness() -> Iterator[tuple[Any, ...]]:
    """Waves in motion, on the same grid and by the same scheme."""
    for row in table_of(resources.files("pyehl") / "studies" / "references" / "waviness.csv"):
        if int(row["grid.points"]) > 257:
            continue
        words = ("surface.kind", "time.scheme")
        options: dict[str, Any] = {
            key: row[key] if key in words else float(row[key])
            for key in row
            if "." in key and key != "grid.points"
        }
        options |= {"time.estimate_error": False}
        ds = solved(options, int(row["grid.points"]))
        case = f"{row['grid.points']}², {row['time.scheme']}, A = {row['surface.amplitude']}"
        case += f", λ = {row['surface.wavelength']} a"
        value = float(ds.mu_ratio)
        yield "waviness", case, "mu_ratio", float(row["mu_ratio"]), value, ""


def thinning() -> Iterator[tuple[Any, ...]]:
    """Oils with shear thinning of the flow, limits of fine grids."""
    for case, (options, theirs) in THINNING.items():
        # the film of Table 1 is a third as thick and needs finer grids
        grids = (129, 257) if "carreau" in str(options) else (257, 513)
        coarse, fine = (solved(PLACE | options, points) for points in grids)
        for name, value in theirs.items():
            ours = (4.0 * float(fine[name]) - float(coarse[name])) / 3.0
            yield "thinning", case, name, value, ours, ""


def formulas() -> Iterator[tuple[Any, ...]]:
    """Film formulas over the solution."""
    for moes_m, moes_l in POINTS:
        options = {"contact.moes_m": moes_m, "contact.moes_l": float(moes_l)}
        ds = solved(options, 513)
        point = OperatingPoint.from_moes(moes_m, float(moes_l))
        for result in estimates(point, Lubricant()):
            for name, value in (("H_c", result.h_c), ("H_min", result.h_min)):
                if math.isfinite(value):
                    ratio = value / point.film_scale / float(ds[f"{name}_extrapolated"])
                    yield moes_m, moes_l, result.name, name, ratio, bool(result.outside)


def write(path: Path, columns: tuple[str, ...], rows: Iterator[tuple[Any, ...]]) -> None:
    """Write a table, numbers to six digits."""
    with path.open("w", newline="", encoding="utf-8") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(columns)
        for row in rows:
            out.writerow([f"{v:.6g}" if isinstance(v, float) else v for v in row])
            file.flush()


@styled()
def draw(rows: list[dict[str, str]]) -> None:
    """Draw films by formula over those of pyehl: a colour per formula, a marker per value of L."""
    figure = new_figure(PAGE, 2.9)
    axes = figure.subplots(1, 2, sharex=True)
    names = sorted({row["formula"] for row in rows})
    colours = dict(zip(names, (BLUE, VERMILLION, GREEN), strict=True))
    markers = {"5": "o", "10": "s", "15": "^"}
    for ax, quantity in zip(axes, ("H_c", "H_min"), strict=True):
        for name, colour in colours.items():
            for moes_l, marker in markers.items():
                chosen = [
                    (float(row["moes_m"]), float(row["ratio"]))
                    for row in rows
                    if (row["formula"], row["quantity"], row["moes_l"]) == (name, quantity, moes_l)
                ]
                # the formulas of H_min overlap: one has filled markers, the others open ones
                face = colour if name == names[0] else "none"
                style = {"marker": marker, "color": colour, "lw": 1.0, "mfc": face, "ms": 4.0}
                if chosen:
                    ax.plot(*zip(*chosen, strict=True), **style)
        ax.axhline(1.0, color=GREY, lw=0.8)
        symbol = {"H_c": "$H_c$", "H_min": "$H_\\mathrm{min}$"}[quantity]
        ax.set(xscale="log", xlabel="$M$", ylabel=f"{symbol} by formula over pyehl")
        ax.xaxis.set_major_formatter(POWERS)
    keys = [Line2D([], [], color=colour, label=name) for name, colour in colours.items()]
    keys += [
        Line2D([], [], color=GREY, marker=marker, ls="", label=f"$L$ = {moes_l}")
        for moes_l, marker in markers.items()
    ]
    figure.legend(handles=keys, loc="outside lower center", ncols=6)
    letter(list(axes))
    save(figure, HERE / "validation.png")


def show() -> None:
    """Print the tables and draw the picture."""
    rows = table_of(HERE / "table.csv")
    for group in ("circle", "ellipse", "waviness", "thinning"):
        print(
            f"\n{group}\n\n| case | quantity | other program | pyehl | deviation |"
            "\n|---|---|---|---|---|"
        )
        for row in rows:
            if row["group"] == group:
                share = 100.0 * (float(row["ours"]) / float(row["theirs"]) - 1.0)
                values = f"{float(row['theirs']):.5g} | {float(row['ours']):.5g} | {share:+.2f} %"
                print(f"| {row['case']} | {row['quantity']} | {values} |")
    rows = table_of(HERE / "formulas.csv")
    draw(rows)
    names = sorted({row["formula"] for row in rows})
    print("\n| formula | quantity | M | minimum | maximum |\n|---|---|---|---|---|")
    for name in names:
        for quantity in ("H_c", "H_min"):
            for low, high in ((20.0, 100.0), (200.0, 2000.0)):
                result = [
                    float(row["ratio"])
                    for row in rows
                    if (row["formula"], row["quantity"]) == (name, quantity)
                    and low <= float(row["moes_m"]) <= high
                ]
                if result:
                    span = f"{min(result):.3f} | {max(result):.3f}"
                    print(f"| {name} | {quantity} | {low:g} to {high:g} | {span} |")


def all_rows() -> Iterator[tuple[Any, ...]]:
    """Rows of table.csv."""
    for rows in (smooth, ellipses, waviness, thinning):
        yield from rows()


if __name__ == "__main__":
    if "show" not in sys.argv[1:]:
        write(HERE / "table.csv", COLUMNS, all_rows())
        write(HERE / "formulas.csv", FORMULA_COLUMNS, formulas())
    show()
