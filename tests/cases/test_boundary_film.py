# SPDX-License-Identifier: BSD-3-Clause
"""Contact at a boundary film: full film, dry limit, mixed films."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from document_text import plain

import pyehl

DOMAIN = {"grid.x_inlet": -2.5, "grid.x_outlet": 1.5, "grid.y_extent": 2.0}
STEEL = DOMAIN | {
    "contact.load": 600.0,
    "contact.radius": 0.018,
    "contact.reduced_modulus": 2.26e11,
}
WAVE = {"surface.kind": "'harmonic'", "surface.wavelength": 0.5, "surface.amplitude": 0.02}
# Waves at rest: slide-to-roll ratio -2
REST = WAVE | {"contact.slide_to_roll": -2.0, "time.estimate_error": False}
MIXED = WAVE | {
    "contact.mean_velocity": 0.1,
    "contact.slide_to_roll": 1.0,
    "lubricant.shear_law": "'eyring'",
    "lubricant.boundary_film": 2e-8,
}
ELLIPSE = {"contact.radius_x": 0.018, "contact.radius_y": 0.036}


@pytest.mark.parametrize(
    "case",
    [
        {},
        WAVE | {"time.steps": 20},
        REST | {"surface.amplitude": 5e-3},
        {"lubricant.shear_law": "'eyring'"},
    ],
    ids=["smooth", "wave", "rest", "eyring"],
)
def test_full_film_changes_no_bit(solve, case):
    """A boundary film below every film of the contact changes no bit."""
    full = STEEL | {"contact.load": 20.0} | case
    without = solve(None, 65, full, fields=True)
    with_film = solve(None, 65, full | {"lubricant.boundary_film": 1e-9}, fields=True)
    assert without["status"] == with_film["status"]
    assert with_film["contact_load_share"] in (0.0, None)
    for name in ("P", "H"):
        assert (without.field(name) == with_film.field(name)).all()
    timed = {"bytes", "wall_seconds", "seconds_per_step", "files", "version", "case"}
    stated = {"contact_load_share", "contact_load_share_error", "contact_load_share_error_note"}
    stated |= {f"contact_load_share_error_{part}" for part in ("grid", "stop")}
    stated |= {"contact_area_share", "mass_defect", "mu_note", "boundary_film"}
    left = {k: v for k, v in without.summary.items() if k not in timed | stated}
    assert left == {k: v for k, v in with_film.summary.items() if k not in timed | stated}


def test_smooth_dry_limit_is_hertz(solve, root):
    """A boundary film five times as thick as the film of the inlet gives the Hertz contact."""
    slow = {"contact.mean_velocity": 0.05, "lubricant.boundary_film": 1e-7}
    done = solve(None, 257, STEEL | slow, fields=True, words=True)
    assert done.converged
    hertz = np.sqrt(np.maximum(0.0, 1.0 - done.field("X")[:, None] ** 2 - done.field("Y") ** 2))
    # a film of 1e-2 a^2/R changes the pressure at the edge
    off = np.sqrt(np.mean((done.field("P") - hertz)[hertz > 0.0] ** 2))
    assert f"that of Hertz within {within(off)} of $p_h$ (rms)" in theory(root, "contact")
    assert done["contact_load_share"] == pytest.approx(1.0, abs=5e-3)
    assert done["contact_area_share"] == pytest.approx(1.0, abs=2e-2)
    assert 0.0 < done["contact_load_share_error"] < 0.01
    # friction is only that of the boundary film, whose coefficient is not set
    assert (done["mu"], done["F"]) == (None, None)
    assert "lubricant.boundary_friction" in done["mu_note"]


def within(off: float) -> str:
    """A deviation in per cent, rounded up, as in the chapters of the theory."""
    return f"{np.ceil(1e3 * off) / 10.0:.1f} %"


def theory(root: Path, name: str) -> str:
    """Text of a chapter of the theory and of its record."""
    pages = f"theory/{name}.md", f"evidence/{name}/README.md"
    return "".join(plain(root / "docs" / page) for page in pages)


# Ball on disc in a traction machine: at 0.01 m/s the film in the limit of fine grids is 3.67 nm,
# above the boundary film of 2.47 nm under pressure
TRACTION = {
    "contact.load": 36.0,
    "contact.mean_velocity": 0.01,
    "contact.slide_to_roll": 0.5,
    "bodies.radius_x1": 9.525e-3,
    "bodies.radius_y1": 9.525e-3,
    "bodies.modulus_1": 2.07e11,
    "bodies.modulus_2": 2.07e11,
    "lubricant.kinematic_viscosity_40": 17.5,
    "lubricant.kinematic_viscosity_100": 3.9,
    "lubricant.density_15": 820.0,
    "lubricant.pressure_viscosity": 1.3e-8,
    "lubricant.shear_law": "'eyring'",
    "lubricant.eyring_stress": 4e6,
    "lubricant.boundary_film": 3e-9,
    "lubricant.boundary_friction": 0.1,
}


@pytest.mark.parametrize(
    "points",
    [
        *(129, 257),
        pytest.param(513, marks=pytest.mark.long),
        pytest.param(1025, marks=pytest.mark.slow),
    ],
)
def test_inlet_that_a_grid_does_not_resolve(solve, points):
    """No load share and no friction there; the error of the film is that by the inlet."""
    done = solve(None, points, TRACTION, words=True)
    assert done.converged
    for name in ("h_c_m", "h_c_error_m"):
        assert done[name] > 0.0
    assert abs(done["h_c_m"] - 3.67e-9) <= done["h_c_error_m"]
    if points == 1025:
        # 0.0487 with solver.accuracy = 1e-4 and 300 cycles
        assert done["contact_load_share"] == pytest.approx(0.05, abs=0.01)
        assert done["contact_load_share_error"] < 0.05
        assert done["contact_load_share_error_stop"] < 0.01
        assert done["mu"] < 0.02
        assert done["H_c_error"] < 0.1 * done["H_c"]
        return
    for name in ("contact_load_share", "contact_load_share_error", "mu", "mu_smooth", "F"):
        assert done[name] is None, name
    for name in ("contact_load_share_error", "mu", "H_c_error", "H_min_error", "F_error"):
        assert "grid.points = 1025 or more" in done[f"{name}_note"], name
    assert done["assessment"].startswith("unresolved inlet: ")


def test_target_error_refines_until_the_inlet_is_resolved(solve):
    """All grids up to 129 x 129 nodes give the boundary film, and agree."""
    touching = STEEL | {
        "contact.load": 100.0,
        "contact.mean_velocity": 0.1,
        "lubricant.boundary_film": 6.5e-8,
        "lubricant.boundary_friction": 0.1,
        "lubricant.shear_law": "'eyring'",
    }
    coarse = solve(None, 65, touching)
    assert coarse["contact_load_share"] is None
    done = solve(None, 65, touching | {"grid.target_error": 0.1, "grid.max_points": 513})
    assert done["points"] > 129
    assert done["contact_load_share"] < 0.9
    assert done["H_c_error"] < 0.1 * done["H_c"]
    assert abs(coarse["H_c"] - done["H_c_extrapolated"]) <= coarse["H_c_error"]


SLOW = {
    "contact.load": 3.22617,
    "contact.mean_velocity": 0.010996,
    "contact.radius": 0.0095,
    "contact.reduced_modulus": 2.26e11,
    "contact.slide_to_roll": 0.5,
    "lubricant.viscosity": 0.03,
    "lubricant.pressure_viscosity": 2e-8,
    "lubricant.shear_law": "'eyring'",
    "lubricant.boundary_film": 1.15883e-8,
    "lubricant.boundary_friction": 0.1,
}


@pytest.mark.parametrize(
    "points",
    [pytest.param(257, marks=pytest.mark.long), pytest.param(513, marks=pytest.mark.slow)],
)
def test_load_share_that_changes_slowly(solve, points):
    """The film is little thicker than the boundary film: the error includes the remaining residual.

    0.501 to 0.519 on 513 to 1025 nodes with residuals below 1e-5; the final value on 513 is 0.96.
    """
    done = solve(None, points, SLOW)
    assert done.converged
    assert done["contact_load_share_error_stop"] > 0.0
    assert abs(done["contact_load_share"] - 0.51) <= done["contact_load_share_error"]


HOT = STEEL | {
    "contact.load": 100.0,
    "contact.mean_velocity": 2.0,
    "contact.slide_to_roll": 0.3,
    "lubricant.shear_law": "'eyring'",
    "lubricant.temperature_viscosity": 0.04,
}
TEMPERATURES = tuple(f"temperature_rise{part}_max_K" for part in ("", "_wall_1", "_wall_2"))


@pytest.mark.parametrize("case", [{}, WAVE | {"time.steps": 20}], ids=["smooth", "wave"])
def test_boundary_film_without_contact_changes_no_bit_of_friction_with_heat(solve, case):
    """A boundary film does not switch the heat off."""
    light = HOT | case | {"contact.load": 20.0}
    without = solve(None, 65, light, words=True)
    boundary = {"lubricant.boundary_film": 1e-8, "lubricant.boundary_friction": 0.1}
    with_film = solve(None, 65, light | boundary, words=True)
    assert with_film["contact_load_share"] in (0.0, None)
    for name in ("mu", "mu_isothermal", "mu_smooth", "mu_smooth_isothermal", *TEMPERATURES):
        assert with_film[name] == without[name], name
    assert with_film["mu_note"] == without["mu_note"]
    assert without["mu_smooth"] < 0.9 * without["mu_smooth_isothermal"]
    if case:
        ratio = with_film.history["heat_ratio"]
        assert np.array_equal(ratio, without.history["heat_ratio"], equal_nan=True)


def test_friction_of_the_boundary_film_is_heat(solve):
    """The contact is dry nearly everywhere: the flash temperature agrees with Tian & Kennedy."""
    boundary = {"lubricant.boundary_film": 1.5e-6, "lubricant.boundary_friction": 0.1}
    done = solve(None, 129, HOT | boundary)
    assert done["contact_load_share"] > 0.9
    # the boundary film does not depend on the temperature
    assert done["mu"] == pytest.approx(done["mu_isothermal"], rel=0.01)
    assert done["mu"] == pytest.approx(0.1 * done["contact_load_share"], rel=0.05)
    walls = [done[name] for name in TEMPERATURES[1:]]
    assert np.mean(walls) == pytest.approx(done["flash_temperature_K"], rel=0.05)
    # half the friction, half the heat
    half = solve(None, 129, HOT | boundary | {"lubricant.boundary_friction": 0.05})
    for name in TEMPERATURES[1:]:
        assert half[name] == pytest.approx(0.5 * done[name], rel=0.03)


def test_solid_contact_heats_the_film_around_it(solve):
    """Friction of the film falls as the friction of the boundary film rises."""
    mixed = HOT | {"lubricant.boundary_film": 5e-7}
    result = [
        solve(None, 129, mixed | {"lubricant.boundary_friction": mu}) for mu in (0.05, 0.1, 0.2)
    ]
    share = result[0]["contact_load_share"]
    assert 0.02 < share < 0.95
    assert {done["contact_load_share"] for done in result} == {share}
    film = [done["mu"] - mu * share for done, mu in zip(result, (0.05, 0.1, 0.2), strict=True)]
    assert film[0] > film[1] > film[2] > 0.0


@pytest.mark.long
@pytest.mark.parametrize(
    ("load", "velocity", "boundary", "height"),
    [(600.0, 0.005, 4e-8, 0.05), (600.0, 0.05, 4e-8, 0.05), (100.0, 0.05, 4e-8, 0.03)],
)
def test_islands_at_rest_converge_on_fine_grids(solve, load, velocity, boundary, height):
    """Lubricant between touching nodes takes more cycles to leave than the default limit."""
    island = {
        "contact.load": load,
        "contact.mean_velocity": velocity,
        "surface.amplitude": height,
        "lubricant.boundary_film": boundary,
    }
    done = solve(None, 257, STEEL | REST | island)
    assert done.converged
    assert 0.2 < done["contact_load_share"] < 0.8


def of_shape(settings: dict) -> dict:
    """Remove what an ellipse determines: the domain, and the one radius."""
    if "contact.radius_x" not in settings:
        return settings
    return {k: v for k, v in settings.items() if k not in DOMAIN and k != "contact.radius"}


def test_mixed_film(solve):
    """Load share with its error by the coarser grid; friction between film and boundary film."""
    known = MIXED | {
        "contact.load": 100.0,
        "lubricant.boundary_film": 4e-8,
        "lubricant.boundary_friction": 0.1,
        "surface.amplitude": 0.03,
    }
    fine = solve(None, 129, STEEL | known, fields=True, words=True)
    assert fine.converged
    share = fine["contact_load_share"]
    assert 0.02 < share < 0.05
    same = solve(None, 65, STEEL | known | {"surface.amplitude": fine["amplitude"]})
    difference = abs(share - same["contact_load_share"])
    assert fine["contact_load_share_error_grid"] == pytest.approx(difference, rel=1e-2)
    parts = [fine[f"contact_load_share_error_{part}"] for part in ("grid", "stop")]
    assert fine["contact_load_share_error"] == pytest.approx(sum(parts))
    assert 0.0 < parts[1] < 0.05 * share
    first = -round(fine["T_mean"] / fine["x_mesh"])
    assert fine.history["load_share"][first:].mean() == pytest.approx(share, rel=0.05)
    # the boundary film has a share of the friction, and the film has a positive one
    assert 0.1 * share < fine["mu"] < 0.1
    # no film is thinner than the boundary film, which is compressed as the lubricant is
    pressure = fine.field("P") * fine["hertz_pressure_Pa"]
    density = (5.9e8 + 1.34 * pressure) / (5.9e8 + pressure)
    assert (density * fine.field("H")).min() >= 0.99 * fine["boundary_film"]
    # pressure as it enters the load balance
    assert abs(fine["load_error"]) <= 1e-6
    assert fine["contact_load_share_error_note"] == ""
    without = STEEL | known | {"lubricant.boundary_friction": 0.0}
    unknown = solve(None, 65, without | {"surface.amplitude": fine["amplitude"]}, words=True)
    # the run ends with another friction, so that the mean is over other steps
    assert unknown["contact_load_share"] == pytest.approx(same["contact_load_share"], rel=0.05)
    assert unknown["mu_ratio"] is None
    assert unknown["mu"] is None
    assert "lubricant.boundary_friction" in unknown["mu_ratio_error_note"]


@pytest.mark.long
def test_single_nodes_that_touch(solve):
    """High waves that touch at a few nodes each."""
    high = {
        "contact.load": 200.0,
        "contact.mean_velocity": 0.2,
        "lubricant.boundary_film": 8e-8,
        "surface.amplitude": 0.05,
        "time.estimate_error": False,
    }
    done = solve(None, 129, STEEL | MIXED | high)
    assert done.converged
    assert 0.02 < done["contact_load_share"] < 0.08


@pytest.mark.long
def test_contact_of_a_coarse_grid(solve):
    """Where a grid does not resolve the inlet the bodies touch, and no error is reported."""
    done = solve(None, 129, STEEL | MIXED, words=True)
    assert done.converged
    assert done["contact_load_share"] > 0.1
    assert done["contact_load_share_error"] is None
    assert "does not resolve the inlet" in done["contact_load_share_error_note"]
    assert done["assessment"].startswith("mixed film: ")
    assert "an error that is not known" in done["assessment"]


def test_a_boundary_film_with_a_large_mass_defect(solve):
    """A thick boundary film on a coarse grid: the assessment states that the model ends there."""
    done = solve(None, 65, STEEL | MIXED | {"lubricant.boundary_film": 8e-8}, words=True)
    assert done.converged
    assert done["mass_defect"] > 0.1
    assert "the boundary film would have to supply" in done["assessment"]
    assert "where the model ends" in done["assessment"]


@pytest.mark.long
def test_no_error_where_the_mass_defect_is_large(solve):
    """Two grids give no error of the load share of a wave of the stress campaign."""
    wave = {
        "contact.load": 220.65341,
        "contact.mean_velocity": 3.8854007,
        "contact.slide_to_roll": 0.0,
        "lubricant.eyring_stress": 1.45e6,
        "lubricant.boundary_film": 1e-6,
        "surface.amplitude": 0.0726428,
        "surface.wavelength_x": 4.0,
        "surface.wavelength_y": 2.0,
        "time.scheme": "'paper'",
    }
    default_domain = {key: value for key, value in STEEL.items() if key not in DOMAIN}
    runs = [
        solve(None, points, default_domain | MIXED | wave, words=True) for points in (33, 65, 129)
    ]
    for done in runs:
        assert done.converged
        assert done["contact_load_share"] > 0.5
        assert done["mass_defect"] > 0.1
        assert done["contact_load_share_error"] is None
    assert "would have to supply much of the flow" in runs[1]["contact_load_share_error_note"]


def test_both_drivers_give_the_same_results(solve, tmp_path):
    values = STEEL | MIXED | {"lubricant.boundary_friction": 0.1, "time.steps": 12}
    done = solve(None, 65, values)
    settings = {k: v.strip("'") if isinstance(v, str) else v for k, v in values.items()}
    case = pyehl.Case().with_options(settings | {"grid.points": 65})
    pyehl.solve(case, output=tmp_path / "out", check=False)
    other = json.loads((tmp_path / "out" / "summary.json").read_text())
    beginnings = "contact_", "mass_defect", "H_", "mu"
    names = [name for name in done.summary if name.startswith(beginnings)]
    assert len(names) > 10
    assert {name: other[name] for name in names} == {name: done[name] for name in names}


@pytest.mark.parametrize(
    "case",
    [
        ELLIPSE,
        {"second_surface.kind": "'harmonic'", "second_surface.amplitude": 0.01},
    ],
    ids=["ellipse", "two surfaces"],
)
def test_other_cases(solve, case):
    done = solve(None, 65, of_shape(STEEL | MIXED | case | {"time.max_periods": 3}))
    assert done["status"] in ("converged", "not settled")
    assert done.history["load_share"].max() > 0.05
    assert (done.history["load_share"] <= 1.0 + 1e-12).all()
