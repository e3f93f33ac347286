# SPDX-License-Identifier: BSD-3-Clause
"""Numbers in README, tutorial, how-tos, limits and theory that this build gives in seconds."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from document_text import plain
from records import percent
from scipy.integrate import quad
from scipy.optimize import brentq

import pyehl
from pyehl.app import answers
from pyehl.prediction import response
from pyehl.prediction.model import ELLIPTICITY, FILM_ELLIPTICITY
from pyehl.schema import summary_of
from pyehl.studies import plan, study
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.response import edge_gain


@pytest.fixture(scope="module")
def states(root: Path):
    """Assert that a page contains some words."""

    def check(page: str, *words: str) -> None:
        text = plain(root / page)
        assert [one for one in words if one not in text] == []

    return check


@pytest.mark.long
def test_smooth_contact_of_the_readme(states, cases: Path):
    result = summary_of(pyehl.solve(cases / "finish.nml", {"surface.kind": "smooth"}))
    film = 1e9 * result["h_c_m"] / result["H_c"] * result["H_c_extrapolated"]
    states(
        "README.md",
        f"is {1e9 * result['h_c_m']:.1f} nm on this grid and, in the table, {film:.1f} nm "
        "extrapolated",
    )


def test_stress_of_a_newtonian_oil(states, cases: Path):
    result = summary_of(pyehl.solve(cases / "table1.nml", {"surface.kind": "smooth"}))
    assert result["shear_stress_max_Pa"] == pytest.approx(2e13, rel=0.1)
    states("docs/theory/prediction-compared.md", "whose shear stress here would be 2·10¹³ Pa")


@pytest.mark.long
def test_tutorial(states, cases: Path):
    smooth = {"surface.kind": "smooth", "grid.target_error": 0.02}
    result = summary_of(pyehl.solve(cases / "finish.nml", smooth))
    values = [result[f"H_c{end}"] for end in ("", "_extrapolated", "_error", "_error_grid")]
    say = "`H_c` {:.4f}, `H_c_extrapolated` {:.4f} and `H_c_error` {:.4f}. Of this error {:.4f} is"
    ground, honed = (
        pyehl.predict(cases / "finish.nml", {"surface.rms_height": height}).summary
        for height in (1e-7, 4e-8)
    )
    # the film at the low end of the band of an estimated alpha
    low = 1.0 - 0.17
    states(
        "docs/tutorial.md",
        say.format(*values),
        f"The roughness adds {percent(100.0 * (ground['mu_ratio'] - 1.0))} to the friction",
        f"minimum film over it is {1e9 * ground['h_min_rough_m']:.0f} nm",
        f"at Λ = {ground['lambda_ratio']:.2f} a real surface",
        f"but even then Λ is {low * honed['lambda_ratio']:.1f}.",
    )


@pytest.mark.long
def test_measured_surface(states, cases: Path):
    result = pyehl.predict(cases / "scan.nml", {"surface.outliers": 100}, tracks=4)
    steps = result.summary["surface_preparation"]["steps"]
    rms = [1e9 * result.summary[f"rms_{name}_m"] for name in ("height", "deformed")]
    strongest = max(result.bands, key=lambda band: band.increase)
    low, high = 1e6 * strongest.shortest, 1e6 * strongest.longest
    states(
        "docs/howto/measured-surface.md",
        "rms height over the tile decreases from {:.1f} nm to {:.1f} nm".format(*rms),
        f"aves of {low:.0f} to {high:.0f} μm contribute most",
    )
    assert steps[0]["points_changed"] == 3


@pytest.mark.long
def test_traction_near_the_origin(states, cases: Path):
    """Proportional to the ratio below 1e-6, and no longer at 1e-5."""
    slopes = [
        float(pyehl.solve(cases / "mtm.nml", {"contact.slide_to_roll": s, "grid.points": 129}).mu)
        / s
        for s in (1e-7, 1e-6, 1e-5)
    ]
    assert slopes[1] / slopes[0] > 0.85
    assert slopes[2] / slopes[0] < 0.5
    states("docs/howto/traction.md", "proportional to the ratio only below 10⁻⁶")
    assert np.exp(-1.8 * 2.0**1.2) < 0.02
    states("docs/howto/traction.md", "above h_c/σ = 2 nearly all of the load is on the film")


@pytest.mark.long
def test_fitted_shear_law(states, cases: Path):
    case = pyehl.Case(cases / "traction.nml", ["grid.points=65"])
    (result,) = pyehl.fit_lubricant(cases / "traction.csv", case).parameters
    value, low, high = (f"{1e-6 * v:.1f}" for v in (result.value, result.low, result.high))
    states(
        "docs/howto/lubricants.md", f"finds {value} MPa with a 95 % interval from {low} to {high}"
    )


@pytest.mark.parametrize(("name", "case"), [("gear", "gear_pair"), ("bearing", "ball_bearing")])
def test_ellipses_whose_film_was_not_compared(states, cases: Path, name: str, case: str):
    kappa = pyehl.film(cases / f"{case}.nml").summary["ellipticity"]
    assert FILM_ELLIPTICITY < kappa < ELLIPTICITY[1]
    states(
        f"docs/howto/{name}.md",
        f"only up to an ellipticity of {FILM_ELLIPTICITY:g}; this contact has {kappa:.1f}.",
    )


@pytest.mark.long
def test_limits(states, cases: Path):
    """Scatter over the tracks, and the viscosity at a high pressure."""
    result = pyehl.predict(cases / "table1.nml").summary
    spread = result["mu_ratio_tracks_spread"] / result["mu_ratio_tracks"]
    pressure = OperatingPoint.from_moes(2000.0, 20.0).hertz_pressure
    assert pressure > 4e9
    power = np.log(Lubricant().viscosity_ratio(pressure)) + 1e-9
    superscript = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")
    say = f"is e{f'{power:.0f}'.translate(superscript)} times that at ambient pressure"
    states("docs/limits.md", f"differs by about {100.0 * spread:.0f} % between", say)
    heavy = {"contact.moes_m": 2000.0, "contact.moes_l": 20.0, "grid.points": 513}
    assert pyehl.solve(pyehl.Case.from_text("", heavy)).attrs["status"] == "converged"


def test_constants_of_the_prediction(states):
    """Film breakdown, the film by the inlet, the pressure of oblique waves."""
    ends, film, quadratic = response.FILM_ENDS, response.INLET_FILM, response.QUADRATIC
    states("docs/conventions.md", f"to first order, exceeds {ends:g} times the smooth film")
    states("docs/theory/prediction.md", f"loss of film exceeds {ends:g} times the smooth film")
    states(
        "docs/theory/prediction-response.md",
        f"thicker than to first order by ${film:g}\\,H_1^2/H$",
        f"Where $H_1$ exceeds ${quadratic:g}\\,H$",
        f"at $H_1 = {ends:g}\\,H$ the film breaks down",
        f"**Pressure.** It increases by ${response.INLET_PRESSURE:g}\\,P_0^2$",
    )
    q = np.geomspace(0.1, 200.0, 20)
    gains = [edge_gain(kx, q, film) for kx in (0.0, 5.0, 20.0) for film in (0.01, 0.03, 0.1)]
    assert 0.03 < np.max(gains) - 1.0 < 0.04
    states("docs/theory/prediction.md", "`edge_gain` adds up to 4 %")


def test_pressure_far_from_the_contact(states):
    """Where the film ruptures, and the contribution to the load."""
    angle = brentq(lambda x: np.tan(x) + 3.0 * np.tanh(3.0 * x), 1.6, 2.2)
    second = -0.8 * np.cos(angle) / np.cosh(3.0 * angle)
    load = quad(lambda x: 0.8 * np.cos(x) + second * np.cosh(3.0 * x), 0.0, angle)[0] / 0.8
    states(
        "docs/theory/border.md",
        rf"so that $\vartheta = {np.degrees(angle):.1f}°$ and $C_\Phi = {second:.5f}$",
        f"The rupture adds {100.0 * (load - 1.0):.0f} % to the load far away",
        rf"to the power $-3-\sqrt{{10}} \approx -{3.0 + np.sqrt(10.0):.1f}$",
    )


def test_limits_of_a_study_on_the_page(states):
    states(
        "docs/howto/sweep.md",
        f"With more than {plan.MAX_CHECKED} cases `--plan` checks some of them",
        "for at most five seconds",
        f"{study.MAX_CASES:,} cases".replace(",", " "),
        f"({plan.CASE_BYTES / 1000:g} kB each)",
    )
    assert plan.MAX_SECONDS == 5.0


def test_delays_of_the_app_on_the_pages(states):
    states("docs/howto/app.md", f"When the control has been at rest for {answers.DELAY:g} s")


def test_constants_of_the_solver(root: Path):
    """The table of docs/design.md has the values of the sources."""
    text = plain(root / "docs/design.md")
    table = re.findall(r"^\| `(\w+)` \(`([\w/.]+)`\) \| (\S+) \|", text, re.MULTILINE)
    assert len(table) == 13
    for name, file, shown in table:
        source = (root / "fortran" / file).read_text(encoding="utf-8")
        (value,) = re.findall(rf"\b{name} = (-?[\d.]+)_dp", source)
        assert float(value) == float(shown.replace("−", "-")), name
