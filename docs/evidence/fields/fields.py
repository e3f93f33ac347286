# SPDX-License-Identifier: BSD-3-Clause
"""Pressure and film of simulated rough surfaces against the prediction, point by point: table.csv.

    python docs/evidence/fields/fields.py NAME ... [--points N]     simulates and adds rows
    python docs/evidence/fields/fields.py                           prints the table
    python docs/evidence/fields/fields.py NAME ... --lobes          the same for lobes.csv

NAME is a row of docs/evidence/prediction/cases.csv or of docs/evidence/thinning/rough.py. Eight
moments of the last period are compared. One minute each on 513 x 513 nodes and one core.
"""

from __future__ import annotations

import argparse
import csv
import sys
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import RectBivariateSpline

HERE = Path(__file__).resolve().parent
for folder in ("prediction", "thinning"):
    sys.path.insert(0, str(HERE.parent / folder))

import rough  # noqa: E402

import cases  # noqa: E402
import pyehl  # noqa: E402
from pyehl import surfaces  # noqa: E402
from pyehl.contact.smooth import solve_contact  # noqa: E402
from pyehl.prediction import response  # noqa: E402
from pyehl.prediction.model import Model, ModelOptions  # noqa: E402
from pyehl.prediction.response import Transfer  # noqa: E402
from pyehl.prediction.rough_contact import RoughContact  # noqa: E402
from pyehl.prediction.spectrum import Spectrum  # noqa: E402
from pyehl.solver import solver_on_heights  # noqa: E402
from pyehl.surfaces import Topography, shifted  # noqa: E402
from pyehl.theory.lubricant import Lubricant  # noqa: E402
from pyehl.theory.operating import OperatingPoint  # noqa: E402

Array = NDArray[np.float64]
MOMENTS = 8
# Rings of the contact [a], and strips along the motion [a] with |Y| below SIDE
RINGS = {"r < 0.4": (0.0, 0.4), "0.4 to 0.7": (0.4, 0.7), "0.7 to 0.9": (0.7, 0.9)}
STRIPS = {"X = -0.5": (-0.65, -0.35), "X = 0": (-0.15, 0.15), "X = 0.5": (0.35, 0.65)}
SIDE = 0.5
# Position of the minimum film: X and |Y| [a]
LOBE_X, LOBE_Y = (0.1, 0.3), (0.88, 0.97)
COLUMNS = (
    "name points place p_correlation p_slope p_square gamma film_correlation film_slope film_square"
).split()
LOBE_COLUMNS = "name points velocity_ratio place correlation rms_simulated rms_predicted".split()


@dataclass(frozen=True, slots=True)
class Moment:
    """Fields of a simulation (nx, ny) at a dimensionless time: P and H, rough and smooth."""

    time: float
    x: Array
    y: Array
    pressure: Array
    film: Array
    smooth_pressure: Array
    smooth_film: Array


def case_of(name: str, points: int) -> tuple[pyehl.Case, Topography]:
    """Make case and tile of a name."""
    if name in rough.PLAN:
        case = rough.case_of(rough.PLAN[name]).with_options(f"grid.points={points}")
        settings = case.resolve()
        point = OperatingPoint.from_settings(settings)
        return case, surfaces.from_settings(settings, point, None)
    row = next(row for row in cases.rows() if row["name"] == name)
    row["points"] = points
    return cases.case(row), cases.surface(row)


def simulate(case: pyehl.Case, heights: Array | None = None) -> list[Moment]:
    """Fields of the last period of a case, with heights in place of its surface."""
    result: list[Moment] = []
    with solver_on_heights(case, {"surface": heights}) as run:
        while not run.done:
            run.advance()
            summary = run.summary
            if not summary.get("steps"):
                continue
            x, y = run.axes()
            fields = [run.field(k).copy() for k in ("P", "H", "P_smooth", "H_smooth")]
            result.append(Moment(float(summary["T"]), x, y, *fields))
            period = float(summary["T_period"])
            result = [moment for moment in result if moment.time > result[-1].time - period]
    ends = result[-1].time - period * np.arange(MOMENTS) / MOMENTS
    return [min(result, key=lambda moment: abs(moment.time - end)) for end in ends]


def on_points(values: Array, moment: Moment, contact: RoughContact) -> Array:
    """Interpolate values from the nodes of a simulation to the points of a contact."""
    spline = RectBivariateSpline(moment.x, moment.y, values)
    return np.asarray(spline(contact.x, contact.y))


def passage_of(case: pyehl.Case, tile: Topography) -> Model:
    """Model of the passage of a tile, with the numerical damping of the grid of a case."""
    settings = case.resolve()
    point, oil = OperatingPoint.from_settings(settings), Lubricant.from_settings(settings)
    ratio = float(settings["surface"]["velocity_ratio"])
    mesh = 4.0 / (settings["grid"]["points"] - 1.0)
    return Model.of_one(tile, solve_contact(settings), point, oil, ModelOptions(), ratio, mesh)


def at(
    moment: Moment, passage: Model, start: float
) -> tuple[RoughContact, Array, Transfer, Spectrum]:
    """Points of a contact at a moment, film and pressure changes to first order, and response.

    `start`: position of the tile at time 0 [a].
    """
    (one,) = passage.surfaces
    way = (start + one.velocity_ratio * moment.time) * passage.operating.hertz_radius
    moved = replace(one, topography=shifted(one.topography, way))
    (wave,) = waves = replace(passage, surfaces=(moved,)).components()
    contact = passage.rough_contact(waves)
    assert isinstance(contact, RoughContact)
    contact.second = None
    return contact, contact.change((0, 0)), wave.transfer, wave.spectrum


def compare(name: str, points: int, moments: list[Moment]) -> list[dict[str, Any]]:
    """Statistics of a case at its places: correlations, and fits of first and second order."""
    case, tile = case_of(name, points)
    passage, start = passage_of(case, tile), float(case.resolve()["surface"]["x_start"])
    parts: dict[str, list[Array]] = {}
    for moment in moments:
        contact, change, transfer, spectrum = at(moment, passage, start)
        gain, _ = transfer.second.of(spectrum.power) if transfer.second else (np.zeros(3), 0.0)
        film = on_points(moment.smooth_film, moment, contact)
        moved_film = contact.smooth_film() / contact.film
        values = np.stack(
            [
                on_points(moment.pressure - moment.smooth_pressure, moment, contact),
                change[..., 1],
                moved_film - on_points(moment.film, moment, contact) / film,
                change[..., 0] / film,
            ]
        )
        inside = np.abs(contact.across) < SIDE
        masks = {k: (contact.radius >= a) & (contact.radius < b) for k, (a, b) in RINGS.items()}
        for k, (a, b) in STRIPS.items():
            strip = (contact.x > a) & (contact.x < b)
            masks[k] = np.logical_and.outer(strip, inside)
        for k, mask in masks.items():
            parts.setdefault(k, []).append(values[:, mask])
    rows = []
    for k, pieces in parts.items():
        p, p1, loss, t1 = np.concatenate(pieces, axis=1)
        one = np.ones_like(p1)
        pressure = np.linalg.lstsq(np.stack([one, p1, p1**2], 1), p, rcond=None)[0]
        film = np.linalg.lstsq(np.stack([t1, t1**2], 1), loss, rcond=None)[0]
        station = list(STRIPS).index(k) if k in STRIPS else 1
        values = (
            np.corrcoef(p, p1)[0, 1],
            pressure[1],
            pressure[2],
            gain[station],
            np.corrcoef(loss, t1)[0, 1],
            film[0],
            film[1],
        )
        texts = [f"{v:.4f}" for v in values]
        rows.append(dict(zip(COLUMNS, (name, points, k, *texts), strict=True)))
    return rows


def lobes(name: str, points: int, moments: list[Moment]) -> list[dict[str, Any]]:
    """Loss of film in the side lobes and at the centre, simulated and predicted to first order.

    Gives the correlation, and both rms values [a^2/R].
    """
    case, tile = case_of(name, points)
    passage, start = passage_of(case, tile), float(case.resolve()["surface"]["x_start"])
    parts: dict[str, list[Array]] = {}
    for moment in moments:
        contact, change, _, _ = at(moment, passage, start)
        smooth = on_points(moment.smooth_film, moment, contact)
        moved = smooth * contact.smooth_film() / contact.film
        both = np.stack([moved - on_points(moment.film, moment, contact), change[..., 0]])
        x, y = contact.x, np.abs(contact.across)
        lobe = np.logical_and.outer(
            (x > LOBE_X[0]) & (x < LOBE_X[1]), (y > LOBE_Y[0]) & (y < LOBE_Y[1])
        )
        for place, mask in {"r < 0.4": contact.radius < 0.4, "lobes": lobe}.items():
            parts.setdefault(place, []).append(both[:, mask & (contact.radius < 1.0)])
    rows = []
    for place, pieces in parts.items():
        both = np.concatenate(pieces, axis=1)
        rms = (f"{v:.6f}" for v in both.std(axis=1))
        texts = passage.velocity_ratio, place, f"{np.corrcoef(both)[0, 1]:.4f}", *rms
        rows.append(dict(zip(LOBE_COLUMNS, (name, points, *texts), strict=True)))
    return rows


def add(new: list[dict[str, Any]], path: Path) -> None:
    """Add rows to a table, replacing those of the same case and grid."""
    old = []
    if path.exists():
        with path.open(newline="", encoding="utf-8") as stream:
            old = list(csv.DictReader(stream))
    made = {(row["name"], str(row["points"])) for row in new}
    with path.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, list(new[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows([*(r for r in old if (r["name"], r["points"]) not in made), *new])


def main() -> None:
    """Simulate and compare, or print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*")
    parser.add_argument("--points", type=int, default=513)
    parser.add_argument("--lobes", action="store_true")
    given = parser.parse_args()
    path, statistics = (HERE / "lobes.csv", lobes) if given.lobes else (HERE / "table.csv", compare)
    for name in given.names:
        case, tile = case_of(name, given.points)
        moments = simulate(case, None if name in rough.PLAN else tile.heights)
        add(statistics(name, given.points, moments), path)
    print(path.read_text(encoding="utf-8"))
    print(f"INLET_PRESSURE {response.INLET_PRESSURE}, INLET_FILM {response.INLET_FILM}")


if __name__ == "__main__":
    main()
