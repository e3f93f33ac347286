# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of known fields."""

import dataclasses
import json
import struct

import numpy as np
import pytest
import reference
from matplotlib.image import imread

from pyehl import Case, cli, namelist
from pyehl.plots import (
    contact,
    figures,
    folder,
    panels,
    style,
    surface,
    transient,
)
from pyehl.prediction.predict import predict
from pyehl.prediction.result import destination, draw, write
from pyehl.surfaces import Topography
from pyehl.theory.operating import OperatingPoint

pytestmark = pytest.mark.usefixtures("no_open_figures")


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


def test_only_a_failed_run_has_its_status_in_the_title():
    for status, words in (("converged", ""), ("negative film", "negative film")):
        about = {"moes_m": 412.9, "moes_l": 10.73, "hertz_pressure_Pa": 0.997e9, "status": status}
        figure = panels.panels(2, (1.0, 0.8), panels.headline(about))
        assert figure.get_suptitle() == words
        assert "M = 412.9" in figure.get_label()


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


def test_flattened_part_of_a_line_contact():
    """Pressure over the stiffness of the half-space: what the deformed part lacks."""
    tile = {"kind": "fractal", "rms_height": 2e-8, "hurst": 0.8, "pixels": 128}
    case = Case(contact={"shape": "line"}, surface=tile | {"length_x": 3e-4, "length_y": 3e-4})
    result = predict(case.resolve())
    response, rough = result.friction.response, result.surface.heights
    part = figures.flattening(result.summary, Topography(response.pressure, result.surface.size))
    lost = rough - rough.mean() - response.deformed
    assert np.std(part) == pytest.approx(np.std(lost), rel=0.01)


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


def test_passage_closes():
    shift = np.arange(8) * 1e-4
    ratio = 1.2 + 0.1 * np.cos(2 * np.pi * shift / 8e-4)
    line = surface.passage(shift, ratio, 8e-4).get_lines()[0].get_xydata()
    assert line[0, 1] == pytest.approx(line[-1, 1])
    assert line[:, 1] == pytest.approx(1.2 + 0.1 * np.cos(2 * np.pi * line[:, 0] / 0.8), abs=1e-9)


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
