# SPDX-License-Identifier: BSD-3-Clause
"""Bearings and gears: closed forms, limits, equilibrium, identities of kinematics, bad input."""

import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from document_text import fences, is_shown

import pyehl
from pyehl import cli
from pyehl.case.machine import read_machine
from pyehl.machines.bearing import TURN, ball_bearing, roller_bearing
from pyehl.machines.contact import CROSSED
from pyehl.machines.equilibrium import (
    BALL,
    ROLLER,
    azimuths,
    ball_stiffness,
    equilibrium,
    roller_stiffness,
)
from pyehl.machines.gear import gear_pair
from pyehl.machines.perform import Prepared
from pyehl.theory.ellipse import ellipse

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
    """Options of which the later ones replace the earlier ones."""
    return {key: value for option in options for key, value in option.items()}


def bearing(*options, **how):
    return pyehl.bearing(..., merged(*options), **how)


def gear(*options, **how):
    return pyehl.gear(..., merged(*options), **how)


def made(*options):
    machine = read_machine(..., [merged(*options)], tuple(MAKERS))
    return machine, MAKERS[machine.kind](machine)


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
    # the elements within the zone carry load, no others
    assert np.array_equal(
        ring.loads > 0.0, np.abs((psi + np.pi) % (2 * np.pi) - np.pi) < np.arccos(1 - 2 * eps)
    )


def test_five_f_over_z_is_that_of_some_clearance():
    """Stribeck's 5 F/Z lies between no clearance and that of a CN bearing with plenty of it."""
    found = [
        made(BALLS, {"ball_bearing.clearance": c})[1].facts["load_max_Z_over_F"]
        for c in (0.0, 1e-5, 5e-5, 1e-4)
    ]
    assert found == sorted(found)
    assert found[0] == pytest.approx(4.385, abs=0.005)  # nine balls, one under the load
    assert found[1] < 5.0 < found[2]
    # all of the load on one ball in the end
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
        # the approach of every element belongs to its load
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
    _, found = made(BALLS, options, {"ball_bearing.contact_angle": 25.0})
    angles, loads = found.ring.angles, found.ring.loads
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


TAPERED = ROLLERS | {
    "roller_bearing.contact_angle": 15.0,
    "roller_bearing.roller_angle": 2.0,
    "roller_bearing.axial_load": 2000.0,
}


def test_tapered_rollers():
    """Equilibrium from a small to a full load zone; Q = F_a/(Z sin alpha); cones on one apex."""
    least = 3000.0 * math.tan(math.radians(15.0))
    loaded = []
    for axial in (1.002 * least, 1.2 * least, 2.0 * least, 20.0 * least):
        _, found = made(TAPERED, {"roller_bearing.axial_load": axial})
        assert forces(found.ring) == pytest.approx((3000.0, axial), rel=1e-10)
        loaded.append(found.facts["elements_loaded"])
    assert loaded == sorted(loaded)
    assert (loaded[0], loaded[-1]) == (3.0, 13.0)
    _, found = made(TAPERED, {"roller_bearing.radial_load": 0.0})
    assert found.ring.loads == pytest.approx(2000.0 / (13 * math.sin(math.radians(15.0))))
    # three forces on a roller: both raceways and the flange, along its axis and across it
    load, flange = found.facts["load_max_N"], found.facts["flange_load_max_N"]
    outer, inner, axis = (math.radians(a) for a in (15.0, 11.0, 13.0))
    assert load * (math.cos(outer) - math.cos(inner)) == pytest.approx(-flange * math.sin(axis))
    assert load * (math.sin(outer) - math.sin(inner)) == pytest.approx(flange * math.cos(axis))
    # with the axial load of the load zone of the cylindrical bearing it is that
    _, straight = made(ROLLERS)
    angle = math.radians(1.0)
    thin = {"roller_bearing.contact_angle": 1.0, "roller_bearing.roller_angle": 0.0}
    axial = straight.ring.loads.sum() * math.tan(angle)
    _, nearly = made(TAPERED, thin, {"roller_bearing.axial_load": float(axial)})
    across = nearly.ring.loads * math.cos(angle)
    assert across == pytest.approx(straight.ring.loads, rel=1e-9, abs=1e-6)
    assert nearly.contacts[0].radius == pytest.approx(straight.contacts[0].radius, rel=1e-3)


def test_elements_at_the_edge_of_the_load_zone():
    """Hardly loaded ones are no reason to refuse the bearing; their bodies are rigid."""
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
    # a load that is none on every element is a slip of units
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
    """Both rings: u = omega d_m/4 (1 - (D/d_m)^2), and rolling seen from the cage."""
    for options, d in ((BALLS, 9.525e-3), (ROLLERS, 9e-3)):
        machine, found = made(options)
        gamma = d / 0.046
        omega = TURN * 3000.0
        expected = 0.25 * omega * 0.046 * (1.0 - gamma**2)
        assert [c.mean_velocity for c in found.contacts] == pytest.approx(
            [expected] * len(found.contacts)
        )
        cage = TURN * found.facts["cage_speed_per_min"]
        # seen from the cage, the raceways run by at the same velocity
        assert (omega - cage) * 0.5 * (0.046 - d) == pytest.approx(expected)
        assert cage * 0.5 * (0.046 + d) == pytest.approx(expected)
        # speeds of both rings count by their difference
        group = machine.kind
        both = {f"{group}.inner_speed": 1000.0, f"{group}.outer_speed": -2000.0}
        assert made(options, both)[1].contacts[0].mean_velocity == pytest.approx(expected)


def test_contacts_of_a_6206():
    """The radii of the drawing; both rings carry the same load."""
    _, found = made(BALLS)
    inner, outer = found.contacts[0], found.contacts[1]
    assert inner.radii == pytest.approx((4.7625e-3, 4.7625e-3, 18.2375e-3, -4.953e-3))
    assert outer.radii == pytest.approx((4.7625e-3, 4.7625e-3, -27.7625e-3, -5.04825e-3))
    assert inner.load == outer.load


def test_spin_of_an_angular_contact():
    _, found = made(BALLS, {"ball_bearing.axial_load": 2000.0, "ball_bearing.contact_angle": 25.0})
    for contact, place in zip(found.contacts, found.places, strict=True):
        angle = math.radians(place["contact_angle_deg"])
        expected = TURN * 3000.0 * math.sin(angle) if place["ring"] == "inner" else 0.0
        assert contact.spin == pytest.approx(expected)


def test_fzg_type_c():
    """Known geometry of the FZG test gears type C, and their Hertz pressure at the pitch point."""
    machine, pair = made(FZG)
    mesh = pair.mesh
    assert math.degrees(mesh.working_angle) == pytest.approx(22.44, abs=0.005)
    assert [2e3 * r for r in mesh.tips] == pytest.approx([82.46, 118.36], abs=0.01)
    assert mesh.contact_ratio == pytest.approx(1.44, abs=0.005)
    assert sum(mesh.radii(0.0)) * 1e3 == pytest.approx(34.92, abs=0.01)
    # without backlash the profile shifts have the same centre distance within 3 um
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
        speed = TURN * 1450.0
        for place, contact in zip(places, pair.contacts, strict=True):
            one, two = mesh.radii(place)
            assert one + two == pytest.approx(mesh.centre_distance * math.sin(mesh.working_angle))
            difference = contact.slide_to_roll * contact.mean_velocity
            sliding = place * speed * (1.0 + teeth[0] / teeth[1])
            assert difference == pytest.approx(sliding, abs=1e-12 * speed)
        # equal surface velocities where and only where the pitch point is
        assert pair.contacts[int(np.argmin(np.abs(places)))].slide_to_roll == 0.0
        # two pairs, a base pitch apart, carry the whole load between them
        for place in np.linspace(mesh.ends[0], mesh.single[0], 9)[1:-1]:
            both = [
                mesh.load_share(s, options["spur_gear.load_sharing"])
                for s in (place, place + mesh.base_pitch)
            ]
            assert sum(both) == pytest.approx(1.0)
        assert shares.max() == 1.0


def test_mean_friction_of_a_constant_coefficient():
    """With the same mu everywhere the mean is that mu, and the loss mu H_V P."""
    found = gear(FZG, OIL)
    table, s = found.table, found.summary
    sliding = table["load_N"] * (table["slide_to_roll"] * table["mean_velocity_m_per_s"]).abs()
    power = np.trapezoid(0.05 * sliding, table["s_m"]) / s["base_pitch_m"]
    assert power / (s["loss_factor"] * s["input_power_W"]) == pytest.approx(0.05)
    assert table["mu"].min() < s["mu_mean"] < table["mu"].max()
    # H_V of Ohlendorf for a load shared equally: pi (u+1)/(z1 u cos(beta)) (1 - eps + e1^2 + e2^2)
    equal = gear(FZG, OIL, {"spur_gear.load_sharing": "equal"}).summary
    pitch = equal["base_pitch_m"]
    _, pair = made(FZG)
    e_1, e_2 = pair.mesh.ends[1] / pitch, -pair.mesh.ends[0] / pitch
    ohlendorf = math.pi * 2.5 / (16 * 1.5) * (1.0 - equal["contact_ratio"] + e_1**2 + e_2**2)
    assert equal["loss_factor"] == pytest.approx(ohlendorf, rel=1e-3)


def test_a_crowned_flank_is_an_ellipse_until_it_is_longer_than_the_face():
    flat = made(FZG)[1]
    assert {c.shape for c in flat.contacts} == {"line"}
    crowned = made(FZG, {"spur_gear.crowning_1": 3e-4})[1]
    assert {c.shape for c in crowned.contacts} == {"ellipse"}
    assert crowned.contacts[0].radii[1] == pytest.approx(14e-3**2 / (8 * 3e-4))
    light = made(FZG, {"spur_gear.crowning_1": 1e-6})[1]
    assert {c.shape for c in light.contacts} == {"line"}


def test_friction_of_lines_and_ellipses():
    """Without heat: tau_0 asinh(eta u/(h tau_0)) over the mean pressure, integrated elsewhere."""
    options = {**FZG, **OIL, "lubricant.thermal_friction": "never"}
    for crowning, weight in ((0.0, 0.0), (3e-4, 1.0)):
        found = gear(options, {"spur_gear.crowning_1": crowning})
        row = found.table.iloc[5]
        oil = pyehl.Lubricant.from_name("fva3", 60.0)
        r = (np.arange(20000) + 0.5) / 20000
        pressure = row["hertz_pressure_Pa"] * np.sqrt(1.0 - r**2)
        speed = abs(row["slide_to_roll"]) * row["mean_velocity_m_per_s"]
        newton = oil.viscosity * oil.viscosity_ratio(pressure) * speed / row["h_c_m"]
        stress = 6e6 * np.arcsinh(newton / 6e6)
        ratio = np.average(stress, weights=r**weight) / np.average(pressure, weights=r**weight)
        assert row["mu"] == pytest.approx(ratio, rel=1e-4)
    # the heat takes friction away
    warm = gear(FZG, OIL)
    cold = gear(options)
    assert np.all((warm.table["mu"] < cold.table["mu"]) | warm.table["mu"].isna())


def test_friction_by_formulas_beside_solved_contacts(root: Path):
    """Within 3 %: crowned flanks on 129 nodes, whose films are 7 to 14 % thinner."""
    options = {
        "spur_gear.crowning_1": 2e-4,
        "spur_gear.torque": 40.0,
        "spur_gear.stations": 5,
        "grid.points": 129,
    }
    path = root / "cases" / "fzg_c.nml"
    formula, solved = (
        pyehl.gear(path, options, run=run, jobs=1).table for run in ("film", "solve")
    )
    assert set(solved["status"]) == {"converged"}
    ratio = (formula["mu"] / solved["mu"]).dropna()
    assert len(ratio) == len(formula) - 1
    assert ratio.between(0.97, 1.03).all()
    assert (formula["h_c_m"] / solved["h_c_m"]).between(1.0, 1.15).all()


def test_lines_are_solved(root: Path):
    """The page states 4 % for films and friction, and a mean coefficient of 0.0357."""
    page = (root / "docs" / "howto" / "gear.md").read_text()
    path = root / "cases" / "fzg_c.nml"
    options = {"spur_gear.stations": 9}
    formula, solved = (pyehl.gear(path, options, run=run, jobs=1) for run in ("film", "solve"))
    assert set(solved.table["shape"]) == {"line"}
    assert set(solved.table["status"]) == {"converged"}
    assert (formula.table["h_c_m"] / solved.table["h_c_m"]).between(0.96, 1.01).all()
    assert (formula.table["mu"] / solved.table["mu"]).dropna().between(0.96, 1.04).all()
    fine = pyehl.gear(path, options, {"grid.points": 1025}, run="solve", jobs=1).table
    error = solved.table["h_c_error_m"]
    assert ((fine["h_c_m"] - solved.table["h_c_m"]).abs() <= error).all()
    assert (error < 0.02 * solved.table["h_c_m"]).all()
    assert solved.summary["mu_mean"] == pytest.approx(0.0357, abs=2e-4)
    assert "0.0357" in page


def test_rollers_of_a_bearing_are_solved_and_predicted():
    """Of another material: the line has the reduced modulus of the bodies."""
    hybrid = {"bodies.modulus_1": 3.1e11, "bodies.poisson_1": 0.26}
    rollers = bearing(ROLLERS, hybrid, run="solve", jobs=1).table
    by_formula = bearing(ROLLERS, hybrid).table
    assert rollers["hertz_pressure_Pa"].to_numpy() == pytest.approx(by_formula["hertz_pressure_Pa"])
    steel = bearing(ROLLERS).table
    assert (by_formula["hertz_pressure_Pa"] > 1.05 * steel["hertz_pressure_Pa"]).all()
    # a prediction has the roughness on lines, too
    rough = {
        "surface.kind": "fractal",
        "surface.rms_height": 2e-8,
        "surface.pixels": 64,
        "grid.points": 257,
        "psd.positions": 2,
        # as much load on a roller, and fewer of them
        "roller_bearing.rollers": 5,
        "roller_bearing.radial_load": 1200.0,
    }
    predicted = bearing(ROLLERS, rough, run="predict", jobs=1).table
    assert set(predicted["status"]) == {"predicted"}
    assert (predicted["h_min_rough_m"] < predicted["h_min_m"]).all()


def test_rolling_resistance_beside_solved_contacts(root: Path):
    """Both formulas beside a 6204 with a short and a long inlet, as the page has it."""
    page = (root / "docs" / "howto" / "bearing.md").read_text()
    case = root / "cases" / "ball_bearing.nml"
    point = pyehl.OperatingPoint.from_settings(pyehl.Case(case).resolve())
    shape, radius, alpha = point.ellipse, point.radius, point.pressure_viscosity
    moment = 7.5 * shape.ellipticity**2 * shape.kernel_ratio**0.25 / point.moes_m
    load = 0.5 * math.pi * point.hertz_radius * point.hertz_pressure
    flow = alpha * point.viscosity * point.mean_velocity / radius
    line = 4.318 * radius / alpha * flow**0.658
    line *= (load / (point.reduced_modulus * radius)) ** 0.0126
    shares = []
    for inlet in (-2.5, -10.0):
        ds = pyehl.solve(case, {"grid.x_inlet": inlet})
        p, h = ds.P.values, ds.H.values
        middle = p.shape[1] // 2
        row = 0.25 * np.sum((h[1:, middle] + h[:-1, middle]) * np.diff(p[:, middle]))
        solved = row * point.hertz_pressure * point.film_scale
        shares.append((float(ds.rolling_moment) / moment, 1.0 - line / solved))
    assert "0.81 and 1.02 of it" in page
    assert [share for share, _ in shares] == pytest.approx([0.81, 1.02], abs=0.006)
    assert "11 to 30 %" in page
    assert [below for _, below in shares] == pytest.approx([0.11, 0.30], abs=0.006)


def test_trial_of_a_gear_pair():
    """302 N m, FVA 3 at 60 degC; ellipses of a made-up crown had 229 to 356 nm, 0.036 to 0.043."""
    found = gear(FZG, OIL, {"spur_gear.torque": 302.0})
    films = found.table["h_c_m"] * 1e9
    assert films.min() > 229.0
    assert films.max() < 1.15 * 356.0
    assert 0.033 < found.summary["mu_mean"] < 0.043


def test_sliding_in_a_groove():
    """Limits: an Eyring stress far below the Newtonian one; a spin alone turns with its torque."""
    options = {"lubricant.shear_law": "limiting", "lubricant.limiting_stress": 1e5}
    found = bearing(BALLS, options)
    row = found.table.iloc[0]
    # a constant stress k: P = k integral of |du|, du = c (y0^2 - y^2) with the y0 that balances
    inner = row["half_width_m"], row["half_width_m"] * row["ellipticity"]
    groove, ball = 0.52 * 9.525e-3, 0.5 * 9.525e-3
    factor = row["mean_velocity_m_per_s"] / row["radius_m"] * 0.25 * (1 / ball + 1 / groove)
    y = (np.arange(400000) + 0.5) / 400000 * inner[1]
    chord = 2.0 * inner[0] * np.sqrt(1.0 - (y / inner[1]) ** 2)
    share = np.cumsum(chord) / chord.sum()
    y_0 = y[np.searchsorted(share, 0.5)]
    power = 1e5 * 2.0 * np.sum(chord * factor * np.abs(y_0**2 - y**2)) * (y[1] - y[0])
    assert row["sliding_power_W"] == pytest.approx(power, rel=5e-3)
    # a Newtonian oil has no absolute friction
    newtonian = bearing(BALLS)
    assert math.isnan(newtonian.summary["torque_N_m"])
    assert newtonian.summary["rolling_torque_N_m"] > 0.0
    pair = gear(FZG)
    for found in (newtonian, pair):
        lines = repr(found).splitlines()
        assert sum("not reported: give a lubricant.shear_law" in line for line in lines) == 3
        assert not any("no result" in line or "nan" in line for line in lines)


def test_rolling_resistance_of_a_line():
    """Per length, whatever the length: 4.318 (alpha eta0 u/R)^0.658 W^0.0126 R/alpha."""
    short, long = (
        bearing(ROLLERS, {f"roller_bearing.{k}": v * f for k, v in
                      (("roller_length", 9e-3), ("radial_load", 3000.0))}).table.iloc[0]
        for f in (1.0, 2.0)
    )  # fmt: skip
    assert long["rolling_power_W"] == pytest.approx(2.0 * short["rolling_power_W"], rel=2e-3)


def test_solved_contacts_and_resuming(tmp_path: Path):
    """Formulas and solutions agree; mirrored balls are solved once; a second call runs nothing."""
    options = [
        BALLS,
        OIL,
        {"grid.points": 129},
        {"ball_bearing.balls": 5, "ball_bearing.radial_load": 100.0},
    ]
    by_formula = bearing(*options)
    folder = tmp_path / "out"
    solved = bearing(*options, run="solve", output=folder, jobs=1)
    assert set(solved.table["status"]) == {"converged"}
    assert solved.table["h_c_m"].to_numpy() == pytest.approx(by_formula.table["h_c_m"], rel=0.1)
    assert (solved.table["h_c_error_m"] > 0.0).all()
    assert solved.table["load_N"].to_numpy() == pytest.approx(by_formula.table["load_N"])
    names = {path.name for path in folder.iterdir()}
    assert {
        "contacts.csv",
        "summary.json",
        "contacts.png",
        "machine.nml",
        "journal.sqlite",
    } == names
    again = bearing(*options, run="solve", output=folder, jobs=1)
    assert again.table.equals(solved.table)
    with pytest.raises(pyehl.InputError, match="another study"):
        bearing(*options, {"ball_bearing.clearance": 1e-6}, run="solve", output=folder)
    with pytest.raises(pyehl.InputError, match="formulas would replace"):
        bearing(*options, output=folder)
    assert solved.data["h_c_m"].attrs["units"] == "m"


ANGULAR = {"ball_bearing.contact_angle": 25.0, "ball_bearing.axial_load": 1.0}
HIGH = {
    "spur_gear.teeth_2": 100,
    "spur_gear.centre_distance": 0.0,
    "spur_gear.tip_diameter_2": 0.466,
}
BAD = {
    "balls do not fit": (BALLS, {"ball_bearing.balls": 16}, "do not fit round", "at most 15"),
    "no rings": (BALLS, {"ball_bearing.ball_diameter": 0.02}, "leave no rings", "below 0.016"),
    "no pitch": (ROLLERS, {"roller_bearing.pitch_diameter": 0.0}, "not given", "bore"),
    "no load": (BALLS, {"ball_bearing.radial_load": 0.0}, "no load", "radial_load"),
    "no speed": (BALLS, {"ball_bearing.outer_speed": 3000.0}, "do not turn", "inner_speed"),
    "preload": (BALLS, {"ball_bearing.clearance": -5e-4}, "cannot be closed", "at least -"),
    "roller preload": (ROLLERS, {"roller_bearing.clearance": -5e-4}, "cannot be closed", "10 um"),
    "too loose": (BALLS, {"ball_bearing.clearance": 9e-4}, "contact angle exceeds", "at most"),
    "comes apart": (BALLS, {"ball_bearing.contact_angle": 25.0}, "come apart", "axial_load"),
    "angle and play": (
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


FILES = {
    "bearing_6206": ("bearing", "ball_bearing"),
    "bearing_nu206": ("bearing", "roller_bearing"),
    "fzg_c": ("gear", "spur_gear"),
}


@pytest.mark.parametrize("name", FILES)
def test_case_files_by_formulas(root: Path, tmp_path: Path, name: str, capfd):
    folder, (command, group) = tmp_path / "out", FILES[name]
    assert cli.main([command, str(root / "cases" / f"{name}.nml"), "-o", str(folder)]) == 0
    reported = capfd.readouterr().out
    for word in ("h_c [nm]", "Lambda", "left out", str(folder / "contacts.csv")):
        assert word in reported
    assert (folder / "contacts.png").stat().st_size > 10_000
    # the resolved group reads back as the same machine
    text = (folder / "machine.nml").read_text()
    assert text.startswith(f"&{group}\n")
    assert cli.main([command, str(folder / "machine.nml"), "-o", str(tmp_path / "again")]) == 0
    tables = [(place / "contacts.csv").read_text() for place in (folder, tmp_path / "again")]
    assert tables[0] == tables[1]
    assert cli.main(["report", str(folder)]) == 0
    shown = (folder / "report.html").read_text()
    for word in ("minimum Lambda", "left out", f"&amp;{group}", "data:image/png"):
        assert word in shown
    # the page is ours, and goes with the result
    assert (
        cli.main([command, str(folder / "machine.nml"), "-o", str(tmp_path / "more"), "--json"])
        == 0
    )
    assert '"kind": ' in capfd.readouterr().out


def test_the_path_of_contact_is_a_duty(root: Path, tmp_path: Path):
    """The table along the path, and a case that runs with it; B and D are steps of the load."""
    folder = tmp_path / "out"
    assert cli.main(["gear", str(root / "cases/fzg_c.nml"), "-q", "-o", str(folder)]) == 0
    table = pd.read_csv(folder / "contacts.csv")
    duty = pd.read_csv(folder / "duty.csv")
    columns = ["time [s]", "load [N/m]", "u1 [m/s]", "u2 [m/s]", "radius_x [m]"]
    assert list(duty.columns) == columns
    mean = 0.5 * (duty["u1 [m/s]"] + duty["u2 [m/s]"])
    np.testing.assert_allclose(
        (duty["u1 [m/s]"] - duty["u2 [m/s]"]) / mean, table["slide_to_roll"], atol=1e-9
    )
    np.testing.assert_allclose(duty["load [N/m]"] * 14e-3, table["load_N"], rtol=1e-9)
    # the contact goes along the line of action with the velocity of the base circle
    path = np.diff(table["s_m"]).sum()
    base = 4.5e-3 * 16 / 2 * math.cos(math.radians(20.0))
    whole = path / (base * 2.0 * math.pi * 1450.0 / 60.0)
    assert duty["time [s]"].iloc[-1] == pytest.approx(whole, rel=1e-6)
    case = pyehl.Case(folder / "duty.nml")
    np.testing.assert_allclose(case["duty"]["load"], duty["load [N/m]"], rtol=1e-12)
    data = pyehl.solve(case, {"grid.points": 257})
    assert float(data.duty_end_s) == pytest.approx(whole, rel=1e-6)
    # the minimum film is about that of the stations by formulas
    assert 0.6 < float(data.duty_h_c_min_m) / table["h_c_m"].min() < 1.2


@pytest.mark.parametrize("page", ["bearing", "gear"])
def test_pages_show_what_is_printed(root: Path, page: str, monkeypatch, capfd):
    monkeypatch.chdir(root)
    path = root / "docs" / "howto" / f"{page}.md"
    blocks = [text for language, text in fences(path) if language == "console"]
    for block in blocks:
        command, *shown = block.removeprefix("$ pyehl ").splitlines()
        assert cli.main(command.split()) == 0
        printed = capfd.readouterr().out.splitlines()
        missing = [s for s in shown if s != "..." and not any(is_shown(s, p) for p in printed)]
        assert not missing
    assert len(blocks) == 1


def test_prediction_needs_a_rough_surface():
    with pytest.raises(pyehl.InputError, match="both surfaces are smooth"):
        bearing(BALLS, run="predict")
    with pytest.raises(pyehl.InputError, match="did you mean 'solve'"):
        bearing(BALLS, run="slove")


@pytest.mark.parametrize("name", FILES)
def test_interrupted_before_any_contact(root: Path, name: str):
    """No film, no friction that needs it, and nothing in their place."""
    path = root / "cases" / f"{name}.nml"
    found = Prepared(path, [], (FILES[name][1],), "solve").result({})
    assert not found.complete
    assert set(found.table["status"]) == {"not run"}
    assert found.table[["h_c_m", "h_min_m"]].isna().all(axis=None)
    assert math.isnan(found.summary["h_min_m"])
    assert "minimum film                  not reported: a contact has no result" in repr(found)


def test_crown_of_a_nanometre_is_a_line():
    tables = [gear(FZG, OIL, {"spur_gear.crowning_1": crown}).table for crown in (0.0, 1e-9)]
    assert tables[0].equals(tables[1])


def test_formulas_that_contradict_each_other():
    """A minimum film above the central one, far beyond the ranges of both formulas, is noted."""
    options = {"lubricant.viscosity": 0.004, "ball_bearing.inner_speed": 100.0}
    for load, crossed in ((3000.0, True), (10.0, False)):
        table = bearing(BALLS, options, {"ball_bearing.radial_load": load}).table
        above = table["h_min_m"] > table["h_c_m"]
        assert above.any() == crossed
        assert (table["note"].str.contains(CROSSED) == above).all()


def test_pressure_above_the_static_limit_is_noted():
    for load, yields in ((3000.0, False), (30000.0, True)):
        found = bearing(BALLS, {"ball_bearing.radial_load": load})
        assert (found.summary["hertz_pressure_max_Pa"] > 4.2e9) == yields
        assert ("steel      yields" in repr(found)) == yields


@pytest.mark.parametrize(
    ("key", "value", "message"),
    [
        ("ball_bearing.radial_load", 3e6, "radial_load=3000000.*\n.*\n.*\\^"),
        ("ball_bearing.inner_speed", 1e6, "inner_speed=1000000.*\n.*\n.*\\^"),
        ("contact.shape", "line", "contact.shape follows from &ball_bearing"),
    ],
)
def test_refused_at_what_causes_it(root: Path, key: str, value: object, message: str):
    with pytest.raises(pyehl.InputError, match=message):
        pyehl.bearing(root / "cases" / "bearing_6206.nml", {key: value})
