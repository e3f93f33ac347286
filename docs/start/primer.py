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
from pyehl.theory.moes_film import nijenbanning_venner_moes, regime
from pyehl.theory.operating import OperatingPoint

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
        ax.loglog(m, film, color=colour, label=f"$L$ = {moes_l:g}")
    style.label_decades(ax.xaxis, ax.yaxis)
    ax.set(xlabel="$M$", ylabel=r"$H_\mathrm{c} = h_\mathrm{c}R/a^2$")
    ax.grid(visible=True)
    ax.legend()
    on_one_line(style.save(figure, HERE / "moes.svg"))


def style_colours() -> tuple[str, str, str]:
    """Give three colours that every reader can distinguish."""
    return style.BLUE, style.VERMILLION, style.GREEN


AREAS = {
    "rigid-isoviscous": ("rigid,\nisoviscous", (0.6, 3.0)),
    "elastic-isoviscous": ("elastic, isoviscous:\nrubber, water", (500.0, 0.85)),
    "rigid-piezoviscous": ("rigid,\npiezo-\nviscous", (11.0, 14.0)),
    "rigid to elastic-piezoviscous": ("between:\nsteel and oil", (500.0, 13.0)),
    "elastic-piezoviscous": ("elastic,\npiezo-\nviscous", (9e3, 2.4)),
}
"""Regimes, their names in the picture and the positions of the names (M, L)."""
SHADES = ("#DCE9F5", "#FBE3D3", "#D9F0E7", "#FFFFFF", "#F6E9F1")


@style.styled()
def regimes() -> None:
    """Regimes over M and L, and the contact of the case among them."""
    m, ell = np.geomspace(0.1, 3e4, 401), np.geomspace(0.5, 25.0, 281)
    names = np.array([[regime(x, y) for x in m] for y in ell])
    figure = style.new_figure(style.COLUMN, HEIGHT)
    ax = figure.subplots()
    for (name, (text, place)), shade in zip(AREAS.items(), SHADES, strict=True):
        inside = (names == name).astype(float)
        ax.contourf(m, ell, inside, levels=[0.5, 1.5], colors=[shade])
        ax.text(*place, text, ha="center", va="center")
    point = OperatingPoint.from_settings(pyehl.Case.read(CASE).resolve())
    ax.plot(point.moes_m, point.moes_l, "o", color=style.VERMILLION, ms=4)
    ax.annotate(
        CASE.name, (point.moes_m, point.moes_l), (0, -6), textcoords="offset points",
        ha="center", va="top", color=style.VERMILLION,
    )  # fmt: skip
    ax.set(xscale="log", yscale="log", xlabel="$M$", ylabel="$L$")
    style.label_decades(ax.xaxis)
    style.label_log_ticks(ax.yaxis)
    on_one_line(style.save(figure, HERE / "regimes.svg"))


@style.styled()
def stribeck() -> None:
    """Friction and load share of solid contact over the speed, with Lambda."""
    text = MIXED.read_text(encoding="utf-8")
    rows = list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))
    speed, friction, share, ratio = (
        np.array([float(row[name]) for row in rows])
        for name in ("contact.mean_velocity", "mu", "contact_load_share", "lambda_ratio")
    )
    figure = style.new_figure(style.COLUMN, 1.1 * HEIGHT)
    ax = figure.subplots()
    ax.semilogx(speed, friction, "o-", color=style.BLUE)
    style.label_log_ticks(ax.xaxis)
    ax.set(xlabel=r"mean velocity $\bar u$ [m/s]", ylim=(0.0, 0.1))
    style.y_label(ax, r"coefficient of friction $\mu$", style.BLUE)
    twin = ax.twinx()
    twin.plot(speed, share, "s--", color=style.VERMILLION)
    twin.set_ylim(0.0, 1.0)
    style.y_label(twin, "load share of solid contact", style.VERMILLION)
    # the share falls below 1 % where the surfaces separate
    parted = float(np.exp(np.interp(-0.01, -share, np.log(speed))))
    ax.axvline(parted, color=style.GREY, lw=0.8, ls=":")
    for place, word in ((0.06, "mixed"), (0.25, "full film")):
        ax.text(place, 0.092, word, ha="center", va="center")
    above = ax.secondary_xaxis("top")
    marks = [value for value in (0.7, 1.0, 2.0, 3.0) if ratio.min() <= value <= ratio.max()]
    above.set_xticks(np.exp(np.interp(marks, ratio, np.log(speed))), [f"{v:g}" for v in marks])
    above.set_xticks([], minor=True)
    above.set_xlabel(r"$\Lambda = h_\mathrm{min}/\sigma$")
    on_one_line(style.save(figure, HERE / "stribeck.svg"))


if __name__ == "__main__":
    lines()
    moes()
    regimes()
    stribeck()
