# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of known fields."""

import dataclasses
import itertools
import json
import struct

import numpy as np
import pandas as pd
import pytest
import reference
import xarray as xr
from apart import assert_apart
from matplotlib import pyplot
from matplotlib.image import imread
from matplotlib.transforms import Bbox

from pyehl import Case, cli, namelist
from pyehl.plots import (
    contact,
    figures,
    folder,
    lubricant,
    panels,
    stribeck,
    study,
    style,
    surface,
    transient,
)
from pyehl.prediction.predict import predict
from pyehl.prediction.result import destination, draw, write
from pyehl.surfaces import Topography
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.transition import Curve


@pytest.fixture(scope="module")
def fields():
    """A dry contact lifted by a central film, on an even grid of the usual domain."""
    x, y = np.linspace(-2.5, 1.5, 129), np.linspace(-2.0, 2.0, 129)
    grid = np.meshgrid(x, y, indexing="ij")
    pressure = reference.hertz_pressure(*grid)
    gap = grid[0] ** 2 / 2 + grid[1] ** 2 / 2 - 1 + reference.hertz_deflection(*grid)
    return x, y, pressure, 0.0243 + gap


@pytest.fixture
def scales():
    point = OperatingPoint()
    return style.Scales(point.hertz_radius, point.hertz_pressure, point.film_scale)


def curves(ax):
    return {line.get_label(): line.get_xydata() for line in ax.get_lines()}


def test_pressure_and_film_in_hertz_units(fields):
    x, y, pressure, film = fields
    ax = contact.pressure_and_film(x, pressure[:, 64], film[:, 64])
    drawn = curves(ax)
    assert drawn["Hertz"][:, 1].max() == 1.0
    assert drawn["pressure"][:, 0] == pytest.approx(x)
    assert drawn["pressure"][:, 1] == pytest.approx(pressure[:, 64])
    assert "p/p_h" in ax.get_ylabel()
    across = contact.pressure_and_film(y, pressure[80, :], film[80, :], name="y")
    assert curves(across)["pressure"][:, 0] == pytest.approx(y)
    assert "y/a" in across.get_xlabel()


def test_pressure_and_film_in_si(fields, scales):
    x, _, pressure, film = fields
    ax = contact.pressure_and_film(x, pressure[:, 64], film[:, 64], scales)
    assert curves(ax)["Hertz"][:, 1].max() == pytest.approx(1.6602, rel=1e-4)
    assert "GPa" in ax.get_ylabel()
    (twin,) = (other for other in ax.figure.axes if other is not ax)
    film_line = curves(twin)["film"]
    assert np.interp(0.0, *film_line.T) == pytest.approx(0.0243 * scales.film * 1e6, rel=1e-3)


def test_a_very_fine_tile_is_drawn_in_part():
    """A picture of 20 000 x 20 000 pixels in the contact shows a part, and states so."""
    tile = Topography(np.random.default_rng(1).normal(0.0, 1e-9, (64, 48)), (6.4e-7, 4.8e-7))
    ax = surface.roughness(tile, tile.heights, 1e-4, name="(a) undeformed,")
    (image,) = ax.get_images()
    assert max(image.get_array().shape) <= surface.PLACES
    assert min(image.get_array().shape) > surface.PLACES / 2
    left, right, _, _ = image.get_extent()
    assert right == pytest.approx(0.1, abs=2e-4)
    assert left == pytest.approx(-0.1, abs=2e-4)
    assert "one of 289 pixels" in ax.get_title(loc="left")
    shown = float(np.nanstd(image.get_array().filled(np.nan)))
    assert shown == pytest.approx(1e9 * tile.rms_height, rel=1e-3)
    few = surface.roughness(tile, tile.heights, 1e-6, name="(a)")
    assert "one of" not in few.get_title(loc="left")
    assert surface.heights(tile).get_xlabel() == "x [nm]"


@pytest.mark.parametrize("si", [True, False])
def test_interferogram(fields, scales, si):
    x, y, _, film = fields
    ax = contact.interferogram(x, y, film, scales if si else None)
    image = ax.get_images()[0].get_array()
    assert image.shape[2] == 3
    assert 0.0 <= image.min()
    assert image.max() <= 1.0
    # the centre by two-beam interference, in red and in green
    h = 0.0243 * (scales.film * 1e6 if si else 1.0)
    spacings = (0.633 / 3.0, 0.532 / 3.0) if si else (0.9 * h, 0.9 * h * 532 / 633)
    middle = image[image.shape[0] // 2, image.shape[1] // 2]
    for channel, step in enumerate(spacings):
        fade = np.exp(-((h / (contact.COHERENT_FRINGES * step)) ** 2))
        expected = 0.5 * (1 - fade * np.cos(2 * np.pi * h / step))
        assert middle[channel] == pytest.approx(expected, abs=0.02)
    # the centre is not dark, and differs from that of a film a third as thick
    thin = contact.fringe_colours(np.array(h / 3), *spacings)
    assert middle.max() > 0.5
    assert np.abs(middle - thin).max() > 0.3
    # the scale has the colours of the map
    (bar,) = (other for other in ax.child_axes)
    assert bar.get_ylim() == pytest.approx((0.0, 1.6 * h), rel=0.02)
    assert bar.get_ylabel() == ("h [µm]" if si else "H = hR/a²")


def test_fringe_spacing_follows_the_film(scales):
    for central in (0.02, 5.0):
        red, green = contact.fringe_spacings(central, scales)
        assert red == pytest.approx(0.9 * central)
        assert green < red
    # the same light for thin films, with their unit
    thin = dataclasses.replace(scales, thin=True)
    assert contact.fringe_spacings(200.0, thin) == pytest.approx((633.0 / 3.0, 532.0 / 3.0))


def test_contours(fields, scales):
    x, y, _, film = fields
    ax = contact.contours(x, y, film, scales)
    assert ax.get_aspect() == 1.0
    for function in (contact.contours, contact.interferogram):
        with pytest.raises(ValueError, match="no map"):
            function(x, y, 0.0 * film, scales)


def test_every_function_takes_axes_and_returns_them(fields, settings):
    x, y, pressure, film = fields
    p = predict(settings)
    tile, deformed = p.surface, p.friction.response.deformed
    line = np.linspace(1.0, 2.0, 8)
    calls = [
        lambda ax: contact.pressure_and_film(x, pressure[:, 64], film[:, 64], ax=ax),
        lambda ax: contact.interferogram(x, y, film, ax=ax),
        lambda ax: contact.contours(x, y, film, ax=ax),
        lambda ax: surface.heights(tile, ax=ax),
        lambda ax: surface.spectrum_map(tile, ax=ax),
        lambda ax: surface.spectrum_line(tile, deformed, tile.heights - deformed, ax=ax),
        lambda ax: surface.roughness(tile, deformed, 4.154e-4, ax=ax),
        lambda ax: surface.passage(line * 1e-4, line, 8e-4, ax=ax),
        lambda ax: surface.octaves([(1e-4, 5e-5, 0.1)], ax=ax),
        lambda ax: transient.friction_history(line, line, ax=ax),
        lambda ax: transient.roughness(x, y, pressure, ax=ax),
        lambda ax: transient.profiles(x, pressure[:, 64], pressure[:, 64], ax=ax),
    ]
    for call in calls:
        ax = style.new_figure(3.0, 3.0).subplots()
        assert call(ax) is ax
        assert ax.has_data()


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


def test_only_a_failed_run_has_its_status_in_the_title():
    for status, words in (("converged", ""), ("negative film", "negative film")):
        about = {"moes_m": 412.9, "moes_l": 10.73, "hertz_pressure_Pa": 0.997e9, "status": status}
        figure = panels.panels(2, (1.0, 0.8), panels.headline(about))
        assert figure.get_suptitle() == words
        assert "M = 412.9" in figure.get_label()


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
    x = kappa * 0.0 + np.linspace(-2.5, 1.5, 65) * max(1.0, 0.3 / kappa)
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


def test_heights_and_amplitude_ratio_of_each_wave(settings):
    """The model of the paper has a real ratio: deformed and flattened parts add up to one."""
    result = predict(settings)
    rough, deformed = result.surface, result.friction.response.deformed
    ax = surface.spectrum_line(rough, deformed, rough.heights - deformed)
    (twin,) = (other for other in ax.figure.axes if other is not ax)
    stays, flattened = (curves(twin)[name][:, 1] for name in ("|T|", "|1 − T|"))
    assert np.all(np.diff(stays) > 0.0)
    # of an annulus both are rms values, whose sum is one or a little more
    assert np.all(stays + flattened >= 1.0)
    assert np.all(stays + flattened < 1.03)
    ax = surface.heights(result.surface)
    assert ax.get_images()[0].get_array().max() == pytest.approx(result.surface.heights.max() * 1e9)


def test_roughness_shares_one_scale(settings):
    result = predict(settings)
    tile, deformed = result.surface, result.friction.response.deformed
    radius = result.operating.hertz_radius
    left, right = (
        surface.roughness(tile, field, radius).get_images()[0] for field in (tile.heights, deformed)
    )
    assert left.get_clim() == right.get_clim()
    assert left.get_clim()[0] == -left.get_clim()[1]
    # the first pixel of the tile is at the centre
    shown = right.get_array()
    centre = (shown.shape[0] // 2, shown.shape[1] // 2)
    assert shown[centre] == pytest.approx(deformed[0, 0] * 1e9)
    # rows of the picture are y
    assert shown[centre[0] + 3, centre[1]] == pytest.approx(deformed[0, 3] * 1e9)


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


def test_passage_closes():
    shift = np.arange(8) * 1e-4
    ratio = 1.2 + 0.1 * np.cos(2 * np.pi * shift / 8e-4)
    line = surface.passage(shift, ratio, 8e-4).get_lines()[0].get_xydata()
    assert line[0, 1] == pytest.approx(line[-1, 1])
    assert line[:, 1] == pytest.approx(1.2 + 0.1 * np.cos(2 * np.pi * line[:, 0] / 0.8), abs=1e-9)


@pytest.fixture(autouse=True)
def no_open_figures():
    yield
    pyplot.close("all")


def test_files_of_all_formats(fields, tmp_path):
    x, _, pressure, film = fields
    figure = style.new_figure(7.2, 3.3)
    contact.pressure_and_film(x, pressure[:, 64], film[:, 64], ax=figure.subplots())
    path = style.save(figure, tmp_path / "a.png")
    data = path.read_bytes()
    width, height = struct.unpack(">II", data[16:24])
    assert (width, height) == (1440, 660)
    for suffix, magic in (("pdf", b"%PDF"), ("svg", b"<?xml")):
        (path,) = folder.save_all({"b": figure}, tmp_path, suffix)
        assert path.name == f"b.{suffix}"
        assert path.read_bytes().startswith(magic)


def run_subcommand(where, output=None, *words):
    out = [] if output is None else ["-o", str(output)]
    return cli.main(["plot", str(where), *out, *words])


def test_subcommand_on_a_prediction(settings, tmp_path, capsys):
    write(predict(settings), destination(tmp_path / "out"))
    assert run_subcommand(tmp_path / "out", tmp_path / "png") == 0
    assert len(capsys.readouterr().out.split()) == 3
    assert imread(tmp_path / "png" / "roughness.png").std() > 0.1
    assert run_subcommand(tmp_path / "out", None, "--movie") == 2
    assert "no frames" in capsys.readouterr().err


def test_subcommand_at_other_resolutions_and_formats(settings, tmp_path, capsys):
    write(predict(settings), destination(tmp_path / "out"))
    assert run_subcommand(tmp_path / "out", None, "--dpi", "100") == 0
    data = (tmp_path / "out" / "roughness.png").read_bytes()
    assert struct.unpack(">II", data[16:24])[0] == round(100 * style.PAGE - 0.5)
    assert run_subcommand(tmp_path / "out", None, "--dpi", "1") == 2
    assert "dpi = 1:" in capsys.readouterr().err
    assert run_subcommand(tmp_path / "out", None, "--format", "svg") == 0
    assert (tmp_path / "out" / "roughness.svg").is_file()


def test_subcommand_on_a_prediction_that_failed(settings, tmp_path):
    settings["psd"]["film_thickness"] = 1e-8
    result = predict(settings)
    write(result, destination(tmp_path / "out"))
    draw(result, tmp_path / "out")
    assert run_subcommand(tmp_path / "out") == 0
    assert not (tmp_path / "out" / "passage.png").exists()


SUMMARY = {
    "status": "converged", "moes_m": 1000.0, "moes_l": 10.0, "hertz_pressure_Pa": 1.66e9,
    "H_c": 0.0243, "H_min": 0.008,
}  # fmt: skip


def test_subcommand_on_a_prediction_of_two_surfaces(tmp_path):
    tiles = ({"kind": "fractal", "pixels": 32, "seed": seed} for seed in (1, 2))
    case = Case(**dict(zip(("surface", "second_surface"), tiles, strict=True)))
    write(predict(case.resolve(), tracks=1), destination(tmp_path / "out"))
    assert run_subcommand(tmp_path / "out") == 0
    drawn = {p.name for p in (tmp_path / "out").glob("*.png")}
    assert drawn >= {"roughness.png", "second_roughness.png", "second_surface_spectrum.png"}


def test_octaves_without_a_contribution():
    ax = surface.octaves([(1e-4, 5e-5, np.nan)])
    assert [text.get_text() for text in ax.texts] == ["not known"]
    ax.figure.canvas.draw()


def test_negative_film_has_no_map(settings, fields, tmp_path):
    x, y, pressure, film = fields
    (tmp_path / "summary.json").write_text(json.dumps(SUMMARY | {"status": "negative film"}))
    (tmp_path / "case.nml").write_text(namelist.text_of(settings))
    for name, values in zip("XYPH", (x, y, pressure, film - 0.03), strict=True):
        np.save(tmp_path / f"{name}.npy", np.asfortranarray(values))
    assert run_subcommand(tmp_path) == 0
    assert {p.name for p in tmp_path.glob("*.png")} == {"centre_lines.png"}


def test_subcommand_on_a_run(settings, fields, tmp_path):
    (tmp_path / "summary.json").write_text(json.dumps(SUMMARY))
    (tmp_path / "case.nml").write_text(namelist.text_of(settings))
    for name, values in zip("XYPH", fields, strict=True):
        np.save(tmp_path / f"{name}.npy", np.asfortranarray(values))
    assert run_subcommand(tmp_path) == 0
    assert {p.name for p in tmp_path.glob("*.png")} == {"centre_lines.png", "film.png"}
    assert run_subcommand(tmp_path, None, "--units", "hertz") == 0


def test_subcommand_reports_missing_fields(settings, tmp_path, capsys):
    (tmp_path / "summary.json").write_text(json.dumps(SUMMARY))
    (tmp_path / "case.nml").write_text(namelist.text_of(settings))
    assert run_subcommand(tmp_path, tmp_path / "new") == 2
    assert "output.fields" in capsys.readouterr().err
    assert not (tmp_path / "new").exists()


def test_subcommand_without_a_result(tmp_path, capsys):
    assert run_subcommand(tmp_path) == 2
    assert "no summary.json" in capsys.readouterr().err
    (tmp_path / "summary.json").write_text("{}")
    assert run_subcommand(tmp_path) == 2
