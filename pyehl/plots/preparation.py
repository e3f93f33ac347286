# SPDX-License-Identifier: BSD-3-Clause
"""A map before and after it was prepared, with its spectrum.

Arrays have their first index along x.
"""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pyehl.plots import style
from pyehl.surfaces import Preparation, Topography, psd_isotropic
from pyehl.surfaces.holes import nearest
from pyehl.theory.amplitude import component_amplitude_ratio
from pyehl.types import Array

SHOWN = 0.005
"""Share of the heights that may lie beyond either end of the colours, against spikes."""


def before_and_after(
    surface: Topography, conditions: tuple[float, float, float, str] | None = None
) -> Figure:
    """Draw a surface as it was and as it is, and its isotropic spectrum.

    With conditions, which are a [m], M, L and the wavelength convention, the amplitude reduction
    A_d/A_i is drawn over the spectrum, for waves along x.
    """
    made = surface.preparation
    figure = style.new_figure(10.2 if made else 7.0, 2.9)
    axes = list(figure.subplots(1, 3 if made else 2))
    lengths = (surface.length_x, surface.length_y)
    curves = [("prepared" if made else "surface", style.BLUE, surface)]
    if made:
        raw = _as_measured(made)
        _map(axes[0], made.scan.heights - np.nanmean(made.scan.heights), _size(made), "as measured")
        nx, ny = made.prepared.shape
        lengths = (nx * made.pixel[0], ny * made.pixel[1])
        _map(axes[1], made.prepared, lengths, "prepared")
        curves.insert(0, ("as measured", style.GREY, raw))
    else:
        _map(axes[0], surface.heights, lengths, "surface")
    _spectra(axes[-1], curves, conditions)
    style.letter(axes)
    return figure


def _size(made: Preparation) -> tuple[float, float]:
    return made.scan.length_x, made.scan.length_y


def _as_measured(made: Preparation) -> Topography:
    """Map as read, as if it were a tile, its holes closed by what is next to them."""
    z = nearest(made.scan.heights)
    return Topography(z - z.mean(), _size(made))


def _map(ax: Axes, heights: Array, size: tuple[float, float], title: str) -> None:
    """Heights in colours; a hole is white."""
    low, high = np.nanquantile(heights, [SHOWN, 1.0 - SHOWN])
    top = float(max(abs(low), abs(high))) or 1.0
    unit, name = style.height_unit(top)
    image = ax.imshow(
        heights.T * unit, origin="lower", extent=(0.0, size[0] * 1e3, 0.0, size[1] * 1e3),
        cmap=style.DIVERGING, vmin=-top * unit, vmax=top * unit, interpolation="nearest",
    )  # fmt: skip
    bar = ax.figure.colorbar(image, ax=ax, fraction=0.046, extend="both")
    bar.set_label(f"height [{name}]")
    rms = float(np.nanstd(heights)) * unit
    peak = float(np.nanmax(np.abs(heights))) * unit
    ax.set_title(f"{title}\nrms {rms:.3g}, peak {peak:.3g} {name}", fontsize="small", loc="right")
    ax.set(xlabel="x [mm]", ylabel="y [mm]")


def _spectra(
    ax: Axes,
    curves: list[tuple[str, str, Topography]],
    conditions: tuple[float, float, float, str] | None,
) -> None:
    ends: list[float] = []
    for label, colour, tile in curves:
        q, c_iso = psd_isotropic(tile)
        shown = c_iso > c_iso.max() * 1e-14
        ax.loglog(q[shown], c_iso[shown], "-", lw=1.2, color=colour, label=label)
        ends += [float(q[0]), float(q[-1])]
    ax.set(xlabel="|q| [rad/m]", ylabel="isotropic spectrum [m⁴]")
    ax.legend(loc="lower left", fontsize="small")
    if conditions is None:
        return
    radius, moes_m, moes_l, convention = conditions
    twin = ax.twinx()
    line = np.geomspace(min(ends), max(ends), 200)
    ratio = component_amplitude_ratio(line, 0.0, radius, moes_m, moes_l, convention=convention)
    twin.plot(line, ratio, color=style.VERMILLION, lw=1.4)
    twin.set_ylim(0.0, 1.02)
    style.y_label(twin, r"$A_d/A_i$", style.VERMILLION)
