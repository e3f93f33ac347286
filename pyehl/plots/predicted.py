# SPDX-License-Identifier: BSD-3-Clause
"""Figures of a prediction: its surfaces, deformed, and the friction of their passage."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from pyehl.plots import surface
from pyehl.plots.panels import headline, no_second_label, panels
from pyehl.surfaces import Topography, wavenumbers
from pyehl.theory.ellipse import ellipse
from pyehl.theory.transport import stiffness
from pyehl.types import Array


def prediction_figures(
    about: Mapping[str, Any], arrays: Mapping[str, Array], tables: Mapping[str, Mapping[str, Array]]
) -> dict[str, Figure]:
    """All figures of a prediction, by the names of their files.

    `about` is its summary; of the `tables` ``passage`` and ``bands`` are shown.
    """
    title = headline(about)
    figures: dict[str, Figure] = {}
    for prefix in ("", "second_") if "second_surface" in about else ("",):
        figures |= _side(about, arrays, prefix, title)
    if about["status"] == "predicted":
        figures["passage"] = _passage(tables, about["length_x_m"], title)
    return figures


def _side(
    about: Mapping[str, Any], arrays: Mapping[str, Array], prefix: str, title: str
) -> dict[str, Figure]:
    """Figures of the rough surface whose names begin with a prefix."""
    size = about[f"{prefix}length_x_m"], about[f"{prefix}length_y_m"]
    tile = Topography(arrays[f"{prefix}surface"], size, about[f"{prefix}surface"])
    deformed = arrays[f"{prefix}deformed"]
    figure = panels(3, (11.6, 3.2), title, room=(0.8, 1.9, 0.8))
    first, second, third = figure.axes
    third.set_box_aspect(1.0)
    surface.heights(tile, ax=first)
    surface.spectrum_map(tile, ax=second)
    flattened = _flattened(about, Topography(arrays[f"{prefix}delta_p"], size))
    surface.spectrum_line(tile, deformed, flattened, ax=third)
    figure.axes[-1].set_box_aspect(1.0)
    figures = {f"{prefix}surface_spectrum": figure}
    figure = panels(2, (7.2, 3.4), title, sharey=True, room=(0.75, 0.35, 1.15))
    for ax, values, name in zip(
        list(figure.axes),
        (tile.heights, deformed),
        ("(a) undeformed,", "(b) deformed,"),
        strict=True,
    ):
        last = values is deformed
        a, kappa = about["hertz_radius_m"], about.get("ellipticity", 1.0)
        surface.roughness(tile, values, a, name=name, bar=last, ellipticity=kappa, ax=ax)
    no_second_label(figure.axes[1])
    figures[f"{prefix}roughness"] = figure
    return figures


def _flattened(about: Mapping[str, Any], tile: Topography) -> Array:
    """Return what pressure [Pa] flattens of a tile [m]: it over E'|q|/4 of the half-space."""
    kernel_ratio = ellipse(about.get("radius_ratio", 1.0)).kernel_ratio
    stiff = stiffness(np.hypot(*wavenumbers(tile)) * about["hertz_radius_m"]) / kernel_ratio
    # the mean is not flattened
    stiff[0, 0] = np.inf
    unit = about["film_scale_m"] / about["hertz_pressure_Pa"]
    part = np.fft.rfft2(tile.heights) * unit / stiff
    return np.asarray(np.fft.irfft2(part, s=tile.shape))


def _passage(tables: Mapping[str, Mapping[str, Array]], length: float, title: str) -> Figure:
    figure = panels(2, (7.6, 3.2), title, room=(0.9, 1.05, 0.15))
    left, right = figure.axes
    shift, ratio = tables["passage"]["shift_m"], tables["passage"]["mu_ratio"]
    second = tables["passage"].get("second_shift_m")
    surface.passage(shift, ratio, length, second=second, ax=left)
    columns = [tables["bands"][name] for name in ("longest_m", "shortest_m", "rise")]
    surface.octaves(
        [(float(a), float(b), float(c)) for a, b, c in zip(*columns, strict=True)], ax=right
    )
    return figure
