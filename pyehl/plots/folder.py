# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of a result folder.

The figures are made in `pyehl.plots.contact`, `pyehl.plots.surface` and `pyehl.plots.transient`,
and written into folders here. Nothing is drawn on a screen.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import xarray as xr
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


def _plot_prediction(data: xr.Dataset, target: Path, dpi: int) -> list[Path]:
    about = data.attrs
    surface = Topography(
        data.surface_m.values, about["length_x_m"], about["length_y_m"], about["surface"]
    )
    passage = None
    if about["status"] == "predicted":
        octaves = zip(
            *(data[f"bands_{name}"].values for name in ("longest_m", "shortest_m", "rise")),
            strict=True,
        )
        passage = (
            data.passage_shift_m.values,
            data.passage_mu_ratio.values,
            [(float(a), float(b), float(c)) for a, b, c in octaves],
        )
    names = ("hertz_radius_m", "moes_m", "moes_l", "wavelength_convention")
    radius, m, ell, convention = (about[name] for name in names)
    return save_prediction(
        target, surface, data.deformed_m.values, (radius, m, ell, convention), passage, dpi
    )


def _plot_run(data: xr.Dataset, target: Path, units: str, dpi: int) -> list[Path]:
    operating = OperatingPoint.from_settings(results.settings_of(data))
    scales = None
    if units == "si" or (units == "auto" and operating.si):
        scales = Scales(operating.hertz_radius, operating.hertz_pressure, operating.film_scale)
    x, y, pressure, film = (data[name].values for name in "XYPH")
    written = [
        save(centre_lines(x, y, pressure, film, scales), target / "centre_lines.png", dpi),
        save(film_maps(x, y, film, scales), target / "film.png", dpi),
    ]
    if "A_d" in data:
        seconds = operating.time_scale if scales else 0.0
        written += _plot_transient(data, target, scales, dpi, seconds)
    return written


def _plot_transient(
    data: xr.Dataset, target: Path, scales: Scales | None, dpi: int, seconds: float
) -> list[Path]:
    names = ("X", "Y", "RR", "A_d", "P", "P_smooth", "H", "H_smooth")
    x, y, rough, deformed, p, p_smooth, h, h_smooth = (data[name].values for name in names)
    pair = transient.deformed_roughness(x, y, rough, deformed, scales)
    lines = transient.rough_and_smooth(x, y, (p, p_smooth), (h, h_smooth), scales)
    written = [
        save(pair, target / "deformed_roughness.png", dpi),
        save(lines, target / "rough_and_smooth.png", dpi),
    ]
    if "history_T" not in data:  # at rest
        return written
    time = data.history_T.values
    if time.size > 1:
        figure = transient.friction_history(
            time,
            data.history_mu_ratio.values,
            period=float(data.attrs["T_mean"]),
            mean=data.attrs.get("mu_ratio"),
            formula=transient.eq_16(data.attrs, results.settings_of(data)),
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
    data = results.load(folder)
    if data.attrs.get("kind") == "prediction":
        return _plot_prediction(data, target, dpi)
    return _plot_run(data, target, units, dpi)
