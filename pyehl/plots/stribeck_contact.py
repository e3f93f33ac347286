# SPDX-License-Identifier: BSD-3-Clause
"""Contact at a boundary film and the least film, below the friction of Stribeck curves."""

from collections.abc import Sequence
from typing import Any, Protocol

from matplotlib.axes import Axes
from numpy.typing import NDArray

from pyehl.plots import style
from pyehl.types import Array


class HasColumns(Protocol):
    """A curve by its columns."""

    def column(self, name: str) -> Array:
        """Give a column (n,); NaN for what is not there."""
        ...


def draw_contact(
    panels: NDArray[Any], abscissae: Sequence[str], curves: Sequence[tuple[HasColumns, str]]
) -> None:
    """Draw shares of load and area on the first row of panels (2, n), least film on the second.

    Lines are predictions, squares and diamonds full simulations.
    """
    for (share, film), name in zip(panels.T, abscissae, strict=True):
        for curve, colour in curves:
            x = curve.column(name)
            _band(share, x, curve, "contact_load_share", colour)
            share.plot(x, curve.column("contact_area_share"), "--", lw=1, color=colour)
            _points(share, x, curve, "contact_load_share_ehl", colour)
            _points(share, x, curve, "contact_area_share_ehl", colour, marker="D")
            _band(film, x, curve, "h_min_rough_m", colour, 1e9)
            _points(film, x, curve, "h_min_rough_ehl_m", colour, 1e9)
        share.set_ylim(-0.03, 1.03)
        film.set_ylim(bottom=0.0)
        for ax in (share, film):
            ax.grid(visible=True, which="major", color="0.92", lw=0.6)
            ax.set_axisbelow(True)
    panels[0, 0].set_ylabel("load, area (dashed)")
    panels[1, 0].set_ylabel("least film [nm]")


def _band(
    ax: Axes, x: Array, curve: HasColumns, name: str, colour: str, factor: float = 1.0
) -> None:
    """Draw a column with its error."""
    y, error = factor * curve.column(name), factor * curve.column(_error(name))
    ax.plot(x, y, "o-", ms=3, lw=1.2, color=colour)
    style.band(ax, x, y, error, color=colour, alpha=0.35)


def _points(
    ax: Axes,
    x: Array,
    curve: HasColumns,
    name: str,
    colour: str,
    factor: float = 1.0,
    marker: str = "s",
) -> None:
    """Draw a column of the full simulation; a load share with its error."""
    y = factor * curve.column(name)
    error = curve.column(_error(name)) if name.startswith("contact_load") else 0.0 * y
    style.points(ax, x, y, error, fmt=marker, ms=5, mfc="white", color=colour, capsize=3)


def _error(name: str) -> str:
    return name.removesuffix("_m") + ("_error_m" if name.endswith("_m") else "_error")
