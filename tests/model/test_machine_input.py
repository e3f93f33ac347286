# SPDX-License-Identifier: BSD-3-Clause
"""Bearings and gears: bad input, and messages that name the key or the place in the file."""

from pathlib import Path

import pytest
from machine_options import BALLS, FZG, ROLLERS, TAPERED, bearing, gear

import pyehl
from pyehl import cli

ANGULAR = {"ball_bearing.contact_angle": 25.0, "ball_bearing.axial_load": 1.0}
HIGH = {
    "spur_gear.teeth_2": 100,
    "spur_gear.centre_distance": 0.0,
    "spur_gear.tip_diameter_2": 0.466,
}
BAD = {
    "balls do not fit": (BALLS, {"ball_bearing.balls": 16}, "do not fit round", "at most 15"),
    "no rings": (BALLS, {"ball_bearing.ball_diameter": 0.02}, "leave no room", "below 0.016"),
    "no pitch": (ROLLERS, {"roller_bearing.pitch_diameter": 0.0}, "not given", "bore"),
    "no load": (BALLS, {"ball_bearing.radial_load": 0.0}, "no load", "radial_load"),
    "no speed": (BALLS, {"ball_bearing.outer_speed": 3000.0}, "do not turn", "inner_speed"),
    "preload": (BALLS, {"ball_bearing.clearance": -5e-4}, "cannot be closed", "at least -"),
    "roller preload": (ROLLERS, {"roller_bearing.clearance": -5e-4}, "cannot be closed", "10 um"),
    "too loose": (BALLS, {"ball_bearing.clearance": 9e-4}, "contact angle exceeds", "at most"),
    "rings separate": (BALLS, {"ball_bearing.contact_angle": 25.0}, "rings separate", "axial_load"),
    "angle and clearance": (
        BALLS,
        ANGULAR | {"ball_bearing.clearance": 1e-5},
        "is a clearance of",
        "one of the two",
    ),
    "cylinders": (ROLLERS, {"roller_bearing.axial_load": 10.0}, "cylindrical", "contact_angle"),
    "cone": (TAPERED, {"roller_bearing.roller_angle": 8.0}, "no cone", "at most 7.5"),
    "apart by rollers": (TAPERED, {"roller_bearing.axial_load": 803.0}, "apart", "803.85"),
    "undercut": (FZG, {"spur_gear.profile_shift_1": -0.2}, "undercut", "at least 0.065"),
    "tight": (FZG, {"spur_gear.centre_distance": 0.0914}, "without backlash", "0.0915"),
    "apart": (FZG, {"spur_gear.centre_distance": 0.0955}, "contact ratio", "1 to 2"),
    "pointed": (FZG, {"spur_gear.tip_diameter_1": 0.0905}, "pointed", "less than"),
    "too high": (FZG, HIGH, "below the base circle", "tip_diameter_2 below 0.46"),
    "no torque": (FZG, {"spur_gear.torque": 0.0}, "torque is 0", "torque of the pinion"),
    "gear at rest": (FZG, {"spur_gear.speed": 0.0}, "do not turn", "speed"),
    "rivals": (BALLS, {"contact.load": 100.0}, "contradicts", "follows from"),
    "huge": (BALLS, {"ball_bearing.radial_load": 9e6}, "ball 1, inner ring", "1e5"),
    "misspelt": (BALLS, {"ball_bearing.bals": 9}, "unknown key", "did you mean 'balls'"),
    "range": (BALLS, {"ball_bearing.osculation_inner": 0.4}, "out of range", "0.501"),
}  # fmt: skip


@pytest.mark.parametrize("name", BAD)
def test_bad_input(name: str):
    options, change, *words = BAD[name]
    with pytest.raises(pyehl.InputError) as error:
        (gear if "spur_gear.module" in options else bearing)(options, change)
    for word in (*words, "expected: "):
        assert word in str(error.value), str(error.value)


FILE = """&ball_bearing
   pitch_diameter = 0.046
   ball_diameter = 9.525e-3
   balls = 17
   radial_load = 1000.0
   inner_speed = 1000.0
/
"""


def test_messages_point_into_the_file(tmp_path: Path, capfd: pytest.CaptureFixture[str]):
    path = tmp_path / "bearing.nml"
    path.write_text(FILE)
    assert cli.main(["bearing", str(path), "-o", str(tmp_path / "out")]) == 2
    reported = capfd.readouterr().err
    assert f"{path}:4:12: error: 17 balls" in reported
    assert "\n  4 |    balls = 17\n    |            ^^\nexpected: at most 15 balls" in reported
    assert not (tmp_path / "out").exists()
    assert cli.main(["gear", str(path)]) == 2
    assert "'pyehl bearing' takes it" in capfd.readouterr().err
    for command in ("check", "film"):
        assert cli.main([command, str(path)]) == 2
        assert "'pyehl bearing', or a case" in capfd.readouterr().err
    path.write_text("&contact load = 100.0 /\n")
    assert cli.main(["bearing", str(path)]) == 2
    assert "there is no &ball_bearing or &roller_bearing" in capfd.readouterr().err


def test_prediction_needs_a_rough_surface():
    with pytest.raises(pyehl.InputError, match="both surfaces are smooth"):
        bearing(BALLS, run="predict")
    with pytest.raises(pyehl.InputError, match="did you mean 'solve'"):
        bearing(BALLS, run="slove")


@pytest.mark.parametrize(
    ("key", "value", "message"),
    [
        ("ball_bearing.radial_load", 3e6, "radial_load=3000000.*\n.*\n.*\\^"),
        ("ball_bearing.inner_speed", 1e6, "inner_speed=1000000.*\n.*\n.*\\^"),
        ("contact.shape", "line", "contact.shape follows from &ball_bearing"),
    ],
)
def test_refusals_name_the_key_that_causes_them(root: Path, key: str, value: object, message: str):
    with pytest.raises(pyehl.InputError, match=message):
        pyehl.bearing(root / "cases" / "bearing_6206.nml", {key: value})
