# SPDX-License-Identifier: BSD-3-Clause
"""Draw the picture at the top of the README: python docs/start/contact.py, half a minute."""

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Polygon, Rectangle
from PIL import Image

import pyehl
from pyehl.plots import contact, style
from pyehl.plots.figures import scales_of
from pyehl.plots.outline import Outline

HERE = Path(__file__).resolve().parent
CASE = HERE.parents[1] / "cases" / "finish.nml"
# At a higher speed than the case, so that all waves are visible; no waves that the grid does not
# resolve
CHANGES = {
    "contact.mean_velocity": 4.0,
    "grid.points": 257,
    "surface.shortest_wavelength": 5e-5,
}
STEEL, DISC, OIL = "#C9CED6", "#AEB6C2", "#F6E3B4"


def on_one_line(path: Path) -> None:
    """Write an SVG file on one line; its line ends have no meaning."""
    path.write_text(" ".join(path.read_text(encoding="utf-8").split()) + "\n", encoding="utf-8")


def arrow(ax: Axes, tip: tuple[float, float], tail: tuple[float, float], **more: Any) -> None:  # noqa: ANN401
    """Draw an arrow between two points."""
    style = {"arrowstyle": "-|>", "lw": 1.2, "color": "black", "shrinkA": 0, "shrinkB": 0, **more}
    ax.annotate("", tip, tail, arrowprops=style)


def sketch(ax: Axes) -> None:
    """Draw ball and disc, their velocities, the load and the oil between them."""
    ax.set(xlim=(-1.5, 1.5), ylim=(-0.62, 1.62), aspect="equal")
    ax.axis("off")
    x = np.linspace(-1.25, 1.25, 801)
    gap = 0.07 + 0.9 * np.maximum(0.0, np.abs(x) - 0.35) ** 2
    rough = gap + 0.012 * np.sin(50.0 * x) * np.sin(23.0 * x + 1.0)
    ax.add_patch(Rectangle((-1.45, -0.4), 2.9, 0.4, fc=DISC, ec="black", lw=0.8))
    inside = x < 0.62
    oil = [*zip(x[inside], rough[inside], strict=True), (0.62, 0.0), (-1.25, 0.0)]
    ax.add_patch(Polygon(oil, fc=OIL, ec="none"))
    top = [(1.25, 1.3), (-1.25, 1.3)]
    ax.add_patch(Polygon([*zip(x, rough, strict=True), *top], fc=STEEL, ec="none"))
    ax.plot(x, rough, color="black", lw=0.8)
    arrow(ax, (0.0, 1.0), (0.0, 1.5))
    ax.text(0.07, 1.42, "load $w$", va="center")
    arrow(ax, (0.45, 0.5), (-0.45, 0.5))
    ax.text(0.0, 0.56, "$u_1$", ha="center", va="bottom")
    arrow(ax, (0.35, -0.2), (-0.35, -0.2))
    ax.text(0.42, -0.2, "$u_2$", va="center")
    ax.text(-1.1, 1.12, "ball", va="center")
    ax.text(-1.38, -0.2, "disc", va="center")
    ax.annotate(
        "oil", (-0.85, 0.1), (-1.42, 0.42), va="center",
        arrowprops={"arrowstyle": "-", "lw": 0.6, "shrinkA": 1, "shrinkB": 0},
    )  # fmt: skip
    ax.text(0.0, -0.52, "motion →", ha="center", va="center")


def films(ax: Axes, data: Any) -> None:  # noqa: ANN401
    """Draw the film of the smooth and of the rough contact along the motion."""
    scales = scales_of(data)
    x, row = data.X.values, style.nearest(data.Y.values, 0.0)
    smooth, rough = (data[name].values[:, row] * scales.film * 1e9 for name in ("H_smooth", "H"))
    unit = scales.radius * 1e3
    ax.plot(x * unit, rough, color=style.VERMILLION, lw=1.2, label="rough")
    ax.plot(x * unit, smooth, "--", color="black", lw=1.0, label="smooth")
    central = smooth[style.nearest(x, 0.0)]
    arrow(ax, (0.0, central), (0.0, 0.0), arrowstyle="<|-|>", lw=0.8, mutation_scale=7)
    ax.text(0.012, 0.4 * central, r"$h_\mathrm{c}$", va="center")
    ax.set(xlim=(-1.4 * unit, 1.3 * unit), ylim=(0.0, 2.3 * central))
    ax.set(xlabel="x [mm], motion →", ylabel="h [nm] at y = 0")
    ax.legend(loc="upper center", ncols=2, frameon=False, handlelength=1.4, columnspacing=1.0)


def film_map(ax: Axes, data: Any) -> None:  # noqa: ANN401
    """Draw the film of the rough contact, and where it is measured."""
    scales = scales_of(data)
    contact.contours(data.X.values, data.Y.values, data.H.values, scales, ax=ax)
    for part in ax.collections:
        part.set_rasterized(True)
    inside = Outline().inside(data.X.values, data.Y.values)
    film = np.where(inside, data.H.values, np.inf)
    i, j = np.unravel_index(int(np.argmin(film)), film.shape)
    unit = scales.radius * 1e3
    lowest = data.X.values[i] * unit, data.Y.values[j] * unit
    for place, name, at in (
        ((0.0, 0.0), r"$h_\mathrm{c}$", (0.02, 0.05)),
        (lowest, r"$h_\mathrm{min}$", (0.24, 1.22 * np.sign(lowest[1]) * unit)),
    ):
        ax.plot(*place, "+", color="white", ms=5)
        line = {"arrowstyle": "-", "lw": 0.6, "shrinkA": 0, "shrinkB": 2}
        far = "min" in name
        ax.annotate(
            name, place, at, ha="center", va="center",
            color="black" if far else "white", arrowprops=line if far else None,
        )  # fmt: skip


@style.styled()
def drawn(data: Any) -> Figure:  # noqa: ANN401
    """Draw the contact, its film along the motion and its map."""
    figure = style.new_figure(style.PAGE, 0.056 / style.INCH)
    left, middle, right = figure.subplots(1, 3, width_ratios=(1.0, 1.2, 1.0))
    sketch(left)
    films(middle, data)
    film_map(right, data)
    return figure


def main() -> None:
    """Solve the contact and draw it."""
    figure = drawn(pyehl.solve(CASE, CHANGES))
    on_one_line(style.save(figure, HERE / "contact.svg", dpi=200))
    # for the first page of the site, which must load fast
    path = style.save(figure, HERE / "contact.png", dpi=160)
    with Image.open(path) as picture:
        picture.convert("RGB").quantize(128).save(path, optimize=True)


if __name__ == "__main__":
    main()
