# SPDX-License-Identifier: BSD-3-Clause
"""Friction with the temperature of the film."""

import re

import numpy as np
import pytest

import pyehl
from pyehl.schema import summary_of

FILM, WALL_1, WALL_2 = (f"temperature_rise{part}_K" for part in ("", "_wall_1", "_wall_2"))
# Table 1 of Zhang et al. 2019, faster, with an Eyring stress of 5 MPa and the film of a Newtonian
# flow
FAST = {
    "contact.load": 600.0,
    "contact.mean_velocity": 5.0,
    "contact.radius": 0.018,
    "contact.reduced_modulus": 2.26e11,
    "contact.slide_to_roll": 0.3,
    "lubricant.viscosity": 0.04,
    "lubricant.pressure_viscosity": 2.2e-8,
    "lubricant.shear_law": "eyring",
    "lubricant.flow": "newtonian",
    "lubricant.temperature_viscosity": 0.04,
    "grid.x_inlet": -2.5,
    "grid.x_outlet": 1.5,
    "grid.y_extent": 2.0,
    "grid.border": "zero",
}


def test_agreement_with_another_program(solve, root):
    """The reference program has 0.0330, isothermal 0.0563; 69 K in the film, 35 K mean of walls."""
    done = solve(None, 257, FAST, words=True)
    assert done["mu_isothermal"] == pytest.approx(0.0563, rel=6e-3)
    assert done["mu"] == pytest.approx(0.0330, rel=6e-3)
    assert done["temperature_rise_max_K"] == pytest.approx(69.0, abs=0.6)
    walls = [done[f"temperature_rise_wall_{k}_max_K"] for k in (1, 2)]
    assert np.mean(walls) == pytest.approx(35.0, abs=0.6)
    # the faster wall removes more heat, and the formula applies to such a contact
    assert walls[0] < walls[1]
    assert done["flash_temperature_K"] == pytest.approx(np.mean(walls), rel=0.03)
    assert "temperature" in done["mu_note"]
    text = (root / "docs/theory/temperature.md").read_text(encoding="utf-8")
    for stated in (
        f"isothermal μ | {done['mu']:.4f}; {done['mu_isothermal']:.4f} |",
        f"| {done['temperature_rise_max_K']:.1f} K; {np.mean(walls):.1f} K |",
        f"Kennedy 1994 with μ = {done['mu']:.4f}: {done['flash_temperature_K']:.1f} K",
    ):
        assert stated in text
    heat = done["mu"] * done["hertz_pressure_Pa"] * 0.3 * 5.0
    assert heat == pytest.approx(1e8, rel=0.2)
    share = round(100.0 * (1.0 - done["mu"] / done["mu_isothermal"]), -1)
    warmer = f"up to {done['temperature_rise_max_K']:.0f} K warmer than the inlet"
    assert f"{warmer}, and friction is {share:.0f} % lower" in text


@pytest.mark.parametrize(("srr", "mu"), [(0.03, 0.043), (1.0, 0.021)])
def test_traction_rises_and_falls(solve, root, srr, mu):
    done = solve(None, 257, FAST | {"contact.slide_to_roll": srr})
    assert done["mu"] == pytest.approx(mu, abs=6e-4)
    text = (root / "docs/theory/temperature.md").read_text(encoding="utf-8")
    (row,) = re.findall(r"ratios 0.03; 1: μ with heat \| (.*?) \|", text)
    assert f"{done['mu']:.4f}" in row


def test_heat_of_slow_sliding_is_not_computed(solve):
    """At slow sliding heat is not computed, as it would change the friction negligibly."""
    slow = FAST | {"contact.slide_to_roll": 5e-5}
    left_out = solve(None, 65, slow, words=True)
    always = solve(None, 65, slow | {"lubricant.thermal_friction": "always"})
    assert "temperature_rise_max_K" not in left_out.summary
    assert "less than 0.1 %" in left_out["mu_note"]
    assert left_out["mu"] == left_out["mu_isothermal"] == always["mu_isothermal"]
    assert 0.999 * left_out["mu"] < always["mu"] < left_out["mu"]
    never = solve(None, 65, FAST | {"lubricant.thermal_friction": "never"}, words=True)
    assert never["mu"] == never["mu_isothermal"]
    assert "never" in never["mu_note"]


def test_which_wall_is_hot(solve):
    """A wall at rest, a wall of low conductivity; the direction of sliding."""
    standing = solve(None, 65, FAST | {"contact.slide_to_roll": 2.0}, fields=True)
    assert standing["temperature_rise_wall_2_max_K"] > 2 * standing["temperature_rise_wall_1_max_K"]
    glass = {"contact.thermal_conductivity_2": 1.0, "contact.thermal_diffusivity_2": 5e-7}
    on_glass = solve(None, 65, FAST | glass)
    steel = solve(None, 65, FAST)
    assert on_glass["temperature_rise_wall_2_max_K"] > 2 * steel["temperature_rise_wall_2_max_K"]
    assert on_glass["mu"] < steel["mu"]
    other = solve(None, 65, FAST | {"contact.slide_to_roll": -0.3})
    assert other["mu"] == pytest.approx(steel["mu"], rel=1e-9)
    assert other["temperature_rise_wall_1_max_K"] == pytest.approx(
        steel["temperature_rise_wall_2_max_K"], rel=1e-9
    )


def test_fields(solve):
    """Nodal temperatures: symmetric in Y, zero upstream of the contact, warm walls downstream."""
    done = solve(None, 65, FAST, fields=True)
    film, first, second = (done.field(name) for name in (FILM, WALL_1, WALL_2))
    assert film.max() == pytest.approx(done["temperature_rise_max_K"], rel=1e-12)
    assert np.array_equal(film, film[:, ::-1])
    x = np.linspace(-2.5, 1.5, 65)
    assert np.abs(film[x < -1.5]).max() < 0.1
    behind = (x > 1.2)[:, np.newaxis] & (np.abs(np.linspace(-2, 2, 65)) < 0.5)[np.newaxis, :]
    assert first[behind].min() > 5.0
    assert second[behind].min() > first[behind].min()


def test_elliptical_contact(solve):
    """Contacts that are wide across the motion and along it; heat flows within each row only."""
    wide = {"contact.radius_x": 0.01, "contact.radius_y": 0.04}
    long = {"contact.radius_x": 0.04, "contact.radius_y": 0.01}
    keys = {key: value for key, value in FAST.items() if key not in ("contact.radius",)}
    keys = {key: value for key, value in keys.items() if not key.startswith("grid.")}
    result = [solve(None, 65, keys | shape) for shape in (wide, long)]
    for done in result:
        walls = [done[f"temperature_rise_wall_{k}_max_K"] for k in (1, 2)]
        assert done["flash_temperature_K"] == pytest.approx(np.mean(walls), rel=0.03)
        assert 0.4 < done["mu"] / done["mu_isothermal"] < 0.9
    # the same load and heat, but over a longer distance
    assert (
        result[1]["temperature_rise_wall_1_max_K"]
        > 1.1 * result[0]["temperature_rise_wall_1_max_K"]
    )


def test_no_heat_twice(solve):
    """Shear heating of the inlet thins the film; the heat of the contact starts at zero."""
    warm = FAST | {"lubricant.thermal_reduction": True}
    done = solve(None, 65, warm)
    assert done["inlet_viscosity_Pa_s"] < 0.04
    # the same film by an oil as thin as that of the inlet; but that is thin in the contact, too
    viscosity = {"lubricant.viscosity": done["inlet_viscosity_Pa_s"]}
    z = {"lubricant.roelands_z": 2.2e-8 * 1.96e8 / (np.log(0.04) + 9.67)}
    thin = solve(None, 65, FAST | viscosity | z)
    assert thin["H_c"] == pytest.approx(done["H_c"], rel=1e-9)
    assert done["mu_isothermal"] > 1.005 * thin["mu_isothermal"]


WAVE = {"surface.kind": "harmonic", "surface.amplitude_over_film": 0.3, "surface.wavelength": 1.0}


@pytest.mark.parametrize("velocity", [1.15, 0.0])
def test_rough_contact(solve, velocity):
    """Ripples of pressure and film change friction with heat about as much as without it."""
    keys = {"surface.velocity_ratio": velocity, "contact.slide_to_roll": 0.3}
    if velocity == 0.0:
        keys |= {"contact.slide_to_roll": -2.0}
    done = solve(None, 65, FAST | WAVE | keys, fields=True, words=True)
    assert done["mu_isothermal"] == pytest.approx(
        done["mu_ratio"] * done["mu_smooth_isothermal"], rel=1e-12
    )
    assert done["mu"] < 0.8 * done["mu_isothermal"]
    slip = {"contact.slide_to_roll": keys["contact.slide_to_roll"]}
    smooth = solve(None, 65, FAST | slip)
    assert done["mu"] / smooth["mu"] == pytest.approx(done["mu_ratio"], rel=0.03)
    # a mu_smooth with heat times mu_ratio would not be mu
    assert done.summary.get("mu_smooth") is None
    assert "mu_isothermal = mu_ratio mu_smooth_isothermal" in done["mu_note"]
    assert done["temperature_rise_max_K"] == pytest.approx(done.field(FILM).max(), rel=1e-12)
    if velocity:
        history = done.history
        known = np.isfinite(history["heat_ratio"])
        known &= history["T"] >= done["T"] - done["T_mean"] - 1e-9
        assert known.sum() > 8
        mean = np.average(history["heat_ratio"][known], weights=history["mu_ratio"][known])
        assert done["mu"] / done["mu_isothermal"] == pytest.approx(mean, rel=2e-3)


@pytest.mark.parametrize(
    "radii",
    [(0.018, 0.018), (0.01, 0.04), pytest.param((0.04, 0.01), marks=pytest.mark.long)],
    ids=["circle", "wide", "narrow"],
)
def test_prediction_includes_the_heat(radii: tuple[float, float]):
    """The prediction applies the heat of its smooth contact, on its own grid."""
    keys = {
        key: value
        for key, value in FAST.items()
        if key != "contact.radius" and (not key.startswith("grid.") or key == "grid.border")
    }
    keys |= {"contact.radius_x": radii[0], "contact.radius_y": radii[1]}
    case = pyehl.Case.from_text("", keys | {"surface.kind": "fractal", "surface.pixels": 64})
    result = pyehl.predict(case).summary
    solved = summary_of(pyehl.solve(case.with_options("surface.kind=smooth", "grid.points=257")))
    assert result["mu_smooth"] / result["mu_smooth_isothermal"] == pytest.approx(
        solved["mu"] / solved["mu_isothermal"], rel=0.01
    )
    assert result["mu"] == pytest.approx(result["mu_ratio"] * result["mu_smooth"], rel=1e-12)
    assert result["temperature_rise_max_K"] == pytest.approx(
        solved["temperature_rise_max_K"], rel=0.02
    )
    # with the friction of the rough contact
    assert result["flash_temperature_K"] == pytest.approx(
        solved["flash_temperature_K"] * result["mu"] / solved["mu"], rel=1e-9
    )
