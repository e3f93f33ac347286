# SPDX-License-Identifier: BSD-3-Clause
"""Draw the pictures of the primer: python docs/start/primer.py, seconds."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
from contact import on_one_line

import pyehl
from pyehl.plots import contact, style
from pyehl.plots.figures import scales_of
from pyehl.theory.film import nijenbanning_venner_moes

HERE = Path(__file__).resolve().parent
CASE = HERE.parents[1] / "cases" / "finish.nml"
MIXED = HERE.parent / "evidence" / "mixed_curve" / "curve.csv"
HEIGHT = 0.72 * style.COLUMN


@style.styled()
def lines() -> None:
    """Pressure and film along the motion."""
    data = pyehl.solve(CASE, {"surface.kind": "smooth", "grid.points": 257})
    figure = style.new_figure(style.COLUMN, HEIGHT)
    ax = figure.subplots()
    row = style.nearest(data.Y.values, 0.0)
    fields = (data[name].values[:, row] for name in "PH")
    contact.pressure_and_film(data.X.values, *fields, scales_of(data), ax=ax)
    ax.set_xlabel("x [mm], motion →")
    twin = next(other for other in figure.axes if other is not ax)
    figure.legend(handles=[*ax.get_lines(), *twin.get_lines()], loc="outside lower center", ncols=3)
    on_one_line(style.save(figure, HERE / "ehl.svg"))


@style.styled()
def moes() -> None:
    """Film of smooth round contacts over M and L by formula."""
    figure = style.new_figure(style.COLUMN, HEIGHT)
    ax = figure.subplots()
    m = np.geomspace(5.0, 3000.0, 100)
    for moes_l, colour in zip((2.5, 5.0, 10.0, 20.0), ("black", *style_colours()), strict=True):
        film = [nijenbanning_venner_moes(value, moes_l) for value in m]
        ax.loglog(m, film, color=colour, label=f"L = {moes_l:g}")
    style.label_decades(ax.xaxis, ax.yaxis)
    ax.set(xlabel="M", ylabel=r"$H_\mathrm{c} = h_\mathrm{c}R/a^2$")
    ax.grid(visible=True)
    ax.legend()
    on_one_line(style.save(figure, HERE / "moes.svg"))


def style_colours() -> tuple[str, str, str]:
    """Give three colours that everybody tells apart."""
    return style.BLUE, style.VERMILLION, style.GREEN


@style.styled()
def regimes() -> None:
    """Friction and load share of solid contact over Lambda."""
    text = MIXED.read_text(encoding="utf-8")
    rows = list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))
    speed, friction, share = (
        np.array([float(row[name]) for row in rows])
        for name in ("contact.mean_velocity", "mu", "contact_load_share")
    )
    figure = style.new_figure(style.COLUMN, HEIGHT)
    ax = figure.subplots()
    ax.semilogx(speed, friction, "o-", color=style.BLUE)
    style.label_log_ticks(ax.xaxis)
    ax.set(xlabel=r"mean velocity $\bar u$ [m/s]", ylim=(0.0, None))
    style.y_label(ax, r"coefficient of friction $\mu$", style.BLUE)
    twin = ax.twinx()
    twin.plot(speed, share, "s--", color=style.VERMILLION)
    twin.set_ylim(0.0, 1.0)
    style.y_label(twin, "load share of solid contact", style.VERMILLION)
    on_one_line(style.save(figure, HERE / "regimes.svg"))


if __name__ == "__main__":
    lines()
    moes()
    regimes()
