# SPDX-License-Identifier: BSD-3-Clause
"""A study is resumed only by the same version, with the same case and maps."""

import io
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

import numpy as np
import pytest
from journals import rows_in

from pyehl.cli import main
from pyehl.studies import study as study_module


def pyehl_(command: str, folder: Path, *words: str, expect: int = 0) -> str:
    """Run a command of studies in this process; returns its output."""
    reported = io.StringIO()
    with redirect_stdout(reported), redirect_stderr(reported):
        status = main([command, *words, "-o", str(folder)])
    assert status == expect, reported.getvalue()
    return reported.getvalue()


def heights(seed: int) -> np.ndarray:
    return 1e-8 * np.random.default_rng(seed).standard_normal((32, 32))


@pytest.fixture
def mapped(tmp_path: Path) -> tuple[Path, list[str]]:
    """A case with a height map of a relative name, and the arguments of a study of it."""
    (tmp_path / "in").mkdir()
    np.save(tmp_path / "in" / "scan.npy", heights(0))
    text = "&surface kind = 'map' file = 'scan.npy' length_x = 8e-4 length_y = 8e-4 /\n"
    (tmp_path / "in" / "case.nml").write_text(text)
    words = ["--run", "film", "--vary", "contact.mean_velocity=0.5,1.0", "--jobs", "1"]
    pyehl_("sweep", tmp_path / "out", str(tmp_path / "in" / "case.nml"), *words)
    return tmp_path, words


def test_a_study_whose_map_has_changed_is_refused(mapped: tuple[Path, list[str]]):
    folder, words = mapped
    before = rows_in(folder / "out")
    np.save(folder / "in" / "scan.npy", heights(1))
    refused = pyehl_("sweep", folder / "out", str(folder / "in" / "case.nml"), *words, expect=2)
    assert "file.scan.npy: there sha256 " in refused
    assert "lubricant" not in refused
    assert rows_in(folder / "out") == before


def test_a_study_goes_on_where_its_map_has_moved(mapped: tuple[Path, list[str]]):
    """The content of the map counts, not its path; another map of the same name is refused."""
    folder, words = mapped
    (folder / "in").rename(folder / "moved")
    reported = pyehl_("sweep", folder / "out", str(folder / "moved" / "case.nml"), *words)
    assert "2 of them are done" in reported
    (folder / "other").mkdir()
    np.save(folder / "other" / "scan.npy", heights(1))
    (folder / "other" / "case.nml").write_text((folder / "moved" / "case.nml").read_text())
    refused = pyehl_("sweep", folder / "out", str(folder / "other" / "case.nml"), *words, expect=2)
    assert "file.scan.npy: there sha256 " in refused


def test_a_study_of_another_version_is_refused(
    mapped: tuple[Path, list[str]], monkeypatch: pytest.MonkeyPatch
):
    folder, words = mapped
    here = study_module.metadata.version("pyehl")
    monkeypatch.setattr(study_module.metadata, "version", lambda name: "9.9.9")
    case = str(folder / "in" / "case.nml")
    refused = pyehl_("sweep", folder / "out", case, *words, expect=2)
    assert refused.splitlines()[1:-1] == [f"  pyehl version: there {here}, here 9.9.9"]


def test_changed_values_make_another_study_but_comments_do_not(mapped: tuple[Path, list[str]]):
    folder, words = mapped
    path = folder / "in" / "case.nml"
    path.write_text(f"! the contact of 2019\n{path.read_text()}")
    assert "2 of them are done" in pyehl_("sweep", folder / "out", str(path), *words)
    path.write_text(f"&contact radius = 0.019 /\n{path.read_text()}")
    refused = pyehl_("sweep", folder / "out", str(path), *words, expect=2)
    assert refused.splitlines()[1:] == [
        "  contact.radius: there 0.018 (default), here 0.019",
        "expected: another folder",
    ]


def test_a_curve_whose_surface_has_changed_is_refused(mapped: tuple[Path, list[str]]):
    folder, _ = mapped
    words = [str(folder / "in" / "case.nml"), "--speed", "1,2", "--set", "grid.points=65"]
    pyehl_("stribeck", folder / "curve", *words)
    before = (folder / "curve" / "stribeck.csv").read_bytes()
    np.save(folder / "in" / "scan.npy", heights(1))
    refused = pyehl_("stribeck", folder / "curve", *words, expect=2)
    assert "file.scan.npy: there sha256 " in refused
    np.save(folder / "in" / "scan.npy", heights(0))
    text = (folder / "in" / "case.nml").read_text()
    (folder / "in" / "case.nml").write_text(text.replace("'map'", "'fractal'"))
    refused = pyehl_("stribeck", folder / "curve", *words, expect=2)
    assert "surface.kind: there 'map', here 'fractal'" in refused
    assert (folder / "curve" / "stribeck.csv").read_bytes() == before
