# SPDX-License-Identifier: BSD-3-Clause
"""What all pictures share: sizes, colours, units, letters.

Maps are colour-blind safe; lengths are in mm, films in um, pressures in GPa when scales are given,
else in Hertz units. Labels are plain text where it says the same: to set mathematics takes as long
as the rest of a panel.
"""

import io
import math
import re
import zlib
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter
from numpy.typing import NDArray

from pyehl import lengths
from pyehl.destination import mark, new_file
from pyehl.plots.outline import CIRCLE, Outline
from pyehl.types import Array

DPI = 150
INCH = 0.0254
# For PNG files: twice as fast as the usual way, and as small
COMPRESSION = {"compress_type": zlib.Z_RLE}
# Okabe & Ito: distinguishable by everybody
BLUE, VERMILLION, GREEN, GREY = "#0072B2", "#D55E00", "#009E73", "#666666"
SEQUENTIAL, DIVERGING = "viridis", "PuOr_r"
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
# Powers of ten as plain text: to read them as mathematics takes as long as the rest of an axis
POWERS = FuncFormatter(lambda value, _: "10" + f"{math.log10(value):.0f}".translate(SUPERSCRIPTS))


@dataclass(frozen=True, slots=True)
class Scales:
    """What turns Hertz units into SI: a [m], p_h [Pa], a^2/R_x [m]."""

    radius: float
    pressure: float
    film: float


# Width of the page that figures are drawn for [in]; 0: as wide as their panels want
PAGE_WIDTH: ContextVar[float] = ContextVar("PAGE_WIDTH", default=0.0)
# Letters as journals want them in their columns [pt], and how many go into an inch
PAGE_FONT, LETTERS_PER_INCH = 7.0, 17.0
# As many of the others
LARGE_PER_INCH = 13.3
# Long over short side of a map from which the latter has one number alone
SLENDER = 4.0


@contextmanager
def page_width(metres: float) -> Iterator[None]:
    """Draw figures so wide, with letters of `PAGE_FONT`; 0: as wide as their panels want."""
    if not metres:
        yield
        return
    token = PAGE_WIDTH.set(metres / INCH)
    try:
        with rc_context({"font.size": PAGE_FONT, "axes.linewidth": 0.6, "lines.linewidth": 1.0}):
            yield
    finally:
        PAGE_WIDTH.reset(token)


def wrapped(title: str, width: float, per_inch: float = LETTERS_PER_INCH) -> str:
    """Break a line of parts, ',  ' between them, so that it fits a width in inches."""
    lines: list[str] = []
    for part in title.split(",  "):
        joined = f"{lines[-1]},  {part}" if lines else part
        # what mathematics is written with is not seen
        seen = len(re.sub(r"\\[a-z]+|[${}]", "", joined))
        if lines and seen <= width * per_inch:
            lines[-1] = joined
        else:
            lines.append(part)
    return ",\n".join(lines)


def new_figure(width: float, height: float) -> Figure:
    """Make an empty figure of a size in inches, laid out by itself."""
    return Figure(figsize=(width, height), layout="constrained")


def axes_or_new(ax: Axes | None, width: float, height: float) -> Axes:
    """Give the axes back, or those of a new pyplot figure of a size in inches."""
    if ax is None:
        from matplotlib import pyplot  # noqa: PLC0415 (heavy, and no file needs it)

        _, ax = pyplot.subplots(figsize=(width, height), layout="constrained")
    return ax


def not_known(ax: Axes) -> None:
    """Say so in axes that have nothing to show."""
    ax.set(xticks=[], yticks=[])
    ax.text(0.5, 0.5, "not known", ha="center", va="center", transform=ax.transAxes)


def colour_bar(
    image: ScalarMappable, ax: Axes, label: str, *, shrink: float = 1.0, slender: float = 1.0
) -> None:
    """Put a colour bar beside axes, so much shorter than they are.

    `slender`: height of the axes over their width, where they are slender.
    """
    unit = math.sqrt(max(1.0, slender))
    beside = ax.inset_axes((1.0 + 0.04 * unit, 0.5 - 0.5 * shrink, 0.05 * unit, shrink))
    powers = POWERS if isinstance(image.norm, LogNorm) else None
    ax.figure.colorbar(image, cax=beside, format=powers).set_label(label)


def y_label(ax: Axes, label: str, colour: str) -> None:
    """Label a y axis in the colour of its line."""
    ax.set_ylabel(label, color=colour)
    ax.tick_params(axis="y", colors=colour)


def label_decades(*axes: Axis) -> None:
    """Label the decades of logarithmic axes as `POWERS` does, or numbers between where few are."""
    for axis in axes:
        low, high = axis.get_view_interval()
        if high > 30.0 * low:
            axis.set_major_formatter(POWERS)
            axis.set_minor_formatter(NullFormatter())
        else:
            label_log_ticks(axis)


def few_ticks(ax: Axes) -> None:
    """Leave one number on the short side of a slender map, where more would lie on each other."""
    for axis, other in ((ax.xaxis, ax.yaxis), (ax.yaxis, ax.xaxis)):
        (low, high), long = axis.get_view_interval(), np.ptp(other.get_view_interval())
        if SLENDER * (high - low) < long:
            place = 0.0 if low < 0.0 else float(high)
            axis.set_ticks([place], [f"{place:.3g}"])


def contact_heights(
    heights: Array,
    extent: tuple[float, float, float, float],
    radius: float,
    top: float,
    unit: str,
    *,
    name: str,
    bar: bool,
    ax: Axes,
    outline: Outline = CIRCLE,
) -> None:
    """Draw heights inside the Hertz ellipse, with a colour bar or not; the title gives their rms.

    Heights (nx, ny) are in `unit`, NaN outside of the ellipse, `top` is the largest of the scale;
    outer edges of the map and semi-axis along the motion in the unit of the axes.
    """
    image = ax.imshow(
        heights.T, origin="lower", extent=extent, cmap=DIVERGING, vmin=-top, vmax=top,
        interpolation="nearest",
    )  # fmt: skip
    ax.add_patch(outline.patch(radius, lw=0.8, ec=GREY))
    rms = float(np.nanstd(heights))
    ax.set_title(f"{name} rms {rms:.3g} {unit}".strip(), loc="left", fontsize="medium", y=1.0)
    along, across = outline.reach
    ax.set(xlim=(-1.05 * along * radius, 1.05 * along * radius))
    ax.set(ylim=(-1.05 * across * radius, 1.05 * across * radius))
    if bar:
        colour_bar(image, ax, f"height [{unit}]", shrink=0.85, slender=outline.slender)


def extent_of(
    x: NDArray[np.floating[Any]], y: NDArray[np.floating[Any]], unit: float = 1.0
) -> tuple[float, float, float, float]:
    """Outer edges of a map with such pixels, for imshow, in a unit."""
    half_x, half_y = 0.5 * (x[1] - x[0]), 0.5 * (y[1] - y[0])
    ends = x[0] - half_x, x[-1] + half_x, y[0] - half_y, y[-1] + half_y
    left, right, bottom, top = (float(end) * unit for end in ends)
    return left, right, bottom, top


def save(figure: Figure, path: str | Path, dpi: int = DPI, command: str = "plot") -> Path:
    """Write a figure as PNG (or what the suffix says), whole or not at all; returns the path.

    It says whose picture it is (`command`). FileError if it cannot be written.
    """
    path = Path(path)
    options: dict[str, Any] = {"metadata": {"Creator": mark(command)}}
    if path.suffix == ".png":
        options = {"metadata": {"Software": mark(command)}, "pil_kwargs": COMPRESSION}
    # fonts are put into PDF files as TrueType
    with new_file(path) as partial, rc_context({"pdf.fonttype": 42, "ps.fonttype": 42}):
        figure.savefig(partial, dpi=dpi, **options)
    return path


def png(figure: Figure, dpi: int) -> bytes:
    """Give a figure as the bytes of a PNG."""
    stream = io.BytesIO()
    # small rather than quick: it goes into a page
    figure.savefig(stream, format="png", dpi=dpi, pil_kwargs={"optimize": True})
    return stream.getvalue()


def letter(axes: Sequence[Axes]) -> None:
    """Mark several axes (a), (b), ...."""
    if len(axes) > 1:
        for mark, ax in zip("abcdef", axes, strict=False):
            # at a given height nothing is measured to keep clear of what is above the axes
            ax.set_title(f"({mark})", loc="left", fontsize="medium", y=1.0)


def axis_unit(scales: Scales | None, name: str) -> tuple[float, str]:
    """Factor from Hertz radii to the unit of an axis, and its label."""
    if scales is None:
        return 1.0, f"{name.upper()} = {name}/a"
    return scales.radius * 1e3, f"{name} [mm]"


def pressure_unit(scales: Scales | None) -> tuple[float, str]:
    """Factor from Hertz pressures to the unit of an axis, and its label."""
    if scales is None:
        return 1.0, r"$P = p/p_h$"
    return scales.pressure * 1e-9, "p [GPa]"


def film_unit(scales: Scales | None) -> tuple[float, str]:
    """Factor from films in a^2/R to the unit of an axis, and its label."""
    if scales is None:
        return 1.0, "H = hR/a²"
    return scales.film * 1e6, "h [µm]"


def hertz_ticks(ax: Axes, outline: Outline = CIRCLE) -> None:
    """Mark the contact radius and its half on both axes, of an ellipse how far it reaches."""
    if outline == CIRCLE:
        ax.set_xticks([-1.0, -0.5, 0.0, 0.5, 1.0])
        ax.set_yticks([-1.0, -0.5, 0.0, 0.5, 1.0])
    else:
        along, across = outline.reach
        ax.set_xticks([-along, 0.0, along], [f"{-along:.3g}", "0", f"{along:.3g}"])
        ax.set_yticks([-across, 0.0, across], [f"{-across:.3g}", "0", f"{across:.3g}"])


def label_log_ticks(axis: Axis) -> None:
    """Label 1, 2 and 5 of each decade of a logarithmic axis where there are few decades."""
    low, high = axis.get_view_interval()
    if high < 100.0 * low:
        decades = 10.0 ** np.arange(math.floor(math.log10(low)), math.log10(high))
        places = np.outer(decades, (1.0, 2.0, 5.0))
        few = np.count_nonzero((low <= places) & (places <= high)) < 2
        axis.set_major_locator(MaxNLocator(3) if few else LogLocator(subs=(1.0, 2.0, 5.0)))
        axis.set_major_formatter(FuncFormatter(lambda value, _: _short(value)))
        axis.set_minor_formatter(NullFormatter())


def _short(value: float) -> str:
    """Write the number of a tick; as a power of ten where it is very large or small."""
    if 1e-3 <= value < 1e4:
        return f"{value:g}"
    digits, _, power = f"{value:.2e}".partition("e")
    factor = "" if float(digits) == 1.0 else rf"{float(digits):g}\cdot"
    return f"${factor}10^{{{int(power)}}}$"


def points(ax: Axes, x: Array, y: Array, error: Array, **how: Any) -> None:  # noqa: ANN401
    """Draw points (n,), those that are numbers, with bars where one of their errors is known."""
    known = np.isfinite(x) & np.isfinite(y)
    bars = np.nan_to_num(error[known])
    ax.errorbar(x[known], y[known], bars if bars.any() else None, **how)


def band(ax: Axes, x: Array, y: Array, error: Array, **how: Any) -> None:  # noqa: ANN401
    """Shade around a line (n,) where its error is known."""
    known = np.isfinite(x) & np.isfinite(y) & np.isfinite(error)
    if known.any():
        low, high = y[known] - error[known], y[known] + error[known]
        ax.fill_between(x[known], low, high, lw=0, **how)


def height_unit(largest: float) -> tuple[float, str]:
    """Factor from metres to the unit for heights up to `largest`, and its name."""
    return (1e9, "nm") if largest < 5e-7 else (1e6, "µm")


def length_unit(largest: float) -> tuple[float, str]:
    """Factor from metres to the unit for lengths up to `largest`, and its name."""
    unit = lengths.unit_of(largest)
    return lengths.UNITS[unit], unit.replace("u", "µ")


def nearest(values: Array, target: float) -> int:
    """Index of the value nearest to a target."""
    return int(np.argmin(np.abs(values - target)))
