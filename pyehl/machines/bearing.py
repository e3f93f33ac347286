# SPDX-License-Identifier: BSD-3-Clause
"""Contacts of every element of a rolling bearing from its dimensions, loads and speeds.

Radii and speeds as in Harris & Kotzalas, *Essential Concepts of Bearing Technology*. Elements roll
freely: both surfaces of a contact have the same velocity.
"""

import math
from dataclasses import dataclass, field
from typing import Any

from pyehl.case.machine import Machine
from pyehl.machines.contact import Contact
from pyehl.machines.equilibrium import (
    BALL,
    ROLLER,
    Equilibrium,
    azimuths,
    ball_stiffness,
    equilibrium,
    roller_stiffness,
)
from pyehl.theory.ellipse import Ellipse, ellipse

RINGS = {"inner": 1.0, "outer": -1.0}
"""Rings, and the sign of the curvature of their raceways."""
# Maximum pressure at the static rating of bearings (ISO 76) [Pa]
STATIC_PRESSURE = {BALL: 4.2e9, ROLLER: 4.0e9}
# Largest contact angle without load [deg]
MAX_ANGLE = 60.0
# Relative excess of the axial load of a tapered bearing over that which loads a single roller
AXIAL_MARGIN = 1e-3
# Fraction of the largest load below which a contact may be too lightly loaded for the solver
LIGHT_FRACTION = 0.5
# Density of bearing steel [kg/m^3]
DENSITY = 7800.0
# rad/s per 1/min
RPM = 2.0 * math.pi / 60.0


@dataclass(frozen=True, slots=True)
class Bearing:
    """A bearing under its load.

    Attributes
    ----------
    speed
        Angular velocity of one ring relative to the other [rad/s].
    ring
        Equilibrium of the inner ring.
    contacts
        Loaded contacts.
    places
        For each contact the element, azimuth and contact angle [deg], and the ring.
    facts
        Quantities of the whole bearing by name.
    """

    speed: float
    ring: Equilibrium
    contacts: list[Contact] = field(default_factory=list)
    places: list[dict[str, Any]] = field(default_factory=list)
    facts: dict[str, float] = field(default_factory=dict)

    def add(self, number: int, azimuth: float, angle: float, ring: str, contact: Contact) -> None:
        """Add a contact; angles in rad."""
        self.contacts.append(contact)
        angles = {"azimuth_deg": math.degrees(azimuth), "contact_angle_deg": math.degrees(angle)}
        self.places.append({"element": number, "ring": ring, **angles})


def ball_bearing(machine: Machine) -> Bearing:
    """Return the contacts of a ball bearing; InputError names the key that does not fit."""
    v = machine.values
    machine.require("ball_diameter", "balls")
    d, pitch = v.ball_diameter, _pitch(machine, v.ball_diameter, v.balls, "balls")
    speed = _speed(machine)
    grooves = {"inner": v.osculation_inner * d, "outer": v.osculation_outer * d}
    centres = sum(grooves.values()) - d
    clearance = _ball_clearance(machine, centres)
    if v.radial_load == v.axial_load == 0.0:
        machine.refuse("radial_load", "the bearing has no load", "a radial_load or axial_load [N]")
    if v.axial_load == 0.0 and v.contact_angle > 0.0:
        what = "an angular-contact bearing without axial load: the rings separate"
        machine.refuse("contact_angle", what, "an axial_load above 0, at least the preload")
    free = math.acos(1.0 - 0.5 * clearance / centres) if clearance > 0.0 < v.axial_load else 0.0
    shapes: list[tuple[float, Ellipse]] = []
    for name, sign in RINGS.items():
        radius = 1.0 / (2.0 / d + 1.0 / _raceway(pitch, d, free, sign))
        shapes.append((radius, ellipse(radius * (2.0 / d - 1.0 / grooves[name]))))
    stiffness = ball_stiffness(machine.reduced_modulus, shapes)
    if clearance < 0.0:
        load = stiffness * (-0.5 * clearance) ** BALL
        radius, shape = shapes[0]
        a = (1.5 * load * radius / (machine.reduced_modulus * shape.load_factor)) ** (1.0 / 3.0)
        pressure = 1.5 * load / (math.pi * shape.ellipticity * a**2)
        # p_h is proportional to Q^(1/3), Q to delta^(3/2)
        _check_preload(machine, pressure, STATIC_PRESSURE[BALL], 2.0)
    ring = equilibrium(stiffness, BALL, v.balls, clearance, (v.radial_load, v.axial_load), centres)
    result, light = Bearing(speed, ring), LIGHT_FRACTION * float(ring.loads.max())
    for number, azimuth in enumerate(azimuths(v.balls)):
        load, angle = float(ring.loads[number]), float(ring.angles[number])
        if load == 0.0:
            continue
        u = 0.25 * speed * pitch * (1.0 - (d * math.cos(angle) / pitch) ** 2)
        for name, sign in RINGS.items():
            radii = (0.5 * d, 0.5 * d, _raceway(pitch, d, angle, sign), -grooves[name])
            # outer raceway control: only the inner contact spins (Jones 1959)
            spin = speed * math.sin(angle) if name == "inner" else 0.0
            place = f"ball {number + 1}, {name} ring"
            contact = Contact(place, load, u, 0.0, radii, spin=spin, may_be_light=load < light)
            result.add(number + 1, float(azimuth), angle, name, contact)
    _facts(machine, result, pitch, d, math.pi / 6.0 * d**3, free)
    result.facts.update(clearance_m=clearance, contact_angle_free_deg=math.degrees(free))
    return result


def roller_bearing(machine: Machine) -> Bearing:
    """Return the contacts of a cylindrical or tapered roller bearing; InputError as `ball_bearing`.

    Cones roll on each other about their common apex. The flange pushes along the axis of a tapered
    roller, so that both raceways carry the same load Q, and the flange 2 Q sin(roller_angle).
    """
    v = machine.values
    machine.require("roller_diameter", "roller_length", "rollers")
    d, pitch = v.roller_diameter, _pitch(machine, v.roller_diameter, v.rollers, "rollers")
    speed = _speed(machine)
    outer, half = math.radians(v.contact_angle), math.radians(v.roller_angle)
    loads = v.radial_load, v.axial_load
    _check_rollers(machine)
    angles = {"inner": outer - 2.0 * half, "outer": outer}
    axis = outer - half
    stiffness = roller_stiffness(machine.reduced_modulus, v.roller_length)
    u = 0.25 * speed * pitch * (1.0 - (d * math.cos(axis) / pitch) ** 2)

    def contact(place: str, load: float, name: str, max_load: float = 0.0) -> Contact:
        # radius of the cone in the plane normal to the raceway, at half the length of the roller
        raceway = 0.5 * (RINGS[name] * pitch - d * math.cos(axis)) / math.cos(angles[name])
        radii = (0.5 * d / math.cos(half), math.inf, raceway, math.inf)
        light = load < LIGHT_FRACTION * max_load
        return Contact(place, load, u, 0.0, radii, length=v.roller_length, may_be_light=light)

    if v.clearance < 0.0:
        load = stiffness * (-0.5 * v.clearance * math.cos(outer)) ** ROLLER
        pressure = contact("", load, "inner").line(machine.reduced_modulus).hertz_pressure
        # p_h is proportional to Q^(1/2), Q to delta^(10/9)
        _check_preload(machine, pressure, STATIC_PRESSURE[ROLLER], 2.0 / ROLLER)
    ring = equilibrium(stiffness, ROLLER, v.rollers, v.clearance, loads, angle=outer)
    result = Bearing(speed, ring)
    for number, azimuth in enumerate(azimuths(v.rollers)):
        load = float(ring.loads[number])
        for name, angle in angles.items() if load > 0.0 else ():
            one = contact(f"roller {number + 1}, {name} ring", load, name, ring.loads.max())
            result.add(number + 1, float(azimuth), angle, name, one)
    _facts(machine, result, pitch, d, 0.25 * math.pi * d**2 * v.roller_length, axis)
    result.facts["clearance_m"] = v.clearance
    if half > 0.0:
        result.facts["flange_load_max_N"] = 2.0 * math.sin(half) * result.facts["load_max_N"]
    return result


def _check_rollers(machine: Machine) -> None:
    """Refuse loads that the rollers cannot carry, and inconsistent angles."""
    v = machine.values
    if v.contact_angle == 0.0:
        machine.require("radial_load")
        for key in ("axial_load", "roller_angle"):
            if getattr(v, key) > 0.0:
                what = f"cylindrical rollers with {key} = {getattr(v, key):g}"
                machine.refuse(key, what, f"a contact_angle above 0, or {key} = 0")
        return
    if 2.0 * v.roller_angle > v.contact_angle:
        what = f"a roller_angle of {v.roller_angle:g} deg leaves no cone on the inner ring"
        machine.refuse("roller_angle", what, f"at most {0.5 * v.contact_angle:g} deg")
    minimum = v.radial_load * math.tan(math.radians(v.contact_angle))
    if v.axial_load <= minimum * (1.0 + AXIAL_MARGIN):
        what = f"an axial load of {v.axial_load:g} N: tapered rollers push the rings apart"
        machine.refuse(
            "axial_load", what, f"more than {minimum:.5g} N, from preload or counter bearing"
        )


def _raceway(pitch: float, element: float, angle: float, sign: float) -> float:
    """Radius of a raceway in the plane of rolling [m], at a contact angle [rad]."""
    return 0.5 * (sign * pitch / math.cos(angle) - element)


def _pitch(machine: Machine, element: float, count: int, elements: str) -> float:
    """Pitch diameter [m]; refuse elements that do not fit round it, or between shaft and housing.

    The bore and the outside diameter are those of catalogues; the rings lie between them.
    """
    v = machine.values
    pitch = v.pitch_diameter
    name = "ball_diameter" if elements == "balls" else "roller_diameter"
    if pitch == 0.0:
        if not (v.bore and v.outer_diameter):
            what = f"{machine.kind}.pitch_diameter is not given"
            expected = "pitch_diameter, or bore and outer_diameter, of which it is the mean"
            machine.refuse("pitch_diameter", what, expected)
        pitch = 0.5 * (v.bore + v.outer_diameter)
    if v.bore and v.outer_diameter:
        room = 0.5 * (v.outer_diameter - v.bore)
        if element >= room:
            what = f"{elements} of {element:.4g} m between a bore of {v.bore:.4g} m and "
            what += f"{v.outer_diameter:.4g} m outside leave no room for the rings"
            machine.refuse(name, what, f"{name} below {max(room, 0.0):.4g} m")
    if element >= pitch:
        what = f"{elements} of {element:.4g} m do not fit round a pitch diameter of {pitch:.4g} m"
        machine.refuse(name, what, f"{name} below {pitch:.4g} m")
    max_count = int(math.pi / math.asin(element / pitch))
    if count > max_count:
        what = f"{count} {elements} of {element:.4g} m do not fit round a pitch diameter of "
        machine.refuse(elements, f"{what}{pitch:.4g} m", f"at most {max_count} {elements}")
    return pitch


def _speed(machine: Machine) -> float:
    speed = RPM * abs(machine.values.inner_speed - machine.values.outer_speed)
    if speed == 0.0:
        what = "the rings do not turn relative to each other: there is no film"
        machine.refuse("inner_speed", what, "inner_speed or outer_speed [1/min]")
    return speed


def _ball_clearance(machine: Machine, centres: float) -> float:
    """Diametral clearance [m], given or from the contact angle; `centres` as in `equilibrium`."""
    v = machine.values
    limit = 2.0 * centres * (1.0 - math.cos(math.radians(MAX_ANGLE)))
    if v.contact_angle == 0.0:
        if v.clearance > limit:
            what = (
                f"a clearance of {v.clearance:.3g} m: the contact angle exceeds {MAX_ANGLE:g} deg"
            )
            machine.refuse("clearance", what, f"clearance of at most {limit:.3g} m; 10 um is 1e-5")
        return float(v.clearance)
    derived = 2.0 * centres * (1.0 - math.cos(math.radians(v.contact_angle)))
    if machine.is_given("clearance") and abs(v.clearance - derived) > 1e-3 * derived:
        what = f"a contact angle of {v.contact_angle:g} deg is a clearance of {derived:.4g} m"
        machine.refuse("clearance", f"{what}, not {v.clearance:.4g} m", "one of the two")
    return derived


def _check_preload(machine: Machine, pressure: float, limit: float, power: float) -> None:
    """Refuse a negative clearance, proportional to p_h^power, whose p_h exceeds a limit [Pa]."""
    if pressure > limit:
        minimum = machine.values.clearance * (limit / pressure) ** power
        what = (
            f"a clearance of {machine.values.clearance:.3g} m cannot be closed: without load the "
            f"Hertz pressure is {pressure / 1e9:.3g} GPa, more than the static limit of "
            f"{limit / 1e9:g} GPa (ISO 76)"
        )
        machine.refuse("clearance", what, f"clearance of at least {minimum:.2g} m; 10 um is 1e-5")


def _facts(
    machine: Machine, result: Bearing, pitch: float, d: float, volume: float, angle: float
) -> None:
    """Add quantities of the whole bearing; `volume` is that of an element [m^3], `angle` [rad]."""
    v, ring = machine.values, result.ring
    gamma = d * math.cos(angle) / pitch
    cage = 0.5 * (v.inner_speed * (1.0 - gamma) + v.outer_speed * (1.0 + gamma))
    max_load = float(ring.loads.max())
    result.facts.update(
        pitch_diameter_m=pitch,
        cage_speed_per_min=cage,
        displacement_radial_m=ring.radial,
        displacement_axial_m=ring.axial,
        load_max_N=max_load,
        elements_loaded=int((ring.loads > 0.0).sum()),
        centrifugal_force_N=DENSITY * volume * 0.5 * pitch * (RPM * cage) ** 2,
    )
    if v.radial_load > 0.0:
        result.facts["load_max_Z_over_F"] = max_load * len(ring.loads) / v.radial_load
