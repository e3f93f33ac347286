# SPDX-License-Identifier: BSD-3-Clause
"""Error of multilevel multi-integration by grid and by patch, and that of the discretisation.

    python docs/evidence/deflection/make.py run     writes errors.csv, in a few seconds
    python docs/evidence/deflection/make.py show    prints the tables of both pages

The pressure is that of Hertz on -2.5 <= X <= 1.5, |Y| <= 2. The error of the multi-integration is
its maximum difference from the full sum (engine 'fft'), that of the discretisation the maximum
difference of this sum from 1 - r^2/2 in the contact, and well inside (r < 1/2).
"""

from __future__ import annotations

import csv
import sys
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pyehl import library

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "benchmarks"))
from common import hertz

HERE = Path(__file__).resolve().parent
POINTS = (65, 129, 257, 513, 1025)
# Requested accuracies on 257 x 257 nodes
ACCURACIES = (2e-4, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10)
KEYS = ("points", "accuracy")
NAMES = ("order", "along", "across", "values", "error", "discretisation", "inside")
# Constants of fortran/deflection/mlmi.f90 and mlmi_up.f90
LIMITS = (1e-4, 1e-6, 1e-7, 1e-8, 1e-9)
LOOSEST, SHARE, REACH, FEW = 2e-4, 2.5, 48, 3

Array = NDArray[np.float64]
Row = dict[str, Any]


def asked(h: float) -> float:
    """Accuracy that the solver requests, as `deflection_accuracy` in fortran/multigrid."""
    return float(2.2e-5 * (128.0 * h) ** 1.35)


def weights(t: int) -> Array:
    """Weights of 2t-point interpolation midway between two nodes, one for each pair."""
    nodes = 2.0 * np.arange(1 - t, t + 1) - 1.0
    return np.array(
        [np.prod([m / (m - k) for m in nodes if m != k]) for k in 2.0 * np.arange(1, t + 1) - 1.0]
    )


def kernel(h: float, along: int, across: int) -> Array:
    """Deflection by a cell at distances of 0 to `along` and `across` meshes (Love 1929)."""
    x, y = np.meshgrid(
        h * (np.arange(along + 2) - 0.5), h * (np.arange(across + 2) - 0.5), indexing="ij"
    )
    corner = x * np.arcsinh(y / abs(x)) + y * np.arcsinh(x / abs(y))
    return np.asarray(2.0 / np.pi**2 * np.diff(np.diff(corner, axis=0), axis=1))


def chosen(wanted: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Wanted values and those closer to the origin along X, for even and odd offsets separately."""
    kept = np.zeros_like(wanted)
    width = int(np.flatnonzero(wanted.sum(axis=0) >= FEW).max(initial=0))
    for b in range(width + 1):
        for parity in (0, 1):
            count = int(np.flatnonzero(wanted[parity::2, b]).max(initial=-1)) + 1
            kept[parity : parity + 2 * count : 2, b] = True
    kept[0, : width + 1] = kept[1, 0] = True
    return kept


def patch(h: float, accuracy: float) -> Row:
    """Order of the transfers, and patch of the first coarsening, as in mlmi_up.f90."""
    goal = min(accuracy, LOOSEST)
    t = 3 + sum(goal < 0.999 * limit for limit in LIMITS)
    table = kernel(h, REACH + 2 * t, REACH)
    a = np.arange(REACH + 1)
    rest = table[a] - sum(
        w * (table[a + 2 * k - 1] + table[abs(a - 2 * k + 1)]) for k, w in enumerate(weights(t), 1)
    )
    copies = np.where(a == 0, 1.0, 2.0)
    copies = copies[:, None] * copies
    high = abs(rest).max()
    low = 1e-20 * high
    for _ in range(20):
        middle = np.sqrt(low * high)
        left_out = (copies * abs(rest))[~chosen(abs(rest) >= middle)].sum()
        low, high = (middle, high) if left_out <= SHARE * goal else (low, middle)
    kept = chosen(abs(rest) >= low)
    along, across = (int(np.flatnonzero(kept.any(axis=axis)).max()) for axis in (1, 0))
    values = int(copies[kept].sum())
    return {"order": 2 * t, "along": along, "across": across, "values": values}


def row(points: int, accuracy: float) -> Row:
    """Errors on a grid, with the patch of a requested accuracy."""
    p, h, exact, contact = hertz(points)
    whole, fast = (
        library.deflection(p, h, h, engine, accuracy=accuracy).values for engine in ("fft", "mlmi")
    )
    off = abs(whole - exact)
    return (
        {"points": points, "accuracy": accuracy}
        | patch(h, accuracy)
        | {
            "error": abs(fast - whole).max() / whole.max(),
            "discretisation": off[contact].max(),
            "inside": off[exact > 0.875].max(),
        }
    )


def runs() -> list[tuple[int, float]]:
    """Grids with the accuracy of the solver, and one grid with other accuracies."""
    return [(n, asked(4.0 / (n - 1))) for n in POINTS] + [(257, a) for a in ACCURACIES]


def read() -> list[Row]:
    """Read errors.csv."""
    with (HERE / "errors.csv").open(encoding="utf-8", newline="") as stream:
        return [{k: float(v) for k, v in line.items()} for line in csv.DictReader(stream)]


def power(value: float) -> str:
    """Format a number for the page."""
    digits, exponent = f"{value:.1e}".split("e")
    return f"{digits}·10{str(int(exponent)).translate(str.maketrans('-0123456789', '⁻⁰¹²³⁴⁵⁶⁷⁸⁹'))}"


def lines(rows: list[Row], names: tuple[str, ...]) -> list[str]:
    """Make a table of the page."""
    text = []
    for line in rows:
        cells = [
            f"{line['along']:.0f} × {line['across']:.0f}"
            if name == "along"
            else f"{line[name]:.0f}"
            if name in ("points", "order", "values")
            else power(line[name])
            for name in names
        ]
        text.append("| " + " | ".join(cells) + " |")
    return text


BY_GRID = (*KEYS, "order", "along", "values", "error", "discretisation", "inside")
BY_PATCH = ("accuracy", "order", "along", "values", "error")


def tables() -> tuple[list[str], list[str]]:
    """Make both tables, by grid and by patch."""
    rows = read()
    n = len(POINTS)
    return lines(rows[:n], BY_GRID), lines(rows[n:], BY_PATCH)


def main() -> None:
    """Run the command of the argument."""
    if sys.argv[1:] == ["run"]:
        with (HERE / "errors.csv").open("w", encoding="utf-8", newline="") as stream:
            table = csv.DictWriter(stream, [*KEYS, *NAMES], lineterminator="\n")
            table.writeheader()
            for run in runs():
                made = row(*run)
                table.writerow({k: f"{v:.4g}" for k, v in made.items()})
    elif sys.argv[1:] == ["show"]:
        for text in tables():
            print(*text, "", sep="\n")
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
