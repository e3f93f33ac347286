# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of the page, and the updates of their data."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from bokeh.models import (
    BasicTicker,
    ColorBar,
    ColumnDataSource,
    Div,
    HoverTool,
    LinearAxis,
    LinearColorMapper,
    Range1d,
    Whisker,
)
from bokeh.palettes import PuOr11, Viridis256
from bokeh.plotting import figure

from pyehl.app import drawing
from pyehl.app.answers import CurvePoint, Film, Rough
from pyehl.app.changes import Changes
from pyehl.plots.style import BLUE, GREEN, GREY, VERMILLION
from pyehl.types import Array

SIDE = 310
WHITE = "#ffffff"
TICKS = 5
"""Desired number of ticks: more would overlap in panels of this width."""
HINTS = {
    "rough_hint": "The surface is smooth, or its prediction is not ready.",
    "curve_hint": "A button computes nine points, which takes several seconds.",
}
"""Texts in place of pictures without data."""


def _figure(title: str, x: str, y: str, **more: Any) -> Any:  # noqa: ANN401 (Bokeh has no types)
    words: dict[str, Any] = {
        "width": SIDE,
        "height": SIDE,
        "tools": "save,reset,wheel_zoom,pan",
        **more,
    }
    made = figure(title=title, x_axis_label=x, y_axis_label=y, **words)
    made.toolbar.autohide = True
    made.title.update(text_font_size="9pt", text_font_style="normal")
    if "x_axis_type" not in words:
        made.xaxis.ticker = BasicTicker(desired_num_ticks=TICKS)
    return made


def _map(title: str, **more: Any) -> Any:  # noqa: ANN401
    ranges = {"x_range": Range1d(-1, 1), "y_range": Range1d(-1, 1)}
    return _figure(title, "x [mm]", "y [mm]", match_aspect=True, **ranges, **more)


class Pictures:
    """Figures and their data sources."""

    def __init__(self) -> None:
        self.changes = Changes()
        empty: dict[str, list[float]] = {"x": [], "y": [], "dw": [], "dh": []}
        self.film = ColumnDataSource({"colours": [], "film": [], **empty})
        self.contours = ColumnDataSource({"x": [], "y": []})
        self.edge = ColumnDataSource({"x": [], "y": []})
        columns: dict[str, list[float]] = {"place": [], "pressure": [], "hertz": [], "film": []}
        self.lines = {name: ColumnDataSource(columns) for name in "xy"}
        self.tiles = ColumnDataSource({"before": [], "after": [], **empty}, name="tiles")
        self.octaves = ColumnDataSource({"left": [], "right": [], "increase": []})
        self.passage = ColumnDataSource({"shift": [], "ratio": []})
        names = ("place", "value", "low", "high", "status")
        self.curve = {
            name: ColumnDataSource({n: [] for n in names}, name=f"curve of {name}")
            for name in ("film", "ratio")
        }
        self.levels = LinearColorMapper(palette=Viridis256, high_color=WHITE)
        self.heights = LinearColorMapper(palette=PuOr11)
        self.fringes, self.contour = self._film_maps()
        self.along, self.across = (self._line(name) for name in "xy")
        self.before, self.after = self._tile_maps()
        self.bands, self.over = self._friction()
        self.curves = [self._curve("film", "h_c [nm]"), self._curve("ratio", "μ_r/μ_s")]
        self.hints = {name: Div(text=text, width=2 * SIDE + 60) for name, text in HINTS.items()}
        for picture in (*self._rough(), *self.curves):
            picture.visible = False

    @property
    def figures(self) -> dict[str, Any]:
        """All figures by name."""
        names = ("fringes", "contour", "along", "across", "before", "after", "bands", "over")
        film, ratio = self.curves
        result = {n: getattr(self, n) for n in names} | self.hints
        return {**result, "curve_film": film, "curve_ratio": ratio}

    def _rough(self) -> tuple[Any, ...]:
        """Give the pictures of a prediction."""
        return self.before, self.after, self.bands, self.over

    def _reveal(self, hint: str, pictures: Sequence[Any], *, known: bool) -> None:
        """Show pictures, or a hint in their place."""
        for picture in pictures:
            self.changes.of(picture, visible=known)
        self.changes.of(self.hints[hint], visible=not known)

    def _film_maps(self) -> tuple[Any, Any]:
        place = {"x": "x", "y": "y", "dw": "dw", "dh": "dh"}
        fringes = _map("film as fringes")
        fringes.xaxis[0].axis_label = "x [mm], motion →"
        fringes.image_rgba("colours", source=self.film, **place)
        contour = _figure(
            "film h [nm]", "x [mm]", "y [mm]", match_aspect=True, width=SIDE + 60,
            x_range=fringes.x_range, y_range=fringes.y_range,
        )  # fmt: skip
        image = contour.image("film", source=self.film, color_mapper=self.levels, **place)
        contour.line("x", "y", source=self.contours, line_color="black", line_alpha=0.5)
        words = [("x, y [mm]", "$x, $y"), ("h [nm]", "@film")]
        contour.add_tools(HoverTool(tooltips=words, renderers=[image]))
        contour.add_layout(ColorBar(color_mapper=self.levels, width=10), "right")
        for picture in (fringes, contour):
            picture.line("x", "y", source=self.edge, color=VERMILLION, line_dash="dashed")
        return fringes, contour

    def _line(self, name: str) -> Any:  # noqa: ANN401
        """Pressure and film on a line through the centre."""
        title = "along the motion" if name == "x" else "across the motion"
        made = _figure(
            title, f"{name} [mm]", "p [GPa]", height=260, width=SIDE + 30,
            x_range=Range1d(-1, 1), y_range=Range1d(0, 1),
        )  # fmt: skip
        made.extra_y_ranges = {"film": Range1d(0, 1)}
        made.add_layout(LinearAxis(y_range_name="film", axis_label="h [nm]"), "right")
        source = self.lines[name]
        made.line("place", "hertz", source=source, color=GREY, line_dash="dashed")
        made.line("place", "pressure", source=source, color=BLUE, line_width=2)
        made.line(
            "place", "film", source=source, color=VERMILLION, line_width=2, y_range_name="film"
        )
        made.yaxis[0].axis_label_text_color = BLUE
        made.yaxis[1].axis_label_text_color = VERMILLION
        return made

    def _tile_maps(self) -> tuple[Any, Any]:
        """Roughness before and in the contact, on one scale."""
        result: list[Any] = []
        for name, title in (("before", "surface [nm]"), ("after", "in the contact [nm]")):
            made = _map(title, width=SIDE + (60 if result else 0))
            place = {"x": "x", "y": "y", "dw": "dw", "dh": "dh"}
            made.image(name, source=self.tiles, color_mapper=self.heights, **place)
            result.append(made)
        result[1].add_layout(ColorBar(color_mapper=self.heights, width=10), "right")
        return result[0], result[1]

    def _friction(self) -> tuple[Any, Any]:
        """Draw the contributions of octaves, and the ratio over the passage."""
        bands = _figure(
            "contributions of octaves of wavelengths", "wavelength [µm]", "increase of μ_r/μ_s",
            x_axis_type="log", height=260, x_range=Range1d(1, 1000), y_range=Range1d(0, 1),
        )  # fmt: skip
        bands.quad(
            left="left", right="right", top="increase", bottom=0.0, source=self.octaves,
            fill_color=GREEN, line_color="white",
        )  # fmt: skip
        over = _figure(
            "over the passage", "displacement [mm]", "μ_r/μ_s", height=260,
            x_range=Range1d(0, 1), y_range=Range1d(0, 2),
        )  # fmt: skip
        over.line("shift", "ratio", source=self.passage, color=BLUE, line_width=2)
        return bands, over

    def _curve(self, name: str, label: str) -> Any:  # noqa: ANN401
        ranges = {"x_range": Range1d(0, 1), "y_range": Range1d(0, 1)}
        made = _figure("curve", "", label, width=SIDE + 60, **ranges)
        source = self.curve[name]
        made.line("place", "value", source=source, color=BLUE)
        made.scatter("place", "value", source=source, color=BLUE, size=6)
        made.add_layout(Whisker(base="place", lower="low", upper="high", source=source))
        made.add_tools(HoverTool(tooltips=[("value", "@value"), ("status", "@status")]))
        return made

    def show_film(self, result: Film) -> None:
        """Show a solution, or empty figures if there is none."""
        if not result.converged:
            self._empty(self.film, self.contours, self.edge, *self.lines.values())
            self.changes.send()
            return
        change = self.changes.of
        made = drawing.film_map(result)
        lowest = float(made.film.min())
        change(self.levels, low=lowest, high=drawing.MAX_FILM * made.central)
        film = {"colours": [made.colours], "film": [made.film.astype(np.float32)]}
        box = {"x": [made.left], "y": [made.bottom], "dw": [made.width], "dh": [made.height]}
        change(self.film, data={**film, **box})
        for source, (x, y) in (
            (self.contours, drawing.contour_lines(made)),
            (self.edge, drawing.outline(result)),
        ):
            change(source, data={"x": x, "y": y})
        highest = result.point.hertz_pressure * 1e-9
        change(self.fringes.title, text=made.caption)
        self._fit(self.fringes, made)
        for name, line in drawing.centre_lines(result).items():
            change(self.lines[name], data=line)
            picture = self.along if name == "x" else self.across
            change(picture.extra_y_ranges["film"], end=5.0 * made.central)
            place = line["place"]
            change(picture.x_range, start=float(place[0]), end=float(place[-1]))
            change(picture.y_range, end=1.08 * max(float(line["pressure"].max()), highest))
        self.changes.send()

    def show_rough(self, result: Rough) -> None:
        """Show a prediction, or hide its figures if there is none."""
        made = result.prediction
        self._reveal("rough_hint", self._rough(), known=made is not None)
        if made is None:
            self._empty(self.tiles, self.octaves, self.passage)
            self.changes.send()
            return
        change = self.changes.of
        before, after, width, height, top = drawing.tiles(made)
        change(self.heights, low=-top, high=top)
        tiles = {"before": [before.astype(np.float32)], "after": [after.astype(np.float32)]}
        place = {"x": [0.0], "y": [0.0], "dw": [width], "dh": [height]}
        change(self.tiles, data={**tiles, **place})
        for picture in (self.before, self.after):
            change(picture.x_range, start=0.0, end=width)
            change(picture.y_range, start=0.0, end=height)
        octaves = drawing.octaves(made)
        change(self.octaves, data=octaves)
        if octaves["increase"]:
            change(self.bands.x_range, start=min(octaves["left"]), end=max(octaves["right"]))
            self._around(self.bands, [0.0, *octaves["increase"]])
        self._empty(self.passage)
        if math.isfinite(made.mu_ratio):
            shift, ratio = made.friction.shift * 1e3, made.friction.passage
            change(self.passage, data={"shift": shift, "ratio": ratio})
            change(self.over.x_range, end=width)
            self._around(self.over, made.friction.passage)
        self.changes.send()

    def show_curve(
        self, points: Sequence[CurvePoint], places: Sequence[float], over: str, about: str
    ) -> None:
        """Show the finished points of a curve, with axes for all of its places."""
        change = self.changes.of
        self._reveal("curve_hint", self.curves, known=True)
        for picture, name in zip(self.curves, ("film", "ratio"), strict=True):
            change(picture.xaxis[0], axis_label=over)
            change(picture.title, text=about)
            result = _columns(points, name)
            change(self.curve[name], data=result)
            change(picture.x_range, start=0.0, end=1.05 * float(max(places)))
            known = np.nan_to_num(np.concatenate([result["low"], result["high"], result["value"]]))
            self._around(picture, [0.0, *known])
        self.changes.send()

    def _empty(self, *sources: ColumnDataSource) -> None:
        for source in sources:
            self.changes.of(source, data={name: [] for name in source.data})

    def _fit(self, picture: Any, made: drawing.Map) -> None:  # noqa: ANN401
        side = max(made.width, made.height)
        x, y = made.left + 0.5 * made.width, made.bottom + 0.5 * made.height
        self.changes.of(picture.x_range, start=x - 0.5 * side, end=x + 0.5 * side)
        self.changes.of(picture.y_range, start=y - 0.5 * side, end=y + 0.5 * side)

    def _around(
        self,
        picture: Any,  # noqa: ANN401
        values: Sequence[float] | Array,
    ) -> None:
        """Set the y axis to the range of values, with a margin."""
        low, high = float(min(values)), float(max(values))
        room = 0.05 * (high - low) or 1.0
        start = low - (room if low else 0.0)
        self.changes.of(picture.y_range, start=start, end=high + room)


def _columns(points: Sequence[CurvePoint], name: str) -> Mapping[str, Any]:
    """Give places, values and ends of the error bars of a curve."""
    if name == "film":
        value = np.array([p.h_c * 1e9 for p in points])
        error = np.array([p.h_c_error * 1e9 for p in points])
    else:
        value = np.array([p.mu_ratio for p in points])
        error = np.array([p.mu_ratio_error for p in points])
    return {
        "place": np.array([p.place for p in points]),
        "value": value,
        "low": value - error,
        "high": value + error,
        "status": [p.status for p in points],
    }
