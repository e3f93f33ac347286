# SPDX-License-Identifier: BSD-3-Clause
"""Many predictions: the numbers of single ones, and shared parts."""

import math
from pathlib import Path

import numpy as np
import pytest

import pyehl
from pyehl.contact import smooth
from pyehl.prediction.predict import predict
from pyehl.studies.tasks import TRACKS, Task, execute
from pyehl.surfaces import from_case as from_case_surface
from pyehl.theory.film import central_film
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint

# Cost of a prediction, which is no result
OWN = {"seconds", "wall_seconds"}
SMALL = ("surface.pixels=64",)
# A ratio, no film, pressures beyond a linear response, the model of the paper, a single wave
CASES = {
    "fractal": SMALL,
    "breakdown": (*SMALL, "surface.rms_height=6e-7"),
    "beyond": ("surface.pixels=128", "surface.rms_height=8e-8", "surface.hurst=0.3"),
    "paper": (*SMALL, "psd.reduction=amplitude", "psd.smooth=hertz"),
    "wave": ("surface.kind=harmonic", "lubricant.shear_law=eyring"),
}
STATUSES = {"breakdown": "film breakdown", "beyond": "beyond linear response"}


@pytest.mark.parametrize("name", CASES)
def test_a_row_is_the_summary_of_a_prediction(cases: Path, name: str):
    """Bit for bit, except for values over the tracks, and suggestions in the message."""
    case = pyehl.Case(cases / "table1.nml", *CASES[name])
    summary = pyehl.predict(case).summary
    row = execute(Task(0, case.text, "predict"))
    assert row["status"] == summary["status"] == STATUSES.get(name, "predicted")
    for key, value in row.items():
        # the assessment contains the message if there is no ratio
        if key not in OWN | {"message", "outside_range", "assessment"}:
            assert value == summary[key], key
    if name not in STATUSES:
        assert row["assessment"] == summary["assessment"]
    numbers = {k for k, v in summary.items() if v is None or isinstance(v, bool | int | float)}
    dropped = numbers - set(row)
    assert dropped <= {*TRACKS, *OWN, "film_breakdown", "schema_version", "surface_preparation"}
    assert set(TRACKS) <= dropped
    assert summary["message"].startswith(row["message"])


def test_assessment_of_a_ratio_beyond_linear_response(cases: Path):
    """Of the film, which is known; only the ratio is missing."""
    summary = pyehl.predict(cases / "table1.nml", *CASES["beyond"], tracks=1).summary
    assert summary["mu_ratio"] is None
    assert summary["lambda_ratio"] > 0.0
    word, _, reason = summary["assessment"].partition(": ")
    assert word in ("full film", "thin film")
    assert f"but mu_r/mu_s is not known: {summary['message']}" in reason


def test_tracks_are_there_where_they_are_asked_for(cases: Path):
    vary = {"surface.seed": [1, 2]}
    asked = ("mu_ratio", "mu_ratio_tracks", "mu_ratio_tracks_spread")
    result = pyehl.sweep(cases / "table1.nml", vary, *SMALL, run="predict", outputs=asked, jobs=1)
    alone = pyehl.predict(cases / "table1.nml", *SMALL, "surface.seed=2").summary
    for name in asked:
        assert float(result[name][1]) == alone[name]
    brief = pyehl.sweep(cases / "table1.nml", vary, *SMALL, run="predict", jobs=1)
    assert "mu_ratio_tracks" not in brief
    assert float(brief.mu_ratio[1]) == alone["mu_ratio"]
    assert float(brief.mu_ratio_cutoff_error[1]) == alone["mu_ratio_cutoff_error"]


def test_shared_parts_are_made_once(cases: Path):
    """Surface, slip and friction law leave the smooth contact unchanged; heat changes it."""
    base = pyehl.Case(cases / "table1.nml", *SMALL)
    execute(Task(0, base.text, "predict"))

    def shared(option: str) -> bool:
        """Whether the smooth contact was already solved."""
        before = smooth.solved_text.cache_info().misses
        execute(Task(0, base.with_options(option).text, "predict"))
        return smooth.solved_text.cache_info().misses == before

    for option in (
        "surface.seed=7",
        "lubricant.shear_law=limiting",
        "contact.slide_to_roll=0.1",
        "contact.thermal_conductivity=20",
        "lubricant.thermal_friction=never",
    ):
        assert shared(option), option
    assert not shared("contact.load=601")
    heated = ["lubricant.thermal_reduction=.true.", "lubricant.temperature_viscosity=0.03"]
    texts = [
        smooth.smooth_case(base.with_options(*heated, f"contact.slide_to_roll={s}").resolve())
        for s in (0.1, 0.2)
    ]
    assert texts[0] != texts[1]


def test_a_map_is_read_once(tmp_path: Path, monkeypatch):
    """For all cases with it, until its file changes or it is prepared in another way."""
    reads = []
    read = from_case_surface.read_scan
    monkeypatch.setattr(from_case_surface, "read_scan", lambda *a: reads.append(a) or read(*a))
    z = pyehl.surfaces.fractal(32, 1e-4, 1e-4, rms_height=1e-8, hurst=0.8).heights
    np.save(tmp_path / "map.npy", z)
    base = pyehl.Case.from_text(
        f"&surface kind = 'map', file = '{tmp_path / 'map.npy'}', length_x = 1e-4, "
        "length_y = 1e-4 /\n",
        ["psd.smooth=hertz"],
    )

    def ratio(*options: str) -> float:
        return execute(Task(0, base.with_options(*options).text, "predict"))["mu_ratio"]

    first = ratio()
    assert ratio("contact.load=500") != first
    assert ratio("surface.shortest_wavelength=2e-5") != first
    assert ratio("surface.track=3e-5") != first
    assert len(reads) == 1
    assert ratio("surface.detrend=tilt") != first
    assert len(reads) == 2
    np.save(tmp_path / "map.npy", 2.0 * z[::-1])
    assert ratio() != first
    assert len(reads) == 3


def test_brief_predictions_suggest_no_cut_off(cases: Path):
    case = pyehl.Case(cases / "table1.nml", *CASES["breakdown"])
    brief = predict(case.resolve(), case.text, brief=True)
    assert brief.advice is None
    assert math.isnan(brief.tracks[0])
    assert brief.below == pyehl.predict(case).below


def smooth_contact(moes_m: float) -> smooth.SmoothContact:
    return smooth.solve_contact(pyehl.Case.from_text("", [f"contact.moes_m={moes_m}"]).resolve())


def test_high_loads_take_a_finer_grid():
    """Above M = 2000 the usual grid gives no extrapolation, above 4000 no solution."""

    usual, high = smooth_contact(2000.0), smooth_contact(2500.0)
    assert "257 x 257 nodes, extrapolated" in usual.source
    assert "513 x 513 nodes, extrapolated" in high.source
    for contact, moes_m in ((usual, 2000.0), (high, 2500.0)):
        settings = pyehl.Case.from_text("", [f"contact.moes_m={moes_m}"]).resolve()
        point = OperatingPoint.from_settings(settings)
        formula = central_film(point, Lubricant.from_settings(settings)) / point.film_scale
        # the formula is accurate to 1 %; without extrapolation the film is 10 % too thin
        assert contact.central_film == pytest.approx(formula, rel=0.015)
    assert high.central_film_error < 0.05 * high.central_film


@pytest.mark.long
def test_a_load_beyond_all_grids_is_reported():
    with pytest.raises(pyehl.EhlError, match=r"on 1025 nodes along X: .*; reduce the load"):
        smooth_contact(60000.0)
