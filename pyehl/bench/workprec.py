# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl bench workprec``: error against seconds and against units, and the cheapest settings.

Every setting is one run. Seconds are those of the processor; the unit, one scipy.fft deflection at
the same grid, is measured before each run. The reference of the errors is extrapolated from the two
finest grids by the narrow scheme; its error bar is what one grid more has changed it by.
"""

import itertools
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from pyehl.bench.unit import processor_seconds, unit_seconds
from pyehl.case import Case
from pyehl.prediction.predict import predict
from pyehl.solver import Solver
from pyehl.types import Row

COLUMNS = (
    ("scene", "s"),
    ("quantity", "s"),
    ("setting", "s"),
    ("points", "d"),
    ("threads", "d"),
    ("seconds", ".3f"),
    ("units", ".1f"),
    ("value", ".6g"),
    ("error", ".1e"),
    ("bar", ".0e"),
    ("estimate", ".1e"),
)
POINT = ("contact.moes_m=1000.0", "contact.moes_l=10.0")
WAVE = (
    *POINT,
    "surface.kind=harmonic",
    "surface.amplitude=9.734e-3",
    "surface.velocity_ratio=1.01",
)
RATIO = ("mu_ratio",)
# What is varied, one at a time from the default; behind the first two of rough contacts alone
SETTINGS: tuple[tuple[str, tuple[str, ...]], ...] = (
    ("default", ()),
    ("fft", ("solver.deflection=fft",)),
    ("paper", ("time.scheme=paper",)),
    ("alcouffe", ("solver.coarsening=alcouffe",)),
    ("classical", ("solver.coarsening=classical",)),
)
LEVELS = (0.03, 0.01, 0.003, 0.001)
"""Errors that the cheapest setting is looked for."""
ORDER = 2
"""Of the discretisation, for Richardson extrapolation."""


@dataclass(frozen=True, slots=True)
class Scene:
    """What is solved."""

    name: str
    options: tuple[str, ...]  # its case, as texts ``group.key=value``
    quantities: tuple[str, ...]  # what the error is of
    # Nodes per side; the last one with ``--full`` alone, for the reference: default setting only
    grids: tuple[int, ...]
    rough: bool = True  # whether schemes, coarsenings and the prediction belong to it


SCENES = (
    Scene("smooth", POINT, ("H_c", "H_min", "F"), (65, 129, 257, 513, 1025, 2049), rough=False),
    Scene("wave", WAVE, RATIO, (129, 257, 513, 1025)),
    Scene(
        "resolved fractal",
        ("surface.kind=fractal", "surface.shortest_wavelength=5.2e-5"),
        RATIO,
        (129, 257, 513, 1025),
    ),
    Scene("fractal", ("surface.kind=fractal",), RATIO, (129, 257, 513, 1025)),
)


def work_rows(
    scenes: Sequence[str],
    *,
    grids: Sequence[int] = (),
    threads: Sequence[int] = (1, 2),
    full: bool = False,
    tell: Callable[[str], None] = lambda text: None,
) -> list[Row]:
    """Run all settings of scenes, by their names in `SCENES`.

    `grids`: nodes per side, where not those of the scene; `full`: with the finest of these, too.
    Of the numbers of threads those after the first are for the default setting alone. Rows have
    `COLUMNS` and `unit_seconds`; `error` is relative to the reference, `bar` the error of that,
    `estimate` what the run says of its own error.
    """
    rows: list[Row] = []
    for scene in (scene for scene in SCENES if scene.name in scenes):
        used = grids or (scene.grids if full else scene.grids[:-1])
        mine: list[Row] = []
        for points in used:
            unit = unit_seconds(points)
            # the finest grid is there for the reference
            reference = scene.rough and full and points == scene.grids[-1]
            for setting, options in SETTINGS if scene.rough else SETTINGS[:2]:
                if reference and options:
                    continue
                for workers in threads[:1] if reference or options else threads:
                    tell(f"{scene.name}: {points} x {points}, {setting}, threads {workers}")
                    mine += _run(scene, setting, options, points, workers, unit)
        if scene.rough:
            mine += _predicted(scene, unit_seconds(max(used)))
        mine += extrapolated(mine)
        add_errors(mine, scene.quantities)
        rows += mine
    return rows


def _run(
    scene: Scene, setting: str, options: Sequence[str], points: int, threads: int, unit: float
) -> list[Row]:
    texts = [*scene.options, *options, f"grid.points={points}", f"solver.threads={threads}"]
    if scene.rough:
        # the coarser run is a row of its own
        texts.append("time.estimate_error=.false.")
    began = processor_seconds()
    with Solver(Case.from_text("", texts)) as solver:
        solver.run()
        seconds = processor_seconds() - began
        summary = solver.summary
    row = {"setting": setting, "points": points, "threads": threads, "status": summary["status"]}
    rows = []
    for quantity in scene.quantities:
        value, error = summary.get(quantity), summary.get(f"{quantity}_error")
        estimate = abs(error / value) if error and value else None
        rows.append(row | _common(scene, quantity, seconds, unit, value, estimate))
    return rows


def _common(
    scene: Scene,
    quantity: str,
    seconds: float,
    unit: float,
    value: float | None,
    estimate: float | None,
) -> Row:
    return {
        "scene": scene.name,
        "quantity": quantity,
        "seconds": seconds,
        "units": seconds / unit,
        "unit_seconds": unit,
        "value": value,
        "estimate": estimate,
    }


def _predicted(scene: Scene, unit: float) -> list[Row]:
    """Give the prediction as one more setting."""
    case = Case.from_text("", scene.options)
    if scene.name == "wave":
        # the prediction takes heights in metres: no such surface there
        return []
    began = processor_seconds()
    told = predict(case.resolve()).summary
    seconds = processor_seconds() - began
    value, model = told["mu_ratio"], told.get("mu_ratio_model_error")
    row = {"setting": "prediction", "points": 257, "threads": 1, "status": told["status"]}
    return [
        row | _common(scene, "mu_ratio", seconds, unit, value, model / value if model else None)
    ]


def share_of_deflection(points: int = 129) -> Row:
    """Measure what multi-integration adds to the error of a short wave that slides.

    `difference`, relative, of mu_r/mu_s by multi-integration and by FFT; `grid_error` of it, by
    the next finer grid; `share`, their ratio.
    """
    options = [
        *POINT,
        "surface.kind=harmonic",
        "surface.wavelength=0.25",
        "surface.amplitude=0.003",
        "surface.velocity_ratio=1.1",
        "time.estimate_error=.false.",
    ]

    def ratio(n: int, engine: str) -> float:
        texts = [*options, f"grid.points={n}", f"solver.deflection={engine}"]
        with Solver(Case.from_text("", texts)) as solver:
            solver.run()
            return float(solver.summary["mu_ratio"])

    fast, exact, finer = ratio(points, "mlmi"), ratio(points, "fft"), ratio(2 * points - 1, "fft")
    difference = abs(fast / exact - 1.0)
    grid = abs(4.0 / 3.0 * (exact / finer - 1.0))
    return {
        "points": points,
        "difference": difference,
        "grid_error": grid,
        "share": difference / grid,
    }


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
