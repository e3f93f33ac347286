# SPDX-License-Identifier: BSD-3-Clause
"""The picture of a study: results over the first varied key, a line for each value of others."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure

from pyehl.plots.style import (
    COLOURS,
    COLUMN,
    GREY,
    PAGE,
    legend_below,
    letter,
    new_figure,
    points,
    styled,
)
from pyehl.types import Array

LINES = (*COLOURS, GREY)
MARKERS = "os^Dv<>"
# Maximum over minimum from which the axis is logarithmic
WIDE = 20.0


class Line(NamedTuple):
    """One line of a panel: label ('' for a single one), places, values, errors (NaN: none)."""

    label: str
    places: Array
    values: Array
    errors: Array


@styled()
def study_figure(
    panels: Sequence[tuple[str, Sequence[Line]]], abscissa: str, conditions: str
) -> Figure:
    """Draw a panel for each result, given as its label and its lines, over an abscissa.

    `abscissa` is its label; `conditions` go into the metadata of a file.
    """
    figure = new_figure(COLUMN if len(panels) == 1 else PAGE, 2.5)
    axes = figure.subplots(1, len(panels), squeeze=False)[0]
    for ax, (label, lines) in zip(axes, panels, strict=True):
        for k, line in enumerate(lines):
            points(
                ax,
                line.places,
                line.values,
                line.errors,
                fmt=f"{MARKERS[k % len(MARKERS)]}-",
                capsize=2,
                color=LINES[k % len(LINES)],
                label=line.label,
            )
        places = np.concatenate([line.places for line in lines])
        if places.min() > 0.0 and places.max() > WIDE * places.min():
            ax.set_xscale("log")
        ax.set(xlabel=abscissa, ylabel=label)
        ax.grid(visible=True)
    letter(axes)
    if len(panels[0][1]) > 1:
        legend_below(figure, axes[0])
    figure.set_label(conditions)
    return figure
