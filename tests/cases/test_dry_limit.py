# SPDX-License-Identifier: BSD-3-Clause
"""Contact at a boundary film with hardly any lubricant left, and solids with a hardness."""

from __future__ import annotations

import numpy as np
import pytest
from test_boundary_film import ELLIPSE, MIXED, REST, STEEL, of_shape, theory, within

# Hertz pressure of STEEL [Pa]
HERTZ = (1.5 * 600.0 * (2.26e11 / 0.018) ** 2) ** (1.0 / 3.0) / np.pi
VALLEYS = {"surface.amplitude": 0.05}
LONG_WAVES = {"surface.amplitude": 0.03, "surface.wavelength": 0.8}
BOTH_ROUGH = {
    "surface.amplitude": 0.01,
    "second_surface.kind": "'harmonic'",
    "second_surface.amplitude": 0.01,
    "time.steps": 35,
}


@pytest.fixture(scope="module")
def dry(script):
    """Dry contact by ContactMechanics."""
    return script("docs/evidence/contact/dry.py")


def apart(pressure: np.ndarray, other: np.ndarray) -> float:
    return float(np.linalg.norm(pressure - other) / np.linalg.norm(other))


def test_rough_dry_limit_full_contact(solve, root, dry):
    """Pressure and area of a dry solver where the waves are flattened completely."""
    rest = REST | {"contact.mean_velocity": 0.005, "lubricant.boundary_film": 2e-8}
    done = solve(None, 129, STEEL | rest, fields=True)
    assert done.converged
    pressure = dry.dry_pressure(done.summary, done.field)
    off_area = abs(done["contact_area_share"] / dry.dry_area(done.summary, pressure) - 1.0)
    stated = (
        f"pressure agrees within {within(apart(done.field('P'), pressure))} and the area within "
        f"{within(off_area)}"
    )
    assert stated in theory(root, "contact")


def test_rough_dry_limit_partial_contact(solve, root, dry):
    """Pressure of a dry solver where they are not: closed valleys trap lubricant."""
    rest = REST | {"contact.mean_velocity": 0.005, "lubricant.boundary_film": 1e-8}
    done = solve(None, 129, STEEL | rest | {"surface.amplitude": 0.05}, fields=True)
    assert done.converged
    pressure = dry.dry_pressure(done.summary, done.field)
    wet = 1.0 - done["contact_load_share"]
    off = within(apart(done.field("P"), pressure))
    text = theory(root, "contact")
    assert f"enclosed lubricant supports {100.0 * wet:.0f} % of the load" in text
    assert f"of the load, and the pressure agrees within {off}" in text
    assert dry.dry_area(done.summary, pressure) < 0.95


@pytest.mark.parametrize(
    ("name", "points", "velocity", "boundary", "hardness", "case"),
    [
        ("flattened", 129, 0.02, 2e-8, 1.15 * HERTZ, {}),
        ("with valleys", 129, 0.005, 1e-8, 1.35 * HERTZ, VALLEYS),
        pytest.param("flattened", 257, 0.005, 2e-8, 1.15 * HERTZ, {}, marks=pytest.mark.long),
        pytest.param(
            "with valleys", 257, 0.005, 1e-8, 1.35 * HERTZ, VALLEYS, marks=pytest.mark.long
        ),
        ("ellipse", 129, 0.005, 1e-8, 1.47e9, ELLIPSE | LONG_WAVES),
        ("two surfaces", 65, 0.01, 2e-8, 1.1 * HERTZ, BOTH_ROUGH),
    ],
    ids=["flat", "valleys", "fine, flat", "fine, valleys", "ellipse", "two surfaces"],
)
def test_hardness_dry_limit(solve, root, dry, name, points, velocity, boundary, hardness, case):
    """Pressure and load share at the pressure limit, as by a dry solver with such a limit."""
    rest = {"contact.mean_velocity": velocity, "lubricant.boundary_film": boundary}
    rest |= {"contact.hardness": hardness}
    done = solve(None, points, of_shape(STEEL | REST | rest | case), fields=True, words=True)
    assert done.converged
    limit = hardness / done["hertz_pressure_Pa"]
    hard, elastic = (
        dry.dry_pressure(done.summary, done.field, max_pressure) for max_pressure in (limit, None)
    )
    pressure = done.field("P")
    assert pressure.max() == pytest.approx(limit, rel=1e-9)
    share = hard[hard >= limit * (1.0 - 1e-9)].sum() / hard.sum()
    # the dry contact is that of the last time step
    moving = "time.steps" in case
    at_limit = done.history["hard_load_share"][-1] if moving else done["load_share_at_hardness"]
    # two nodes of the ellipse are one hundredth of its area
    assert at_limit == pytest.approx(share, rel=0.02 if name == "ellipse" else 0.01)
    row = f"| {name} | {points} | {limit:.2f} | {within(apart(pressure, hard))} | "
    row += f"{100.0 * at_limit:.1f} % | {100.0 * share:.1f} % |"
    assert row in theory(root, "contact")
    assert apart(pressure, elastic) > 2.0 * apart(pressure, hard)
    assert done["plastic_depth_max_m"] > 5e-8
    # where the solids yield, the film is at least 0.7 times the boundary film
    assert done.field("H").min() > 0.7 * done["boundary_film"]
    assert "yielding solids" in done["assessment"]


@pytest.mark.long
@pytest.mark.parametrize("case", [{}, REST, MIXED], ids=["smooth", "rest", "wave"])
def test_hardness_above_all_pressures_changes_no_bit(solve, case):
    touching = STEEL | {"contact.mean_velocity": 0.05, "lubricant.boundary_film": 3e-8} | case
    elastic = solve(None, 65, touching, fields=True)
    hard = solve(None, 65, touching | {"contact.hardness": 1e12}, fields=True)
    # 65 nodes may not resolve the inlet: the bodies touch there, and no load share is reported
    assert elastic["contact_load_share"] is None or elastic["contact_load_share"] > 0.0
    for name in ("P", "H"):
        assert (elastic.field(name) == hard.field(name)).all()
    timed = {"bytes", "wall_seconds", "seconds_per_step", "files", "version", "case"}
    more = {"load_share_at_hardness", "area_share_at_hardness", "plastic_depth_max_m"}
    more.add("flowing_load_share_at_hardness")
    left = {k: v for k, v in hard.summary.items() if k not in timed | more}
    assert left == {k: v for k, v in elastic.summary.items() if k not in timed}
    unknown = elastic["contact_load_share"] is None
    assert [hard[name] for name in more] == [None if unknown else 0.0] * 4


@pytest.mark.long
def test_hardness_in_time_steps(solve):
    """No pressure above the limit in any step, and more contact than of elastic solids."""
    moving = STEEL | MIXED | {"time.max_periods": 3}
    elastic = solve(None, 65, moving)
    hard = solve(None, 65, moving | {"contact.hardness": 1.1 * HERTZ})
    assert elastic.history["P_max"].max() > 1.2
    assert hard.history["P_max"].max() <= 1.1 * (1.0 + 1e-6)
    assert hard.history["hard_load_share"].max() > 0.05
    assert hard.history["hard_flowing"].max() > 0.01
    assert np.abs(hard.history["load_error"]).max() <= 1e-6
    assert hard.history["plastic_depth"].max() * hard["film_scale_m"] > 5e-8
