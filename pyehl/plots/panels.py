# SPDX-License-Identifier: BSD-3-Clause
"""Panels side by side, or stacked, and the conditions of a picture."""

from collections.abc import Mapping, Sequence
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pyehl.plots.style import COLUMN, PAGE, PAGE_WIDTH, THIN, VERMILLION, Picture, Scales, letter
from pyehl.plots.style import new_figure as laid_out

# Room below and above a row of panels [in]
BELOW, ABOVE = 0.42, 0.22
# Room beside and between stacked panels [in]
LEFT, RIGHT, GAP = 0.6, 0.8, 0.12
# Room at the right of panels without a colour bar [in]
MARGIN = 0.12
# Panels narrower than this are stacked [in]
MIN_PANEL = 2.0


def headline(summary: Mapping[str, Any], scales: Scales | None = None) -> str:
    """M, L, p_h and film in one line, and in capitals the status of a failed run.

    From the scalars of a solution or a prediction; in SI units with scales, else in Hertz units.
    """
    shape = summary.get("shape")
    line = shape in ("line", "roller")
    names = ("moes_m_line", "moes_l_line") if line else ("moes_m", "moes_l")
    moes_m, moes_l = (float(summary[name]) for name in names)
    parts = [*[f"{shape} contact"] * line, f"M = {moes_m:.4g}", f"L = {moes_l:.4g}"]
    parts.append(f"Hertz pressure {summary['hertz_pressure_Pa'] * 1e-9:.3g} GPa")
    for name, word in (("c", "central film"), ("min", "minimum film")):
        si, big = summary.get(f"h_{name}_m"), summary.get(f"H_{name}")
        if si is None and scales is not None and big is not None:
            si = big * scales.film
        if si is not None and (scales is not None or big is None):
            parts.append(f"{word} {si * 1e9:.4g} nm" if si < THIN else f"{word} {si * 1e6:.3g} µm")
        elif big is not None:
            parts.append(f"{word} H = {big:.3g}")
    if summary["status"] not in ("converged", "predicted"):
        parts.append(str(summary["status"]).upper())
    return ",  ".join(parts)


def panels(
    count: int,
    size: tuple[float, float],
    conditions: str,
    *,
    sharey: bool = False,
    room: tuple[float, float, float] | None = None,
) -> Figure:
    """Make a figure with panels of a size (width, height), one column or one page wide.

    `conditions` are its label, which goes into the metadata of a file; the status of a failed run
    is printed above the panels. `room`: space left of, between and right of panels side by side, in
    inches, if it is known; it saves the automatic layout, which takes as long as drawing.
    """
    width = page(count)
    columns = 1 if width < count * MIN_PANEL else count
    rows, height = count // columns, max(MIN_PANEL, width / columns * size[1] / size[0])
    if room is None or columns < count or failed(conditions):
        figure = laid_out(width, rows * height)
    else:
        left, between, right = room
        panel = (width - left - right - (count - 1) * between) / count
        figure = Picture(figsize=(width, height))
        figure.subplots_adjust(
            left / width, BELOW / height, 1.0 - right / width, 1.0 - ABOVE / height, between / panel
        )
    figure.subplots(rows, columns, sharey=sharey, squeeze=False)
    return _labelled(figure, conditions)


def rows(heights: Sequence[float], conditions: str, right: float = RIGHT) -> Figure:
    """Make a figure with stacked panels of given heights over their width.

    All are equally wide, with room at the right [in], by default for a colour bar.
    """
    width = page(2)
    wide = width - LEFT - right
    high = BELOW + sum(wide * height + ABOVE + GAP for height in heights)
    top = high + (0.2 if failed(conditions) else 0.0)
    figure = Picture(figsize=(width, top))
    for height in heights:
        high -= wide * height + ABOVE + GAP
        bottom = high + GAP
        figure.add_axes((LEFT / width, bottom / top, wide / width, wide * height / top))
    return _labelled(figure, conditions)


def page(count: int) -> float:
    """Width of a figure with a number of panels [in]."""
    return PAGE_WIDTH.get() or (COLUMN if count == 1 else PAGE)


def failed(conditions: str) -> bool:
    """Whether they end with the status of a failed run."""
    return conditions.rpartition(",  ")[2].isupper()


def _labelled(figure: Figure, conditions: str) -> Figure:
    letter(figure.axes)
    if failed(conditions):
        figure.suptitle(conditions.rpartition(",  ")[2].lower(), color=VERMILLION)
    figure.set_label(conditions)
    return figure


def drop_second_label(ax: Axes) -> None:
    """Remove the label of a y axis shared with the panel at the left."""
    place = ax.get_subplotspec()
    if place is not None and not place.is_first_col():
        ax.set_ylabel("")


def drop_x_labels(*axes: Axes) -> None:
    """Remove numbers and labels of x axes that the panels below repeat."""
    for ax in axes:
        ax.tick_params(labelbottom=False)
        ax.set_xlabel("")
