# SPDX-License-Identifier: BSD-3-Clause
"""Panels side by side under a line that says what they show."""

from collections.abc import Mapping
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pyehl.plots.style import LARGE_PER_INCH, PAGE_WIDTH, Scales, letter, new_figure, wrapped

# Room below and above a row of panels, and of one more line above them [in]
BELOW, ABOVE, LINE = 0.52, 0.57, 0.17
# Panels narrower than this are put below one another [in]
LEAST_PANEL = 2.0


def headline(summary: Mapping[str, Any], scales: Scales | None = None) -> str:
    """M, L, p_h, film and direction of motion in one line; the status unless it is a good one.

    Of the scalars of a solution or a prediction, with scales in SI units, else in Hertz units.
    """
    line = summary.get("shape") == "line"
    names = ("moes_m_line", "moes_l_line") if line else ("moes_m", "moes_l")
    moes_m, moes_l = (float(summary[name]) for name in names)
    parts = [*["line contact"] * line, f"M = {moes_m:.4g}", f"L = {moes_l:.4g}"]
    parts.append(f"Hertz pressure {summary['hertz_pressure_Pa'] * 1e-9:.3g} GPa")
    for name, word in (("c", "film"), ("min", "minimum")):
        si, big = summary.get(f"h_{name}_m"), summary.get(f"H_{name}")
        if si is None and scales is not None and big is not None:
            si = big * scales.film
        if si is not None and (scales is not None or big is None):
            parts.append(f"{word} {si * 1e6:.3g} µm")
        elif big is not None:
            parts.append(f"{word} H = {big:.3g}")
    if summary["status"] not in ("converged", "predicted"):
        parts.append(str(summary["status"]).upper())
    return ",  ".join(parts) + ",  motion →"


def panels(
    count: int,
    size: tuple[float, float],
    title: str,
    *,
    sharey: bool = False,
    room: tuple[float, float, float] | None = None,
) -> Figure:
    """Make a figure with panels side by side.

    `room`: left of, between and right of the panels in inches, where it is known. Then nothing is
    measured, which takes as long as to draw.
    """
    page = PAGE_WIDTH.get()
    if page:
        return _on_page(count, size, wrapped(title, page), page, sharey=sharey)
    title = wrapped(title, size[0], LARGE_PER_INCH)
    if room is None:
        figure = new_figure(*size)
    else:
        more = LINE * title.count("\n")
        (width, height), (left, between, right) = (size[0], size[1] + more), room
        panel = (width - left - right - (count - 1) * between) / count
        top = 1.0 - (ABOVE + more) / height
        figure = Figure(figsize=(width, height))
        figure.subplots_adjust(
            left / width, BELOW / height, 1.0 - right / width, top, between / panel
        )
    letter(list(figure.subplots(1, count, sharey=sharey, squeeze=False)[0]))
    figure.suptitle(title, fontsize="medium")
    return figure


def _on_page(
    count: int, size: tuple[float, float], title: str, width: float, *, sharey: bool
) -> Figure:
    """Make a figure as wide as a page, its panels below one another where they would be small."""
    columns = count if width >= count * LEAST_PANEL else 1
    rows = count // columns
    height = max(LEAST_PANEL, size[1] * width / columns * count / size[0])
    figure = new_figure(width, rows * height)
    letter(list(figure.subplots(rows, columns, sharey=sharey, squeeze=False).ravel()))
    figure.suptitle(title, fontsize="medium")
    return figure


def no_second_label(ax: Axes) -> None:
    """Leave out the label of the y axis that panels side by side share."""
    place = ax.get_subplotspec()
    if place is not None and not place.is_first_col():
        ax.set_ylabel("")
