# SPDX-License-Identifier: BSD-3-Clause
"""What all pictures share: sizes, colours, units, letters.

Maps are colour-blind safe; lengths are in mm, films in um, pressures in GPa when scales are given,
else in Hertz units.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib import pyplot
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

__all__ = [
    "BLUE",
    "DIVERGING",
    "DPI",
    "GREEN",
    "GREY",
    "SEQUENTIAL",
    "VERMILLION",
    "Scales",
    "axes_or_new",
    "axis_unit",
    "edges",
    "height_unit",
    "letter",
    "nearest",
    "new_figure",
    "save",
]

Array = NDArray[np.float64]

DPI = 300
# Okabe & Ito: told apart by everybody
BLUE, VERMILLION, GREEN, GREY = "#0072B2", "#D55E00", "#009E73", "#666666"
SEQUENTIAL, DIVERGING = "viridis", "PuOr_r"


@dataclass(frozen=True, slots=True)
class Scales:
    """What turns Hertz units into SI: a [m], p_h [Pa], a^2/R [m]."""

    radius: float
    pressure: float
    film: float


def new_figure(width: float, height: float) -> Figure:
    """Make an empty figure of a size in inches, laid out by itself."""
    return Figure(figsize=(width, height), layout="constrained")


def axes_or_new(ax: Axes | None, width: float, height: float) -> Axes:
    """Give the axes back, or those of a new pyplot figure of a size in inches."""
    if ax is None:
        _, ax = pyplot.subplots(figsize=(width, height), layout="constrained")
    return ax


def save(figure: Figure, path: str | Path, dpi: int = DPI) -> Path:
    """Write a figure as PNG (or what the suffix says) at `dpi` dots per inch; returns the path."""
    path = Path(path)
    figure.savefig(path, dpi=dpi)
    return path


def letter(axes: Sequence[Axes]) -> None:
    """Mark several axes (a), (b), ...."""
    if len(axes) > 1:
        for mark, ax in zip("abcdef", axes, strict=False):
            ax.set_title(f"({mark})", loc="left", fontsize="medium")


def axis_unit(scales: Scales | None, name: str) -> tuple[float, str]:
    """Factor from Hertz radii to the unit of an axis, and its label."""
    if scales is None:
        return 1.0, f"${name.upper()} = {name}/a$"
    return scales.radius * 1e3, f"${name}$ [mm]"


def height_unit(largest: float) -> tuple[float, str]:
    """Factor from metres to the unit for heights up to `largest`, and its name."""
    return (1e9, "nm") if largest < 5e-7 else (1e6, r"$\mu$m")


def edges(centres: NDArray[np.floating[Any]]) -> tuple[float, float]:
    """Outer edges of the first and the last pixel around equally spaced centres."""
    half = 0.5 * (centres[1] - centres[0])
    return float(centres[0] - half), float(centres[-1] + half)


def nearest(values: Array, target: float) -> int:
    """Index of the value nearest to a target."""
    return int(np.argmin(np.abs(values - target)))
