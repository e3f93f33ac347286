# SPDX-License-Identifier: BSD-3-Clause
"""Bearings and gears: closed forms, limits, equilibrium, geometry, identities of kinematics."""

import math

import numpy as np
import pytest
from machine_options import BALLS, E_STEEL, FZG, ROLLERS, TAPERED, bearing, made

import pyehl
from pyehl.machines.bearing import RPM
from pyehl.machines.equilibrium import (
    BALL,
    ROLLER,
    azimuths,
    ball_stiffness,
    equilibrium,
    roller_stiffness,
)
from pyehl.theory.ellipse import ellipse


def forces(ring):
    """Radial and axial force of the elements of a ring."""
    across = ring.loads * np.cos(ring.angles) * np.cos(azimuths(len(ring.loads)))
    return across.sum(), (ring.loads * np.sin(ring.angles)).sum()


@pytest.mark.parametrize(("power", "stribeck"), [(BALL, 4.37), (ROLLER, 4.08)])
@pytest.mark.parametrize("count", [20, 200])
def test_stribeck_without_clearance(power, stribeck, count):
    """4.37 F/Z and 4.08 F/Z are the limits of many elements without clearance."""
    centres = 5e-4 if power == BALL else math.inf
    ring = equilibrium(1e10, power, count, 0.0, (1000.0, 0.0), centres)
    assert ring.loads.max() * count / 1000.0 == pytest.approx(stribeck, abs=0.006)
    # J_r(epsilon = 0.5): the integral of the load over the azimuth, in closed form
    integral = math.gamma(0.5 * power + 1.0) / math.gamma(0.5 * power + 1.5) / math.sqrt(math.pi)
    limit = equilibrium(1e10, power, 2000, 0.0, (1000.0, 0.0), centres)
    assert limit.loads.max() * 2000 / 1000.0 == pytest.approx(2.0 / integral, rel=1e-5)


@pytest.mark.parametrize(
    ("power", "axial", "largest"), [(BALL, 1.216, 4.37), (ROLLER, 1.260, 4.08)]
)
def test_half_load_zone_of_an_oblique_contact(power, axial, largest):
    """NSK Technical Report, CAT. No. E728g, 5.1, eqs. (4) and (5), as printed.

    With F_a = 1.216 F_r tan(alpha) in point contact, 1.260 in line contact, half of the elements
    carry load, and the largest is 4.37 F_r/(Z cos(alpha)), or 4.08.
    """
    count, angle, centres = 2000, math.radians(15.0), 5e-4
    load = 1000.0, 1000.0 * axial * math.tan(angle)
    if power == BALL:
        # stiff, so that the contact angle does not change
        play = 2.0 * centres * (1.0 - math.cos(angle))
        ring = equilibrium(1e14, power, count, play, load, centres)
    else:
        ring = equilibrium(1e10, power, count, 0.0, load, math.inf, angle)
    result = ring.loads.max() * count * math.cos(angle) / 1000.0
    assert result == pytest.approx(largest, abs=0.006)
    assert np.count_nonzero(ring.loads) == pytest.approx(count / 2, rel=0.01)


@pytest.mark.parametrize("power", [BALL, ROLLER])
def test_load_zone_by_clearance(power):
    """Q(psi) = Q_max (1 - (1 - cos psi)/(2 eps))^n, eps = (1 - P_d/(2 delta))/2 (Harris)."""
    count, clearance = 24, 2e-5
    stiffness = 1.5e10 if power == BALL else 3e8
    ring = equilibrium(stiffness, power, count, clearance, (3000.0, 0.0), math.inf)
    eps = 0.5 * (1.0 - 0.5 * clearance / ring.radial)
    assert 0.0 < eps < 0.5
    psi = azimuths(count)
    shape = np.maximum(1.0 - (1.0 - np.cos(psi)) / (2.0 * eps), 0.0) ** power
    assert ring.loads == pytest.approx(ring.loads.max() * shape, rel=1e-10, abs=1e-9)
    # only the elements within the zone carry load
    assert np.array_equal(
        ring.loads > 0.0, np.abs((psi + np.pi) % (2 * np.pi) - np.pi) < np.arccos(1 - 2 * eps)
    )


def test_five_f_over_z_is_that_of_some_clearance():
    """Stribeck's 5 F/Z is between zero clearance and a large clearance of a CN bearing."""
    result = [
        made(BALLS, {"ball_bearing.clearance": c})[1].facts["load_max_Z_over_F"]
        for c in (0.0, 1e-5, 5e-5, 1e-4)
    ]
    assert result == sorted(result)
    assert result[0] == pytest.approx(4.385, abs=0.005)  # nine balls, one under the load
    assert result[1] < 5.0 < result[2]
    # in the limit all of the load is on one ball
    wide = made(BALLS, {"ball_bearing.clearance": 4e-4, "ball_bearing.radial_load": 10.0})[1]
    assert wide.facts["load_max_Z_over_F"] == pytest.approx(9.0)


def test_equilibrium_of_random_bearings():
    random = np.random.default_rng(50)
    for _ in range(200):
        count = int(random.integers(3, 40))
        power = BALL if random.random() < 0.7 else ROLLER
        load = 10 ** random.uniform(0, 5), 10 ** random.uniform(0, 5)
        which = random.integers(3) if power == BALL else 0
        load = [(load[0], 0.0), (0.0, load[1]), load][which]
        stiffness = 10 ** random.uniform(9, 11)
        clearance = random.uniform(-2e-5, 8e-5)
        centres = 10 ** random.uniform(-4, -2.5) if power == BALL else math.inf
        ring = equilibrium(stiffness, power, count, clearance, load, centres)
        assert forces(ring) == pytest.approx(load, rel=1e-10, abs=1e-10 * ring.loads.sum())
        # the approach of every element gives its load
        across = 0.5 * -clearance + ring.radial * np.cos(azimuths(count))
        if power == BALL:
            approach = np.hypot(ring.axial, centres + across) - centres
        else:
            approach = across
        expected = stiffness * np.maximum(approach, 0.0) ** power
        assert ring.loads == pytest.approx(expected, rel=1e-6, abs=1e-6 * ring.loads.max())


def test_pure_axial_load_is_shared_equally():
    """Q = F_a/(Z sin alpha) with cos alpha = cos alpha_0/(1 + delta/A) (Harris)."""
    options = {"ball_bearing.radial_load": 0.0, "ball_bearing.axial_load": 2000.0}
    _, result = made(BALLS, options, {"ball_bearing.contact_angle": 25.0})
    angles, loads = result.ring.angles, result.ring.loads
    assert loads == pytest.approx(2000.0 / (9 * np.sin(angles)))
    assert np.all(np.degrees(angles) > 25.0)
    centres = 0.05 * 9.525e-3
    stiffness = (
        loads[0] / ((math.cos(math.radians(25.0)) / math.cos(angles[0]) - 1.0) * centres) ** 1.5
    )
    assert stiffness == pytest.approx(_stiffness(math.radians(25.0)), rel=1e-9)


def _stiffness(angle):
    d, pitch = 9.525e-3, 0.046
    shapes = []
    for sign, f in ((1.0, 0.52), (-1.0, 0.53)):
        raceway = 0.5 * (sign * pitch / math.cos(angle) - d)
        radius = 1.0 / (2.0 / d + 1.0 / raceway)
        shapes.append((radius, ellipse(radius * (2.0 / d - 1.0 / (f * d)))))
    return ball_stiffness(E_STEEL, shapes)


def test_tapered_rollers():
    """Equilibrium from a small to a full load zone; Q = F_a/(Z sin alpha); cones with one apex."""
    least = 3000.0 * math.tan(math.radians(15.0))
    loaded = []
    for axial in (1.002 * least, 1.2 * least, 2.0 * least, 20.0 * least):
        _, result = made(TAPERED, {"roller_bearing.axial_load": axial})
        assert forces(result.ring) == pytest.approx((3000.0, axial), rel=1e-10)
        loaded.append(result.facts["elements_loaded"])
    assert loaded == sorted(loaded)
    assert (loaded[0], loaded[-1]) == (3.0, 13.0)
    _, result = made(TAPERED, {"roller_bearing.radial_load": 0.0})
    assert result.ring.loads == pytest.approx(2000.0 / (13 * math.sin(math.radians(15.0))))
    # three forces on a roller: both raceways and the flange, along its axis and across it
    load, flange = result.facts["load_max_N"], result.facts["flange_load_max_N"]
    outer, inner, axis = (math.radians(a) for a in (15.0, 11.0, 13.0))
    assert load * (math.cos(outer) - math.cos(inner)) == pytest.approx(-flange * math.sin(axis))
    assert load * (math.sin(outer) - math.sin(inner)) == pytest.approx(flange * math.cos(axis))
    # with the axial load of the load zone of the cylindrical bearing it has the loads of that
    # bearing
    _, straight = made(ROLLERS)
    angle = math.radians(1.0)
    thin = {"roller_bearing.contact_angle": 1.0, "roller_bearing.roller_angle": 0.0}
    axial = straight.ring.loads.sum() * math.tan(angle)
    _, nearly = made(TAPERED, thin, {"roller_bearing.axial_load": float(axial)})
    across = nearly.ring.loads * math.cos(angle)
    assert across == pytest.approx(straight.ring.loads, rel=1e-9, abs=1e-6)
    assert nearly.contacts[0].radius == pytest.approx(straight.contacts[0].radius, rel=1e-3)


def test_elements_at_the_edge_of_the_load_zone():
    """Lightly loaded elements do not make the bearing invalid; their bodies are rigid."""
    oil = {"lubricant.viscosity": 0.3, "lubricant.shear_law": "eyring"}
    fast = {"roller_bearing.inner_speed": 9000.0, "roller_bearing.axial_load": 1150.0}
    for keys in (TAPERED | fast, BALLS | {"ball_bearing.axial_load": 900.0}):
        table = bearing(keys, oil).table
        assert table["h_c_m"].between(1e-8, 1e-3).all()
        assert (table["h_min_m"] <= table["h_c_m"]).all()
    table = bearing(TAPERED | fast, oil).table
    light = table[table["regime"] == "rigid-isoviscous"]
    assert 0 < len(light) < len(table)
    assert light["load_N"].max() < 0.1 * table["load_N"].max()
    # Martin 1916: h = 4.9 eta u R/w
    w = light["load_N"] / light["length_m"]
    film = 4.9 * 0.3 * light["mean_velocity_m_per_s"] * light["radius_m"] / w
    assert (light["h_min_m"] / film).between(1.0, 1.5).all()
    # a negligible load on every element indicates a mistake of units
    with pytest.raises(pyehl.InputError, match="Moes parameter M"):
        bearing(ROLLERS, oil, {"roller_bearing.radial_load": 0.1})


def test_hertz_stiffness():
    """Two equal circles in series: delta = 2 a^2/R with a^3 = 3 w R/(2 E')."""
    load, radius = 100.0, 0.01
    approach = 2.0 * (1.5 * load * radius / E_STEEL) ** (2 / 3) / radius
    assert ball_stiffness(E_STEEL, [(radius, ellipse(1.0))] * 2) == pytest.approx(
        load / approach**1.5
    )
    # Palmgren for each of two contacts: delta = 3.84e-5 Q^0.9/l^0.8 in N and mm, 4 % stiffer
    length = 9.0
    palmgren = 1000.0 / (2 * 3.84e-5 * 1000.0**0.9 / length**0.8 * 1e-3) ** (10 / 9)
    assert roller_stiffness(E_STEEL, length * 1e-3) == pytest.approx(palmgren, rel=0.04)


def test_velocities_of_a_bearing():
    """Both rings: u = omega d_m/4 (1 - (D/d_m)^2), and rolling in the frame of the cage."""
    for options, d in ((BALLS, 9.525e-3), (ROLLERS, 9e-3)):
        machine, result = made(options)
        gamma = d / 0.046
        omega = RPM * 3000.0
        expected = 0.25 * omega * 0.046 * (1.0 - gamma**2)
        assert [c.mean_velocity for c in result.contacts] == pytest.approx(
            [expected] * len(result.contacts)
        )
        cage = RPM * result.facts["cage_speed_per_min"]
        # in the frame of the cage, both raceways move at the same velocity
        assert (omega - cage) * 0.5 * (0.046 - d) == pytest.approx(expected)
        assert cage * 0.5 * (0.046 + d) == pytest.approx(expected)
        # only the difference of the speeds of the rings matters
        group = machine.kind
        both = {f"{group}.inner_speed": 1000.0, f"{group}.outer_speed": -2000.0}
        assert made(options, both)[1].contacts[0].mean_velocity == pytest.approx(expected)


def test_contacts_of_a_6206():
    """Radii from the drawing; both rings carry the same load."""
    _, result = made(BALLS)
    inner, outer = result.contacts[0], result.contacts[1]
    assert inner.radii == pytest.approx((4.7625e-3, 4.7625e-3, 18.2375e-3, -4.953e-3))
    assert outer.radii == pytest.approx((4.7625e-3, 4.7625e-3, -27.7625e-3, -5.04825e-3))
    assert inner.load == outer.load


def test_spin_of_an_angular_contact():
    _, result = made(BALLS, {"ball_bearing.axial_load": 2000.0, "ball_bearing.contact_angle": 25.0})
    for contact, place in zip(result.contacts, result.places, strict=True):
        angle = math.radians(place["contact_angle_deg"])
        expected = RPM * 3000.0 * math.sin(angle) if place["ring"] == "inner" else 0.0
        assert contact.spin == pytest.approx(expected)


def test_fzg_type_c():
    """Known geometry of the FZG test gears type C, and their Hertz pressure at the pitch point."""
    machine, pair = made(FZG)
    mesh = pair.mesh
    assert math.degrees(mesh.working_angle) == pytest.approx(22.44, abs=0.005)
    assert [2e3 * r for r in mesh.tips] == pytest.approx([82.46, 118.36], abs=0.01)
    assert mesh.contact_ratio == pytest.approx(1.44, abs=0.005)
    assert sum(mesh.radii(0.0)) * 1e3 == pytest.approx(34.92, abs=0.01)
    # with zero backlash the profile shifts give the same centre distance within 3 um
    tight = made(FZG, {"spur_gear.centre_distance": 0.0})[1].mesh
    assert tight.centre_distance == pytest.approx(91.5e-3, abs=6e-6)
    at = next(k for k, place in enumerate(pair.places) if place["s_m"] == 0.0)
    line = pair.contacts[at].line(machine.reduced_modulus)
    assert line.load_per_length == pytest.approx(
        372.6 / (0.036 * math.cos(math.radians(20))) / 14e-3
    )


def test_random_gears():
    """The pitch point rolls, u follows the gear ratio, the path is that of both tips."""
    random = np.random.default_rng(2026)
    for _ in range(60):
        teeth = [int(n) for n in random.integers(20, 80, 2)]
        shifts = random.uniform(0.0, 0.4, 2)
        angle = float(random.uniform(20.0, 25.0))
        options = FZG | {
            "spur_gear.teeth_1": teeth[0],
            "spur_gear.teeth_2": teeth[1],
            "spur_gear.pressure_angle": angle,
            "spur_gear.profile_shift_1": float(shifts[0]),
            "spur_gear.profile_shift_2": float(shifts[1]),
            "spur_gear.centre_distance": 0.0,
            "spur_gear.load_sharing": str(random.choice(["linear", "equal"])),
        }
        _, pair = made(options)
        mesh = pair.mesh
        places = np.array([p["s_m"] for p in pair.places])
        shares = np.array([p["load_share"] for p in pair.places])
        assert np.all(np.diff(places) > 0.0)
        assert (places[0], places[-1]) == pytest.approx(mesh.ends)
        speed = RPM * 1450.0
        for place, contact in zip(places, pair.contacts, strict=True):
            one, two = mesh.radii(place)
            assert one + two == pytest.approx(mesh.centre_distance * math.sin(mesh.working_angle))
            difference = contact.slide_to_roll * contact.mean_velocity
            sliding = place * speed * (1.0 + teeth[0] / teeth[1])
            assert difference == pytest.approx(sliding, abs=1e-12 * speed)
        # equal surface velocities only at the pitch point
        assert pair.contacts[int(np.argmin(np.abs(places)))].slide_to_roll == 0.0
        # two pairs, a base pitch apart, carry the whole load
        for place in np.linspace(mesh.ends[0], mesh.single[0], 9)[1:-1]:
            both = [
                mesh.load_share(s, options["spur_gear.load_sharing"])
                for s in (place, place + mesh.base_pitch)
            ]
            assert sum(both) == pytest.approx(1.0)
        assert shares.max() == 1.0


def test_a_crowned_flank_is_an_ellipse_until_it_is_longer_than_the_face():
    flat = made(FZG)[1]
    assert {c.shape for c in flat.contacts} == {"line"}
    crowned = made(FZG, {"spur_gear.crowning_1": 3e-4})[1]
    assert {c.shape for c in crowned.contacts} == {"ellipse"}
    assert crowned.contacts[0].radii[1] == pytest.approx(14e-3**2 / (8 * 3e-4))
    light = made(FZG, {"spur_gear.crowning_1": 1e-6})[1]
    assert {c.shape for c in light.contacts} == {"line"}
