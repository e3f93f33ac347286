# SPDX-License-Identifier: BSD-3-Clause
"""Films of starved point contacts: over the oil layer, on meshes to a/128, and of random contacts.

    python benchmarks/starvation.py table FILE.csv
    python benchmarks/starvation.py mesh FILE.csv
    python benchmarks/starvation.py random FILE.csv [--count 60] [--seed 1]

The tables of docs/evidence/starvation.
"""

import argparse
import csv
import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import brentq

import pyehl
from pyehl.theory.starvation import layer_reduction

LAYERS = (0.1, 0.25, 0.5, 0.75, 1.0, 1.5, 2.5)
"""Oil layers of the table over rho h, with the flooded film h by formula."""
POINTS = ((50.0, 5.0), (100.0, 10.0), (300.0, 10.0), (1000.0, 10.0))
COLUMNS = (
    "shape", "moes_m", "moes_l", "radius_ratio", "points", "r", "status", "H_c", "H_c_error",
    "H_min", "H_min_error", "oil_imbalance", "cycles", "share", "gamma",
)  # fmt: skip


def solve(contact: dict[str, Any], points: int, **inlet: float) -> dict[str, Any]:
    """Solve; returns the scalars and attributes of the result."""
    case = pyehl.Case(contact=contact, inlet=inlet, grid={"points": points})
    result = pyehl.solve(case, check=False)
    return {k: v.item() for k, v in result.data_vars.items() if v.ndim == 0} | result.attrs


def row(
    contact: dict[str, Any],
    points: int,
    ratio: float,
    flooded: dict[str, Any],
    density: float,
) -> dict[str, Any]:
    """Solve with a layer of `ratio` times rho h, h by formula; compare with the flooded contact."""
    # the same layer on every grid
    film = float(pyehl.film(pyehl.Case(contact=contact)).formulas[0]["H_c"])
    layer = ratio * density * film
    ratio = layer / (density * float(flooded["H_c"]))
    result = solve(contact, points, film_hertz=layer)
    share = float(result["H_c"]) / float(flooded["H_c"])
    gamma = math.nan
    if layer_reduction(ratio, 1.0) < share < min(1.0, ratio):
        gamma = brentq(lambda g: layer_reduction(ratio, g) - share, 1.0, 60.0)
    values = {name: result.get(name) for name in COLUMNS}
    return values | {"points": points, "r": ratio, "share": share, "gamma": gamma} | contact


def density_of(contact: dict[str, Any]) -> float:
    """Density ratio at the Hertz pressure by Dowson & Higginson."""
    pressure = pyehl.film(pyehl.Case(contact=contact)).summary["hertz_pressure_Pa"]
    return (5.9e8 + 1.34 * pressure) / (5.9e8 + pressure)


def table(grids: tuple[int, ...] = (65, 129, 257)) -> Iterator[dict[str, Any]]:
    """Compute films over the layer at four operating points on three grids."""
    for moes_m, moes_l in POINTS:
        contact: dict[str, Any] = {"moes_m": moes_m, "moes_l": moes_l}
        density = density_of(contact)
        for points in grids:
            flooded = solve(contact, points)
            for ratio in LAYERS:
                yield row(contact, points, ratio, flooded, density)


def mesh() -> Iterator[dict[str, Any]]:
    """Compute films with four layers at M = 100, L = 10 on meshes of a/32, a/64 and a/128."""
    contact: dict[str, Any] = {"moes_m": 100.0, "moes_l": 10.0}
    density = density_of(contact)
    for nodes in (32, 64, 128):
        # on a domain of 4 a
        points = 4 * nodes + 1
        flooded = solve(contact, points)
        for ratio in (0.25, 0.5, 1.0, 2.0):
            yield row(contact, points, ratio, flooded, density)


def random(count: int, seed: int) -> Iterator[dict[str, Any]]:
    """Compute films of random circles and ellipses on two grids."""
    draw = np.random.default_rng(seed)
    for _ in range(count):
        contact: dict[str, Any] = {
            "moes_m": round(float(np.exp(draw.uniform(math.log(20.0), math.log(1000.0)))), 2),
            "moes_l": round(float(draw.uniform(2.0, 15.0)), 2),
            "radius_ratio": round(float(np.exp(draw.uniform(math.log(0.2), math.log(1.5)))), 3),
        }
        if draw.random() < 0.5:
            contact["radius_ratio"] = 1.0
        ratio = round(float(np.exp(draw.uniform(math.log(0.1), math.log(3.0)))), 3)
        density = density_of(contact)
        for points in (65, 129):
            flooded = solve(contact, points)
            if math.isfinite(float(flooded["H_c"])):
                yield row(contact, points, ratio, flooded, density)


def main(words: Sequence[str] | None = None) -> None:
    """Write one of the tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("kind", choices=("table", "mesh", "random"))
    parser.add_argument("file", type=Path)
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    args = parser.parse_args(words)
    draws = {"table": table, "mesh": mesh, "random": lambda: random(args.count, args.seed)}
    with args.file.open("w", newline="") as out:
        writer = csv.DictWriter(out, COLUMNS, extrasaction="ignore")
        writer.writeheader()
        for values in draws[args.kind]():
            writer.writerow(values)
            out.flush()


if __name__ == "__main__":
    main()
