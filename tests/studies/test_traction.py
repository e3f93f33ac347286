# SPDX-License-Identifier: BSD-3-Clause
"""Traction curves, and an empirical law for thin films."""

import csv
import io
import math
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

import numpy as np
import pytest

import pyehl
from pyehl.cli import main
from pyehl.errors import InputError
from pyehl.studies.curve import WORDS
from pyehl.studies.curve_plan import plan_curve
from pyehl.studies.study import Axis
from pyehl.theory.load_share import AIHARA, LoadShare

# A ball on a disc with a mineral oil
BALL = """
&contact load = 36.0 mean_velocity = 2.5 /
&bodies radius_x1 = 9.525e-3 radius_y1 = 9.525e-3 /
&lubricant
   viscosity = 0.084 pressure_viscosity = 2.24e-8 temperature_viscosity = 0.05
   thermal_conductivity = 0.134 shear_law = 'eyring'
/
&grid points = 65 /
"""
SLIP = "contact.slide_to_roll"


def run(*words: str, expect: int = 0) -> str:
    reported, complaint = io.StringIO(), io.StringIO()
    with redirect_stdout(reported), redirect_stderr(complaint):
        status = main(["stribeck", *words, "--jobs", "1"])
    assert status == expect, reported.getvalue() + complaint.getvalue()
    return reported.getvalue() + complaint.getvalue()


def columns(folder: Path) -> dict[str, np.ndarray]:
    with (folder / "stribeck.csv").open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    names = [name for name in rows[0] if name not in WORDS]
    return {name: np.array([float(row[name] or "nan") for row in rows]) for name in names}


def test_traction_curve_has_three_regions(tmp_path: Path):
    """Proportional to slip at first, then nearly constant, then decreasing by heat."""
    (tmp_path / "ball.nml").write_text(BALL)
    (tmp_path / "measured.csv").write_text(f"{SLIP},mu\n0.1,0.033\n0.3,0.033\n")
    slips = "0,1e-7,2e-7,0.12,0.2,0.5"
    reported = run(
        *(str(tmp_path / "ball.nml"), "--slide-to-roll", slips, "-o", str(tmp_path / "out")),
        *("--measured", str(tmp_path / "measured.csv")),
    )
    result = columns(tmp_path / "out")
    mu, isothermal = result["mu"], result["mu_isothermal"]
    assert np.isnan(mu[0])
    assert mu[2] == pytest.approx(2.0 * mu[1], rel=1e-3)
    assert mu[4] == pytest.approx(mu[3], rel=0.02)
    assert mu[5] < 0.96 * mu[4]
    assert np.all(np.diff(isothermal[1:]) > 0.0)
    assert np.isnan(result["temperature_rise_max_K"][:3]).all()
    assert np.all(np.diff(result["temperature_rise_max_K"][3:]) > 0.0)
    assert (tmp_path / "out" / "stribeck.png").is_file()
    # the deviation at the two measured points on the curve, by hand
    there = np.interp([0.1, 0.3], result[SLIP][1:], mu[1:]) / 0.033 - 1.0
    assert f"off by {there.mean():+.1%} in the mean" in reported
    assert f"{np.sqrt(np.mean(there**2)):.1%} rms" in reported
    assert "2 of 2 points" in reported


def test_load_share_by_hand():
    law = LoadShare(0.12)
    assert law.share(0.0) == 1.0
    assert law.share(1.0) == pytest.approx(math.exp(-1.8))
    assert law.share(2.0) == pytest.approx(math.exp(-1.8 * 2.0**1.2))
    assert law.friction(0.0, 0.04) == 0.12
    assert law.friction(1.0, 0.04) == pytest.approx(0.04 + 0.08 * math.exp(-1.8))
    assert LoadShare(0.12, 2.32, 0.97).share(2.0) == pytest.approx(0.0107, rel=0.01)
    assert "Aihara" in law.words
    assert "Aihara" not in LoadShare(0.12, 2.32, 0.97).words


@pytest.mark.parametrize("numbers", [(0.0,), (1.5,), (0.1, -1.0), (0.1, 1.8, math.nan)])
def test_load_share_refuses(numbers):
    with pytest.raises(InputError, match="expected a number above 0"):
        LoadShare(*numbers)


@pytest.mark.long
def test_empirical_left_end(tmp_path: Path):
    """Thin films tend to boundary friction; without the flag there is no number."""
    (tmp_path / "ball.nml").write_text(
        BALL + "&surface kind = 'fractal' rms_height = 3e-7 shortest_wavelength = 1e-5 /\n"
    )
    words = (str(tmp_path / "ball.nml"), "--speed", "0.2,0.8,10", "--slide-to-roll", "0.05")
    words += ("--set", "grid.points=129")
    reported = run(*words, "-o", str(tmp_path / "out"), "--boundary-friction", "0.12", expect=0)
    result = columns(tmp_path / "out")
    ratio = result["lambda_ratio_central"]
    assert ratio[0] < 0.5
    assert ratio[2] > 4.0
    broken = np.isnan(result["mu"])
    assert broken.tolist() == [True, False, False]
    share = np.exp(-AIHARA[0] * ratio ** AIHARA[1])
    assert result["asperity_load_share_empirical"] == pytest.approx(share, rel=1e-12)
    expected = share * 0.12 + (1.0 - share) * result["mu"]
    assert result["mu_empirical"][~broken] == pytest.approx(expected[~broken], rel=1e-12)
    # after film breakdown the law uses the friction of the smooth contact
    assert share[0] * 0.12 < result["mu_empirical"][0] < share[0] * 0.12 + (1.0 - share[0]) * 0.06
    assert result["mu_empirical"][2] == pytest.approx(result["mu"][2], rel=0.01)
    assert "empirical: exp(-1.8 (h_c/sigma)^1.2)" in reported
    # the same curve with another law: nothing is computed again
    reported = run(*words, "-o", str(tmp_path / "out"), *("--boundary-friction", "0.1"))
    assert "6 of 6 tasks are done" in reported
    reported = run(*words, "-o", str(tmp_path / "out"))
    assert "empirical:" not in reported
    assert not [name for name in columns(tmp_path / "out") if "empirical" in name]


def test_roughness_of_the_second_surface_has_a_left_end():
    """The law needs a rough surface, on either body."""
    case = pyehl.Case.from_text(BALL + "&second_surface kind = 'fractal' rms_height = 3e-7 /\n")
    assert case.resolve()["surface"]["kind"] == "smooth"
    made = plan_curve(case, [Axis("contact.mean_velocity", (0.3, 0.6))], load_share=LoadShare(0.12))
    assert len(made.points) == 2


@pytest.mark.parametrize(
    ("option", "words"),
    [("surface.kind=smooth", "has no Lambda"), ("surface.kind=fractal", "a friction ratio only")],
)
def test_no_empirical_number(tmp_path: Path, option: str, words: str):
    case = pyehl.Case.from_text(BALL.replace("eyring", "newtonian"), [option])
    with pytest.raises(InputError, match=words):
        pyehl.stribeck(case, {"contact": {"mean_velocity": [0.3, 0.6]}}, boundary_friction=0.12)


@pytest.fixture(scope="module")
def stored(root: Path) -> dict[str, dict[str, np.ndarray]]:
    """The tables of docs/evidence/traction."""
    result = {}
    for name in ("traction", "empirical"):
        with (root / "docs" / "evidence" / "traction" / f"{name}.csv").open(newline="") as stream:
            rows = list(csv.DictReader(stream))
        names = [word for word in rows[0] if word not in WORDS]
        result[name] = {word: np.array([float(r[word] or "nan") for r in rows]) for word in names}
    return result


def test_the_table_is_what_a_run_gives(cases: Path, tmp_path: Path, stored):
    run(str(cases / "mtm.nml"), "--slide-to-roll", "0.125,0.5", "-o", str(tmp_path / "out"))
    result, t = columns(tmp_path / "out"), stored["traction"]
    assert set(result) == set(t)
    for k, slip in enumerate(result[SLIP]):
        row = int(np.argmin(np.abs(t[SLIP] - slip)))
        for name in ("mu", "mu_isothermal", "temperature_rise_max_K", "h_c_m"):
            assert result[name][k] == pytest.approx(t[name][row], rel=1e-4), name
