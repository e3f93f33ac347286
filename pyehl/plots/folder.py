# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of a result folder.

The figures are made in `pyehl.plots.contact`, `pyehl.plots.surface` and `pyehl.plots.transient`,
and written into folders here. Nothing is drawn on a screen.
"""

from __future__ import annotations

import csv
import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pyehl import results
from pyehl.plots import transient
from pyehl.plots.contact import centre_lines, film_maps
from pyehl.plots.style import DPI, Scales, save
from pyehl.plots.surface import friction_passage, roughness_pair, surface_spectrum
from pyehl.surfaces import Topography
from pyehl.theory.operating import OperatingPoint

__all__ = ["plot_folder", "save_prediction"]

Array = NDArray[np.float64]


def save_prediction(
    folder: Path,
    surface: Topography,
    deformed: Array,
    conditions: tuple[float, float, float, str],
    passage: tuple[Array, Array, Sequence[tuple[float, float, float]]] | None,
    dpi: int = DPI,
) -> list[Path]:
    """Write the pictures of a prediction into a folder; returns their paths.

    Parameters
    ----------
    folder
        Where to.
    surface, deformed
        The tile, and its deformed roughness [m] of the same shape.
    conditions
        a [m], M, L and the wavelength convention.
    passage
        Displacement [m] and mu_r/mu_s there, both (n,), and longest and shortest wavelength [m]
        and rise of each octave; None: there is no prediction.
    dpi
        Dots per inch.
    """
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
    return save_prediction(target, surface, deformed, conditions, passage, dpi)


def _plot_run(folder: Path, target: Path, units: str, dpi: int) -> list[Path]:
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
    run: results.Result, target: Path, scales: Scales | None, dpi: int, seconds: float
) -> list[Path]:
    x, y = run["X"], run["Y"]
    pair = transient.deformed_roughness(x, y, run["RR"], run["A_d"], scales)
    lines = transient.rough_and_smooth(
        x, y, (run["P"], run["P_smooth"]), (run["H"], run["H_smooth"]), scales
    )
    written = [
        save(pair, target / "deformed_roughness.png", dpi),
        save(lines, target / "rough_and_smooth.png", dpi),
    ]
    if "history_T" not in run.variables:  # at rest
        return written
    time = run["history_T"]
    if time.size > 1:
        figure = transient.friction_history(
            time,
            run["history_mu_ratio"],
            period=float(run.summary["T_mean"]),
            mean=run.summary["mu_ratio"],
            formula=transient.eq_16(run),
            seconds=seconds,
        )
        written.append(save(figure, target / "friction.png", dpi))
    return written


def plot_folder(folder: Path, target: Path, units: str = "auto", dpi: int = DPI) -> list[Path]:
    """Write the pictures of a result folder into another; returns their paths.

    Parameters
    ----------
    folder, target
        Result folder, and where the pictures go.
    units
        Of the EHL fields: 'si', 'hertz', or 'auto' for SI when the case was given in SI.
    dpi
        Dots per inch.

    Raises
    ------
    ValueError, KeyError
        If the folder is not a result folder.
    OSError
        If a file cannot be read or written.
    """
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    if summary.get("kind") == "prediction":
        return _plot_prediction(folder, summary, target, dpi)
    return _plot_run(folder, target, units, dpi)
