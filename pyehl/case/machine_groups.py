# SPDX-License-Identifier: BSD-3-Clause
"""Groups of a file that describes a machine element in place of one contact, key by key.

As in `pyehl.case.groups`, 0 means "not given" for some keys.
"""

from dataclasses import dataclass
from typing import Any

from pyehl.case.key import real, whole, word

LENGTH = "0 or [1e-4, 10]"


def diameter(what: str) -> Any:  # noqa: ANN401
    """Describe a diameter whose mean with the other one is the pitch diameter."""
    return real(0.0, "m", LENGTH, f"{what}, used only for the pitch diameter")


def clearance() -> Any:  # noqa: ANN401
    """Describe the clearance of a bearing."""
    meaning = "radial internal clearance (diametral play) in operation; negative: preload"
    return real(0.0, "m", "[-1e-3, 1e-3]", meaning)


def load(meaning: str) -> Any:  # noqa: ANN401
    """Describe a load of a bearing."""
    return real(0.0, "N", "[0, 1e7]", meaning)


def speed(of: str) -> Any:  # noqa: ANN401
    """Describe the rotational speed of a part."""
    return real(0.0, "1/min", "[-1e6, 1e6]", f"rotational speed of the {of}")


@dataclass(slots=True)
class BallBearing:
    """``&ball_bearing``: one row of balls, deep-groove or angular contact."""

    bore: float = diameter("bore")
    outer_diameter: float = diameter("outside diameter")
    pitch_diameter: float = real(
        0.0,
        "m",
        LENGTH,
        "diameter of the circle of ball centres; 0: mean of bore and outside diameter",
    )
    ball_diameter: float = real(0.0, "m", LENGTH, "diameter of a ball")
    balls: int = whole(0, "0 or [3, 200]", "number of balls")
    osculation_inner: float = real(
        0.52, "-", "[0.501, 0.7]", "radius of the inner groove over the ball diameter"
    )
    osculation_outer: float = real(
        0.53, "-", "[0.501, 0.7]", "radius of the outer groove over the ball diameter"
    )
    contact_angle: float = real(
        0.0, "deg", "0 or [1, 60]", "contact angle without load; 0: it follows from the clearance"
    )
    clearance: float = clearance()
    radial_load: float = load("radial load of the bearing")
    axial_load: float = load("axial load of the bearing")
    inner_speed: float = speed("inner ring")
    outer_speed: float = speed("outer ring")


@dataclass(slots=True)
class RollerBearing:
    """``&roller_bearing``: one row of cylindrical or tapered rollers."""

    bore: float = diameter("bore")
    outer_diameter: float = diameter("outside diameter")
    pitch_diameter: float = real(
        0.0,
        "m",
        LENGTH,
        "diameter of the circle of roller axes; 0: mean of bore and outside diameter",
    )
    roller_diameter: float = real(0.0, "m", LENGTH, "diameter of a roller at half its length")
    roller_length: float = real(0.0, "m", LENGTH, "effective length of a roller")
    rollers: int = whole(0, "0 or [3, 400]", "number of rollers")
    contact_angle: float = real(
        0.0, "deg", "0 or [1, 45]", "half angle of a tapered outer raceway; 0: cylindrical"
    )
    roller_angle: float = real(
        0.0, "deg", "[0, 10]", "half of the included angle of a tapered roller"
    )
    clearance: float = clearance()
    radial_load: float = load("radial load of the bearing")
    axial_load: float = load("axial load, of tapered rollers")
    inner_speed: float = speed("inner ring")
    outer_speed: float = speed("outer ring")


@dataclass(slots=True)
class SpurGear:
    """``&spur_gear``: a pair of external involute spur gears; the pinion is gear 1."""

    teeth_1: int = whole(0, "0 or [5, 1000]", "number of teeth of the pinion, which drives")
    teeth_2: int = whole(0, "0 or [5, 1000]", "number of teeth of the wheel")
    module: float = real(0.0, "m", "0 or [1e-5, 0.1]", "module")
    pressure_angle: float = real(20.0, "deg", "[10, 35]", "pressure angle of the basic rack")
    profile_shift_1: float = real(
        0.0, "-", "[-2, 2]", "profile shift of the pinion over the module"
    )
    profile_shift_2: float = real(0.0, "-", "[-2, 2]", "profile shift of the wheel over the module")
    centre_distance: float = real(
        0.0, "m", LENGTH, "centre distance; 0: from the profile shifts, without backlash"
    )
    tip_diameter_1: float = real(
        0.0, "m", LENGTH, "tip diameter of the pinion; 0: addendum of one module, tips shortened"
    )
    tip_diameter_2: float = real(
        0.0, "m", LENGTH, "tip diameter of the wheel; 0: default as for the pinion"
    )
    face_width: float = real(0.0, "m", "0 or [1e-4, 2]", "common face width")
    crowning_1: float = real(
        0.0, "m", "[0, 1e-3]", "crowning height of the pinion at the ends of the face width"
    )
    crowning_2: float = real(
        0.0, "m", "[0, 1e-3]", "crowning height of the wheel at the ends of the face width"
    )
    torque: float = real(0.0, "N m", "[0, 1e7]", "torque of the pinion")
    speed: float = speed("pinion")
    load_sharing: str = word(
        "linear",
        "linear|equal",
        "load of two pairs in mesh: 1/3 to 2/3 linearly (ISO/TR 13989-1), or one half each",
    )
    stations: int = whole(25, "[5, 201]", "stations along the path of contact")
