# SPDX-License-Identifier: BSD-3-Clause
"""The infinite line: Hertz contact, Moes numbers and film formulas."""

import math
from dataclasses import replace

import line_newton
import pytest

import pyehl
from pyehl.contact.film_formulas import sheet
from pyehl.errors import InputError
from pyehl.theory import line_contact
from pyehl.theory.line_contact import LineContact
from pyehl.theory.lubricant import Lubricant


@pytest.mark.parametrize(("moes_m", "moes_l", "h_c", "h_min"), line_newton.FILMS)
def test_formulas_against_converged_solutions(moes_m, moes_l, h_c, h_min):
    line = LineContact.from_moes(moes_m, moes_l)
    moes, dowson = line_contact.estimates(line, Lubricant(roelands_z=0.68))
    assert -0.025 <= moes.h_c / line.film_scale / h_c - 1.0 <= -0.004
    assert 0.005 <= dowson.h_min / line.film_scale / h_min - 1.0 <= 0.028
    assert not moes.outside
    assert not dowson.outside


def test_numbers_of_a_line():
    line = LineContact(1.8285e5, 0.4622, 0.01, 2.26e11)
    assert line.half_width == pytest.approx(1.4353e-4, rel=1e-4)
    assert (line.moes_m, line.moes_l) == pytest.approx((20.0, 10.0), rel=2e-4)
    # the load of a semi-ellipse, and the definitions by the numbers alone
    assert 0.5 * math.pi * line.half_width * line.hertz_pressure == pytest.approx(1.8285e5)
    assert line.alpha_bar == pytest.approx(line.moes_l * math.sqrt(line.moes_m / (2 * math.pi)))
    speed = 12 * line.viscosity * line.mean_velocity * line.radius**2
    assert line.speed_parameter == pytest.approx(speed / (line.half_width**3 * line.hertz_pressure))
    wide = line_contact.moes_film(20.0, 10.0) * 8 * 20 / math.pi
    assert wide == pytest.approx(5.10, abs=0.005)
    assert line.film_scale * wide * math.pi / 160 == pytest.approx(
        wide * line.radius * math.sqrt(2 * line.speed), rel=2e-3
    )


@pytest.mark.parametrize(
    ("moes_m", "moes_l", "limit", "name"),
    [
        (1e-4, 1e-4, lambda m, _: 3.0 / m, "rigid-isoviscous"),
        (1e6, 0.0, lambda m, _: 2.62105 * m**-0.2, "elastic-isoviscous"),
        (1.0, 1e4, lambda _, ell: 1.28666 * ell ** (2 / 3), "rigid-piezoviscous"),
        (1e9, 1e3, lambda m, ell: 1.31106 * m**-0.125 * ell**0.75, "elastic-piezoviscous"),
    ],
)
def test_asymptotes(moes_m, moes_l, limit, name):
    number = line_contact.moes_film(moes_m, moes_l) * 8 * moes_m / math.pi
    assert number == pytest.approx(limit(moes_m, moes_l), rel=0.02)
    assert line_contact.regime(moes_m, moes_l) == name


def test_without_alpha_and_bad_numbers():
    line = LineContact.from_moes(20.0, 0.0)
    assert line.pressure_viscosity == 0.0
    oil = Lubricant(pressure_viscosity=0.0)
    assert [f.name for f in line_contact.estimates(line, oil)] == ["Moes, line"]
    with pytest.raises(InputError, match="load_per_length"):
        LineContact(-1.0, 1.0, 0.01)
    with pytest.raises(InputError, match="M > 0"):
        line_contact.moes_film(0.0, 5.0)


def test_density_at_l_0_is_that_of_the_solver():
    """L = 0 without SI values has no pressure to compress the lubricant; with them it has."""
    line = LineContact.from_moes(10.0, 0.0)
    film = line_contact.central_film(line, Lubricant()) / line.film_scale
    solved = pyehl.solve(
        pyehl.Case(
            contact={"shape": "line", "moes_m_line": 10.0, "moes_l_line": 0.0}, grid={"points": 257}
        )
    )
    # as far below the solution as for L = 5 ... 10; with the density it would be 15 % below
    assert -0.025 <= film / float(solved["H_c"]) - 1.0 <= -0.003
    in_si = replace(line, si=True)
    density = float(Lubricant().density_ratio(line.hertz_pressure))
    assert line_contact.central_film(in_si, Lubricant()) == pytest.approx(
        film * line.film_scale / density, rel=1e-12
    )


@pytest.mark.parametrize(
    "contact", [{"shape": "line", "moes_m_line": 10.0, "moes_l_line": 0.0}, {"moes_l": 0.0}]
)
def test_density_at_l_0_of_a_starved_inlet(contact):
    """All oil of a thin layer enters the contact, at its ambient density."""
    settings = pyehl.Case(contact=contact, inlet={"film_hertz": 1e-3}).resolve()
    (starved,) = (f for f in sheet(settings)["formulas"] if f["name"].startswith("starved"))
    assert starved["H_c"] == pytest.approx(1e-3, rel=1e-3)
