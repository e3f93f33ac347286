# SPDX-License-Identifier: BSD-3-Clause
"""The errors of runs for ``pyehl bench workprec``, and the cheapest run for an error.

The reference is extrapolated from the two finest grids by the narrow scheme; its error bar is what
one grid more has changed it by.
"""

import itertools
import math
from collections.abc import Mapping, Sequence

from pyehl.types import Row

LEVELS = (0.03, 0.01, 0.003, 0.001)
"""Errors that the cheapest setting is looked for."""
ORDER = 2
"""Of the discretisation, for Richardson extrapolation."""


def extrapolated(rows: Sequence[Row]) -> list[Row]:
    """Richardson: the value of a grid and of the next coarser one, at the cost of both."""
    found = {(r["quantity"], r["setting"], r["threads"], r["points"]): r for r in rows}
    more = []
    for (quantity, setting, threads, points), fine in found.items():
        coarse = found.get((quantity, setting, threads, (points + 1) // 2))
        if coarse is None or fine["value"] is None or coarse["value"] is None:
            continue
        # nested iteration has solved the coarser grid of a smooth contact anyway
        extra = 0.0 if fine["scene"] == "smooth" else coarse["seconds"]
        seconds = fine["seconds"] + extra
        value = fine["value"] + (fine["value"] - coarse["value"]) / (2**ORDER - 1)
        more.append(
            fine
            | {
                "setting": f"{setting}, extrapolated",
                "seconds": seconds,
                "units": seconds / fine["unit_seconds"],
                "value": value,
                "estimate": None,
            }
        )
    return more


def _reference(values: Mapping[int, float]) -> tuple[float, float]:
    """Limit of the two finest grids, and its relative error."""
    grids = sorted(values)[-3:]
    if len(grids) < 2:
        return math.nan, math.nan
    limits = [
        values[b] + (values[b] - values[a]) / (2**ORDER - 1) for a, b in itertools.pairwise(grids)
    ]
    last = limits[-1]
    bar = abs(last - limits[0]) if len(limits) > 1 else abs(last - values[grids[-1]])
    return last, bar / abs(last)


def add_errors(rows: Sequence[Row], quantities: Sequence[str]) -> None:
    """Add to the rows of a scene `error`, relative to the reference, and `bar`, its own error."""
    for quantity in quantities:
        mine = [row for row in rows if row["quantity"] == quantity]
        values = {
            row["points"]: row["value"]
            for row in mine
            if row["setting"] == "default" and row["value"] is not None
        }
        limit, bar = _reference(values)
        for row in mine:
            known = row["value"] is not None and math.isfinite(limit)
            row["error"] = abs(row["value"] / limit - 1.0) if known else None
            row["bar"] = bar if known else None


def cheapest(rows: Sequence[Row]) -> list[Row]:
    """Give the setting of least seconds for each of `LEVELS`, by scene and quantity.

    An error below the bar of the reference counts as the bar.
    """
    found = []
    for scene, quantity in dict.fromkeys((row["scene"], row["quantity"]) for row in rows):
        mine = [
            row
            for row in rows
            if (row["scene"], row["quantity"]) == (scene, quantity) and row["error"] is not None
        ]
        for level in LEVELS:
            good = [row for row in mine if max(row["error"], row["bar"]) <= level]
            best = min(good, key=lambda row: row["seconds"], default=None)
            found.append({"scene": scene, "quantity": quantity, "level": level, "best": best})
    return found


def told(row: Row) -> str:
    """Give a row of `cheapest` in a line."""
    best, how = row["best"], "none of these"
    if best is not None:
        how = f"{best['setting']}, {best['points']} x {best['points']}, threads {best['threads']}: "
        how += f"{best['seconds']:.3g} s, error {best['error']:.1e}"
    return f"{row['scene']}, {row['quantity']} to {row['level']:.1%}: {how}"
