# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of results, and the verb ``pyehl plot``.

The figures are made in `pyehl.plot_contact`, `pyehl.plot_surface` and `pyehl.plot_march`, and
written into folders here. Nothing is drawn on a screen.
"""

from __future__ import annotations

import argparse
import csv
import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from pyehl.operating import OperatingPoint
from pyehl.plot_contact import centre_lines, film_maps
from pyehl.plot_style import DPI, Scales, save
from pyehl.plot_surface import friction_passage, roughness_pair, surface_spectrum
from pyehl.topography import Topography

if TYPE_CHECKING:
    from pyehl.predict import Prediction
    from pyehl.results import Result

__all__ = [
    "Scales",
    "add_arguments",
    "centre_lines",
    "execute",
    "film_maps",
    "friction_passage",
    "roughness_pair",
    "save",
    "save_prediction",
    "surface_spectrum",
]

Array = NDArray[np.float64]


def save_prediction(prediction: Prediction, folder: Path) -> list[Path]:
    """Write the pictures of a prediction into a folder; returns their paths."""
    f, o = prediction.friction, prediction.operating
    bands = [(b.longest, b.shortest, b.rise) for b in prediction.bands]
    return _save_prediction(
        folder,
        prediction.surface,
        f.response.deformed,
        (o.hertz_radius, o.moes_m, o.moes_l, prediction.options.wavelength_convention),
        (f.shift, f.passage, bands) if f.status == "predicted" else None,
    )


def _save_prediction(
    folder: Path,
    surface: Topography,
    deformed: Array,
    conditions: tuple[float, float, float, str],
    passage: tuple[Array, Array, Sequence[tuple[float, float, float]]] | None,
    dpi: int = DPI,
) -> list[Path]:
    written = [
        save(surface_spectrum(surface, *conditions), folder / "surface_spectrum.png", dpi),
        save(roughness_pair(surface, deformed, conditions[0]), folder / "roughness.png", dpi),
    ]
    if passage is not None:
        shift, ratio, bands = passage
        figure = friction_passage(shift, ratio, surface.length_x, bands)
        written.append(save(figure, folder / "passage.png", dpi))
    return written


def _columns(path: Path) -> dict[str, Array]:
    with path.open(newline="", encoding="utf-8") as stream:
        rows = list(csv.reader(stream))
    table = np.array(rows[1:], dtype=float).reshape(len(rows) - 1, len(rows[0]))
    return {name: table[:, k] for k, name in enumerate(rows[0])}


def _plot_prediction(folder: Path, summary: dict[str, Any], target: Path, dpi: int) -> list[Path]:
    surface = Topography(
        np.load(folder / "surface.npy", allow_pickle=False),
        float(summary["length_x"]),
        float(summary["length_y"]),
        str(summary["surface"]),
    )
    deformed = np.load(folder / "deformed.npy", allow_pickle=False)
    passage = None
    if summary["status"] == "predicted":
        along, bands = _columns(folder / "passage.csv"), _columns(folder / "bands.csv")
        octaves = zip(bands["longest"], bands["shortest"], bands["rise"], strict=True)
        passage = (
            along["shift_m"],
            along["mu_ratio"],
            [(float(a), float(b), float(c)) for a, b, c in octaves],
        )
    conditions = (
        float(summary["hertz_radius"]),
        float(summary["moes_m"]),
        float(summary["moes_l"]),
        str(summary["wavelength_convention"]),
    )
    return _save_prediction(target, surface, deformed, conditions, passage, dpi)


def _plot_run(folder: Path, target: Path, units: str, dpi: int) -> list[Path]:
    from pyehl import results  # noqa: PLC0415

    run = results.read(folder)
    operating = OperatingPoint.from_settings(run.case)
    scales = None
    if units == "si" or (units == "auto" and operating.si):
        scales = Scales(operating.hertz_radius, operating.hertz_pressure, operating.film_scale)
    x, y, pressure, film = (run[name] for name in "XYPH")
    written = [
        save(centre_lines(x, y, pressure, film, scales), target / "centre_lines.png", dpi),
        save(film_maps(x, y, film, scales), target / "film.png", dpi),
    ]
    if "A_d" in run.variables:
        written += _plot_march(run, target, scales, dpi, operating.time_scale if scales else 0.0)
    return written


def _plot_march(
    run: Result, target: Path, scales: Scales | None, dpi: int, seconds: float
) -> list[Path]:
    from pyehl import plot_march  # noqa: PLC0415 (only marches need it)

    x, y = run["X"], run["Y"]
    pair = plot_march.deformed_roughness(x, y, run["RR"], run["A_d"], scales)
    lines = plot_march.rough_and_smooth(
        x, y, (run["P"], run["P_smooth"]), (run["H"], run["H_smooth"]), scales
    )
    written = [
        save(pair, target / "deformed_roughness.png", dpi),
        save(lines, target / "rough_and_smooth.png", dpi),
    ]
    time = run["history_T"]
    if time.size > 1:
        figure = plot_march.friction_history(
            time,
            run["history_mu_ratio"],
            period=float(run.summary["T_mean"]),
            mean=run.summary["mu_ratio"],
            formula=plot_march.eq_16(run),
            seconds=seconds,
        )
        written.append(save(figure, target / "friction.png", dpi))
    return written


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of ``pyehl plot``."""
    parser.add_argument("folder", type=Path, help="result folder of pyehl run or predict")
    parser.add_argument("-o", "--output", type=Path, help="where the PNG go (default: the folder)")
    parser.add_argument(
        "--units",
        choices=("auto", "si", "hertz"),
        default="auto",
        help="of the EHL fields (default: SI when the case was given in SI)",
    )
    parser.add_argument("--dpi", type=int, default=DPI, help=f"dots per inch (default: {DPI})")


def execute(args: argparse.Namespace) -> int:
    """Run ``pyehl plot``; 0 when drawn, 2 when there is nothing to draw."""
    folder: Path = args.folder
    try:
        if not (folder / "summary.json").is_file():
            raise ValueError(f"{folder}: no result folder, it has no summary.json")
        if not 10 <= args.dpi <= 2400:
            raise ValueError(f"--dpi {args.dpi}: 10 ... 2400 dots per inch were expected")
        target: Path = args.output or folder
        target.mkdir(parents=True, exist_ok=True)
        summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        if summary.get("kind") == "prediction":
            written = _plot_prediction(folder, summary, target, args.dpi)
        else:
            written = _plot_run(folder, target, args.units, args.dpi)
    except (ValueError, KeyError, OSError) as error:
        print(error, file=sys.stderr)
        return 2
    for path in written:
        print(path)
    return 0
