# SPDX-License-Identifier: BSD-3-Clause
"""Stress below the surface: the section y = 0, and the maximum shear over depth."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter

from pyehl.plots import style

if TYPE_CHECKING:
    import xarray as xr

# Number of contours; depth [short half widths] and half width [a] of the section
LEVELS, DEEP, WIDE = 12, 1.5, 1.5


def _units(data: xr.Dataset) -> tuple[float, str, float, str]:
    """Factor and label of lengths in a, and of stresses over p_h."""
    if "z_m" not in data.coords:
        return 1.0, "a", 1.0, r"$\tau_\mathrm{max}/p_h$"
    length, unit = style.length_unit(float(data.principal_shear_max_depth_m))
    a = float(data.z_m[-1] / data.Z[-1])
    p_h = float(data.principal_shear_max_Pa / data.principal_shear_max)
    return a * length, unit, p_h * 1e-6, r"$\tau_\mathrm{max}$ [MPa]"


def section(data: xr.Dataset, ax: Axes | None = None) -> Axes:
    """Contours of the principal shear stress on y = 0, the maximum over time.

    Parameters
    ----------
    data
        A result of `pyehl.stress`.
    ax
        Axes; None: a new figure.
    """
    ax = style.axes_or_new(ax, 4.6, 3.0)
    length, unit, factor, label = _units(data)
    x, z = data.X.values * length, data.Z.values * length
    shear = data.section_shear.transpose("Z", "X").values * factor
    image = ax.contourf(x, z, shear, levels=LEVELS, cmap=style.SEQUENTIAL)
    ax.contour(x, z, shear, levels=image.levels, colors="w", linewidths=0.3)
    short = float(data.attrs["short_side"]) * length
    ax.set(xlim=(-WIDE * length, WIDE * length), ylim=(DEEP * short, 0.0))
    ax.set(xlabel=f"x [{unit}]", ylabel=f"depth z [{unit}]")
    style.colour_bar(image, ax, label)
    return ax


def over_depth(data: xr.Dataset, ax: Axes | None = None) -> Axes:
    """Maximum principal shear over depth, of a rough contact beside the smooth one."""
    ax = style.axes_or_new(ax, 3.4, 3.0)
    length, unit, factor, label = _units(data)
    z = np.maximum(data.Z.values, 0.5 * data.Z.values[1]) * length
    rough = "principal_shear_smooth" in data
    ax.plot(
        data.principal_shear.values * factor,
        z,
        color=style.BLUE,
        label="rough, maximum over time" if rough else "smooth",
    )
    if rough:
        smooth = data.principal_shear_smooth.values * factor
        ax.plot(smooth, z, "--", color=style.GREY, label="smooth")
        ax.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2)
    ax.set(yscale="log", ylim=(z[-1], z[0]), xlabel=label, ylabel=f"depth z [{unit}]")
    ax.set_xlim(left=0.0)
    ax.yaxis.set_major_formatter("{x:g}")
    ax.yaxis.set_minor_formatter(NullFormatter())
    return ax


@style.styled()
def stress_figures(data: xr.Dataset) -> dict[str, Figure]:
    """Give both pictures by the names of their files."""
    figures = {}
    for name, draw in (("section", section), ("depth", over_depth)):
        figures[name] = style.new_figure(style.COLUMN, 0.75 * style.COLUMN)
        draw(data, figures[name].add_subplot())
    return figures
