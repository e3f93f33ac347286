# SPDX-License-Identifier: BSD-3-Clause
"""Common parts of all pictures: the style sheet, sizes, colours, units, letters.

Figures are drawn for print: text of 8 points, one column or one page wide, no titles. Maps are
colour-blind safe; lengths are in mm, films in nm or um, pressures in GPa if scales are given, else
in Hertz units. Labels are plain text if possible: typesetting mathematics takes as long as the rest
of a panel.
"""

import io
import math
import zlib
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from cycler import cycler
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm
from matplotlib.contour import ContourSet
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, MaxNLocator, NullFormatter
from numpy.typing import NDArray

from pyehl import lengths
from pyehl.destination import mark, new_file
from pyehl.plots.outline import CIRCLE, Outline
from pyehl.types import Array

DPI = 200
INCH = 0.0254
# Widths of a column and of a page of a journal [in]
COLUMN, PAGE = 0.085 / INCH, 0.175 / INCH
# Okabe & Ito: colour-blind safe
BLUE, VERMILLION, GREEN, GREY = "#0072B2", "#D55E00", "#009E73", "#666666"
PURPLE, ORANGE, SKY = "#CC79A7", "#E69F00", "#56B4E9"
COLOURS = (BLUE, VERMILLION, GREEN, PURPLE, ORANGE, SKY)
STYLE: Any = {
    **dict.fromkeys(("font.size", "axes.titlesize", "axes.labelsize", "legend.fontsize"), 8.0),
    **dict.fromkeys(("xtick.labelsize", "ytick.labelsize"), 8.0),
    **dict.fromkeys(("axes.linewidth", "xtick.major.width", "ytick.major.width"), 0.6),
    **dict.fromkeys(("xtick.minor.width", "ytick.minor.width"), 0.4),
    "lines.linewidth": 1.2,
    "lines.markersize": 3.0,
    "legend.frameon": False,
    "legend.handlelength": 1.6,
    "legend.columnspacing": 1.2,
    "grid.color": "0.92",
    "grid.linewidth": 0.5,
    "axes.grid": False,
    "axes.axisbelow": True,
    "mathtext.default": "it",
    "axes.prop_cycle": cycler(color=COLOURS),
}
"""The style sheet."""
# For PNG files: twice as fast as the default, and as small
COMPRESSION = {"compress_type": zlib.Z_RLE}
SEQUENTIAL, DIVERGING = "viridis", "PuOr_r"
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
# Powers of ten as plain text: typesetting them takes as long as the rest of an axis
POWERS = FuncFormatter(lambda value, _: "10" + f"{math.log10(value):.0f}".translate(SUPERSCRIPTS))


# Films [m] below this are shown in nm
THIN = 1e-6


@dataclass(frozen=True, slots=True)
class Scales:
    """Scales from Hertz units to SI: a [m], p_h [Pa], a^2/R_x [m]."""

    radius: float
    pressure: float
    film: float
    thin: bool = False  # films are shown in nm, else in um


# Width of figures [in]; 0: a column or a page, by their panels
PAGE_WIDTH: ContextVar[float] = ContextVar("PAGE_WIDTH", default=0.0)
# Long over short side of a map from which the short one has a single number
SLENDER = 4.0
# Letters of 8 points per inch, and the width of a legend handle with its gaps in letters
LETTERS_PER_INCH, HANDLE = 14.0, 7
# Minimum vertical distance of numbers over the width of a map
CLOSE = 0.035
# Half width of a band over the height of its axes below which the line hides it
THIN_BAND = 0.005
# Height over width below which a map is flat
FLAT = 0.5


@contextmanager
def styled() -> Iterator[None]:
    """Apply the style sheet; also a decorator."""
    with rc_context(STYLE):
        yield


class Picture(Figure):
    """A figure with the style sheet, which also applies when ticks and layout are drawn."""

    def draw(self, renderer: Any) -> None:  # noqa: ANN401
        """Draw it with the style sheet."""
        with rc_context(STYLE):
            super().draw(renderer)


@contextmanager
def page_width(metres: float) -> Iterator[None]:
    """Set the width of figures [m]; 0: a column or a page, by their panels."""
    token = PAGE_WIDTH.set(metres / INCH)
    try:
        with rc_context(STYLE):
            yield
    finally:
        PAGE_WIDTH.reset(token)


def new_figure(width: float, height: float) -> Figure:
    """Make an empty figure of a size in inches, with automatic layout."""
    return Picture(figsize=(width, height), layout="constrained")


def axes_or_new(ax: Axes | None, width: float, height: float) -> Axes:
    """Return the axes, or those of a new pyplot figure of a size in inches."""
    if ax is None:
        from matplotlib import pyplot  # noqa: PLC0415 (heavy, and no file needs it)

        _, ax = pyplot.subplots(figsize=(width, height), layout="constrained")
    return ax


def not_known(ax: Axes) -> None:
    """Write 'not known' in empty axes."""
    ax.set(xticks=[], yticks=[])
    ax.text(0.5, 0.5, "not known", ha="center", va="center", transform=ax.transAxes)


def colour_bar(
    image: ScalarMappable, ax: Axes, label: str, *, slender: float = 1.0, above: bool = False
) -> None:
    """Put a colour bar beside axes, with the same height.

    `slender`: height of the axes over their width; `above`: the label is above the bar, as beside a
    flat map, which has no room along the bar.
    """
    broad = 0.05 * min(1.0, max(slender, 0.3))
    beside = ax.inset_axes((1.0 + 0.8 * broad, 0.0, broad, 1.0))
    log = isinstance(image.norm, LogNorm)
    bar = ax.figure.colorbar(image, cax=beside, format=POWERS if log else None)
    ticks = 3 if slender < FLAT else 7
    if isinstance(image, ContourSet):
        levels = list(image.levels)
        bar.set_ticks(levels[:: math.ceil(len(levels) / ticks)])
    elif not log:
        bar.locator = MaxNLocator(ticks)
        bar.update_ticks()
    if above or slender < FLAT:
        beside.set_title(label, loc="left" if above else "right", y=1.0)
    else:
        bar.set_label(label)


def legend_below(figure: Figure, *axes: Axes) -> None:
    """Put one legend for several axes below the panels."""
    named = [ax.get_legend_handles_labels() for ax in axes]
    unique = {label: handle for result in named for handle, label in zip(*result, strict=True)}
    if unique:
        letters = figure.get_figwidth() * LETTERS_PER_INCH
        columns = max(1, int(letters // (HANDLE + max(map(len, unique)))))
        figure.legend(unique.values(), unique.keys(), loc="outside lower center", ncols=columns)


def y_label(ax: Axes, label: str, colour: str) -> None:
    """Label a y axis in the colour of its line."""
    ax.set_ylabel(label, color=colour)
    ax.tick_params(axis="y", colors=colour)


def label_decades(*axes: Axis, max_labels: int = 9) -> None:
    """Label the decades of logarithmic axes, or numbers between them if they are few."""
    for axis in axes:
        low, high = axis.get_view_interval()
        if high > 30.0 * low:
            axis.set_major_formatter(POWERS)
            axis.set_minor_formatter(NullFormatter())
        else:
            label_log_ticks(axis, max_labels)


def few_ticks(ax: Axes) -> None:
    """Give each axis of a map the numbers that it has room for."""
    wide, high = (float(np.ptp(axis.get_view_interval())) for axis in (ax.xaxis, ax.yaxis))
    for axis, ratio in ((ax.xaxis, wide / high), (ax.yaxis, high / wide)):
        low, top = (float(end) for end in axis.get_view_interval())
        if ratio < 1.0 / SLENDER:
            # stacked numbers need less room than those side by side
            place = round_below(0.85 * min(top, -low)) if low < 0.0 < top else 0.0
            room = axis is ax.yaxis and place > CLOSE * wide
            places = [0.0, place, -place][: 1 + 2 * room] if low < 0.0 else [top]
            axis.set_ticks(places, [f"{p:.3g}".replace("-", "−") for p in places])
        else:
            axis.set_major_locator(MaxNLocator(4 if ratio > 2.0 else 2 if ratio < 0.7 else 3))


def round_below(value: float) -> float:
    """Round a positive value down to 1, 2 or 5 times a power of ten."""
    power = 10.0 ** math.floor(math.log10(value))
    return next(step * power for step in (5.0, 2.0, 1.0) if step * power <= value * (1 + 1e-12))


def contact_heights(
    heights: NDArray[np.floating[Any]],
    x: NDArray[np.floating[Any]],
    y: NDArray[np.floating[Any]],
    radius: float,
    top: float,
    unit: str,
    *,
    name: str,
    bar: bool,
    ax: Axes,
    outline: Outline = CIRCLE,
) -> None:
    """Draw heights inside the Hertz ellipse, optionally with a colour bar; the title has their rms.

    Heights (nx, ny) are in `unit`, NaN outside of the ellipse, `top` is the maximum of the scale;
    positions x (nx,), y (ny,) and semi-axis along the motion are in the unit of the axes.
    """
    across, up, seen = outline.seen(x, y, heights)
    image = ax.imshow(
        seen.T, origin="lower", extent=extent_of(across, up), cmap=DIVERGING, vmin=-top, vmax=top,
        interpolation="nearest",
    )  # fmt: skip
    ax.add_patch(outline.patch(radius, lw=0.8, ec=GREY))
    rms = float(np.nanstd(heights))
    ax.set_title(f"{name} rms {rms:.3g} {unit}".strip(), loc="left", y=1.0)
    wide, high = (half * radius for half in outline.view(1.05))
    ax.set(xlim=(-wide, wide), ylim=(-high, high))
    if bar:
        colour_bar(image, ax, f"height [{unit}]", slender=high / wide)


def place_labels(ax: Axes, x: str, y: str, outline: Outline) -> None:
    """Label the axes of a map along and across the motion, and mark its direction."""
    if outline.turned:
        ax.set(xlabel=y, ylabel=x)
        name = ax.get_title(loc="left")
        above = f"{name}{',' * (len(name) > 3)} motion ↑".strip()
        ax.set_title(above, loc="left", y=1.0)
    else:
        ax.set(xlabel=f"{x}, motion →", ylabel=y)


def extent_of(
    x: NDArray[np.floating[Any]], y: NDArray[np.floating[Any]], unit: float = 1.0
) -> tuple[float, float, float, float]:
    """Outer edges of a map with pixels at x and y, for imshow, in a unit."""
    half_x, half_y = 0.5 * (x[1] - x[0]), 0.5 * (y[1] - y[0])
    ends = x[0] - half_x, x[-1] + half_x, y[0] - half_y, y[-1] + half_y
    left, right, bottom, top = (float(end) * unit for end in ends)
    return left, right, bottom, top


def save(figure: Figure, path: str | Path, dpi: int = DPI, command: str = "plot") -> Path:
    """Write a figure as PNG (or what the suffix names), whole or not at all; returns the path.

    Its metadata name the command and the conditions, the label of the figure.
    FileError if it cannot be written.
    """
    path = Path(path)
    options: dict[str, Any] = {"metadata": {"Creator": mark(command)}}
    if path.suffix == ".png":
        options = {"metadata": {"Software": mark(command)}, "pil_kwargs": COMPRESSION}
    # PDF files embed fonts as TrueType
    if words := str(figure.get_label()):
        field = {".png": "Description", ".svg": "Description", ".pdf": "Subject"}.get(path.suffix)
        options["metadata"] |= {field: words} if field else {}
    with new_file(path) as partial, rc_context({"pdf.fonttype": 42, "ps.fonttype": 42}):
        figure.savefig(partial, dpi=dpi, **options)
    return path


def png(figure: Figure, dpi: int) -> bytes:
    """Give a figure as the bytes of a PNG."""
    stream = io.BytesIO()
    # optimised for size: it is embedded in a page
    figure.savefig(stream, format="png", dpi=dpi, pil_kwargs={"optimize": True})
    return stream.getvalue()


def letter(axes: Sequence[Axes]) -> None:
    """Mark several axes (a), (b), ...."""
    if len(axes) > 1:
        for mark, ax in zip("abcdef", axes, strict=False):
            # a fixed height saves the measurement of other text above the axes
            ax.set_title(f"({mark})", loc="left", y=1.0)


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
    return scales.film * (1e9 if scales.thin else 1e6), "h [nm]" if scales.thin else "h [µm]"


def hertz_ticks(ax: Axes, outline: Outline = CIRCLE) -> None:
    """Mark the contact radius and its half on both axes, or the extents of an ellipse."""
    for axis, reach in zip((ax.xaxis, ax.yaxis), outline.box, strict=True):
        places = reach * np.array([-1.0, -0.5, 0.0, 0.5, 1.0] if outline == CIRCLE else [-1, 0, 1])
        axis.set_ticks(places, [f"{place:.3g}".replace("-", "−") for place in places])


def label_log_ticks(axis: Axis, max_labels: int = 9) -> None:
    """Label 1, 2 and 5 of each decade of a logarithmic axis with few decades.

    At most `max_labels` of them.
    """
    low, high = axis.get_view_interval()
    if high < 100.0 * low:
        decades = 10.0 ** np.arange(math.floor(math.log10(low)), math.log10(high))
        places = np.outer(decades, (1.0, 2.0, 5.0)).ravel()
        places = places[(low <= places) & (places <= high)]
        if places.size < 2:
            axis.set_major_locator(MaxNLocator(min(3, max_labels - 1)))
        else:
            axis.set_major_locator(
                FixedLocator(places[:: math.ceil(places.size / max_labels)].tolist())
            )
        axis.set_major_formatter(FuncFormatter(lambda value, _: _short(value)))
        axis.set_minor_formatter(NullFormatter())


def _short(value: float) -> str:
    """Write the number of a tick, with a power of ten if it is very large or small."""
    if 1e-3 <= value < 1e4:
        return f"{value:g}"
    digits, _, power = f"{value:.2e}".partition("e")
    factor = "" if float(digits) == 1.0 else rf"{float(digits):g}\cdot"
    return f"${factor}10^{{{int(power)}}}$"


def points(ax: Axes, x: Array, y: Array, error: Array, **options: Any) -> None:  # noqa: ANN401
    """Draw the finite ones of points (n,), with bars if an error is known."""
    known = np.isfinite(x) & np.isfinite(y)
    bars = np.nan_to_num(error[known])
    ax.errorbar(x[known], y[known], bars if bars.any() else None, **options)


def band(ax: Axes, x: Array, y: Array, error: Array, **options: Any) -> None:  # noqa: ANN401
    """Shade the error around a line (n,) that is already drawn, where it is known.

    The legend omits a band that is thinner than the line.
    """
    known = np.isfinite(x) & np.isfinite(y) & np.isfinite(error)
    if known.any():
        if float(error[known].max()) < THIN_BAND * float(np.ptp(ax.get_ylim())):
            options.pop("label", None)
        low, high = y[known] - error[known], y[known] + error[known]
        ax.fill_between(x[known], low, high, lw=0, **options)


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
