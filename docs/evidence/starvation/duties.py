# SPDX-License-Identifier: BSD-3-Clause
"""Duties with an oil layer: ``python docs/evidence/starvation/duties.py``.

Writes balance.csv, the oil balance at four instants of ten duties, and start.csv, the first step
from steady contacts.
"""

import csv
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[2] / "tests/cases"))
from test_starved_duty import (  # noqa: E402
    BOTH_SIDES,
    DUTIES,
    LAYER,
    line,
    lost,
    point,
    sums,
)

import pyehl  # noqa: E402
from pyehl.types import Row  # noqa: E402

BALL_DUTIES = {
    "speed": {"mean_velocity": [1.0, 1.0, 1.4, 1.4]},
    "load": {"load": [1.0, 1.0, 1.5, 1.5]},
    "layer": {"inlet_film": [1.0, 1.0, 0.5, 0.5]},
}
OIL = {"viscosity": 0.05, "pressure_viscosity": 2e-8}
RADII_Y = {0.01: 60.0, 0.003: 30.0, 0.03: 100.0}
"""Radii [m] with the loads [N]; radius_x is 0.01 m."""


def balances() -> Iterator[Row]:
    """Oil balance after each quarter of the steps, over the oil that has flowed in by then."""
    runs = {
        ("line", name): pyehl.solve(
            line(time, BOTH_SIDES if name == "reversal" else None, LAYER, **duty)
        )
        for name, (time, duty) in DUTIES.items()
    }
    runs |= {
        ("ball", name): point([0.0, 0.2, 0.5, 6.0], **duty) for name, duty in BALL_DUTIES.items()
    }
    for (contact, name), data in runs.items():
        table, away = sums(data), lost(data)
        for quarter in (1, 2, 3, 4):
            row = len(table) * quarter // 4 - 1
            time, *oil = table[row]
            yield (
                {"contact": contact, "duty": name, "T": f"{time:.4f}"}
                | {
                    key: f"{value:.8f}"
                    for key, value in zip(("in", "out", "at_sides", "gained"), oil, strict=True)
                }
                | {"lost": f"{away[row]:.1e}"}
            )


def starts() -> Iterator[Row]:
    """H_c of the steady contact, its change in the first step, and the stated errors."""
    for radius, load in RADII_Y.items():
        contact = {
            "load": load, "mean_velocity": 1.0, "radius_x": 0.01, "radius_y": radius,
            "reduced_modulus": 2.2e11,
        }  # fmt: skip
        film = float(pyehl.film(pyehl.Case(contact=contact, lubricant=OIL)).formulas[0]["h_c_m"])
        for share in (0.6, 1.2):
            for points in (65, 129, 257):
                data = pyehl.solve(
                    pyehl.Case(
                        contact=contact,
                        lubricant=OIL,
                        inlet={"film": share * film},
                        grid={"points": points, "border": "zero"},
                        duty={
                            "time": [0.0, 1.6e-7, 3.2e-7],
                            "mean_velocity": [1.0, 1.0, 1.0 + 1e-6],
                        },
                    )
                )
                h_c = data.history_H_c.values
                yield {
                    "radius_y": radius,
                    "layer_share": share,
                    "points": points,
                    "H_c": f"{h_c[0]:.5f}",
                    "change": f"{h_c[-1] / h_c[0] - 1.0:.5f}",
                    "error": f"{float(data.H_c_error) / h_c[0]:.5f}",
                    "step_error": f"{float(data.history_c_step_error[-1]):.5f}",
                }


def write(name: str, rows: Iterable[Row]) -> None:
    """Write a table."""
    kept = list(rows)
    with (HERE / name).open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, list(kept[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(kept)


if __name__ == "__main__":
    write("start.csv", starts())
    write("balance.csv", balances())
