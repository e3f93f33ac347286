# SPDX-License-Identifier: BSD-3-Clause
"""Figures with the width of a column, and movies that state their time scale."""

import re
from pathlib import Path

import pytest
from PIL import Image

import pyehl
from pyehl.cli import main
from pyehl.plots.movie import movie
from pyehl.plots.style import DPI, PAGE, new_figure, page_width, save

POINTS_PER_MM = 72.0 / 25.4


@pytest.fixture(scope="module")
def moving(tmp_path_factory, root: Path) -> Path:
    folder = tmp_path_factory.mktemp("moving") / "dent"
    pyehl.solve(
        root / "cases/dent.nml", "grid.points=33", "output.frame_interval=1.0", output=folder,
        check=False,
    )  # fmt: skip
    return folder


@pytest.mark.parametrize(
    ("given", "wide"),
    [
        ("84mm", 84.0),
        pytest.param("17.4cm", 174.0, marks=pytest.mark.long),
        pytest.param("3.3in", 83.82, marks=pytest.mark.long),
    ],
)
@pytest.mark.long
def test_pdf_has_the_requested_width_and_its_fonts(moving, tmp_path, given, wide):
    words = ["plot", str(moving), "-o", str(tmp_path), "--format", "pdf", "--width", given]
    assert main(words) == 0
    files = sorted(tmp_path.glob("*.pdf"))
    assert len(files) == 6
    for file in files:
        data = file.read_bytes()
        box = re.search(rb"/MediaBox \[ 0 0 (\S+) (\S+) \]", data)
        assert float(box[1]) == pytest.approx(wide * POINTS_PER_MM, abs=0.01)
        # complete TrueType fonts, none drawn as Type 3
        assert b"/FontFile2" in data
        assert b"/Type3" not in data


@pytest.mark.long
def test_svg_needs_no_font(moving, tmp_path):
    pyehl.plot(moving, tmp_path, format="svg", width=0.084)
    for file in tmp_path.glob("*.svg"):
        text = file.read_text(encoding="utf-8")
        assert "<text" not in text
        wide = float(re.search(r'<svg [^>]*width="([\d.]+)pt"', text)[1])
        assert wide == pytest.approx(84.0 * POINTS_PER_MM, abs=0.01)


@pytest.mark.long
def test_narrow_figures_have_their_panels_below_one_another(moving):
    narrow, wide, usual = (pyehl.plot(moving, width=w)["film"] for w in (0.084, 0.174, 0.0))
    left, right = narrow.axes[:2]
    assert left.get_position().y0 > right.get_position().y1
    left, right = wide.axes[:2]
    assert left.get_position().x1 < right.get_position().x0
    assert usual.get_figwidth() == pytest.approx(PAGE)
    for figure in (narrow, usual):
        figure.canvas.draw()
        assert {text.get_fontsize() for text in figure.axes[0].get_xticklabels()} == {8.0}
    # figures for a page do not change later figures
    assert new_figure(2.0, 2.0).subplots().title.get_fontsize() > 8.0


def test_every_figure_names_its_conditions(moving):
    for width in (0.0, 0.084):
        for name, figure in pyehl.plot(moving, width=width).items():
            reported = figure.get_label()
            assert "M =" in reported, name
            assert "Hertz pressure" in reported, name
            assert figure.get_suptitle() == "", name


@pytest.mark.long
def test_files_name_their_conditions(moving, tmp_path):
    pyehl.plot(moving, tmp_path)
    with Image.open(tmp_path / "film.png") as picture:
        assert "M =" in picture.text["Description"]
    pyehl.plot(moving, tmp_path, format="svg")
    assert "Hertz pressure" in (tmp_path / "film.svg").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("given", "why"),
    [("84", "a length with mm, cm or in"), ("84 px", "84 px"), ("5mm", "40 ... 400 mm")],
)
def test_other_widths_are_refused(moving, tmp_path, capsys, given, why):
    assert main(["plot", str(moving), "-o", str(tmp_path), "--width", given]) == 2
    assert why in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


@pytest.mark.long
def test_movie_keeps_its_pace_and_states_it(moving, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("pyehl.plots.movie.DPI", 40)
    words = ["plot", str(moving), "-o", str(tmp_path), "--movie", "--frame-seconds"]
    assert main([*words, "0.21"]) == 0
    data = pyehl.load(moving)
    with Image.open(tmp_path / "movie.gif") as picture:
        assert picture.n_frames == data.sizes["T"]
        assert picture.info["duration"] == 210
    assert main([*words, "0.001"]) == 2
    assert "expected 0.02 ... 10 s" in capsys.readouterr().err
    titles = []
    monkeypatch.setattr(
        "matplotlib.figure.Figure.suptitle", lambda self, text, **more: titles.append(text)
    )
    movie(data, tmp_path, seconds=0.5)
    unit = float(data["t_s"][1] - data["t_s"][0]) * 1e6
    assert all("0.5 s per frame" in title for title in titles)
    assert all(f"= {unit:.3g} µs in the contact" in title for title in titles)
    assert len(set(titles)) == data.sizes["T"]


def test_page_width_applies_only_in_its_block(tmp_path):
    with page_width(0.084):
        figure = new_figure(84.0 / 25.4, 2.0)
    path = save(figure, tmp_path / "page.png", DPI)
    with Image.open(path) as picture:
        assert picture.size[0] == pytest.approx(84.0 / 25.4 * DPI, abs=1.0)
