# SPDX-License-Identifier: BSD-3-Clause
"""Compare stated with true errors of elliptical contacts, and errors by the shape of the cells.

    python docs/evidence/errors_ellipses/make.py errors     # errors.csv
    python docs/evidence/errors_ellipses/make.py cells      # cells.csv
    python docs/evidence/errors_ellipses/make.py ends       # ends.csv

M and L are those of the round contact with the same equations (Biboulet & Houpert 2010), kappa is
the semi-axis across the motion over that along it. Points are drawn from a seed that was not used
to choose any estimate.
"""

from __future__ import annotations

import csv
import itertools
import math
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from scipy.special import elliprd

import pyehl
from pyehl.theory.ellipse import ellipse

HERE = Path(__file__).parent
SEED = 20271
POINTS = 44
QUANTITIES = ("H_c", "H_min")
NAMES = ("border", "kappa", "moes_m", "moes_l")
# A-priori error of H_min, over two, that the coarsest of three grids may have
COARSEST = 0.15
# Nodes of the largest doubled domain
MOST = 3.0e5
Row = dict[str, Any]


def contact(kappa: float, moes_m: float, moes_l: float) -> Row:
    """Keys of a contact of ellipticity `kappa`, with the M and L of a round one."""
    ratio = float(elliprd(0.0, 1.0, kappa**2) / elliprd(0.0, kappa**2, 1.0))
    kernel = ellipse(ratio).kernel_ratio
    return {
        "contact.radius_ratio": ratio,
        "contact.moes_m": moes_m * kappa * kernel**0.25,
        "contact.moes_l": moes_l / kernel**0.75,
    }


def solved(keys: Row) -> Row:
    """Solve a case and return its summary."""
    with pyehl.Solver(pyehl.Case.from_text("", keys)) as solver:
        solver.run()
        return solver.summary


def missed(kappa: float, moes_m: float, mesh: float) -> float:
    """Half of the a-priori error of H_min (fortran/contact/grid_error.f90)."""
    return 0.16 * moes_m * mesh**2 * max(1.0, 0.3 / min(1.0, kappa) ** 2)


def domain_of(keys: Row) -> Row:
    """Give the default domain of a contact."""
    return pyehl.Case.from_text("", keys).resolve()["grid"]


def grids_of(kappa: float, moes_m: float, grid: Row) -> list[int]:
    """Three grids, of which the coarsest is fine enough for a solution."""
    width = grid["x_outlet"] - grid["x_inlet"]
    for points in (33, 65):
        if missed(kappa, moes_m, width / (points - 1)) <= COARSEST:
            return [points, 2 * points - 1, 4 * points - 3]
    return []


def points() -> Iterator[tuple[str, float, float, float]]:
    """Draw kappa from 1/10 to 10 and M from 2 to 600, log-uniform, and L up to 20."""
    generator = np.random.default_rng(SEED)
    count = 0
    while count < POINTS:
        kappa = 10.0 ** generator.uniform(-1.0, 1.0)
        moes_m = math.exp(generator.uniform(math.log(2.0), math.log(600.0)))
        drawn = kappa, moes_m, generator.uniform(0.0, 20.0)
        point = tuple(float(f"{value:.4g}") for value in drawn)
        border = "zero" if moes_m > 10.0 and generator.random() < 0.4 else "flooded"
        if grids_of(*point[:2], domain_of(contact(*point) | {"grid.border": border})):
            count += 1
            yield (border, *point)


def errors(point: tuple[str, float, float, float]) -> list[Row]:
    """Solve a contact on three grids, and on the same meshes with the domain doubled."""
    border, *shape = point
    keys = contact(*shape) | {"grid.border": border}
    grid = domain_of(keys)
    doubled = {f"grid.{key}": 2.0 * grid[key] for key in ("x_inlet", "x_outlet", "y_extent")}
    rows = []
    for nodes in grids_of(*shape[:2], grid):
        result = solved(keys | {"grid.points": nodes})
        wide: Row = {}
        if 4 * nodes * result["points_y"] <= MOST:
            size = {"grid.points": 2 * nodes - 1, "grid.points_y": 2 * result["points_y"] - 1}
            wide = solved(keys | doubled | size)
        row: Row = dict(zip(NAMES, point, strict=True))
        row |= {"points": nodes, "points_y": result["points_y"]}
        row |= {"status": result["status"], "status_doubled": wide.get("status")}
        for name in QUANTITIES:
            row |= {key: result[key] for key in (name, f"{name}_error", f"{name}_error_domain")}
            row |= {f"{name}_doubled": wide.get(name)}
        rows.append(row)
    # the limit of fine grids on the doubled domain, order 2
    for name in QUANTITIES:
        middle, fine = [None, None, *(r[f"{name}_doubled"] for r in rows if r["status_doubled"])][
            -2:
        ]
        known = middle is not None and fine is not None
        for row in rows:
            row[f"{name}_limit"] = (4.0 * fine - middle) / 3.0 if known else None
    return rows


CELL_POINTS = tuple(itertools.product((0.15, 0.4, 2.5, 6.0), (30.0, 120.0), (10.0,)))
RATIOS = (0.25, 0.5, 1.0, 1.5, 2.0)


def cells(point: tuple[float, float, float]) -> list[Row]:
    """Solve a contact on cells of several shapes."""
    kappa, _, _ = point
    keys = contact(*point) | {"grid.x_inlet": -2.5, "grid.x_outlet": 1.5, "grid.border": "zero"}
    sides = 2.0 * max(1.0, kappa)
    keys["grid.y_extent"] = sides
    rows: list[Row] = []
    for ratio in RATIOS:
        for nodes in (65, 129, 257):
            # nodes that can be coarsened: the shape of the cells is approximately the requested one
            across = 2 * round(sides * (nodes - 1) / (4.0 * ratio) / 32.0) * 32
            made = any((r["points"], r["points_y"]) == (nodes, across + 1) for r in rows)
            if made or across < 64 or nodes * across > MOST / 2:
                continue
            result = solved(keys | {"grid.points": nodes, "grid.points_y": across + 1})
            row: Row = dict(zip(NAMES[1:], point, strict=True))
            row |= {"ratio": ratio, "points": nodes, "points_y": across + 1}
            row |= {key: result[key] for key in ("status", "total_cycles", "restarts", *QUANTITIES)}
            rows.append(row)
    return rows


# kappa, M, L by R_x, nodes along X
EXTREME = (
    *itertools.product((0.1,), (200.0, 400.0), (10.0,), (257,)),
    *itertools.product((1.0 / 30.0,), (10.0, 50.0), (10.0,), (257,)),
    (1.0 / 30.0, 50.0, 2.0, 257),
    *itertools.product((0.1,), (400.0, 1000.0), (10.0,), (513,)),
    (1.0 / 30.0, 50.0, 10.0, 513),
    *itertools.product((10.0,), (1000.0,), (5.0, 10.0, 15.0), (129,)),
)


def ends(point: tuple[float, float, float, int]) -> list[Row]:
    """Solve a very narrow or wide contact."""
    *place, nodes = point
    result = solved(contact(*place) | {"contact.moes_l": point[2], "grid.points": nodes})
    row: Row = dict(zip((*NAMES[1:], "points"), point, strict=True))
    return [row | {key: result[key] for key in ("status", "cycles", "restarts")}]


TABLES: dict[str, tuple[Callable[[Any], list[Row]], Callable[[], Any]]] = {
    "errors": (errors, points),
    "cells": (cells, lambda: CELL_POINTS),
    "ends": (ends, lambda: EXTREME),
}


def main() -> None:
    """Make a table."""
    name = sys.argv[1]
    make, todo = TABLES[name]
    with (HERE / f"{name}.csv").open("w", newline="", encoding="utf-8") as stream:
        writer = None
        for point in todo():
            for row in make(point):
                if writer is None:
                    writer = csv.DictWriter(stream, row, lineterminator="\n")
                    writer.writeheader()
                writer.writerow(row)
            stream.flush()


if __name__ == "__main__":
    main()
