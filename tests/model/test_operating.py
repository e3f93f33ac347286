# SPDX-License-Identifier: BSD-3-Clause
"""Conversions between SI, Moes and Hertz, viscosity and density."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from reference import TABLE_1

import pyehl
from pyehl.theory.ellipse import ellipse
from pyehl.theory.line_contact import LineContact
from pyehl.theory.lubricant import Lubricant, default_roelands_z
from pyehl.theory.operating import OperatingPoint


def test_table_1():
    point = OperatingPoint()
    assert point.hertz_radius == pytest.approx(TABLE_1["hertz_radius"], rel=2e-5)
    assert point.hertz_pressure == pytest.approx(TABLE_1["hertz_pressure"], rel=3e-5)
    assert point.moes_m == pytest.approx(TABLE_1["moes_m"], rel=3e-5)
    assert point.moes_l == pytest.approx(TABLE_1["moes_l"], rel=5e-5)
    assert point.speed_parameter == pytest.approx(TABLE_1["speed_parameter"], rel=5e-5)
    assert Lubricant().roelands_z == pytest.approx(TABLE_1["roelands_z"], rel=1e-5)
    # one pixel of the table's 256 is 1/128 of a; the tile is 1.9957 a
    assert TABLE_1["length"] / point.hertz_radius == pytest.approx(1.9957, rel=3e-5)


@given(scale=st.tuples(*[st.floats(0.1, 10.0)] * 6))
def test_identities(scale):
    base = (600.0, 0.84, 0.018, 2e11, 0.04, 2e-8)
    point = OperatingPoint(*(b * s for b, s in zip(base, scale, strict=True)))
    m, ell = point.moes_m, point.moes_l
    assert point.alpha_bar == pytest.approx(ell / math.pi * (1.5 * m) ** (1 / 3))
    assert point.speed_parameter == pytest.approx((128 * math.pi**3 / (3 * m**4)) ** (1 / 3))
    a = point.hertz_radius
    assert point.hertz_pressure == pytest.approx(
        point.reduced_modulus * a / (math.pi * point.radius)
    )


@given(m=st.floats(5.0, 5000.0), ell=st.floats(0.5, 25.0), r=st.floats(1e-3, 1.0))
def test_from_moes_is_the_inverse(m, ell, r):
    point = OperatingPoint.from_moes(m, ell, radius=r)
    assert point.moes_m == pytest.approx(m)
    assert point.moes_l == pytest.approx(ell)
    assert not point.si


@pytest.mark.parametrize("contact", [OperatingPoint, LineContact])
def test_no_pressure_viscosity_only_at_l_0(contact):
    point = contact.from_moes(100.0, 0.0, pressure_viscosity=0.0)
    assert point == contact.from_moes(100.0, 0.0)
    assert point.moes_m == pytest.approx(100.0)
    with pytest.raises(pyehl.InputError, match="pressure_viscosity"):
        contact.from_moes(100.0, 10.0, pressure_viscosity=0.0)
    with pytest.raises(pyehl.InputError, match="viscosity"):
        contact.from_moes(100.0, 10.0, viscosity=0.0)


@pytest.mark.parametrize("ratio", [1e-7, 1e7])
def test_extreme_radius_ratios_are_refused(ratio):
    with pytest.raises(pyehl.InputError, match="radius_ratio must be 1e-6"):
        ellipse(ratio)


def test_from_settings_takes_either_kind():
    moes = pyehl.Case(contact={"moes_m": 200.0, "moes_l": 5.0}).resolve()
    assert OperatingPoint.from_settings(moes).moes_m == pytest.approx(200.0)
    contact = {"load": 10.0, "mean_velocity": 1.0, "radius": 0.01, "reduced_modulus": 2e11}
    point = OperatingPoint.from_settings(pyehl.Case(contact=contact).resolve())
    assert (point.load, point.si) == (10.0, True)
    sliding = pyehl.Case(contact=contact | {"slide_to_roll": -0.5}).resolve()
    point = OperatingPoint.from_settings(sliding)
    assert point.sliding_speed == 0.5


def test_viscosity_slope_at_ambient_pressure_is_alpha():
    for law in ("roelands", "barus"):
        oil = Lubricant(viscosity_law=law)
        slope = float(oil.log_viscosity_ratio(1e3) - oil.log_viscosity_ratio(-1e3)) / 2e3
        assert slope == pytest.approx(oil.pressure_viscosity, rel=1e-6)
        assert float(oil.viscosity_ratio(0.0)) == 1.0


def test_roelands_by_its_original_form():
    # Roelands wrote log eta against its value at -p0, 6.315e-5 Pa s: ln eta + 9.67
    oil, p = Lubricant(), 1.2e9
    log_eta0 = math.log(oil.viscosity)
    expected = (log_eta0 + 9.67) * ((1 + p / oil.roelands_p0) ** oil.roelands_z - 1)
    assert float(oil.log_viscosity_ratio(p)) == pytest.approx(expected, rel=1e-12)


def test_roelands_under_temperature_by_its_original_form():
    # (T - 138 K)^-S0 in Roelands' form, with beta its slope at ambient pressure
    oil, p, rise = Lubricant(temperature=60.0, temperature_viscosity=0.035), 1.2e9, 40.0
    level, above = math.log(oil.viscosity) + 9.67, 60.0 + 273.15 - 138.0
    share = (1 + p / oil.roelands_p0) ** oil.roelands_z
    share *= ((above + rise) / above) ** (-0.035 * above / level)
    assert float(oil.log_viscosity_ratio(p, rise)) == pytest.approx(level * (share - 1), rel=1e-12)
    for law in ("roelands", "barus"):
        warm = Lubricant(viscosity_law=law, temperature_viscosity=0.035)
        slope = float(warm.log_viscosity_ratio(0.0, 1e-3) - warm.log_viscosity_ratio(0.0, -1e-3))
        assert slope / 2e-3 == pytest.approx(-0.035, rel=1e-6)
        assert warm.log_viscosity_ratio(p, 0.0) == warm.log_viscosity_ratio(p)


def test_roelands_ends_at_minus_p0():
    assert np.isnan(Lubricant().log_viscosity_ratio(-2e8))
    assert np.isfinite(Lubricant().log_viscosity_ratio(-1.9e8))


def test_density():
    oil = Lubricant()
    assert float(oil.density_ratio(0.0)) == 1.0
    assert float(oil.density_ratio(1e15)) == pytest.approx(1.34, rel=1e-5)
    assert np.all(Lubricant(density_law="incompressible").density_ratio([0.0, 1e9]) == 1.0)


@pytest.mark.parametrize(
    ("arguments", "word"),
    [
        ({"load": -1.0}, "load"),
        ({"load": "heavy"}, "load = 'heavy': expected a positive number"),
        ({"radius": 0.0}, "radius"),
        ({"mean_velocity": math.nan}, "mean_velocity"),
        ({"reduced_modulus": math.inf}, "reduced_modulus"),
        ({"pressure_viscosity": -1e-9}, "pressure_viscosity"),
    ],
)
def test_operating_point_refuses(arguments, word):
    with pytest.raises(ValueError, match=word):
        OperatingPoint(**arguments)


@pytest.mark.parametrize(
    ("arguments", "word"),
    [
        ({"viscosity_law": "tait"}, "barus"),
        ({"density_law": "none"}, "incompressible"),
        ({"viscosity": 0.0}, "viscosity"),
        ({"viscosity": 4e-5}, "Pa s"),
        ({"roelands_z": -0.5}, "roelands_z"),
    ],
)
def test_lubricant_refuses(arguments, word):
    with pytest.raises(ValueError, match=word):
        Lubricant(**arguments)


def test_moes_numbers_must_be_positive():
    with pytest.raises(ValueError, match="moes_l"):
        OperatingPoint.from_moes(100.0, -1.0)
    assert OperatingPoint.from_moes(100.0, 0.0).moes_l == 0.0
    assert OperatingPoint.from_moes(100.0, 0.0).moes_m == pytest.approx(100.0)
    assert default_roelands_z(0.04, 0.0) == 0.0
