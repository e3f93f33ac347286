# SPDX-License-Identifier: BSD-3-Clause
"""The picture of a study: results over what was varied first, a line for each other value."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure

from pyehl.plots.style import BLUE, GREEN, GREY, VERMILLION, letter, new_figure, points
from pyehl.types import Array

COLOURS = (BLUE, VERMILLION, GREEN, "#CC79A7", "#E69F00", "#56B4E9", GREY)
MARKERS = "os^Dv<>"
# Values over a larger range are drawn over a logarithmic axis
WIDE = 20.0


class Line(NamedTuple):
    """One line of a panel: its label ('' for the only one), places, values, errors (NaN: none)."""

    label: str
    places: Array
    values: Array
    errors: Array


def study_figure(panels: Sequence[tuple[str, Sequence[Line]]], abscissa: str, title: str) -> Figure:
    """Draw a panel for each result, given as its label and its lines, over an abscissa."""
    figure = new_figure(1.0 + 3.4 * len(panels), 3.4)
    axes = figure.subplots(1, len(panels), squeeze=False)[0]
    for ax, (label, lines) in zip(axes, panels, strict=True):
        for k, line in enumerate(lines):
            points(
                ax,
                line.places,
                line.values,
                line.errors,
                fmt=f"{MARKERS[k % len(MARKERS)]}-",
                ms=4,
                lw=1.2,
                capsize=2,
                color=COLOURS[k % len(COLOURS)],
                label=line.label,
            )
        places = np.concatenate([line.places for line in lines])
        if places.min() > 0.0 and places.max() > WIDE * places.min():
            ax.set_xscale("log")
        ax.set(xlabel=abscissa, ylabel=label)
        ax.grid(visible=True, color="0.92", lw=0.6)
    letter(axes)
    if len(panels[0][1]) > 1:
        axes[0].legend(fontsize="small")
    figure.suptitle(title, fontsize="medium")
    return figure
