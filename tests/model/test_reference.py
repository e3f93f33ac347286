# SPDX-License-Identifier: BSD-3-Clause
"""Closed forms of the dry contact, against numerical integration."""

import math

import pytest
import reference
from scipy.integrate import dblquad, quad


def test_hertz_pressure_integrates_to_the_load():
    load, _ = quad(lambda r: 2 * math.pi * r * float(reference.hertz_pressure(r, 0.0)), 0.0, 1.0)
    assert load == pytest.approx(2 * math.pi / 3, rel=1e-9)


@pytest.mark.parametrize("x", [0.0, 0.5, 1.5, 3.0])
def test_deflection(x):
    # polar coordinates about the point, in which 1/r cancels
    def along(s, phi):
        return float(reference.hertz_pressure(x + s * math.cos(phi), s * math.sin(phi)))

    value, _ = dblquad(along, 0.0, math.pi, 0.0, x + 1.0, epsabs=1e-5, epsrel=1e-5)
    expected = 2 / math.pi**2 * 2 * value
    assert float(reference.hertz_deflection(x, 0.0)) == pytest.approx(expected, abs=2e-4)


def test_deflection_is_smooth_at_the_edge():
    inside, outside = reference.hertz_deflection([1 - 1e-9, 1 + 1e-9], 0.0)
    assert inside == pytest.approx(outside, abs=1e-8)
    assert float(reference.hertz_deflection(0.0, 0.0)) == 1.0
    far = float(reference.hertz_deflection(1e3, 0.0))
    # far away, a point load of 2 pi/3
    assert far == pytest.approx(2 / math.pi**2 * 2 * math.pi / 3 / 1e3, rel=1e-3)
