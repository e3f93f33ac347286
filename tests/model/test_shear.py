# SPDX-License-Identifier: BSD-3-Clause
"""Shear laws: closed forms and limits; `cases/test_kinematics.py` tests them in runs."""

import math

import numpy as np
import pytest

from pyehl.theory.shear import ShearLaw, shear_stress

LAWS = [
    ShearLaw(),
    ShearLaw("eyring", eyring_stress=6e6),
    ShearLaw("limiting", limiting_coefficient=0.05),
    ShearLaw("limiting", limiting_stress=8e7),
    ShearLaw("carreau", carreau_stress=7e6, carreau_exponent=0.46),
]


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.law)
def test_newtonian_when_slow(law):
    tau = np.array([1e-4, 1.0, 100.0])
    assert shear_stress(tau, np.full(3, 1e9), law) == pytest.approx(tau, rel=2e-5)


def test_closed_forms():
    tau, p = np.array([3e7]), np.array([1e9])
    eyring, limiting, fixed, carreau = (float(shear_stress(tau, p, law)[0]) for law in LAWS[1:])
    assert eyring == pytest.approx(6e6 * math.log(5 + math.sqrt(26)), rel=1e-14)
    assert limiting == pytest.approx(5e7 * (1 - math.exp(-0.6)), rel=1e-14)
    assert fixed == pytest.approx(8e7 * (1 - math.exp(-3 / 8)), rel=1e-14)
    assert carreau == pytest.approx(3e7 * (1 + (30 / 7) ** 2) ** -0.27, rel=1e-14)


def test_stress_reaches_the_limit():
    p = np.array([0.0, 1e8, 2e9])
    stress = shear_stress(np.full(3, 1e15), p, LAWS[2])
    assert stress == pytest.approx(0.05 * p, rel=1e-14)
    assert float(shear_stress(1e15, 0.0, LAWS[3])) == pytest.approx(8e7, rel=1e-14)


def test_carreau_is_a_power_law_at_high_stress():
    low, high = shear_stress([1e12, 1e13], 0.0, LAWS[4])
    assert high / low == pytest.approx(10**0.46, rel=1e-9)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"law": "dry"}, "eyring"),
        ({"law": "eyring", "eyring_stress": 0.0}, "eyring_stress"),
        ({"law": "limiting", "limiting_coefficient": math.nan}, "limiting_coefficient"),
        ({"law": "limiting", "limiting_stress": -1.0}, "limiting_stress"),
        ({"law": "carreau", "carreau_stress": 1e6}, "carreau_exponent"),
        ({"law": "carreau", "carreau_stress": 1e6, "carreau_exponent": 1.5}, "carreau_exponent"),
        ({"law": "carreau", "carreau_stress": 1e6, "carreau_exponent": 0.04}, r"\[0.05, 1\]"),
    ],
)
def test_refuses(changes, message):
    with pytest.raises(ValueError, match=message):
        ShearLaw(**changes)
