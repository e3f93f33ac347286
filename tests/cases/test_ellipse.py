# SPDX-License-Identifier: BSD-3-Clause
"""Elliptical contacts: reference values, order, circular limit, symmetry, waves."""

import json
import math
import subprocess
from pathlib import Path

import numpy as np
import pytest
from scipy.special import ellipe, ellipk

import pyehl
from pyehl.theory.ellipse import ellipse
from pyehl.theory.film import nijenbanning_venner_moes

PLACE = {"grid.border": "zero", "grid.x_inlet": -2.5, "grid.x_outlet": 1.5}
# D of kappa = 10
RATIO_OF_TEN = 0.02737
ROUND = {"contact.load": 50.0, "contact.mean_velocity": 1.0, "grid.points": 65}
WAVE = {
    "surface.kind": "harmonic",
    "surface.amplitude": 5e-3,
    "surface.x_start": 1.5,
    "time.steps": 10,
}


def rows(table, kind: str) -> list[dict[str, str]]:
    return [
        row
        for row in table("smooth_ellipses.csv")
        if (row["cells"] == "limit") == (kind == "limit")
    ]


def on_cells(solve, row: dict[str, str], points: int, *, square: bool):
    """Solve a row of the table with nodes along X, on square or on default cells."""
    settings = PLACE | {
        "contact.radius_ratio": row["radius_ratio"],
        "grid.y_extent": row["y_extent"],
        "lubricant.roelands_z": 0.6684,
    }
    if square:
        settings["grid.points_y"] = round(float(row["y_extent"]) * (points - 1) / 2.0) + 1
    done = solve((float(row["moes_m"]), float(row["moes_l"])), points, settings)
    assert done.converged, done.summary
    return done


def test_reference_films_on_the_same_cells(solve, table):
    for row in rows(table, "cells"):
        done = on_cells(solve, row, 4 * int(row["cells"]) + 1, square=True)
        assert done["y_mesh"] == pytest.approx(done["x_mesh"], rel=1e-12)
        assert done["H_c"] == pytest.approx(float(row["H_c"]), rel=3e-4), row
        assert done["H_min"] == pytest.approx(float(row["H_min"]), rel=3e-3), row


def test_limits_with_order_two(solve, table):
    """On the default cells, which are not square."""
    for row in rows(table, "limit"):
        coarse, middle, fine = (on_cells(solve, row, n, square=False) for n in (129, 257, 513))
        assert fine["H_c_extrapolated"] == pytest.approx(float(row["H_c"]), rel=1e-3), row
        assert fine["H_min_extrapolated"] == pytest.approx(float(row["H_min"]), rel=5e-3), row
        change = (middle["H_c"] - coarse["H_c"]) / (fine["H_c"] - middle["H_c"])
        assert math.log2(change) == pytest.approx(2.0, abs=0.15), row
        for done in (middle, fine):
            assert abs(done["H_c"] - float(row["H_c"])) <= 1.1 * done["H_c_error"], row


def test_ellipticity_against_legendre_integrals(table):
    """kappa, k_b and D by the Legendre forms of the textbooks, wide and narrow."""
    for row in rows(table, "limit"):
        assert ellipse(float(row["radius_ratio"])).ellipticity == pytest.approx(
            float(row["kappa"]), rel=2e-5
        )
    for kappa in (1 / 30, 0.1, 0.5, 2.0, 10.0, 30.0):
        long, short = max(1.0, kappa), min(1.0, kappa)
        m = 1.0 - (short / long) ** 2
        k, e = ellipk(m), ellipe(m)
        along_long = math.pi * short * (k - e) / (m * long**2)
        along_short = math.pi * short * ((long / short) ** 2 * e - k) / (m * long**2)
        c_x, c_y = (along_short, along_long) if kappa > 1.0 else (along_long, along_short)
        shape = ellipse(c_y / c_x)
        assert shape.ellipticity == pytest.approx(kappa, rel=1e-9)
        assert shape.kernel_ratio == pytest.approx(math.pi**2 / (4.0 * c_x), rel=1e-9)


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ({"contact.radius": 0.01}, {"contact.radius_x": 0.01, "contact.radius_y": 0.01}),
        (
            {
                "contact.radius_x": 0.01,
                "contact.radius_y": 0.03,
                # multi-integration coarsens other rows if the row Y = 0 has an odd number
                "solver.deflection": "fft",
            },
            {"solver.symmetry": "full"},
        ),
    ],
)
def test_equal_radii_are_a_circle_and_half_is_whole(solve, one, other):
    exact = "contact.radius" in one
    first = solve(None, 65, ROUND | one)
    second = solve(None, 65, ROUND | (other if exact else one | other))
    for name in ("H_c", "H_min", "P_max", "F", "residual", "hertz_radius_m"):
        if exact:
            assert first[name] == second[name]
        elif name != "residual":
            assert first[name] == pytest.approx(second[name], rel=1e-9)


def test_numbers_of_python_are_those_of_the_program(solve):
    for radii in ((0.01, 0.04), (0.02, 0.008)):
        keys = {"contact.radius_x": radii[0], "contact.radius_y": radii[1]}
        done = solve(None, 33, ROUND | keys)
        point = pyehl.OperatingPoint.from_settings(pyehl.Case.from_text("", ROUND | keys).resolve())
        for name, value in {
            "moes_m": point.moes_m,
            "moes_l": point.moes_l,
            "alpha_bar": point.alpha_bar,
            "speed_parameter": point.speed_parameter,
            "hertz_pressure_Pa": point.hertz_pressure,
            "hertz_radius_m": point.hertz_radius,
            "semi_axis_y_m": point.semi_axis_y,
            "film_scale_m": point.film_scale,
            "radius_ratio": radii[0] / radii[1],
            "ellipticity": point.ellipse.ellipticity,
        }.items():
            assert done[name] == pytest.approx(value, rel=1e-12), name
        # semi-ellipsoidal pressure
        load = 2.0 / 3.0 * math.pi * point.hertz_pressure * point.hertz_radius * point.semi_axis_y
        assert load == pytest.approx(50.0, rel=1e-12)


def test_bodies_make_reduced_radii_and_modulus(ehl: str, tmp_path: Path):
    """A ball in a groove; the case written by the run gives the same."""
    ball, ring, groove = 0.004, 0.0125, -0.00413
    bodies = {
        "bodies.radius_x1": ball,
        "bodies.radius_y1": ball,
        "bodies.radius_x2": ring,
        "bodies.radius_y2": groove,
        "bodies.modulus_2": 3e11,
        "bodies.poisson_2": 0.2,
    }
    contact = pyehl.Case.from_text("", bodies).resolve()["contact"]
    assert contact["radius_x"] == pytest.approx(1.0 / (1.0 / ball + 1.0 / ring), rel=1e-14)
    assert contact["radius_y"] == pytest.approx(1.0 / (1.0 / ball + 1.0 / groove), rel=1e-12)
    modulus = 2.0 / ((1.0 - 0.3**2) / 2.06e11 + (1.0 - 0.2**2) / 3e11)
    assert contact["reduced_modulus"] == pytest.approx(modulus, rel=1e-14)
    case = pyehl.Case.from_text("", bodies, {"contact.load": 20, "grid.points": 65})
    (tmp_path / "case.nml").write_text(case.text)
    first, again = tmp_path / "first", tmp_path / "again"
    subprocess.run([ehl, tmp_path / "case.nml", "-o", first], check=True)
    subprocess.run([ehl, first / "case.nml", "-o", again], check=True)
    assert np.array_equal(np.load(first / "H.npy"), np.load(again / "H.npy"))
    changed = pyehl.Case(first / "case.nml", "bodies.radius_x2=0").resolve()["contact"]
    assert changed["radius_x"] == ball
    # all values of a resolved case, as if each had been given
    whole = pyehl.Case(first / "case.nml").resolve()
    again = {f"{g}.{k}": v for g, keys in whole.items() for k, v in keys.items() if v != ""}
    assert pyehl.Case.from_text("", again).resolve() == whole


def test_turned_by_a_right_angle_radii_change_places(solve):
    """The same contact by other keys; in between, angles of both signs are mirror images."""
    keys = ROUND | {"grid.points": 129, "grid.border": "zero", "solver.deflection": "fft"}
    # the whole domain has other coarse grids, and thus other algebraic errors
    keys |= {"solver.accuracy": 0.01}
    radii = {"contact.radius_x": 0.01, "contact.radius_y": 0.03}
    swapped = {"contact.radius_x": 0.03, "contact.radius_y": 0.01}
    straight = solve(None, 129, keys | radii)
    turned = solve(None, 129, keys | swapped | {"contact.angle": 90.0})
    assert not turned["half_domain"]
    for name in ("h_c_m", "h_min_m", "p_max_Pa", "hertz_pressure_Pa"):
        assert turned[name] == pytest.approx(straight[name], rel=2e-4), name
    left, right, other = (
        solve(None, 129, keys | given | {"contact.angle": angle}, fields=True)
        for given, angle in ((radii, 30.0), (radii, -30.0), (swapped, -60.0))
    )
    assert np.allclose(left.field("H"), right.field("H")[:, ::-1], rtol=1e-5, atol=0.0)
    for name in ("h_c_m", "h_min_m"):
        assert other[name] == pytest.approx(left[name], rel=1e-3), name
    assert left["h_min_m"] < 0.95 * straight["h_min_m"]


def beyond(x, half_width, film, flow, pressure, alpha):
    """Integral of H dP/dX beyond an inlet border at x, by 40 Gauss points.

    dI/dX is proportional to (H - q)/H^3, P = -ln(1 - alpha I)/alpha, and the gap opens as that of
    the dry contact.
    """
    node, weight = np.polynomial.legendre.leggauss(40)
    node, weight = 0.5 * (node + 1.0), 0.5 * weight

    def gap(at):
        root = np.sqrt(at**2 - half_width**2)
        return 0.5 * (at * root - half_width**2 * np.arccosh(at / half_width))

    def integral(start, power):
        at = np.asarray(start)[..., None] / node
        h = film + gap(at) - gap(x)
        return (weight * (h - flow) / h**power * at / node).sum(axis=-1)

    rate = -np.expm1(-alpha * pressure) / alpha / integral(x, 3)
    at = x / node
    h = film + gap(at) - gap(x)
    slope = rate * (h - flow) / h**2 / (1.0 - alpha * rate * integral(at, 3))
    return float((weight * slope * at / node).sum())


def test_rolling_moment(solve):
    """From the fields; in a wide contact near the asymptote of Biboulet & Houpert 2010."""
    kappa, m = 5.0, 1000.0
    shape = ellipse(0.08455531)
    assert shape.ellipticity == pytest.approx(kappa, rel=1e-3)
    done = solve(
        (m * shape.ellipticity * shape.kernel_ratio**0.25, 10.0 / shape.kernel_ratio**0.75),
        257,
        {"contact.radius_ratio": 0.08455531, "grid.x_inlet": -5.0, "grid.x_outlet": 3.0},
        fields=True,
    )
    p, h = done.field("P"), done.field("H")
    slope = np.diff(p, axis=0) * 0.5 * (h[1:] + h[:-1])
    rows = slope.sum(axis=0)
    y = np.linspace(-1.0, 1.0, p.shape[1]) * 0.5 * (p.shape[1] - 1) * done["y_mesh"]
    centre = round(5.0 / done["x_mesh"])
    for j in np.flatnonzero(np.abs(y) < shape.ellipticity):
        half_width = math.sqrt(1.0 - (y[j] / shape.ellipticity) ** 2)
        rows[j] += beyond(5.0, half_width, h[0, j], h[centre, j], p[0, j], done["alpha_bar"])
    moment = 0.5 * float(rows.sum()) * done["y_mesh"]
    assert moment - 0.5 * float(slope.sum()) * done["y_mesh"] > 0.01 * moment
    assert done["rolling_moment"] == pytest.approx(moment, rel=1e-6)
    assert done["rolling_moment"] == pytest.approx(7.5 * kappa / m, rel=0.1)


def test_film_of_a_flooded_ellipse(solve):
    """Against published values for another border: the numbers of docs/theory/border.md."""
    wide = {"contact.radius_ratio": 0.35177}
    flooded = solve((200.0, 10.0), 257, wide)
    place = {"grid.x_inlet": -2.5, "grid.x_outlet": 1.5, "grid.y_extent": 4.0}
    zero = solve((200.0, 10.0), 257, wide | place | {"grid.border": "'zero'"})
    result = [f"{done['H_c_extrapolated']:.4f}" for done in (flooded, zero)]
    assert result == ["0.1415", "0.1379"]


def test_si_and_moes_numbers_are_one_contact(solve):
    given = solve(None, 65, ROUND | {"contact.radius_x": 0.01, "contact.radius_y": 0.03})
    same = solve(
        (given["moes_m"], given["moes_l"]), 65, {"contact.radius_ratio": given["radius_ratio"]}
    )
    for name in ("H_c", "H_min", "alpha_bar", "speed_parameter"):
        assert same[name] == pytest.approx(given[name], rel=1e-6)


def test_formula(solve):
    """Within 3 % for R_x <= R_y, divided by the density at p_h."""
    for ratio, m in ((0.5, 300.0), (0.1, 2000.0)):
        done = solve((m, 10.0), 257, {"contact.radius_ratio": ratio})
        p = done["hertz_pressure_Pa"]
        density = (5.9e8 + 1.34 * p) / (5.9e8 + p)
        formula = nijenbanning_venner_moes(m, 10.0, ellipse(ratio)) / density
        assert done["H_c_extrapolated"] == pytest.approx(formula, rel=0.03)


@pytest.mark.parametrize("ratio", [0.2, 3.0])
def test_flooded_border_makes_the_domain_no_matter(solve, ratio):
    kappa = ellipse(ratio).ellipticity
    sides = max(kappa, math.sqrt(kappa))
    result = {}
    for border, width, points in (
        ("flooded", 4, 65),
        ("flooded", 8, 129),
        ("flooded", 16, 257),
        ("zero", 16, 257),
    ):
        result[border, width] = solve(
            (30.0 * kappa, 8.0),
            points,
            {
                "contact.radius_ratio": ratio,
                "grid.border": border,
                "grid.x_inlet": -0.625 * width,
                "grid.x_outlet": 0.375 * width,
                "grid.y_extent": 0.5 * width * sides,
            },
        )
    exact = result["flooded", 16]["H_c"]
    assert abs(result["flooded", 8]["H_c"] / exact - 1.0) < 1e-3
    for case in result.values():
        assert abs(case["H_c"] - exact) <= case["H_c_error_domain"] + 1e-5 * exact


@pytest.mark.parametrize(
    ("ratio", "coarsening"),
    [
        (0.3, "classical"),
        (2.0, "alcouffe"),
        pytest.param(0.3, "alcouffe", marks=pytest.mark.long),
        pytest.param(2.0, "classical", marks=pytest.mark.long),
    ],
)
def test_waves_on_half_and_whole_domains(solve, ratio, coarsening):
    keys = WAVE | {
        "contact.radius_ratio": ratio,
        "solver.coarsening": coarsening,
        "solver.deflection": "fft",
    }
    half = solve((200.0, 10.0), 129, keys)
    whole = solve((200.0, 10.0), 129, keys | {"solver.symmetry": "full"})
    assert half["points_y"] == whole["points_y"]
    assert half["last_mu_ratio"] == pytest.approx(whole["last_mu_ratio"], rel=1e-8)
    assert half["last_mu_ratio"] > 1.0001


def test_deflection_engines_agree(solve):
    keys = {"contact.radius_ratio": 0.1}
    exact = solve((500.0, 10.0), 129, keys | {"solver.deflection": "fft"})
    fast = solve((500.0, 10.0), 129, keys | {"solver.deflection": "mlmi"})
    assert fast["H_c"] == pytest.approx(exact["H_c"], rel=2e-3)
    assert fast["H_min"] == pytest.approx(exact["H_min"], rel=2e-3)


def test_resolved_case_gives_the_same_bits(ehl: str, tmp_path: Path):
    """The case written by a run, with the values that follow from the ellipse."""
    first, again = tmp_path / "first", tmp_path / "again"
    options = ["contact.radius_x=0.01", "contact.radius_y=0.03", "grid.points=65"]
    (tmp_path / "case.nml").write_text("")
    sets = [word for option in options for word in ("--set", option)]
    subprocess.run([ehl, tmp_path / "case.nml", "-o", first, *sets], check=True)
    subprocess.run([ehl, first / "case.nml", "-o", again], check=True)
    one, two = (np.load(folder / "H.npy") for folder in (first, again))
    assert np.array_equal(one, two)
    text = (first / "case.nml").read_text()
    assert "radius_x" in text
    assert "radius =" not in text
    # an option changes it as it changes the original case
    subprocess.run(
        [ehl, first / "case.nml", "-o", tmp_path / "c", "--set", "grid.points=129"], check=True
    )
    points_y = json.loads((tmp_path / "c" / "summary.json").read_text())["points_y"]
    assert points_y - 1 == 2 * (json.loads((first / "summary.json").read_text())["points_y"] - 1)
