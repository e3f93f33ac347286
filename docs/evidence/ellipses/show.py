"""Print what the tables of this folder say."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

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


def cells(rows: list[Row], point: tuple[float, float]) -> dict[float, tuple[float, float]]:
    """Nodes and error of H_c on 129 nodes along the motion, by the shape of the cells.

    The limit is that of the finest cells of all, by Richardson.
    """
    here = [r for r in rows if (r["kappa"], r["moes_m"]) == point and r["H_c"]]
    sides = 2.0 * max(1.0, point[0])
    films = {(r["points"], r["points_y"]): r["H_c"] for r in here}
    pairs = [n for n in sorted(films) if (0.5 * (n[0] + 1), 0.5 * (n[1] + 1)) in films]
    if not pairs:
        return {}
    fine, coarse = films[pairs[-1]], films[0.5 * (pairs[-1][0] + 1), 0.5 * (pairs[-1][1] + 1)]
    limit = (4.0 * fine - coarse) / 3.0
    return {
        sides / (r["points_y"] - 1) * 64.0: (
            r["points"] * r["points_y"],
            abs(r["H_c"] / limit - 1.0),
        )
        for r in here
        if r["points"] == 129
    }


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
    for point in sorted({(row["kappa"], row["moes_m"]) for row in rows}):
        for ratio, (nodes, error) in cells(rows, point).items():
            print("kappa {:g}, M {:g}:".format(*point), end=" ")
            print(f"cells 1 : {ratio:.2f}, {nodes:.0f} nodes, H_c off by {error:.2%}")


if __name__ == "__main__":
    show()
