# SPDX-License-Identifier: BSD-3-Clause
"""Bearings and a gear pair as options, and calls with them."""

import pyehl
from pyehl.case.machine import read_machine
from pyehl.machines.bearing import ball_bearing, roller_bearing
from pyehl.machines.gear import gear_pair

E_STEEL = 2.06e11 / 0.91
BALLS = {
    "ball_bearing.bore": 0.03,
    "ball_bearing.outer_diameter": 0.062,
    "ball_bearing.ball_diameter": 9.525e-3,
    "ball_bearing.balls": 9,
    "ball_bearing.radial_load": 3000.0,
    "ball_bearing.inner_speed": 3000.0,
}
ROLLERS = {
    "roller_bearing.pitch_diameter": 0.046,
    "roller_bearing.roller_diameter": 9e-3,
    "roller_bearing.roller_length": 9e-3,
    "roller_bearing.rollers": 13,
    "roller_bearing.radial_load": 3000.0,
    "roller_bearing.inner_speed": 3000.0,
}
FZG = {
    "spur_gear.teeth_1": 16,
    "spur_gear.teeth_2": 24,
    "spur_gear.module": 4.5e-3,
    "spur_gear.profile_shift_1": 0.1817,
    "spur_gear.profile_shift_2": 0.1715,
    "spur_gear.centre_distance": 91.5e-3,
    "spur_gear.face_width": 14e-3,
    "spur_gear.torque": 372.6,
    "spur_gear.speed": 1450.0,
}
OIL = {
    "lubricant.name": "fva3",
    "lubricant.temperature": 60.0,
    "lubricant.shear_law": "eyring",
    "lubricant.eyring_stress": 6e6,
}
MAKERS = {"ball_bearing": ball_bearing, "roller_bearing": roller_bearing, "spur_gear": gear_pair}


def merged(*options):
    """Merge options; later ones replace earlier ones."""
    return {key: value for option in options for key, value in option.items()}


def bearing(*options, **execution):
    return pyehl.bearing(..., merged(*options), **execution)


def gear(*options, **execution):
    return pyehl.gear(..., merged(*options), **execution)


def made(*options):
    machine = read_machine(..., [merged(*options)], tuple(MAKERS))
    return machine, MAKERS[machine.kind](machine)


TAPERED = ROLLERS | {
    "roller_bearing.contact_angle": 15.0,
    "roller_bearing.roller_angle": 2.0,
    "roller_bearing.axial_load": 2000.0,
}
