# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl report``: one self-contained page about any result."""

import base64
import html
import io
import json
import re
import shutil
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import pyehl
from pyehl.cli import main
from pyehl.display import with_error

LARGEST = 2_000_000
# Tests that look at pictures
DRAWN = "test_a_page_for_every_result", "test_a_page_for_a_measured_response", "test_pdf_printed"
SMALL = "grid.points=65"


class Page(HTMLParser):
    """The content of a page: tags that are not closed, addresses, pictures, text."""

    VOID = ("meta", "img", "br")

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.addresses: list[str] = []
        self.pictures: list[tuple[str, bytes]] = []
        self.words: list[str] = []
        self.tags: set[str] = set()
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attrs):
        self.tags.add(tag)
        known = dict(attrs)
        if tag == "img":
            head, _, data = known["src"].partition(",")
            assert head == "data:image/png;base64"
            self.pictures.append((known["alt"], base64.b64decode(data)))
        else:
            self.addresses += [known[name] for name in ("src", "href") if name in known]
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.words.append(data)

    @property
    def text(self) -> str:
        return " ".join(" ".join(self.words).split())


def read(path: Path) -> Page:
    assert path.stat().st_size < LARGEST
    page = Page(path.read_text(encoding="utf-8"))
    assert not page.open
    # nothing is loaded
    assert not page.addresses
    assert not page.tags & {"script", "link", "iframe", "object"}
    assert all(len(words) > 20 for words, _ in page.pictures)
    for _, data in page.pictures:
        pixels = np.asarray(Image.open(io.BytesIO(data)).convert("L"))
        assert pixels.std() > 5.0
    for part in ("Conditions", "Results", "Limits that apply", "Versions", "How to cite"):
        assert part in page.text
    return page


@pytest.fixture(autouse=True)
def stand_in(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Replace pictures that no test looks at by four pixels: drawing takes most of the time."""
    if request.node.originalname not in DRAWN:
        stream = io.BytesIO()
        Image.fromarray(np.array([[0, 255], [255, 0]], dtype=np.uint8)).save(stream, "png")
        for module in ("folder", "stress", "study"):
            monkeypatch.setattr(f"pyehl.reports.{module}.png", lambda *_: stream.getvalue())


@pytest.fixture(scope="module")
def folders(tmp_path_factory, root: Path) -> Path:
    place = tmp_path_factory.mktemp("results")
    table1 = root / "cases/table1.nml"
    pyehl.solve(table1, "grid.points=129", "surface.kind=smooth", output=place / "smooth")
    pyehl.solve(root / "cases/dent.nml", SMALL, output=place / "rough")
    pyehl.predict(table1, output=place / "prediction", plots=False)
    vary = {"contact.moes_m": [50.0, 100.0, 200.0]}
    pyehl.sweep(root / "cases/quick.nml", vary, SMALL, output=place / "sweep", jobs=1)
    pyehl.stribeck(
        table1,
        {"contact.mean_velocity": [0.6, 1.2]},
        "grid.points=129",
        output=place / "curve",
        jobs=1,
    )
    return place


OTHER_PAGES = [("prediction", 3), ("sweep", 1), ("curve", 1)]


@pytest.mark.parametrize(
    ("name", "pictures"),
    [
        ("smooth", 2),
        ("rough", 6),
        *(pytest.param(*case, marks=pytest.mark.long) for case in OTHER_PAGES),
    ],
)
def test_a_page_for_every_result(folders, tmp_path, name, pictures):
    written = pyehl.report(folders / name, tmp_path / "page.html")
    page = read(written)
    assert len(page.pictures) == pictures
    assert re.search(r"(Full film|Thin film|Holds|Take with care|Unresolved waves)\.", page.text)
    assert "Moes load M" in page.text
    assert "600 N" in page.text or name in ("sweep", "rough")
    assert not list(tmp_path.glob(".partial*"))


def test_numbers_are_those_of_the_result(folders, tmp_path):
    summary = json.loads((folders / "smooth/summary.json").read_text())
    page = read(pyehl.report(folders / "smooth", tmp_path / "page.html"))
    error = summary["H_c_error"] * summary["film_scale_m"] * 1e9
    assert f"h_c {with_error(summary['h_c_m'] * 1e9, error, 'nm')}" in page.text
    assert f"H_c = {with_error(summary['H_c'], summary['H_c_error'])}" in page.text
    assert summary["assessment"].partition(": ")[2][1:] in page.text.replace("μ_r/μ_s", "mu_r/mu_s")
    assert summary["mu_note"] in page.text
    prediction = json.loads((folders / "prediction/summary.json").read_text())
    page = read(pyehl.report(folders / "prediction", tmp_path / "other.html"))
    ratio = with_error(prediction["mu_ratio"], prediction["mu_ratio_model_error"])
    # the meaning of each ±, first the mean over the tracks of the surface
    assert (
        "1.324 ± 0.134 (mean and scatter over 8 tracks); on the track of the case 1.540"
        in page.text
    )
    assert f"{ratio} (model); between {prediction['mu_ratio_min']:.4g}" in page.text


def test_the_case_in_it_can_be_run(folders, tmp_path, root):
    """The short case on the page is the case that was run."""
    text = pyehl.report(folders / "smooth", tmp_path / "page.html").read_text(encoding="utf-8")
    short = re.search(r"<pre>(&amp;.*?)</pre>", text, re.DOTALL)[1]
    (tmp_path / "case.nml").write_text(html.unescape(short))
    again = pyehl.Case(tmp_path / "case.nml").resolve()
    asked = ("grid.points=129", "surface.kind=smooth")
    assert again == pyehl.Case(root / "cases/table1.nml", *asked).resolve()


@pytest.mark.parametrize(
    ("load", "verdict"),
    [
        ("50,51", "Holds. 2 of 2 cases have a result."),
        ("50,300", "2 of 2 cases have a result. With care: 1 'outside the range of a formula'."),
    ],
)
def test_films_by_formula_are_results(tmp_path, root, load, verdict):
    vary = {"contact.load": [float(word) for word in load.split(",")]}
    folder = tmp_path / "films"
    pyehl.sweep(root / "cases/table1.nml", vary, run="film", output=folder, jobs=1)
    assert verdict in read(pyehl.report(folder)).text


def test_missing_result_is_reported(tmp_path, root):
    with pytest.raises(pyehl.NotConverged):
        pyehl.solve(root / "cases/quick.nml", SMALL, "solver.max_cycles=1", output=tmp_path / "run")
    page = read(pyehl.report(tmp_path / "run", tmp_path / "page.html"))
    assert "No result. The status is 'cycle limit'" in page.text
    assert "H_c =" not in page.text


@pytest.mark.long
def test_film_breakdown_is_reported(tmp_path, root):
    result = pyehl.predict(
        root / "cases/table1.nml", "surface.rms_height=4e-7", output=tmp_path / "run", plots=False
    )
    assert result.summary["status"] == "film breakdown"
    page = read(pyehl.report(tmp_path / "run", tmp_path / "page.html"))
    assert "Film breakdown. " in page.text
    assert result.summary["message"][1:] in page.text
    assert "suggested_shortest_wavelength_m" in page.text


def test_a_failed_case_of_a_study_is_reported(folders, tmp_path):
    folder = tmp_path / "sweep"
    shutil.copytree(folders / "sweep", folder)
    rows = (folder / "results.csv").read_text().splitlines()
    rows[1] = rows[1].replace(",converged,", ",cycle limit,")
    (folder / "results.csv").write_text("\n".join(rows) + "\n")
    page = read(pyehl.report(folder, tmp_path / "page.html"))
    assert "Take with care. 2 of 3 cases have a result. Others: 1 'cycle limit'" in page.text


def test_a_page_for_a_measured_response(tmp_path, root):
    folder = tmp_path / "response"
    folder.mkdir()
    (folder / "case.nml").write_text(pyehl.Case(root / "cases/table1.nml").text)
    rng = np.random.default_rng(1)
    Image.fromarray(rng.integers(0, 255, (64, 64, 3), dtype=np.uint8)).save(folder / "response.png")
    summary = {
        "kind": "response",
        "status": "measured",
        "waves": 12,
        "within_fitted_range": False,
        "shipped_difference_rms": 0.021,
        "shipped_difference_max": 0.05,
        "tiers": [{"points": 129, "waves": 5}, {"points": 257, "waves": 7}],
    }
    (folder / "summary.json").write_text(json.dumps(summary))
    result = read(pyehl.report(folder))
    assert len(result.pictures) == 1
    assert "Take with care. 12 waves; they differ from the shipped response by 0.021" in result.text
    assert "Film and pressure are isothermal" in result.text
    assert "one track" not in result.text
    (folder / "case.nml").unlink()
    with pytest.raises(pyehl.FileError, match=r"case\.nml.*cannot be read"):
        pyehl.report(folder)


def test_an_unfinished_zipped_study_is_reported(tmp_path, root):
    vary = {"contact.moes_m": [50.0, 100.0, 200.0], "contact.moes_l": [8.0, 9.0, 10.0]}
    folder = tmp_path / "sweep"
    pyehl.sweep(root / "cases/quick.nml", vary, SMALL, zipped=True, output=folder, jobs=1)
    assert "3 of 3 cases have a result." in read(pyehl.report(folder)).text
    rows = (folder / "results.csv").read_text().splitlines()
    (folder / "results.csv").write_text("\n".join(rows[:-1]) + "\n")
    assert "2 of 2 cases have a result; 1 are not done" in read(pyehl.report(folder)).text


def test_folders_of_the_maps_of_a_study_are_not_shown(tmp_path, root):
    """In the case, and as values of a key; with characters that HTML and namelists quote."""
    place = tmp_path / "o'brien & co"
    place.mkdir()
    heights = 2e-8 * np.sin(2.0 * np.pi * np.arange(64) / 64.0)[:, np.newaxis] * np.ones(64)
    files = [place / name for name in ("ground.npy", "honed.npy")]
    for file in files:
        np.save(file, heights)
    size = {"surface.length_x": 4e-4, "surface.length_y": 4e-4, "surface.kind": "map"}
    case = pyehl.Case(root / "cases/table1.nml", {**size, "surface.file": str(files[0])})
    vary = {"surface.file": [str(file) for file in files]}
    pyehl.sweep(case, vary, run="predict", output=tmp_path / "sweep", jobs=1)
    text = pyehl.report(tmp_path / "sweep").read_text(encoding="utf-8")
    assert "ground.npy" in text
    assert "honed.npy" in text
    pyehl.predict(case, output=tmp_path / "run", plots=False)
    text += pyehl.report(tmp_path / "run").read_text(encoding="utf-8")
    assert "brien" not in text
    assert tmp_path.name not in text


def test_folders_of_maps_are_not_shown(tmp_path, root):
    heights = 2e-8 * np.sin(2.0 * np.pi * np.arange(64) / 64.0)[:, np.newaxis] * np.ones(64)
    np.save(tmp_path / "ground.npy", heights)
    pyehl.predict(
        root / "cases/table1.nml",
        {"surface.kind": "map", "surface.file": str(tmp_path / "ground.npy")},
        {"surface.length_x": 4e-4, "surface.length_y": 4e-4},
        output=tmp_path / "run",
        plots=False,
    )
    page = read(pyehl.report(tmp_path / "run", tmp_path / "page.html"))
    assert "ground.npy" in page.text
    assert str(tmp_path) not in (tmp_path / "page.html").read_text()


def test_only_its_own_file_is_replaced(folders, tmp_path, capsys):
    target = tmp_path / "page.html"
    assert main(["report", str(folders / "smooth"), "-o", str(target)]) == 0
    first = target.read_bytes()
    assert main(["report", str(folders / "smooth"), "-o", str(target)]) == 0
    assert target.read_bytes() == first
    target.write_text("mine")
    assert main(["report", str(folders / "smooth"), "-o", str(target)]) == 2
    assert "did not write" in capsys.readouterr().err
    assert target.read_text() == "mine"


def test_a_new_run_removes_the_old_report(tmp_path, root):
    """The page belongs to the result: it is removed with it."""
    for _ in range(2):
        pyehl.solve(root / "cases/quick.nml", SMALL, output=tmp_path / "run")
        assert not (tmp_path / "run/report.html").exists()
        assert pyehl.report(tmp_path / "run") == tmp_path / "run/report.html"
    (tmp_path / "run/notes.html").write_text("mine")
    with pytest.raises(pyehl.InputError, match=r"notes\.html"):
        pyehl.solve(root / "cases/quick.nml", SMALL, output=tmp_path / "run")


def test_folders_without_results_are_refused(tmp_path):
    with pytest.raises(pyehl.InputError, match="no result folder"):
        pyehl.report(tmp_path)
    (tmp_path / "summary.json").write_text('{"kind": "reproduce"}')
    with pytest.raises(pyehl.InputError, match="a result of 'reproduce' has no report"):
        pyehl.report(tmp_path)
    (tmp_path / "summary.json").write_text("{")
    with pytest.raises(pyehl.FileError, match="cannot be read"):
        pyehl.report(tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["summary.json"]


def test_pdf(folders, tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(pyehl.InputError, match="no browser is installed"):
        pyehl.report(folders / "smooth", tmp_path / "page.html", pdf=True)
    assert not (tmp_path / "page.html").exists()


@pytest.mark.long
@pytest.mark.skipif(not shutil.which("chromium"), reason="no browser: chromium is not installed")
def test_pdf_printed(folders, tmp_path):
    pyehl.report(folders / "smooth", tmp_path / "page.html", pdf=True)
    data = (tmp_path / "page.pdf").read_bytes()
    assert data.startswith(b"%PDF")
    assert len(data) < LARGEST
    # in the folder of the result, too
    shutil.copytree(folders / "smooth", tmp_path / "smooth")
    for _ in range(2):
        pyehl.report(tmp_path / "smooth", tmp_path / "smooth/page.html", pdf=True)
    assert (tmp_path / "smooth/page.pdf").is_file()
    with pytest.raises(pyehl.InputError, match="one name"):
        pyehl.report(tmp_path / "smooth", tmp_path / "page.pdf", pdf=True)
    (tmp_path / "page.pdf").write_bytes(b"%PDF mine")
    with pytest.raises(pyehl.InputError, match="did not write"):
        pyehl.report(folders / "smooth", tmp_path / "page.html", pdf=True)


@pytest.mark.long
def test_stress_in_a_report(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """From the folder of the result, from another one, or computed; refused for another case."""
    run, other = tmp_path / "run", tmp_path / "other"
    pyehl.solve("cases/mtm.nml", "grid.points=33", output=run)
    pyehl.solve("cases/mtm.nml", "grid.points=33", "contact.load=30", output=other)

    def words(*options: str) -> tuple[str, int]:
        assert main(["report", str(run), *options]) == 0
        result = Page((run / "report.html").read_text(encoding="utf-8"))
        return " ".join(result.words), len(result.pictures)

    without, pictures = words()
    assert "Stress below the surface" not in without
    assert "Stress below the surface" in words("--stress")[0]
    assert main(["stress", str(run), "-o", str(run / "stress"), "--friction", "0.1"]) == 0
    inside, more = words()
    assert "traction is 0.1 times the pressure" in inside
    assert more == pictures + 2
    assert main(["stress", str(other), "-o", str(tmp_path / "steel")]) == 0
    capsys.readouterr()
    for folder, expected in (("steel", "stress of another case"), ("run", "no stress.nc")):
        assert main(["report", str(run), "--stress", str(tmp_path / folder)]) == 2
        assert expected in capsys.readouterr().err
