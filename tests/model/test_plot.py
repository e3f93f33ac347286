# SPDX-License-Identifier: BSD-3-Clause
"""Pictures: what they show, on fields that are known."""

import argparse
import json
import struct

import f90nml
import numpy as np
import pytest

from pyehl import reference
from pyehl.commands import plot
from pyehl.commands.predict import draw
from pyehl.plots import contact, style, surface
from pyehl.prediction.folder import write
from pyehl.prediction.of_case import predict
from pyehl.theory.operating import OperatingPoint


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


def test_centre_lines_in_hertz_units(fields):
    figure = contact.centre_lines(*fields)
    left, right = figure.axes[:2]
    drawn = curves(left)
    assert drawn["Hertz"][:, 1].max() == 1.0
    assert drawn["pressure"][:, 0] == pytest.approx(fields[0])
    assert drawn["pressure"][:, 1] == pytest.approx(fields[2][:, 64])
    assert curves(right)["pressure"][:, 0] == pytest.approx(fields[1])
    assert "p/p_h" in left.get_ylabel()


def test_centre_lines_in_si(fields, scales):
    figure = contact.centre_lines(*fields, scales)
    assert curves(figure.axes[0])["Hertz"][:, 1].max() == pytest.approx(1.6602, rel=1e-4)
    assert "GPa" in figure.axes[0].get_ylabel()
    films = [curves(ax)["film"] for ax in figure.axes if "film" in curves(ax)]
    assert len(films) == 2
    assert np.interp(0.0, *films[0].T) == pytest.approx(0.0243 * scales.film * 1e6, rel=1e-3)


@pytest.mark.parametrize("si", [True, False])
def test_film_maps(fields, scales, si):
    x, y, _, film = fields
    figure = contact.film_maps(x, y, film, scales if si else None)
    fringe, contours = figure.axes[:2]
    image = fringe.get_images()[0].get_array()
    assert 0.0 <= image.min()
    assert image.max() <= 1.0
    # the centre by the law of two beams
    step = contact.LIGHT / 3e-6 * 1e-6 * 1e6 if si else 0.01
    h = 0.0243 * (scales.film * 1e6 if si else 1.0)
    fade = np.exp(-((h / (contact.COHERENT_FRINGES * step)) ** 2))
    expected = 0.5 * (1 - fade * np.cos(2 * np.pi * h / step))
    n = image.shape
    assert image[n[0] // 2, n[1] // 2] == pytest.approx(expected, abs=0.02)
    assert contours.get_aspect() == 1.0
    text = fringe.texts[0].get_text()
    assert ("0.211" in text) if si else ("0.01" in text)


def test_surface_spectrum(settings):
    result = predict(settings)
    figure = surface.surface_spectrum(result.surface, 4.154e-4, 1000.0, 10.0)
    ratio = figure.axes[-1].get_lines()[0].get_ydata()
    assert np.all(np.diff(ratio) > 0.0)
    assert figure.axes[0].get_images()[0].get_array().max() == pytest.approx(
        result.surface.heights.max() * 1e9
    )


def test_roughness_pair_shares_one_scale(settings):
    result = predict(settings)
    deformed = result.friction.response.deformed
    figure = surface.roughness_pair(result.surface, deformed, result.operating.hertz_radius)
    left, right = (ax.get_images()[0] for ax in figure.axes[:2])
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
    figure = surface.friction_passage(shift, ratio, 8e-4)
    line = figure.axes[0].get_lines()[0].get_xydata()
    assert line[0, 1] == pytest.approx(line[-1, 1])
    assert line[:, 1] == pytest.approx(1.2 + 0.1 * np.cos(2 * np.pi * line[:, 0] / 0.8), abs=1e-9)


def test_png_at_300_dots_per_inch(fields, tmp_path):
    path = style.save(contact.centre_lines(*fields), tmp_path / "a.png")
    data = path.read_bytes()
    width, height = struct.unpack(">II", data[16:24])
    assert (width, height) == (2160, 990)


def run_subcommand(folder, output=None, units="auto", dpi=style.DPI):
    return plot.execute(argparse.Namespace(folder=folder, output=output, units=units, dpi=dpi))


def test_subcommand_on_a_prediction(settings, tmp_path, capsys):
    write(predict(settings), tmp_path / "out")
    assert run_subcommand(tmp_path / "out", tmp_path / "png") == 0
    assert len(capsys.readouterr().out.split()) == 3
    assert (tmp_path / "png" / "roughness.png").stat().st_size > 1e4


def test_subcommand_at_other_resolutions(settings, tmp_path, capsys):
    write(predict(settings), tmp_path / "out")
    assert run_subcommand(tmp_path / "out", dpi=100) == 0
    data = (tmp_path / "out" / "roughness.png").read_bytes()
    assert struct.unpack(">II", data[16:24]) == (700, 310)
    assert run_subcommand(tmp_path / "out", dpi=1) == 2
    assert "--dpi 1" in capsys.readouterr().err


def test_subcommand_on_a_prediction_that_failed(settings, tmp_path):
    settings["psd"]["film_thickness"] = 1e-8
    write(predict(settings), tmp_path / "out", draw=draw)
    assert run_subcommand(tmp_path / "out") == 0
    assert not (tmp_path / "out" / "passage.png").exists()


def test_subcommand_on_a_run(settings, fields, tmp_path):
    (tmp_path / "summary.json").write_text(json.dumps({"status": "converged"}))
    (tmp_path / "case.nml").write_text(str(f90nml.Namelist(settings)) + "\n")
    for name, values in zip("XYPH", fields, strict=True):
        np.save(tmp_path / f"{name}.npy", np.asfortranarray(values))
    assert run_subcommand(tmp_path) == 0
    assert {p.name for p in tmp_path.glob("*.png")} == {"centre_lines.png", "film.png"}
    assert run_subcommand(tmp_path, units="hertz") == 0


def test_subcommand_without_a_result(tmp_path, capsys):
    assert run_subcommand(tmp_path) == 2
    assert "no summary.json" in capsys.readouterr().err
    (tmp_path / "summary.json").write_text("{}")
    assert run_subcommand(tmp_path) == 2
