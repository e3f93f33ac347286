# SPDX-License-Identifier: BSD-3-Clause
"""A rough ball on a disc whose film is about as thick as the roughness: predicted and simulated.

    python docs/evidence/thin_film/make.py predict      rewrites predicted.csv
    python docs/evidence/thin_film/make.py simulate     adds missing rows to simulated.csv
    python docs/evidence/thin_film/make.py film         rewrites film.csv
    python docs/evidence/thin_film/make.py show         prints the tables of README.md

A simulation takes two minutes on one core on 257 x 257 nodes and ten on 513 x 513. film.csv has the
remaining film over the first-order loss of film: surface 1 at 6 m/s on 257 x 257 nodes, eight
moments of the last period.
"""

from __future__ import annotations

import csv
import importlib
import math
import sys
from pathlib import Path
from typing import Any

import numpy as np

import pyehl
from pyehl import surfaces
from pyehl.contact.smooth import solve_contact
from pyehl.prediction.model import Model, ModelOptions
from pyehl.prediction.response import film_left
from pyehl.schema import summary_of
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint

HERE = Path(__file__).parent
CASE = """
&contact
   load = 37.0 radius = 9.525e-3 reduced_modulus = 2.3077e11
   slide_to_roll = 0.3 rough_surface = 2
/
&lubricant
   pressure_viscosity = 1.8e-8 temperature = 80.0 density_15 = 870.0
   kinematic_viscosity_40 = 46.0 kinematic_viscosity_100 = 6.8
   shear_law = 'eyring' thermal_reduction = .true.
/
&surface
   kind = 'fractal' rms_height = 8e-8 hurst = 0.8 modulus = 'gaussian' pixels = 256
   rolloff_wavenumber = 7.85e4 shortest_wavelength = 8e-6 length_x = 512e-6 length_y = 512e-6
/
"""
# Seed, speed [m/s], flow, nodes per side
RUNS = [
    (1, 6.0, "consistent", 257),
    (1, 3.0, "consistent", 257),
    (1, 6.0, "newtonian", 257),
    (1, 3.0, "newtonian", 257),
    (1, 6.0, "consistent", 513),
    (1, 3.0, "consistent", 513),
    (2, 6.0, "consistent", 257),
    (2, 3.0, "consistent", 257),
    (2, 6.0, "consistent", 513),
    (2, 3.0, "consistent", 513),
]
KEYS = ("seed", "speed", "flow", "points")
# Distances from the centre [a], and the width of a bin of losses of film
RINGS, BIN = {"r < 0.7": (0.0, 0.7), "0.7 to 0.9": (0.7, 0.9)}, 0.2
POSITIONS = 32
NAMES = {
    "predicted.csv": (
        "status mu_ratio mu_ratio_model_error h_min_m h_min_rough_m h_min_rough_error_m loss"
    ).split(),
    "film.csv": "place from to points loss film film_deviation".split(),
    "simulated.csv": (
        "status mu_ratio mu_ratio_error mu_ratio_error_note h_min_m h_min_rough_m P_max_rough"
    ).split(),
}

Row = dict[str, Any]


def case_of(seed: int, speed: float, flow: str, points: int = 257) -> pyehl.Case:
    """Make the case of a run."""
    return pyehl.Case.from_text(
        CASE,
        [
            f"surface.seed={seed}",
            f"contact.mean_velocity={speed}",
            f"lubricant.flow={flow}",
            f"grid.points={points}",
        ],
    )


def predicted(seed: int, speed: float, flow: str) -> Row:
    """Predict a case; `loss` is the maximum first-order loss of film over the smooth film."""
    summary = pyehl.predict(case_of(seed, speed, flow)).summary | {"loss": loss(seed, speed, flow)}
    return {name: summary[name] for name in NAMES["predicted.csv"]}


def loss(seed: int, speed: float, flow: str) -> float:
    """Maximum first-order loss of film over a passage, over the smooth film."""
    settings = case_of(seed, speed, flow).resolve()
    point, oil = OperatingPoint.from_settings(settings), Lubricant.from_settings(settings)
    tile = surfaces.from_settings(settings, point, None)
    ratio = float(settings["surface"]["velocity_ratio"])
    model = Model.of_one(tile, solve_contact(settings), point, oil, ModelOptions(), ratio)
    waves = model.components()
    contact, pixels = model.rough_contact(waves), waves[0].spectrum.shape[0]
    result = 0.0
    for step in range(POSITIONS):
        reduction = contact.change((step * pixels // POSITIONS, 0))[..., 0] / contact.smooth_film()
        result = max(result, float(reduction.max(where=contact.inside, initial=0.0)))
    return result


def film() -> list[Row]:
    """Compute simulated over smooth film in bins of the predicted first-order loss of film."""
    sys.path.insert(0, str(HERE.parent / "fields"))
    fields = importlib.import_module("fields")
    case = case_of(1, 6.0, "consistent")
    settings = case.resolve()
    tile = surfaces.from_settings(settings, OperatingPoint.from_settings(settings), None)
    passage, start = fields.passage_of(case, tile), float(settings["surface"]["x_start"])
    parts = []
    for moment in fields.simulate(case):
        contact, change, *_ = fields.at(moment, passage, start)
        reduction = change[..., 0] / contact.smooth_film()
        films = [fields.on_points(f, moment, contact) for f in (moment.film, moment.smooth_film)]
        values = np.stack([contact.radius, reduction, films[0] / films[1]])
        parts.append(values[:, contact.inside])
    radius, reduction, ratio = np.concatenate(parts, axis=1)
    rows = []
    for place, (inner, outer) in RINGS.items():
        for low in BIN * np.arange(-5, 6):
            here = (radius >= inner) & (radius < outer)
            here &= (reduction >= low) & (reduction < low + BIN)
            if here.any():
                numbers = reduction[here].mean(), ratio[here].mean(), ratio[here].std()
                bounds = round(low, 1), round(low + BIN, 1)
                values = place, *bounds, np.count_nonzero(here), *(float(v) for v in numbers)
                rows.append(dict(zip(NAMES["film.csv"], values, strict=True)))
    return rows


def simulated(seed: int, speed: float, flow: str, points: int) -> Row:
    """Simulate a case."""
    try:
        data = pyehl.solve(case_of(seed, speed, flow, points))
    except pyehl.NotConverged as error:
        data = error.results
    result = {name: summary_of(data).get(name) for name in NAMES["simulated.csv"]}
    variables = [name for name in result if name in data]
    return result | {name: float(data[name]) for name in variables}


def read(name: str) -> list[Row]:
    """Read a table."""
    if not (HERE / name).exists():
        return []
    with (HERE / name).open(newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def write(name: str, rows: list[Row]) -> None:
    """Write a table."""
    keys = {"predicted.csv": KEYS[:3], "simulated.csv": KEYS, "film.csv": ()}[name]
    with (HERE / name).open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, [*keys, *NAMES[name]], lineterminator="\n")
        writer.writeheader()
        for row in rows:
            writer.writerow({k: f"{v:.6g}" if isinstance(v, float) else v for k, v in row.items()})


def number(row: Row, name: str) -> float:
    """Give a number of a table; NaN for an empty cell."""
    return float(row[name] or math.nan)


def with_error(value: float, error: float, form: str) -> str:
    """Format a number, with its error if it is known."""
    if not math.isfinite(value):
        return "–"
    return format(value, form) + (f" ± {error:{form}}" if math.isfinite(error) else "")


def lines() -> list[str]:
    """Make the table of predictions and simulations."""
    known = {tuple(row[k] for k in KEYS[:3]): row for row in read("predicted.csv")}
    result = [
        "| surface | speed [m/s] | flow | predicted μ_r/μ_s | minimum film [nm] | nodes "
        "| simulated μ_r/μ_s | minimum film [nm] | maximum pressure [p_h] |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for row in read("simulated.csv"):
        said = known[tuple(row[k] for k in KEYS[:3])]
        ratios = []
        for values, good, error in (
            (said, "predicted", "mu_ratio_model_error"),
            (row, "converged", "mu_ratio_error"),
        ):
            text = with_error(number(values, "mu_ratio"), number(values, error), ".4f")
            ratios.append(text if values["status"] == good else values["status"])
        minimum = [1e9 * number(said, name) for name in ("h_min_rough_m", "h_min_rough_error_m")]
        cells = [
            *(row["seed"], f"{float(row['speed']):g}", row["flow"], ratios[0]),
            *(with_error(*minimum, ".0f"), row["points"], ratios[1]),
            with_error(1e9 * number(row, "h_min_rough_m"), math.nan, ".0f"),
            with_error(number(row, "P_max_rough"), math.nan, ".1f"),
        ]
        result.append(f"| {' | '.join(cells)} |")
    return result


def film_lines() -> list[str]:
    """Make the table of the remaining film over its reduction, with `film_left`."""
    rows = read("film.csv")
    result = [
        "| first-order loss | below 0.7 a | 0.7 to 0.9 a | `film_left` |",
        "|---|---|---|---|",
    ]
    for low in dict.fromkeys(row["from"] for row in rows):
        here = {row["place"]: row for row in rows if row["from"] == low}
        cells = [
            with_error(*(number(here[k], n) for n in ("film", "film_deviation")), ".2f")
            if k in here
            else "–"
            for k in RINGS
        ]
        row = next(iter(here.values()))
        middle = 0.5 * (number(row, "from") + number(row, "to"))
        law = float(film_left(np.array(middle)))
        result.append(f"| {low} to {row['to']} | {' | '.join(cells)} | {law:.2f} |")
    return result


def main(arguments: list[str]) -> None:
    """Predict, simulate or show."""
    if arguments == ["predict"]:
        places = dict.fromkeys(run[:3] for run in RUNS)
        write(
            "predicted.csv",
            [dict(zip(KEYS[:3], run, strict=True)) | predicted(*run) for run in places],
        )
    elif arguments == ["simulate"]:
        rows = read("simulated.csv")
        done = {(int(r["seed"]), float(r["speed"]), r["flow"], int(r["points"])) for r in rows}
        for run in RUNS:
            if run not in done:
                print(*run, flush=True)
                rows.append(dict(zip(KEYS, run, strict=True)) | simulated(*run))
                write("simulated.csv", rows)
    elif arguments == ["film"]:
        write("film.csv", film())
    elif arguments == ["show"]:
        print("\n".join([*lines(), "", *film_lines()]))
    else:
        raise SystemExit(__doc__)


if __name__ == "__main__":
    main(sys.argv[1:])
