# SPDX-License-Identifier: BSD-3-Clause
"""Slide-to-roll ratio, and shear laws in whole runs."""

import numpy as np
import pytest

from pyehl.case import Case
from pyehl.solver import Solver
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.shear import ShearLaw, shear_stress

# M = 200 in SI units: 65 x 65 nodes resolve the contact
SI = {"contact.load": 120.0, "lubricant.density_law": "incompressible"}
OPERATING = OperatingPoint(load=120.0)
WAVE = {"surface.kind": "harmonic", "surface.amplitude_over_film": 0.3, "time.steps": 60}
LAWS = {
    "eyring": ShearLaw("eyring"),
    "limiting": ShearLaw("limiting"),
    "carreau": ShearLaw("carreau", carreau_stress=7e6, carreau_exponent=0.5),
}


def words(law: ShearLaw) -> dict[str, object]:
    """Keys of the law in a case, for the friction alone."""
    keys: dict[str, object] = {"lubricant.shear_law": law.law, "lubricant.flow": "newtonian"}
    if law.law == "carreau":
        keys["lubricant.carreau_stress"] = law.carreau_stress
        keys["lubricant.carreau_exponent"] = law.carreau_exponent
    return keys


def friction(done, law: ShearLaw, slide_to_roll: float) -> float:
    """Friction integral of the written fields, over the Newtonian stress of eta0 and H = 1."""
    x, y, p, h = (done.field(name) for name in "XYPH")
    scale = 0.04 * slide_to_roll * OPERATING.mean_velocity / OPERATING.film_scale
    pressure = p * OPERATING.hertz_pressure
    newtonian = scale * Lubricant().viscosity_ratio(pressure) / h
    stress = shear_stress(newtonian, pressure, law)
    return float(stress.sum() * (x[1] - x[0]) * (y[1] - y[0]) / scale)


@pytest.mark.parametrize("name", LAWS)
def test_friction_is_the_integral_of_the_stress(solve, name):
    srr, law = 0.05, LAWS[name]
    done = solve(None, 65, SI | words(law) | {"contact.slide_to_roll": srr}, fields=True)
    # the sums run in another order
    assert done["F"] == pytest.approx(friction(done, law, srr), rel=1e-12)
    newtonian = solve(None, 65, SI, fields=True)
    assert done["H_c"] == newtonian["H_c"]  # the flow is Newtonian
    assert done["F"] < 0.1 * newtonian["F"]
    assert newtonian["F"] == pytest.approx(friction(newtonian, ShearLaw(), srr), rel=1e-12)


@pytest.mark.parametrize("name", LAWS)
def test_every_law_is_newtonian_when_slow(solve, name):
    newtonian = solve(None, 65, SI)["F"]
    law = SI | words(LAWS[name])
    slow = solve(None, 65, law | {"contact.slide_to_roll": 1e-9})["F"]
    # a limit proportional to pressure is zero where p = 0: 3e-6 of the friction
    assert slow == pytest.approx(newtonian, rel=5e-6)
    assert solve(None, 65, law | {"contact.slide_to_roll": 0.0})["F"] == newtonian


def test_one_motion_in_three_notations(solve):
    runs = [
        solve(None, 65, SI | WAVE | keys)
        for keys in (
            {"surface.velocity_ratio": 1.25},
            {"contact.slide_to_roll": 0.5},
            {"contact.slide_to_roll": -0.5, "contact.rough_surface": 2},
        )
    ]
    for done in runs:
        assert done["steps"] == 60
        assert np.array_equal(done.history["mu_ratio"], runs[0].history["mu_ratio"])
    moes = solve((200.0, 10.0), 65, WAVE | {"contact.slide_to_roll": 0.5})
    assert Case(moes.folder / "case.nml").resolve()["surface"]["velocity_ratio"] == 1.25


def test_stress_laws_in_time_steps(solve):
    """The friction of each step follows the law; the wave changes it little."""
    newtonian = solve(None, 65, SI | WAVE)
    law = words(LAWS["eyring"])
    eyring = solve(None, 65, SI | WAVE | law, fields=True)
    assert np.array_equal(eyring.history["H_c"], newtonian.history["H_c"])
    swing = np.ptp(newtonian.history["mu_ratio"])
    assert 0.0 < np.ptp(eyring.history["mu_ratio"]) < 0.1 * swing
    # all cycles are full ones, as before a rough run
    smooth = solve(None, 65, SI | law | {"solver.cycle": "F"})["F"]
    last = friction(eyring, ShearLaw("eyring"), 0.02) / smooth
    assert eyring.history["mu_ratio"][-1] == pytest.approx(last, rel=1e-12)


def test_both_drivers(solve, tmp_path):
    keys = SI | WAVE | {"lubricant.shear_law": "limiting", "time.steps": 5, "grid.points": 65}
    done = solve(None, 65, keys)
    case = Case.from_text("", [f"{key}={value}" for key, value in keys.items()])
    with Solver(case) as solver:
        solver.run()
        solver.write(tmp_path / "out")
    history = (tmp_path / "out" / "history.csv").read_text()
    assert history == (done.folder / "history.csv").read_text()
