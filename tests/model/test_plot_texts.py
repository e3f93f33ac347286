# SPDX-License-Identifier: BSD-3-Clause
"""Texts in pictures: readable, inside, and without overlap."""

import itertools

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from apart import assert_apart
from matplotlib.transforms import Bbox

from pyehl import Case, namelist
from pyehl.plots import (
    figures,
    lubricant,
    panels,
    stribeck,
    study,
    style,
    surface,
)
from pyehl.prediction.predict import predict
from pyehl.surfaces import Topography
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.transition import Curve

pytestmark = pytest.mark.usefixtures("no_open_figures")


def clear(ax):
    """Whether the numbers below axes do not overlap, and there are some."""
    low, high = ax.get_xlim()
    boxes = sorted(
        (box.x0, box.x1)
        for label in (*ax.get_xticklabels(), *ax.get_xticklabels(minor=True))
        if label.get_text() and low <= label.get_position()[0] <= high
        for box in [label.get_window_extent()]
    )
    return boxes and all(one[1] < other[0] for one, other in itertools.pairwise(boxes))


@style.styled()
@pytest.mark.parametrize("count", [1, 2, 3, 5, 8])
def test_wavelengths_of_few_octaves_are_readable(count):
    figure = panels.panels(2, (1.0, 0.8), "octaves", room=(0.7, 0.9, 0.1))
    ax = figure.axes[1]
    surface.octaves([(1.2e-4 / 2**k, 0.6e-4 / 2**k, 0.01) for k in range(count)], ax=ax)
    figure.set_dpi(100)
    figure.draw_without_rendering()
    assert clear(ax)


@style.styled()
@pytest.mark.parametrize("sides", [(8.0, 1.0), (1.0, 8.0), (1.0, 1.0)])
def test_slender_maps_are_readable(sides):
    heights = np.random.default_rng(1).normal(scale=1e-8, size=(24, 24))
    tile = Topography(heights, tuple(3.6e-4 * side for side in sides))
    figure = panels.panels(3, (1.0, 0.9), "tile", room=(0.55, 1.3, 0.65))
    surface.heights(tile, ax=figure.axes[0])
    surface.spectrum_map(tile, ax=figure.axes[1])
    surface.spectrum_line(tile, heights, heights, ax=figure.axes[2])
    figure.set_dpi(100)
    figure.draw_without_rendering()
    assert all(clear(ax) for ax in figure.axes[:3])


KAPPAS = [0.1, 0.3, 0.45, 1.0, 2.0, 3.0, 6.0, 10.0, 25.0]


@pytest.mark.parametrize(
    ("kappa", "units"),
    [
        pytest.param(
            *(kappa, units),
            marks=[] if (kappa, units) in ((0.1, "si"), (25.0, "hertz")) else [pytest.mark.long],
        )
        for units in ("si", "hertz")
        for kappa in KAPPAS
    ],
)
def test_no_texts_of_a_solution_collide(kappa, units):
    """Pictures of smooth and rough contacts that are narrow, round and wide."""
    x = np.linspace(-2.5, 1.5, 65) * max(1.0, 0.3 / kappa)
    y = np.linspace(-1.6, 1.6, 65) * max(1.0, kappa)
    inside = np.maximum(0.0, 1.0 - x[:, None] ** 2 - (y[None, :] / kappa) ** 2)
    film = 0.03 + 0.5 * np.maximum(0.0, x[:, None] ** 2 + (y[None, :] / kappa) ** 2 - 1.0)
    waves = 0.004 * np.cos(6.0 * x)[:, None] * np.cos(6.0 * y / kappa)
    time = np.linspace(0.0, 4.0, 50)
    fields = {"P": np.sqrt(inside), "H": film + waves, "RR": 2.0 * waves, "A_d": -waves}
    fields |= {"P_smooth": np.sqrt(inside), "H_smooth": film}
    data = xr.Dataset(
        {name: (("X", "Y"), values) for name, values in fields.items()}
        | {f"history_{n}": ("history", v) for n, v in (("T", time), ("mu_ratio", 1 + 0.1 * time))}
        | {f"history_{n}": ("history", 1 + 0.1 * time) for n in ("P_max", "H_min", "H_c")}
        | {"ellipticity": kappa, "H_c": 0.03, "H_min": 0.02, "P_rise_max": 0.1, "T_mean": 1.0}
        | {"mu_ratio": 1.2, "moes_m": 1e3, "moes_l": 10.0, "hertz_pressure_Pa": 1.66e9},
        {"X": x, "Y": y},
        {"status": "converged", "case": namelist.text_of(Case().resolve())},
    )
    made = figures.solution_figures(data, units)
    assert len(made) == 6
    for name, figure in made.items():
        assert_apart(figure, name)


@pytest.mark.long
@pytest.mark.parametrize("kappa", [0.1, 1.0, 10.0])
def test_no_texts_of_a_rough_surface_collide(kappa):
    """The roughness in a contact, its spectrum and the contributions of octaves."""
    heights = np.random.default_rng(1).normal(scale=1e-8, size=(48, 48))
    about = {"moes_m": 1e3, "moes_l": 10.0, "hertz_pressure_Pa": 1.66e9, "status": "predicted"}
    about |= {"hertz_radius_m": 2e-4, "ellipticity": kappa, "length_x_m": 8e-4, "length_y_m": 8e-4}
    about |= {"film_scale_m": 1e-5, "surface": "fractal"}
    arrays = {"surface": heights, "deformed": 0.3 * heights, "delta_p": 1e16 * heights}
    shift = np.linspace(0.0, 7.9e-4, 64)
    bands = {"longest_m": [8e-4, 4e-4], "shortest_m": [4e-4, 2e-4], "increase": [-2e-4, 3e-4]}
    tables = {
        "passage": {"shift_m": shift, "mu_ratio": 1.0 + 0.01 * np.sin(1e4 * shift)},
        "bands": {name: np.array(values) for name, values in bands.items()},
    }
    for name, figure in figures.prediction_figures(about, arrays, tables).items():
        assert_apart(figure, name)


@pytest.mark.long
@pytest.mark.parametrize(
    ("key", "count", "contact"),
    [
        ("contact.mean_velocity", 1, True),
        ("contact.mean_velocity", 3, False),
        ("lubricant.temperature", 1, False),
        ("lubricant.temperature", 3, True),
    ],
)
def test_no_texts_of_a_curve_collide(key, count, contact):
    """Stribeck and traction curves with all that can be drawn over them."""
    places = np.array([0.02, 0.1, 0.5, 2.0, 10.0]) * (10.0 if "temp" in key else 1.0)
    names = "mu mu_ratio mu_smooth mu_isothermal mu_empirical mu_ratio_spread mu_ratio_model_error"
    columns = dict.fromkeys(f"{names} mu_ratio_ehl mu_ratio_ehl_error theta_2".split(), 1.0)
    columns |= {"lambda_ratio": 2.0 * places**0.7, "temperature_rise_max_K": 10.0 * places}
    columns |= {"contact_load_share": 0.5 if contact else None, "contact_load_share_ehl": None}
    extra = ("contact_load_share_error", "contact_area_share", "contact_area_share_ehl")
    columns |= dict.fromkeys((*extra, "contact_load_share_ehl_error"), 0.1)
    columns |= dict.fromkeys(("h_min_rough_m", "h_min_rough_error_m", "h_min_rough_ehl_m"), 1e-8)
    statuses = ["film breakdown", *["full film"] * 4]
    table = pd.DataFrame({key: places, "status": statuses} | columns)
    labels = [""] if count == 1 else [f"contact.slide_to_roll = 0.{k}" for k in range(count)]
    for absolute in (True, False):
        curves = [Curve(label, key, table, absolute) for label in labels]
        measured = stribeck.Points({key: places}, 0.9 + 0.0 * places, 0.05 + 0.0 * places)
        assert_apart(stribeck.draw_stribeck(curves, "ball", measured), (key, count, absolute))
    slip = table.rename(columns={key: "contact.slide_to_roll"})
    curves = [Curve(label, "contact.slide_to_roll", slip, absolute=True) for label in labels]
    assert_apart(stribeck.draw_traction(curves, "ball"), "traction")


def test_no_texts_of_lubricants_and_studies_collide():
    oil = Lubricant()
    assert_apart(lubricant.draw_oil("oil", oil, (0.0, 100.0, 1e9), 0.05), "oil")
    line = np.linspace(0.0, 1.0, 5)
    assert_apart(lubricant.draw_fit(line, line, 0.1 * line, (line, line), "fitted"), "fit")
    lines = [study.Line(f"contact.load = {k}00", line + 0.1, 1e-7 * line, line) for k in range(4)]
    for count in (1, 3):
        figure = study.study_figure([("h_c [m]", lines)] * count, "load [N]", "first case")
        assert_apart(figure, count)


def test_headline():
    about = {"moes_m": 1000.0, "moes_l": 10.0, "hertz_pressure_Pa": 1.66e9, "status": "converged"}
    title = panels.headline(about | {"H_c": 0.0243, "H_min": 0.008})
    for part in ("M = 1000", "L = 10", "1.66 GPa", "= 0.0243", "= 0.008"):
        assert part in title
    title = panels.headline(
        about | {"H_c": 0.0243, "h_c_m": 2.3e-7, "h_min_m": 8e-8}, style.Scales(1.0, 1.0, 1.0)
    )
    assert "central film 230 nm" in title
    assert "minimum film 80 nm" in title
    assert "FILM" in panels.headline(about | {"status": "negative film"})


@pytest.mark.parametrize(
    ("rms", "length", "reduction"),
    [
        (5e-8, 8e-4, "response"),
        (1e-9, 6e-5, "response"),
        (1e-9, 5e-3, "response"),
        (2e-11, 8e-4, "response"),
        (5e-8, 8e-4, "amplitude"),
    ],
)
@pytest.mark.long
def test_labels_in_pictures_of_a_prediction_are_inside(settings, rms, length, reduction):
    """Every panel with its labels is inside the picture, and no panels overlap."""
    settings["surface"] |= {"rms_height": rms, "length_x": length, "length_y": length, "pixels": 64}
    settings["psd"] |= {"reduction": reduction}
    result = predict(settings)
    made = figures.prediction_figures(result.summary, result.arrays, result.tables)
    assert len(made) == 3
    for figure in made.values():
        figure.draw_without_rendering()
        assert "M = " in figure.get_label()
        panels = [ax for ax in figure.axes if ax.get_subplotspec() is not None]
        boxes = {}
        for ax in panels:
            place = ax.get_subplotspec().num1
            boxes.setdefault(place, []).append(ax.get_tightbbox())
        boxes = [Bbox.union(parts) for _, parts in sorted(boxes.items())]
        texts = [text.get_window_extent() for text in figure.texts]
        for box in [*boxes, *texts]:
            assert figure.bbox.x0 <= box.x0
            assert box.x1 <= figure.bbox.x1
            assert figure.bbox.y0 <= box.y0
            assert box.y1 <= figure.bbox.y1
        for k, box in enumerate(boxes):
            assert not any(box.overlaps(other) for other in [*boxes[k + 1 :], *texts])
