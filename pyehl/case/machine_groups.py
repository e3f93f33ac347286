# SPDX-License-Identifier: BSD-3-Clause
"""Groups of a file that describes a machine element in place of one contact, key by key.

As of `pyehl.case.groups`; a zero that is allowed stands for "not given".
"""

from dataclasses import dataclass

from pyehl.case.key import real, whole, word

LENGTH = "0 or [1e-4, 10]"
SPEED = "[-1e6, 1e6]"


@dataclass(slots=True)
class BallBearing:
    """``&ball_bearing``: one row of balls, deep-groove or angular contact."""

    bore: float = real(0.0, "m", LENGTH, "bore, for the pitch diameter alone")
    outer_diameter: float = real(0.0, "m", LENGTH, "outside diameter, for the pitch diameter alone")
    pitch_diameter: float = real(
        0.0, "m", LENGTH, "of the circle of ball centres; 0: mean of bore and outside diameter"
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
        0.0, "deg", "0 or [1, 60]", "without load; 0: it follows from the clearance"
    )
    clearance: float = real(
        0.0,
        "m",
        "[-1e-3, 1e-3]",
        "radial internal clearance (diametral play) in operation; negative: preload",
    )
    radial_load: float = real(0.0, "N", "[0, 1e7]", "radial load of the bearing")
    axial_load: float = real(0.0, "N", "[0, 1e7]", "axial load of the bearing")
    inner_speed: float = real(0.0, "1/min", SPEED, "rotational speed of the inner ring")
    outer_speed: float = real(0.0, "1/min", SPEED, "rotational speed of the outer ring")


@dataclass(slots=True)
class RollerBearing:
    """``&roller_bearing``: one row of cylindrical or tapered rollers."""

    bore: float = real(0.0, "m", LENGTH, "bore, for the pitch diameter alone")
    outer_diameter: float = real(0.0, "m", LENGTH, "outside diameter, for the pitch diameter alone")
    pitch_diameter: float = real(
        0.0, "m", LENGTH, "of the circle of roller axes; 0: mean of bore and outside diameter"
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
    clearance: float = real(
        0.0,
        "m",
        "[-1e-3, 1e-3]",
        "radial internal clearance (diametral play) in operation; negative: preload",
    )
    radial_load: float = real(0.0, "N", "[0, 1e7]", "radial load of the bearing")
    axial_load: float = real(0.0, "N", "[0, 1e7]", "axial load, of tapered rollers")
    inner_speed: float = real(0.0, "1/min", SPEED, "rotational speed of the inner ring")
    outer_speed: float = real(0.0, "1/min", SPEED, "rotational speed of the outer ring")


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
        0.0, "m", LENGTH, "centre distance; 0: without backlash by the profile shifts"
    )
    tip_diameter_1: float = real(
        0.0, "m", LENGTH, "tip diameter of the pinion; 0: addendum of one module, tips shortened"
    )
    tip_diameter_2: float = real(0.0, "m", LENGTH, "tip diameter of the wheel; 0: as of the pinion")
    face_width: float = real(0.0, "m", "0 or [1e-4, 2]", "common face width")
    crowning_1: float = real(
        0.0, "m", "[0, 1e-3]", "crowning height of the pinion at the ends of the face width"
    )
    crowning_2: float = real(
        0.0, "m", "[0, 1e-3]", "crowning height of the wheel at the ends of the face width"
    )
    torque: float = real(0.0, "N m", "[0, 1e7]", "torque of the pinion")
    speed: float = real(0.0, "1/min", SPEED, "rotational speed of the pinion")
    load_sharing: str = word(
        "linear",
        "linear|equal",
        "load of two pairs in mesh: 1/3 to 2/3 linearly (ISO/TR 13989-1), or one half each",
    )
    stations: int = whole(25, "[5, 201]", "stations along the path of contact")
