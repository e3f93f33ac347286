"""Print what the tables of this folder say."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

import numpy as np

HERE = Path(__file__).parent
Row = dict[str, Any]


def numbers(name: str) -> list[Row]:
    """Read a table; None where there is no number."""

    def value(text: str) -> float | str | None:
        try:
            return float(text)
        except ValueError:
            return text or None

    with (HERE / f"{name}.csv").open(encoding="utf-8", newline="") as stream:
        return [{k: value(v) for k, v in row.items()} for row in csv.DictReader(stream)]


def shares(rows: list[Row], name: str, true: str, stated: str, factor: float) -> tuple[int, int]:
    """Count the rows whose true error is at most `factor` times the stated one, and all of them."""
    known = [row for row in rows if None not in (row[name], row[true], row[stated])]
    good = sum(abs(row[name] - row[true]) <= factor * row[stated] for row in known)
    return good, len(known)


def ratios(rows: list[Row], kappa: float, moes_m: float) -> dict[float, tuple[float, float]]:
    """Nodes and error of H_c on cells of each shape, on the finest grids, for one contact."""
    found = {}
    here = [r for r in rows if (r["kappa"], r["moes_m"]) == (kappa, moes_m) and r["H_c"]]
    limits = {}
    for ratio in sorted({r["ratio"] for r in here}):
        films = [r["H_c"] for r in here if r["ratio"] == ratio]
        if len(films) > 1:
            limits[ratio] = (4.0 * films[-1] - films[-2]) / 3.0
    # cells that are shorter in one direction or the other have one limit
    limit = float(np.median(list(limits.values())))
    for ratio in limits:
        middle = next(r for r in here if r["ratio"] == ratio and r["points"] == 129)
        nodes = middle["points"] * middle["points_y"]
        found[ratio] = nodes, abs(middle["H_c"] / limit - 1.0)
    return found


def show() -> None:
    """Print the shares of the errors that hold, and what cells are worth."""
    rows = numbers("errors")
    points = {(row["kappa"], row["moes_m"]) for row in rows}
    done = sum(row["status"] == "converged" for row in rows)
    print(f"{len(points)} contacts, {done} of {len(rows)} runs converged")
    for name in ("H_c", "H_min"):
        for border in ("flooded", "zero"):
            here = [row for row in rows if row["border"] == border]
            good, known = shares(here, name, f"{name}_doubled", f"{name}_error_domain", 1.0)
            print(f"{name}, {border}: domain changes it by what is stated: {good} of {known}")
        for factor in (1.0, 2.0):
            good, known = shares(rows, name, f"{name}_limit", f"{name}_error", factor)
            print(f"{name}: true error at most {factor:g} times the stated: {good} of {known}")
    rows = numbers("cells")
    for kappa, moes_m in sorted({(row["kappa"], row["moes_m"]) for row in rows}):
        for ratio, (nodes, error) in ratios(rows, kappa, moes_m).items():
            print(
                f"kappa {kappa:g}, M {moes_m:g}: cells 1:{ratio:g}, {nodes:.0f} nodes, {error:.2%}"
            )


if __name__ == "__main__":
    show()
