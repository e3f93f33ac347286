# SPDX-License-Identifier: BSD-3-Clause
"""The smooth contact against reference values, limits, other engines and its own error estimate."""

import itertools
import math
from typing import Any

import numpy as np
import pytest
import reference
from reference import SMOOTH, SmoothRow

from pyehl.theory.film import nijenbanning_venner_moes

# Independent programs agree with one another to this tolerance on the same grid
AGREEMENT = 2e-3
# Algebraic error a hundred times below the default, to compare discretisations
TIGHT = {"solver.accuracy": 1e-3, "solver.max_cycles": 60}
ROWS = [
    pytest.param(row, k, id=f"M{row.moes_m:g}-L{row.moes_l:g}-z{row.roelands_z:g}-{points}")
    for row in SMOOTH
    for k, points in enumerate(row.points)
]


def run(solve, row: SmoothRow, points: int) -> Any:
    settings = {
        "lubricant.roelands_z": row.roelands_z,
        "grid.x_inlet": row.x_inlet,
        "grid.y_extent": row.y_extent,
        "grid.border": "zero",
    }
    return solve((row.moes_m, row.moes_l), points, settings)


def contradiction(row: SmoothRow) -> float:
    """Deviation of H_min of a row from the value that rows with another z imply.

    z acts on the inlet and so on both films: H_min is proportional to H_c. The rows at M = 1000, L
    = 10 violate that by 0.25 %: from z = 0.68 to 0.6684 H_c falls by 0.13 % and H_min rises.
    """
    worst = 0.0
    for other in SMOOTH:
        if (other.moes_m, other.moes_l) != (row.moes_m, row.moes_l):
            continue
        for points in set(row.points) & set(other.points):
            a, b = row.points.index(points), other.points.index(points)
            films = row.h_c[a] / other.h_c[b], row.h_min[a] / other.h_min[b]
            worst = max(worst, abs(films[1] / films[0] - 1.0))
    return worst


@pytest.mark.parametrize(("row", "k"), ROWS)
def test_reference_rows(solve, row: SmoothRow, k: int):
    done = run(solve, row, row.points[k])
    assert done.converged
    assert done["H_c"] == pytest.approx(row.h_c[k], rel=AGREEMENT)
    assert abs(done["load_error"]) <= 1e-6
    # The rows at z = 0.68 and at M = 20 have no counterpart; see contradiction() for the other
    exact = row.roelands_z == 0.68 or row.moes_m != 1000.0
    tolerance = AGREEMENT if exact else AGREEMENT + contradiction(row)
    assert done["H_min"] == pytest.approx(row.h_min[k], rel=tolerance)


@pytest.mark.parametrize(
    "row", SMOOTH, ids=lambda r: f"M{r.moes_m:g}-L{r.moes_l:g}-z{r.roelands_z:g}"
)
def test_limits(solve, row: SmoothRow):
    coarse, fine = (run(solve, row, points) for points in (513, 1025))
    for name, limit in (("H_c", row.limit_c), ("H_min", row.limit_min)):
        assert (4.0 * fine[name] - coarse[name]) / 3.0 == pytest.approx(limit, rel=AGREEMENT)


def test_friction(solve, table):
    for line in table("friction_smooth.csv"):
        row = next(
            r
            for r in SMOOTH
            if (r.moes_m, r.moes_l, r.roelands_z)
            == tuple(float(line[name]) for name in ("moes_m", "moes_l", "roelands_z"))
        )
        if line["points"] == "limit":
            coarse, fine = (run(solve, row, points)["F"] for points in (513, 1025))
            value = (4.0 * fine - coarse) / 3.0
        else:
            value = run(solve, row, int(line["points"]))["F"]
        assert value == pytest.approx(float(line["F"]), rel=2e-3), line


@pytest.mark.parametrize(
    "point",
    [
        (200.0, 10.0),
        *(pytest.param(p, marks=pytest.mark.long) for p in [(500.0, 15.0), (1000.0, 10.0)]),
    ],
)
def test_order_is_two(solve, point: tuple[float, float]):
    runs = [solve(point, points, TIGHT) for points in (257, 513, 1025)]
    assert all(done.converged for done in runs)
    # Only H_c is smooth in the mesh size: H_min is the smallest of the nodes and lies between them,
    # and F has a part from the pressure spike, which is a few meshes wide
    a, b, c = (done["H_c"] for done in runs)
    assert math.log2((b - a) / (c - b)) == pytest.approx(2.0, abs=0.15)


@pytest.mark.parametrize("point", [(200.0, 10.0), (1000.0, 10.0)])
def test_mlmi_and_fft_agree(solve, point: tuple[float, float]):
    # The summation error of mlmi must be a small part of the discretisation error, 0.2 to 1 %
    mlmi, fft = (solve(point, 513, {"solver.deflection": name}) for name in ("mlmi", "fft"))
    assert mlmi.converged
    assert fft.converged
    assert mlmi["H_c"] == pytest.approx(fft["H_c"], rel=1e-4)
    assert mlmi["deflection"] != fft["deflection"]


def test_hertz_limit(solve):
    """P tends to the Hertz ellipse, and the shape to the Hertz deflection, as the film gets thin.

    Only the film separates the two problems: a gap of H_c, uneven by some tenths of itself,
    compared with a deflection of 1. So the differences are proportional to H_c.
    """
    before = math.inf
    for moes_m in (1000.0, 2000.0, 4000.0):
        done = solve((moes_m, 5.0), 513, fields=True)
        assert done.converged
        x, y = done.field("X")[:, None], done.field("Y")[None, :]
        pressure, film, h_c = done.field("P"), done.field("H"), done["H_c"]
        inside = x**2 + y**2 < 0.8**2
        assert 0.0 < done["P_max"] - 1.0 < 0.2 * h_c
        profile = np.abs(pressure - reference.hertz_pressure(x, y))[inside].max()
        assert profile < 0.5 * h_c
        assert profile < before / 1.5
        before = profile
        # H - X^2/2 - Y^2/2 = H00 + deflection; subtracting its value at the centre removes H00
        shape = film - 0.5 * x**2 - 0.5 * y**2
        centre = np.argmin(np.abs(x)), np.argmin(np.abs(y))
        change = shape - shape[centre] - (reference.hertz_deflection(x, y) - 1.0)
        assert np.abs(change).max() < h_c
        # Far away only the load counts, not its distribution: centre against corners
        assert np.abs(change[[0, 0, -1, -1], [0, -1, 0, -1]]).max() < 0.1 * h_c


@pytest.mark.parametrize(
    ("moes_m", "moes_l"),
    [
        pytest.param(m, n, marks=[pytest.mark.long] if (i + j) % 2 else [])
        for i, m in enumerate((20.0, 60.0, 250.0, 700.0, 1300.0, 2000.0))
        for j, n in enumerate((5.0, 7.5, 11.0, 15.0))
    ],
)
def test_default_settings_converge(solve, moes_m: float, moes_l: float):
    done = solve((moes_m, moes_l), 513)
    assert done.converged
    assert abs(done["load_error"]) <= 1e-6
    assert 0.0 < done["H_min"] < done["H_c"] < done["H_c_extrapolated"]
    if moes_m >= 500.0:
        # The accuracy of the formula, for incompressible fluids, was 0.8 % there; 1.1 % includes
        # the error of the extrapolated value (0.1 %) and points between those of that comparison
        pressure = done["hertz_pressure_Pa"]
        density = (5.9e8 + 1.34 * pressure) / (5.9e8 + pressure)
        formula = nijenbanning_venner_moes(moes_m, moes_l) / density
        assert done["H_c_extrapolated"] == pytest.approx(formula, rel=0.011)


ESTIMATED = [
    (20.0, 5.0),
    (20.0, 15.0),
    (100.0, 5.0),
    (100.0, 15.0),
    (200.0, 10.0),
    (500.0, 5.0),
    (500.0, 15.0),
    (1000.0, 10.0),
    (2000.0, 10.0),
    (2000.0, 15.0),
]


def limits(solve, point: tuple[float, float]) -> dict[str, float]:
    """H_c and H_min on ever finer grids, extrapolated from 513 and 1025 points per side."""
    coarse, fine = (solve(point, points) for points in (513, 1025))
    assert coarse.converged
    assert fine.converged
    return {name: (4.0 * fine[name] - coarse[name]) / 3.0 for name in ("H_c", "H_min")}


@pytest.mark.long
def test_error_estimates(solve):
    ratios = []
    for point in ESTIMATED:
        limit = limits(solve, point)
        for points, name in itertools.product((257, 513), limit):
            done = solve(point, points)
            assert done["error_estimate"] == "coarser grids"
            ratios.append(abs(done[name] - limit[name]) / done[f"{name}_error"])
        extrapolated = solve(point, 513)["H_c_extrapolated"]
        assert extrapolated == pytest.approx(limit["H_c"], rel=1e-3), point
    assert np.mean(np.array(ratios) <= 1.0) >= 0.95
    # The error is not far too large either
    assert np.median(ratios) > 0.35


@pytest.mark.parametrize(
    ("point", "target"),
    [
        ((200.0, 10.0), 1e-2),
        pytest.param((200.0, 10.0), 1e-3, marks=pytest.mark.long),
        pytest.param((1000.0, 10.0), 2e-2, marks=pytest.mark.long),
        pytest.param((2000.0, 15.0), 5e-3, marks=pytest.mark.long),
    ],
)
def test_target_error(solve, point: tuple[float, float], target: float):
    done = solve(point, 513, {"grid.target_error": target})
    assert done.converged
    assert done["H_c_error_grid"] <= target * done["H_c"]
    limit = limits(solve, point)["H_c"]
    assert abs(done["H_c"] / limit - 1.0) <= 2.0 * target
    # and the grid is no finer than needed: the next coarser one would miss the target
    coarser = solve(point, (done["points"] + 1) // 2)
    assert coarser["H_c_error_grid"] > target * coarser["H_c"]


def test_target_error_missed_on_the_finest_grid(solve):
    done = solve((1000.0, 10.0), 65, {"grid.target_error": 1e-4, "grid.max_points": 257})
    assert (done["status"], done.code) == ("target missed", 1)
    assert done["H_c_error"] > 1e-4 * done["H_c"]
