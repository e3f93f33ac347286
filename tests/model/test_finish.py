# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces by Ra, Rq or a finish: height, lay, and effect of the assumed spectrum."""

import json
import math

import numpy as np
import pytest

import pyehl
from pyehl import cli
from pyehl.case import exchanged
from pyehl.errors import InputError
from pyehl.prediction.predict import predict
from pyehl.surfaces import fractal

SMALL = "&contact mean_velocity = 4.0 /\n&grid points = 33 /\n&lubricant shear_law = 'eyring' /\n"


def resolved(keys, group="surface"):
    return pyehl.Case.from_text(f"&{group} {keys} /\n").resolve()[group]


@pytest.mark.parametrize("group", ["surface", "second_surface"])
def test_ra_and_rq_give_the_rms_height(group):
    normal = math.sqrt(math.pi / 2.0)
    assert resolved("kind='fractal' ra=3e-7", group)["rms_height"] == pytest.approx(3e-7 * normal)
    assert resolved("kind='fractal' rq=3e-7", group)["rms_height"] == 3e-7
    tile = fractal(256, 1e-3, 1e-3, rms_height=3e-7 * normal, hurst=0.8, rolloff_wavenumber=6e4)
    assert np.abs(tile.heights).mean() == pytest.approx(3e-7, rel=0.02)


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ("kind='fractal' ra=1e-7 rq=1e-7", r"surface\.rq contradicts surface\.ra"),
        ("kind='fractal' rms_height=1e-7 ra=1e-7", r"surface\.ra contradicts surface\.rms_height"),
        ("kind='harmonic' ra=1e-7", r"surface\.ra beside surface\.kind = 'harmonic'"),
        ("rq=1e-7", r"surface\.rq beside surface\.kind = 'smooth'"),
        ("kind='smooth' finish='ground'", r"surface\.finish beside surface\.kind = 'smooth'"),
        ("finish='grinded'", "'ground'"),
    ],
)
def test_contradicting_keys_are_refused(keys, message):
    with pytest.raises(InputError, match=message):
        resolved(keys)


def test_a_finish_sets_the_missing_keys():
    ground = resolved("finish='ground'")
    assert ground["kind"] == "fractal"
    assert ground["rms_height"] == pytest.approx(0.4e-6 * math.sqrt(math.pi / 2.0))
    assert ground["rolloff_wavenumber"] == pytest.approx(2.0 * math.pi / 100e-6)
    assert (ground["hurst"], ground["lay_ratio"]) == (0.5, 0.1)
    own = resolved("finish='ground' ra=1e-7 hurst=0.7 lay_ratio=1.0 rolloff_wavenumber=0.0")
    assert own["rms_height"] == pytest.approx(1e-7 * math.sqrt(math.pi / 2.0))
    assert (own["hurst"], own["lay_ratio"], own["rolloff_wavenumber"]) == (0.7, 1.0, 0.0)
    heights = [resolved(f"finish='{f}'")["rms_height"]
               for f in ("ground", "honed", "superfinished", "polished")]  # fmt: skip
    assert heights == sorted(heights, reverse=True)
    # a written case is the same case, and another finish changes derived values
    case = pyehl.Case.from_text("&surface finish='ground' /")
    assert pyehl.Case.from_text(case.text).resolve() == case.resolve()
    assert case.with_options({"surface.finish": "polished"}).resolve()["surface"]["hurst"] == 0.8


@pytest.mark.parametrize(
    "keys", ["kind='fractal' ra=5e-8", "kind='fractal' rq=5e-8", "finish='ground'"]
)
def test_another_surface_in_its_place(keys, tmp_path):
    """Its keys are unset for a smooth contact, for heights in memory and for a written tile."""
    case = pyehl.Case.from_text(f"{SMALL}&surface {keys} pixels=16 /\n")
    assert case.smooth()["surface"]["kind"] == "smooth"
    assert exchanged(case)["second_surface"]["rms_height"] == case["surface"]["rms_height"]
    for heights in (None, np.zeros((16, 16))):
        with pyehl.Solver(case, surface=heights) as solver:
            assert solver.shape == (33, 33)
    (tmp_path / "case.nml").write_text(case.text)
    words = ["surface", str(tmp_path / "case.nml"), "-o", str(tmp_path / "tile.npy"), "--no-plots"]
    assert cli.main(words) == 0
    assert pyehl.Case(tmp_path / "tile.npy.nml")["surface"]["kind"] == "map"


def test_cells_of_a_finish_are_those_of_its_fractal_surface():
    """A wide smooth contact has cells that are longer across the motion, too long for waves."""
    wide = {"contact.radius_x": 0.01, "contact.radius_y": 0.3, "contact.load": 300.0}
    rows = [
        pyehl.Case.from_text("", wide | keys)["grid"]["points_y"]
        for keys in ({"surface.finish": "ground"}, {"surface.kind": "fractal"}, {})
    ]
    assert rows[0] == rows[1] > rows[2]


@pytest.mark.parametrize("ratio", [0.1, 1.0, 5.0])
def test_lay_has_the_given_ratio(ratio):
    """Rms slopes along and across have the ratio of the correlation lengths."""
    tile = fractal(512, 1e-3, 1e-3, rms_height=1e-7, hurst=1.0, rolloff_wavenumber=1e5,
                   lay_ratio=ratio, modulus="gaussian", seed=3)  # fmt: skip
    along, across = (float(np.std(np.diff(tile.heights, axis=axis))) for axis in (0, 1))
    assert across / along == pytest.approx(ratio, rel=0.25)
    assert tile.rms_height == pytest.approx(1e-7, rel=1e-9)


def test_a_lay_ratio_of_1_changes_no_bit():
    kept = fractal(32, 1e-4, 1e-4, rms_height=1e-8, hurst=0.8)
    assert np.array_equal(
        kept.heights, fractal(32, 1e-4, 1e-4, rms_height=1e-8, hurst=0.8, lay_ratio=1.0).heights
    )


def test_program_and_package_make_the_same_lay():
    case = pyehl.Case.from_text(SMALL + "&surface finish='honed' ra=1e-8 pixels=64 /")
    with pyehl.Solver(case) as solver:
        plan = solver.describe(predict=False)
    assert f"rms height {1e-8 * math.sqrt(math.pi / 2.0):.2E} m" in plan


def test_a_prediction_by_ra_shows_what_the_spectrum_does(tmp_path, capsys):
    text = SMALL + "&surface kind='fractal' ra=2e-8 pixels=128 /"
    (tmp_path / "case.nml").write_text(text)
    command = ["predict", str(tmp_path / "case.nml"), "-o", str(tmp_path / "out"), "--no-plots"]
    assert cli.main([*command, "--tracks", "1"]) == 0
    out = capsys.readouterr().out
    assert "spectrum   not determined by Ra; typical roll-offs: ground 100 um, honed 60 um" in out
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["status"] == "predicted"
    rows = summary["spectrum_beside"]
    assert [row["rolloff_wavelength_m"] for row in rows] == [30e-6, 100e-6, None]
    alone = text.replace("ra=2e-8", "ra=2e-8 rolloff_wavenumber=%r" % (2.0 * math.pi / 30e-6))
    one = predict(pyehl.Case.from_text(alone).resolve(), brief=True)
    assert rows[0]["mu_ratio"] == one.mu_ratio
    assert rows[0]["h_min_rough_m"] == one.summary["h_min_rough_m"]
    # without a roll-off the long waves are flattened, and the film is thickest
    assert rows[2]["h_min_rough_m"] > rows[0]["h_min_rough_m"]
    measured = pyehl.Case.from_text(text.replace("ra=2e-8", "rms_height=2e-8"))
    assert pyehl.predict(measured, tracks=1).summary["spectrum_beside"] is None
