# SPDX-License-Identifier: BSD-3-Clause
"""The prediction for shear-thinning lubricants, and the deformed surface in numbers."""

import csv
import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from document_text import plain
from scipy import optimize

import pyehl
from pyehl.case import Case
from pyehl.contact.smooth import solve_contact, zone_of
from pyehl.schema import summary_of
from pyehl.simulation.initial_condition import starting_pressure
from pyehl.simulation.resolution import resolution
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.response import inlet_transfer
from pyehl.theory.shear import flow_factors, sliding_stress
from pyehl.theory.transport import transport

CASES = Path(__file__).resolve().parents[2] / "cases"
SURFACE = (
    "&surface kind = 'fractal' rms_height = 5e-8 seed = 1 pixels = 64 length_x = 4e-4 "
    "length_y = 4e-4 /"
)


def table_1(*options: str) -> Case:
    """Return the contact of Table 1 with a small fractal tile."""
    text = (
        "&contact load = 600 mean_velocity = 0.84 radius = 0.018 reduced_modulus = 2.26e11 /\n"
        f"&lubricant shear_law = 'eyring' /\n{SURFACE}\n"
    )
    return Case.from_text(text, options)


@pytest.mark.parametrize(
    ("law", "exponent", "b", "s", "phi"),
    [
        ("eyring", 1.0, 0.0, (5.0, 3.0), (2.15284, 2.15284)),
        ("eyring", 1.0, 1.0, (2.0, 2.0), (1.53059, 1.31352)),
        ("eyring", 1.0, 100.0, (1.0, 1.0), (97.7339, 18.3347)),
        ("carreau", 0.5, 2.0, (5.0, 5.0), (3.06463, 2.8926)),
    ],
)
def test_flow_factors_of_the_printed_table(law, exponent, b, s, phi):
    result = flow_factors(law, exponent, [b], s)
    assert (result.along[0], result.across[0]) == pytest.approx(phi, rel=1e-4)


def test_slopes_of_flow_factors():
    b, s, step = np.array([0.3, 4.0, 50.0]), np.array([2.0, 1.0, 3.0]), 1e-4
    here = flow_factors("carreau", 0.6, b, (s, 0.0))
    more, less = (flow_factors("carreau", 0.6, b * math.exp(d), (s, 0.0)) for d in (step, -step))
    slope = np.log(more.along / less.along) / (2.0 * step)
    np.testing.assert_allclose(here.by_sliding, slope, rtol=1e-4, atol=1e-6)
    more, less = (flow_factors("carreau", 0.6, b, (s * math.exp(d), 0.0)) for d in (step, -step))
    slope = np.log(more.along / less.along) / (2.0 * step)
    np.testing.assert_allclose(here.by_gradient, slope, rtol=1e-4, atol=1e-6)
    np.testing.assert_allclose(here.tangent, here.along * (1.0 + slope), rtol=1e-4)


def test_sliding_stress_solves_the_law():
    b = np.array([[0.0, 0.5], [20.0, 1e6]])
    tau = sliding_stress("carreau", 0.5, b)
    np.testing.assert_allclose(tau * (1.0 + tau**2) ** 0.5, b, rtol=1e-6)
    np.testing.assert_allclose(sliding_stress("eyring", 1.0, b), np.arcsinh(b), rtol=1e-12)


def waves_at(case: Case) -> tuple[np.ndarray, float]:
    """T at the centre for a few waves, and how much thinner the lubricant is in the inlet."""
    settings = case.resolve()
    o, oil = OperatingPoint.from_settings(settings), Lubricant.from_settings(settings)
    contact = solve_contact(settings)
    zone = zone_of(contact, o, oil)
    kx, ky = np.array([10.0, 25.0, 40.0, 20.0]), np.array([0.0, 25.0, 0.0, 50.0])
    ratio = float(settings["surface"]["velocity_ratio"])
    inlet = inlet_transfer(zone, kx, ky, (o.moes_m, o.moes_l), ratio)
    ((driven, free),) = transport(zone, kx, ky, ratio, np.array([0.0]))
    return driven + free * inlet * np.exp(1j * kx * (ratio - 1.0)), contact.thinning


def test_a_law_at_low_stress_is_newtonian():
    light = "contact.load=20"
    thin, share = waves_at(table_1(light, "lubricant.eyring_stress=1e9"))
    newtonian, one = waves_at(table_1(light, "lubricant.flow='newtonian'"))
    assert one == 1.0
    assert share == pytest.approx(1.0, abs=1e-4)
    np.testing.assert_allclose(thin, newtonian, atol=1e-3)
    less, _ = waves_at(table_1(light, "lubricant.eyring_stress=1e6"))
    assert np.abs(less - newtonian).max() > 0.02


def test_short_waves_of_an_oil_that_thins_are_not_flattened():
    # an independent program, on 257 x 257 nodes, has this for (25, 25)
    thin, _ = waves_at(table_1())
    newtonian, _ = waves_at(table_1("lubricant.flow='newtonian'"))
    assert np.all(np.abs(1.0 - thin)[1:] < np.abs(1.0 - newtonian)[1:])
    assert abs(thin[1].conjugate() - (0.6535 - 0.3833j)) < 0.05


def test_the_table_of_waves_is_that_of_this_package(root, evidence):
    folder = root / "docs" / "evidence" / "thinning"
    compare = evidence("thinning", "compare")
    name = "m500-carreau-100"
    run, measured = compare.PLAN[name], compare.of_table()
    waves = compare.Waves(run, measured[name])
    newtonian = compare.Waves(compare.twin(run), measured[f"{name}-newtonian"])
    result, _ = compare.predicted(waves, newtonian)
    with (folder / "waves.csv").open(newline="", encoding="utf-8") as stream:
        rows = [row for row in csv.DictReader(stream) if row["run"] == name]
    table = [complex(float(r["predicted_re"]), float(r["predicted_im"])) for r in rows]
    np.testing.assert_allclose(result.ravel(), table, atol=2e-3)


def test_friction_hardly_increases():
    predicted = pyehl.predict(table_1("surface.length_x=8.29e-4", "surface.length_y=8.29e-4"))
    newtonian = pyehl.predict(
        table_1(
            "surface.length_x=8.29e-4",
            "surface.length_y=8.29e-4",
            "lubricant.shear_law='newtonian'",
        )
    )
    assert newtonian.mu_ratio > 1.2
    assert abs(predicted.mu_ratio - 1.0) < 0.01
    assert 0.0 < predicted.model_error < 0.01
    assert predicted.summary["p_rise_rms_Pa"] < newtonian.summary["p_rise_rms_Pa"]
    assert "Newtonian" not in predicted.note


def test_a_law_in_the_friction_alone_states_no_error():
    result = pyehl.predict(table_1("lubricant.flow='newtonian'"))
    assert math.isnan(result.model_error)
    assert "those of a Newtonian flow" in result.note


def by_quadrature(
    law: str, exponent: float, b: float, s: tuple[float, float], points: int
) -> list[float]:
    """phi_x, phi_y and the mean stress along X, by Gauss quadrature and SciPy's root search."""
    nodes, weights = np.polynomial.legendre.leggauss(points)
    xi, weights = 0.5 * nodes[:, None], 0.5 * weights[:, None]

    def shear(mean: np.ndarray) -> np.ndarray:
        tau = mean + xi * np.asarray(s)
        size = np.hypot(*tau.T)[:, None]
        if law == "eyring":
            return np.sinh(size) / size * tau
        return (1.0 + size**2) ** ((1.0 - exponent) / (2.0 * exponent)) * tau

    def balance(mean: np.ndarray) -> list[float]:
        x, y = (weights * shear(mean)).sum(axis=0)
        return [math.asinh(x) - math.asinh(b), y / (1.0 + b)]

    alone = math.asinh(b) if law == "eyring" else b**exponent
    result = optimize.root(balance, [alone, 0.0], tol=1e-12)
    assert np.abs(result.fun).max() < 1e-8
    flow = (weights * xi * shear(result.x)).sum(axis=0)
    return [*(12.0 * flow / np.asarray(s)), float(result.x[0])]


def test_reference_values(root):
    """The table of docs/theory/thinning.md: quadrature, factors of Python and Fortran tests."""
    text = plain(root / "docs" / "theory" / "thinning.md")
    source = (root / "fortran" / "test" / "test_flow.f90").read_text(encoding="utf-8")
    calls = [re.sub("_dp", "", line) for line in re.findall(r"call agree\(.*by_.*\)", source)]
    tested = [[float(v) for v in re.findall(r"-?\d[\d.e]*", line)] for line in calls]
    rows = [
        line for line in text.splitlines() if re.match(r"\| (Eyring|Carreau, n = 0.5) \|", line)
    ]
    assert len(rows) == len(tested) == 6
    for line, values in zip(rows, tested, strict=True):
        name, *cells = (cell.strip() for cell in line.strip("|").split("|"))
        b, x, y, along, across, stress = map(float, ", ".join(cells).split(", "))
        assert [b, x, y, along, across, stress] == values
        law = "eyring" if name == "Eyring" else "carreau"
        six = by_quadrature(law, 0.5, b, (x, y), points=6)
        assert six == pytest.approx([along, across, stress], rel=1e-5, abs=1e-9)
        exact = by_quadrature(law, 0.5, b, (x, y), points=200)
        coarse = (law, x) == ("carreau", 5.0)
        assert six == pytest.approx(exact, rel=9e-4 if coarse else 1e-6, abs=1e-9)
        result = flow_factors(law, 0.5, [b], ([x], [y]))
        assert result.along[0] == pytest.approx(along, rel=1e-5)
        assert result.across[0] == pytest.approx(across, rel=1e-5)


def test_error_of_six_points_across_the_film():
    """Error where a gradient outweighs the sliding, as docs/theory/thinning.md states."""
    case = "carreau", 0.5, 2.0, (30.0, 0.1)
    change = np.array(by_quadrature(*case, points=6)) / by_quadrature(*case, points=200) - 1.0
    assert 100.0 * change == pytest.approx([-0.17, -0.17, -1.75], abs=0.01)


@pytest.mark.parametrize("law", ["eyring", "carreau"])
def test_flow_factors_by_sliding_and_gradient(law):
    """As docs/theory/thinning.md states."""
    sliding = np.geomspace(1e-2, 1e6, 60)
    for x, y in ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (10.0, 0.0), (20.0, 20.0)):
        result = flow_factors(law, 0.5, sliding, (x, y))
        assert np.all(np.diff(result.along) > 0.0)
        assert np.all(result.across <= result.along * (1.0 + 1e-12))
    rolling = flow_factors(law, 0.5, [0.0, 0.0], ([1.0, 2.0], [1.0, 2.0]))
    np.testing.assert_allclose(rolling.along, rolling.across, rtol=1e-12)
    assert 1.0 < rolling.along[0] < rolling.along[1]
    if law == "eyring":
        fast = flow_factors(law, 0.5, [1e3, 1e3], ([0.0, 1.0], 0.0))
        assert fast.along[1] < fast.along[0]
        assert fast.across[1] < fast.across[0]


def test_share_below_a_film():
    def share(limit: float) -> tuple[float, float]:
        summary = pyehl.predict(table_1(f"psd.film_limit={limit}")).summary
        assert summary["film_limit_m"] == limit
        return summary["film_below_limit_share"], summary["film_below_limit_error"]

    assert share(1e-6) == (1.0, 0.0)
    assert share(1e-9) == (0.0, 0.0)
    part, error = share(2.2e-7)
    assert 0.02 < part < 0.98
    assert 0.0 < error < part
    summary = pyehl.predict(table_1()).summary
    assert summary["film_limit_m"] is None
    assert summary["film_below_limit_share"] is None


def test_the_deformed_surface_in_numbers():
    result = pyehl.predict(table_1())
    s, response = result.summary, result.friction.response
    assert s["rms_deformed_m"] == pytest.approx(np.std(response.deformed))
    assert s["lambda_ratio_deformed"] == pytest.approx(s["h_min_m"] / s["rms_deformed_m"])
    # the centre of the contact meets every point of the tile, in waves of its local response
    assert s["p_rise_max_Pa"] > 2.0 * s["p_rise_rms_Pa"]
    assert s["p_rise_rms_Pa"] == pytest.approx(s["rms_pressure_Pa"], rel=0.1)
    # pressures with the names of a run: the smooth contact is that of a run on the same grid
    smooth = summary_of(pyehl.solve(table_1(), ["surface.kind=smooth", "grid.points=257"]))
    assert s["p_max_Pa"] == smooth["p_max_Pa"]
    assert s["p_max_Pa"] < s["p_max_rough_Pa"] <= s["p_max_Pa"] + s["p_rise_max_Pa"]
    assert s["h_min_rough_m"] < s["h_min_m"]
    for name in ("rms_deformed_error_m", "p_rise_rms_error_Pa", "h_min_rough_error_m"):
        assert s[name] > 0.0
    model = replace(result.model, operating=replace(result.operating, load=1e5))
    outside = replace(result, model=model).summary
    assert outside["outside_range"]
    assert outside["p_rise_rms_error_Pa"] is None


def test_waves_that_a_grid_leaves_out():
    result = resolution(table_1("grid.points=65"))
    assert abs(result.left_out) < 0.01
    assert result.mu_ratio == pytest.approx(1.0, abs=0.02)


def test_predicted_start_omits_unresolved_waves():
    """With them the response would not be linear; without them the start contains the rest."""
    x, y = np.linspace(-2.5, 1.5, 65), np.linspace(0.0, 2.0, 33)
    low, high = (
        starting_pressure(
            Case(CASES / "table1.nml", f"surface.rms_height={rms}").resolve(),
            {},
            x,
            y,
            np.zeros((1, 1)),
        )
        for rms in (1e-8, 5e-8)
    )
    assert 0.0 < np.std(low) == pytest.approx(np.std(high) / 5.0, rel=0.02)


def test_start_from_the_prediction():
    x = np.linspace(-2.5, 1.5, 129)
    y = np.linspace(0.0, 2.0, 65)
    thin, newtonian = (
        starting_pressure(table_1(*options).resolve(), {}, x, y, np.zeros((1, 1)))
        for options in ((), ("lubricant.flow='newtonian'",))
    )
    assert 0.0 < np.std(thin) < np.std(newtonian)


# Quantities of `rough.py` and their errors
ERRORS = {
    "mu_ratio": "mu_ratio_model_error",
    "p_rise_rms_Pa": "p_rise_rms_error_Pa",
    "p_rise_max_Pa": "p_rise_max_error_Pa",
    "h_min_rough_m": "h_min_rough_error_m",
    "rms_deformed_m": "rms_deformed_error_m",
}


@pytest.mark.parametrize("name", ["e1", "e8"])
def test_table_of_surfaces_is_what_is_predicted(root, script, name):
    rough = script("docs/evidence/thinning/rough.py")
    line = numbers(root / "docs" / "evidence" / "thinning" / "predicted.csv")[name]
    result = rough.predicted(rough.PLAN[name])
    for key in (*ERRORS, *ERRORS.values()):
        assert result[key] == pytest.approx(line[key], rel=1e-4), key


def numbers(path) -> dict[str, dict[str, float]]:
    with path.open(newline="", encoding="utf-8") as stream:
        return {
            row["name"]: {k: float(v) for k, v in row.items() if k not in ("name", "status") and v}
            for row in csv.DictReader(stream)
        }
