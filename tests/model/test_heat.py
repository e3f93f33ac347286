# SPDX-License-Identifier: BSD-3-Clause
"""Oil by its data sheet, shear heating of the inlet, flash temperature: Python against Fortran."""

import math

import numpy as np
import pytest
from paper_model import predict_friction
from scipy.special import elliprd

from pyehl.case import Case
from pyehl.contact.film_formulas import report as film_report
from pyehl.contact.film_formulas import sheet
from pyehl.prediction.predict import predict
from pyehl.solver import Solver
from pyehl.surfaces import Topography
from pyehl.theory.ellipse import ellipse
from pyehl.theory.film import central_film
from pyehl.theory.friction import absolute_friction
from pyehl.theory.heat import flash_temperature, thermal_loading, thermal_reduction
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.moes_film import inlet_viscosity_ratio, nijenbanning_venner_moes
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.shear import ShearLaw

OIL = """&lubricant temperature = {t} kinematic_viscosity_40 = 68.0 kinematic_viscosity_100 = 8.7
density_15 = 880.0 shear_law = 'eyring' {more} / &contact mean_velocity = 5.0 slide_to_roll = 0.3 /
&grid points = 257 /"""


# Conductivity and diffusivity of both bodies
STEEL = (46.0, 46.0), (1.25e-5, 1.25e-5)


def kinematic_viscosity(t: float, at_40: float, at_100: float) -> float:
    """Kinematic viscosity [mm^2/s] at t [degC] by ASTM D341 through two points of a data sheet."""
    nu = np.array([at_40, at_100])
    double_log = np.log(np.log(nu + 0.7 + np.exp(-1.47 - 1.84 * nu - 0.51 * nu**2)))
    log_t = np.log(np.array([40.0, 100.0]) + 273.15)
    slope = (double_log[1] - double_log[0]) / (log_t[1] - log_t[0])
    z = np.exp(np.exp(double_log[0] + slope * (np.log(t + 273.15) - log_t[0]))) - 0.7
    return float(z - np.exp(-0.7487 - 3.295 * z + 0.6119 * z**2 - 0.3193 * z**3))


def resolved(t: float = 60.0, more: str = "", options: list[str] | None = None):
    return Case.from_text(OIL.format(t=t, more=more), options or []).resolve()


@pytest.mark.parametrize("t", [-20.0, 15.0, 60.0, 140.0])
def test_viscosity_of_a_case_is_that_of_the_data_sheet(t):
    more = "pressure_viscosity = 2.2e-8"
    oil = resolved(t, more)["lubricant"]
    density = 880.0 * (1.0 - 6.5e-4 * (t - 15.0))
    expected = 1e-6 * kinematic_viscosity(t, 68.0, 8.7) * density
    assert oil["viscosity"] == pytest.approx(expected, rel=1e-12)
    near = [resolved(t + d, more)["lubricant"]["viscosity"] for d in (-0.5, 0.5)]
    # a difference over one kelvin
    assert oil["temperature_viscosity"] == pytest.approx(math.log(near[0] / near[1]), rel=2e-4)
    z = 2.2e-8 * 1.96e8 / (math.log(oil["viscosity"]) + 9.67)
    assert oil["roelands_z"] == pytest.approx(z, rel=1e-14)


def test_a_resolved_case_reads_back():
    case = Case.from_text(OIL.format(t=60.0, more="thermal_reduction = T"))
    assert Case.from_text(case.text).text == case.text


def test_thermal_reduction_in_formula_prediction_and_solver():
    more = "thermal_reduction = .true."
    warm, cold = resolved(more=more), resolved()
    point, isothermal = OperatingPoint.from_settings(warm), OperatingPoint.from_settings(cold)
    oil = warm["lubricant"]
    loading = thermal_loading(oil["temperature_viscosity"], oil["viscosity"], 5.0, 0.14)
    reduction = thermal_reduction(loading, isothermal.hertz_pressure / 2.26e11, 0.3)
    assert 0.7 < reduction < 0.99
    assert point.thermal_reduction == reduction
    lubricant = Lubricant.from_settings(warm)
    assert lubricant.viscosity == oil["viscosity"]  # no heating in the contact
    ratio = central_film(point, lubricant) / central_film(isothermal, lubricant)
    assert ratio == pytest.approx(reduction, rel=1e-12)
    assert sheet(warm)["formulas"][0]["h_c_m"] == central_film(point, lubricant)
    assert sheet(warm)["thermal_reduction"] == reduction
    films = {}
    for text in (more, ""):
        with Solver(Case.from_text(OIL.format(t=60.0, more=text))) as solver:
            assert ("shear heating" in solver.describe()) == bool(text)
            assert solver.run()
            films[text] = solver.summary
    assert films[more]["thermal_reduction"] == pytest.approx(reduction, rel=1e-13)
    assert films[more]["thermal_loading"] == pytest.approx(loading, rel=1e-13)
    assert films[more]["inlet_viscosity_Pa_s"] == pytest.approx(point.viscosity, rel=1e-12)
    assert films[more]["moes_m"] == pytest.approx(point.moes_m, rel=1e-12)
    assert "thermal_reduction" not in films[""]
    # the formula is within 0.8 % of the solver
    assert films[more]["h_c_m"] / films[""]["h_c_m"] == pytest.approx(reduction, rel=0.01)


def test_inlet_viscosity():
    for reduction in (1.0, 0.9, 0.3):
        ratio = inlet_viscosity_ratio(300.0, 8.0, reduction)
        film = nijenbanning_venner_moes(300.0 * ratio**-0.75, 8.0 * ratio**0.25)
        assert film == pytest.approx(reduction * nijenbanning_venner_moes(300.0, 8.0), rel=1e-13)


def test_flash_temperature_limits():
    q, a, k, kappa = 1e8, 2e-4, 46.0, 1.25e-5
    # stationary: 3 pi/8 q a/k for each surface under all the heat (the potential of a semi-ellipse)
    stationary = flash_temperature(q, a, (0.0, 0.0), (k, k), (kappa, kappa))
    assert stationary == pytest.approx(3 * math.pi / 16 * q * a / k, rel=2e-3)
    # fast: heat flows straight down on the centre line
    s = np.linspace(0.0, 1.0, 201)[:, np.newaxis]
    v = (np.arange(2000) + 0.5) / 2000 * np.sqrt(1.0 + s)
    root = np.sqrt(np.maximum(0.0, 1.0 - (s - v**2) ** 2))
    maximum = float((2.0 * root * np.sqrt(1.0 + s) / 2000).sum(axis=1).max())
    u = 1e5
    expected = 0.5 * 1.5 * q / k * math.sqrt(kappa * a / (math.pi * u)) * maximum
    assert flash_temperature(q, a, (u, u), (k, k), (kappa, kappa)) == pytest.approx(
        expected, rel=2e-3
    )


def max_increase(kappa: float, peclet: float) -> float:
    """Maximum increase of a half-space that moves under a semi-ellipse of heat [mean q a/k].

    By the integral over moving point sources in polar coordinates about points of Y = 0; semi-axes
    1 and kappa, Pe = u a/(2 diffusivity).
    """
    t = (np.arange(1500) + 0.5) / 1500
    angle, weight = math.pi * (1.0 - t**2), 2.0 * math.pi * t / 1500
    c, s = np.cos(angle), np.sin(angle)
    node, of_node = np.polynomial.legendre.leggauss(40)
    node, of_node = 0.5 * math.pi * node, 0.5 * math.pi * of_node
    result = []
    for x in np.linspace(-0.1, 1.0, 45):
        square, slope = c**2 + (s / kappa) ** 2, x * c
        root = np.sqrt(np.maximum(0.0, slope**2 - square * (x**2 - 1.0)))
        near, far = (np.maximum(0.0, (-slope + sign * root) / square) for sign in (-1.0, 1.0))
        half = 0.5 * (far - near)[:, np.newaxis]
        r = 0.5 * (far + near)[:, np.newaxis] + half * np.sin(node)
        heat = 1.0 - (x + r * c[:, np.newaxis]) ** 2 - (r * s[:, np.newaxis] / kappa) ** 2
        rise = np.sqrt(np.maximum(0.0, heat)) * np.exp(-peclet * r * (1.0 + c[:, np.newaxis]))
        along = (half * rise * np.cos(node) * of_node).sum(axis=1)
        result.append(1.5 / math.pi * float((along * weight).sum()))
    return max(result)


@pytest.mark.parametrize("peclet", [0.0, 2.0, 20.0])
@pytest.mark.parametrize(("kappa", "near"), [(0.1, 0.06), (0.4, 0.03), (1.0, 0.012), (4.0, 0.06)])
def test_flash_temperature_of_ellipses(kappa, near, peclet):
    """The maximum increase of one surface, by moving sources; exact at zero velocity."""
    square = kappa**2
    ratio = elliprd(0.0, 1.0, square) / elliprd(0.0, square, 1.0) if kappa != 1.0 else 1.0
    shape = ellipse(float(ratio))
    assert shape.ellipticity == pytest.approx(kappa, rel=1e-12)
    alone = flash_temperature(
        1.0, 1.0, (2.0 * peclet, 0.0), (1.0, 1e-30), (1.0, 1.0), shape.potential
    )
    if peclet == 0.0:
        near = 1e-3
    assert alone == pytest.approx(max_increase(kappa, peclet), rel=near)


def test_absolute_friction_of_the_solver():
    keys = ["lubricant.shear_law=limiting", "contact.slide_to_roll=-2.0", "grid.points=129"]
    case = Case.from_text("", keys)
    with Solver(case) as solver:
        assert solver.run()
        s = solver.summary
    point = OperatingPoint(slide_to_roll=-2.0)
    # tau -> tau_L = 0.06 p: the fluid carries the whole load, apart from p = 0 outside
    assert s["mu"] == s["mu_smooth"] == pytest.approx(0.06, rel=1e-2)
    assert s["mu"] < 0.06
    assert s["shear_stress_max_Pa"] == pytest.approx(0.06 * s["p_max_Pa"], rel=1e-6)
    force = s["F"] * 0.04 * 2.0 * point.mean_velocity / point.film_scale * point.hertz_radius**2
    assert s["mu"] == pytest.approx(force / 600.0, rel=1e-12)
    flux = s["mu"] * 600.0 * point.sliding_speed / (math.pi * point.hertz_radius**2)
    rise = flash_temperature(
        flux, point.hertz_radius, (0.0, 1.68), (46.0, 46.0), (1.25e-5, 1.25e-5)
    )
    assert s["flash_temperature_K"] == pytest.approx(rise, rel=1e-12)
    assert "isothermal" in s["mu_note"]
    h = s["H_c"] * point.film_scale
    # most of the film is about as thick as in the centre, and 1/h is greater at the edge
    assert 1.0 < s["shear_rate_mean_per_s"] * h / point.sliding_speed < 2.0


def test_eyring_friction_of_table_1():
    keys = ["lubricant.shear_law=eyring", "grid.points=257"]
    with Solver(Case.from_text("", keys)) as solver:
        assert solver.run()
        s = solver.summary
    # a semi-ellipse of pressure and a uniform film: the edge is thinner, the inlet carries load too
    flat = Topography(np.zeros((64, 64)), (8.29e-4, 8.29e-4))
    oil = Lubricant(shear=ShearLaw("eyring"))
    uniform = predict_friction(flat, OperatingPoint(), oil, s["h_c_m"])
    assert s["mu"] == pytest.approx(uniform.mu_smooth, rel=0.02)
    # 0.1 m/s of sliding heats by some ten kelvin, 0.017 m/s does not
    assert 0.5 < s["flash_temperature_K"] < 3.0


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["grid.points=129", "contact.moes_m=200.0"], "moes_m"),
        (["grid.points=129", "contact.slide_to_roll=0.0"], "no sliding"),
        (["grid.points=129"], "the Newtonian shear stress of"),
    ],
)
def test_a_missing_coefficient_is_explained(options, words):
    with Solver(Case.from_text("", options)) as solver:
        assert solver.run()
        s = solver.summary
    assert (s["mu"], s["mu_smooth"], s["flash_temperature_K"]) == (None, None, None)
    assert words in s["mu_note"]


def test_a_newtonian_coefficient_where_pressure_is_low():
    """An oil as thin as water at low load: the stress is below that of shear thinning."""
    keys = {
        "contact.load": 1.0,
        "contact.reduced_modulus": 1e9,
        "contact.mean_velocity": 0.5,
        "grid.points": 65,
        "lubricant.density_law": "'incompressible'",
    }
    with Solver(Case.from_text("", [f"{k}={v}" for k, v in keys.items()])) as solver:
        assert solver.run()
        s = solver.summary
    assert s["shear_stress_max_Pa"] < 5e6
    assert 0.0 < s["mu"] < 0.1
    assert "isothermal" in s["mu_note"]


def test_absolute_friction_of_a_uniform_film():
    """Coefficient and flash temperature with a shear law; without one, only the ratio."""
    point = OperatingPoint(slide_to_roll=0.5)
    law = Lubricant(shear=ShearLaw("eyring"))
    s = absolute_friction(point, law, film=2e-7, mu_smooth=0.05, mu_ratio=1.2)
    assert s["mu"] == pytest.approx(0.06)
    assert s["shear_rate_mean_per_s"] == pytest.approx(0.42 / 2e-7)
    flux = 0.06 * 600.0 * 0.42 / (math.pi * point.hertz_radius**2)
    rise = flash_temperature(
        flux, point.hertz_radius, (1.05, 0.63), (46.0, 46.0), (1.25e-5, 1.25e-5)
    )
    assert s["flash_temperature_K"] == pytest.approx(rise, rel=1e-12)
    alone = absolute_friction(point, Lubricant(), film=2e-7, mu_smooth=1e3, mu_ratio=1.2)
    assert math.isnan(alone["mu"])
    assert "shear_law" in alone["mu_note"]


def test_prediction_and_film_sheet_state_the_inlet_heating():
    """Film, coefficients and the inlet heating of both, in the summary and in print."""
    # the film of the paper's model is that of the formula, to which the reduction applies exactly
    surface = ["surface.kind=fractal", "surface.pixels=64", "psd.smooth=hertz"]
    warm = predict(resolved(more="thermal_reduction = T", options=surface))
    cold = predict(resolved(options=surface))
    s = warm.summary
    assert warm.film / cold.film == pytest.approx(s["thermal_reduction"], rel=1e-12)
    assert s["mu"] == pytest.approx(s["mu_smooth"] * s["mu_ratio"])
    assert 0.02 < s["mu_smooth"] < 0.1
    assert s["shear_rate_mean_per_s"] == pytest.approx(1.5 / warm.film)
    assert "isothermal" in film_report(sheet(resolved(more="thermal_reduction = T")))
    assert "isothermal" not in film_report(sheet(resolved()))
