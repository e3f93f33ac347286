# SPDX-License-Identifier: BSD-3-Clause
"""Oils with shear thinning in the flow that makes the film (lubricant.flow)."""

import subprocess
from pathlib import Path

import numpy as np
import pytest

import pyehl

PAPER = {"grid.x_inlet": -2.5, "grid.x_outlet": 1.5, "grid.y_extent": 2.0, "grid.border": "zero"}
# Table 1 of Zhang et al. 2019 with an Eyring stress of 5 MPa
TABLE1 = PAPER | {
    "contact.load": 600.0,
    "contact.mean_velocity": 0.84,
    "contact.radius": 0.018,
    "contact.reduced_modulus": 2.26e11,
    "lubricant.viscosity": 0.04,
    "lubricant.pressure_viscosity": 2.2e-8,
    "lubricant.shear_law": "eyring",
}
# An oil that thins at low shear rates
CARREAU = PAPER | {
    "contact.load": 30.0,
    "contact.mean_velocity": 0.5,
    "contact.radius": 0.0127,
    "contact.reduced_modulus": 1.24e11,
    "lubricant.viscosity": 0.5,
    "lubricant.pressure_viscosity": 1.8e-8,
    "lubricant.shear_law": "carreau",
    "lubricant.carreau_stress": 1e5,
    "lubricant.carreau_exponent": 0.8,
}
WAVE = {"surface.kind": "harmonic", "surface.amplitude": 5e-4, "time.steps": 12}


def test_fast_sliding_eyring_agrees_with_a_newton_solver(solve):
    """Against an independent solver on the same grid: Table 1 at a slide-to-roll ratio of 2."""
    done = solve(None, 129, TABLE1 | {"contact.slide_to_roll": 2.0})
    assert done["h_c_m"] == pytest.approx(1.89568e-7, rel=1e-3)
    assert done["h_min_m"] == pytest.approx(5.669e-8, rel=3e-3)
    assert done["mu_smooth"] == pytest.approx(0.06401, rel=3e-3)


@pytest.mark.parametrize(
    ("srr", "h_c", "h_min"), [(0.1, 6.6841e-7, 4.5041e-7), (0.0, 6.6982e-7, 4.5062e-7)]
)
def test_carreau_agrees_with_a_newton_solver(solve, srr, h_c, h_min):
    """Films in the limit of fine grids: a fifth thinner than that of a Newtonian oil."""
    done = solve(None, 129, CARREAU | {"contact.slide_to_roll": srr})
    length = done["h_c_m"] / done["H_c"]
    assert done["H_c_extrapolated"] * length == pytest.approx(h_c, rel=1e-3)
    assert done["H_min_extrapolated"] * length == pytest.approx(h_min, rel=2e-3)
    if srr:
        # the other solver omits the cavity, half a per cent here
        assert done["mu_smooth"] == pytest.approx(0.005821, rel=1e-2)


def test_strong_thinning(solve):
    """n = 0.5, where factors that lag the pressure gradient would diverge."""
    keys = CARREAU | {"lubricant.carreau_exponent": 0.5}
    rolling = solve(None, 65, keys | {"contact.slide_to_roll": 0.0})
    sliding = solve(None, 65, keys | {"contact.slide_to_roll": 1.0})
    thin = solve(None, 65, CARREAU)
    assert rolling["status"] == sliding["status"] == "converged"
    assert sliding["H_c"] < rolling["H_c"] < thin["H_c"]


@pytest.mark.parametrize("srr", [1.0, 1.4])
def test_films_far_thinner_than_the_newtonian_one(solve, srr):
    """n = 0.3: the film is a seventh of the Newtonian one, from which the solver cannot start."""
    done = solve(
        None, 65, CARREAU | {"lubricant.carreau_exponent": 0.3, "contact.slide_to_roll": srr}
    )
    newtonian = solve(None, 65, CARREAU | {"lubricant.flow": "newtonian"})
    assert done["status"] == "converged"
    assert done["restarts"] == 0
    assert done["H_c"] < newtonian["H_c"] / 6.0


def test_cached_factors_do_not_change_the_result(solve):
    """A run that keeps its factors from cycle to cycle, at two values of solver.accuracy."""
    keys = CARREAU | {"lubricant.carreau_exponent": 0.5, "contact.slide_to_roll": 0.5}
    usual, strict = (solve(None, 65, keys | {"solver.accuracy": a}) for a in (0.1, 0.001))
    assert strict["cycles"] > usual["cycles"]
    assert usual["H_c"] == pytest.approx(strict["H_c"], rel=1e-4)
    assert usual["H_min"] == pytest.approx(strict["H_min"], rel=2e-4)


def test_laws_that_leave_the_flow_newtonian(solve):
    newtonian = solve(None, 65, CARREAU | {"lubricant.shear_law": "newtonian"})
    for keys in (
        {"lubricant.shear_law": "limiting"},
        {"lubricant.flow": "newtonian"},
        {"lubricant.carreau_exponent": 1.0},
    ):
        assert solve(None, 65, CARREAU | keys)["H_c"] == pytest.approx(newtonian["H_c"], rel=1e-9)


@pytest.mark.parametrize("keys", [{}, {"time.scheme": "paper"}, {"solver.coarsening": "alcouffe"}])
def test_time_steps_of_half_and_whole_domains(solve, keys):
    runs = [
        solve(None, 65, CARREAU | WAVE | keys | more, fields=True)
        for more in ({}, {"solver.symmetry": "full"})
    ]
    assert all(run.history["cycles"].max() < 8 for run in runs)
    assert np.allclose(runs[0].field("P"), runs[1].field("P"), rtol=0.0, atol=2e-4)


@pytest.mark.parametrize(
    "keys",
    [
        {"surface.velocity_ratio": 1.05},
        pytest.param(
            {
                "lubricant.shear_law": "eyring",
                "lubricant.eyring_stress": 4e6,
                "surface.velocity_ratio": 1.1,
            },
            marks=pytest.mark.long,
        ),
    ],
)
def test_steps_are_solved_well_below_the_grid_error(solve, keys):
    """Though their tolerance follows from the friction of a Newtonian lubricant."""
    wave = {"surface.kind": "harmonic", "surface.amplitude": 0.06, "surface.wavelength": 0.5}
    keys = CARREAU | wave | {"time.estimate_error": False} | keys
    usual = solve(None, 65, keys)
    strict = solve(None, 65, keys | {"time.steps": usual["steps"], "solver.accuracy": 0.0025})
    finer = solve(None, 129, keys)
    assert strict["cycles_per_step"] > usual["cycles_per_step"]
    algebraic = abs(usual["mu_ratio"] - strict["mu_ratio"])
    assert algebraic < 0.1 * 4.0 / 3.0 * abs(finer["mu_ratio"] - usual["mu_ratio"])


def test_short_waves_leak(solve):
    """Where the oil thins, less of a wave is flattened."""
    left = {
        flow: solve(
            None,
            129,
            TABLE1
            | WAVE
            | {
                "lubricant.flow": flow,
                "surface.wavelength": 0.25,
                "surface.x_start": 1.5,
                "contact.slide_to_roll": 0.5,
                "time.steps": 0,
            },
        )["amplitude_ratio"]
        for flow in ("consistent", "newtonian")
    }
    assert left["consistent"] < left["newtonian"]


def test_a_run_that_was_stopped_is_resumed_to_the_same_bits(ehl: str, tmp_path: Path):
    """Factors and stress follow from film and pressure, so that a checkpoint needs none of them."""
    keys = CARREAU | WAVE | {"grid.points": 65, "contact.slide_to_roll": 0.3}
    (tmp_path / "case.nml").write_text(pyehl.Case.from_text("", keys).text)

    def run(*words: str) -> int:
        return subprocess.run([ehl, *words, "--quiet"], cwd=tmp_path, check=False).returncode

    assert run("case.nml", "-o", "whole") == 1
    assert run("case.nml", "-o", "parts", "--set", "time.steps=5") == 1
    assert run("--resume", "parts", "--set", "time.steps=12") == 1
    whole, parts = (pyehl.load(tmp_path / name) for name in ("whole", "parts"))
    assert float(whole.steps) == float(parts.steps) == 12
    assert np.array_equal(whole["P"], parts["P"])
    assert np.array_equal(whole["H"], parts["H"])
    assert float(whole.last_mu_ratio) == float(parts.last_mu_ratio)
