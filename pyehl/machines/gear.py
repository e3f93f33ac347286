# SPDX-License-Identifier: BSD-3-Clause
"""Contacts along the path of contact of involute spur gears, from geometry, torque and speed.

Geometry of ISO 21771, external gears without tip relief; the pinion drives.
"""

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from pyehl.case.machine import Machine
from pyehl.machines.contact import MAX_ELLIPTICITY, Contact
from pyehl.theory.ellipse import ellipse
from pyehl.types import Array

# Negative backlash that is tolerated, and tip thickness of a pointed tooth, over the module
TOLERANCE = 1e-3
RPM = 2.0 * math.pi / 60.0
# R_x/R_y below which the ellipticity far exceeds `MAX_ELLIPTICITY`
MIN_RADIUS_RATIO = 1e-3
# Distance of the stations beside B and D from them, over the base pitch
STATION_OFFSET = 1e-6


@dataclass(frozen=True, slots=True)
class Mesh:
    """Geometry of a pair of gears; lengths in m.

    Attributes
    ----------
    centre_distance, working_angle
        Centre distance and working pressure angle of the pair [m], [rad].
    base
        Base radii of pinion and wheel.
    tips
        Tip radii.
    base_pitch
        p_b.
    ends
        Start A and end E of the path of contact, from the pitch point along the line of action.
    """

    centre_distance: float
    working_angle: float
    base: tuple[float, float]
    tips: tuple[float, float]
    base_pitch: float
    ends: tuple[float, float]

    @property
    def single(self) -> tuple[float, float]:
        """Part of the path on which one pair carries the load: B and D."""
        begin, end = self.ends
        return end - self.base_pitch, begin + self.base_pitch

    @property
    def contact_ratio(self) -> float:
        """Transverse contact ratio."""
        return (self.ends[1] - self.ends[0]) / self.base_pitch

    def radii(self, place: float) -> tuple[float, float]:
        """Radii of curvature of both flanks at a position on the path."""
        tangent = math.tan(self.working_angle)
        return self.base[0] * tangent + place, self.base[1] * tangent - place

    def load_share(self, place: float, sharing: str) -> float:
        """Fraction of the load that the pair at a position on the path carries.

        'linear': from 1/3 to 2/3 while two pairs are in mesh and back (ISO/TR 13989-1, unmodified
        profiles, accuracy grade 7 or better); 'equal': one half.
        """
        begin, end = self.ends
        first, last = self.single
        inside = 1e-12 * self.base_pitch
        if first - inside <= place <= last + inside:
            return 1.0
        if sharing == "equal":
            return 0.5
        part = (place - begin) / (first - begin) if place < first else (end - place) / (end - last)
        return (1.0 + part) / 3.0


@dataclass(frozen=True, slots=True)
class GearPair:
    """A pair of gears under its torque.

    Attributes
    ----------
    mesh
        Its geometry.
    input_power
        Torque times angular velocity of the pinion [W].
    angular_velocity
        Of the pinion [rad/s].
    contacts
        Contacts along the path of contact.
    places
        For each contact the distance from the pitch point [m], pinion angle [deg] and load share.
    facts
        Quantities of the pair by name.
    """

    mesh: Mesh
    input_power: float
    angular_velocity: float
    contacts: list[Contact] = field(default_factory=list)
    places: list[dict[str, Any]] = field(default_factory=list)
    facts: dict[str, float] = field(default_factory=dict)


def _involute(angle: float) -> float:
    return math.tan(angle) - angle


def _inverse_involute(value: float) -> float:
    from scipy.optimize import brentq  # noqa: PLC0415 (takes as long to load as all the rest)

    return float(brentq(lambda angle: _involute(angle) - value, 0.0, 1.5, xtol=1e-15))


def mesh_of(machine: Machine) -> Mesh:
    """Return the geometry of a pair; InputError names the key that prevents meshing."""
    v = machine.values
    machine.require("teeth_1", "teeth_2", "module", "face_width")
    teeth, shifts = (v.teeth_1, v.teeth_2), (v.profile_shift_1, v.profile_shift_2)
    alpha, m = math.radians(v.pressure_angle), v.module
    for i in (1, 2):
        minimum = 1.0 - 0.5 * teeth[i - 1] * math.sin(alpha) ** 2
        if shifts[i - 1] < minimum:
            what = (
                f"gear {i} with {teeth[i - 1]} teeth and a profile shift of {shifts[i - 1]:g} is "
            )
            expected = (
                f"profile_shift_{i} of at least {math.ceil(1e3 * minimum) / 1e3:g}, or more teeth"
            )
            key = f"profile_shift_{i}" if machine.is_given(f"profile_shift_{i}") else f"teeth_{i}"
            machine.refuse(key, f"{what}undercut by its rack", expected)
    standard = 0.5 * m * sum(teeth)
    value = _involute(alpha) + 2.0 * sum(shifts) / sum(teeth) * math.tan(alpha)
    if value <= 0.0:
        machine.refuse(
            "profile_shift_2", "the gears do not mesh with these profile shifts", "larger ones"
        )
    tight = standard * math.cos(alpha) / math.cos(_inverse_involute(value))
    distance = v.centre_distance or tight
    if distance < tight - TOLERANCE * m:
        what = f"a centre distance of {distance:.6g} m is less than without backlash"
        machine.refuse("centre_distance", what, f"{tight:.6g} m at least, by the profile shifts")
    working = math.acos(standard * math.cos(alpha) / distance)
    base = (0.5 * m * teeth[0] * math.cos(alpha), 0.5 * m * teeth[1] * math.cos(alpha))
    # tips are shortened so that the clearance is that of the basic rack
    shortening = distance - standard - m * sum(shifts)
    tips = [
        0.5 * given or 0.5 * m * z + m * (1.0 + x) + min(shortening, 0.0)
        for given, z, x in zip((v.tip_diameter_1, v.tip_diameter_2), teeth, shifts, strict=True)
    ]
    for i in (1, 2):
        _check_tip(machine, i, tips[i - 1], base[i - 1], teeth[i - 1], shifts[i - 1], alpha)
    tangent, pitch = math.tan(working), math.pi * m * math.cos(alpha)
    begin = base[1] * tangent - math.sqrt(tips[1] ** 2 - base[1] ** 2)
    end = math.sqrt(tips[0] ** 2 - base[0] ** 2) - base[0] * tangent
    for i, other, radius in ((1, 2, base[0] * tangent + begin), (2, 1, base[1] * tangent - end)):
        if radius <= 0.0:
            limit = 2.0 * math.hypot(base[other - 1], distance * math.sin(working))
            what = f"the tip of gear {other} reaches below the base circle of gear {i}"
            key = (
                f"tip_diameter_{other}"
                if machine.is_given(f"tip_diameter_{other}")
                else f"teeth_{i}"
            )
            machine.refuse(key, what, f"tip_diameter_{other} below {limit:.5g} m, or more teeth")
    mesh = Mesh(distance, working, base, (tips[0], tips[1]), pitch, (begin, end))
    if not 1.0 <= mesh.contact_ratio < 2.0:
        what = f"the contact ratio is {mesh.contact_ratio:.4g}"
        key = next(
            (
                k
                for k in ("centre_distance", "tip_diameter_1", "tip_diameter_2")
                if machine.is_given(k)
            ),
            "teeth_1",
        )
        machine.refuse(key, what, "1 to 2: other tip diameters or another centre distance")
    return mesh


def _check_tip(
    machine: Machine, i: int, tip: float, base: float, teeth: int, shift: float, alpha: float
) -> None:
    """Refuse a tip inside the base circle, and a pointed tooth."""
    key = f"tip_diameter_{i}" if machine.is_given(f"tip_diameter_{i}") else f"profile_shift_{i}"
    if tip <= base:
        machine.refuse(
            key, f"the tip of gear {i} is inside its base circle", f"{2 * base:.5g} m at least"
        )
    half = (0.5 * math.pi + 2.0 * shift * math.tan(alpha)) / teeth + _involute(alpha)
    thickness = 2.0 * tip * (half - _involute(math.acos(base / tip)))
    if thickness < TOLERANCE * machine.values.module:
        pointed = 2.0 * base / math.cos(_inverse_involute(half))
        what = f"the teeth of gear {i} are pointed at a tip diameter of {2.0 * tip:.5g} m"
        machine.refuse(key, what, f"less than {pointed:.5g} m, or a smaller profile shift")


def stations(mesh: Mesh, count: int) -> Array:
    """About `count` positions on the path [m], with A, B, D and E, evenly spaced between them.

    B and D occur twice, once with two pairs in mesh and once with one. The pitch point C is a
    station if it lies between B and D.
    """
    first, last = mesh.single
    begin, end = mesh.ends
    places: list[float] = []
    inner = [first, *([0.0] if first < 0.0 < last else []), last]
    for low, high in zip([begin, *inner], [*inner, end], strict=True):
        nodes = max(2, round(count * (high - low) / (end - begin)) + 1)
        part = np.linspace(low, high, nodes)
        if low == begin:
            part[-1] -= STATION_OFFSET * mesh.base_pitch
        elif high == end:
            part[0] += STATION_OFFSET * mesh.base_pitch
        elif places and low == 0.0:
            part = part[1:]
        places.extend(part.tolist())
    return np.array(places)


def gear_pair(machine: Machine) -> GearPair:
    """Return the contacts of a pair along its path of contact; InputError names an invalid key.

    With crowning a contact is an ellipse; without, or where the ellipse is longer than the face
    width, it is a line of the face width.
    """
    v = machine.values
    mesh = mesh_of(machine)
    machine.require("torque")
    omega = RPM * abs(v.speed)
    if omega == 0.0:
        machine.refuse("speed", "the gears do not turn: there is no film", "speed [1/min]")
    ratio = v.teeth_1 / v.teeth_2
    force = v.torque / mesh.base[0]
    # a crowning height C_b at the ends of the face width b gives the radius b^2/(8 C_b)
    across = [v.face_width**2 / (8.0 * c) if c else math.inf for c in (v.crowning_1, v.crowning_2)]
    pair = GearPair(mesh, v.torque * omega, omega)
    for number, place in enumerate(stations(mesh, v.stations)):
        one, two = mesh.radii(float(place))
        share = mesh.load_share(float(place), v.load_sharing)
        mean = 0.5 * omega * (one + ratio * two)
        # u1 - u2 = s (omega1 + omega2)
        slide = float(place) * omega * (1.0 + ratio) / mean
        where = f"station {number + 1}, {place * 1e3:.3f} mm from the pitch point"
        radii = (one, across[0], two, across[1])
        contact = Contact(where, share * force, mean, slide, radii)
        if not _is_ellipse(contact, machine.reduced_modulus, v.face_width):
            contact = Contact(where, share * force, mean, slide, radii, length=v.face_width)
        pair.contacts.append(contact)
        angle = math.degrees(float(place) / mesh.base[0])
        pair.places.append({"s_m": float(place), "pinion_angle_deg": angle, "load_share": share})
    pair.facts.update(
        centre_distance_m=mesh.centre_distance,
        working_angle_deg=math.degrees(mesh.working_angle),
        tip_diameter_1_m=2.0 * mesh.tips[0],
        tip_diameter_2_m=2.0 * mesh.tips[1],
        base_pitch_m=mesh.base_pitch,
        contact_ratio=mesh.contact_ratio,
        normal_force_N=force,
        input_power_W=pair.input_power,
    )
    return pair


def _is_ellipse(contact: Contact, modulus: float, width: float) -> bool:
    """Whether the ellipse of crowned flanks ends within the face width, and is not too long."""
    ratio = contact.radius_ratio
    if ratio < MIN_RADIUS_RATIO:
        return False
    shape = ellipse(ratio)
    cube = 1.5 * contact.load * contact.radius / (modulus * shape.load_factor)
    return (
        shape.ellipticity <= MAX_ELLIPTICITY and 2.0 * shape.ellipticity * cube ** (1 / 3) <= width
    )
