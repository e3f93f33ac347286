# SPDX-License-Identifier: BSD-3-Clause
"""The subcommand ``pyehl predict`` and its result folder."""

import argparse
import csv
import json

import numpy as np
import pytest
import xarray as xr

from pyehl import FileError, InputError, namelist
from pyehl.commands import film as film_command
from pyehl.commands import predict as predict_command
from pyehl.prediction.predict import predict
from pyehl.prediction.result import destination, draw, write
from pyehl.results import load
from pyehl.theory import film
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint


def test_summary_describes_the_prediction(settings):
    result = predict(settings)
    summary = json.loads(json.dumps(result.summary, allow_nan=False))
    assert summary["status"] == "predicted"
    assert summary["mu_ratio_min"] < summary["mu_ratio"] < summary["mu_ratio_max"]
    assert summary["wavelength_convention"] == "components"
    assert (summary["reduction"], summary["smooth"]) == ("amplitude", "hertz")
    assert summary["mu_ratio_model_error"] is None  # known for the response alone
    assert summary["stiffness"] == "exact"
    assert summary["viscosity_law"] == "roelands"
    assert summary["h_c_m"] == 0.2333e-6
    assert summary["h_c_source"] == "psd.film_thickness"
    assert summary["seed"] == 1
    assert summary["rms_height_m"] == pytest.approx(5e-8)
    assert summary["mu_ratio_tracks"] == pytest.approx(1.072, abs=0.006)
    assert summary["mu_ratio_tracks_spread"] == pytest.approx(0.1, abs=0.06)
    assert summary["mu_smooth"] is None  # a Newtonian coefficient has no meaning
    assert "no absolute coefficient" in summary["note"]
    assert 0.0 < summary["wall_seconds"] < 5.0
    assert sum(b["increase"] for b in summary["bands"]) == pytest.approx(summary["mu_ratio"] - 1)
    for word in (
        "on the track of the case 1.25",
        "positions",
        "ms",
        "seed 1",
        "no absolute coefficient",
    ):
        assert word in predict_command.report(result)


@pytest.mark.parametrize("tracks", [10**9, 10_001, 0, -1])
def test_too_many_tracks_are_refused_at_once(settings, tracks):
    """Before anything is allocated: a list of a thousand million would exhaust the memory."""
    settings["surface"] = {"kind": "fractal"}
    with pytest.raises(ValueError, match=rf"tracks = {tracks}: expected 1 to 10000; the mean over"):
        predict(settings, tracks=tracks)


def test_film_from_the_formula_and_law_from_psd(settings):
    settings["psd"] |= {"film_thickness": 0.0, "viscosity_law": "barus"}
    settings["lubricant"]["shear_law"] = "eyring"
    result = predict(settings)
    assert result.film == pytest.approx(film.central_film(OperatingPoint(), Lubricant()), rel=1e-14)
    assert "Nijenbanning" in result.film_source
    assert result.lubricant.viscosity_law == "barus"
    assert result.summary["mu_smooth"] > 0.0
    assert f"mu         {result.summary['mu']:.5f}" in predict_command.report(result)


def test_harmonic_amplitude_is_a_share_of_the_film(settings):
    settings["surface"]["kind"] = "harmonic"
    result = predict(settings)
    assert result.surface.heights.max() == pytest.approx(0.4 * 0.2333e-6)


@pytest.fixture
def folder(settings, tmp_path):
    target = tmp_path / "deep" / "out"
    result = predict(settings)
    write(result, destination(target))
    draw(result, target)
    return target


def test_folder(folder, settings):
    names = {p.name for p in folder.iterdir()}
    assert names == {
        "case.nml", "summary.json", "passage.csv", "spectrum.csv", "bands.csv",
        "x.npy", "y.npy", "surface.npy", "deformed.npy", "delta_p.npy",
        "surface_spectrum.png", "roughness.png", "passage.png",
    }  # fmt: skip
    assert [p.name for p in folder.parent.iterdir()] == ["out"]  # nothing left behind
    case = namelist.values((folder / "case.nml").read_text())
    assert case["psd"]["film_thickness"] == 0.2333e-6
    again = predict(case)
    summary = json.loads((folder / "summary.json").read_text())
    assert again.friction.mu_ratio == summary["mu_ratio"]
    z = np.load(folder / "surface.npy", allow_pickle=False)
    assert z.shape == (256, 256)
    assert np.isfortran(z)
    assert np.array_equal(z, again.surface.heights)
    with (folder / "passage.csv").open() as stream:
        rows = list(csv.DictReader(stream))
    ratios = [float(row["mu_ratio"]) for row in rows]
    assert np.mean(ratios) == pytest.approx(summary["mu_ratio"], rel=1e-12)


def test_folder_holds_the_data(folder, settings):
    data = predict(settings).data
    again = load(folder)
    assert data.deformed_m.shape == (256, 256)
    assert data.bands_increase.dims == ("bands",)
    assert min(float(one.wall_seconds) for one in (data, again)) > 0.0
    data, again = (one.drop_vars("wall_seconds") for one in (data, again))
    xr.testing.assert_identical(data, again)


def test_earlier_result_is_replaced(folder, settings):
    settings["surface"]["seed"] = 2
    write(predict(settings), destination(folder))
    assert json.loads((folder / "summary.json").read_text())["seed"] == 2
    assert not (folder / "passage.png").exists()


def test_other_folders_are_left_alone(settings, tmp_path):
    (tmp_path / "thesis.tex").write_text("precious")
    result = predict(settings)
    with pytest.raises(InputError, match=r"holds 'thesis\.tex'"):
        write(result, destination(tmp_path))
    with pytest.raises(InputError, match="not a folder"):
        write(result, destination(tmp_path / "thesis.tex"))
    assert [p.name for p in tmp_path.iterdir()] == ["thesis.tex"]


def test_failed_write_leaves_the_old_result(folder, settings, monkeypatch):
    before = (folder / "summary.json").read_text()

    def fail(*_):
        raise OSError("disk full")

    monkeypatch.setattr("pyehl.prediction.result.write_csv", fail)
    with pytest.raises(OSError, match="disk full"):
        write(predict(settings), destination(folder))
    assert (folder / "summary.json").read_text() == before
    assert [p.name for p in folder.parent.iterdir()] == ["out"]


def test_a_picture_that_fails_is_a_warning(settings, tmp_path, monkeypatch, caplog):
    """The result is written before the pictures."""
    place = destination(tmp_path / "out")
    result = predict(settings)
    write(result, place)

    def fail(*_, **__):
        raise MemoryError("Unable to allocate 5.27 TiB")

    monkeypatch.setattr("pyehl.plots.surface.roughness", fail)
    draw(result, place.folder)
    assert "roughness.png: not drawn: Unable to allocate 5.27 TiB" in caplog.text
    files = json.loads((tmp_path / "out" / "summary.json").read_text())["files"]
    assert "passage.png" in files
    assert "surface_spectrum.png" in files
    assert sorted(files) == sorted(p.name for p in (tmp_path / "out").iterdir())
    # a new prediction in the folder replaces the pictures, too
    write(result, place)
    assert not (tmp_path / "out" / "passage.png").exists()


@pytest.fixture
def command(settings, monkeypatch, tmp_path):
    """Run the subcommand on `settings`, as if they came from the compiled reader."""

    class Case:
        text = "&surface\n kind = 'fractal'\n/\n"

        def __init__(self, case, *options):
            pass

        def resolve(self):
            return settings

    monkeypatch.setattr("pyehl.api.Case", Case)

    def run(execute, **arguments):
        defaults = {
            "case": "a.nml",
            "overrides": [],
            "output": tmp_path / "out",
            "plots": False,
            "tracks": 2,
            "smooth": None,
            "force": False,
        }
        return execute(argparse.Namespace(**(defaults | arguments)))

    return run


def test_command(command, tmp_path, capsys):
    assert command(predict_command.execute) == 0
    assert "mu_r/mu_s" in capsys.readouterr().out
    assert (tmp_path / "out" / "case.nml").read_text().startswith("&surface")


def test_subcommand_reports_bad_input(command, settings, tmp_path):
    settings["surface"]["kind"] = "smooth"
    with pytest.raises(InputError, match=r"a\.nml: surface\.kind"):
        command(predict_command.execute)
    settings["surface"] |= {"kind": "map", "file": str(tmp_path / "none.npy")}
    with pytest.raises(FileError, match=r"none\.npy"):
        command(predict_command.execute)
    assert not (tmp_path / "out").exists()


def test_subcommand_reports_film_breakdown(command, settings, capsys, tmp_path):
    settings["psd"]["film_thickness"] = 1e-8
    assert command(predict_command.execute) == 1
    assert "film breakdown" in capsys.readouterr().out
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert (summary["status"], summary["mu_ratio"]) == ("film breakdown", None)


def test_film_command(command, capsys, settings):
    assert command(film_command.execute, json=False) == 0
    assert "Hamrock-Dowson" in capsys.readouterr().out
    assert command(film_command.execute, json=True) == 0
    assert json.loads(capsys.readouterr().out)["moes_m"] == pytest.approx(1000.0, rel=1e-4)
    settings["surface"] |= {"kind": "map", "file": "none.npy"}
    with pytest.raises(FileError, match=r"none\.npy"):
        command(film_command.execute, json=True)
